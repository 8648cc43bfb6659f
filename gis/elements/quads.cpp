#include "gis/elements/quads.hpp"

#include <algorithm>
#include <optional>

#include "core/predicates.hpp"
#include "core/quality.hpp"
#include "gis/grid/local_plane.hpp"

namespace coastmesh {
namespace {

using Corners = std::array<std::uint32_t, 3>;

constexpr double kSameAngleDeg = 1e-6;  // rounding must not choose between the diagonals of a rectangle

std::uint32_t numbersOf(const Grid& grid) {
  std::uint32_t numbers = 0;
  for (const std::uint32_t quad : grid.quad_of)
    if (quad != kNone) numbers = std::max(numbers, quad + 1);
  return numbers;
}

std::optional<Quad> quadOf(const Grid& grid, std::uint32_t first, std::uint32_t second) {
  const Corners &v = grid.triangles[first], &w = grid.triangles[second];
  for (unsigned i = 0; i < 3; ++i)
    for (unsigned k = 0; k < 3; ++k) {
      if (v[i] != w[(k + 1) % 3] || v[(i + 1) % 3] != w[k]) continue;
      const std::uint32_t across = w[(k + 2) % 3];
      if (across == v[(i + 2) % 3]) return std::nullopt;
      Quad quad{{first, second}, {}};
      for (unsigned from = 0, to = 0; from < 3; ++from) {
        quad.nodes[to++] = v[from];
        if (from == i) quad.nodes[to++] = across;
      }
      return quad;
    }
  return std::nullopt;
}

// The smallest angle of both halves, in degrees; less than 0 if they differ in direction, or one is flat.
double leastAngle(const std::array<Point, 4>& p, bool from_first) {
  const std::array<std::array<Point, 3>, 2> halves{
      from_first ? std::array{p[0], p[1], p[2]} : std::array{p[0], p[1], p[3]},
      from_first ? std::array{p[0], p[2], p[3]} : std::array{p[1], p[2], p[3]}};
  const int turn = orient2d(halves[0][0], halves[0][1], halves[0][2]);
  if (turn == 0 || turn != orient2d(halves[1][0], halves[1][1], halves[1][2])) return -1.0;
  return std::min(leastAngleDeg(halves[0][0], halves[0][1], halves[0][2]),
                  leastAngleDeg(halves[1][0], halves[1][1], halves[1][2]));
}

void addTriangle(Grid& grid, const Corners& corners, std::uint32_t quad) {
  grid.triangles.push_back(corners);
  if (quad != kNone || !grid.quad_of.empty()) grid.quad_of.push_back(quad);
}

}  // namespace

std::vector<Quad> quadsOf(const Grid& grid) {
  std::vector<Quad> quads;
  std::vector<std::uint32_t> first_of(numbersOf(grid), kNone), count(first_of.size(), 0);
  for (const std::uint32_t quad : grid.quad_of)
    if (quad != kNone) ++count[quad];
  for (std::uint32_t t = 0; t < grid.quad_of.size(); ++t) {
    const std::uint32_t number = grid.quad_of[t];
    if (number == kNone || count[number] != 2) continue;
    if (first_of[number] == kNone) {
      first_of[number] = t;
    } else if (const auto quad = quadOf(grid, first_of[number], t)) {
      quads.push_back(*quad);
    }
  }
  std::ranges::sort(quads, {}, [](const Quad& quad) { return quad.halves[0]; });
  return quads;
}

void addElement(Grid& grid, std::span<const std::uint32_t> nodes) {
  if (nodes.size() == 3 || nodes[3] == nodes[2] || nodes[3] == nodes[0])
    return addTriangle(grid, {nodes[0], nodes[1], nodes[2]}, kNone);
  const std::array<Point, 4> places = localPlane(grid, std::array{nodes[0], nodes[1], nodes[2], nodes[3]});
  const bool from_first = leastAngle(places, true) >= leastAngle(places, false) - kSameAngleDeg;
  if (grid.quad_of.empty()) grid.quad_of.assign(grid.triangles.size(), kNone);
  const auto number = static_cast<std::uint32_t>(grid.triangles.size());  // unique, as elements are only appended
  if (from_first) {
    addTriangle(grid, {nodes[0], nodes[1], nodes[2]}, number);
    addTriangle(grid, {nodes[0], nodes[2], nodes[3]}, number);
  } else {
    addTriangle(grid, {nodes[0], nodes[1], nodes[3]}, number);
    addTriangle(grid, {nodes[1], nodes[2], nodes[3]}, number);
  }
}

std::vector<std::uint8_t> diagonalsOf(const Grid& grid) {
  std::vector<std::uint8_t> side;
  for (const Quad& quad : quadsOf(grid)) {
    if (side.empty()) side.assign(grid.triangles.size(), kNoDiagonal);
    const Corners &v = grid.triangles[quad.halves[0]], &w = grid.triangles[quad.halves[1]];
    const auto sideOf = [](const Corners& corners, const Corners& other) {
      std::uint8_t i = 0;  // the corner that the other half does not have
      while (std::ranges::count(other, corners[i]) > 0) ++i;
      return i;
    };
    side[quad.halves[0]] = sideOf(v, w);
    side[quad.halves[1]] = sideOf(w, v);
  }
  return side;
}

std::vector<NodePair> diagonalEdges(const Grid& grid) {
  std::vector<NodePair> edges;
  const std::vector<std::uint8_t> diagonals = diagonalsOf(grid);
  for (std::uint32_t t = 0; t < diagonals.size(); ++t) {
    if (diagonals[t] == kNoDiagonal) continue;
    const std::uint32_t from = grid.triangles[t][next3(diagonals[t])], to = grid.triangles[t][prev3(diagonals[t])];
    if (from < to) edges.push_back({from, to});  // the other half has it from `to`
  }
  std::ranges::sort(edges);
  return edges;
}

std::vector<NodePair> edgesOfQuads(const Grid& grid) {
  std::vector<NodePair> edges;
  for (const Quad& quad : quadsOf(grid))
    for (const std::uint32_t t : quad.halves)
      for (unsigned i = 0; i < 3; ++i) edges.push_back(edgeKey(grid.triangles[t][i], grid.triangles[t][(i + 1) % 3]));
  std::ranges::sort(edges);
  const auto repeated = std::ranges::unique(edges);
  edges.erase(repeated.begin(), repeated.end());
  return edges;
}

std::array<double, 4> anglesOf(const Grid& grid, const Quad& quad) {
  const std::array<Point, 4> places = localPlane(grid, quad.nodes);
  std::array<double, 4> angles{};
  // Those of both halves together: at the ends of the diagonal they add up.
  for (const std::uint32_t t : quad.halves) {
    std::array<std::size_t, 3> at;
    for (unsigned i = 0; i < 3; ++i)
      at[i] = static_cast<std::size_t>(std::ranges::find(quad.nodes, grid.triangles[t][i]) - quad.nodes.begin());
    const std::array<double, 3> of_half =
        spaceAnglesDeg({places[at[0]].x, places[at[0]].y, 0.0}, {places[at[1]].x, places[at[1]].y, 0.0},
                       {places[at[2]].x, places[at[2]].y, 0.0});
    for (unsigned i = 0; i < 3; ++i) angles[at[i]] += of_half[i];
  }
  return angles;
}

std::vector<std::uint32_t> otherHalves(const Grid& grid) {
  std::vector<std::uint32_t> other;
  for (const Quad& quad : quadsOf(grid)) {
    if (other.empty()) other.assign(grid.triangles.size(), kNone);
    other[quad.halves[0]] = quad.halves[1];
    other[quad.halves[1]] = quad.halves[0];
  }
  return other;
}

void includeOtherHalves(const Grid& grid, std::vector<std::uint8_t>& chosen) {
  for (const Quad& quad : quadsOf(grid))
    if (chosen[quad.halves[0]] != 0 || chosen[quad.halves[1]] != 0) chosen[quad.halves[0]] = chosen[quad.halves[1]] = 1;
}

Grid trianglesOnly(const Grid& grid) {
  Grid rest;
  rest.crs = grid.crs;
  rest.nodes = grid.nodes;
  const std::vector<std::uint32_t> other = otherHalves(grid);
  for (std::size_t t = 0; t < grid.triangles.size(); ++t)
    if (other.empty() || other[t] == kNone) rest.triangles.push_back(grid.triangles[t]);
  return rest;
}

}  // namespace coastmesh
