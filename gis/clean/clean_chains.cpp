#include "gis/clean/clean_chains.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>
#include <optional>
#include <span>
#include <tuple>

#include "gis/clean/clean_touches.hpp"
#include "gis/clean/seam.hpp"
#include "gis/clean/small_islands.hpp"
#include "gis/clean/torn_edges.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/coast/flood_plains.hpp"
#include "gis/coast/input_polygons.hpp"
#include "gis/error.hpp"
#include "gis/geometry/box.hpp"
#include "gis/geometry/point_grid.hpp"

namespace coastmesh {

namespace {

// A chain of the input that takes part in cleaning.
struct InputChain {
  CleanChain::Role role;
  std::uint32_t feature;
  std::vector<Point> points;
};

std::vector<InputChain> gather(const Coastline& coastline, const std::vector<std::size_t>& members,
                               const CleanOptions& options, CleanReport& report) {
  using Role = CleanChain::Role;
  std::vector<InputChain> chains;
  std::optional<SmallIslands> small;
  std::optional<AreasWithin> areas;
  if (options.min_island_area_m2 > 0)
    small.emplace(coastline, members, options.min_island_area_m2,
                  options.areas != nullptr ? *options.areas : areas.emplace(coastline));
  for (const std::size_t member : members) {
    const Feature& feature = coastline.features[member];
    const auto index = static_cast<std::uint32_t>(member);
    std::vector<Polygon> larger;
    if (small)
      larger = small->without(member, [&](const Point& p) { report.add(EditKind::SmallIsland, p, coastline, member); });
    // If a region has lines, they are its border, cleaned before.
    const bool by_lines = feature.use == FeatureUse::Region && !feature.lines.empty();
    for (const Polygon& polygon : small ? larger : feature.polygons) {
      if (by_lines) break;
      if (!polygon.outer.empty()) chains.push_back({Role::Outer, index, polygon.outer});
      for (const Ring& hole : polygon.holes)
        if (!hole.empty()) chains.push_back({Role::Hole, index, hole});
    }
    for (const auto& line : feature.lines) {
      if (!line.empty()) chains.push_back({Role::Line, index, line});
    }
    for (const Point& point : feature.points) chains.push_back({Role::Point, index, {point}});
  }
  return chains;
}

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

void keepTouches(std::vector<InputChain>& chains, const Coastline& coastline, double snap_m, CleanReport& report,
                 const ItemLoop& loop) {
  std::vector<TouchChain> touching;
  touching.reserve(chains.size());
  for (InputChain& chain : chains) {
    touching.push_back({&chain.points, chain.role == CleanChain::Role::Outer || chain.role == CleanChain::Role::Hole});
  }
  const double tolerance = std::max(0.0, snap_m) / metresPerUnit(coastline.crs);
  const double widest = coastline.crs.geographic ? 180 : kNoLimit;
  for (const Touch& touch : insertTouchingPoints(touching, tolerance, widest, loop)) {
    if (!isReported(coastline.features[chains[touch.chain].feature])) continue;
    report.add(EditKind::OverlappingEdge, touch.place, coastline, chains[touch.chain].feature);
  }
}

const Point& requirePlace(const Point& plane, const Point& input, const Feature& feature,
                          const Projection& projection) {
  if (std::isfinite(plane.x) && std::isfinite(plane.y)) return plane;
  throw InputError(featureInWords(feature) + ": the point " + std::to_string(input.x) + ", " + std::to_string(input.y) +
                   " has no place in the working plane (" + projection.description() +
                   "): check the coordinates and their CRS");
}

// All points of the chains in the plane, chain after chain.
std::vector<Point> projectAll(const std::vector<InputChain>& chains, std::size_t count, const Projection& projection,
                              const ItemLoop& loop) {
  std::vector<std::size_t> first;
  first.reserve(chains.size());
  for (std::size_t c = 0, at = 0; c < chains.size(); at += chains[c++].points.size()) first.push_back(at);
  std::vector<Point> plane;
  reserveOn(loop, plane, count);
  plane.resize(count);
  constexpr std::size_t kWorthAStretch = 2048;
  const auto work = [&](std::size_t from, std::size_t to) {
    auto c = static_cast<std::size_t>(std::ranges::upper_bound(first, from) - first.begin()) - 1;
    for (std::size_t i = from; i < to; ++i) {
      while (i - first[c] >= chains[c].points.size()) ++c;
      plane[i] = projection.forward(chains[c].points[i - first[c]]);
    }
  };
  if (count > 0) forStretches(loop, count, work, kWorthAStretch);
  return plane;
}

void requireUntorn(const std::vector<InputChain>& chains, const std::vector<Point>& plane, const Coastline& coastline,
                   const Projection& projection) {
  Box box;
  for (const Point& p : plane) box.add(p);
  const double extent = std::hypot(box.xmax - box.xmin, box.ymax - box.ymin);
  std::span<const Point> rest(plane);
  for (const InputChain& chain : chains) {
    const Feature& feature = coastline.features[chain.feature];
    const bool closed = chain.role == CleanChain::Role::Outer || chain.role == CleanChain::Role::Hole;
    requireUntorn({featureInWords(feature), chain.points, rest.first(chain.points.size()), closed}, extent,
                  coastline.crs, projection);
    rest = rest.subspan(chain.points.size());
  }
}

// Turns input points into vertices.
class VertexMaker {
 public:
  VertexMaker(CleanVertices& vertices, double snap, std::size_t expected)
      : vertices_(vertices), grid_(vertices.plane, snap, expected) {
    vertices.plane.reserve(expected);
    vertices.input.reserve(expected);
  }

