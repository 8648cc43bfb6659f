#include "gis/check/triangle_overlaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/bulk_list.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/grid/on_sphere.hpp"

namespace coastmesh {
namespace {

// Share of the longest side: the rounding of coordinates in files, for nodes on a side and for common sides of two
// pieces.
constexpr double kRounding = 1e-6;
// Share of the square of a side's length over the Earth's radius: at most this far, a side that is straight in one
// plane bends in others.
constexpr double kBend = 0.25;
constexpr double kEarthRadius = 6.4e6;  // metres

using Corners = std::array<SphereVector, 3>;

// Places in space: on the unit sphere, or in the plane z = 0.
class Places {
 public:
  Places(const Grid& grid, const ItemLoop& loop) : grid_(grid), on_sphere_(grid.crs.geographic) {
    resizeUnset(places_, grid.nodes.size());
    forEachByStretches(loop, places_.size(), [&](std::size_t node) {
      const Point& p = grid.nodes[node];
      places_[node] = on_sphere_ ? onSphere(asLonLat(p)) : SphereVector{p.x, p.y, 0.0};
    });
    if (!grid.crs.isPlane()) bend_ = on_sphere_ ? kBend : kBend / kEarthRadius;
  }

  Corners of(std::uint32_t t) const {
    const auto& [a, b, c] = grid_.triangles[t];
    return {places_[a], places_[b], places_[c]};
  }

  bool isCounterClockwise(const Corners& p) const { return dot(leftOf(p[0], p[1]), minus(p[2], p[0])) > 0.0; }

  // True if the interiors penetrate each other by more than the tolerance, along the direction that separates them
  // soonest.
  bool overlap(const Corners& a, const Corners& b) const {
    const double longest = std::max(longestSide(a), longestSide(b));
    const double allowed = longest * std::max(kRounding, bend_ * longest);
    return !isParted(a, b, allowed) && !isParted(b, a, allowed);
  }

 private:
  // The normal of a side, to its left; as long as the side.
  SphereVector leftOf(const SphereVector& from, const SphereVector& to) const {
    return cross(on_sphere_ ? from : SphereVector{0.0, 0.0, 1.0}, minus(to, from));
  }

  static double longestSide(const Corners& p) {
    double square = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const SphereVector side = minus(p[(i + 1) % 3], p[i]);
      square = std::max(square, dot(side, side));
    }
    return std::sqrt(square);
  }

  // True if all of `b` lies beyond a side of `a`.
  bool isParted(const Corners& a, const Corners& b, double allowed) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const SphereVector left = leftOf(a[i], a[(i + 1) % 3]);
      const double limit = allowed * std::sqrt(dot(left, left));
      const auto isBeyond = [&](const SphereVector& corner) { return dot(left, minus(corner, a[i])) <= limit; };
      if (std::ranges::all_of(b, isBeyond)) return true;
    }
    return false;
  }

  const Grid& grid_;
  const bool on_sphere_;
  double bend_ = 0.0;
  BulkList<SphereVector> places_;
};

// The difference of two longitudes, within ±180.
double wrapped(double degrees) { return std::abs(degrees) <= 180.0 ? degrees : std::remainder(degrees, 360.0); }

// The box in longitudes and latitudes of a triangle of great circles; its first corner's longitude is within ±180.
Box boxOnSphere(const Grid& grid, std::uint32_t t) {
  constexpr double kWide = 60.0;     // degrees: sides this long may pass near a pole
  constexpr double kSagitta = 2e-3;  // degrees of latitude per squared degree of longitude
  const auto& corners = grid.triangles[t];
  std::array<Point, 3> p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = grid.nodes[corners[i]];
  const double first = wrapped(p[0].x);
  const double turn = wrapped(p[1].x - p[0].x) + wrapped(p[2].x - p[1].x) + wrapped(p[0].x - p[2].x);
  const bool at_pole = std::ranges::any_of(p, [](const Point& corner) { return std::abs(corner.y) > 90.0 - 1e-9; });
  Box box;
  for (const Point& corner : p) box.add(Point{first + wrapped(corner.x - p[0].x), corner.y});
  const double width = box.xmax - box.xmin;
  const bool round = std::abs(turn) > 1.0 || at_pole;
  if (round || width > kWide) {
    if (box.ymax > 0.0) box.ymax = 90.0;
    if (box.ymin < 0.0) box.ymin = -90.0;
  } else {
    const double pad = kSagitta * width * width;
    box.ymin -= pad;
    box.ymax += pad;
  }
  if (round) {
    box.xmin = -180.0;
    box.xmax = 180.0;
  }
  return box;
}

