#include "tests/fuzz/ring_pslgs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "tests/support/pslg_parts.hpp"

namespace coastmesh {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

Point polar(double radius, double at) { return radius * Point{std::cos(at), std::sin(at)}; }

// A polygon as the whole domain, with or without labels.
Pslg polygon(Choices& choices, const std::vector<Point>& ring) {
  Pslg pslg;
  const bool labelled = choices.oneIn(2);
  addRing(pslg, ring, labelled ? 0 : kUnlabelled, labelled ? kOutside : kUnlabelled);
  return pslg;
}

// A power of ten with an exponent between `low` and 0.
double tenTo(Choices& choices, double low) { return std::pow(10.0, choices.between(low, 0.0)); }

std::vector<Point> comb(Choices& choices) {
  const std::uint32_t teeth = 1 + choices.below(5);
  const double width = 0.5 * tenTo(choices, -1.5), gap = 0.5 * tenTo(choices, -1.5);
  std::vector<Point> ring;
  double x = 0.0;
  for (std::uint32_t i = 0; i < teeth; ++i) {
    const double high = choices.between(0.2, 1.0);
    ring.insert(ring.end(), {{x, 0.0}, {x, high}, {x + width, high}, {x + width, 0.0}});
    x += width + gap;
  }
  ring.push_back({x, -0.1});
  ring.push_back({-gap, -0.1});
  std::ranges::reverse(ring);
  return ring;
}

std::vector<Point> spiral(Choices& choices) {
  const std::uint32_t steps = 6 + choices.below(30);
  const double step = kTurn / (5.0 + choices.below(8)), width = choices.between(0.02, 0.8);
  std::vector<Point> ring;
  const auto radius = [&](double i) { return 0.1 + i * step / kTurn; };
  for (std::uint32_t i = 0; i <= steps; ++i) ring.push_back(polar(radius(i) + width, i * step));
  for (std::uint32_t i = steps + 1; i > 0; --i) ring.push_back(polar(radius(i - 1.0), (i - 1.0) * step));
  return ring;
}

std::vector<Point> channel(Choices& choices) {
  const double width = tenTo(choices, -3.0), bend = choices.between(-0.3, 0.3);
  const double length = std::min(3.0, 400.0 * width);
  return {{-1.0, -1.0},
          {0.0, -0.5 * width},
          {0.5 * length, -0.5 * width + bend * length},
          {length, -0.5 * width},
          {length + 1.0, -1.0},
          {length + 1.0, 1.0},
          {length, 0.5 * width},
          {0.5 * length, 0.5 * width + bend * length},
          {0.0, 0.5 * width},
          {-1.0, 1.0}};
}

}  // namespace

Pslg nestedStars(Choices& choices) {
  Pslg pslg;
  const bool labelled = choices.oneIn(2);
  const std::uint32_t rings = 1 + choices.below(4);
  double outside = 1.0;
  VertexId touched = kNone;
  double touched_at = 0.0;
  for (std::uint32_t r = 0; r < rings; ++r) {
    const std::uint32_t count = 3 + choices.below(14);
    const double inside = outside * choices.between(0.3, 0.95);
    const double start = touched == kNone ? choices.share() : touched_at;
    std::vector<VertexId> ring;
    double nearest = outside;
    VertexId nearest_vertex = kNone;
    double nearest_at = 0.0;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (i == 0 && touched != kNone) {
        ring.push_back(touched);
        continue;
      }
      const double at = kTurn * (i + (i == 0 ? 0.0 : choices.between(-0.3, 0.3))) / count + start;
      const double radius = choices.between(inside, outside);
      ring.push_back(addPoint(pslg, polar(radius, at)));
      if (radius < nearest) nearest = radius, nearest_vertex = ring.back(), nearest_at = at;
    }
    const bool sea = r % 2 == 0;
    if (labelled) {
      closeRing(pslg, ring, sea ? static_cast<RegionId>(r / 2) : kOutside,
                sea ? kOutside : static_cast<RegionId>(r / 2));
    } else {
      closeRing(pslg, ring, kUnlabelled, kUnlabelled);
      if (!sea) pslg.holes.push_back(polar(0.5 * (inside + nearest) * 0.9, start + 0.1));
    }
    // Chords cut inward: the next ring must stay clear of the one that cuts deepest.
    outside = nearest * std::cos(std::min(0.45 * kTurn, 1.6 * kTurn / count) / 2.0) * choices.between(0.2, 1.0);
    touched = choices.oneIn(3) ? nearest_vertex : kNone;
    touched_at = nearest_at;
  }
  return pslg;
}

