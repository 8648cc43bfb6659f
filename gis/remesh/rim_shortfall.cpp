#include "gis/remesh/rim_shortfall.hpp"

#include <algorithm>
#include <utility>

#include "core/input_corners.hpp"
#include "core/metric.hpp"
#include "core/quality.hpp"

namespace coastmesh {

namespace {

constexpr double kHairDeg = 1e-4;  // of angles on the surface, besides those in space

// The corners that no shared edge is a side of: a larger patch has them too.
InputCorners lastingCorners(const TriMesh& mesh, const RefineOptions& options, const std::vector<Point>& rim) {
  const InputCorners all(mesh, TriangleBound(options.min_angle_deg, options.max_angle_deg, options.size_max));
  std::vector<InputCorner> lasting(all.all().begin(), all.all().end());
  std::erase_if(lasting,
                [&](const InputCorner& corner) { return std::ranges::binary_search(rim, corner.apex, lexLess); });
  return InputCorners(std::move(lasting));
}

}  // namespace

RimShortfall rimShortfall(const RemeshPatch& patch, const TriMesh& mesh, const RefineOptions& options) {
  const Pslg& pslg = patch.domain.pslg;
  std::vector<std::uint8_t> on_rim(mesh.points.size(), 0);
  for (const SegmentId s : patch.shared) on_rim[pslg.segments[s].a] = on_rim[pslg.segments[s].b] = 1;
  std::vector<Point> rim;
  for (VertexId v = 0; v < pslg.points.size(); ++v)
    if (on_rim[v] != 0) rim.push_back(pslg.points[v]);
  std::ranges::sort(rim, lexLess);

  struct Miss {
    TriId triangle;
    double by_deg;
  };
  std::vector<Miss> misses;
  const Surface surface = patch.domain.projection.surface();
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t].v;
    const auto [low, high] =
        std::ranges::minmax(surfaceAnglesDeg(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], surface));
    const double by_deg = std::max(options.min_angle_deg - low, high - options.max_angle_deg);
    if (by_deg > kHairDeg) misses.push_back({t, by_deg});
  }
  RimShortfall found;
  if (misses.empty()) return found;
  const InputCorners lasting = lastingCorners(mesh, options, rim);
  for (const auto& [t, by_deg] : misses) {
    const auto& v = mesh.triangles[t].v;
    if (lasting.excuseOf(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]) != Excuse::None) continue;
    const std::size_t before = found.nodes.size();
    const auto addNodes = [&](TriId at) {
      for (const VertexId corner : mesh.triangles[at].v)
        if (on_rim[corner] != 0) found.nodes.push_back(patch.nodes[corner]);
    };
    addNodes(t);
    if (found.nodes.size() == before)
      for (const EdgeRef across : mesh.triangles[t].adj)
        if (across != kNone) addNodes(triOf(across));
    if (found.nodes.size() > before) found.squared_deg += by_deg * by_deg;
  }
  std::ranges::sort(found.nodes);
  const auto repeated = std::ranges::unique(found.nodes);
  found.nodes.erase(repeated.begin(), repeated.end());
  return found;
}

}  // namespace coastmesh
