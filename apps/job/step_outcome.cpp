#include "apps/job/step_outcome.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "gis/check/check_target.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/for_count.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "gis/model/target.hpp"
#include "gis/places.hpp"

namespace coastmesh {

namespace {

// The number of each cause, and remedies.
template <typename Short>
std::string causesText(const std::vector<Short>& found, const SizeOptions& sizes, QualityGoal goal) {
  std::array<std::size_t, kShortCauses> counts{};
  for (const Short& one : found) ++counts[static_cast<std::size_t>(one.cause)];
  const bool follows = sizes.coast == CoastDetail::Follow;
  const std::array<std::string, kShortCauses> texts{
      follows ? "at edges of the shore, which larger sizes there make longer"
              : "at edges of the shore, which --coast follow makes as long as the sizes",
      "at edges of the open boundary, where larger sizes or a larger --size-max help",
      follows ? "where water is narrow, which a larger --channel-min closes"
              : "where water is narrow, which --coast follow closes",
      "at constraints, weirs or borders of regions, which stay as they are in the data: wider angles and gaps between "
      "lines, or longer segments, make longer edges there",
      goal == QualityGoal::Centred
          ? "elsewhere, where --quality centred, which may make no angle above 90 degrees, takes shorter edges: larger "
            "sizes, a smaller --min-angle or another --quality help"
          : "elsewhere, where larger sizes, a larger --size-max or a smaller --min-angle help"};
  std::string text;
  for (std::size_t cause = 0; cause < kShortCauses; ++cause)
    if (counts[cause] > 0) text += (text.empty() ? "" : "; ") + std::to_string(counts[cause]) + " " + texts[cause];
  return text;
}

// Where larger sizes lengthen no edge, as the shores stay as they are.
std::string smallWatersText(std::size_t small_waters, const char* option) {
  if (small_waters == 0) return {};
  return "; in the " + std::to_string(small_waters) + forCount(small_waters, " part", " parts") +
         " narrower than an element, which " + forCount(small_waters, "stays", "stay") +
         " as in the input, larger sizes do not help: a smaller " + option + " does, or leave " +
         forCount(small_waters, "it", "them") + " out with --where";
}

// True for places within this distance of `middle`.
class NearPlaces {
 public:
  NearPlaces(const Grid& grid, const Point& middle, double distance_m) : middle_(middle), distance_m_(distance_m) {
    constexpr double kMetresPerDegree = 111e3;  // precise enough for what is near
    if (grid.crs.geographic) up_ = kMetresPerDegree;
    along_ = grid.crs.geographic ? up_ * std::cos(middle.y * std::numbers::pi / 180.0) : 1.0;
  }
  bool operator()(const Point& p) const {
    return std::hypot(along_ * (p.x - middle_.x), up_ * (p.y - middle_.y)) <= distance_m_;
  }
  // How far such places can be above or below, in the grid's units.
  double reachUp() const { return distance_m_ / up_; }

