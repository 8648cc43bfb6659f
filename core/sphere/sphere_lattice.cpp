#include "core/sphere/sphere_lattice.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "core/links.hpp"
#include "core/sphere/close_sphere.hpp"
#include "core/sphere/sphere_place.hpp"

namespace coastmesh {

namespace {

using Corners = std::array<SpacePoint, 3>;

SpacePoint unit(const SpacePoint& a) { return (1.0 / lengthOf(a)) * a; }

// The corners of an icosahedron: the pole, five near it, five near the other pole, and that. Only the poles lie on an
// axis of the plane.
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

using Numbers = std::array<unsigned, 3>;
constexpr std::size_t kFaces = 20;

// Counter-clockwise as seen from outside.
std::array<Numbers, kFaces> faces() {
  std::array<Numbers, kFaces> faces{};
  for (unsigned i = 0; i < 5; ++i) {
    const unsigned next = (i + 1) % 5;
    faces[i] = {0, 1 + next, 1 + i};
    faces[5 + i] = {1 + i, 1 + next, 6 + i};
    faces[10 + i] = {1 + next, 6 + next, 6 + i};
    faces[15 + i] = {11, 6 + i, 6 + next};
  }
  return faces;
}

// The place with these shares of a face's corners, which add up to 1. The sine of each share of the arc is its weight,
// so that arcs between corners are divided evenly, and areas within the face differ by less than a fifth.
SpacePoint placeIn(const Corners& face, double a, double b, double c) {
  static const double kArc = std::atan(2.0);
  return unit(std::sin(a * kArc) * face[0] + std::sin(b * kArc) * face[1] + std::sin(c * kArc) * face[2]);
}

// The shares of a face's second and third corner at lattice point (a, b), with axes 60 degrees apart, in units of 1 /
// `trianglesOfFace`. The corners are at (0, 0), (h, k) and (-k, h + k).
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

// All places: the icosahedron's corners, those along its edges, and those in its faces, row by row.
std::vector<SpacePoint> placesInOrder(const SphereLattice& lattice, const ItemLoop& loop) {
  const std::array<SpacePoint, 12> corners = icosahedron();
  std::vector<SpacePoint> places;
  reserveOn(loop, places, static_cast<std::size_t>(lattice.vertices()));
  places.assign(corners.begin(), corners.end());
  const std::array<Numbers, kFaces> all = faces();
  for (const Numbers& face : all)
    for (unsigned i = 0; i < 3; ++i)
      if (const unsigned from = face[i], to = face[next3(i)]; from < to)
        addAlong(lattice, corners[from], corners[to], places);
  std::vector<std::vector<SpacePoint>> inside(all.size());
  loop(all.size(), [&](std::size_t f) {
    addInside(lattice, {corners[all[f][0]], corners[all[f][1]], corners[all[f][2]]}, inside[f]);
  });
  for (const std::vector<SpacePoint>& some : inside) places.insert(places.end(), some.begin(), some.end());
  assert(static_cast<std::int64_t>(places.size()) == lattice.vertices());
  return places;
}

// Counter-clockwise in the plane.
std::array<std::size_t, kLatticeRing> neighboursOfPole(const std::vector<SpacePoint>& places) {
  std::array<std::size_t, kLatticeRing> ring{};
  std::iota(ring.begin(), ring.end(), kLatticePole);
  const auto height = [&](std::size_t i) { return places[i].z; };
  std::ranges::sort(ring, {}, height);
  for (std::size_t i = kLatticePole + kLatticeRing; i < places.size(); ++i) {
    if (places[i].z >= height(ring.back())) continue;
    ring.back() = i;
    std::ranges::sort(ring, {}, height);
  }
  std::ranges::sort(ring, {}, [&](std::size_t i) { return std::atan2(places[i].y, places[i].x); });
  return ring;
}

// The number of each place in a mesh: the neighbours of the pole come first, the pole is the last.
std::vector<VertexId> numbersInMesh(const std::vector<SpacePoint>& places) {
  std::vector<VertexId> numbers(places.size(), kNone);
  numbers[0] = static_cast<VertexId>(places.size() - 1);
  VertexId next = 0;
  for (const std::size_t i : neighboursOfPole(places)) numbers[i] = next++;
  for (VertexId& number : numbers)
    if (number == kNone) number = next++;
  return numbers;
}

// The triangles of a lattice without turns, whose faces are divided into h rows. In a face, place (a, b) is a steps
// from the first corner towards the second and b towards the third.
class LatticeFaces {
 public:
  explicit LatticeFaces(std::int64_t h) : h_(static_cast<std::uint32_t>(h)), corners_(faces()) {
    std::uint32_t known = 0;
    for (const Numbers& face : corners_)
      for (unsigned i = 0; i < 3; ++i)
        if (face[i] < face[next3(i)]) edge_[face[i]][face[next3(i)]] = edge_[face[next3(i)]][face[i]] = known++;
  }

