#include "parallel/stitch.hpp"

#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <cassert>
#include <span>
#include <utility>

#include "core/bulk_list.hpp"
#include "core/flip.hpp"
#include "core/links.hpp"
#include "core/predicates.hpp"
#include "core/refine/check.hpp"
#include "core/refine/fill_holes.hpp"

namespace coastmesh {

namespace {

// One side of a cut edge in the stitched mesh.
struct CutSide {
  EdgeRef name;
  EdgeRef edge;
  EdgeRef beyond;  // the other side, if that is in no piece
  SegmentId seg;
};

// Where each piece begins in the stitched mesh.
struct Layout {
  std::vector<VertexId> on_cuts;  // Steiner points on cuts: the whole's numbers, ascending
  std::vector<VertexId> vertex;   // of each piece, and the end
  std::vector<TriId> triangle;    // of each piece, and the end
};

Layout layOut(const std::vector<CutSubmesh>& pieces, VertexId input_vertices) {
  Layout layout;
  for (const CutSubmesh& cut : pieces)
    std::ranges::copy_if(cut.fixed, std::back_inserter(layout.on_cuts),
                         [&](VertexId v) { return v >= input_vertices; });
  tbb::parallel_sort(layout.on_cuts.begin(), layout.on_cuts.end());
  layout.on_cuts.erase(std::unique(layout.on_cuts.begin(), layout.on_cuts.end()), layout.on_cuts.end());
  layout.vertex.push_back(input_vertices + static_cast<VertexId>(layout.on_cuts.size()));
  layout.triangle.push_back(0);
  for (const CutSubmesh& cut : pieces) {
    const TriMesh& mesh = cut.state.mesh;
    layout.vertex.push_back(layout.vertex.back() + static_cast<VertexId>(mesh.points.size()) - mesh.input_vertices);
    layout.triangle.push_back(layout.triangle.back() + static_cast<TriId>(mesh.triangles.size()));
  }
  return layout;
}

// Writes a piece to its place; returns its sides of cut edges. `vertex` has the new number of each vertex,
// `triangle(t)` returns that of a triangle. Fixed vertices keep the values of the whole mesh.
template <typename TriangleNumber>
std::vector<CutSide> place(const CutSubmesh& cut, std::span<const VertexId> vertex, const TriangleNumber& triangle,
                           MeshState& whole) {
  const TriMesh& mesh = cut.state.mesh;
  for (VertexId v = mesh.input_vertices; v < mesh.points.size(); ++v) {
    whole.mesh.points[vertex[v]] = mesh.points[v];
    if (!whole.notes.spacing.empty()) whole.notes.spacing[vertex[v]] = cut.state.notes.spacing[v];
    if (!whole.due_vertices.empty()) whole.due_vertices[vertex[v]] = cut.state.due_vertices[v];
  }
  std::vector<CutSide> sides;
  sides.reserve(cut.edges.size());
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const TriId at = triangle(t);
    whole.mesh.triangles[at] = renumbered(mesh.triangle(t), triangle, [&](VertexId v) { return vertex[v]; });
    for (unsigned i = 0; i < 3; ++i) {
      if (mesh.triangle(t).seg[i] != kFrozen) continue;
      const std::pair ends(mesh.origin(edgeRef(t, i)), mesh.target(edgeRef(t, i)));
      const auto endsOf = [](const CutEdge& e) { return std::pair(e.a, e.b); };
      const auto edge = std::ranges::lower_bound(cut.edges, ends, {}, endsOf);
      // Otherwise the whole mesh has nothing beyond it: it stays frozen.
      if (edge != cut.edges.end() && endsOf(*edge) == ends)
        sides.push_back({edge->name, edgeRef(at, i), edge->beyond, edge->seg});
    }
    if (!whole.due_triangles.empty()) whole.due_triangles[at] = cut.state.due_triangles[t];
  }
  return sides;
}

// Joins the two sides of every cut edge; returns the edges.
std::vector<EdgeRef> joinSides(const std::vector<std::vector<CutSide>>& sides_of, TriMesh& mesh, Recorder& recorder) {
  std::vector<CutSide> sides;
  std::vector<EdgeRef> edges;
  for (const std::vector<CutSide>& some : sides_of) {
    for (const CutSide& side : some) {
      if (side.beyond == kNone) {
        sides.push_back(side);
      } else {
        link(mesh.triangles, side.edge, side.beyond, side.seg);
        edges.push_back(side.edge);
      }
    }
  }
  tbb::parallel_sort(sides.begin(), sides.end(), [](const CutSide& x, const CutSide& y) {
    return std::pair(x.name, x.edge) < std::pair(y.name, y.edge);
  });
  const std::size_t others = edges.size();
  edges.resize(others + sides.size() / 2);
  forEachByStretches(recorder.loop("stitch"), sides.size() / 2, [&](std::size_t i) {
    const CutSide &one = sides[2 * i], &other = sides[2 * i + 1];
    link(mesh.triangles, one.edge, other.edge, one.seg);
    edges[others + i] = one.edge;
  });
  return edges;
}

// Restores the Delaunay property by flips, starting from these edges.
void restoreAcross(std::span<const EdgeRef> edges, MeshState& whole, const ItemLoop& loop) {
  const auto isToFlip = [&](EdgeRef e) {
    if (whole.mesh.segment(e) != kNone) return false;
    const auto& v = whole.mesh.triangle(triOf(e)).v;
    return inCircle(whole.mesh.point(v[0]), whole.mesh.point(v[1]), whole.mesh.point(v[2]),
                    whole.mesh.point(whole.mesh.apex(whole.mesh.twin(e)))) > 0;
  };
  constexpr std::size_t kEdgesAtOnce = 1024;
  std::vector<EdgeRef> waiting = joined(overStretches(
      loop, edges.size(),
      [&](std::size_t first, std::size_t last) {
        std::vector<EdgeRef> some;
        std::copy_if(edges.begin() + first, edges.begin() + last, std::back_inserter(some), isToFlip);
        return some;
      },
      kEdgesAtOnce));
  for (const TriId t : restoreDelaunay(whole.mesh, std::move(waiting)))
    if (!whole.due_triangles.empty()) whole.due_triangles[t] = 1;
}

// Exchanges numbers, of vertices or of triangles, between the pieces of a partition: pieces that shrank free some,
// pieces that grew take them, then new ones.
class Exchange {
 public:
  // `old(p)`: the numbers that piece p had; `count(p)`: how many it has now. All numbers are below `end`.
  template <typename Old, typename Count>
  Exchange(std::size_t pieces, std::uint32_t end, const Old& old, const Count& count) : end_(end) {
    std::size_t further = 0;
    for (std::size_t p = 0; p < pieces; ++p) {
      const std::span<const std::uint32_t> had = old(p);
      const std::size_t has = count(p);
      further_.push_back(further);
      if (has > had.size()) {
        further += has - had.size();
      } else {
        free_.insert(free_.end(), had.begin() + static_cast<std::ptrdiff_t>(has), had.end());
      }
    }
    taken_ = std::min(further, free_.size());
    last_ = end + static_cast<std::uint32_t>(further - taken_);
  }