  // Returns the vertex for a point. `snapped` is set to true if that is another point nearby.
  VertexId make(const Point& plane, const Point& input, bool& snapped) {
    const VertexId found = grid_.find(plane);
    if (found != kNone) {
      snapped = !(vertices_.plane[found] == plane);
      return found;
    }
    const auto v = static_cast<VertexId>(vertices_.plane.size());
    vertices_.plane.push_back(plane);
    vertices_.input.push_back(input);
    grid_.add(v);
    return v;
  }
  void prefetch(const Point& plane) const { grid_.prefetch(plane); }

 private:
  CleanVertices& vertices_;
  PointGrid grid_;
};

// Removes spikes from a ring without repeated vertices: a, b, a becomes a. Calls `spike(b)`.
template <typename Spike>
std::vector<VertexId> withoutSpikes(const std::vector<VertexId>& ring, Spike&& spike) {
  std::vector<VertexId> kept;
  for (const VertexId v : ring) {
    if (kept.size() >= 2 && kept[kept.size() - 2] == v) {
      spike(kept.back());
      kept.pop_back();
    } else {
      kept.push_back(v);
    }
  }
  // The same where the ring closes.
  std::size_t first = 0, last = kept.size();
  while (last - first > 2) {
    if (kept[first] == kept[last - 1]) {
      --last;
    } else if (kept[first] == kept[last - 2]) {
      spike(kept[last - 1]);
      last -= 2;
    } else if (kept[first + 1] == kept[last - 1]) {
      spike(kept[first]);
      ++first;
      --last;
    } else {
      break;
    }
  }
  return {kept.begin() + static_cast<std::ptrdiff_t>(first), kept.begin() + static_cast<std::ptrdiff_t>(last)};
}

// Reduces a ring that is traced several times over to one round. Returns true for such a ring.
bool traceOnce(std::vector<VertexId>& walk) {
  const auto again = std::find(walk.begin() + 1, walk.end(), walk.front());
  const auto once = static_cast<std::size_t>(again - walk.begin());
  if (again == walk.end() || once < 3 || walk.size() % once != 0) return false;
  for (std::size_t i = once; i < walk.size(); ++i)
    if (walk[i] != walk[i - once]) return false;
  walk.resize(once);
  return true;
}

// True if two rings have the same vertices in the same order, from any start and in either direction.
bool isSameRing(const std::vector<VertexId>& a, const std::vector<VertexId>& b) {
  if (a.size() != b.size()) return false;
  const std::size_t n = a.size();
  const auto start = static_cast<std::size_t>(std::ranges::find(b, a.front()) - b.begin());
  if (start == n) return false;
  bool forward = true, backward = true;
  for (std::size_t i = 0; i < n && (forward || backward); ++i) {
    forward = forward && a[i] == b[(start + i) % n];
    backward = backward && a[i] == b[(start + n - i) % n];
  }
  return forward || backward;
}

// Removes rings that a feature repeats in the same role: by the even-odd rule they would cancel each other. Calls
// `drop(ring)` for each.
template <typename Drop>
void dropRepeatedRings(std::vector<CleanChain>& chains, Drop&& drop) {
  // Rings that may be the same are adjacent, in their order.
  struct Key {
    std::uint32_t feature;
    CleanChain::Role role;
    std::size_t size;
    VertexId least;
    std::size_t chain;
    auto operator<=>(const Key&) const = default;
  };
  std::vector<Key> keys;
  for (std::size_t c = 0; c < chains.size(); ++c)
    if (chains[c].isRing())
      keys.push_back(
          {chains[c].feature, chains[c].role, chains[c].walk.size(), *std::ranges::min_element(chains[c].walk), c});
  std::ranges::sort(keys);
  std::vector<bool> repeated(chains.size(), false);
  const auto isAlike = [](const Key& a, const Key& b) {
    return std::tie(a.feature, a.role, a.size, a.least) == std::tie(b.feature, b.role, b.size, b.least);
  };
  for (std::size_t k = 1, first = 0; k < keys.size(); ++k) {
    if (!isAlike(keys[first], keys[k])) first = k;
    // Different rings may share their least vertex.
    repeated[keys[k].chain] = std::any_of(keys.begin() + static_cast<std::ptrdiff_t>(first),
                                          keys.begin() + static_cast<std::ptrdiff_t>(k), [&](const Key& before) {
                                            return !repeated[before.chain] &&
                                                   isSameRing(chains[before.chain].walk, chains[keys[k].chain].walk);
                                          });
  }
  for (std::size_t c = 0; c < chains.size(); ++c)
    if (repeated[c]) drop(chains[c]);
  std::size_t c = 0;
  std::erase_if(chains, [&](const CleanChain&) { return repeated[c++]; });
}

// Over a sample of the points: least and greatest scale, and the grain of coordinates, below which a snap distance has
// no effect.
struct Scales {
  double least = std::numeric_limits<double>::infinity(), greatest = 0.0;
  double grain = std::numeric_limits<double>::infinity();
};

Scales scalesOf(const std::vector<InputChain>& chains, const Coastline& coastline, const Projection& projection) {
  constexpr std::size_t kLeastSample = 8, kMostSample = 256, kPointsForOne = 64;
  Scales scales;
  const auto take = [&](const InputChain& chain, const Point& point) {
    const Point plane = requirePlace(projection.forward(point), point, coastline.features[chain.feature], projection);
    const double scale = projection.scaleAt(plane);
    scales.least = std::min(scales.least, scale);
    scales.greatest = std::max(scales.greatest, scale);
    scales.grain = std::min(scales.grain, std::ldexp(std::max(std::abs(plane.x), std::abs(plane.y)), -46));
  };
  std::size_t count = 0, passed = 0;
  for (const InputChain& chain : chains) count += chain.points.size();
  const std::size_t step =
      std::max<std::size_t>(1, count / std::clamp(count / kPointsForOne, kLeastSample, kMostSample));
  for (const InputChain& chain : chains) {
    for (std::size_t i = (step - passed % step) % step; i < chain.points.size(); i += step)
      take(chain, chain.points[i]);
    passed += chain.points.size();
  }
  return scales;
}

// Features whose rings contain the plane's point at infinity, `place`; ascending.
std::vector<std::uint32_t> holdersOf(const Point& place, const Coastline& coastline,
                                     const std::vector<std::size_t>& members) {
  std::vector<std::uint32_t> holders;
  const auto holds = [&](const Feature& feature) {
    const bool may_jump = coastline.crs.geographic && feature.use != FeatureUse::Frame;
    return InputPolygons(feature.polygons, may_jump).holdAtAnyTurn(place);
  };
  for (const bool frames : {true, false}) {  // usually no frame contains it; others extend little beyond
    for (const std::size_t member : members) {
      const Feature& feature = coastline.features[member];
      if ((feature.use == FeatureUse::Frame) == frames && holds(feature)) {
        holders.push_back(static_cast<std::uint32_t>(member));
      }
    }
    if (holders.empty()) break;
  }
  std::ranges::sort(holders);
  return holders;
}

}  // namespace

CleanChains makeChains(const Coastline& coastline, const std::vector<std::size_t>& members,
                       const Projection& projection, const CleanOptions& options, CleanReport& report,
                       const ItemLoop& loop) {
  std::vector<InputChain> input = gather(coastline, members, options, report);
  std::vector<Ring*> rings;
  for (InputChain& chain : input) {
    if (chain.role == CleanChain::Role::Outer || chain.role == CleanChain::Role::Hole) rings.push_back(&chain.points);
  }
  if (!projection.isIdentity()) keepTouches(input, coastline, options.snap_m, report, loop);
  const std::optional<Seam> seam = healSeam(rings, coastline.crs, projection);
  std::size_t count = 0;
  for (const InputChain& chain : input) count += chain.points.size();

  CleanChains result;
  for (const std::size_t member : members) {
    const FeatureUse use = coastline.features[member].use;
    result.framed = result.framed || use == FeatureUse::Frame;
    result.land = result.land || use == FeatureUse::Land;
    result.coast = result.coast || use == FeatureUse::Coast;
  }
  result.seam = seam;
  const Scales scales = scalesOf(input, coastline, projection);
  // By the smallest scale, so that nowhere more than requested is snapped.
  const double snap = input.empty() || options.snap_m <= 0 ? 0 : options.snap_m * scales.least;
  result.snap = snap > scales.grain ? snap : 0;
  if (const std::optional<Point> beyond = projection.infinity()) {
    result.beyond = holdersOf(*beyond, coastline, members);
  }
  const std::vector<Point> plane = projectAll(input, count, projection, loop);
  if (projection.mayTear()) requireUntorn(input, plane, coastline, projection);
  constexpr std::size_t kAhead = 16;
  std::size_t at = 0;
  VertexMaker maker(result.vertices, result.snap, count);
  for (const std::size_t member : members) {
    const Feature& feature = coastline.features[member];
    bool snapped = false;
    for (const Point& point : feature.vertex_order)
      maker.make(requirePlace(projection.forward(point), point, feature, projection), point, snapped);
  }
  for (InputChain& chain : input) {
    const Feature& feature = coastline.features[chain.feature];
    const bool closed = chain.role == CleanChain::Role::Outer || chain.role == CleanChain::Role::Hole;
    const bool reported = isReported(feature);
    CleanChain made{chain.role, chain.feature, {}};
    made.walk.reserve(chain.points.size());
    bool snapped = false;
    for (const Point& point : chain.points) {
      snapped = false;
      if (at + kAhead < plane.size()) maker.prefetch(plane[at + kAhead]);
      const VertexId v = maker.make(requirePlace(plane[at++], point, feature, projection), point, snapped);
      const bool repeated = !made.walk.empty() && made.walk.back() == v;
      if (reported && (snapped || repeated)) report.add(EditKind::RepeatedPoint, point, coastline, chain.feature);
      if (!repeated) made.walk.push_back(v);
    }
    while (closed && made.walk.size() > 1 && made.walk.front() == made.walk.back()) {
      if (reported && !snapped) report.add(EditKind::RepeatedPoint, chain.points.back(), coastline, chain.feature);
      made.walk.pop_back();
    }
    if (closed) {
      made.walk = withoutSpikes(made.walk, [&](VertexId v) {
        if (reported) report.add(EditKind::Spike, result.vertices.input[v], coastline, chain.feature);
      });
    }
    if (closed && made.walk.size() > 3 && traceOnce(made.walk) && reported)
      report.add(EditKind::RepeatedRing, result.vertices.input[made.walk.front()], coastline, chain.feature);
    if (made.walk.size() < (closed ? 3u : chain.role == CleanChain::Role::Point ? 1u : 2u)) {
      if (reported) report.add(EditKind::DegenerateRing, chain.points.front(), coastline, chain.feature);
      continue;
    }
    std::vector<Point>().swap(chain.points);
    result.chains.push_back(std::move(made));
  }
  dropRepeatedRings(result.chains, [&](const CleanChain& ring) {
    if (isReported(coastline.features[ring.feature]))
      report.add(EditKind::RepeatedRing, result.vertices.input[ring.walk.front()], coastline, ring.feature);
  });
  result.vertices.is_new.assign(result.vertices.plane.size(), 0);
  result.resolution =
      resolutionOf(result.vertices.plane, result.vertices.input, coastline.crs, scales.greatest, result.snap);
  return result;
}

}  // namespace coastmesh
