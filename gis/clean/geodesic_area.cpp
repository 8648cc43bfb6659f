#include "gis/clean/geodesic_area.hpp"

#include <GeographicLib/Accumulator.hpp>
#include <GeographicLib/Math.hpp>
#include <GeographicLib/PolygonArea.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "gis/crs/ogr_support.hpp"

namespace coastmesh {

namespace {

double planeArea(const Ring& ring) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const Point &o = ring[0], &a = ring[i], &b = ring[i + 1];
    twice += (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
  }
  return std::abs(twice) / 2;
}

// The ring with longitudes that go on past ±180 where it crosses the antimeridian, its first point repeated at the end:
// 360 degrees further where it goes round a pole.
Ring unrolled(const Ring& lonlat) {
  Ring result = lonlat;
  result.push_back(lonlat.front());
  for (std::size_t i = 1; i < result.size(); ++i) {
    result[i].x = result[i - 1].x + GeographicLib::Math::AngDiff(lonlat[i - 1].x, lonlat[i % lonlat.size()].x);
  }
  return result;
}

// Area of a closed ring with straight edges on Lambert's cylindrical map of the unit sphere.
double roughArea(const Ring& lonlat) {
  const double degree = GeographicLib::Math::degree();
  double area = 0;
  for (std::size_t i = 0; i < lonlat.size(); ++i) {
    const Point &a = lonlat[i], &b = lonlat[(i + 1) % lonlat.size()];
    area += (b.x - a.x) * degree * (std::sin(a.y * degree) + std::sin(b.y * degree)) / 2;
  }
  return std::abs(area);
}

// True iff some edge jumps across the antimeridian. An edge from pole to pole has no length, whatever its longitudes.
bool jumps(const Ring& lonlat) {
  for (std::size_t i = 0; i < lonlat.size(); ++i) {
    const Point &a = lonlat[i], &b = lonlat[(i + 1) % lonlat.size()];
    if (std::abs(a.x - b.x) > 180 && !(a.y == b.y && std::abs(a.y) == 90)) return true;
  }
  return false;
}

}  // namespace

RingArea::RingArea(const Crs& crs) : plane_(crs.isPlane()), edges_(crs.semi_major_m, crs.flattening) {
  if (!plane_ && !crs.geographic) to_lonlat_ = std::make_unique<CrsMap>(toOgr(crs), geographicBase(crs));
}

double RingArea::of(const Ring& ring) const {
  if (ring.size() < 3) return 0;
  if (plane_) return planeArea(ring);
  if (!to_lonlat_) return onEllipsoid(ring);
  Ring lonlat;
  lonlat.reserve(ring.size());
  for (const Point& p : ring) lonlat.push_back(to_lonlat_->forward(p));
  return onEllipsoid(lonlat);
}

// None for rings whose longitudes jump or that come near to a pole.
std::optional<double> RingArea::awayFromPoles(const Ring& lonlat) const {
  constexpr double kWidest = 90, kHighest = 89;  // degrees
  GeographicLib::Accumulator<double> sum;
  EdgeArea::Vertex from = edges_.at(lonlat.back());
  for (const Point& p : lonlat) {
    const EdgeArea::Vertex to = edges_.at(p);
    if (std::abs(p.y) > kHighest || std::abs(to.lon_deg - from.lon_deg) > kWidest) return std::nullopt;
    sum += edges_.under(from, to);
    from = to;
  }
  return std::abs(sum());
}

