#include "gis/projection/distortion.hpp"

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/Math.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/metric.hpp"
#include "gis/crs/geographic_map.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

namespace {

class DistortionMeter {
 public:
  explicit DistortionMeter(const Crs& crs) : map_(crs), geodesic_(crs.semi_major_m, crs.flattening) {
    constexpr double kStep = 50.0;  // metres: neither curvature nor rounding matters
    step_ = kStep / metresPerUnit(crs);
  }

  // At a point of the plane, whose image in the input's CRS is `place`: the ratio of the axes of the ellipse that a
  // small circle on the ground becomes (Tissot's indicatrix). nullopt if the point has no image on Earth.
  std::optional<Distortion> at(const Point& plane, const Point& place) const {
    const Vector x = onGround({plane.x - step_, plane.y}, {plane.x + step_, plane.y});
    const Vector y = onGround({plane.x, plane.y - step_}, {plane.x, plane.y + step_});
    // Singular values of the matrix of columns x and y.
    const double sum = std::hypot(x.east + y.north, x.north - y.east);
    const double difference = std::hypot(x.east - y.north, x.north + y.east);
    const double large = sum + difference, small = std::abs(sum - difference);
    if (!std::isfinite(large) || !(large > 0.0)) return std::nullopt;
    return Distortion{large / small, toDegrees(2.0 * std::asin((large - small) / (large + small))), place};
  }

 private:
  struct Vector {
    double east, north;
  };
  Vector onGround(const Point& p, const Point& q) const {
    const LonLat from = map_.forward(p), to = map_.forward(q);
    double metres, azimuth, other_azimuth, sine, cosine;
    geodesic_.Inverse(from.lat, from.lon, to.lat, to.lon, metres, azimuth, other_azimuth);
    // The azimuth in the middle, where both vectors are measured.
    azimuth += GeographicLib::Math::AngDiff(azimuth, other_azimuth) / 2.0;
    GeographicLib::Math::sincosd(azimuth, sine, cosine);
    return {metres * sine, metres * cosine};
  }

  GeographicMap map_;
  GeographicLib::Geodesic geodesic_;
  double step_ = 0.0;
};

// The chains that bound the domain: only the frame, if water lies between it and land, which may extend far beyond;
// otherwise all rings and lines within the box of the frame.
class BoundingChains {
 public:
  explicit BoundingChains(const Coastline& coastline) : coastline_(coastline) {
    bool shores = false;
    for (const Feature& feature : coastline.features) {
      shores = shores || feature.use == FeatureUse::Land || feature.use == FeatureUse::Coast;
      if (feature.use != FeatureUse::Frame) continue;
      for (const Polygon& polygon : feature.polygons)
        for (const Point& p : polygon.outer) frame_.add(p);
    }
    frame_only_ = shores && !frame_.empty();
  }

  bool holds(const Point& p) const { return frame_.empty() || frame_.meets(Box::of(p, p)); }

  template <typename Act>
  void forEach(Act&& act) const {
    for (const Feature& feature : coastline_.features) {
      const bool frame = feature.use == FeatureUse::Frame;
      const bool shore =
          feature.use == FeatureUse::Area || feature.use == FeatureUse::Land || feature.use == FeatureUse::Coast;
      if (!frame && (frame_only_ || !shore)) continue;
      for (const Polygon& polygon : feature.polygons) {
        act(polygon.outer, true);
        if (!frame_only_)
          for (const Ring& hole : polygon.holes) act(hole, true);
      }
      for (const auto& line : feature.lines) act(line, false);
    }
  }

 private:
  const Coastline& coastline_;
  Box frame_;
  bool frame_only_ = false;
};

}  // namespace

Distortion largestDistortion(const Coastline& coastline, const Crs& crs, const Projection& to_crs) {
  constexpr std::size_t kVertices = 2048, kPieces = 16;
  const BoundingChains chains(coastline);
  const DistortionMeter meter(crs);
  std::size_t count = 0;
  Box extent;
  std::array<Point, 4> outermost{};
  chains.forEach([&](const std::vector<Point>& chain, bool) {
    count += chain.size();
    for (const Point& p : chain) {
      if (!chains.holds(p)) continue;
      if (p.x < extent.xmin) outermost[0] = p;
      if (p.x > extent.xmax) outermost[1] = p;
      if (p.y < extent.ymin) outermost[2] = p;
      if (p.y > extent.ymax) outermost[3] = p;
      extent.add(p);
    }
  });
  if (extent.empty()) return {};
  const std::size_t step = std::max<std::size_t>(1, count / kVertices);
  const double long_edge = std::hypot(extent.xmax - extent.xmin, extent.ymax - extent.ymin) / kPieces;
  Distortion largest;
  const auto look = [&](const Point& p) {
    if (!chains.holds(p)) return;
    const auto here = meter.at(to_crs.forward(p), p);
    if (here && here->ratio > largest.ratio) largest = *here;
  };
  for (const Point& p : outermost) look(p);
  std::size_t at = 0;
  chains.forEach([&](const std::vector<Point>& chain, bool closed) {
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const Point& p = chain[i];
      if (at++ % step != 0) continue;
      look(p);
      if (i + 1 == chain.size() && !closed) continue;
      const Point& q = chain[i + 1 == chain.size() ? 0 : i + 1];
      double dx = q.x - p.x;
      if (coastline.crs.geographic && std::abs(dx) > 180 && std::abs(dx) < 360) dx -= std::copysign(360.0, dx);
      if (!(std::hypot(dx, q.y - p.y) > long_edge)) continue;
      for (std::size_t part = 1; part < kPieces; ++part) {
        const double t = static_cast<double>(part) / kPieces;
        look({p.x + t * dx, p.y + t * (q.y - p.y)});
      }
    }
  });
  return largest;
}

}  // namespace coastmesh
