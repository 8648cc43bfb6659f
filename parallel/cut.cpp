#include "parallel/cut.hpp"

#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/flip.hpp"
#include "core/predicates.hpp"

namespace coastmesh {

CutPiece cutOut(const Sheet& sheet, const Partition& partition, PieceId piece, VertexMarks& marks) {
  marks.resize(sheet.mesh.points.size(), kNone);
  const std::span<const TriId> triangles = partition.of(piece);
  CutPiece cut;
  std::vector<VertexId> own;  // the sheet's number of a local vertex
  const auto number = [&](VertexId v) {
    if (marks[v] != kNone) return;
    marks[v] = static_cast<VertexId>(own.size());
    own.push_back(v);
  };
  // Vertices that must not change come first.
  for (const TriId t : triangles) {
    const Triangle& tri = sheet.mesh.triangle(t);
    for (unsigned i = 0; i < 3; ++i) {
      if (tri.v[i] < sheet.mesh.input_vertices) number(tri.v[i]);
      if (tri.adj[i] == kNone || partition.piece_of[triOf(tri.adj[i])] == piece) continue;
      const VertexId a = tri.v[next3(i)], b = tri.v[prev3(i)];
      number(a);
      number(b);
      cut.edges.push_back({marks[a], marks[b], std::min(edgeRef(t, i), tri.adj[i]), tri.seg[i]});
    }
  }
  std::ranges::sort(cut.edges, {}, [](const CutEdge& e) { return std::pair(e.a, e.b); });
  cut.fixed = own;
  for (const TriId t : triangles)
    for (const VertexId v : sheet.mesh.triangle(t).v) number(v);

  TriMesh& mesh = cut.piece.mesh;
  VertexNotes& notes = cut.piece.notes;
  mesh.input_vertices = static_cast<VertexId>(cut.fixed.size());
  mesh.points.reserve(own.size());
  for (const VertexId v : own) mesh.points.push_back(sheet.mesh.point(v));
  notes.corners = sheet.notes.corners;
  if (!sheet.notes.spacing.empty()) {
    notes.spacing.reserve(own.size());
    for (const VertexId v : own) notes.spacing.push_back(sheet.notes.spacing[v]);
  }
  for (const VertexId v : cut.fixed) {
    const bool input = v < sheet.mesh.input_vertices;
    notes.shell_unit.push_back(input ? sheet.notes.shell_unit[v] : 0.0);
    notes.small_angle.push_back(input && sheet.notes.small_angle[v]);
  }
  if (!sheet.due_vertices.empty())
    for (const VertexId v : own) cut.piece.due_vertices.push_back(sheet.due_vertices[v]);
  mesh.triangles.reserve(triangles.size());
  for (const TriId t : triangles) {
    const Triangle& from = sheet.mesh.triangle(t);
    Triangle& to = mesh.triangles.emplace_back();
    for (unsigned i = 0; i < 3; ++i) {
      to.v[i] = marks[from.v[i]];
      to.seg[i] = from.seg[i];
      if (from.adj[i] == kNone) continue;
      const TriId beyond = triOf(from.adj[i]);
      if (partition.piece_of[beyond] == piece) {
        to.adj[i] = edgeRef(partition.slot_of[beyond], indexOf(from.adj[i]));
      } else {
        to.seg[i] = kFrozen;
      }
    }
    if (!sheet.due_triangles.empty()) cut.piece.due_triangles.push_back(sheet.due_triangles[t]);
  }
  for (const VertexId v : own) marks[v] = kNone;
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
  std::vector<VertexId> on_cuts;  // Steiner points on cuts: the sheet's numbers, ascending
  std::vector<VertexId> vertex;   // one a piece, and the end
  std::vector<TriId> triangle;    // one a piece, and the end
};

Layout layOut(const std::vector<CutPiece>& pieces, VertexId input_vertices) {
  Layout layout;
  for (const CutPiece& cut : pieces)
    std::ranges::copy_if(cut.fixed, std::back_inserter(layout.on_cuts),
                         [&](VertexId v) { return v >= input_vertices; });
  tbb::parallel_sort(layout.on_cuts.begin(), layout.on_cuts.end());
  layout.on_cuts.erase(std::unique(layout.on_cuts.begin(), layout.on_cuts.end()), layout.on_cuts.end());
  layout.vertex.push_back(input_vertices + static_cast<VertexId>(layout.on_cuts.size()));
  layout.triangle.push_back(0);
  for (const CutPiece& cut : pieces) {
    const TriMesh& mesh = cut.piece.mesh;
    layout.vertex.push_back(layout.vertex.back() + static_cast<VertexId>(mesh.points.size()) - mesh.input_vertices);
    layout.triangle.push_back(layout.triangle.back() + static_cast<TriId>(mesh.triangles.size()));
  }
  return layout;
}

// Writes one piece to its place; lists its sides of cut edges.
std::vector<CutSide> place(const CutPiece& cut, std::size_t p, const Layout& layout, Sheet& sheet) {
  const TriMesh& mesh = cut.piece.mesh;
  const VertexId input_vertices = sheet.mesh.input_vertices;
  std::vector<VertexId> number(mesh.points.size());
  for (VertexId v = 0; v < mesh.input_vertices; ++v) {
    const auto at = std::ranges::lower_bound(layout.on_cuts, cut.fixed[v]) - layout.on_cuts.begin();
    number[v] = cut.fixed[v] < input_vertices ? cut.fixed[v] : input_vertices + static_cast<VertexId>(at);
  }
  for (VertexId v = mesh.input_vertices; v < mesh.points.size(); ++v)
    number[v] = layout.vertex[p] + v - mesh.input_vertices;
  for (VertexId v = mesh.input_vertices; v < mesh.points.size(); ++v) {
    sheet.mesh.points[number[v]] = mesh.points[v];
    if (!sheet.notes.spacing.empty()) sheet.notes.spacing[number[v]] = cut.piece.notes.spacing[v];
    if (!sheet.due_vertices.empty()) sheet.due_vertices[number[v]] = cut.piece.due_vertices[v];
  }
  std::vector<CutSide> sides;
  sides.reserve(cut.edges.size());
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const TriId at = layout.triangle[p] + t;
    Triangle& to = sheet.mesh.triangles[at];
    to = mesh.triangles[t];
    for (unsigned i = 0; i < 3; ++i) {
      if (to.adj[i] != kNone) to.adj[i] += 4 * layout.triangle[p];
      if (to.seg[i] != kFrozen) continue;
      const std::pair ends(mesh.origin(edgeRef(t, i)), mesh.target(edgeRef(t, i)));
      const CutEdge& edge =
          *std::ranges::lower_bound(cut.edges, ends, {}, [](const CutEdge& e) { return std::pair(e.a, e.b); });
      sides.push_back({edge.name, edgeRef(at, i), edge.seg});
    }
    for (VertexId& v : to.v) v = number[v];
    if (!sheet.due_triangles.empty()) sheet.due_triangles[at] = cut.piece.due_triangles[t];
  }
  return sides;
}

