#include "gis/grid/loop_role.hpp"

#include <GeographicLib/Accumulator.hpp>
#include <GeographicLib/Math.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/predicates.hpp"
#include "gis/crs/lon_lat.hpp"

namespace coastmesh {

namespace {

using GeographicLib::Math;

constexpr double kSphere = 4.0 * std::numbers::pi;  // the area of the unit sphere

BoundaryRole roleInPlane(std::span<const Point> ring) {
  // At its least vertex a counter-clockwise loop turns left, however often it passes there: the mesh lies to its left,
  // and all of it on one side of that vertex.
  const std::size_t n = ring.size();
  const auto least = static_cast<std::size_t>(std::ranges::min_element(ring, lexLess) - ring.begin());
  const Point &before = ring[(least + n - 1) % n], &after = ring[(least + 1) % n];
  return orient2d(before, ring[least], after) > 0 ? BoundaryRole::Land : BoundaryRole::Island;
}

std::vector<Point> placesOf(std::span<const Point> nodes, std::span<const std::uint32_t> loop) {
  std::vector<Point> ring;
  ring.reserve(loop.size());
  for (const std::uint32_t node : loop) ring.push_back(nodes[node]);
  return ring;
}

std::vector<LonLat> onEllipsoid(std::span<const Point> ring) {
  std::vector<LonLat> places;
  places.reserve(ring.size());
  for (const Point& p : ring) places.push_back(asLonLat(p));
  return places;
}

// Unwraps longitudes where the loop crosses ±180 or has points of other revolutions, by whole revolutions.
std::vector<LonLat> unrolled(std::vector<LonLat> ring) {
  double turns = 0.0;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    turns -= 360.0 * std::round((ring[i].lon + turns - ring[i - 1].lon) / 360.0);
    ring[i].lon += turns;
  }
  return ring;
}

// The area to the left of a ring of great circles, on the unit sphere. The area between an edge and the equator is from
// Bevis and Cambareri (1987); it is valid over poles and for edges along a meridian too.
double areaToTheLeft(std::span<const LonLat> ring) {
  GeographicLib::Accumulator<double> below, turn;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const LonLat &from = ring[i], &to = ring[(i + 1) % ring.size()];
    const double step = Math::AngDiff(from.lon, to.lon) * Math::degree();
    const double s = std::tan(0.5 * from.lat * Math::degree()), t = std::tan(0.5 * to.lat * Math::degree());
    below += 2.0 * std::atan2(std::sin(0.5 * step) * (s + t), std::cos(0.5 * step) * (1.0 + s * t));
    turn += step;
  }
  const double rounds = std::round(turn() / (2.0 * std::numbers::pi));
  const double area = std::fmod(2.0 * std::numbers::pi * rounds - below(), kSphere);
  return area < 0.0 ? area + kSphere : area;
}

// True if straight lines in degrees make the same loop as great circles, except for slivers.
bool isPlainInDegrees(std::span<const LonLat> unrolled_ring) {
  constexpr double kWidest = 180.0, kHighest = 89.0;
  const auto [west, east] = std::ranges::minmax(unrolled_ring, {}, &LonLat::lon);
  const auto [south, north] = std::ranges::minmax(unrolled_ring, {}, &LonLat::lat);
  return east.lon - west.lon < kWidest && std::max(north.lat, -south.lat) < kHighest;
}

}  // namespace

std::optional<BoundaryRole> roleByArea(std::span<const Point> nodes, std::span<const std::uint32_t> loop,
                                       const Crs& crs) {
  if (!crs.geographic) return std::nullopt;
  constexpr double kSure = 1e-4;  // on the unit sphere: above any error from the bent sides of slivers
  const std::vector<LonLat> ring = unrolled(onEllipsoid(placesOf(nodes, loop)));
  const double left = areaToTheLeft(ring);
  if (isPlainInDegrees(ring) && std::min(left, kSphere - left) < kSure) return std::nullopt;
  return left < 0.5 * kSphere ? BoundaryRole::Land : BoundaryRole::Island;
}

BoundaryRole roleOfLoop(std::span<const Point> nodes, std::span<const std::uint32_t> loop, const Crs& crs) {
  if (const std::optional<BoundaryRole> role = roleByArea(nodes, loop, crs)) return *role;
  std::vector<Point> ring = placesOf(nodes, loop);
  if (crs.geographic) std::ranges::transform(unrolled(onEllipsoid(ring)), ring.begin(), asGeographic);
  return roleInPlane(ring);
}

}  // namespace coastmesh
