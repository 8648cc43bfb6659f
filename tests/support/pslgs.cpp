#include "tests/support/pslgs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/metric.hpp"
#include "tests/support/pslg_parts.hpp"

namespace coastmesh {

namespace {

std::vector<Point> box(double x, double y, double side) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

void addRandomPoints(Pslg& pslg, std::mt19937_64& random, int n) {
  for (int i = 0; i < n; ++i) {
    const double x = uniform(random, 0.01, 0.99);
    addPoint(pslg, {x, uniform(random, 0.01, 0.99)});
  }
}

// A hexagon with subdivided edges. Every edge stays in the rhombus of half angle 30° around it: the rhombi of the four
// edges that replace it lie inside and apart from one another if the tip is within 0.2 of the base. So no two edges
// meet.
std::vector<Point> fractalRing(std::mt19937_64& random, const Point& centre, double radius, int levels) {
  constexpr double kHighestTip = 0.2;
  std::vector<Point> ring;
  for (int i = 0; i < 6; ++i) {
    const double at = toRadians(60.0 * i + 7.0);
    ring.push_back(centre + radius * Point{std::cos(at), std::sin(at)});
  }
  for (int level = 0; level < levels; ++level) {
    std::vector<Point> finer;
    finer.reserve(4 * ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i], d = ring[(i + 1) % ring.size()] - a;
      const double tip = uniform(random, -kHighestTip, kHighestTip);
      finer.push_back(a);
      finer.push_back(a + (1.0 / 3.0) * d);
      finer.push_back(a + 0.5 * d + tip * Point{-d.y, d.x});
      finer.push_back(a + (2.0 / 3.0) * d);
    }
    ring = std::move(finer);
  }
  return ring;
}

void transform(Pslg& pslg, auto&& to) {
  for (Point& p : pslg.points) p = to(p);
  for (Point& p : pslg.holes) p = to(p);
}

}  // namespace

double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

Pslg squarePslg() {
  Pslg pslg;
  addRing(pslg, box(0.0, 0.0, 1.0), kUnlabelled, kUnlabelled);
  return pslg;
}

Pslg squareWithHole() {
  Pslg pslg = squarePslg();
  addRing(pslg, box(1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0), kUnlabelled, kUnlabelled);
  pslg.holes.push_back({0.5, 0.5});
  return pslg;
}

Pslg randomPoints(unsigned seed, int n) {
  std::mt19937_64 random(seed);
  Pslg pslg;
  addRandomPoints(pslg, random, n);
  return pslg;
}

Pslg randomPointsInBox(unsigned seed, int n) {
  std::mt19937_64 random(seed);
  Pslg pslg = squarePslg();
  addRandomPoints(pslg, random, n);
  return pslg;
}

Pslg nearDuplicates(unsigned seed, int pairs) {
  std::mt19937_64 random(seed);
  Pslg pslg = squarePslg();
  addRandomPoints(pslg, random, pairs);
  for (int i = 0; i < pairs; ++i) {
    const double at = uniform(random, 0.0, 2.0 * std::numbers::pi);
    addPoint(pslg, pslg.points[4 + i] + 1e-9 * Point{std::cos(at), std::sin(at)});
  }
  return pslg;
}

Pslg starPolygon(unsigned seed, int n) {
  std::mt19937_64 random(seed);
  std::vector<Point> ring;
  for (int i = 0; i < n; ++i) {
    const double at = 2.0 * std::numbers::pi * i / n, radius = uniform(random, 0.3, 1.0);
    ring.push_back(radius * Point{std::cos(at), std::sin(at)});
  }
  Pslg pslg;
  addRing(pslg, ring, 0, kOutside);
  return pslg;
}