double RingArea::onEllipsoid(const Ring& lonlat) const {
  if (const std::optional<double> area = awayFromPoles(lonlat)) return *area;
  GeographicLib::PolygonArea polygon(edges_.geodesic());
  for (const Point& p : lonlat) polygon.AddPoint(p.y, p.x);
  double perimeter, area;  // the smaller part of the globe, negative where it lies to the right
  polygon.Compute(false, true, perimeter, area);
  area = std::abs(area);
  const double globe = edges_.geodesic().EllipsoidArea(), rest = globe - area;
  Ring plain = lonlat;
  if (jumps(lonlat)) {
    plain = unrolled(lonlat);
    if (std::abs(plain.back().x - plain.front().x) > 180) return area;
  }
  const double rough = roughArea(plain) / (4 * std::numbers::pi) * globe;
  return std::abs(area - rough) <= std::abs(rest - rough) ? area : rest;
}

double geodesicArea(const Coastline& coastline, const std::vector<std::size_t>& members, const ItemLoop& loop) {
  const RingArea area(coastline.crs);
  std::vector<std::pair<const Ring*, double>> rings;  // with the sign that they count with
  for (const std::size_t member : members) {
    if (coastline.features[member].use != FeatureUse::Area) continue;
    for (const Polygon& polygon : coastline.features[member].polygons) {
      rings.emplace_back(&polygon.outer, 1);
      for (const Ring& hole : polygon.holes) rings.emplace_back(&hole, -1);
    }
  }
  std::vector<double> areas(rings.size());
  constexpr std::size_t kWorthAStretch = 32;
  const auto work = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) areas[i] = rings[i].second * area.of(*rings[i].first);
  };
  forStretches(loop, rings.size(), work, kWorthAStretch);
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

namespace {

// Karney, "Algorithms for geodesics" (2013), Section 6: the area between an edge and the equator, added up along rings
// with the inside to their left. Which of the areas that differ by half the globe is meant, crossings of a meridian
// tell.
class AreaSum {
 public:
  explicit AreaSum(const Crs& crs) : edges_(crs.semi_major_m, crs.flattening) {}

  void add(const Point& from, const Point& to) {
    using GeographicLib::Math;
    constexpr double kWidest = 90, kHighest = 89;  // degrees
    double area = 0, unused = 0;
    if (std::abs(from.x - to.x) < kWidest && std::max(std::abs(from.y), std::abs(to.y)) < kHighest) {
      area = edges_.under(edges_.at(from), edges_.at(to));
    } else {
      edges_.geodesic().GenInverse(from.y, from.x, to.y, to.x, GeographicLib::Geodesic::AREA, unused, unused, unused,
                                   unused, unused, unused, area);
    }
    sum_ -= area;
    const double step = Math::AngDiff(from.x, to.x);
    const bool west_before = Math::AngNormalize(from.x) < 0, west_after = Math::AngNormalize(to.x) < 0;
    // Only where the meridian of 0 degrees is crossed, not the one of 180.
    if ((step > 0 && west_before && !west_after) || (step < 0 && !west_before && west_after)) odd_ = !odd_;
  }

  double area() const {
    const double globe = edges_.geodesic().EllipsoidArea();
    const double area = std::fmod(sum_() + (odd_ ? globe / 2 : 0), globe);
    return area < 0 ? area + globe : area;
  }

 private:
  EdgeArea edges_;
  GeographicLib::Accumulator<double> sum_;
  bool odd_ = false;
};

}  // namespace

double geodesicArea(const Domain& domain, const Crs& crs) {
  std::vector<Point> places = domain.input_points;
  if (!crs.isPlane() && !crs.geographic) {
    const CrsMap to_lonlat(toOgr(crs), geographicBase(crs));
    for (Point& p : places) p = to_lonlat.forward(p);
  }
  double twice = 0;
  AreaSum sum(crs);
  for (const Segment& s : domain.pslg.segments) {
    if ((s.left >= 0) == (s.right >= 0)) continue;
    const Point &a = places[s.left >= 0 ? s.a : s.b], &b = places[s.left >= 0 ? s.b : s.a], &o = places.front();
    if (crs.isPlane()) {
      twice += (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
    } else {
      sum.add(a, b);
    }
  }
  return crs.isPlane() ? twice / 2 : sum.area();
}

}  // namespace coastmesh
