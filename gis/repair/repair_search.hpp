#pragma once

#include <optional>
#include <span>
#include <vector>

#include "gis/repair/repair_patch.hpp"

namespace coastmesh {

// Searches return the best edit by `EditScore::betterThan` of those that leave fewer defects in `patch`, or nullopt if
// no edit does.

// The edits to try.
struct SearchReach {
  std::span<const double> shares;          // where edges are split
  std::span<const std::uint32_t> movable;  // nodes that may be moved a little
  double least_angle_deg = 0.0;            // smaller angles are made only of such angles
};

// Moves a node, or flips or splits an edge of `inside`; for FESOM2 and FVCOM, cuts off a corner of a shore that may
// move. REQUIRES: `patch` surrounds `inside` and the triangles of the movable nodes (`patchRound`).
std::optional<PatchEdit> bestReshaping(const RepairView& view, std::span<const std::uint32_t> inside,
                                       const SearchReach& reach, const GridPatch& patch);

// Cuts off the corner of a triangle with two boundary edges (`cornerCutOf`). Returns nullopt also if that leaves no
// fewer defects. REQUIRES: `patch` surrounds the triangles at its corners.
std::optional<PatchEdit> usefulCornerCut(const RepairView& view, std::uint32_t t, const GridPatch& patch);

// For a triangle with too short a time step: moves a node, or collapses one of the triangle's edges. REQUIRES: `patch`
// surrounds the triangles at the movable nodes and at the triangle's corners (`patchRound`).
std::optional<PatchEdit> bestLengthening(const RepairView& view, std::uint32_t t,
                                         std::span<const std::uint32_t> movable, const GridPatch& patch);

// The moves of a node that add no defect.
std::vector<PatchEdit> harmlessMoves(const RepairView& view, std::uint32_t node, const GridPatch& patch);

// The moves of a node along the boundary that add no defect and keep the bounds on angles of `StepBound`, or make such
// angles no worse. None for an inner node. REQUIRES: `patch` surrounds the triangles at the node.
std::vector<PatchEdit> harmlessSlides(const RepairView& view, std::uint32_t node, const GridPatch& patch);

// True if the triangles at its corners alone decide whether a triangle can be lengthened. False if models limit flow
// links or valences, shores may move, or a triangle of the patch is clockwise: then other triangles matter too.
bool mendsByCornersAlone(const RepairView& view, const GridPatch& patch);

// For a triangle with a small angle: the move, flip or collapse that makes the largest smallest angle, more than 0.1
// degrees above that of the triangles it replaces, and adds no defect. REQUIRES: `patch` as for `bestLengthening`.
std::optional<PatchEdit> bestRelaxing(const RepairView& view, std::uint32_t t, std::span<const std::uint32_t> movable,
                                      const GridPatch& patch);

// The sum, over triangles, of the squares of what their angles lack of `goal_deg`; infinite if one is clockwise.
double lackOfAngles(const RepairView& view, std::span<const std::uint32_t> triangles, double goal_deg);

// For a node near a triangle with a small angle: the move that leaves the least `lackOfAngles` of the triangles around
// the node, if that is less than before, and adds no defect. Nullopt if there is none. REQUIRES: the patch is that
// around the node's triangles.
std::optional<PatchEdit> bestSharing(const RepairView& view, std::uint32_t node, double goal_deg,
                                     const GridPatch& patch);

// Splits an inner node in two: half of its triangles get a new node, between the old one and the middle of their other
// corners. Returns nullopt also for a node with fewer than eight triangles.
std::optional<PatchEdit> bestNodeSplit(const RepairView& view, std::uint32_t node, const GridPatch& patch);

}  // namespace coastmesh
