#include "gis/weirs/weir_gaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "core/quality.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/local_plane.hpp"

namespace coastmesh {
namespace {

constexpr double kShare = 0.02, kMostShare = 0.1;  // of the shortest edge at the node
constexpr double kLeast = 0.5, kMost = 10.0;       // metres

// A move `share` of the way towards a place.
struct Move {
  Point towards;
  double share = 0.0;
};

double lengthOf(const Point& p) { return std::sqrt(squaredLength(p)); }

// The corners of the sector's triangles across the node, counter-clockwise from its first.
std::vector<Point> rimOf(const Grid& grid, const NodeSector& sector, std::uint32_t node) {
  std::vector<Point> rim;
  for (const std::uint32_t t : sector.triangles) {
    const GridCorners& v = grid.triangles[t];
    const auto at = static_cast<std::size_t>(std::ranges::find(v, node) - v.begin());
    rim.push_back(grid.nodes[v[(at + 1) % 3]]);
    if (t == sector.triangles.back()) rim.push_back(grid.nodes[v[(at + 2) % 3]]);
  }
  return rim;
}

// The same in a plane around the node.
std::vector<Point> aroundNode(const Grid& grid, std::uint32_t node, std::span<const Point> rim) {
  std::vector<Point> places{grid.nodes[node]};
  places.insert(places.end(), rim.begin(), rim.end());
  places = localPlane(grid.crs, places);
  std::vector<Point> around;
  for (std::size_t i = 1; i < places.size(); ++i) around.push_back(places[i] - places[0]);
  return around;
}

// Into the middle of the sector by `distance`.
Move intoMiddle(const Grid& grid, std::span<const Point> rim, std::span<const Point> around, double distance) {
  const auto turn = [](const Point& a, const Point& b) { return std::atan2(cross(a, b), dot(a, b)); };
  double whole = 0.0;
  for (std::size_t i = 1; i < around.size(); ++i) whole += turn(around[i - 1], around[i]);
  double left = 0.5 * whole;
  std::size_t i = 1;
  for (; i + 1 < around.size(); ++i) {
    const double angle = turn(around[i - 1], around[i]);
    if (angle >= left) break;
    left -= angle;
  }
  const Point &a = around[i - 1], &b = around[i];
  const Point direction = (1.0 / lengthOf(a)) * Point{a.x * std::cos(left) - a.y * std::sin(left),
                                                      a.x * std::sin(left) + a.y * std::cos(left)};
  // Where the ray meets the side from a to b.
  const double along = cross(a, direction) / cross(direction, b - a);
  const double reach = cross(a, b) / cross(direction, b - a);
  return {placeBetween(grid.crs, rim[i - 1], rim[i], along), distance / reach};
}

Move moveOf(const Grid& grid, const NodeSector& sector, std::span<const Point> rim, std::span<const Point> around,
            double distance) {
  if (sector.first_is_cut == sector.last_is_cut) return intoMiddle(grid, rim, around, distance);
  const std::size_t shore = sector.first_is_cut ? around.size() - 1 : 0;
  return {rim[shore], distance / lengthOf(around[shore])};
}

// Degrees; negative if a triangle is not counter-clockwise.
double leastAngle(const Grid& grid, std::span<const std::uint32_t> triangles) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t t : triangles) {
    const auto [a, b, c] = localPlane(grid, grid.triangles[t]);
    if (orient2d(a, b, c) <= 0) return -1.0;
    least = std::min(least, leastAngleDeg(a, b, c));
  }
  return least;
}

// Moves the node by the largest of a few parts of the move that keeps the angles. Returns that part, 0 if none does.
double moveBy(Grid& grid, std::uint32_t node, std::span<const std::uint32_t> triangles, const Move& move,
              double bound_deg, std::span<const double> parts) {
  const Point before = grid.nodes[node];
  for (const double part : parts) {
    grid.nodes[node] = placeBetween(grid.crs, before, move.towards, part * move.share);
    if (leastAngle(grid, triangles) >= bound_deg) return part;
  }
  grid.nodes[node] = before;
  return 0.0;
}

double shortestOf(const std::vector<std::vector<Point>>& around) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const std::vector<Point>& sector : around)
    for (const Point& p : sector) shortest = std::min(shortest, lengthOf(p));
  return shortest;
}

}  // namespace

void moveApart(Grid& grid, std::span<const NodeSector> sectors, std::span<const std::uint32_t> nodes,
               double min_angle_deg, WeirGaps& gaps) {
  constexpr std::array kParts{1.0, 0.5, 0.25}, kFewParts{0.25, 0.05, 0.01};
  std::vector<std::vector<Point>> rims, around;
  for (std::size_t s = 0; s < sectors.size(); ++s) {
    rims.push_back(rimOf(grid, sectors[s], nodes[s]));
    around.push_back(aroundNode(grid, nodes[s], rims.back()));
  }
  const double shortest = shortestOf(around);
  const double gap = std::min(std::clamp(kShare * shortest, kLeast, kMost), kMostShare * shortest);
  std::vector<Move> moves;
  for (std::size_t s = 0; s < sectors.size(); ++s)
    moves.push_back(moveOf(grid, sectors[s], rims[s], around[s], 0.5 * gap));
  std::vector<double> moved;
  for (std::size_t s = 0; s < sectors.size(); ++s) {
    const double bound = std::min(min_angle_deg, leastAngle(grid, sectors[s].triangles));
    moved.push_back(moveBy(grid, nodes[s], sectors[s].triangles, moves[s], bound, kParts));
  }
  // No two stay at one place, whatever the angles.
  for (std::size_t s = 0, still = 0; s < sectors.size(); ++s)
    if (moved[s] == 0.0 && still++ > 0)
      moved[s] = moveBy(grid, nodes[s], sectors[s].triangles, moves[s], 0.0, kFewParts);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < sectors.size(); ++s)
    least = std::min(least, 0.5 * gap * (moved[s] + moved[(s + 1) % sectors.size()]));
  gaps.least = gaps.most > 0.0 ? std::min(gaps.least, least) : least;
  gaps.most = std::max(gaps.most, least);
}

}  // namespace coastmesh
