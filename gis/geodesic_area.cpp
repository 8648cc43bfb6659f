#include "gis/geodesic_area.hpp"

#include <GeographicLib/Math.hpp>
#include <GeographicLib/PolygonArea.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gis/clean.hpp"
#include "gis/ogr_support.hpp"

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

RingArea::RingArea(const Crs& crs) : plane_(crs.isPlane()), geodesic_(crs.semi_major_m, crs.flattening) {
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

double RingArea::onEllipsoid(const Ring& lonlat) const {
  GeographicLib::PolygonArea polygon(geodesic_);
  for (const Point& p : lonlat) polygon.AddPoint(p.y, p.x);
  double perimeter, area;  // the smaller part of the globe, negative where it lies to the right
  polygon.Compute(false, true, perimeter, area);
  area = std::abs(area);
  const double globe = geodesic_.EllipsoidArea(), rest = globe - area;
  Ring plain = lonlat;
  if (jumps(lonlat)) {
    plain = unrolled(lonlat);
    if (std::abs(plain.back().x - plain.front().x) > 180) return area;
  }
  const double rough = roughArea(plain) / (4 * std::numbers::pi) * globe;
  return std::abs(area - rough) <= std::abs(rest - rough) ? area : rest;
}

double geodesicArea(const Coastline& coastline, const std::vector<std::size_t>& members) {
  const RingArea area(coastline.crs);
  double sum = 0;
  for (const std::size_t member : members) {
    for (const Polygon& polygon : coastline.features[member].polygons) {
      sum += area.of(polygon.outer);
      for (const Ring& hole : polygon.holes) sum -= area.of(hole);
    }
  }
  return sum;
}

}  // namespace coastmesh
