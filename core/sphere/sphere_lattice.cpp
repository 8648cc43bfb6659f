#include "core/sphere/sphere_lattice.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/predicates.hpp"
#include "core/sphere/sphere_place.hpp"

namespace coastmesh {

namespace {

using Corners = std::array<SpacePoint, 3>;

SpacePoint unit(const SpacePoint& a) { return (1.0 / lengthOf(a)) * a; }

// The corners of an icosahedron: the pole, five near it, five near the other, and that. None lies on an axis of the
// plane but the poles.
std::array<SpacePoint, 12> icosahedron() {
  constexpr double kTurn = 0.2;  // radians
  const double height = 1.0 / std::sqrt(5.0), radius = 2.0 * height;
  std::array<SpacePoint, 12> corners;
  corners[0] = {0.0, 0.0, -1.0};
  corners[11] = {0.0, 0.0, 1.0};
  for (std::size_t i = 0; i < 5; ++i) {
    const double lower = kTurn + 0.4 * std::numbers::pi * static_cast<double>(i),
                 upper = lower + 0.2 * std::numbers::pi;
    corners[1 + i] = {radius * std::cos(lower), radius * std::sin(lower), -height};
    corners[6 + i] = {radius * std::cos(upper), radius * std::sin(upper), height};
  }
  return corners;
}

using Numbers = std::array<std::size_t, 3>;

// Counter-clockwise as seen from outside.
std::array<Numbers, 20> faces() {
  std::array<Numbers, 20> faces{};
  for (std::size_t i = 0; i < 5; ++i) {
    const std::size_t next = (i + 1) % 5;
    faces[i] = {0, 1 + next, 1 + i};
    faces[5 + i] = {1 + i, 1 + next, 6 + i};
    faces[10 + i] = {1 + next, 6 + next, 6 + i};
    faces[15 + i] = {11, 6 + i, 6 + next};
  }
  return faces;
}

// The place that has these shares of a face's corners, which add up to 1. Arcs from corner to corner are cut evenly,
// and within the face areas differ by less than a fifth: sines of shares of the arc in place of the shares.
SpacePoint placeIn(const Corners& face, double a, double b, double c) {
  static const double kArc = std::atan(2.0);
  return unit(std::sin(a * kArc) * face[0] + std::sin(b * kArc) * face[1] + std::sin(c * kArc) * face[2]);
}

// Of step (a, b) of the lattice, whose steps have 60 degrees between them: how much of the second and of the third
// corner of the face it lies in, in parts of `trianglesOfFace`. The corners lie at (0, 0), (h, k) and (-k, h + k).
struct Shares {
  std::int64_t second, third;
};
Shares sharesOf(const SphereLattice& l, std::int64_t a, std::int64_t b) {
  return {a * (l.h + l.k) + b * l.k, b * l.h - a * l.k};
}

void addInside(const SphereLattice& lattice, const Corners& face, std::vector<SpacePoint>& places) {
  const std::int64_t whole = lattice.trianglesOfFace();
  const auto part = [&](std::int64_t share) { return static_cast<double>(share) / static_cast<double>(whole); };
  for (std::int64_t b = 0; b <= lattice.h + lattice.k; ++b) {
    for (std::int64_t a = -lattice.k; a <= lattice.h; ++a) {
      const auto [second, third] = sharesOf(lattice, a, b);
      const std::int64_t first = whole - second - third;
      if (first > 0 && second > 0 && third > 0) places.push_back(placeIn(face, part(first), part(second), part(third)));
    }
  }
}

void addAlong(const SphereLattice& lattice, const SpacePoint& from, const SpacePoint& to,
              std::vector<SpacePoint>& places) {
  const std::int64_t steps = std::gcd(lattice.h, lattice.k);
  for (std::int64_t i = 1; i < steps; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(steps);
    places.push_back(placeIn({from, to, from}, 1.0 - share, share, 0.0));
  }
}

// Cells of space that are as wide as a clearance: what is nearer than that lies in a cell or one beside it.
class Cells {
 public:
  explicit Cells(double width) : per_unit_(1.0 / width) {}

  std::uint64_t of(const SpacePoint& p, int dx = 0, int dy = 0, int dz = 0) const {
    return along(p.x, dx) << 42 | along(p.y, dy) << 21 | along(p.z, dz);
  }

 private:
  // From 1 on, so that the cells beside it have numbers too.
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
        // Three cells in a row.
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

// The points between a and b that lie `step` apart or less on the sphere, by halves.
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

SphereLattice sphereLattice(double edge) {
  const double wanted = 0.8 * std::numbers::pi / std::numbers::sqrt3 / (edge * edge);  // triangles of a face
  const auto offness = [&](const SphereLattice& l) {
    return std::abs(static_cast<double>(l.trianglesOfFace()) - wanted);
  };
  // Without turns triangles are a little better: none of them lies across an edge of the icosahedron.
  constexpr double kNearEnough = 0.02;  // of their number: half of that of lengths
  SphereLattice best{std::max<std::int64_t>(1, std::llround(std::sqrt(wanted))), 0};
  if (offness(best) <= kNearEnough * wanted) return best;
  for (SphereLattice l{1, 0}; static_cast<double>((l.h - 1) * (l.h - 1)) <= wanted; ++l.h) {
    const double h = static_cast<double>(l.h);
    const auto root = static_cast<std::int64_t>(0.5 * (std::sqrt(std::max(0.0, 4.0 * wanted - 3.0 * h * h)) - h));
    for (l.k = std::max<std::int64_t>(0, root); l.k <= std::min(l.h, root + 1); ++l.k)
      if (offness(l) < offness(best)) best = l;
  }
  return best;
}

std::vector<SpacePoint> placesOf(const SphereLattice& lattice, const ItemLoop& loop) {
  const std::array<SpacePoint, 12> corners = icosahedron();
  std::vector<SpacePoint> places(corners.begin(), corners.end());
  const std::array<Numbers, 20> all = faces();
  for (const Numbers& face : all)
    for (std::size_t i = 0; i < 3; ++i)
      if (const std::size_t from = face[i], to = face[(i + 1) % 3]; from < to)
        addAlong(lattice, corners[from], corners[to], places);
  std::vector<std::vector<SpacePoint>> inside(all.size());
  loop(all.size(), [&](std::size_t f) {
    addInside(lattice, {corners[all[f][0]], corners[all[f][1]], corners[all[f][2]]}, inside[f]);
  });
  reserveOn(loop, places, static_cast<std::size_t>(lattice.vertices()));
  for (const std::vector<SpacePoint>& some : inside) places.insert(places.end(), some.begin(), some.end());
  assert(static_cast<std::int64_t>(places.size()) == lattice.vertices());
  // The neighbours of the pole to the front.
  const auto ring = places.begin() + kLatticePole, rest = ring + kLatticeRing;
  std::ranges::nth_element(ring, rest - 1, places.end(), {}, &SpacePoint::z);
  std::ranges::sort(ring, rest, {}, [](const SpacePoint& p) { return std::atan2(p.y, p.x); });
  return places;
}

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
