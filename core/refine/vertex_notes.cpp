#include "core/refine/vertex_notes.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

#include "core/input_angle.hpp"

namespace coastmesh {

namespace {

// Sectors below this angle are split on shells (Ruppert 1995, Section 5).
constexpr double kShellAngle = std::numbers::pi / 3.0;

bool isConstrained(const TriMesh& mesh, EdgeRef e) { return mesh.segment(e) != kNone || mesh.twin(e) == kNone; }

void noteAngles(const TriMesh& mesh, const TriangleBound& bound, VertexNotes& notes) {
  notes.shell_unit.assign(mesh.input_vertices, 0.0);
  notes.small_angle.assign(mesh.input_vertices, false);
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef right = edgeRef(t, prev3(i));
      const VertexId v = mesh.triangle(t).v[i];
      if (!isConstrained(mesh, right) || v >= mesh.input_vertices) continue;
      if (!mayBeSmall(mesh, t, i, bound)) continue;
      const Sector sector = sectorAt(mesh, t, i);
      if (!bound.canDivide(sector.angle)) notes.small_angle[v] = true;
      if (sector.angle >= kShellAngle) continue;
      const double nearer = std::min(bound.surface.chord(mesh.point(v), mesh.point(mesh.target(sector.right))),
                                     bound.surface.chord(mesh.point(v), mesh.point(mesh.origin(sector.left))));
      notes.shell_unit[v] = notes.shell_unit[v] == 0.0 ? nearer : std::min(notes.shell_unit[v], nearer);
    }
  }
}

// Spacing is the distance to the nearest vertex or segment that a vertex sees, from the triangles around it.
void noteSpacing(const TriMesh& mesh, const Surface& surface, VertexNotes& notes) {
  notes.spacing.assign(mesh.points.size(), std::numeric_limits<double>::infinity());
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& tri = mesh.triangle(t);
    for (unsigned i = 0; i < 3; ++i) {
      const VertexId a = tri.v[next3(i)], b = tri.v[prev3(i)];
      const double length = surface.chord(mesh.point(a), mesh.point(b));
      notes.spacing[a] = std::min(notes.spacing[a], length);
      notes.spacing[b] = std::min(notes.spacing[b], length);
      if (!isConstrained(mesh, edgeRef(t, i))) continue;
      if (surface.isCurved()) {
        notes.spacing[tri.v[i]] = std::min(
            notes.spacing[tri.v[i]], distanceToSegment(surface, mesh.point(tri.v[i]), mesh.point(a), mesh.point(b)));
        continue;
      }
      const Point ab = mesh.point(b) - mesh.point(a), av = mesh.point(tri.v[i]) - mesh.point(a);
      const double along = dot(av, ab);
      if (along > 0.0 && along < length * length)
        notes.spacing[tri.v[i]] = std::min(notes.spacing[tri.v[i]], std::abs(cross(ab, av)) / length);
    }
  }
}

}  // namespace

VertexNotes noteInput(const TriMesh& mesh, const TriangleBound& bound) {
  VertexNotes notes;
  noteAngles(mesh, bound, notes);
  notes.surface = bound.surface;
  noteSpacing(mesh, bound.surface, notes);
  InputCorners corners(mesh, bound);
  if (!corners.all().empty()) notes.corners = std::make_shared<const InputCorners>(std::move(corners));
  return notes;
}

void noteSpacingOfNeighbours(const TriMesh& mesh, VertexNotes& notes) {
  const std::size_t known = notes.spacing.size();
  notes.spacing.resize(mesh.points.size(), std::numeric_limits<double>::infinity());
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const VertexId a = mesh.origin(edgeRef(t, i)), b = mesh.target(edgeRef(t, i));
      if (a < known && b < known) continue;
      const double length = notes.surface.chord(mesh.point(a), mesh.point(b));
      for (const VertexId v : {a, b})
        if (v >= known) notes.spacing[v] = std::min(notes.spacing[v], length);
    }
  }
}

void noteFurther(const TriMesh& mesh, VertexNotes& notes) {
  noteSpacingOfNeighbours(mesh, notes);
  notes.shell_unit.resize(mesh.input_vertices, 0.0);
  notes.small_angle.resize(mesh.input_vertices, false);
}

}  // namespace coastmesh
