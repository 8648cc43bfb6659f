#include "gis/size/node_sizes.hpp"

#include <algorithm>
#include <queue>
#include <utility>

#include "core/metric.hpp"

namespace coastmesh {

namespace {

// The edges of a mesh by their ends.
class Neighbours {
 public:
  explicit Neighbours(const TriMesh& mesh) : first_(mesh.points.size() + 1, 0) {
    const auto forEachEdge = [&](auto&& f) {
      for (TriId t = 0; t < mesh.triangles.size(); ++t) {
        for (unsigned i = 0; i < 3; ++i) {
          const EdgeRef e = edgeRef(t, i);
          if (mesh.twin(e) == kNone || mesh.twin(e) > e) f(mesh.origin(e), mesh.target(e));
        }
      }
    };
    forEachEdge([&](VertexId a, VertexId b) { ++first_[a + 1], ++first_[b + 1]; });
    for (std::size_t v = 0; v + 1 < first_.size(); ++v) first_[v + 1] += first_[v];
    ends_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    forEachEdge([&](VertexId a, VertexId b) { ends_[next[a]++] = b, ends_[next[b]++] = a; });
  }
  std::span<const VertexId> of(VertexId v) const {
    return std::span(ends_).subspan(first_[v], first_[v + 1] - first_[v]);
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<VertexId> ends_;
};

}  // namespace

std::vector<double> nodeSizes(const TriMesh& mesh, const SizeFunction& size, double gradation,
                              const std::function<double(const Point&)>& scale) {
  // Slightly less, since others round the lengths that they measure otherwise.
  constexpr double kHair = 1.0 - 1e-6;
  std::vector<double> sizes(mesh.points.size()), scales(mesh.points.size());
  for (VertexId v = 0; v < sizes.size(); ++v) {
    scales[v] = scale(mesh.points[v]);
    sizes[v] = size.at(mesh.points[v]) / scales[v];
  }
  const auto allowed = [&](VertexId from, VertexId to) {
    const double metres = distance(mesh.points[from], mesh.points[to]) / std::max(scales[from], scales[to]);
    return sizes[from] + kHair * gradation * metres;
  };
  using Entry = std::pair<double, VertexId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t].v;
    for (unsigned i = 0; i < 3; ++i)
      for (const VertexId to : {v[next3(i)], v[prev3(i)]})
        if (allowed(v[i], to) < sizes[to]) queue.push({sizes[v[i]], v[i]});
  }
  if (queue.empty()) return sizes;
  const Neighbours neighbours(mesh);
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
