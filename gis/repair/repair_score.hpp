#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "gis/repair/repair_patch.hpp"

namespace coastmesh {

// What an edit leaves of a patch: first angles that are not small, since what is left of the defects may be mended by
// another edit; then fewer defects, and then a larger smallest angle.
struct EditScore {
  int defects = 0;         // more than the patch has now; less than 0 where it gets better
  double min_angle = 0.0;  // degrees, of the whole patch
  // Degrees, of the triangles that the edit makes, and of those that they take the place of.
  double made_angle = 180.0, replaced_angle = 180.0;
  double made_largest = 0.0, replaced_largest = 0.0;  // their largest

  // How many of these the smallest angle reaches.
  int grade() const {
    int reached = 0;
    for (const double angle : {20.0, 25.0, 30.0, 33.0}) reached += min_angle >= angle;
    return reached;
  }
  bool betterThan(const EditScore& other) const {
    if (grade() != other.grade()) return grade() > other.grade();
    return defects != other.defects ? defects < other.defects : min_angle > other.min_angle;
  }
};

// More than any patch has.
inline constexpr int kTurnedOver = std::numeric_limits<int>::max();

struct TriangleScore {
  int defects = 0;
  double min_angle = 0.0, max_angle = 180.0;  // degrees
};

// What is measured once, so that an edit costs what it changes.
struct PatchScale {
  std::vector<std::pair<double, std::uint32_t>> angles;  // the smallest of each triangle, ascending
  std::vector<std::uint32_t> turned;                     // triangles that are clockwise, or without area
  // Triangles that an edit took the place of, as they are; none for one of `turned`. Grows while edits are scored.
  mutable std::vector<std::pair<std::uint32_t, std::optional<TriangleScore>>> replaced{};
};

PatchScale scaleOf(const RepairView& view, const GridPatch& patch);

// What an edit has to reach to be of use.
struct ScoreBar {
  int defects = kTurnedOver;         // fewer than these
  double least_angle_deg = 0.0;      // no smaller angles made, unless what they take the place of has smaller ones
  const EditScore* best = nullptr;   // better than this
  double largest_angle_deg = 180.0;  // no larger angles made, unless what they take the place of has larger ones

  bool isReachedBy(const EditScore& score) const {
    return score.made_angle >= std::min(least_angle_deg, score.replaced_angle) &&
           score.made_largest <= std::max(largest_angle_deg, score.replaced_largest) && score.defects < defects &&
           (best == nullptr || score.betterThan(*best));
  }
};

// Of the patch as it is.
EditScore scoreOf(const PatchScale& scale);
EditScore scoreOf(const RepairView& view, const GridPatch& patch, const PatchScale& scale, const PatchEdit& edit);

// The same where the edit reaches the bar; none as soon as it is clear that it does not.
std::optional<EditScore> scoreAbove(const RepairView& view, const GridPatch& patch, const PatchScale& scale,
                                    const PatchEdit& edit, const ScoreBar& bar);

// Whether moves of the node may leave fewer defects than there are: not where the edges across from it, which stay, are
// all that is wrong. REQUIRES: the node's triangles are of the patch.
bool moveMayMend(const RepairView& view, const PatchScale& scale, std::uint32_t node);

}  // namespace coastmesh
