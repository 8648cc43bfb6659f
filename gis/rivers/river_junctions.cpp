#include "gis/rivers/river_junctions.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/ids.hpp"
#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "core/union_find.hpp"
#include "gis/geometry/near_segments.hpp"
#include "gis/geometry/ring_area.hpp"

namespace coastmesh {

namespace {

// Trims grow by this share of the width until branches are clear of one another, and then once more by `kMargin`.
constexpr double kStep = 0.15, kMargin = 0.25;
constexpr double kMostWidths = 12.0;
// Of a junction that is made of several.
constexpr std::size_t kMostBranches = 8;
// The least distance between banks of different branches, as a share of a cell's width.
constexpr double kLeastBank = 0.5;
// The least angle of land between the bank of a branch and that between it and the next.
constexpr double kLeastAngleDeg = 25.0;
// Branches are compared over this many steps of half a width.
constexpr int kLadder = 5;

using Edge = std::pair<Point, Point>;
using Clash = std::optional<std::pair<std::size_t, std::size_t>>;

bool meetElsewhere(const Edge& p, const Edge& q) {
  if (p.first == q.first || p.first == q.second || p.second == q.first || p.second == q.second) return false;
  return areNear(p.first, p.second, q.first, q.second, 0.0);
}

Point middleOf(const std::vector<RiverSection>& sections) {
  Point sum{0.0, 0.0};
  for (const RiverSection& section : sections) sum = sum + section.place;
  return (1.0 / static_cast<double>(sections.size())) * sum;
}

// The banks between two branches must not run along one of them.
Clash clashOfCorners(const std::vector<Point>& ring, const std::vector<std::vector<Edge>>& ladders) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < ladders.size(); ++i) {
    if (ladders[i].size() < 4) continue;
    const Edge &right = ladders[i][2], &left = ladders[i][3];
    const double at_right = angleAt(right.first, right.second, ring[(2 * i + n - 1) % n]);
    const double at_left = angleAt(left.first, left.second, ring[(2 * i + 2) % n]);
    if (std::min(at_right, at_left) < toRadians(kLeastAngleDeg)) return {{i, i}};
  }
  return std::nullopt;
}

// The ring of corners must not cross itself, or a branch.
Clash clashOfRing(const std::vector<Point>& ring, const std::vector<std::vector<Edge>>& ladders) {
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Edge side{ring[k], ring[(k + 1) % ring.size()]};
    for (std::size_t m = k + 1; m < ring.size(); ++m)
      if (meetElsewhere(side, {ring[m], ring[(m + 1) % ring.size()]})) return {{k / 2, m / 2}};
    for (std::size_t i = 0; i < ladders.size(); ++i)
      for (const Edge& rung : ladders[i])
        if (meetElsewhere(side, rung)) return {{i, k / 2}};
  }
  if (signedAreaOf(ring) <= 0.0) return {{0, ladders.size() - 1}};
  return std::nullopt;
}

}  // namespace

JunctionPlanner::JunctionPlanner(const RiverNetwork& network, std::span<const RiverCourse> courses,
                                 std::span<const ReachShape> shapes)
    : network_(network),
      courses_(courses),
      shapes_(shapes),
      sets_(network.nodes.size()),
      branches_(network.nodes.size()),
      is_due_(network.nodes.size(), 1),
      gone_(network.reaches.size(), 0) {
  const std::size_t n = network.reaches.size();
  plan_.trim_start.assign(n, 0.0);
  plan_.trim_end.assign(n, 0.0);
  plan_.in_junction.assign(n, 0);
  plan_.left_out.assign(n, 0);
  for (std::uint32_t r = 0; r < n; ++r) {
    branches_[network.reaches[r].from].push_back({r, false, 0.0});
    branches_[network.reaches[r].to].push_back({r, true, 0.0});
  }
}

void JunctionPlanner::bar(std::uint32_t reach) {
  if (gone_[reach] == 0) removeBranches(reach);
}

void JunctionPlanner::look(std::uint32_t reach) {
  for (const std::uint32_t node : {network_.reaches[reach].from, network_.reaches[reach].to})
    is_due_[sets_.find(node)] = 1;
}

