#include "gis/merge/joined_meshes.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include "core/predicates.hpp"
#include "core/union_find.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/geometry/ring_area.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/grid/linked_grid.hpp"
#include "gis/merge/covered_triangles.hpp"
#include "gis/merge/enclosed_gaps.hpp"
#include "gis/merge/frame_sides.hpp"
#include "gis/merge/gap_faces.hpp"
#include "gis/merge/outline.hpp"
#include "gis/merge/same_nodes.hpp"
#include "gis/merge/tidy_gap.hpp"

namespace coastmesh {

namespace {

bool isTurned(const TriMesh& mesh, TriId t) {
  const auto& v = mesh.triangles[t].v;
  return orient2d(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]) <= 0;
}

// The loops of the grid's boundary around holes that are open all around, near the outline.
std::vector<std::vector<VertexId>> openHoles(const TriMesh& mesh, const EdgeKinds& kinds, const Outline& outline,
                                             const ItemLoop& loop) {
  std::vector<std::vector<VertexId>> holes = boundaryLoops(mesh, loop);
  std::erase_if(holes, [&](const std::vector<VertexId>& ring) {
    std::vector<Point> places;
    Box box;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (!kinds.isOpen(ring[i], ring[(i + 1) % ring.size()])) return true;
      places.push_back(mesh.points[ring[i]]);
      box.add(places.back());
    }
    return signedAreaOf(places) >= 0.0 || !box.meets(outline.box());
  });
  return holes;
}

std::vector<NodePair> lineEdges(const Grid& grid) {
  std::vector<NodePair> edges;
  for (const GridLine& line : grid.lines)
    for (const auto& [a, b] : edgesOf(line)) edges.push_back(edgeKey(a, b));
  std::ranges::sort(edges);
  return edges;
}

// Nodes of triangles that are kept and of others, or of the outline, in the whole's numbers.
std::vector<VertexId> changedNodes(const TriMesh& mesh, std::span<const std::uint32_t> same,
                                   std::span<const Cover> cover) {
  std::vector<std::uint8_t> of_kept(same.size(), 0), of_covered(same.size(), 0);
  for (TriId t = 0; t < cover.size(); ++t)
    for (const VertexId v : mesh.triangles[t].v) (cover[t] == Cover::Free ? of_kept : of_covered)[v] = 1;
  std::vector<VertexId> changed;
  for (VertexId v = 0; v < same.size(); ++v)
    if (of_kept[v] != 0 && (of_covered[v] != 0 || same[v] != kNone))
      changed.push_back(same[v] == kNone ? v : static_cast<VertexId>(same.size()) + same[v]);
  return changed;
}

class MeshJoiner {
 public:
  MeshJoiner(const Grid& grid, const Grid& inserted, const NestPlane* plane, const ItemLoop& loop)
      : grid_(grid),
        plane_(plane),
        loop_(loop),
        inserted_grid_(inserted),
        inserted_(linkGrid(inserted, loop).mesh),
        kinds_(grid),
        inserted_kinds_(inserted),
        outline_(inserted, inserted_, loop) {
    joined_.mesh = linkGrid(grid, loop).mesh;
    joined_.has_open = outline_.hasOpen();
    if (plane_ == nullptr) return;
    is_far_.resize(joined_.mesh.triangles.size());
    for (TriId t = 0; t < is_far_.size(); ++t)
      is_far_[t] = std::ranges::all_of(joined_.mesh.triangles[t].v,
                                       [&](VertexId v) { return plane_->isFar(joined_.mesh.points[v]); });
  }

  JoinedMeshes join() {
    requireTurns(inserted_, {}, "the mesh that is put in");
    requireTurns(joined_.mesh, is_far_, "the mesh");
    joinSides();
    moveSame();
    findCover();
    fillGaps();
    const Gap gap{joined_.first_inserted, joined_.first_gap, std::move(gap_.shore),
                  changedNodes(joined_.mesh, joined_.same, cover_), grid_.crs};
    joined_.taken.assign(joined_.whole.triangles.size(), 1);
    tidyGap(joined_.whole, gap, joined_.taken);
    const auto last_kept = joined_.taken.begin() + joined_.first_inserted;
    joined_.covered = cover_.size() - static_cast<std::size_t>(std::count(joined_.taken.begin(), last_kept, 1));
    leaveOutCutOff();
    countJoined();
    requireBoth();
    joined_.line_ends = std::move(gap_.line_ends);
    return std::move(joined_);
  }

 private:
  std::string placeText(const Point& place) const {
    const Point p = plane_ == nullptr ? place : plane_->inverse(place);
    return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ")";
  }

