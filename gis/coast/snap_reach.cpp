#include "gis/coast/snap_reach.hpp"

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/Math.hpp>
#include <algorithm>
#include <cmath>

namespace coastmesh {

namespace {

// Margin, since cleaning measures in a plane that is not quite conformal, or in degrees of another latitude.
constexpr double kSlack = 1.12;

double cosOfLatitude(double latitude) { return GeographicLib::Math::cosd(std::min(std::abs(latitude), 90.0)); }

// The largest number of units of a projected CRS per metre on the ground, sampled over `extent`.
double greatestScale(const GeographicMap& map, const GeographicLib::Geodesic& geodesic, double metres_per_unit,
                     const Box& extent) {
  constexpr int kPlaces = 9;           // along each side
  constexpr double kStep = 50.0;       // metres
  constexpr double kGreatest = 100.0;  // as Mercator has at 89.4 degrees; with larger ones everything would be near
  const double step = kStep / metres_per_unit;
  double greatest = 1.0 / metres_per_unit;
  for (int i = 0; i < kPlaces; ++i) {
    for (int j = 0; j < kPlaces; ++j) {
      const Point at{extent.xmin + (extent.xmax - extent.xmin) * i / (kPlaces - 1),
                     extent.ymin + (extent.ymax - extent.ymin) * j / (kPlaces - 1)};
      const LonLat here = map.forward(at);
      for (const Point& beside : {Point{at.x + step, at.y}, Point{at.x, at.y + step}}) {
        const LonLat there = map.forward(beside);
        double metres = 0.0;
        geodesic.Inverse(here.lat, here.lon, there.lat, there.lon, metres);
        if (metres > 0.0) greatest = std::max(greatest, step / metres);
      }
    }
  }
  return std::min(greatest, kGreatest / metres_per_unit);
}

}  // namespace

SnapReach::SnapReach(const SnapDistance& snap, const Crs& crs, const Box& extent) {
  if (!(snap.length > 0.0) || extent.empty()) return;
  if (snap.in_plane || crs.isPlane()) {
    length_ = units_ = most_units_ = snap.length;
    return;
  }
  length_ = kSlack * snap.length;
  geographic_ = crs.geographic;
  semi_major_m_ = crs.semi_major_m;
  flattening_ = crs.flattening;
  map_.emplace(crs);
  const double metres_per_unit = metresPerUnit(crs);
  constexpr double kBetweenPlaces = 1.5;  // the scale may be larger between the samples
  units_ = snap.length / metres_per_unit;
  most_units_ = geographic_ ? length_ / metres_per_unit
                            : kBetweenPlaces * length_ *
                                  greatestScale(*map_, {semi_major_m_, flattening_}, metres_per_unit, extent);
}

Box SnapReach::around(const Box& box) const {
  if (isNothing()) return box;
  Box result = box.grownBy(most_units_);
  if (!geographic_) return result;
  constexpr double kTurn = 360.0;
  const double cosine = std::min(cosOfLatitude(result.ymin), cosOfLatitude(result.ymax));
  const double more = most_units_ < kTurn * cosine ? most_units_ / cosine : kTurn;
  result.xmin = box.xmin - more;
  result.xmax = box.xmax + more;
  return result;
}

bool SnapReach::isNear(const Point& p, const Point& a, const Point& b) const {
  const double narrowing = geographic_ ? cosOfLatitude(p.y) : 1.0;
  const double abx = (b.x - a.x) * narrowing, aby = b.y - a.y, apx = (p.x - a.x) * narrowing, apy = p.y - a.y;
  const double square = abx * abx + aby * aby;
  const double t = square > 0.0 ? std::clamp((abx * apx + aby * apy) / square, 0.0, 1.0) : 0.0;
  const Point nearest{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
  const double gap = std::hypot((nearest.x - p.x) * narrowing, nearest.y - p.y);
  if (gap <= units_) return true;
  if (!map_ || gap > most_units_) return false;
  const LonLat from = map_->forward(p), to = map_->forward(nearest);
  double metres = 0.0;
  GeographicLib::Geodesic(semi_major_m_, flattening_).Inverse(from.lat, from.lon, to.lat, to.lon, metres);
  return metres <= length_;
}

bool SnapReach::holds(const Point& a, const Point& b, const Point& c, const Point& d) const {
  return isNear(a, c, d) || isNear(b, c, d) || isNear(c, a, b) || isNear(d, a, b);
}

}  // namespace coastmesh
