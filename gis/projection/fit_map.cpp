#include "gis/projection/fit_map.hpp"

#include <GeographicLib/Math.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <optional>

#include "gis/error.hpp"
#include "gis/geometry/chain_index.hpp"

namespace coastmesh {

namespace {

using GeographicLib::Math;

struct Direction {
  double x = 0, y = 0, z = 0;
};

double dot(const Direction& u, const Direction& v) { return u.x * v.x + u.y * v.y + u.z * v.z; }

Direction toDirection(const LonLat& place) {
  double sin_lon, cos_lon, sin_lat, cos_lat;
  Math::sincosd(place.lon, sin_lon, cos_lon);
  Math::sincosd(place.lat, sin_lat, cos_lat);
  return {cos_lat * cos_lon, cos_lat * sin_lon, sin_lat};
}

LonLat toLonLat(const Direction& d) { return {Math::atan2d(d.y, d.x), Math::atan2d(d.z, std::hypot(d.x, d.y))}; }

double degreesBetween(const Direction& u, const Direction& v) {
  const double chord = std::sqrt(std::max(0.0, 2 - 2 * dot(u, v)));
  return 2 * std::asin(std::min(1.0, chord / 2)) / Math::degree();
}

// Like the library's, but faster for most longitudes.
double angNormalize(double x) { return x > -180 && x < 180 ? x : Math::AngNormalize(x); }
double angDiff(double x, double y) {
  const double d = y - x;
  return std::abs(x) < 180 && std::abs(y) < 180 && std::abs(d) < 180 ? d : Math::AngDiff(x, y);
}

constexpr std::size_t kLonCells = 360, kLatCells = 180;

// Reduces many points to the outermost ones in each cell of one degree, which is enough for radii and centres.
std::vector<Direction> thinned(const std::vector<LonLat>& places) {
  std::vector<Direction> directions;
  if (places.size() < kLonCells * kLatCells) {
    for (const LonLat& p : places) directions.push_back(toDirection(p));
    return directions;
  }
  std::vector<std::uint32_t> number(kLonCells * kLatCells, 0);  // of the cell among those used, from 1; 0: unused
  std::vector<std::array<LonLat, 4>> outermost;
  for (const LonLat& given : places) {
    const LonLat p{angNormalize(given.lon), given.lat};
    const auto i = static_cast<std::size_t>(std::clamp(p.lon + 180, 0.0, 359.0));
    const auto j = static_cast<std::size_t>(std::clamp(p.lat + 90, 0.0, 179.0));
    std::uint32_t& cell = number[j * kLonCells + i];
    if (cell == 0) {
      outermost.push_back({p, p, p, p});
      cell = static_cast<std::uint32_t>(outermost.size());
    }
    auto& [west, east, south, north] = outermost[cell - 1];
    if (p.lon < west.lon) west = p;
    if (p.lon > east.lon) east = p;
    if (p.lat < south.lat) south = p;
    if (p.lat > north.lat) north = p;
  }
  for (const std::uint32_t cell : number) {
    if (cell == 0) continue;
    for (const LonLat& p : outermost[cell - 1]) directions.push_back(toDirection(p));
  }
  return directions;
}

// The shortest arc of longitudes, and the range of latitudes.
struct Extent {
  double mid_lon = 0, width = 0;
  double south = 90, north = -90;

