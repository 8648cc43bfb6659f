#include "gis/projection/conformal_map.hpp"

#include <GeographicLib/LambertConformalConic.hpp>
#include <GeographicLib/Math.hpp>
#include <GeographicLib/PolarStereographic.hpp>
#include <GeographicLib/TransverseMercator.hpp>
#include <cmath>

namespace coastmesh {

namespace {

using GeographicLib::Math;

// A projection of GeographicLib about a central meridian, with the plane's origin moved to the centre.
template <typename Library>
class AboutMeridian final : public ConformalMap {
 public:
  AboutMeridian(Library library, const LonLat& centre) : library_(std::move(library)), meridian_(centre.lon) {
    origin_ = forward(centre);
  }

  Point forward(const LonLat& place) const override {
    double x, y;
    library_.Forward(meridian_, place.lat, place.lon, x, y);
    return {x - origin_.x, y - origin_.y};
  }
  LonLat inverse(const Point& plane) const override {
    double lat, lon;
    library_.Reverse(meridian_, plane.x + origin_.x, plane.y + origin_.y, lat, lon);
    return {lon, lat};
  }
  double scaleAt(const Point& plane) const override {
    double lat, lon, convergence, scale;
    library_.Reverse(meridian_, plane.x + origin_.x, plane.y + origin_.y, lat, lon, convergence, scale);
    return scale;
  }

 private:
  Library library_;
  double meridian_;
  Point origin_;
};

class PolarMap final : public ConformalMap {
 public:
  PolarMap(const Ellipsoid& ellipsoid, bool north, double meridian)
      : library_(ellipsoid.a, ellipsoid.f, 1.0), north_(north), meridian_(meridian) {}

  Point forward(const LonLat& place) const override {
    double x, y;
    library_.Forward(north_, place.lat, Math::AngDiff(meridian_, place.lon), x, y);
    return {x, y};
  }
  LonLat inverse(const Point& plane) const override {
    double lat, lon;
    library_.Reverse(north_, plane.x, plane.y, lat, lon);
    return {Math::AngNormalize(lon + meridian_), lat};
  }
  double scaleAt(const Point& plane) const override {
    double lat, lon, convergence, scale;
    library_.Reverse(north_, plane.x, plane.y, lat, lon, convergence, scale);
    return scale;
  }
  // A little off the pole, where data that extend to the pole have an edge.
  std::optional<LonLat> infinity() const override { return LonLat{17.123, north_ ? -89.999 : 89.999}; }

 private:
  GeographicLib::PolarStereographic library_;
  bool north_;
  double meridian_;
};

// Maps the ellipsoid to a sphere by the conformal latitude chi, and the sphere to the plane stereographically: Snyder,
// "Map Projections: A Working Manual" (1987), p. 160, equations 21-24 to 21-27. We use unit vectors, so that only the
// antipode is a special case.
class ObliqueStereographic final : public ConformalMap {
 public:
  ObliqueStereographic(const Ellipsoid& ellipsoid, const LonLat& centre)
      : e2_(ellipsoid.f * (2 - ellipsoid.f)),
        es_((ellipsoid.f < 0 ? -1 : 1) * std::sqrt(std::abs(e2_))),
        meridian_(centre.lon),
        centre_(onSphere(centre.lat)),
        diameter_(2 * ellipsoid.a / centre_.scale),
        a_(ellipsoid.a) {
    Math::sincosd(meridian_, sin_meridian_, cos_meridian_);
  }

  Point forward(const LonLat& place) const override {
    const OnSphere at = onSphere(place.lat);
    double sin_lon, cos_lon;
    Math::sincosd(Math::AngDiff(meridian_, place.lon), sin_lon, cos_lon);
    const double east = at.cos * sin_lon;
    const double north = centre_.cos * at.sin - centre_.sin * at.cos * cos_lon;
    const double up = centre_.sin * at.sin + centre_.cos * at.cos * cos_lon;
    return {diameter_ * east / (1 + up), diameter_ * north / (1 + up)};
  }

  LonLat inverse(const Point& plane) const override { return inverseByTangent(plane).place; }
  OnGround onGround(const Point& plane) const override {
    const ByTangent at = inverseByTangent(plane);
    const double polar = a_ * std::sqrt(1 - e2_);
    constexpr double kAtPole = 1e-100;  // less than any rounding
    if (at.to_axis < kAtPole) return {at.place, {0, 0, at.place.lat > 0 ? polar : -polar}, scaleAt(plane)};
    const double cos_lat = 1 / std::sqrt(1 + at.tangent * at.tangent), sin_lat = cos_lat * at.tangent;
    const double flatter = std::sqrt(1 - e2_ * sin_lat * sin_lat);
    // The radius of the ellipsoid's parallel over the distance to the axis of the unit sphere.
    const double parallel = a_ * cos_lat / (flatter * at.to_axis);
    const double x = parallel * at.to_meridian, y = parallel * at.east;
    return {at.place,
            {x * cos_meridian_ - y * sin_meridian_, x * sin_meridian_ + y * cos_meridian_,
             a_ * (1 - e2_) * sin_lat / flatter},
            diameter_ * (1 + at.squared) / (2 * parallel)};
  }

