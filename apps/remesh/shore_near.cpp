#include "apps/remesh/shore_near.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "gis/fields/plain_field.hpp"
#include "gis/geometry/box.hpp"
#include "gis/grid/boundary_kinds.hpp"

namespace coastmesh {

std::vector<NodePair> shoreEdges(const Grid& grid, const TriMesh& mesh) {
  const EdgeKinds kinds(grid);
  std::vector<NodePair> edges;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (mesh.twin(e) != kNone) continue;
      if (!kinds.isOpen(mesh.origin(e), mesh.target(e))) edges.push_back({mesh.origin(e), mesh.target(e)});
    }
  }
  return edges;
}

std::vector<NodePair> coastEdges(const Grid& grid, const TriMesh& mesh) {
  std::vector<NodePair> edges;
  if (!hasPlain(grid)) return edges;
  const std::vector<std::uint8_t> land = landNodes(grid);
  const auto isOnLand = [&](TriId t) {
    return std::ranges::any_of(grid.triangles[t], [&](std::uint32_t node) { return land[node] != 0; });
  };
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    if (isOnLand(t)) continue;
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i), twin = mesh.twin(e);
      if (twin != kNone && isOnLand(triOf(twin))) edges.push_back({mesh.origin(e), mesh.target(e)});
    }
  }
  return edges;
}

Pslg edgesNear(const Grid& grid, std::span<const NodePair> edges, const Domain& part, const SizeOptions& sizes) {
  constexpr double kMargin = 0.25, kFar = 2.0;  // extents of the part, for channels and if sizes have no limit
  Box box;
  for (const Point& p : part.pslg.points) box.add(p);
  const double extent = std::max(box.xmax - box.xmin, box.ymax - box.ymin);
  const Point middle{0.5 * (box.xmin + box.xmax), 0.5 * (box.ymin + box.ymax)};
  const double reach =
      (std::min(sizes.most_m, sizes.size_m) - sizes.shore_m) / sizes.shore_rate * part.projection.scaleAt(middle);
  box = box.grownBy(kMargin * extent + (std::isfinite(reach) ? std::max(0.0, reach) : kFar * extent));
  Pslg near;
  std::unordered_map<std::uint32_t, VertexId> number;
  const auto numberOf = [&](std::uint32_t node, const Point& place) {
    const auto [at, is_new] = number.try_emplace(node, static_cast<VertexId>(near.points.size()));
    if (is_new) near.points.push_back(place);
    return at->second;
  };
  for (const auto& [from, to] : edges) {
    const Point a = part.projection.forward(grid.nodes[from]), b = part.projection.forward(grid.nodes[to]);
    if (!(isInRange(a) && isInRange(b)) || !Box::of(a, b).meets(box)) continue;
    const VertexId first = numberOf(from, a), last = numberOf(to, b);
    near.segments.push_back({first, last, 0, 0, kOutside});
  }
  return near;
}

}  // namespace coastmesh
