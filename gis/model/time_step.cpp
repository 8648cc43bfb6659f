#include "gis/model/time_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "gis/crs/geodesy.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "gis/long_wave.hpp"

namespace coastmesh {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double stepOf(double shortest_m, double depth_m) {
  if (std::isnan(depth_m)) return depth_m;
  return depth_m > 0.0 ? shortest_m / longWaveSpeed(depth_m) : kInfinity;
}

// The edges of the boundary, and the nodes that it or a line keeps in place.
class HeldEdges {
 public:
  HeldEdges(const Grid& grid, const ItemLoop& loop)
      : on_shore_(grid.nodes.size(), false), on_line_(grid.nodes.size(), false) {
    edges_ = joined(overStretches(loop, grid.triangles.size(), [&](std::size_t first, std::size_t last) {
      std::vector<NodePair> some;
      for (std::size_t t = first; t < last; ++t) {
        const auto& [a, b, c] = grid.triangles[t];
        for (const auto& [from, to] : {NodePair{a, b}, NodePair{b, c}, NodePair{c, a}})
          some.push_back({std::min(from, to), std::max(from, to)});
      }
      return some;
    }));
    sortOn(loop, edges_);
    std::vector<NodePair> boundary;  // edges of only one triangle
    for (std::size_t i = 0, end = 0; i < edges_.size(); i = end) {
      for (end = i; end < edges_.size() && edges_[end] == edges_[i];) ++end;
      if (end - i == 1) boundary.push_back(edges_[i]);
    }
    edges_ = std::move(boundary);
    for (const Boundary& each : grid.boundaries) {
      if (each.role != BoundaryRole::Open && each.role != BoundaryRole::River) continue;
      for (const auto& [a, b] : edgesOf(each)) openings_.push_back({std::min(a, b), std::max(a, b)});
    }
    std::ranges::sort(openings_);
    for (const NodePair& edge : edges_)
      if (!std::ranges::binary_search(openings_, edge)) on_shore_[edge[0]] = on_shore_[edge[1]] = true;
    for (const GridLine& line : grid.lines)
      for (const std::uint32_t node : line.nodes) on_line_[node] = true;
  }

  ShortCause causeOf(std::uint32_t a, std::uint32_t b) const {
    const NodePair edge{std::min(a, b), std::max(a, b)};
    if (std::ranges::binary_search(openings_, edge)) return ShortCause::Opening;
    if (std::ranges::binary_search(edges_, edge)) return ShortCause::Shore;
    if (on_shore_[a] && on_shore_[b]) return ShortCause::Narrow;
    return on_line_[a] || on_line_[b] ? ShortCause::Line : ShortCause::Interior;
  }

 private:
  std::vector<NodePair> edges_, openings_;  // the lesser node first
  std::vector<bool> on_shore_, on_line_;
};

// The cause of edges of the triangle shorter than `least_m`; of several causes the first in the order of ShortCause.
ShortCause causeIn(const Grid& grid, const HeldEdges& held, const std::array<double, 3>& lengths, std::uint32_t t,
                   double least_m) {
  ShortCause cause = ShortCause::Interior;
  for (std::size_t i = 0; i < 3; ++i)
    if (lengths[i] < least_m)
      cause = std::min(cause, held.causeOf(grid.triangles[t][i], grid.triangles[t][(i + 1) % 3]));
  return cause;
}

// The height that most land nodes do not exceed, if enough nodes are land for a flood plain, and floods reach it.
double floodHeight(const Grid& grid) {
  constexpr double kLeastShare = 0.01, kMost = 50.0;  // of the nodes; metres
  constexpr double kOfLand = 0.95;                    // single nodes may stand out
  std::vector<double> heights;
  std::ranges::copy_if(grid.z, std::back_inserter(heights), [](double z) { return z > 0.0; });
  const double count = static_cast<double>(heights.size());
  if (heights.empty() || count < kLeastShare * static_cast<double>(grid.z.size())) return 0.0;
  const auto most = heights.begin() + static_cast<std::ptrdiff_t>(kOfLand * (count - 1.0));
  std::ranges::nth_element(heights, most);
  return *most <= kMost ? *most : 0.0;
}

// The first of the shortest edges and time steps, in whatever order stretches are processed.
struct Shortest {
  double length = kInfinity, step = kInfinity, flooded_step = kInfinity;
  std::size_t of_length = 0, of_step = 0, of_flooded = 0;  // triangles
  bool has_depths = false;

  static void take(double value, std::size_t triangle, double& least, std::size_t& of) {
    if (value < least) least = value, of = triangle;
  }
  void add(const Shortest& later) {
    take(later.length, later.of_length, length, of_length);
    take(later.step, later.of_step, step, of_step);
    take(later.flooded_step, later.of_flooded, flooded_step, of_flooded);
    has_depths = has_depths || later.has_depths;
  }
};

}  // namespace

double deepestOf(const Grid& grid, std::uint32_t t) {
  if (grid.z.empty()) return std::numeric_limits<double>::quiet_NaN();
  double deepest = std::numeric_limits<double>::quiet_NaN();
  for (const std::uint32_t node : grid.triangles[t]) deepest = std::fmax(deepest, 0.0 - grid.z[node]);
  return deepest;
}

std::vector<double> timeSteps(const Grid& grid, const ItemLoop& loop) {
  const EdgeMeter meter(grid.nodes, grid.crs, loop);
  std::vector<double> steps(grid.triangles.size());
  forEachByStretches(loop, steps.size(), [&](std::size_t t) {
    steps[t] = stepOf(meter.shortestOf(grid.triangles[t]), deepestOf(grid, static_cast<std::uint32_t>(t)));
  });
  return steps;
}

