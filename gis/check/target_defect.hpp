#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/point.hpp"

namespace coastmesh {

// Defects that make a model reject a grid.
enum class TargetDefectKind {
  WrongCount,      // a file is inconsistent with itself
  BrokenEdge,      // an edge of three triangles, or of two with different orientation
  Clockwise,       // a triangle that is clockwise, or has no area
  Overlap,         // a triangle that overlaps others
  UnusedNode,      // a node without triangles
  RepeatedNode,    // two nodes at the same place
  HangingNode,     // a node on an edge of a triangle, but not one of its corners
  PinchedNode,     // the mesh touches itself in a node
  OrphanCell,      // a triangle without a neighbour
  UnknownDepth,    // a node without a depth
  DryOpening,      // a node of an open boundary that is above the water
  NoBoundary,      // a boundary edge of the mesh that is in no boundary
  StrayBoundary,   // two consecutive nodes of a boundary without a boundary edge of the mesh between them
  BoundaryTwice,   // a boundary edge of the mesh that is in two boundaries
  BoundaryTurned,  // a boundary with the mesh to its right
  LoopedBoundary,  // a loop that repeats its first node, which the model rejects
  WrongShore,      // an outer shore marked as an island, or the other way round
  TwoOpenEdges,    // a triangle with two open edges
  OpenAndSolid,    // a triangle with an open edge, and a solid one or a node of the shore opposite
  OpenBridge,      // a triangle with an inner edge between nodes of open boundaries
  OneNeighbour,    // a triangle with only one neighbour
  LoneWall,        // a wall between openings too short for codes at nodes: one edge, for TELEMAC two
  Valence,         // an interior node with too few or too many triangles
  LargeAngle,      // an angle larger than the model accepts
  NotOrthogonal,   // an edge far from perpendicular to the line between the neighbours' centres
  SmallFlowLink,   // an edge with the neighbours' centres too close to one another
  Courant,         // a triangle whose Courant number is out of range for the time step
  RoundTheGlobe,   // a triangle whose longitudes jump at ±180, for a model that takes differences of them as they are
  Quadrilateral,   // an element of four nodes, for a model of triangles
  BedAboveCrest,   // a node of a weir whose bed is higher than the crest
};
inline constexpr std::size_t kTargetDefectKinds = 30;
std::string_view toString(TargetDefectKind kind);

struct TargetDefect {
  TargetDefectKind kind;
  Point place;                 // in the grid's CRS
  std::int64_t triangle = -1;  // index, -1 if none
  std::int64_t node = -1;      // the same
  // Degrees, metres above the water or a crest, triangles around a node, a cosine, a share (`FlowLink`), or a Courant
  // number.
  double value = 0.0;
  std::string text;     // of WrongCount, and of Overlap
  bool advice = false;  // the model runs, but not as well as it could

  friend bool operator==(const TargetDefect&, const TargetDefect&) = default;
};

}  // namespace coastmesh