Pslg fractalCoast(unsigned seed, int levels, int islands) {
  std::mt19937_64 random(seed);
  Pslg pslg;
  addRing(pslg, fractalRing(random, {}, 1.0, levels), 0, kOutside);
  // The coast stays outside a disk of this radius, and a ring stays within this multiple of its own radius.
  constexpr double kClear = 0.57, kReach = 1.16;
  std::vector<std::pair<Point, double>> placed;
  for (int tries = 0; tries < 100 * islands && std::ssize(placed) < islands; ++tries) {
    const double size = uniform(random, 0.02, 0.15);
    const double x = uniform(random, -kClear, kClear);
    const Point centre{x, uniform(random, -kClear, kClear)};
    const double reach = kReach * size;
    const bool free = std::sqrt(squaredLength(centre)) + reach < kClear &&
                      std::ranges::all_of(
                          placed, [&](const auto& p) { return distance(p.first, centre) > 1.02 * (reach + p.second); });
    if (!free) continue;
    placed.emplace_back(centre, reach);
    addRing(pslg, fractalRing(random, centre, size, std::max(0, levels - 1)), kOutside, 0);
  }
  return pslg;
}

Pslg combPolygon(int teeth) {
  constexpr double kWidth = 0.1;
  std::vector<Point> ring{{0.0, -0.2}, {teeth * kWidth, -0.2}};
  for (int i = teeth; i > 0; --i) {
    ring.push_back({i * kWidth, 0.0});
    ring.push_back({(i - 0.5) * kWidth, 10.0 * kWidth});
  }
  ring.push_back({0.0, 0.0});
  Pslg pslg;
  addRing(pslg, ring, 0, kOutside);
  return pslg;
}

Pslg fanOfAngles(int rays, double angle_deg) {
  Pslg pslg;
  addRing(pslg, box(-0.5, -1.0, 2.0), 0, kOutside);
  const VertexId apex = addPoint(pslg, {0.0, 0.0});
  for (int i = 0; i < rays; ++i) {
    const double at = toRadians(10.0 + angle_deg * i), length = 0.7 + 0.3 * std::sin(7.0 * i);
    const VertexId tip = addPoint(pslg, length * Point{std::cos(at), std::sin(at)});
    addSegment(pslg, apex, tip, 0, 0);
  }
  return pslg;
}

Pslg nestedRings() {
  Pslg pslg;
  addRing(pslg, box(0.0, 0.0, 1.0), 0, kOutside);
  addRing(pslg, box(0.2, 0.2, 0.6), kOutside, 0);
  addRing(pslg, box(0.3, 0.3, 0.4), 1, kOutside);
  addRing(pslg, {{0.4, 0.45}, {0.55, 0.4}, {0.6, 0.6}}, kOutside, 1);
  return pslg;
}

Pslg touchingHoles() {
  Pslg pslg;
  const std::vector<VertexId> outer = addRing(pslg, box(0.0, 0.0, 1.0), 0, kOutside);
  const VertexId common = addPoint(pslg, {0.5, 0.5});
  for (const double side : {-1.0, 1.0}) {
    const VertexId b = addPoint(pslg, {0.5 + 0.2 * side, 0.5 - 0.15 * side});
    const VertexId c = addPoint(pslg, {0.5 + 0.25 * side, 0.5 + 0.1 * side});
    closeRing(pslg, {common, b, c}, kOutside, 0);
  }
  const VertexId b = addPoint(pslg, {0.3, 0.1}), c = addPoint(pslg, {0.15, 0.3});
  closeRing(pslg, {outer[0], b, c}, kOutside, 0);
  return pslg;
}

Pslg collinearRuns() {
  const std::vector<double> stops{0.0, 0.03, 0.031, 0.25, 0.5, 0.51, 0.75, 0.9};
  std::vector<Point> ring;
  for (const double s : stops) ring.push_back({s, 0.0});
  for (const double s : stops) ring.push_back({1.0, s});
  for (const double s : stops) ring.push_back({1.0 - s, 1.0});
  for (const double s : stops) ring.push_back({0.0, 1.0 - s});
  Pslg pslg;
  addRing(pslg, ring, 0, kOutside);
  return pslg;
}

Pslg narrowChannel(double width) {
  const double low = 0.5 - 0.5 * width, high = 0.5 + 0.5 * width;
  Pslg pslg;
  addRing(pslg,
          {{-1.1, 0.0},
           {-0.1, 0.0},
           {-0.1, low},
           {0.1, low},
           {0.1, 0.0},
           {1.1, 0.0},
           {1.1, 1.0},
           {0.1, 1.0},
           {0.1, high},
           {-0.1, high},
           {-0.1, 1.0},
           {-1.1, 1.0}},
          0, kOutside);
  return pslg;
}