  double scaleAt(const Point& plane) const override {
    const double x = plane.x / diameter_, y = plane.y / diameter_;
    return diameter_ / (2 * a_) * onSphere(inverse(plane).lat).scale * (1 + x * x + y * y);
  }
  Surface sphere() const override { return Surface::sphere(0.5 * diameter_, e2_ == 0.0 ? 0.0 : kAngleMargin); }
  std::optional<LonLat> infinity() const override { return inverse({1e18 * diameter_, 0}); }

 private:
  // Radians per metre of the longest edge: the difference of a flat triangle's angle between the sphere and the Earth's
  // ellipsoid. Measured: 1.7e-5 degrees per kilometre.
  static constexpr double kAngleMargin = 3e-10;

  // Sine and cosine of the conformal latitude, and the scale of the map from the ellipsoid of semi-major axis 1 to the
  // unit sphere: cos chi / m, with m the radius of the parallel.
  struct OnSphere {
    double sin, cos, scale;
  };

  // A place with intermediate results: the tangent of its latitude, its distance to the axis of the unit sphere in two
  // directions and in total, and the squared distance to the plane's origin in diameters. At a pole the distance to the
  // axis is 0, and the tangent is meaningless.
  struct ByTangent {
    LonLat place;
    double tangent, to_meridian, east, to_axis, squared;
  };

  ByTangent inverseByTangent(const Point& plane) const {
    const double x = plane.x / diameter_, y = plane.y / diameter_;
    const double q = x * x + y * y;
    const double east = 2 * x / (1 + q), north = 2 * y / (1 + q), up = (1 - q) / (1 + q);
    const double to_meridian = up * centre_.cos - north * centre_.sin;
    const double to_pole = up * centre_.sin + north * centre_.cos;
    const double to_axis = std::hypot(to_meridian, east);
    if (to_axis == 0) return {{Math::AngNormalize(meridian_), to_pole > 0 ? 90.0 : -90.0}, 0, 0, 0, 0, q};
    const double tangent = Math::tauf(to_pole / to_axis, es_);
    return {{Math::AngNormalize(meridian_ + Math::atan2d(east, to_meridian)), Math::atand(tangent)},
            tangent,
            to_meridian,
            east,
            to_axis,
            q};
  }

  OnSphere onSphere(double lat) const {
    const double tau = Math::tand(Math::LatFix(lat)), tau_conformal = Math::taupf(tau, es_);
    const double secant = std::hypot(1.0, tau), secant_conformal = std::hypot(1.0, tau_conformal);
    const double sin_lat = tau / secant;
    return {tau_conformal / secant_conformal, 1 / secant_conformal,
            secant / secant_conformal * std::sqrt(1 - e2_ * sin_lat * sin_lat)};
  }

  double e2_, es_;
  double meridian_;
  OnSphere centre_;
  double diameter_;
  double a_;
  double sin_meridian_ = 0, cos_meridian_ = 1;
};

}  // namespace

std::unique_ptr<ConformalMap> transverseMercator(const Ellipsoid& ellipsoid, const LonLat& centre) {
  using Library = GeographicLib::TransverseMercator;
  return std::make_unique<AboutMeridian<Library>>(Library(ellipsoid.a, ellipsoid.f, 1.0), centre);
}

std::unique_ptr<ConformalMap> lambertConic(const Ellipsoid& ellipsoid, const LonLat& centre, double parallel1,
                                           double parallel2) {
  using Library = GeographicLib::LambertConformalConic;
  return std::make_unique<AboutMeridian<Library>>(Library(ellipsoid.a, ellipsoid.f, parallel1, parallel2, 1.0), centre);
}

std::unique_ptr<ConformalMap> polarStereographic(const Ellipsoid& ellipsoid, bool north, double central_meridian) {
  return std::make_unique<PolarMap>(ellipsoid, north, central_meridian);
}

std::unique_ptr<ConformalMap> obliqueStereographic(const Ellipsoid& ellipsoid, const LonLat& centre) {
  return std::make_unique<ObliqueStereographic>(ellipsoid, centre);
}

}  // namespace coastmesh
