#include "tests/support/size_figures.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/metric.hpp"

namespace coastmesh {

double SizeOf::at(const Point& x) const { return std::clamp(f_(x), least_, most_); }

SizeFigures sizeFigures(const TriMesh& mesh, const SizeFunction& size) {
  std::vector<double> shares;
  double needed = 0.0;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t].v;
    const Point &a = mesh.points[v[0]], &b = mesh.points[v[1]], &c = mesh.points[v[2]];
    for (const Point& middle : {midpoint(a, b), midpoint(b, c), midpoint(c, a)}) {
      const double h = size.at(middle);
      needed += 0.5 * cross(b - a, c - a) / 3.0 * 2.0 / (std::sqrt(3.0) * h * h);
    }
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (mesh.twin(e) != kNone && mesh.twin(e) < e) continue;
      const Point &from = mesh.points[mesh.origin(e)], &to = mesh.points[mesh.target(e)];
      shares.push_back(distance(from, to) / size.at(midpoint(from, to)));
    }
  }
  std::ranges::sort(shares);
  const auto within = std::ranges::count_if(shares, [](double s) { return s >= 0.7 && s <= 1.4; });
  return {shares[shares.size() / 2], static_cast<double>(within) / static_cast<double>(shares.size()),
          static_cast<double>(mesh.points.size()) / needed};
}

}  // namespace coastmesh
