#include "gis/size/node_sizes.hpp"

#include <algorithm>
#include <queue>
#include <utility>

#include "core/metric.hpp"
#include "gis/geometry/neighbours.hpp"

namespace coastmesh {

namespace {

Neighbours neighboursIn(const TriMesh& mesh) {
  return {mesh.points.size(), [&](const auto& visit) {
            for (TriId t = 0; t < mesh.triangles.size(); ++t) {
              for (unsigned i = 0; i < 3; ++i) {
                const EdgeRef e = edgeRef(t, i);
                if (mesh.twin(e) == kNone || mesh.twin(e) > e) visit(mesh.origin(e), mesh.target(e));
              }
            }
          }};
}

}  // namespace

std::vector<double> nodeSizes(const TriMesh& mesh, const SizeFunction& size, double gradation,
                              const std::function<double(VertexId)>& measure, const Surface& surface,
                              const ItemLoop& loop) {
  // Slightly less than allowed, because other programs round lengths differently.
  constexpr double kHair = 1.0 - 1e-6;
  std::vector<double> sizes(mesh.points.size()), measures(mesh.points.size());
  forEachByStretches(loop, sizes.size(), [&](std::size_t i) {
    const auto v = static_cast<VertexId>(i);
    measures[v] = measure(v);
    sizes[v] = size.at(mesh.points[v]) / measures[v];
  });
  const auto allowed = [&](VertexId from, VertexId to) {
    const double length = surface.chord(mesh.points[from], mesh.points[to]);
    const double metres = length / std::max(measures[from], measures[to]);
    return sizes[from] + kHair * gradation * metres;
  };
  using Entry = std::pair<double, VertexId>;
  const std::vector<Entry> first_entries =
      joined(overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
        std::vector<Entry> some;
        for (std::size_t t = first; t < last; ++t) {
          for (unsigned i = 0; i < 3; ++i) {
            const EdgeRef e = edgeRef(static_cast<TriId>(t), i);
            if (mesh.twin(e) != kNone && mesh.twin(e) < e) continue;  // each edge once
            VertexId from = mesh.origin(e), to = mesh.target(e);
            if (sizes[to] < sizes[from]) std::swap(from, to);
            if (sizes[from] < sizes[to] && allowed(from, to) < sizes[to]) some.push_back({sizes[from], from});
          }
        }
        return some;
      }));
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue(std::greater<>(), first_entries);
  if (queue.empty()) return sizes;
  const Neighbours neighbours = neighboursIn(mesh);
  while (!queue.empty()) {
    const auto [least, from] = queue.top();
    queue.pop();
    if (least != sizes[from]) continue;
    for (const VertexId to : neighbours.of(from)) {
      const double most = allowed(from, to);
      if (!(most < sizes[to])) continue;
      sizes[to] = most;
      queue.push({most, to});
    }
  }
  return sizes;
}

}  // namespace coastmesh