// Each pass but the last takes a reach away.
JunctionPlan JunctionPlanner::plan() {
  for (bool any = true; any;) {
    for (std::uint32_t node = 0; node < branches_.size(); ++node) {
      if (is_due_[node] == 0 || sets_.find(node) != node) continue;
      is_due_[node] = 0;
      if (const auto without_room = trim(branches_[node])) takeAway(*without_room);
    }
    for (std::uint32_t r = 0; r < network_.reaches.size(); ++r)
      if (gone_[r] == 0 && roomOf(r) < 0.0) takeAway(r);
    any = std::ranges::find(is_due_, 1) != is_due_.end();
  }
  plan_.junctions.clear();
  for (const auto& branches : branches_)
    if (branches.size() > 1) plan_.junctions.push_back({branches});
  return plan_;
}

double& JunctionPlanner::trimOf(const RiverBranch& branch) {
  return (branch.at_end ? plan_.trim_end : plan_.trim_start)[branch.reach];
}

double JunctionPlanner::roomOf(std::uint32_t reach) const {
  return courses_[reach].length() - plan_.trim_start[reach] - plan_.trim_end[reach] - shapes_[reach].least_length;
}

// True if a reach without room makes its two junctions one, which must not get too many branches.
bool JunctionPlanner::isBetween(std::uint32_t reach) const {
  const std::uint32_t from = sets_.find(network_.reaches[reach].from), to = sets_.find(network_.reaches[reach].to);
  const std::size_t n = branches_[from].size(), m = branches_[to].size();
  return from != to && n > 1 && m > 1 && n + m <= kMostBranches + 2;
}

// Of a reach without room and one that clashes with it, that to be left out: the narrower one.
std::uint32_t JunctionPlanner::loserOf(std::uint32_t reach,
                                       const std::pair<std::uint32_t, std::uint32_t>& clash) const {
  if (isBetween(reach) || (clash.first != reach && clash.second != reach)) return reach;
  const std::uint32_t other = clash.first == reach ? clash.second : clash.first;
  return !isBetween(other) && courses_[other].meanWidth() < courses_[reach].meanWidth() ? other : reach;
}

// Trims the branches of a junction, and orders them. Returns a reach that is too short for that, or in the way.
std::optional<std::uint32_t> JunctionPlanner::trim(std::vector<RiverBranch>& branches) {
  for (RiverBranch& branch : branches) trimOf(branch) = branch.trim = 0.0;
  if (branches.size() < 2) return std::nullopt;
  for (RiverBranch& branch : branches) grow(branch, kMargin);
  std::pair<std::uint32_t, std::uint32_t> last{kNone, kNone};
  for (;;) {
    for (const RiverBranch& branch : branches)
      if (roomOf(branch.reach) < 0.0) return loserOf(branch.reach, last);
    const auto clash = findClash(branches);
    if (!clash) break;
    last = {branches[clash->first].reach, branches[clash->second].reach};
    for (const std::size_t i : {clash->first, clash->second}) {
      const RiverBranch& branch = branches[i];
      if (branch.trim > kMostWidths * courses_[branch.reach].maxWidth()) return loserOf(branch.reach, last);
    }
    grow(branches[clash->first], kStep);
    if (clash->second != clash->first) grow(branches[clash->second], kStep);
  }
  return std::nullopt;
}

void JunctionPlanner::grow(RiverBranch& branch, double share) {
  const double width = sectionOf(courses_[branch.reach], branch, branch.trim).width;
  trimOf(branch) = branch.trim += share * width;
}

// Orders the branches around their junction, by the directions of their last sections from the middle of these.
std::vector<RiverSection> JunctionPlanner::order(std::vector<RiverBranch>& branches) const {
  std::vector<RiverSection> sections;
  for (const RiverBranch& branch : branches) sections.push_back(sectionOf(courses_[branch.reach], branch, branch.trim));
  const Point centre = middleOf(sections);
  std::vector<std::pair<double, std::size_t>> by_angle;
  for (std::size_t i = 0; i < branches.size(); ++i) {
    const Point arm = sections[i].place - centre;
    by_angle.emplace_back(std::atan2(arm.y, arm.x), i);
  }
  std::ranges::sort(by_angle);
  std::vector<RiverBranch> branches_before = std::move(branches);
  const std::vector<RiverSection> sections_before = std::move(sections);
  branches.clear();
  sections.clear();
  for (const auto& [angle, i] : by_angle) {
    branches.push_back(branches_before[i]);
    sections.push_back(sections_before[i]);
  }
  return sections;
}