  std::uint32_t end() const { return last_; }  // one past the largest number
  // The number of item i of piece p, which had the numbers `had`.
  std::uint32_t operator()(std::size_t p, std::span<const std::uint32_t> had, std::size_t i) const {
    if (i < had.size()) return had[i];
    const std::size_t place = further_[p] + i - had.size();
    return place < taken_ ? free_[place] : end_ + static_cast<std::uint32_t>(place - taken_);
  }
  // Unused numbers, ascending.
  std::vector<std::uint32_t> holes() const {
    std::vector<std::uint32_t> left(free_.begin() + static_cast<std::ptrdiff_t>(taken_), free_.end());
    std::ranges::sort(left);
    return left;
  }

 private:
  std::uint32_t end_, last_ = 0;
  std::vector<std::size_t> further_;  // for each piece: how many the previous pieces need in addition to their own
  std::vector<std::uint32_t> free_;
  std::size_t taken_ = 0;
};

// Resizes to `count` items, with some spare room: the first `kept` are preserved, all others will be overwritten.
template <typename Item>
void resizeBehind(const ItemLoop& loop, std::vector<Item>& items, std::size_t kept, std::size_t count) {
  if (count > items.capacity()) {
    items.resize(kept);
    growOn(loop, items, count, count / 8);
  }
  items.resize(count);
}

template <typename Item>
void resizeBehind(const ItemLoop& loop, BulkList<Item>& items, std::size_t kept, std::size_t count) {
  if (count > items.capacity()) {
    items.resize(kept);
    growOn(loop, items, count, count / 8);
  }
  resizeUnset(items, count);
}

// The same, preserving all items; does nothing for an unused list.
template <typename Item, typename Allocator>
void growWhereKept(const ItemLoop& loop, std::vector<Item, Allocator>& items, std::size_t count) {
  if (!items.empty()) resizeBehind(loop, items, items.size(), count);
}

template <typename Items>
void shrinkWhereKept(Items& items, std::size_t count) {
  if (!items.empty()) items.resize(count);
}

void closeHoles(std::span<const TriId> triangles, std::span<const VertexId> vertices, MeshState& whole,
                Recorder& recorder) {
  TriMesh& mesh = whole.mesh;
  mesh.triangles.resize(fillHoles(triangles, mesh.triangles.size(), [&](TriId from, TriId to) {
    const Triangle moved = mesh.triangles[from];
    mesh.triangles[to] = unlinked(moved.v);
    for (unsigned i = 0; i < 3; ++i) link(mesh.triangles, edgeRef(to, i), moved.adj[i], moved.seg[i]);
    if (!whole.due_triangles.empty()) whole.due_triangles[to] = whole.due_triangles[from];
  }));
  shrinkWhereKept(whole.due_triangles, mesh.triangles.size());
  if (vertices.empty()) return;
  const auto left = static_cast<VertexId>(mesh.points.size() - vertices.size());
  std::vector<VertexId> number(vertices.size(), kNone);  // of those from `left` on
  fillHoles(vertices, mesh.points.size(), [&](VertexId from, VertexId to) {
    number[from - left] = to;
    mesh.points[to] = mesh.points[from];
    if (!whole.notes.spacing.empty()) whole.notes.spacing[to] = whole.notes.spacing[from];
    if (!whole.due_vertices.empty()) whole.due_vertices[to] = whole.due_vertices[from];
  });
  forEachByStretches(recorder.loop("stitch"), mesh.triangles.size(), [&](std::size_t t) {
    for (VertexId& v : mesh.triangles[t].v)
      if (v >= left) v = number[v - left];
  });
  mesh.points.resize(left);
  shrinkWhereKept(whole.notes.spacing, left);
  shrinkWhereKept(whole.due_vertices, left);
}

}  // namespace