  double midLat() const { return (south + north) / 2; }
  double height() const { return north - south; }
};

Extent extentOf(const std::vector<LonLat>& places) {
  Extent extent;
  std::array<bool, kLonCells> used{};
  for (const LonLat& p : places) {
    extent.south = std::min(extent.south, p.lat);
    extent.north = std::max(extent.north, p.lat);
    if (std::abs(p.lat) == 90) continue;  // a pole has no longitude
    used[static_cast<std::size_t>(std::clamp(angNormalize(p.lon) + 180, 0.0, 359.0))] = true;
  }
  // The arc is opposite the middle of the longest run of empty cells around the globe.
  std::size_t best_run = 0, best_end = 0, run = 0;
  for (std::size_t i = 0; i < 2 * kLonCells; ++i) {
    run = used[i % kLonCells] ? 0 : run + 1;
    if (run > best_run && run <= kLonCells) {
      best_run = run;
      best_end = i;
    }
  }
  const double empty_mid = static_cast<double>(best_end) + 1 - static_cast<double>(best_run) / 2 - 180;
  const double roughly = Math::AngNormalize(empty_mid + 180);
  double west = 180, east = -180;
  for (const LonLat& p : places) {
    if (std::abs(p.lat) == 90) continue;
    const double d = angDiff(roughly, p.lon);
    west = std::min(west, d);
    east = std::max(east, d);
  }
  if (west > east) return extent;  // poles only
  extent.mid_lon = Math::AngNormalize(roughly + (west + east) / 2);
  extent.width = east - west;
  return extent;
}

// A cap of the sphere.
struct Cap {
  LonLat centre;
  double radius = 0;  // degrees
};

Cap capAround(const LonLat& centre, const std::vector<Direction>& directions) {
  const Direction middle = toDirection(centre);
  Direction farthest = middle;
  double least = std::numeric_limits<double>::infinity();
  for (const Direction& d : directions) {
    const double cosine = dot(middle, d);
    if (cosine < least) {
      least = cosine;
      farthest = d;
    }
  }
  return {centre, degreesBetween(middle, farthest)};
}

// The smallest of a few caps: about the middle of the extent, the mean direction, the poles. A pole is preferred if the
// smallest contains it and its own radius is less than a tenth larger.
Cap leastCap(const Extent& extent, const std::vector<Direction>& directions) {
  Cap best = capAround({extent.mid_lon, extent.midLat()}, directions);
  Direction mean;
  for (const Direction& d : directions) mean = {mean.x + d.x, mean.y + d.y, mean.z + d.z};
  const Cap about_mean = capAround(toLonLat(mean), directions);
  if (about_mean.radius < best.radius) best = about_mean;
  for (const double pole : {90.0, -90.0}) {
    const Cap about_pole = capAround({extent.mid_lon, pole}, directions);
    if (about_pole.radius < 1.1 * best.radius &&
        degreesBetween(toDirection(best.centre), {0, 0, pole / 90}) < best.radius)
      best = about_pole;
  }
  return best;
}

// The area left out of the domain: on land, or in no group; on land alone if all groups are.
class LeftOut {
 public:
  explicit LeftOut(const std::vector<RingGroup>& groups) {
    for (const RingGroup& group : groups) {
      if (group.rings.empty()) continue;
      ChainIndex& index = (group.is_land ? land_ : water_).emplace_back(ChainIndex::Kind::Rings);
      for (const Ring* ring : group.rings) index.add(*ring);
      index.build();
    }
  }

  bool holds(const Point& p) const {
    const auto isIn = [&](const ChainIndex& index) { return index.locate(p) == Location::Inside; };
    const auto touches = [&](const ChainIndex& index) { return index.locate(p) != Location::Outside; };
    if (std::ranges::any_of(land_, isIn)) return true;
    const bool is_around_land = water_.empty() && !land_.empty();
    return !is_around_land && std::ranges::none_of(water_, touches);
  }

 private:
  std::vector<ChainIndex> land_, water_;
};

// Of the places offered, the one in the area left out that is furthest from all vertices.
class Clearest {
 public:
  Clearest(const std::vector<RingGroup>& groups, double west, const std::vector<Direction>& directions)
      : left_out_(groups), west_(west), directions_(directions) {}

  void offer(const LonLat& trial) {
    const Direction d = toDirection(trial);
    double nearest = -1;
    for (const Direction& vertex : directions_) nearest = std::max(nearest, dot(d, vertex));
    const double clearance = std::acos(std::clamp(nearest, -1.0, 1.0)) / Math::degree();
    if (clearance <= clearance_) return;
    const Point as_given{west_ + std::fmod(trial.lon - west_ + 720, 360.0), trial.lat};
    if (!left_out_.holds(as_given)) return;
    best_ = trial;
    clearance_ = clearance;
  }

  const std::optional<LonLat>& best() const { return best_; }

