#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/refine/mend_triangles.hpp"

namespace coastmesh {

namespace {

// The longest strip to follow beyond such a triangle: a bound on the run, not a setting.
constexpr std::size_t kLongestStrip = 100000;

VertexId filledCornerOf(const RefineRun& run, TriId t) {
  if (!run.mesh.isLive(t)) return kNone;
  const Corners& v = run.mesh.triangle(t).v;
  const auto apex = std::ranges::find_if(v, [&](VertexId corner) { return fillsCorner(run, t, corner); });
  return apex == v.end() ? kNone : *apex;
}

void growCornerTriangle(RefineRun& run, TriId filler, VertexId apex, Beyond beyond) {
  EditMesh& mesh = run.mesh;
  // Every round removes a vertex.
  for (std::size_t left_of_strip = shortCornerStrip(run, filler).size(); left_of_strip > 1; --left_of_strip) {
    const unsigned i = mesh.cornerOf(filler, apex);
    const SegmentId right = mesh.segment(edgeRef(filler, prev3(i))), left = mesh.segment(edgeRef(filler, next3(i)));
    const VertexId a = mesh.triangle(filler).v[next3(i)], b = mesh.triangle(filler).v[prev3(i)];
    if (mesh.isConstrained(edgeRef(filler, i))) return;
    const EdgeRef base = mesh.twin(edgeRef(filler, i));
    const VertexId c = mesh.apex(base);
    const bool on_right = mesh.segment(edgeRef(triOf(base), next3(indexOf(base)))) == right;
    const bool on_left = mesh.segment(edgeRef(triOf(base), prev3(indexOf(base)))) == left;
    if (!on_right && !on_left) return;
    const VertexId goes = on_right ? a : b, stays = on_right ? b : a;
    if (mesh.kind(goes) != VertexKind::Segment) return;
    const Point &from = mesh.point(apex), &to = mesh.point(c);
    if (isTooLong(from, to, mesh.point(stays), run.bound.surface.squaredChord(from, to), run.bound)) return;
    const std::size_t known = run.touched.size();
    if (!(beyond == Beyond::StaysGood ? run.ops.removeInto({apex, c, stays}, goes, run.touched)
                                      : run.ops.removeAnyway(goes, run.touched)))
      return;
    ++run.stats.removals;
    const auto grown =
        std::find_if(run.touched.begin() + static_cast<std::ptrdiff_t>(known), run.touched.end(), [&](TriId t) {
          const Corners& v = mesh.triangle(t).v;
          const auto has = [&](VertexId corner) { return std::ranges::find(v, corner) != v.end(); };
          return mesh.isLive(t) && has(apex) && has(c) && has(stays);
        });
    if (grown == run.touched.end()) return;
    filler = *grown;
  }
}

void growAll(RefineRun& run, Beyond beyond) {
  for (TriId t = 0; t < run.mesh.triangleSlots(); ++t)
    if (const VertexId apex = filledCornerOf(run, t); apex != kNone) growCornerTriangle(run, t, apex, beyond);
}

}  // namespace

bool fillsCorner(const RefineRun& run, TriId t, VertexId apex) {
  const EditMesh& mesh = run.mesh;
  if (apex >= mesh.inputVertices() || !run.notes.small_angle[apex]) return false;
  const unsigned i = mesh.cornerOf(t, apex);
  if (!mesh.isConstrained(edgeRef(t, next3(i))) || !mesh.isConstrained(edgeRef(t, prev3(i)))) return false;
  const Triangle& tri = mesh.triangle(t);
  return !run.bound.canDivide(angleAt(mesh.point(apex), mesh.point(tri.v[next3(i)]), mesh.point(tri.v[prev3(i)])));
}

VertexId filledCornerBehind(const RefineRun& run, TriId t, unsigned apex) {
  const EditMesh& mesh = run.mesh;
  const EdgeRef shortest = edgeRef(t, apex);
  if (mesh.isConstrained(shortest)) return kNone;
  const EdgeRef beyond = mesh.twin(shortest);
  const VertexId v = mesh.apex(beyond);
  return fillsCorner(run, triOf(beyond), v) ? v : kNone;
}

std::vector<TriId> shortCornerStrip(const RefineRun& run, TriId t) {
  const EditMesh& mesh = run.mesh;
  const VertexId apex = filledCornerOf(run, t);
  if (apex == kNone) return {};
  const unsigned i = mesh.cornerOf(t, apex);
  const SegmentId right = mesh.segment(edgeRef(t, prev3(i))), left = mesh.segment(edgeRef(t, next3(i)));
  std::vector<TriId> strip{t};
  std::size_t up_to_last = 0;
  EdgeRef across = edgeRef(t, i);
  while (strip.size() < kLongestStrip && !mesh.isConstrained(across)) {
    // The next triangle's base is the edge shared with the previous one, from left to right.
    const EdgeRef base = mesh.twin(across);
    strip.push_back(triOf(base));
    if (violatesBound(run, triOf(base))) up_to_last = strip.size();
    const EdgeRef on_right = edgeRef(triOf(base), next3(indexOf(base)));
    const EdgeRef on_left = edgeRef(triOf(base), prev3(indexOf(base)));
    if (mesh.segment(on_right) == right && right != kNone) {
      across = on_left;
    } else if (mesh.segment(on_left) == left && left != kNone) {
      across = on_right;
    } else {
      break;
    }
  }
  strip.resize(up_to_last);
  return strip;
}

void growCornerTriangles(RefineRun& run, Beyond beyond, const RunControl& control) {
  growAll(run, beyond);
  if (beyond == Beyond::GetsMended && !run.touched.empty()) {
    std::vector<TriId> touched = std::exchange(run.touched, {});
    resume(run, touched, control);
    // Refinement may have split the sides again.
    growAll(run, beyond);
  }
  run.touched.clear();
}

}  // namespace coastmesh