// Two branches, by their positions, that are not clear of one another, in the order around the junction; one twice
// if it is not clear of the junction itself.
JunctionPlanner::Clash JunctionPlanner::findClash(std::vector<RiverBranch>& branches) const {
  const std::vector<RiverSection> sections = order(branches);
  const Point centre = middleOf(sections);
  std::vector<Point> ring;
  for (const RiverSection& section : sections) {
    ring.push_back(section.at(0.0));
    ring.push_back(section.at(1.0));
    if (const std::size_t n = ring.size(); orient2d(ring[n - 2], ring[n - 1], centre) <= 0)
      return {{n / 2 - 1, n / 2 - 1}};
  }
  std::vector<std::vector<Edge>> ladders;
  for (const RiverBranch& branch : branches) ladders.push_back(ladderOf(branch));
  if (const Clash clash = clashOfBanks(branches, ladders)) return clash;
  if (const Clash clash = clashOfCorners(ring, ladders)) return clash;
  return clashOfRing(ring, ladders);
}

JunctionPlanner::Clash JunctionPlanner::clashOfBanks(const std::vector<RiverBranch>& branches,
                                                     const std::vector<std::vector<Edge>>& ladders) const {
  for (std::size_t i = 0; i < branches.size(); ++i)
    for (std::size_t j = i + 1; j < branches.size(); ++j) {
      const double least = kLeastBank * std::min(shapes_[branches[i].reach].cell, shapes_[branches[j].reach].cell);
      for (const Edge& p : ladders[i])
        for (const Edge& q : ladders[j])
          if (areNear(p.first, p.second, q.first, q.second, least)) return {{i, j}};
    }
  return std::nullopt;
}

// Sections and banks of a branch from its junction on.
std::vector<Edge> JunctionPlanner::ladderOf(const RiverBranch& branch) const {
  const RiverCourse& course = courses_[branch.reach];
  std::vector<Edge> edges;
  RiverSection before;
  double along = branch.trim;
  for (int i = 0; i < kLadder && along <= course.length(); ++i) {
    const RiverSection section = sectionOf(course, branch, along);
    edges.emplace_back(section.at(0.0), section.at(1.0));
    if (i > 0) {
      edges.emplace_back(before.at(0.0), section.at(0.0));
      edges.emplace_back(before.at(1.0), section.at(1.0));
    }
    before = section;
    along += 0.5 * section.width;
  }
  return edges;
}

// A reach between two junctions makes them one, unless they have too many branches; any other is left out.
void JunctionPlanner::takeAway(std::uint32_t reach) {
  const std::uint32_t from = sets_.find(network_.reaches[reach].from), to = sets_.find(network_.reaches[reach].to);
  const bool is_between = isBetween(reach);
  (is_between ? plan_.in_junction : plan_.left_out)[reach] = 1;
  removeBranches(reach);
  if (!is_between) return;
  const std::uint32_t root = std::min(from, to), other = std::max(from, to);
  sets_.unite(from, to);
  branches_[root].insert(branches_[root].end(), branches_[other].begin(), branches_[other].end());
  branches_[other].clear();
  is_due_[other] = 0;
}

void JunctionPlanner::removeBranches(std::uint32_t reach) {
  gone_[reach] = 1;
  for (const std::uint32_t end : {network_.reaches[reach].from, network_.reaches[reach].to}) {
    const std::uint32_t node = sets_.find(end);
    std::erase_if(branches_[node], [&](const RiverBranch& branch) { return branch.reach == reach; });
    for (const RiverBranch& branch : branches_[node]) trimOf(branch) = 0.0;  // until they are trimmed anew
    is_due_[node] = 1;
  }
}

RiverSection sectionOf(const RiverCourse& course, const RiverBranch& branch, double distance) {
  if (!branch.at_end) return course.sectionAt(std::min(distance, course.length()));
  return course.sectionAt(std::max(0.0, course.length() - distance)).turned();
}

}  // namespace coastmesh
