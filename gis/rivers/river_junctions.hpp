#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/union_find.hpp"
#include "gis/rivers/river_course.hpp"
#include "gis/rivers/river_network.hpp"

namespace coastmesh {

// A reach where it leaves a junction.
struct RiverBranch {
  std::uint32_t reach = 0;
  bool at_end = false;  // the reach ends here; otherwise it begins here
  double trim = 0.0;    // its rows begin at this distance from the node
};

// Branches of two reaches or more, counter-clockwise. Between their last sections, and straight banks that connect
// these, is a polygon that does not cross itself, and that no rows overlap.
struct RiverJunction {
  std::vector<RiverBranch> branches;
};

// What there is to know of a reach before its ends are trimmed.
struct ReachShape {
  double least_length = 0.0;  // of its rows
  double cell = 0.0;          // mean width of its cells
};

struct JunctionPlan {
  std::vector<RiverJunction> junctions;
  std::vector<double> trim_start, trim_end;  // of each reach
  std::vector<std::uint8_t> in_junction;     // of each reach: 1 if it is so short that it is part of a junction
  std::vector<std::uint8_t> left_out;        // of each reach: 1 if it has no room beside the others at a junction
};

// Finds where rows have to end so that those of other reaches have room. Junctions become one if the reach between them
// is too short.
class JunctionPlanner {
 public:
  // REQUIRES: the arguments outlive it.
  JunctionPlanner(const RiverNetwork& network, std::span<const RiverCourse> courses,
                  std::span<const ReachShape> shapes);

  // From now on the reach is not there.
  void bar(std::uint32_t reach);
  // The course of the reach has changed.
  void look(std::uint32_t reach);
  // Only junctions that are concerned are planned anew.
  JunctionPlan plan();

 private:
  using Clash = std::optional<std::pair<std::size_t, std::size_t>>;
  using Edge = std::pair<Point, Point>;

  double& trimOf(const RiverBranch& branch);
  double roomOf(std::uint32_t reach) const;
  bool isBetween(std::uint32_t reach) const;
  std::uint32_t loserOf(std::uint32_t reach, const std::pair<std::uint32_t, std::uint32_t>& clash) const;
  std::optional<std::uint32_t> trim(std::vector<RiverBranch>& branches);
  void grow(RiverBranch& branch, double share);
  std::vector<RiverSection> order(std::vector<RiverBranch>& branches) const;
  Clash findClash(std::vector<RiverBranch>& branches) const;
  Clash clashOfBanks(const std::vector<RiverBranch>& branches, const std::vector<std::vector<Edge>>& ladders) const;
  std::vector<Edge> ladderOf(const RiverBranch& branch) const;
  void takeAway(std::uint32_t reach);
  void removeBranches(std::uint32_t reach);

  const RiverNetwork& network_;
  std::span<const RiverCourse> courses_;
  std::span<const ReachShape> shapes_;
  mutable UnionFind sets_;                          // `find` shortens paths
  std::vector<std::vector<RiverBranch>> branches_;  // by root
  std::vector<std::uint8_t> is_due_;                // nodes whose branches have changed
  std::vector<std::uint8_t> gone_;
  JunctionPlan plan_;
};

// The section of a branch at a distance from its node, with `left` as seen from the junction.
RiverSection sectionOf(const RiverCourse& course, const RiverBranch& branch, double distance);

}  // namespace coastmesh
