#include "parallel/cut.hpp"

#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "core/flip.hpp"
#include "core/links.hpp"
#include "core/predicates.hpp"
#include "core/refine/check.hpp"

namespace coastmesh {

CutSubmesh cutOut(const MeshState& whole, const Partition& partition, PieceId piece, VertexNumbers& numbers) {
  numbers.resize(whole.mesh.points.size(), kNone);
  const std::span<const TriId> triangles = partition.of(piece);
  const auto slotOf = [&](TriId t) { return partition.piece_of[t] == piece ? partition.slot_of[t] : kNone; };
  const auto numberOf = [&](VertexId v) -> VertexId& { return numbers[v]; };
  Submesh sub = extractSubmesh(whole.mesh, whole.mesh.input_vertices, whole.notes, triangles, slotOf, numberOf);

  CutSubmesh cut;
  for (const EdgeRef e : sub.frozen) {
    if (whole.mesh.twin(e) == kNone) continue;  // frozen in the whole: no side to be joined
    const VertexId a = numbers[whole.mesh.origin(e)], b = numbers[whole.mesh.target(e)];
    cut.edges.push_back({a, b, std::min(e, whole.mesh.twin(e)), whole.mesh.segment(e)});
  }
  std::ranges::sort(cut.edges, {}, [](const CutEdge& e) { return std::pair(e.a, e.b); });
  cut.fixed.assign(sub.parent.begin(), sub.parent.begin() + sub.mesh.input_vertices);
  if (!whole.due_vertices.empty())
    for (const VertexId v : sub.parent) cut.state.due_vertices.push_back(whole.due_vertices[v]);
  if (!whole.due_triangles.empty())
    for (const TriId t : triangles) cut.state.due_triangles.push_back(whole.due_triangles[t]);
  for (const VertexId v : sub.parent) numbers[v] = kNone;
  cut.state.mesh = std::move(sub.mesh);
  cut.state.notes = std::move(sub.notes);
  return cut;
}

namespace {

// One side of a cut edge in the stitched mesh.
struct CutSide {
  EdgeRef name;
  EdgeRef edge;
  SegmentId seg;
};

// Where in the stitched mesh the pieces begin.
struct Layout {
  std::vector<VertexId> on_cuts;  // Steiner points on cuts: the whole's numbers, ascending
  std::vector<VertexId> vertex;   // one a piece, and the end
  std::vector<TriId> triangle;    // one a piece, and the end
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

// Writes one piece to its place; lists its sides of cut edges.
std::vector<CutSide> place(const CutSubmesh& cut, std::size_t p, const Layout& layout, MeshState& whole) {
  const TriMesh& mesh = cut.state.mesh;
  const VertexId input_vertices = whole.mesh.input_vertices;
  std::vector<VertexId> number(mesh.points.size());
  for (VertexId v = 0; v < mesh.input_vertices; ++v) {
    const auto at = std::ranges::lower_bound(layout.on_cuts, cut.fixed[v]) - layout.on_cuts.begin();
    number[v] = cut.fixed[v] < input_vertices ? cut.fixed[v] : input_vertices + static_cast<VertexId>(at);
  }
  for (VertexId v = mesh.input_vertices; v < mesh.points.size(); ++v)
    number[v] = layout.vertex[p] + v - mesh.input_vertices;
  for (VertexId v = mesh.input_vertices; v < mesh.points.size(); ++v) {
    whole.mesh.points[number[v]] = mesh.points[v];
    if (!whole.notes.spacing.empty()) whole.notes.spacing[number[v]] = cut.state.notes.spacing[v];
    if (!whole.due_vertices.empty()) whole.due_vertices[number[v]] = cut.state.due_vertices[v];
  }
  std::vector<CutSide> sides;
  sides.reserve(cut.edges.size());
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const TriId at = layout.triangle[p] + t;
    whole.mesh.triangles[at] = renumbered(
        mesh.triangle(t), [&](TriId n) { return layout.triangle[p] + n; }, [&](VertexId v) { return number[v]; });
    for (unsigned i = 0; i < 3; ++i) {
      if (mesh.triangle(t).seg[i] != kFrozen) continue;
      const std::pair ends(mesh.origin(edgeRef(t, i)), mesh.target(edgeRef(t, i)));
      const auto endsOf = [](const CutEdge& e) { return std::pair(e.a, e.b); };
      const auto edge = std::ranges::lower_bound(cut.edges, ends, {}, endsOf);
      // Else the whole has nothing beyond it: it stays frozen.
      if (edge != cut.edges.end() && endsOf(*edge) == ends) sides.push_back({edge->name, edgeRef(at, i), edge->seg});
    }
    if (!whole.due_triangles.empty()) whole.due_triangles[at] = cut.state.due_triangles[t];
  }
  return sides;
}

// Joins the two sides of every cut edge; returns the edges.
std::vector<EdgeRef> joinSides(const std::vector<std::vector<CutSide>>& sides_of, TriMesh& mesh, Recorder& recorder) {
  std::vector<CutSide> sides;
  for (const std::vector<CutSide>& some : sides_of) sides.insert(sides.end(), some.begin(), some.end());
  tbb::parallel_sort(sides.begin(), sides.end(), [](const CutSide& x, const CutSide& y) {
    return std::pair(x.name, x.edge) < std::pair(y.name, y.edge);
  });
  std::vector<EdgeRef> edges(sides.size() / 2);
  forEachByStretches(recorder.loop("stitch"), edges.size(), [&](std::size_t i) {
    const CutSide &one = sides[2 * i], &other = sides[2 * i + 1];
    link(mesh.triangles, one.edge, other.edge, one.seg);
    edges[i] = one.edge;
  });
  return edges;
}

}  // namespace

void stitch(std::vector<CutSubmesh>&& pieces, const MeshState& before, Recorder& recorder, MeshState& whole) {
  const VertexId input_vertices = before.mesh.input_vertices;
  const Layout layout = layOut(pieces, input_vertices);
  whole.mesh.input_vertices = input_vertices;
  const ItemLoop loop = recorder.loop("stitch");
  resizeAnew(loop, whole.mesh.points, layout.vertex.back());
  resizeAnew(loop, whole.mesh.triangles, layout.triangle.back());
  whole.notes.shell_unit = before.notes.shell_unit;
  whole.notes.small_angle = before.notes.small_angle;
  whole.notes.corners = before.notes.corners;
  resizeAnew(loop, whole.notes.spacing, before.notes.spacing.empty() ? 0 : layout.vertex.back());
  resizeAnew(loop, whole.due_vertices, before.due_vertices.empty() ? 0 : layout.vertex.back());
  resizeAnew(loop, whole.due_triangles, before.due_triangles.empty() ? 0 : layout.triangle.back());
  const auto keep = [&](VertexId from, VertexId to) {
    whole.mesh.points[to] = before.mesh.points[from];
    if (!whole.notes.spacing.empty()) whole.notes.spacing[to] = before.notes.spacing[from];
    if (!whole.due_vertices.empty()) whole.due_vertices[to] = before.due_vertices[from];
  };
  forEachByStretches(recorder.loop("stitch"), input_vertices + layout.on_cuts.size(), [&](std::size_t i) {
    const auto to = static_cast<VertexId>(i);
    keep(to < input_vertices ? to : layout.on_cuts[to - input_vertices], to);
  });

  std::vector<std::vector<CutSide>> sides(pieces.size());
  recorder.forEach("stitch", pieces.size(), {}, [&](std::size_t p) {
    sides[p] = place(pieces[p], p, layout, whole);
    pieces[p] = {};
  });
  std::vector<EdgeRef> edges = joinSides(sides, whole.mesh, recorder);
  std::erase_if(edges, [&](EdgeRef e) {
    if (whole.mesh.segment(e) != kNone) return true;
    const auto& v = whole.mesh.triangle(triOf(e)).v;
    return inCircle(whole.mesh.point(v[0]), whole.mesh.point(v[1]), whole.mesh.point(v[2]),
                    whole.mesh.point(whole.mesh.apex(whole.mesh.twin(e)))) <= 0;
  });
  for (const TriId t : restoreDelaunay(whole.mesh, std::move(edges)))
    if (!whole.due_triangles.empty()) whole.due_triangles[t] = 1;
  assert(checkMesh(whole.mesh, nullptr, {}).empty());
}

}  // namespace coastmesh
