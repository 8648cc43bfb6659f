#include "gis/size/globe_start.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "core/sphere/clear_places.hpp"
#include "core/sphere/sphere_lattice.hpp"
#include "core/sphere/sphere_place.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Distances, relative to the radius.
constexpr double kFewPlaces = 0.5;    // between points of a lattice that is only a beginning
constexpr double kLargestRing = 0.9;  // from the point at infinity to the ring's corners
constexpr double kRingForSizes = 0.003;
// Share of the distance to the nearest input point: leaves room for the ring and good triangles around it.
constexpr double kShareOfClearance = 0.35;
// Lattice points keep this distance from the input, relative to the lattice's edges.
constexpr double kClearance = 0.6;
// The lattice's mean edge, relative to a requested longest edge: the lattice's edges differ.
constexpr double kBelowLongest = 0.87;
// The lattice for the largest size is used where sizes are at least this share of it.
constexpr double kSameLength = 0.87;

// The chord from the point at infinity to the nearest input point.
double clearanceOf(const Domain& domain, const Surface& surface) {
  const Point apex = sphereCap(surface, std::vector<Point>{}).apex;
  double nearest = 2.0 * surface.radius();
  for (const Point& x : domain.pslg.points) nearest = std::min(nearest, surface.chord(apex, x));
  return nearest;
}

double largestRing(const Domain& domain, const Surface& surface) {
  return std::min(kLargestRing * surface.radius(), kShareOfClearance * clearanceOf(domain, surface));
}

void requireNumbers(double length, const Surface& surface) {
  if (length >= kLeastLatticeEdge * surface.radius()) return;
  char text[160];
  std::snprintf(text, sizeof text,
                "edges of %.3g m on the whole globe need more triangles than can be numbered: request %.3g m or more",
                length, kLeastLatticeEdge * surface.radius());
  throw InputError(text);
}

// True if the lattice can be the whole mesh: it has no turns, and there is no input.
bool isAll(const SphereLattice& lattice, const Domain& domain) {
  return lattice.k == 0 && lattice.h > 1 && domain.pslg.points.empty();
}

std::vector<Point> ringOf(const std::vector<SpacePoint>& places, const Surface& surface) {
  std::vector<Point> ring;
  for (std::size_t i = kLatticePole; i < kLatticePole + kLatticeRing; ++i) ring.push_back(planeOf(places[i], surface));
  return ring;
}

}  // namespace

bool isUniform(const SizeOptions& options) {
  SizeOptions others = options;
  others.size_m = kInfinity;
  return options.size_m < kInfinity && !others.any() && options.time_step_s == 0.0;
}

Domain withRing(const Domain& domain, const SizeOptions& options) {
  const Surface surface = domain.projection.surface();
  const double length = std::min({kRingForSizes * surface.radius(), options.size_m, options.most_m, options.shore_m,
                                  largestRing(domain, surface)});
  Domain all = domain;
  constexpr unsigned kCorners = 6;
  const SphereCap cap = sphereCap(surface, length, kCorners);
  for (const Point& x : cap.ring) {
    all.pslg.points.push_back(x);
    all.input_points.push_back(domain.projection.inverse(x));
  }
  const auto side = [&](RegionId region) { return region == domain.rest ? domain.rest : kOutside; };
  for (Segment& s : all.pslg.segments) s.left = side(s.left), s.right = side(s.right);
  return all;
}

GlobeStart globeStart(const Domain& domain, const SizeOptions& options, const SizeFunction* size,
                      const ItemLoop& loop) {
  const Surface surface = domain.projection.surface();
  const double radius = surface.radius(), largest = largestRing(domain, surface);
  const double longest = kBelowLongest * options.most_m;
  const bool uniform = size == nullptr ? std::isfinite(longest) : isUniform(options);
  const double wanted = size == nullptr ? longest : size->most();
  const bool has_lattice = std::isfinite(wanted) && wanted < kFewPlaces * radius;
  if (has_lattice) requireNumbers(wanted, surface);

  GlobeStart start;
  const double edge = has_lattice || uniform ? wanted : kFewPlaces * radius;
  const SphereLattice lattice = sphereLattice(edge / radius);
  if (has_lattice && uniform && isAll(lattice, domain)) {
    start.lattice = meshOf(lattice, surface, loop);
    start.cap = sphereCap(
        surface, std::vector<Point>(start.lattice.points.begin(), start.lattice.points.begin() + kLatticeRing));
    return start;
  }
  const std::vector<SpacePoint> places = placesOf(lattice, loop);
  SphereCap of_lattice = sphereCap(surface, ringOf(places, surface));
  // The lattice's own ring has the best triangles around it. Used if it is not too large, and one size is requested.
  if ((uniform || size == nullptr) && surface.chord(of_lattice.apex, of_lattice.ring.front()) <= largest) {
    start.cap = std::move(of_lattice);
  } else {
    constexpr unsigned kCorners = 6;
    const double there = size != nullptr ? size->at(of_lattice.apex) : wanted;
    start.cap = sphereCap(surface, std::min(there, largest), kCorners);
  }
  start.seeds = clearPlaces(places, domain.pslg, start.cap.ring, surface, kClearance * edge, loop);
  if (size == nullptr || uniform) return start;
  if (has_lattice) std::erase_if(start.seeds, [&](const Point& x) { return size->at(x) < kSameLength * wanted; });
  constexpr std::size_t kFewest = 12;
  if (start.seeds.size() >= kFewest) return start;
  const std::vector<SpacePoint> few = placesOf(sphereLattice(kFewPlaces), loop);
  start.seeds = clearPlaces(few, domain.pslg, start.cap.ring, surface, kClearance * kFewPlaces * radius, loop);
  return start;
}

}  // namespace coastmesh