  // Throws InputError for a triangle in the outline's box that is not counter-clockwise. `name`: "the mesh".
  void requireTurns(const TriMesh& mesh, std::span<const std::uint8_t> is_far, const std::string& name) const {
    for (TriId t = 0; t < mesh.triangles.size(); ++t) {
      if (!isTurned(mesh, t) || (!is_far.empty() && is_far[t] != 0)) continue;
      Box own;
      for (const VertexId v : mesh.triangles[t].v) own.add(mesh.points[v]);
      if (!own.meets(outline_.box())) continue;
      throw InputError("triangle " + std::to_string(t + 1) + " of " + name + " at " +
                       placeText(mesh.points[mesh.triangles[t].v[0]]) +
                       " is clockwise or flat: coastmesh convert with --target turns clockwise ones");
    }
  }

  // Sides of the inserted mesh's frame across land, which is in the other one too, are as good as open.
  void joinSides() {
    const FrameSides sides = frameSides(grid_, joined_.mesh, is_far_, inserted_grid_, inserted_, outline_, loop_);
    outline_.join(sides.joined);
    for (const std::uint32_t e : sides.joined) sides_.push_back(edgeKey(outline_.edges()[e].a, outline_.edges()[e].b));
    std::ranges::sort(sides_);
    for (const std::uint32_t e : sides.closed) joined_.closed.push_back({outline_.edges()[e].a, outline_.edges()[e].b});
  }

  bool isSide(VertexId a, VertexId b) const { return std::ranges::binary_search(sides_, edgeKey(a, b)); }

  void moveSame() {
    joined_.same = sameNodes(grid_, outline_, loop_);
    for (std::uint32_t v = 0; v < joined_.same.size(); ++v)
      if (joined_.same[v] != kNone) joined_.mesh.points[v] = outline_.place(joined_.same[v]);
  }

  void findCover() {
    cover_ = coverOf(joined_.mesh, joined_.same, is_far_, outline_, loop_);
    for (TriId t = 0; t < cover_.size(); ++t)
      if (cover_[t] == Cover::Free && (is_far_.empty() || is_far_[t] == 0) && isTurned(joined_.mesh, t))
        cover_[t] = Cover::Met;  // by a node that moved
    for (const Quad& quad : quadsOf(grid_)) {
      Cover &first = cover_[quad.halves[0]], &second = cover_[quad.halves[1]];
      if (first == Cover::Free && second != Cover::Free) first = Cover::Met;
      if (second == Cover::Free && first != Cover::Free) second = Cover::Met;
    }
    if (std::ranges::find(cover_, Cover::Free) == cover_.end())
      throw InputError("the mesh that is put in covers all of the other one");
  }

  void fillGaps() {
    try {
      tryToFill();
    } catch (const BadPslg& error) {
      throw InputError("the meshes cannot be joined at " + placeText(error.defect.place) + ": " + error.what() +
                       "; check finds such places");
    }
  }

  void tryToFill() {
    gap_ = fillGap(joined_.mesh, joined_.same, cover_, openHoles(joined_.mesh, kinds_, outline_, loop_),
                   lineEdges(grid_), outline_, loop_);
    assemble();
    const auto enclosed = fillEnclosed(
        joined_.whole, [this](EdgeRef e) { return endKindOf(e); }, loop_);
    if (enclosed.empty()) return;
    gap_.triangles.insert(gap_.triangles.end(), enclosed.begin(), enclosed.end());
    assemble();
  }

  EndKind endKindOf(EdgeRef e) const {
    const TriId t = triOf(e);
    if (t >= joined_.first_gap) return EndKind::Shore;
    if (t < joined_.first_inserted) {
      const EdgeRef own = edgeRef(joined_.kept[t], indexOf(e));
      return kinds_.isOpen(joined_.mesh.origin(own), joined_.mesh.target(own)) ? EndKind::OpenOfOne : EndKind::Shore;
    }
    const EdgeRef own = e - edgeRef(joined_.first_inserted, 0);
    const VertexId a = inserted_.origin(own), b = inserted_.target(own);
    return inserted_kinds_.isOpen(a, b) || isSide(a, b) ? EndKind::OpenOfOther : EndKind::Shore;
  }