// Joins the two sides of every cut edge; answers the edges.
std::vector<EdgeRef> joinSides(const std::vector<std::vector<CutSide>>& sides_of, TriMesh& mesh, Recorder& recorder) {
  std::vector<CutSide> sides;
  for (const std::vector<CutSide>& some : sides_of) sides.insert(sides.end(), some.begin(), some.end());
  tbb::parallel_sort(sides.begin(), sides.end(), [](const CutSide& x, const CutSide& y) {
    return std::pair(x.name, x.edge) < std::pair(y.name, y.edge);
  });
  std::vector<EdgeRef> edges(sides.size() / 2);
  forEachByStretches(recorder.loop("stitch"), edges.size(), [&](std::size_t i) {
    const CutSide &one = sides[2 * i], &other = sides[2 * i + 1];
    for (const auto& [from, to] : {std::pair(one, other), std::pair(other, one)}) {
      mesh.triangles[triOf(from.edge)].adj[indexOf(from.edge)] = to.edge;
      mesh.triangles[triOf(from.edge)].seg[indexOf(from.edge)] = from.seg;
    }
    edges[i] = one.edge;
  });
  return edges;
}

}  // namespace

Sheet stitch(std::vector<CutPiece>&& pieces, const Sheet& before, Recorder& recorder, Sheet&& reused) {
  const VertexId input_vertices = before.mesh.input_vertices;
  const Layout layout = layOut(pieces, input_vertices);
  Sheet sheet = std::move(reused);
  sheet.mesh.input_vertices = input_vertices;
  const ItemLoop loop = recorder.loop("stitch");
  resizeAnew(loop, sheet.mesh.points, layout.vertex.back());
  resizeAnew(loop, sheet.mesh.triangles, layout.triangle.back());
  sheet.notes.shell_unit = before.notes.shell_unit;
  sheet.notes.small_angle = before.notes.small_angle;
  sheet.notes.corners = before.notes.corners;
  resizeAnew(loop, sheet.notes.spacing, before.notes.spacing.empty() ? 0 : layout.vertex.back());
  resizeAnew(loop, sheet.due_vertices, before.due_vertices.empty() ? 0 : layout.vertex.back());
  resizeAnew(loop, sheet.due_triangles, before.due_triangles.empty() ? 0 : layout.triangle.back());
  const auto keep = [&](VertexId from, VertexId to) {
    sheet.mesh.points[to] = before.mesh.points[from];
    if (!sheet.notes.spacing.empty()) sheet.notes.spacing[to] = before.notes.spacing[from];
    if (!sheet.due_vertices.empty()) sheet.due_vertices[to] = before.due_vertices[from];
  };
  forEachByStretches(recorder.loop("stitch"), input_vertices + layout.on_cuts.size(), [&](std::size_t i) {
    const auto to = static_cast<VertexId>(i);
    keep(to < input_vertices ? to : layout.on_cuts[to - input_vertices], to);
  });

  std::vector<std::vector<CutSide>> sides(pieces.size());
  recorder.forEach("stitch", pieces.size(), {}, [&](std::size_t p) {
    sides[p] = place(pieces[p], p, layout, sheet);
    pieces[p] = {};
  });
  std::vector<EdgeRef> edges = joinSides(sides, sheet.mesh, recorder);
  std::erase_if(edges, [&](EdgeRef e) {
    if (sheet.mesh.segment(e) != kNone) return true;
    const auto& v = sheet.mesh.triangle(triOf(e)).v;
    return inCircle(sheet.mesh.point(v[0]), sheet.mesh.point(v[1]), sheet.mesh.point(v[2]),
                    sheet.mesh.point(sheet.mesh.apex(sheet.mesh.twin(e)))) <= 0;
  });
  for (const TriId t : restoreDelaunay(sheet.mesh, std::move(edges)))
    if (!sheet.due_triangles.empty()) sheet.due_triangles[t] = 1;
  return sheet;
}

}  // namespace coastmesh
