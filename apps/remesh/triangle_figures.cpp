#include "apps/remesh/triangle_figures.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "core/metric.hpp"
#include "core/quality.hpp"
#include "gis/elements/quads.hpp"
#include "gis/grid/local_plane.hpp"

namespace coastmesh {

namespace {

// The finaliser of splitmix64.
std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9U;
  bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebU;
  return bits ^ (bits >> 31U);
}

// The same for any order of the corners.
std::uint64_t keyOf(const Grid& grid, std::size_t triangle) {
  std::uint64_t key = 0;
  for (const std::uint32_t node : grid.triangles[triangle]) {
    const Point& p = grid.nodes[node];
    key += mixed(mixed(std::bit_cast<std::uint64_t>(p.x)) + std::bit_cast<std::uint64_t>(p.y));
  }
  return mixed(key);
}

TriangleFigures figuresOfOne(const std::array<Point, 3>& corners) {
  const auto& [a, b, c] = corners;
  return {1, leastAngleDeg(a, b, c), std::min({distance(a, b), distance(b, c), distance(c, a)}),
          std::max({distance(a, b), distance(b, c), distance(c, a)})};
}

}  // namespace

void TriangleFigures::add(const TriangleFigures& other) {
  triangles += other.triangles;
  min_angle_deg = std::min(min_angle_deg, other.min_angle_deg);
  shortest_m = std::min(shortest_m, other.shortest_m);
  longest_m = std::max(longest_m, other.longest_m);
}

TriangleFigures figuresOf(const Grid& grid, const ItemLoop& loop, const IsWanted& isWanted) {
  TriangleFigures all;
  for (const TriangleFigures& some :
       overStretches(loop, grid.triangles.size(), [&](std::size_t first, std::size_t last) {
         TriangleFigures figures;
         for (std::size_t t = first; t < last; ++t)
           if (isWanted(t)) figures.add(figuresOfOne(localPlane(grid, grid.triangles[t])));
         return figures;
       }))
    all.add(some);
  return all;
}

PlacedTriangles::PlacedTriangles(const Grid& grid, const ItemLoop& loop, const IsWanted& isWanted)
    : keys_(joined(overStretches(loop, grid.triangles.size(), [&](std::size_t first, std::size_t last) {
        std::vector<std::uint64_t> some;
        for (std::size_t t = first; t < last; ++t)
          if (isWanted(t)) some.push_back(keyOf(grid, t));
        return some;
      }))) {
  sortOn(loop, keys_);
}

bool PlacedTriangles::has(const Grid& grid, std::size_t triangle) const {
  return std::ranges::binary_search(keys_, keyOf(grid, triangle));
}

LastingFigures::LastingFigures(const TriangleFigures& now, bool may_change, const Grid& grid, const ItemLoop& loop,
                               const IsWanted& isWanted)
    : now_(now), loop_(loop) {
  if (may_change) placed_ = std::make_shared<const PlacedTriangles>(grid, loop, isWanted);
}

TriangleFigures LastingFigures::in(const Grid& grid) const {
  return placed_ ? figuresOf(grid, loop_, [&](std::size_t t) { return placed_->has(grid, t); }) : now_;
}

BeforeRepairs::BeforeRepairs(const Grid& grid, bool may_change, const ItemLoop& loop) : loop_(loop) {
  if (may_change) placed_ = std::make_shared<const PlacedTriangles>(grid, loop, [](std::size_t) { return true; });
}

RepairedTriangles BeforeRepairs::repairedIn(const Grid& grid, double min_angle_deg, double max_angle_deg) const {
  if (!placed_) return {};
  const std::vector<std::uint32_t> other_half = otherHalves(grid);
  RepairedTriangles all;
  for (const RepairedTriangles& some :
       overStretches(loop_, grid.triangles.size(), [&](std::size_t first, std::size_t last) {
         RepairedTriangles repaired;
         for (std::size_t t = first; t < last; ++t) {
           if ((!other_half.empty() && other_half[t] != kNone) || placed_->has(grid, t)) continue;
           const std::array<Point, 3> corners = localPlane(grid, grid.triangles[t]);
           const TriangleFigures figures = figuresOfOne(corners);
           repaired.figures.add(figures);
           const double largest = std::ranges::max(anglesDeg(corners[0], corners[1], corners[2]));
           if (figures.min_angle_deg >= min_angle_deg - kAngleSlackDeg && largest <= max_angle_deg + kAngleSlackDeg)
             continue;
           if (repaired.below++ == 0 || figures.min_angle_deg < repaired.worst.min_angle_deg)
             repaired.worst = {grid.nodes[grid.triangles[t][0]], figures.min_angle_deg, largest};
         }
         return repaired;
       })) {
    all.figures.add(some.figures);
    if (some.below > 0 && (all.below == 0 || some.worst.min_angle_deg < all.worst.min_angle_deg))
      all.worst = some.worst;
    all.below += some.below;
  }
  return all;
}

}  // namespace coastmesh
