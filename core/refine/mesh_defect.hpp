#pragma once

#include <string_view>

#include "core/ids.hpp"
#include "core/point.hpp"

namespace coastmesh {

enum class DefectKind {
  BrokenTopology,  // neighbours that do not point back, an edge of three triangles, a corner out of range
  NotCounterClockwise,
  PinchedVertex,    // two fans of triangles meet in a vertex
  MissingVertex,    // an input vertex on the domain's boundary is not in the mesh, bit for bit
  MissingSegment,   // an input segment is not a chain of edges
  NotDelaunay,      // an unconstrained edge that is not locally Delaunay
  AngleBelowBound,  // a triangle misses the bounds, not excused by a corner of the input
  WrongArea,        // the triangles do not cover the domain exactly once
  UnusedVertex,     // a Steiner point without triangles
};

inline std::string_view toString(DefectKind kind) {
  switch (kind) {
    case DefectKind::BrokenTopology:
      return "broken topology";
    case DefectKind::NotCounterClockwise:
      return "triangle not counter-clockwise";
    case DefectKind::PinchedVertex:
      return "pinched vertex";
    case DefectKind::MissingVertex:
      return "input vertex missing";
    case DefectKind::MissingSegment:
      return "input segment missing";
    case DefectKind::NotDelaunay:
      return "edge not Delaunay";
    case DefectKind::AngleBelowBound:
      return "angle beyond the bound";
    case DefectKind::WrongArea:
      return "wrong area";
    case DefectKind::UnusedVertex:
      return "vertex without triangle";
  }
  return "";
}

struct MeshDefect {
  DefectKind kind;
  Point place;
  TriId triangle = kNone;
  double value = 0.0;  // degrees for AngleBelowBound, relative error for WrongArea
};

}  // namespace coastmesh