void stitch(std::vector<CutSubmesh>&& pieces, Recorder& recorder, MeshState& whole) {
  const VertexId input_vertices = whole.mesh.input_vertices;
  const Layout layout = layOut(pieces, input_vertices);
  const std::size_t vertices = layout.vertex.back(), triangles = layout.triangle.back();
  const std::size_t kept = layout.vertex.front();
  // Ascending, so that none is overwritten before it has moved.
  for (std::size_t to = input_vertices; to < kept; ++to) {
    const VertexId from = layout.on_cuts[to - input_vertices];
    whole.mesh.points[to] = whole.mesh.points[from];
    if (!whole.notes.spacing.empty()) whole.notes.spacing[to] = whole.notes.spacing[from];
    if (!whole.due_vertices.empty()) whole.due_vertices[to] = whole.due_vertices[from];
  }
  const ItemLoop loop = recorder.loop("stitch");
  resizeBehind(loop, whole.mesh.points, kept, vertices);
  if (!whole.notes.spacing.empty()) resizeBehind(loop, whole.notes.spacing, kept, vertices);
  if (!whole.due_vertices.empty()) resizeBehind(loop, whole.due_vertices, kept, vertices);
  resizeAnew(loop, whole.mesh.triangles, triangles);
  if (!whole.due_triangles.empty()) resizeAnew(loop, whole.due_triangles, triangles);

  std::vector<std::vector<CutSide>> sides(pieces.size());
  recorder.forEach("stitch", pieces.size(), {}, [&](std::size_t p) {
    const TriMesh& mesh = pieces[p].state.mesh;
    std::vector<VertexId> vertex(mesh.points.size());
    for (VertexId v = 0; v < mesh.input_vertices; ++v) {
      const VertexId old = pieces[p].fixed[v];
      const auto at = std::ranges::lower_bound(layout.on_cuts, old) - layout.on_cuts.begin();
      vertex[v] = old < input_vertices ? old : input_vertices + static_cast<VertexId>(at);
    }
    for (VertexId v = mesh.input_vertices; v < mesh.points.size(); ++v)
      vertex[v] = layout.vertex[p] + v - mesh.input_vertices;
    sides[p] = place(
        pieces[p], vertex, [&](TriId t) { return layout.triangle[p] + t; }, whole);
    pieces[p] = {};
  });
  restoreAcross(joinSides(sides, whole.mesh, recorder), whole, loop);
  assert(checkMesh(whole.mesh, nullptr, {}).empty());
}

