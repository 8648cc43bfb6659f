#include "gis/check/check_segments.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/bulk_list.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/loop_role.hpp"

namespace coastmesh {
namespace {

// An edge of a segment, and its place among the mesh's boundary edges, kNone if it is none of them.
struct SegmentEdge {
  NodePair nodes;
  std::uint32_t place = kNone;
  bool is_against = false;
};
// What takes long to find out about a segment.
struct SegmentSearch {
  std::vector<SegmentEdge> edges, back;  // along its nodes; those across, and from these to those at a weir's ends
  BoundaryRole by_shape = BoundaryRole::Land;
};

bool isLoop(const Boundary& boundary) { return boundary.closed && boundary.nodes.size() >= 3; }

class SegmentCheck {
 public:
  SegmentCheck(const Grid& grid, const TriMesh& mesh, std::span<const EdgeRef> boundary_edges,
               std::optional<Target> target, const ItemLoop& loop)
      : grid_(grid), target_(target), loop_(loop) {
    of_mesh_.resize(boundary_edges.size());
    forEachByStretches(loop_, of_mesh_.size(), [&](std::size_t e) {
      of_mesh_[e] = {mesh.origin(boundary_edges[e]), mesh.target(boundary_edges[e])};
    });
    sortOn(loop_, of_mesh_);
  }

  std::vector<TargetDefect> run() {
    std::vector<int> uses(of_mesh_.size(), 0);
    const std::vector<SegmentSearch> searches = searchSegments();
    for (std::size_t b = 0; b < grid_.boundaries.size(); ++b) {
      const Boundary& boundary = grid_.boundaries[b];
      std::size_t turned = 0;
      for (const SegmentEdge& edge : searches[b].edges) {
        if (edge.place == kNone) {
          add(TargetDefectKind::StrayBoundary, edge.nodes);
          continue;
        }
        if (edge.is_against) ++turned;
        if (++uses[edge.place] == 2) add(TargetDefectKind::BoundaryTwice, edge.nodes);
      }
      for (const SegmentEdge& edge : searches[b].back)
        if (edge.place != kNone) ++uses[edge.place];
      if (boundary.nodes.empty()) continue;
      if (boundary.nodes.size() == 1) add(TargetDefectKind::StrayBoundary, boundary.nodes.front());
      if (target_) checkForModel(boundary, searches[b].by_shape, turned);
    }
    for (std::size_t i = 0; i < uses.size(); ++i)
      if (uses[i] == 0) add(TargetDefectKind::NoBoundary, of_mesh_[i]);
    return std::move(defects_);
  }

 private:
  void add(TargetDefectKind kind, std::uint32_t node, double value = 0.0) {
    defects_.push_back({kind, grid_.nodes[node], -1, node, value, {}});
  }
  void add(TargetDefectKind kind, const NodePair& edge) {
    const Point middle = meanPlace(grid_.crs, std::array{grid_.nodes[edge[0]], grid_.nodes[edge[1]]});
    defects_.push_back({kind, middle, -1, edge[0], 0.0, {}});
  }

  // `turned`: how many of its edges have the mesh to their right.
  void checkForModel(const Boundary& boundary, BoundaryRole by_shape, std::size_t turned) {
    const std::uint32_t first = boundary.nodes.front();
    if (turned > 0) add(TargetDefectKind::BoundaryTurned, first, static_cast<double>(turned));
    if (!isLoop(boundary)) return;
    const bool shore = !isOpening(boundary.role);
    if (shore && turned == 0 && boundary.role != by_shape) add(TargetDefectKind::WrongShore, first);
    // The models close islands themselves; SCHISM needs other loops as two linked segments.
    if (boundary.repeats_first && (target_ == Target::Schism || boundary.role == BoundaryRole::Island))
      add(TargetDefectKind::LoopedBoundary, first);
  }

  std::uint32_t placeOf(const NodePair& edge) const {
    const auto place = std::ranges::lower_bound(of_mesh_, edge);
    return place != of_mesh_.end() && *place == edge ? static_cast<std::uint32_t>(place - of_mesh_.begin()) : kNone;
  }

  std::vector<SegmentEdge> placesOf(const std::vector<NodePair>& edges) const {
    std::vector<SegmentEdge> found;
    found.reserve(edges.size());
    for (const NodePair& edge : edges) {
      const std::uint32_t along = placeOf(edge);
      const std::uint32_t place = along != kNone ? along : placeOf({edge[1], edge[0]});
      found.push_back({edge, place, along == kNone && place != kNone});
    }
    return found;
  }

  std::vector<SegmentSearch> searchSegments() const {
    constexpr std::size_t kWorthAStretch = 16;
    std::vector<SegmentSearch> searches(grid_.boundaries.size());
    const auto search = [&](std::size_t first, std::size_t last) {
      for (std::size_t b = first; b < last; ++b) {
        const Boundary& boundary = grid_.boundaries[b];
        searches[b].edges = placesOf(edgesOf(boundary));
        std::vector<NodePair> back = edgesOf(Boundary{boundary.role, boundary.closed, boundary.back_nodes});
        if (!boundary.back_nodes.empty() && !boundary.closed) {
          back.push_back({boundary.nodes.front(), boundary.back_nodes.front()});
          back.push_back({boundary.nodes.back(), boundary.back_nodes.back()});
        }
        searches[b].back = placesOf(back);
        if (isLoop(boundary)) searches[b].by_shape = roleOfLoop(grid_.nodes, boundary.nodes, grid_.crs);
      }
    };
    forStretches(loop_, searches.size(), search, kWorthAStretch);
    return searches;
  }

  const Grid& grid_;
  const std::optional<Target> target_;
  const ItemLoop& loop_;
  std::vector<NodePair> of_mesh_;  // boundary edges, ascending
  std::vector<TargetDefect> defects_;
};

}  // namespace

std::vector<EdgeRef> boundaryEdges(const TriMesh& mesh, const ItemLoop& loop) {
  return joined(overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
    std::vector<EdgeRef> found;
    for (std::size_t t = first; t < last; ++t)
      for (unsigned i = 0; i < 3; ++i)
        if (mesh.triangles[t].adj[i] == kNone) found.push_back(edgeRef(static_cast<TriId>(t), i));
    return found;
  }));
}

std::vector<TargetDefect> checkSegments(const Grid& grid, const TriMesh& mesh, std::span<const EdgeRef> boundary_edges,
                                        std::optional<Target> target, const ItemLoop& loop) {
  return SegmentCheck(grid, mesh, boundary_edges, target, loop).run();
}

}  // namespace coastmesh
