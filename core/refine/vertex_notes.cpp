#include "core/refine/vertex_notes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/input_angle.hpp"
#include "core/large_list.hpp"

namespace coastmesh {

namespace {

// Sectors below this angle are split on shells (Ruppert 1995, Section 5).
constexpr double kShellAngle = std::numbers::pi / 3.0;

bool isConstrained(const TriMesh& mesh, EdgeRef e) { return mesh.segment(e) != kNone || mesh.twin(e) == kNone; }

// What a sector at an input vertex says of it.
struct SmallSector {
  VertexId vertex;
  double nearer;      // the shorter of its sides; infinite if it is not split on shells
  bool is_too_small;  // for the bounds
};

void noteAngles(const TriMesh& mesh, const TriangleBound& bound, VertexNotes& notes, const ItemLoop& loop) {
  notes.shell_unit.assign(mesh.input_vertices, 0.0);
  notes.small_angle.assign(mesh.input_vertices, false);
  const auto sectors = listOver<SmallSector>(loop, mesh.triangles.size(), [&](std::size_t i, auto& found) {
    const auto t = static_cast<TriId>(i);
    for (unsigned corner = 0; corner < 3; ++corner) {
      const VertexId v = mesh.triangle(t).v[corner];
      if (!isConstrained(mesh, edgeRef(t, prev3(corner))) || v >= mesh.input_vertices) continue;
      if (!mayBeSmall(mesh, t, corner, bound)) continue;
      const Sector sector = sectorAt(mesh, t, corner);
      const bool on_shells = sector.angle < kShellAngle;
      const double nearer = on_shells
                                ? std::min(bound.surface.chord(mesh.point(v), mesh.point(mesh.target(sector.right))),
                                           bound.surface.chord(mesh.point(v), mesh.point(mesh.origin(sector.left))))
                                : std::numeric_limits<double>::infinity();
      const bool is_too_small = !bound.canDivide(sector.angle);
      if (on_shells || is_too_small) found.push_back({v, nearer, is_too_small});
    }
  });
  for (const SmallSector& s : sectors) {
    if (s.is_too_small) notes.small_angle[s.vertex] = true;
    if (std::isinf(s.nearer)) continue;
    double& unit = notes.shell_unit[s.vertex];
    unit = unit == 0.0 ? s.nearer : std::min(unit, s.nearer);
  }
}

// Spacing is the distance to the nearest vertex or segment that a vertex sees, from the triangles around it.
void noteSpacing(const TriMesh& mesh, const Surface& surface, VertexNotes& notes, const ItemLoop& loop) {
  notes.spacing.assign(mesh.points.size(), std::numeric_limits<double>::infinity());
  forEachByStretches(loop, mesh.triangles.size(), [&](std::size_t t) {
    const Triangle& tri = mesh.triangles[t];
    for (unsigned i = 0; i < 3; ++i) {
      const VertexId a = tri.v[next3(i)], b = tri.v[prev3(i)];
      const double length = surface.chord(mesh.point(a), mesh.point(b));
      lowerTo(notes.spacing[a], length);
      lowerTo(notes.spacing[b], length);
      if (!isConstrained(mesh, edgeRef(static_cast<TriId>(t), i))) continue;
      if (surface.isCurved()) {
        lowerTo(notes.spacing[tri.v[i]],
                distanceToSegment(surface, mesh.point(tri.v[i]), mesh.point(a), mesh.point(b)));
        continue;
      }
      const Point ab = mesh.point(b) - mesh.point(a), av = mesh.point(tri.v[i]) - mesh.point(a);
      const double along = dot(av, ab);
      if (along > 0.0 && along < length * length) lowerTo(notes.spacing[tri.v[i]], std::abs(cross(ab, av)) / length);
    }
  });
}

}  // namespace

VertexNotes noteInput(const TriMesh& mesh, const TriangleBound& bound, const ItemLoop& loop) {
  VertexNotes notes;
  noteAngles(mesh, bound, notes, loop);
  notes.surface = bound.surface;
  noteSpacing(mesh, bound.surface, notes, loop);
  InputCorners corners(mesh, bound, loop);
  if (!corners.all().empty()) notes.corners = std::make_shared<const InputCorners>(std::move(corners));
  return notes;
}

namespace {

// Of the vertices below `end`, without regard to the others.
void noteSpacingOfNeighbours(const TriMesh& mesh, std::size_t end, VertexNotes& notes, const ItemLoop& loop) {
  const std::size_t known = notes.spacing.size();
  resizeUnset(notes.spacing, mesh.points.size());
  forEachByStretches(loop, end - known,
                     [&](std::size_t i) { notes.spacing[known + i] = std::numeric_limits<double>::infinity(); });
  forEachByStretches(loop, mesh.triangles.size(), [&](std::size_t t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(static_cast<TriId>(t), i);
      const VertexId a = mesh.origin(e), b = mesh.target(e);
      if ((a < known && b < known) || std::max<std::size_t>(a, b) >= end) continue;
      const double length = notes.surface.chord(mesh.point(a), mesh.point(b));
      for (const VertexId v : {a, b})
        if (v >= known) lowerTo(notes.spacing[v], length);
    }
  });
}

}  // namespace

void noteSpacingOfNeighbours(const TriMesh& mesh, VertexNotes& notes, const ItemLoop& loop) {
  noteSpacingOfNeighbours(mesh, mesh.points.size(), notes, loop);
}

void noteFurther(const TriMesh& mesh, VertexNotes& notes, const BulkList<double>& dividing, const ItemLoop& loop) {
  const std::size_t end = mesh.points.size() - dividing.size();
  noteSpacingOfNeighbours(mesh, end, notes, loop);
  std::ranges::copy(dividing, notes.spacing.begin() + static_cast<std::ptrdiff_t>(end));
  notes.shell_unit.resize(mesh.input_vertices, 0.0);
  notes.small_angle.resize(mesh.input_vertices, false);
}

}  // namespace coastmesh
