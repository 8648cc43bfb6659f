#include "core/sphere/clear_places.hpp"

#include <algorithm>
#include <cstdint>

#include "core/predicates.hpp"
#include "core/sphere/sphere_place.hpp"

namespace coastmesh {

namespace {

// Cubic cells as wide as the clearance: points closer to each other are in the same cell or adjacent ones.
class Cells {
 public:
  explicit Cells(double width) : per_unit_(1.0 / width) {}

  std::uint64_t of(const SpacePoint& p, int dx = 0, int dy = 0, int dz = 0) const {
    return along(p.x, dx) << 42 | along(p.y, dy) << 21 | along(p.z, dz);
  }

 private:
  // Numbers start above 0, so that adjacent cells have valid numbers too.
  std::uint64_t along(double x, int step) const {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>((x + 1.0) * per_unit_) + 2 + step);
  }
  double per_unit_;
};

struct Sample {
  std::uint64_t cell;
  SpacePoint place;
};

// Places on the sphere of radius 1, cell by cell.
class Samples {
 public:
  explicit Samples(double clearance) : cells_(clearance), squared_(clearance * clearance) {}

  void add(const SpacePoint& p) { samples_.push_back({cells_.of(p), p}); }
  void sort() { std::ranges::sort(samples_, {}, &Sample::cell); }
  bool isNear(const SpacePoint& p) const {
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        // Cells adjacent along z have consecutive numbers.
        const auto first = std::ranges::lower_bound(samples_, cells_.of(p, dx, dy, -1), {}, &Sample::cell);
        const std::uint64_t last = cells_.of(p, dx, dy, 1);
        for (auto s = first; s != samples_.end() && s->cell <= last; ++s) {
          const SpacePoint apart = s->place - p;
          if (dot(apart, apart) < squared_) return true;
        }
      }
    }
    return false;
  }

 private:
  Cells cells_;
  double squared_;
  std::vector<Sample> samples_;
};

// Adds points between a and b, at most `step` apart on the sphere, by repeated halving.
void addBetween(const Point& a, const Point& b, const Surface& surface, double step, int depth, Samples& samples) {
  constexpr int kMostHalvings = 40;
  const Point middle{0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
  const SpacePoint p = placeOnSphere(a, surface), q = placeOnSphere(b, surface), m = placeOnSphere(middle, surface);
  if (depth == kMostHalvings || (distance(p, m) <= step && distance(m, q) <= step)) {
    samples.add(m);
    return;
  }
  samples.add(m);
  addBetween(a, middle, surface, step, depth + 1, samples);
  addBetween(middle, b, surface, step, depth + 1, samples);
}

bool liesWithin(const Point& x, std::span<const Point> ring) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (orient2d(ring[i], ring[i + 1 == ring.size() ? 0 : i + 1], x) <= 0) return false;
  return true;
}

}  // namespace

std::vector<Point> clearPlaces(std::span<const SpacePoint> places, const Pslg& pslg, std::span<const Point> ring,
                               const Surface& surface, double clearance, const ItemLoop& loop) {
  constexpr double kStep = 0.5;  // between samples of a segment, as a share of the clearance
  const double width = clearance / surface.radius();
  Samples samples(width);
  for (const Point& x : ring) samples.add(placeOnSphere(x, surface));
  for (const Point& x : pslg.points) samples.add(placeOnSphere(x, surface));
  for (const Segment& s : pslg.segments)
    addBetween(pslg.points[s.a], pslg.points[s.b], surface, kStep * width, 0, samples);
  samples.sort();
  return joined(overStretches(loop, places.size(), [&](std::size_t first, std::size_t last) {
    std::vector<Point> clear;
    for (std::size_t i = first; i < last; ++i) {
      if (places[i].z <= -1.0) continue;
      const Point x = planeOf(places[i], surface);
      if (liesWithin(x, ring) && !samples.isNear(places[i])) clear.push_back(x);
    }
    return clear;
  }));
}

}  // namespace coastmesh