Pslg openLines() {
  Pslg pslg;
  const std::vector<VertexId> outer = addRing(pslg, box(0.0, 0.0, 1.0), 0, kOutside);
  const VertexId a = addPoint(pslg, {0.2, 0.3}), b = addPoint(pslg, {0.7, 0.35}), c = addPoint(pslg, {0.65, 0.8});
  addSegment(pslg, a, b, 0, 0);
  addSegment(pslg, b, c, 0, 0);
  addSegment(pslg, outer[2], addPoint(pslg, {0.8, 0.7}), 0, 0);
  addSegment(pslg, addPoint(pslg, {0.1, 0.6}), addPoint(pslg, {0.4, 0.7}), kUnlabelled, kUnlabelled);
  return pslg;
}

Pslg twoRegions() {
  Pslg pslg;
  std::vector<VertexId> corner;
  for (const Point& p : box(0.0, 0.0, 1.0)) corner.push_back(addPoint(pslg, p));
  const VertexId low = addPoint(pslg, {0.45, 0.0}), bend = addPoint(pslg, {0.6, 0.55}),
                 high = addPoint(pslg, {0.4, 1.0});
  addSegment(pslg, corner[0], low, 0, kOutside);
  addSegment(pslg, low, corner[1], 1, kOutside);
  addSegment(pslg, corner[1], corner[2], 1, kOutside);
  addSegment(pslg, high, corner[2], kOutside, 1);
  addSegment(pslg, high, corner[3], 0, kOutside);
  addSegment(pslg, corner[3], corner[0], 0, kOutside);
  addSegment(pslg, low, bend, 0, 1);
  addSegment(pslg, high, bend, 1, 0);
  return pslg;
}

Pslg scaled(Pslg pslg, double factor) {
  transform(pslg, [=](const Point& p) { return factor * p; });
  return pslg;
}

Pslg moved(Pslg pslg, const Point& by) {
  transform(pslg, [=](const Point& p) { return p + by; });
  return pslg;
}

Pslg turned(Pslg pslg, double angle_deg) {
  const double c = std::cos(toRadians(angle_deg)), s = std::sin(toRadians(angle_deg));
  transform(pslg, [=](const Point& p) { return Point{c * p.x - s * p.y, s * p.x + c * p.y}; });
  return pslg;
}

double smallestSpacing(const Pslg& pslg) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < pslg.points.size(); ++v) {
    const Point& p = pslg.points[v];
    for (std::size_t w = 0; w < v; ++w) smallest = std::min(smallest, distance(p, pslg.points[w]));
    for (const Segment& s : pslg.segments) {
      if (s.a == v || s.b == v) continue;
      const Point a = pslg.points[s.a], ab = pslg.points[s.b] - a;
      const double share = std::clamp(dot(p - a, ab) / squaredLength(ab), 0.0, 1.0);
      smallest = std::min(smallest, distance(p, a + share * ab));
    }
  }
  return smallest;
}

void PrintTo(const NamedPslg& named, std::ostream* out) { *out << named.name; }

std::string nameOf(const NamedPslg& named) { return named.name; }

std::vector<NamedPslg> assortedPslgs() {
  return {{"Square", squarePslg()},
          {"SquareWithHole", squareWithHole()},
          {"RandomPoints", randomPoints(11, 60)},
          {"RandomPointsInBox", randomPointsInBox(12, 60)},
          {"NearDuplicates", nearDuplicates(13, 4)},
          {"StarPolygon", starPolygon(14, 40)},
          {"FractalCoast", fractalCoast(15, 2, 3)},
          {"CombPolygon", combPolygon(5)},
          {"FanOfAngles", fanOfAngles(9, 2.0)},
          {"NestedRings", nestedRings()},
          {"TouchingHoles", touchingHoles()},
          {"CollinearRuns", collinearRuns()},
          {"NarrowChannel", narrowChannel(0.01)},
          {"OpenLines", openLines()},
          {"TwoRegions", twoRegions()},
          {"SquareTurned", turned(squareWithHole(), 33.0)}};
}

}  // namespace coastmesh
