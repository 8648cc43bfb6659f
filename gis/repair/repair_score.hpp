#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "gis/repair/repair_patch.hpp"

namespace coastmesh {

// What a defect counts; one that is only advice counts 1.
inline constexpr int kDefectWeight = 8;

// The outcome of an edit of a patch. Edits are ranked by grade first, since another edit may repair the defects that
// are left, then by fewest defects, then by fewest triangles with too short an edge, then by largest smallest angle.
struct EditScore {
  int defects = 0;         // change of the patch's defects, weighted; negative: fewer
  double min_angle = 0.0;  // degrees, of the whole patch
  // Degrees: the smallest angle of the triangles that the edit makes, and of those that they replace.
  double made_angle = 180.0, replaced_angle = 180.0;
  double made_largest = 0.0, replaced_largest = 0.0;  // their largest angles
  int short_added = 0;  // change in the number of triangles with an edge below the bound (`StepBound`)

  // The number of these thresholds, in degrees, that the smallest angle reaches; at most one if the edit makes edges
  // too short.
  int grade() const {
    int reached = 0;
    for (const double angle : {20.0, 25.0, 30.0, 33.0}) reached += min_angle >= angle;
    return short_added > 0 ? std::min(reached, 1) : reached;
  }
  bool betterThan(const EditScore& other) const {
    if (grade() != other.grade()) return grade() > other.grade();
    if (defects != other.defects) return defects < other.defects;
    return short_added != other.short_added ? short_added < other.short_added : min_angle > other.min_angle;
  }
};

// More than any patch has.
inline constexpr int kTurnedOver = std::numeric_limits<int>::max();

struct TriangleScore {
  int defects = 0;                            // weighted
  double min_angle = 0.0, max_angle = 180.0;  // degrees
  bool is_short = false;                      // an edge is below the bound
};

// Measurements of a patch, made once, so that scoring an edit costs only as much as the edit changes.
struct PatchScale {
  std::vector<std::pair<double, std::uint32_t>> angles;  // the smallest angle of each triangle, ascending
  std::vector<std::uint32_t> turned;                     // triangles that are clockwise, or without area
  // Cached scores, before any edit, of triangles that edits replace; nullopt for those in `turned`.
  mutable std::vector<std::pair<std::uint32_t, std::optional<TriangleScore>>> replaced{};
};

PatchScale scaleOf(const RepairView& view, const GridPatch& patch);

// The least that an edit must achieve to be useful.
struct ScoreBar {
  int defects = kTurnedOver;         // fewer defects than this
  double least_angle_deg = 0.0;      // no smaller angles, unless the replaced triangles have smaller ones
  const EditScore* best = nullptr;   // better than this
  double largest_angle_deg = 180.0;  // no larger angles, unless the replaced triangles have larger ones
  int short_added = kTurnedOver;     // no more triangles with too short an edge

  bool isReachedBy(const EditScore& score) const {
    return score.short_added <= short_added && score.made_angle >= std::min(least_angle_deg, score.replaced_angle) &&
           score.made_largest <= std::max(largest_angle_deg, score.replaced_largest) && score.defects < defects &&
           (best == nullptr || score.betterThan(*best));
  }
};

// The score of the patch as it is, and after an edit; its defects are `kTurnedOver` if a triangle is clockwise or has
// no area.
EditScore scoreOf(const PatchScale& scale);
EditScore scoreOf(const RepairView& view, const GridPatch& patch, const PatchScale& scale, const PatchEdit& edit);

// The score of the edit if it reaches the bar; nullopt as soon as it is certain that it does not.
std::optional<EditScore> scoreAbove(const RepairView& view, const GridPatch& patch, const PatchScale& scale,
                                    const PatchEdit& edit, const ScoreBar& bar);

// False if no move of the node can reduce defects, because all of them are due to edges opposite the node, which stay.
// REQUIRES: the node's triangles are in the patch.
bool moveMayMend(const RepairView& view, const PatchScale& scale, std::uint32_t node);

}  // namespace coastmesh