  // Makes the triangles of a face and links them to one another.
  void fill(std::size_t f, std::span<const VertexId> numbers, std::span<Triangle> triangles) const {
    const auto vertex = [&](std::uint32_t a, std::uint32_t b) { return numbers[placeAt(f, a, b)]; };
    for (std::uint32_t b = 0; b < h_; ++b) {
      for (std::uint32_t a = 0; a + b < h_; ++a) {
        triangles[up(f, a, b)] = unlinked({vertex(a, b), vertex(a + 1, b), vertex(a, b + 1)});
        if (a + b + 1 < h_)
          triangles[down(f, a, b)] = unlinked({vertex(a + 1, b), vertex(a + 1, b + 1), vertex(a, b + 1)});
      }
    }
    for (std::uint32_t b = 0; b + 1 < h_; ++b) {
      for (std::uint32_t a = 0; a + b + 1 < h_; ++a) {
        const TriId t = down(f, a, b);
        setTwins(triangles, edgeRef(t, 0), edgeRef(up(f, a, b + 1), 2));
        setTwins(triangles, edgeRef(t, 1), edgeRef(up(f, a, b), 0));
        setTwins(triangles, edgeRef(t, 2), edgeRef(up(f, a + 1, b), 1));
      }
    }
  }

  // Links each face to the adjacent ones.
  void join(std::span<Triangle> triangles) const {
    std::array<std::vector<EdgeRef>, kEdges> before;
    for (std::size_t f = 0; f < kFaces; ++f) {
      for (unsigned side = 0; side < 3; ++side) {
        std::vector<EdgeRef> along = edgesAlong(f, side);
        const std::size_t from = corners_[f][next3(side)], to = corners_[f][prev3(side)];
        if (from > to) std::ranges::reverse(along);
        std::vector<EdgeRef>& other = before[edge_[from][to]];
        for (std::size_t i = 0; i < other.size(); ++i) setTwins(triangles, along[i], other[i]);
        other = std::move(along);
      }
    }
  }

 private:
  static constexpr std::size_t kCorners = 12, kEdges = 30;

  TriId up(std::size_t f, std::uint32_t a, std::uint32_t b) const {
    return static_cast<TriId>(f) * h_ * h_ + 2 * h_ * b - b * b + 2 * a;
  }
  TriId down(std::size_t f, std::uint32_t a, std::uint32_t b) const { return up(f, a, b) + 1; }

  // The index of a place in `placesInOrder`.
  std::size_t placeAt(std::size_t f, std::uint32_t a, std::uint32_t b) const {
    const Numbers& corner = corners_[f];
    if (b == 0) return placeAlong(corner[0], corner[1], a);
    if (a == 0) return placeAlong(corner[0], corner[2], b);
    if (a + b == h_) return placeAlong(corner[1], corner[2], b);
    const std::size_t h = h_, rows = b - 1;
    return kCorners + kEdges * (h - 1) + f * ((h - 1) * (h - 2) / 2) + rows * (h - 1) - rows * (rows + 1) / 2 + a - 1;
  }
  std::size_t placeAlong(std::size_t from, std::size_t to, std::uint32_t step) const {
    if (step == 0) return from;
    if (step == h_) return to;
    return kCorners + std::size_t{edge_[from][to]} * (h_ - 1) + (from < to ? step : h_ - step) - 1;
  }
  // The edges along a side, from the corner after the opposite one.
  std::vector<EdgeRef> edgesAlong(std::size_t f, unsigned side) const {
    std::vector<EdgeRef> along;
    for (std::uint32_t i = 0; i < h_; ++i)
      along.push_back(edgeRef(side == 0 ? up(f, h_ - 1 - i, i) : side == 1 ? up(f, 0, h_ - 1 - i) : up(f, i, 0), side));
    return along;
  }

  std::uint32_t h_;
  std::array<Numbers, kFaces> corners_;
  std::array<std::array<std::uint32_t, kCorners>, kCorners> edge_{};
};

}  // namespace

SphereLattice sphereLattice(double edge) {
  const double wanted = 0.8 * std::numbers::pi / std::numbers::sqrt3 / (edge * edge);  // triangles of a face
  const auto offness = [&](const SphereLattice& l) {
    return std::abs(static_cast<double>(l.trianglesOfFace()) - wanted);
  };
  // Without turns triangles are slightly better: none crosses an edge of the icosahedron.
  constexpr double kNearEnough = 0.02;  // share of the triangles, twice that of lengths
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
  const std::vector<SpacePoint> in_order = placesInOrder(lattice, loop);
  const std::vector<VertexId> numbers = numbersInMesh(in_order);
  std::vector<SpacePoint> places;
  reserveOn(loop, places, in_order.size());
  places.resize(in_order.size());
  places[0] = in_order[0];
  for (std::size_t i = 1; i < in_order.size(); ++i) places[kLatticePole + numbers[i]] = in_order[i];
  return places;
}

TriMesh meshOf(const SphereLattice& lattice, const Surface& surface, const ItemLoop& loop) {
  assert(lattice.k == 0 && lattice.h > 1);
  const std::vector<SpacePoint> places = placesInOrder(lattice, loop);
  const std::vector<VertexId> numbers = numbersInMesh(places);
  TriMesh mesh;
  reserveOn(loop, mesh.points, places.size());
  mesh.points.resize(places.size());
  forEachByStretches(loop, places.size(), [&](std::size_t i) {
    mesh.points[numbers[i]] = i == 0 ? sphereCap(surface, std::vector<Point>{}).apex : planeOf(places[i], surface);
  });
  const LatticeFaces faces(lattice.h);
  reserveOn(loop, mesh.triangles, static_cast<std::size_t>(lattice.triangles()));
  mesh.triangles.resize(static_cast<std::size_t>(lattice.triangles()));
  loop(kFaces, [&](std::size_t f) { faces.fill(f, numbers, mesh.triangles); });
  faces.join(mesh.triangles);
  assert(findBrokenLink(mesh.triangles) == kNone);
  return mesh;
}

}  // namespace coastmesh
