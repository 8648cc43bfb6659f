#include "gis/clean/clean_report.hpp"

#include <cassert>

namespace coastmesh {

std::string_view toString(EditKind kind) {
  switch (kind) {
    case EditKind::RepeatedPoint:
      return "repeated point";
    case EditKind::Spike:
      return "spike";
    case EditKind::SelfCrossing:
      return "self-crossing";
    case EditKind::FeaturesCross:
      return "features cross";
    case EditKind::TouchingRing:
      return "touching ring";
    case EditKind::OverlappingEdge:
      return "overlapping edge";
    case EditKind::DegenerateRing:
      return "degenerate ring";
    case EditKind::SmallIsland:
      return "small island";
    case EditKind::SimplifiedPoint:
      return "simplified point";
    case EditKind::FeaturesOverlap:
      return "features overlap";
    case EditKind::MisplacedRing:
      return "misplaced ring";
    case EditKind::OutsideWater:
      return "point outside the water";
    case EditKind::DissolvedEdge:
      return "dissolved edge";
    case EditKind::OpenedPinch:
      return "opened pinch";
    case EditKind::ClosedWater:
      return "closed water";
    case EditKind::DroppedSpit:
      return "dropped spit";
    case EditKind::CutOffWater:
      return "cut-off water";
    case EditKind::MovedPoint:
      return "moved point";
    case EditKind::WidenedPassage:
      return "widened passage";
    case EditKind::Barrier:
      return "barrier";
    case EditKind::RepeatedRing:
      return "repeated ring";
  }
  assert(false);
  return "";
}

}  // namespace coastmesh