 private:
  Point middle_;
  double distance_m_, up_ = 1.0, along_ = 1.0;
};

// The short edges that repairs for models made, by splitting.
std::string ofRepairsText(const Grid& grid, const std::vector<ShortEdge>& below_least, double least_m,
                          std::span<const Repair> repairs) {
  constexpr double kNear = 2.0;  // smallest sizes
  std::vector<const Repair*> splits;
  for (const Repair& repair : repairs)
    if (repair.splits_edge) splits.push_back(&repair);
  const auto upOf = [](const Repair* repair) { return repair->place.y; };
  std::ranges::stable_sort(splits, {}, upOf);
  std::size_t edges = 0;
  const Repair* first = nullptr;
  for (const ShortEdge& edge : below_least) {
    const NearPlaces isNear(grid, edge.place, kNear * least_m);
    const auto low = std::ranges::lower_bound(splits, edge.place.y - isNear.reachUp(), {}, upOf);
    const auto high = std::ranges::upper_bound(splits, edge.place.y + isNear.reachUp(), {}, upOf);
    const auto split = std::find_if(low, high, [&](const Repair* repair) { return isNear(repair->place); });
    if (split == high) continue;
    ++edges;
    if (first == nullptr) first = *split;
  }
  if (first == nullptr) return {};
  return "; " + std::to_string(edges) + " of all are where repairs for a model split edges, the shortest at " +
         pointText(first->place) + " (" + std::string(toString(first->kind)) + ")";
}

// Edges so short that the requirement is missed: they cause the exit code.
std::string missedText(const StepOutcome& outcome, const SizeOptions& sizes) {
  if (!outcome.least_missed) return {};
  const auto missed = std::ranges::count_if(outcome.below_least, [&](const ShortEdge& edge) {
    return edge.length_m < StepOutcome::kShareOfLeast * sizes.least_m;
  });
  return ", " + std::to_string(missed) + " of them shorter than " + amount("%g", StepOutcome::kShareOfLeast) +
         " times it (exit code 1)";
}

std::string courantText(const StepOutcome& outcome, const Grid& grid, const SizeOptions& sizes) {
  const std::vector<LongStep>& found = outcome.above_step;
  return "--courant-min " + amount("%g", sizes.least_courant) + " with --time-step " + amount("%g", sizes.time_step_s) +
         " is not reached in " + std::to_string(found.size()) +
         forCount(found.size(), " triangle, at ", " triangles, the worst at ") +
         pointText(middleOf(grid, found.front().triangle)) +
         amount(" with a Courant number of %.3g", sizes.time_step_s / found.front().step_s) + ": a longer time step" +
         (sizes.least_m > 0.0 ? " or a smaller --size-min" : "") + " helps";
}

std::vector<std::string> warningsOf(const StepOutcome& outcome, const SizeOptions& sizes, QualityGoal goal,
                                    std::size_t small_waters, const std::string& of_repairs) {
  const std::vector<ShortStep>& below_step = outcome.below_step;
  const std::vector<ShortEdge>& below_least = outcome.below_least;
  std::vector<std::string> all;
  if (!below_step.empty()) {
    const ShortStep& worst = below_step.front();
    all.push_back("--time-step " + amount("%g", sizes.time_step_s) + " at --courant " + amount("%g", sizes.courant) +
                  " does not hold in " + std::to_string(below_step.size()) +
                  forCount(below_step.size(), " triangle, at ", " triangles, the worst at ") + pointText(worst.place) +
                  amount(" with %.3g s: ", worst.step_s * sizes.courant) + causesText(below_step, sizes, goal) +
                  smallWatersText(small_waters, "--time-step"));
  }
  if (!below_least.empty()) {
    all.push_back("edges shorter than " + amount("%g", StepOutcome::kUsualShare) + " times --size-min " +
                  amount("%g", sizes.least_m) + ": " + std::to_string(below_least.size()) + missedText(outcome, sizes) +
                  ", the shortest of " + amount("%.4g m at ", below_least.front().length_m) +
                  pointText(below_least.front().place) + ": " + causesText(below_least, sizes, goal) + of_repairs +
                  smallWatersText(small_waters, "--size-min"));
  }
  return all;
}

// What the shortest edge is at, if it is far shorter than those of a shore that follows the sizes, and lies between
// triangles of two features or of two regions: a border that stays as in the data. Empty if there is none.
std::string borderWarning(const Grid& grid, const StepReport& step, const SizeOptions& sizes) {
  constexpr double kFarShorter = 0.2, kNear = 3.0;  // of the shore's edges; in lengths of the shortest edge
  const double at_shores = sizes.atShores();
  if (sizes.coast != CoastDetail::Follow || grid.feature_of.empty() || !std::isfinite(at_shores)) return {};
  if (!(step.shortest_edge_m < kFarShorter * at_shores)) return {};
  const NearPlaces near(grid, step.shortest_edge, kNear * step.shortest_edge_m);
  const auto isNear = [&](std::uint32_t node) { return near(grid.nodes[node]); };
  const GridFeature* first = nullptr;
  bool at_region = false, at_feature = false;
  for (std::size_t t = 0; t < grid.triangles.size() && !at_feature; ++t) {
    if (std::ranges::none_of(grid.triangles[t], isNear)) continue;
    const GridFeature& feature = grid.features[grid.feature_of[t]];
    if (first == nullptr) first = &feature;
    at_feature = feature.fid != first->fid || feature.source != first->source;
    at_region = at_region || feature.region != first->region;
  }
  if (!at_feature && !at_region) return {};
  return "the shortest edge, " + amount("%.3g m at ", step.shortest_edge_m) + pointText(step.shortest_edge) +
         (at_feature ? ", is at a border that two features share, which stays as it is in the data: "
                       "--dissolve makes them one"
                     : ", is at the border of a region, which stays as it is in --regions: draw it so that it meets "
                       "shores, the frame and other borders at larger angles, or coarser");
}

// Edges with an end on a constraint or a weir that are far shorter than the sizes requested there.
struct ShortAtLines {
  std::size_t count = 0;
  // Of the edge that falls shortest of its size:
  Point place;  // its middle
  double length_m = 0.0, size_m = 0.0;
  std::uint32_t line = kNone;         // the index of the line
  std::vector<std::uint32_t> others;  // lines within a few lengths of the edge, ascending
  bool by_shore = false;              // the boundary is as near
};

struct ShortOne {
  NodePair edge;
  double length_m, share;
};

// The line of each node: the first constraint or weir that has it, or kNone.
std::vector<std::uint32_t> linesOfNodes(const Grid& grid) {
  std::vector<std::uint32_t> line_of(grid.nodes.size(), kNone);
  for (std::uint32_t i = 0; i < grid.lines.size(); ++i) {
    if (grid.lines[i].kind == LineKind::RegionBorder) continue;
    for (const std::uint32_t node : grid.lines[i].nodes) line_of[node] = std::min(line_of[node], i);
  }
  return line_of;
}

// What is within a few lengths of the edge besides its line.
void findCauses(const Grid& grid, const EdgeMeter& meter, const ShortOne& one, ShortAtLines& found) {
  constexpr double kNear = 3.0;  // lengths
  const auto isNear = [&](std::uint32_t node) {
    return std::min(meter.between(node, one.edge[0]), meter.between(node, one.edge[1])) <= kNear * one.length_m;
  };
  for (std::uint32_t i = 0; i < grid.lines.size(); ++i)
    if (i != found.line && std::ranges::any_of(grid.lines[i].nodes, isNear)) found.others.push_back(i);
  found.by_shore = std::ranges::any_of(
      grid.boundaries, [&](const Boundary& boundary) { return std::ranges::any_of(boundary.nodes, isNear); });
}

// Counts edges shorter than `share` of the sizes at both ends. `spared_m`: lengths from which on edges are not counted.
ShortAtLines shortAtLines(const Grid& grid, double share, double spared_m, const ItemLoop& loop) {
  ShortAtLines found;
  const auto isMeant = [](const GridLine& line) { return line.kind != LineKind::RegionBorder; };
  if (grid.size_m.empty() || std::ranges::none_of(grid.lines, isMeant)) return found;
  const std::vector<std::uint32_t> line_of = linesOfNodes(grid);
  const EdgeMeter meter(grid.nodes, grid.crs, loop);
  auto edges = joined(overStretches(loop, grid.triangles.size(), [&](std::size_t first, std::size_t last) {
    std::vector<ShortOne> some;
    for (std::size_t t = first; t < last; ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = grid.triangles[t][i], b = grid.triangles[t][(i + 1) % 3];
        if (line_of[a] == kNone && line_of[b] == kNone) continue;
        const double length = meter.between(a, b), size = std::min(grid.size_m[a], grid.size_m[b]);
        if (length < share * size && length < spared_m) some.push_back({edgeKey(a, b), length, length / size});
      }
    }
    return some;
  }));
  std::ranges::sort(edges, {}, &ShortOne::edge);
  const auto repeated = std::ranges::unique(edges, {}, &ShortOne::edge);
  edges.erase(repeated.begin(), repeated.end());
  if (edges.empty()) return found;
  found.count = edges.size();
  const ShortOne& worst = *std::ranges::min_element(edges, {}, &ShortOne::share);
  const auto& [a, b] = worst.edge;
  found.place = placeBetween(grid.crs, grid.nodes[a], grid.nodes[b], 0.5);
  found.length_m = worst.length_m;
  found.size_m = std::min(grid.size_m[a], grid.size_m[b]);
  found.line = std::min(line_of[a], line_of[b]);
  findCauses(grid, meter, worst, found);
  return found;
}

// The length of the shortest edge of the boundary; infinite if there is none.
double shortestAtBoundary(const Grid& grid, const ItemLoop& loop) {
  double shortest = std::numeric_limits<double>::infinity();
  const EdgeMeter meter(grid.nodes, grid.crs, loop);
  for (const Boundary& boundary : grid.boundaries)
    for (const auto& [a, b] : edgesOf(boundary)) shortest = std::min(shortest, meter.between(a, b));
  return shortest;
}

// "constraint 'dike'".
std::string lineText(const GridLine& line) {
  return std::string(toString(line.kind)) + (line.name.empty() ? " without a name" : " '" + line.name + "'");
}

// Where edges beside constraints and weirs are far shorter than the sizes, and why. With a coast as in the data, they
// are only named if they are far shorter than the shore's own edges. Empty if there are none.
std::string lineWarning(const Grid& grid, const SizeOptions& sizes, const ItemLoop& loop) {
  constexpr double kFarShorter = 0.2;  // of the size
  constexpr double kOfShore = 0.5;     // of the shore's shortest edge
  constexpr std::size_t kOthersShown = 3;
  if (!sizes.any() || grid.lines.empty()) return {};
  const double spared_m =
      sizes.coast == CoastDetail::Follow ? SizeOptions::kNone : kOfShore * shortestAtBoundary(grid, loop);
  const ShortAtLines found = shortAtLines(grid, kFarShorter, spared_m, loop);
  if (found.count == 0) return {};
  std::vector<std::string> others;
  for (const std::uint32_t line : found.others)
    if (std::string other = lineText(grid.lines[line]); std::ranges::find(others, other) == others.end())
      others.push_back(std::move(other));
  const std::string itself = lineText(grid.lines[found.line]);
  std::erase(others, itself);
  if (found.by_shore) others.insert(others.begin(), "the shore");
  std::string near;
  for (std::size_t i = 0; i < std::min(kOthersShown, others.size()); ++i) near += (i > 0 ? ", " : "") + others[i];
  return "edges at constraints or weirs that are shorter than " + amount("%g", kFarShorter) +
         " times the requested size: " + std::to_string(found.count) + ", the worst of " +
         amount("%.3g m instead of ", found.length_m) + amount("%.4g m at ", found.size_m) + pointText(found.place) +
         ", where " + itself +
         (near.empty() ? " turns sharply or has points close together" : " meets or comes close to " + near) +
         ": lines stay as they are in the data; wider angles and gaps, or longer segments, make longer edges";
}

// The share of the edges at the shore that are shorter than half of the requested size there; 0 if no sizes are known.
double shareOfFineShore(const Grid& grid, const ItemLoop& loop) {
  constexpr double kFine = 0.5;
  if (grid.size_m.empty()) return 0.0;
  const EdgeMeter meter(grid.nodes, grid.crs, loop);
  std::size_t edges = 0, fine = 0;
  for (const Boundary& boundary : grid.boundaries) {
    if (boundary.role != BoundaryRole::Land && boundary.role != BoundaryRole::Island) continue;
    for (const auto& [a, b] : edgesOf(boundary)) {
      ++edges;
      fine += meter.between(a, b) < kFine * std::min(grid.size_m[a], grid.size_m[b]);
    }
  }
  return edges == 0 ? 0.0 : static_cast<double>(fine) / static_cast<double>(edges);
}

}  // namespace