void stitchInPlace(std::vector<CutSubmesh>&& pieces, const Partition& parts, Recorder& recorder, MeshState& whole) {
  TriMesh& mesh = whole.mesh;
  const auto meshOf = [&](std::size_t p) -> const TriMesh& { return pieces[p].state.mesh; };
  const auto oldTriangles = [&](std::size_t p) { return parts.of(static_cast<PieceId>(p)); };
  const auto oldVertices = [&](std::size_t p) { return std::span<const VertexId>(pieces[p].own); };
  const Exchange triangles(pieces.size(), static_cast<TriId>(mesh.triangles.size()), oldTriangles,
                           [&](std::size_t p) { return meshOf(p).triangles.size(); });
  const Exchange vertices(pieces.size(), static_cast<VertexId>(mesh.points.size()), oldVertices,
                          [&](std::size_t p) { return meshOf(p).points.size() - meshOf(p).input_vertices; });
  const ItemLoop loop = recorder.loop("stitch");
  growWhereKept(loop, mesh.triangles, triangles.end());
  growWhereKept(loop, mesh.points, vertices.end());
  growWhereKept(loop, whole.due_triangles, triangles.end());
  growWhereKept(loop, whole.due_vertices, vertices.end());
  growWhereKept(loop, whole.notes.spacing, vertices.end());

  std::vector<std::vector<CutSide>> sides(pieces.size());
  recorder.forEach("stitch", pieces.size(), {}, [&](std::size_t p) {
    std::vector<VertexId> vertex = std::move(pieces[p].fixed);
    for (std::size_t i = 0; vertex.size() < meshOf(p).points.size(); ++i)
      vertex.push_back(vertices(p, oldVertices(p), i));
    sides[p] = place(
        pieces[p], vertex, [&](TriId t) { return triangles(p, oldTriangles(p), t); }, whole);
    pieces[p] = {};
  });
  restoreAcross(joinSides(sides, mesh, recorder), whole, loop);
  closeHoles(triangles.holes(), vertices.holes(), whole, recorder);
  assert(checkMesh(mesh, nullptr, {}).empty());
}

}  // namespace coastmesh
