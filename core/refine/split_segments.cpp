#include "core/refine/split_segments.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/refine/divide_segments.hpp"

namespace coastmesh {

namespace {

// An edge from a to b or back, kNone if there is none: of its two sides the first around a, counter-clockwise from
// `triangleOf(a)`, or from the boundary. Other triangles around a are not visited if that can be avoided.
EdgeRef findEdge(const EditMesh& mesh, VertexId a, VertexId b, std::vector<EdgeRef>& star) {
  const TriId home = mesh.triangleOf(a);
  for (TriId t = home;;) {
    const unsigned i = mesh.cornerOf(t, a);
    const auto& v = mesh.triangle(t).v;
    if (v[prev3(i)] == b) return edgeRef(t, next3(i));
    const EdgeRef before = edgeRef(t, prev3(i)), after = edgeRef(t, next3(i));
    if (v[next3(i)] == b && mesh.twin(before) == kNone) return before;
    if (v[next3(i)] == b || mesh.twin(after) == kNone) break;
    t = triOf(mesh.twin(after));
    if (t == home) return kNone;
  }
  mesh.star(a, star);
  for (const EdgeRef opposite : star) {
    if (mesh.origin(opposite) == b) return edgeRef(triOf(opposite), prev3(indexOf(opposite)));
    if (mesh.target(opposite) == b) return edgeRef(triOf(opposite), next3(indexOf(opposite)));
  }
  return kNone;
}

}  // namespace

bool wantsSplitSegments(const TriMesh& mesh, const RefineOptions& options) {
  const bool has_lattice = mesh.points.size() > mesh.input_vertices;
  return options.size != nullptr || (has_lattice && std::isfinite(options.size_max));
}

std::uint64_t splitSegments(TriMesh& mesh, const Pslg& pslg, VertexNotes& notes, const RefineOptions& options,
                            const ItemLoop& loop) {
  const std::vector<Subsegment> cuts = subsegmentsOf(mesh, pslg, loop);
  const VertexId before = static_cast<VertexId>(mesh.points.size());
  const std::uint64_t most = std::min<std::uint64_t>(options.max_vertices, kNone);
  constexpr std::size_t kWorthThreads = 1 << 15;
  EditMesh edit = before < kWorthThreads ? EditMesh(std::move(mesh)) : EditMesh(std::move(mesh), loop);
  const SegmentDivider divider(pslg, options);
  std::vector<TriId> touched;
  std::vector<EdgeRef> star;
  const auto apply = [&](const Subsegment& cut, const std::vector<Division>& divisions) {
    const Point a = edit.point(cut.a), b = edit.point(cut.b);
    VertexId from = cut.a;
    for (const auto& [on, size] : divisions) {
      if (edit.vertexCount() >= most) break;
      const EdgeRef edge = findEdge(edit, from, cut.b, star);
      if (edge == kNone) break;
      touched.clear();
      const VertexId v = edit.splitSegment(edge, on, touched);
      if (v == kNone) break;
      notes.spacing.resize(edit.vertexSlots());
      notes.spacing[v] = std::min({options.surface.chord(on, a) + notes.spacing[cut.a],
                                   options.surface.chord(on, b) + notes.spacing[cut.b], size});
      from = v;
    }
  };
  constexpr std::size_t kBatch = 4096;
  std::vector<Divided> batch(std::min(cuts.size(), kBatch));
  const auto divide = [&](const Subsegment& cut, std::uint64_t at_most) {
    return divider.divide(edit.point(cut.a), edit.point(cut.b), cut.seg, at_most);
  };
  for (std::size_t begin = 0; begin < cuts.size() && edit.vertexCount() < most; begin += kBatch) {
    const std::size_t count = std::min(kBatch, cuts.size() - begin);
    forStretches(
        loop, count,
        [&](std::size_t first, std::size_t last) {
          for (std::size_t i = first; i < last; ++i) batch[i] = divide(cuts[begin + i], kManyDivisions);
        },
        kSubsegmentsAtOnce);
    for (std::size_t i = 0; i < count && edit.vertexCount() < most; ++i) {
      if (!batch[i].is_whole) batch[i] = divide(cuts[begin + i], most - edit.vertexCount());
      apply(cuts[begin + i], batch[i].divisions);
    }
  }
  Renumbering by;
  mesh = edit.vertexCount() < kWorthThreads ? edit.release(by, false) : edit.releaseOn(loop, by);
  BulkList<double> spacing = unsetList<double>(mesh.points.size());  // every vertex comes from one before
  forEachByStretches(loop, by.vertex.size(), [&](std::size_t v) {
    if (by.vertex[v] != kNone) spacing[by.vertex[v]] = notes.spacing[v];
  });
  notes.spacing = std::move(spacing);
  return mesh.points.size() - before;
}

}  // namespace coastmesh