  void assemble() {
    const auto shift = static_cast<std::uint32_t>(joined_.mesh.points.size());
    BulkList<Point> points(joined_.mesh.points);
    points.insert(points.end(), inserted_.points.begin(), inserted_.points.end());
    std::vector<std::array<VertexId, 3>> corners;
    joined_.kept.clear();
    for (TriId t = 0; t < cover_.size(); ++t) {
      if (cover_[t] != Cover::Free) continue;
      joined_.kept.push_back(t);
      for (VertexId& v : corners.emplace_back(joined_.mesh.triangles[t].v))
        if (joined_.same[v] != kNone) v = shift + joined_.same[v];
    }
    joined_.first_inserted = static_cast<TriId>(corners.size());
    for (const Triangle& t : inserted_.triangles) corners.push_back({shift + t.v[0], shift + t.v[1], shift + t.v[2]});
    joined_.first_gap = static_cast<TriId>(corners.size());
    corners.insert(corners.end(), gap_.triangles.begin(), gap_.triangles.end());
    std::vector<EdgeConflict> conflicts;
    joined_.whole = linkTriangles(std::move(points), corners, conflicts, loop_);
    // Conflicts within either mesh are not of this.
    if (conflicts.empty()) return;
    std::vector<std::uint8_t> is_same(inserted_.points.size(), 0);
    for (const std::uint32_t node : joined_.same)
      if (node != kNone) is_same[node] = 1;
    const auto isOfBoth = [&](VertexId v) { return v >= shift && is_same[v - shift] != 0; };
    for (const EdgeConflict& edge : conflicts)
      if (isOfBoth(edge.a) && isOfBoth(edge.b))
        throw InputError("the meshes overlap beside the edge at " + placeText(joined_.whole.points[edge.a]) +
                         ", which both have");
  }

  // Leaves out waters of the grid that were connected with the rest only through covered triangles: neither with the
  // inserted mesh nor, by an open boundary of their own, with the sea.
  void leaveOutCutOff() {
    const TriMesh& whole = joined_.whole;
    std::vector<std::uint8_t>& taken = joined_.taken;
    UnionFind waters(taken.size());
    for (TriId t = 0; t < taken.size(); ++t)
      for (const EdgeRef across : whole.triangles[t].adj)
        if (taken[t] != 0 && across != kNone && taken[triOf(across)] != 0) waters.unite(t, triOf(across));
    std::vector<std::uint8_t> is_left(cover_.size(), 0);  // by triangle of the grid
    for (TriId i = 0; i < joined_.first_inserted; ++i) is_left[joined_.kept[i]] = taken[i];
    std::vector<std::uint8_t> is_cut(taken.size(), 0), stays(taken.size(), 0);  // by water
    for (TriId i = 0; i < joined_.first_inserted; ++i) {
      for (unsigned k = 0; k < 3; ++k) {
        const EdgeRef e = edgeRef(joined_.kept[i], k), across = joined_.mesh.twin(e);
        if (across != kNone && is_left[triOf(across)] == 0) is_cut[waters.find(i)] = 1;
        if (across == kNone && kinds_.isOpen(joined_.mesh.origin(e), joined_.mesh.target(e))) stays[waters.find(i)] = 1;
      }
    }
    for (TriId t = joined_.first_inserted; t < joined_.first_gap; ++t) stays[waters.find(t)] = 1;
    for (TriId t = 0; t < taken.size(); ++t) {
      const std::uint32_t water = waters.find(t);
      if (taken[t] == 0 || stays[water] != 0 || (is_cut[water] == 0 && t < joined_.first_inserted)) continue;
      taken[t] = 0;
      if (t < joined_.first_inserted) ++joined_.cut_off;
    }
  }

  void countJoined() {
    for (TriId t = 0; t < inserted_.triangles.size(); ++t) {
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef own = edgeRef(t, i);
        if (inserted_.twin(own) != kNone) continue;
        const EdgeRef across = joined_.whole.twin(edgeRef(joined_.first_inserted + t, i));
        if (across == kNone || !joined_.isTaken(triOf(across))) continue;
        ++joined_.joined;
        if (isSide(inserted_.origin(own), inserted_.target(own))) ++joined_.joined_land;
      }
    }
  }

  void requireBoth() const {
    if (joined_.joined == 0)
      throw InputError(joined_.has_open
                           ? "no open boundary of the mesh that is put in has water of the other one beside it"
                           : "the mesh that is put in has no water of the other one beside it");
    if (std::find(joined_.taken.begin(), joined_.taken.begin() + joined_.first_inserted, 1) ==
        joined_.taken.begin() + joined_.first_inserted)
      throw InputError("the mesh that is put in covers all of the other one's water that is connected with it");
  }

  const Grid& grid_;
  const NestPlane* const plane_;
  const ItemLoop& loop_;
  const Grid& inserted_grid_;
  const TriMesh inserted_;
  const EdgeKinds kinds_, inserted_kinds_;
  Outline outline_;
  std::vector<NodePair> sides_;  // edges of its land boundaries that join, sorted
  JoinedMeshes joined_;
  std::vector<std::uint8_t> is_far_;  // for each triangle of the grid: on the other side of the Earth
  std::vector<Cover> cover_;
  GapFaces gap_;
};

}  // namespace

JoinedMeshes joinMeshes(const Grid& grid, const Grid& inserted, const NestPlane* plane, const ItemLoop& loop) {
  if (plane == nullptr) return MeshJoiner(grid, inserted, nullptr, loop).join();
  const Grid flat = plane->flat(grid, loop), flat_inserted = plane->flat(inserted, loop);
  return MeshJoiner(flat, flat_inserted, plane, loop).join();
}

}  // namespace coastmesh