StepReport measureStep(const Grid& grid, const ItemLoop& loop) {
  StepReport report;
  if (grid.triangles.empty()) return report;
  const double flood = floodHeight(grid);
  const EdgeMeter meter(grid.nodes, grid.crs, loop);
  Shortest all;
  for (const Shortest& one : overStretches(loop, grid.triangles.size(), [&](std::size_t first, std::size_t last) {
         Shortest some;
         for (std::size_t t = first; t < last; ++t) {
           const double length = meter.shortestOf(grid.triangles[t]);
           const double depth = deepestOf(grid, static_cast<std::uint32_t>(t));
           Shortest::take(length, t, some.length, some.of_length);
           Shortest::take(stepOf(length, depth), t, some.step, some.of_step);
           if (flood > 0.0) Shortest::take(stepOf(length, depth + flood), t, some.flooded_step, some.of_flooded);
           some.has_depths = some.has_depths || !std::isnan(depth);
         }
         return some;
       }))
    all.add(one);
  report.shortest_edge_m = all.length;
  if (all.length < kInfinity) {
    const auto& corners = grid.triangles[all.of_length];
    const std::array<double, 3> lengths = meter.of(corners);
    const auto i = static_cast<std::size_t>(std::ranges::min_element(lengths) - lengths.begin());
    report.shortest_edge = placeBetween(grid.crs, grid.nodes[corners[i]], grid.nodes[corners[(i + 1) % 3]], 0.5);
  }
  report.has_depths = all.has_depths;
  report.step_s = all.step;
  if (all.step < kInfinity) report.step_place = middleOf(grid, static_cast<std::uint32_t>(all.of_step));
  if (flood == 0.0 || all.step == kInfinity) return report;
  report.flood_m = flood;
  report.flooded_step_s = all.flooded_step;
  report.flooded_place = middleOf(grid, static_cast<std::uint32_t>(all.of_flooded));
  return report;
}

std::string_view toString(ShortCause cause) {
  constexpr std::array<std::string_view, kShortCauses> kNames{"shore", "opening", "narrow", "line", "interior"};
  return kNames[static_cast<std::size_t>(cause)];
}

std::vector<ShortStep> stepsBelow(const Grid& grid, double time_step_s, double courant, const ItemLoop& loop) {
  const EdgeMeter meter(grid.nodes, grid.crs, loop);
  std::vector<ShortStep> found =
      joined(overStretches(loop, grid.triangles.size(), [&](std::size_t first, std::size_t last) {
        std::vector<ShortStep> some;
        for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
          const double depth = deepestOf(grid, t), step = stepOf(meter.shortestOf(grid.triangles[t]), depth);
          if (time_step_s > courant * step)
            some.push_back({t, middleOf(grid, t), step, time_step_s / courant * longWaveSpeed(depth)});
        }
        return some;
      }));
  if (found.empty()) return found;
  const HeldEdges held(grid, loop);
  for (ShortStep& each : found)
    each.cause = causeIn(grid, held, meter.of(grid.triangles[each.triangle]), each.triangle, each.needed_m);
  std::ranges::stable_sort(found, {}, &ShortStep::step_s);
  return found;
}

std::vector<LongStep> stepsAbove(const Grid& grid, double time_step_s, double courant, double least_depth_m,
                                 const ItemLoop& loop) {
  const EdgeMeter meter(grid.nodes, grid.crs, loop);
  std::vector<LongStep> found =
      joined(overStretches(loop, grid.triangles.size(), [&](std::size_t first, std::size_t last) {
        std::vector<LongStep> some;
        for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
          const double depth = deepestOf(grid, t), step = stepOf(meter.shortestOf(grid.triangles[t]), depth);
          if (depth >= least_depth_m && time_step_s < courant * step) some.push_back({t, step});
        }
        return some;
      }));
  std::ranges::stable_sort(found, std::ranges::greater{}, &LongStep::step_s);
  return found;
}

std::vector<ShortEdge> edgesBelow(const Grid& grid, double least_m, const ItemLoop& loop) {
  const EdgeMeter meter(grid.nodes, grid.crs, loop);
  auto edges = joined(overStretches(loop, grid.triangles.size(), [&](std::size_t first, std::size_t last) {
    std::vector<std::pair<NodePair, double>> some;
    for (std::size_t t = first; t < last; ++t) {
      if (!(meter.shortestOf(grid.triangles[t]) < least_m)) continue;
      const std::array<double, 3> lengths = meter.of(grid.triangles[t]);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = grid.triangles[t][i], b = grid.triangles[t][(i + 1) % 3];
        if (lengths[i] < least_m) some.push_back({{std::min(a, b), std::max(a, b)}, lengths[i]});
      }
    }
    return some;
  }));
  std::ranges::sort(edges);
  const auto repeated = std::ranges::unique(edges, {}, &std::pair<NodePair, double>::first);
  edges.erase(repeated.begin(), repeated.end());
  std::vector<ShortEdge> found;
  if (edges.empty()) return found;
  const HeldEdges held(grid, loop);
  for (const auto& [nodes, length] : edges)
    found.push_back({placeBetween(grid.crs, grid.nodes[nodes[0]], grid.nodes[nodes[1]], 0.5), length,
                     held.causeOf(nodes[0], nodes[1])});
  std::ranges::stable_sort(found, {}, &ShortEdge::length_m);
  return found;
}

}  // namespace coastmesh
