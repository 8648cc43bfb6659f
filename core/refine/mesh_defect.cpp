#include "core/refine/mesh_defect.hpp"

#include <cassert>

namespace coastmesh {

std::string_view toString(DefectKind kind) {
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

}  // namespace coastmesh