Box boxOf(const Grid& grid, std::uint32_t t) {
  if (grid.crs.geographic) return boxOnSphere(grid, t);
  Box box;
  for (const std::uint32_t node : grid.triangles[t]) box.add(grid.nodes[node]);
  return box;
}

// False if all longitudes are within half a turn.
bool mayMeetATurnAway(const Grid& grid, const ItemLoop& loop) {
  if (!grid.crs.geographic || grid.nodes.empty()) return false;
  const Box all = boxAround(grid.nodes, loop);
  return !(all.xmax <= 180.0 && all.xmin >= -180.0 && all.xmax - all.xmin < 180.0);
}

Box shifted(const Box& box, double east) { return {box.xmin + east, box.ymin, box.xmax + east, box.ymax}; }

}  // namespace

std::vector<TriangleOverlap> triangleOverlaps(const Grid& grid, const TriMesh& mesh, const ItemLoop& loop) {
  const auto count = static_cast<std::uint32_t>(grid.triangles.size());
  const Places places(grid, loop);
  BulkList<std::uint8_t> stands;
  resizeUnset(stands, count);
  forEachByStretches(loop, count, [&](std::size_t t) {
    stands[t] = places.isCounterClockwise(places.of(static_cast<std::uint32_t>(t)));
  });
  const auto isLoose = [&](EdgeRef twin) { return twin == kNone || !stands[triOf(twin)]; };
  const std::vector<std::uint32_t> loose = joined(overStretches(loop, count, [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> found;
    for (auto t = static_cast<std::uint32_t>(first); t < last; ++t)
      if (stands[t] && std::ranges::any_of(mesh.triangles[t].adj, isLoose)) found.push_back(t);
    return found;
  }));
  const std::vector<double> turns = mayMeetATurnAway(grid, loop) ? std::vector{0.0, -360.0, 360.0} : std::vector{0.0};
  std::vector<Box> boxes(loose.size() * turns.size());
  std::vector<std::uint32_t> owner(boxes.size());
  forEachByStretches(loop, loose.size(), [&](std::size_t k) {
    const Box box = boxOf(grid, loose[k]);
    for (std::size_t i = 0; i < turns.size(); ++i) {
      boxes[k * turns.size() + i] = shifted(box, turns[i]);
      owner[k * turns.size() + i] = loose[k];
    }
  });
  const BoxTree tree(boxes, BoxTree::Order::Hilbert, loop);
  const auto overlapsWith = [&](std::uint32_t t, const Corners& corners, std::uint32_t k) {
    return owner[k] != t && places.overlap(corners, places.of(owner[k]));
  };
  // Consecutive triangles are mostly neighbours: far from edges without a neighbour, one search serves all.
  constexpr std::size_t kTogether = 32, kMostCandidates = 64;
  const auto findOverlaps = [&](std::uint32_t first, std::uint32_t last, std::vector<TriangleOverlap>& found) {
    std::array<Box, kTogether> box_of;
    Box all;
    for (std::uint32_t t = first; t < last; ++t) all.add(box_of[t - first] = boxOf(grid, t));
    std::vector<std::uint32_t> candidates;
    const auto isFew = [&] { return candidates.size() <= kMostCandidates; };
    tree.descend([&](const Box& node, std::size_t, std::size_t) { return isFew() && node.meets(all); },
                 [&](std::uint32_t k) { candidates.push_back(k); });
    for (std::uint32_t t = first; t < last && !candidates.empty(); ++t) {
      if (!stands[t]) continue;
      const Box& box = box_of[t - first];
      const Corners corners = places.of(t);
      std::uint32_t with = kNone;
      if (isFew()) {
        const auto at = std::ranges::find_if(
            candidates, [&](std::uint32_t k) { return boxes[k].meets(box) && overlapsWith(t, corners, k); });
        if (at != candidates.end()) with = owner[*at];
      } else {
        tree.descend([&](const Box& node, std::size_t, std::size_t) { return with == kNone && node.meets(box); },
                     [&](std::uint32_t k) {
                       if (overlapsWith(t, corners, k)) with = owner[k];
                     });
      }
      if (with != kNone) found.push_back({t, with});
    }
  };
  return joined(overStretches(loop, count, [&](std::size_t first, std::size_t last) {
    std::vector<TriangleOverlap> found;
    for (std::size_t t = first; t < last; t += kTogether)
      findOverlaps(static_cast<std::uint32_t>(t), static_cast<std::uint32_t>(std::min(t + kTogether, last)), found);
    return found;
  }));
}

}  // namespace coastmesh