Pslg tinyAngles(Choices& choices) {
  const std::uint32_t rays = 2 + choices.below(10);
  const double step = toRadians(20.0 * tenTo(choices, -6.5));
  std::vector<Point> tips;
  double at = choices.oneIn(2) ? 0.0 : choices.share();
  for (std::uint32_t i = 0; i < rays; ++i) {
    tips.push_back(polar(choices.between(0.3, 1.0), at));
    at += choices.oneIn(4) ? choices.between(0.0, 0.7) : step * choices.between(0.5, 2.0);
    if (at > 0.9 * kTurn) break;
  }
  Pslg pslg;
  if (choices.oneIn(3)) {  // spikes, two rays each, that meet in the apex
    const bool inside = choices.oneIn(2);
    const RegionId left = inside ? 0 : kOutside, right = inside ? kOutside : 0;
    if (!inside) addRing(pslg, {{-2.0, -2.0}, {2.0, -2.0}, {2.0, 2.0}, {-2.0, 2.0}}, 0, kOutside);
    const VertexId apex = addPoint(pslg, {});
    for (std::size_t i = 0; i + 1 < tips.size(); i += 2) {
      const VertexId a = addPoint(pslg, tips[i]);
      closeRing(pslg, {apex, a, addPoint(pslg, tips[i + 1])}, left, right);
    }
    return pslg;
  }
  if (choices.oneIn(2)) {
    tips.push_back({});
    return polygon(choices, tips);
  }
  addRing(pslg, {{-2.0, -2.0}, {2.0, -2.0}, {2.0, 2.0}, {-2.0, 2.0}}, kUnlabelled, kUnlabelled);
  const VertexId apex = choices.oneIn(4) ? VertexId{0} : addPoint(pslg, {});
  for (const Point& tip : tips) addSegment(pslg, apex, addPoint(pslg, tip), kUnlabelled, kUnlabelled);
  return pslg;
}

Pslg narrowStrip(Choices& choices) {
  switch (choices.below(3)) {
    case 0:
      return polygon(choices, comb(choices));
    case 1:
      return polygon(choices, spiral(choices));
    default:
      return polygon(choices, channel(choices));
  }
}

Pslg brokenSides(Choices& choices) {
  const std::uint32_t sides = 3 + choices.below(4);
  std::vector<Point> corners;
  const bool square = choices.oneIn(3);
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double radius = choices.between(0.5, 1.0);
    corners.push_back(polar(radius, kTurn * (i + choices.between(0.0, 0.5)) / sides));
  }
  if (square) corners = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
  std::vector<Point> ring;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point a = corners[i], b = corners[(i + 1) % corners.size()];
    std::vector<double> stops{0.0};
    const std::uint32_t count = choices.below(7);
    for (std::uint32_t k = 0; k < count; ++k) {
      const double stop =
          choices.oneIn(3) ? stops[choices.below(static_cast<std::uint32_t>(stops.size()))] + tenTo(choices, -9.0) * 0.1
          : choices.oneIn(2) ? choices.below(8) / 8.0
                             : choices.share();
      if (stop > 0.0 && stop < 1.0) stops.push_back(stop);
    }
    std::ranges::sort(stops);
    stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
    for (const double stop : stops) ring.push_back(a + stop * (b - a));
  }
  return polygon(choices, ring);
}

}  // namespace coastmesh