 private:
  static constexpr double kLeastClearance = 0.5;

  LeftOut left_out_;
  double west_;
  const std::vector<Direction>& directions_;
  std::optional<LonLat> best_;
  double clearance_ = kLeastClearance;  // degrees
};

// Offers places on a spiral from pole to pole, both included, some 3 degrees apart.
void offerSpiral(Clearest& clearest) {
  constexpr int kTrials = 4000;
  for (int i = 0; i < kTrials; ++i) {
    const double z = 1 - 2.0 * i / (kTrials - 1);
    const double lon = std::fmod(i * 180 * (3 - std::sqrt(5.0)), 360.0);
    clearest.offer({lon, std::asin(std::clamp(z, -1.0, 1.0)) / Math::degree()});
  }
}

// Offers places in the boxes of the largest rings, for land or holes between the places of the spiral.
void offerInsides(const std::vector<RingGroup>& groups, Clearest& clearest) {
  constexpr std::size_t kMostRings = 200;
  constexpr int kAlong = 7;
  struct Bounds {
    double west = 540, east = -540, south = 90, north = -90;
    double smaller() const { return std::min(east - west, north - south); }
  };
  std::vector<Bounds> extents;
  for (const RingGroup& group : groups) {
    for (const Ring* ring : group.rings) {
      Bounds& e = extents.emplace_back();
      for (const Point& p : *ring) {
        e.west = std::min(e.west, p.x);
        e.east = std::max(e.east, p.x);
        e.south = std::min(e.south, p.y);
        e.north = std::max(e.north, p.y);
      }
    }
  }
  std::ranges::stable_sort(extents, std::ranges::greater(), &Bounds::smaller);
  extents.resize(std::min(extents.size(), kMostRings));
  for (const Bounds& e : extents) {
    for (int i = 1; i <= kAlong; ++i) {
      for (int j = 1; j <= kAlong; ++j) {
        constexpr double kParts = kAlong + 1;
        clearest.offer({e.west + (e.east - e.west) * i / kParts, e.south + (e.north - e.south) * j / kParts});
      }
    }
  }
}

// The centre of a stereographic projection of more than a hemisphere: its antipode, which has no image, is as far
// inside the area left out as possible. Throws InputError if that area is too small.
LonLat centreAwayFromLand(const std::vector<RingGroup>& groups, double west, const std::vector<Direction>& directions) {
  Clearest clearest(groups, west, directions);
  offerSpiral(clearest);
  if (!clearest.best()) offerInsides(groups, clearest);
  if (!clearest.best()) {
    throw InputError(
        "no gap on the globe is left that is wider than about 100 km, which the projection needs: leave some area out, "
        "as --bbox=-180,-85,180,90 does around the south pole");
  }
  return {Math::AngNormalize(clearest.best()->lon + 180), -clearest.best()->lat};
}

std::string degreesInWords(double degrees) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g°", degrees == 0 ? 0.0 : degrees);
  return text;
}

FittedMap polar(const LonLat& centre, const Ellipsoid& ellipsoid) {
  const bool north = centre.lat > 0;
  return {polarStereographic(ellipsoid, north, centre.lon),
          std::string("polar stereographic about the ") + (north ? "north" : "south") + " pole, central meridian " +
              degreesInWords(centre.lon),
          ""};
}

FittedMap oblique(const LonLat& centre, const Ellipsoid& ellipsoid) {
  return {obliqueStereographic(ellipsoid, centre),
          "oblique stereographic, centre at longitude " + degreesInWords(centre.lon) + ", latitude " +
              degreesInWords(centre.lat),
          ""};
}

FittedMap because(FittedMap map, const std::string& reason) {
  map.reason = reason;
  return map;
}

constexpr double kLargeCap = 30;  // degrees

// True if it is so small, and so far from the poles, that no cap around it reaches a pole or is large.
bool isPlainlySmall(const Extent& extent) {
  return extent.height() < 10 && extent.width < 20 && extent.south > -60 && extent.north < 60;
}

// A stereographic map. If its sphere is requested, a polar one uses the oblique implementation, which has a sphere.
FittedMap stereographic(const LonLat& centre, const Ellipsoid& ellipsoid, bool is_surface) {
  const bool at_pole = std::abs(centre.lat) == 90;
  FittedMap fitted = at_pole ? polar(centre, ellipsoid) : oblique(centre, ellipsoid);
  fitted.is_surface = is_surface;
  if (at_pole && is_surface) fitted.map = obliqueStereographic(ellipsoid, centre);
  return fitted;
}

// The map for an extent that is large or near a pole, or if a surface is requested; nullopt for others.
std::optional<FittedMap> mapAboutCentre(const std::vector<LonLat>& places, const std::vector<RingGroup>& groups,
                                        const Extent& extent, const Ellipsoid& ellipsoid, SurfaceKind kind) {
  const std::vector<Direction> directions = thinned(places);
  const Cap cap = leastCap(extent, directions);
  const bool asked = kind == SurfaceKind::Ellipsoid || kind == SurfaceKind::Sphere;
  const bool is_surface = asked || (kind == SurfaceKind::Auto && cap.radius > kLargeCap);
  if (cap.radius > 90) {
    const double west = std::ranges::min(places, {}, &LonLat::lon).lon;  // longitudes may run from -180 or from 0
    const LonLat centre = centreAwayFromLand(groups, west, directions);
    return because(stereographic(centre, ellipsoid, is_surface),
                   "larger than a hemisphere: projected away from the middle of what is left out");
  }
  const std::string radius = "lies within " + degreesInWords(cap.radius) + " of ";
  if (std::abs(cap.centre.lat) == 90) {
    return because(stereographic(cap.centre, ellipsoid, is_surface), radius + "the pole");
  }
  const bool holds_pole = 90 - std::abs(cap.centre.lat) <= cap.radius;
  if (cap.radius > kLargeCap || holds_pole || is_surface) {
    return because(stereographic(cap.centre, ellipsoid, is_surface),
                   radius + "the centre" + (holds_pole ? ", a pole among it" : ""));
  }
  return std::nullopt;
}

FittedMap chooseMap(const std::vector<LonLat>& places, const std::vector<RingGroup>& groups, const Ellipsoid& ellipsoid,
                    SurfaceKind kind) {
  constexpr double kElongated = 1.5;
  const Extent extent = extentOf(places);
  if (!isPlainlySmall(extent) || kind == SurfaceKind::Ellipsoid || kind == SurfaceKind::Sphere) {
    if (std::optional<FittedMap> map = mapAboutCentre(places, groups, extent, ellipsoid, kind)) return std::move(*map);
  }
  const LonLat middle{extent.mid_lon, extent.midLat()};
  const double width = extent.width * std::cos(middle.lat * Math::degree());
  const std::string spans = "spans " + degreesInWords(extent.height()) + " from south to north and " +
                            degreesInWords(width) + " of arc from west to east: ";
  if (extent.height() >= kElongated * width) {
    return {transverseMercator(ellipsoid, middle),
            "transverse Mercator, central meridian " + degreesInWords(middle.lon), spans + "long from south to north"};
  }
  if (width >= kElongated * extent.height()) {
    const double parallel1 = extent.south + extent.height() / 6, parallel2 = extent.north - extent.height() / 6;
    return {lambertConic(ellipsoid, middle, parallel1, parallel2),
            "Lambert conformal conic, central meridian " + degreesInWords(middle.lon) + ", parallels " +
                degreesInWords(parallel1) + " and " + degreesInWords(parallel2),
            spans + "long from west to east"};
  }
  return because(oblique(middle, ellipsoid), spans + "as wide as long");
}

}  // namespace

FittedMap fitMap(const std::vector<LonLat>& places, const std::vector<RingGroup>& groups, const Ellipsoid& ellipsoid,
                 SurfaceKind kind) {
  return chooseMap(places, groups, ellipsoid, kind);
}

FittedMap mapOfEmptyGlobe(const Ellipsoid& ellipsoid) {
  return because(stereographic({17.3, 40.9}, ellipsoid, true), "the globe is empty");
}

}  // namespace coastmesh