StepOutcome measureOutcome(const Grid& grid, const SizeOptions& sizes, const ItemLoop& loop, QualityGoal goal,
                           std::size_t small_waters, std::span<const Repair> repairs) {
  StepOutcome outcome;
  outcome.step = measureStep(grid, loop);
  if (sizes.time_step_s > 0.0) outcome.below_step = stepsBelow(grid, sizes.time_step_s, sizes.courant, loop);
  if (sizes.least_m > 0.0 && sizes.any())
    outcome.below_least = edgesBelow(grid, StepOutcome::kUsualShare * sizes.least_m, loop);
  outcome.least_missed = sizes.coast == CoastDetail::Follow && !outcome.below_least.empty() &&
                         outcome.below_least.front().length_m < StepOutcome::kShareOfLeast * sizes.least_m;
  outcome.warnings =
      warningsOf(outcome, sizes, goal, small_waters, ofRepairsText(grid, outcome.below_least, sizes.least_m, repairs));
  if (sizes.depth.crossing_s > 0.0)
    outcome.above_step = stepsAbove(grid, sizes.time_step_s, sizes.least_courant, sizes.depth.least_depth_m, loop);
  if (!outcome.above_step.empty()) outcome.warnings.push_back(courantText(outcome, grid, sizes));
  if (std::string warning = borderWarning(grid, outcome.step, sizes); !warning.empty())
    outcome.warnings.push_back(std::move(warning));
  if (std::string warning = lineWarning(grid, sizes, loop); !warning.empty())
    outcome.warnings.push_back(std::move(warning));
  constexpr double kUsualFine = 0.25;  // some edges are always divided for the sake of angles
  if (sizes.coast == CoastDetail::Keep && sizes.any())
    if (const double fine = shareOfFineShore(grid, loop); fine > kUsualFine)
      outcome.notes.push_back("the coast is finer than the sizes: " + amount("%.0f %%", 100.0 * fine) +
                              " of the edges at the shore are shorter than half of the size there; --coast follow "
                              "makes the coast as coarse as the sizes");
  return outcome;
}

std::string stepText(const StepReport& step, bool plane, const std::vector<std::string>& targets) {
  std::string text =
      amount("shortest edge %.4g", step.shortest_edge_m) + (plane ? " at " : " m at ") + pointText(step.shortest_edge);
  if (!targets.empty() && std::ranges::none_of(targetsNamed(targets), isOfLongWaves)) return text;
  if (!step.has_depths) return text + "; without depths there is no time step";
  if (!std::isfinite(step.step_s)) return text + "; nothing is under water, so there is no time step";
  text += "; time step by CFL " + atMost(step.step_s) + " s at " + pointText(step.step_place);
  if (step.flood_m == 0.0) return text;
  return text + amount("; with the water %.3g m higher,", step.flood_m) + " over most of the land, " +
         atMost(step.flooded_step_s) + " s at " + pointText(step.flooded_place);
}

}  // namespace coastmesh
