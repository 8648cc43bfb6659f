#include "gis/grid/wind_triangles.hpp"

#include <algorithm>
#include <utility>

#include "core/ids.hpp"
#include "gis/grid/ground_orientation.hpp"

namespace coastmesh {

namespace {

using Corners = std::array<std::uint32_t, 3>;

// The other triangle at an edge, and whether both list the edge in the same direction.
struct Neighbour {
  std::uint32_t triangle = kNone;
  bool same_direction = false;
};

// The neighbour at each side of each triangle; none at edges of one triangle, or of more than two.
std::vector<std::array<Neighbour, 3>> neighboursOf(std::span<const Corners> triangles) {
  struct Side {
    std::uint32_t low, high, triangle;
    std::uint8_t index;
    bool ascends;
  };
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint8_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3];
      if (a != b) sides.push_back({std::min(a, b), std::max(a, b), t, i, a < b});
    }
  }
  const auto edge = [](const Side& side) { return std::pair{side.low, side.high}; };
  std::ranges::stable_sort(sides, {}, edge);
  std::vector<std::array<Neighbour, 3>> neighbours(triangles.size());
  for (std::size_t first = 0, end = 0; first < sides.size(); first = end) {
    while (end < sides.size() && edge(sides[end]) == edge(sides[first])) ++end;
    if (end - first != 2) continue;
    const Side &s = sides[first], &t = sides[first + 1];
    neighbours[s.triangle][s.index] = {t.triangle, s.ascends == t.ascends};
    neighbours[t.triangle][t.index] = {s.triangle, s.ascends == t.ascends};
  }
  return neighbours;
}

}  // namespace

void windTriangles(std::span<const Point> nodes, const Crs& crs, const std::vector<bool>& wound,
                   std::span<Corners> triangles) {
  if (std::ranges::all_of(wound, std::identity())) return;
  const std::vector<std::array<Neighbour, 3>> neighbours = neighboursOf(triangles);
  std::vector<bool> seen = wound, turned(triangles.size(), false);
  std::vector<std::uint32_t> part;
  // Adds to `part` all triangles connected to it.
  const auto spread = [&] {
    for (std::size_t k = 0; k < part.size(); ++k) {
      for (const Neighbour& next : neighbours[part[k]]) {
        if (next.triangle == kNone || seen[next.triangle]) continue;
        seen[next.triangle] = true;
        turned[next.triangle] = turned[part[k]] != next.same_direction;
        part.push_back(next.triangle);
      }
    }
  };
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (wound[t]) part.push_back(t);
  spread();
  for (std::uint32_t first = 0; first < triangles.size(); ++first) {
    if (seen[first]) continue;
    seen[first] = true;
    part = {first};
    spread();
    std::int64_t balance = 0;
    for (const std::uint32_t t : part) {
      const auto& [a, b, c] = triangles[t];
      const int orientation = orientationOnGround(nodes[a], nodes[b], nodes[c], crs);
      balance += turned[t] ? -orientation : orientation;
    }
    if (balance >= 0) continue;
    for (const std::uint32_t t : part) turned[t] = !turned[t];
  }
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (turned[t]) std::swap(triangles[t][1], triangles[t][2]);
}

}  // namespace coastmesh
