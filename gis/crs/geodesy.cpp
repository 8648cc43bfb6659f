#include "gis/crs/geodesy.hpp"

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/PolygonArea.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "core/bulk_list.hpp"
#include "core/quality.hpp"
#include "gis/crs/crs_map.hpp"
#include "gis/error.hpp"

namespace coastmesh {
namespace {

// Places on an ellipsoid.
struct Geodetic {
  std::span<const Point> points;  // already geographic if `places` is empty
  std::vector<LonLat> places;
  double a = 0.0;  // semi-major axis, metres
  double f = 0.0;  // flattening

  LonLat at(std::size_t i) const { return places.empty() ? asLonLat(points[i]) : places[i]; }
};

[[noreturn]] void refuseNode(std::span<const Point> nodes, std::size_t node, const Crs& crs, const std::string& path) {
  throw InputError((path.empty() ? "" : "'" + path + "': ") + "node " + std::to_string(node + 1) + " at " +
                   std::to_string(nodes[node].x) + ", " + std::to_string(nodes[node].y) +
                   " has no longitude and latitude in " + nameOf(crs) + "; check that the CRS is the right one");
}

// `path` is for errors; it may be empty.
Geodetic toGeodetic(std::span<const Point> points, const Crs& crs, const std::string& path = {}) {
  Geodetic out{points, {}, crs.semi_major_m, crs.flattening};
  if (!crs.geographic) {
    std::vector<double> x(points.size()), y(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      x[i] = points[i].x;
      y[i] = points[i].y;
    }
    mapToGeographic(crs)->forward(x, y);
    out.places.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!std::isfinite(x[i]) || !std::isfinite(y[i])) refuseNode(points, i, crs, path);
      out.places[i] = {x[i], y[i]};
    }
  }
  return out;
}

using Vector = std::array<double, 3>;

Vector operator-(const Vector& u, const Vector& v) { return {u[0] - v[0], u[1] - v[1], u[2] - v[2]}; }
double dot(const Vector& u, const Vector& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }
Vector cross(const Vector& u, const Vector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

Vector toEarthCentred(const LonLat& place, double a, double e2) {
  const double lon = place.lon * std::numbers::pi / 180.0, lat = place.lat * std::numbers::pi / 180.0;
  const double n = a / std::sqrt(1.0 - e2 * std::sin(lat) * std::sin(lat));
  return {n * std::cos(lat) * std::cos(lon), n * std::cos(lat) * std::sin(lon), n * (1.0 - e2) * std::sin(lat)};
}

std::unique_ptr<Vector[]> toEarthCentred(const Geodetic& geodetic, const ItemLoop& loop) {
  const double e2 = geodetic.f * (2.0 - geodetic.f);
  auto places = std::make_unique_for_overwrite<Vector[]>(geodetic.points.size());
  forEachByStretches(loop, geodetic.points.size(),
                     [&](std::size_t i) { places[i] = toEarthCentred(geodetic.at(i), geodetic.a, e2); });
  return places;
}

constexpr double kSmallEdge = 20000.0;  // metres

// Area of a triangle with edges below `kSmallEdge`: the flat triangle through its corners, projected along the normal
// of the ellipsoid at its centroid, with the first term of the series in the Gaussian curvature K. On a sphere, a flat
// area A with circumradius r and distance d from circumcentre to centroid has the spherical area A (1 + K (sum l^2 / 8
// - r^2 / 2)), the projected area A (1 - K d^2 / 2), and d^2 = r^2 - sum l^2 / 9; the quotient is 1 + K sum l^2 5/72.
// The error is below 1e-7 for 20 km. PolygonArea, a difference of two large areas, is less accurate here.
double smallTriangleArea(const Vector& u, const Vector& v, const Vector& w, double a, double e2) {
  const Vector uv = v - u, uw = w - u, vw = w - v;
  Vector normal{u[0] + v[0] + w[0], u[1] + v[1] + w[1], (u[2] + v[2] + w[2]) / (1.0 - e2)};
  const double norm = std::sqrt(dot(normal, normal));
  const double sin_lat = normal[2] / norm;
  const double t = 1.0 - e2 * sin_lat * sin_lat;
  const double curvature = t * t / (a * a * (1.0 - e2));
  const double projected = dot(cross(uv, uw), normal) / norm / 2.0;
  return projected * (1.0 + curvature * (dot(uv, uv) + dot(uw, uw) + dot(vw, vw)) * 5.0 / 72.0);
}

constexpr double kMediumEdge = 60000.0;  // metres

// The square of a geodesic's length from that of its chord: the arc has the curvature of the normal section at its
// middle, by Euler's formula. The error is below 1e-11 for 60 km.
double squaredArc(const Vector& p, const Vector& q, double a, double e2) {
  const Vector chord = q - p;
  const Vector normal{p[0] + q[0], p[1] + q[1], (p[2] + q[2]) / (1.0 - e2)};
  const double to_axis2 = normal[0] * normal[0] + normal[1] * normal[1], norm2 = to_axis2 + normal[2] * normal[2];
  const double t = 1.0 - e2 * normal[2] * normal[2] / norm2;
  const double across = a / std::sqrt(t), along = across * (1.0 - e2) / t;  // radii of curvature
  const double squared = dot(chord, chord);
  const double east = chord[1] * normal[0] - chord[0] * normal[1];
  const double east2 = to_axis2 > 0.0 && squared > 0.0 ? east * east / (to_axis2 * squared) : 0.0;
  const double curvature = (1.0 - east2) / along + east2 / across;
  const double x = squared * curvature * curvature;
  return squared * (1.0 + x * (1.0 / 12.0 + x / 90.0));
}

// Area of a triangle with edges below `kMediumEdge`: that of the plane triangle whose sides have the geodesics'
// lengths, times 1 + K sum l^2 / 24, with the Gaussian curvature K at the centroid (Gauss, Disquisitiones generales
// circa superficies curvas, 1827, Section 29). The plane triangle's area is that of the flat one through the corners
// plus a first-order term for the change of its sides.
double mediumTriangleArea(const Vector& u, const Vector& v, const Vector& w, double a, double e2) {
  const Vector uv = v - u, uw = w - u, vw = w - v;
  const Vector across = cross(uv, uw);
  const Vector normal{u[0] + v[0] + w[0], u[1] + v[1] + w[1], (u[2] + v[2] + w[2]) / (1.0 - e2)};
  const double twice = std::sqrt(dot(across, across));
  if (twice == 0.0) return 0.0;
  const double sin2_lat = normal[2] * normal[2] / dot(normal, normal);
  const double t = 1.0 - e2 * sin2_lat;
  const double curvature = t * t / (a * a * (1.0 - e2));
  const double uv2 = squaredArc(u, v, a, e2), uw2 = squaredArc(u, w, a, e2), vw2 = squaredArc(v, w, a, e2);
  // The derivative of the area by the square of a side is a quarter of the cotangent of the opposite angle.
  const double more =
      (dot(uv, uw) * (vw2 - dot(vw, vw)) - dot(uv, vw) * (uw2 - dot(uw, uw)) + dot(uw, vw) * (uv2 - dot(uv, uv))) /
      (4.0 * twice);
  const double area = (0.5 * twice + more) * (1.0 + curvature * (uv2 + uw2 + vw2) / 24.0);
  return dot(across, normal) < 0.0 ? -area : area;
}

}  // namespace

bool isOnEarth(const LonLat& place) { return std::abs(place.lon) <= 540.0 && std::abs(place.lat) <= 90.0; }

void requirePlaces(std::span<const Point> nodes, const Crs& crs, const std::string& path) {
  if (crs.isPlane()) return;
  if (!crs.geographic) {
    toGeodetic(nodes, crs, path);
    return;
  }
  const auto odd = std::ranges::find_if_not(nodes, isOnEarth, asLonLat);
  if (odd != nodes.end()) refuseNode(nodes, static_cast<std::size_t>(odd - nodes.begin()), crs, path);
}

BulkList<double> triangleAreas(std::span<const Point> nodes, std::span<const std::array<std::uint32_t, 3>> triangles,
                               const Crs& crs, const ItemLoop& loop) {
  BulkList<double> areas;
  resizeUnset(areas, triangles.size());
  if (crs.isPlane()) {
    forEachByStretches(loop, triangles.size(), [&](std::size_t t) {
      const auto& [a, b, c] = triangles[t];
      areas[t] = signedArea(nodes[a], nodes[b], nodes[c]);
    });
    return areas;
  }
  const Geodetic geodetic = toGeodetic(nodes, crs);
  const double e2 = geodetic.f * (2.0 - geodetic.f);
  const std::unique_ptr<const Vector[]> places = toEarthCentred(geodetic, loop);
  const GeographicLib::Geodesic geodesic(geodetic.a, geodetic.f);
  forEachByStretches(loop, triangles.size(), [&](std::size_t t) {
    const Vector &u = places[triangles[t][0]], &v = places[triangles[t][1]], &w = places[triangles[t][2]];
    const double longest = std::sqrt(std::max({dot(v - u, v - u), dot(w - u, w - u), dot(w - v, w - v)}));
    if (longest < kSmallEdge) {
      areas[t] = smallTriangleArea(u, v, w, geodetic.a, e2);
      return;
    }
    if (longest < kMediumEdge) {
      areas[t] = mediumTriangleArea(u, v, w, geodetic.a, e2);
      return;
    }
    GeographicLib::PolygonArea polygon(geodesic);
    for (std::uint32_t n : triangles[t]) polygon.AddPoint(geodetic.at(n).lat, geodetic.at(n).lon);
    double perimeter = 0.0;
    polygon.Compute(false, true, perimeter, areas[t]);
  });
  return areas;
}

std::vector<double> areasOfFew(std::span<const Point> nodes, std::span<const std::array<std::uint32_t, 3>> triangles,
                               const Crs& crs, const ItemLoop& loop) {
  std::vector<Point> own(3 * triangles.size());
  std::vector<std::array<std::uint32_t, 3>> corners(triangles.size());
  forEachByStretches(loop, triangles.size(), [&](std::size_t t) {
    const auto first = static_cast<std::uint32_t>(3 * t);
    corners[t] = {first, first + 1, first + 2};
    for (std::uint32_t i = 0; i < 3; ++i) own[first + i] = nodes[triangles[t][i]];
  });
  const BulkList<double> areas = triangleAreas(own, corners, crs, loop);
  return {areas.begin(), areas.end()};
}

EdgeMeter::EdgeMeter(std::span<const Point> nodes, const Crs& crs, const ItemLoop& loop) : nodes_(nodes) {
  if (crs.isPlane()) return;
  const Geodetic geodetic = toGeodetic(nodes, crs);
  diameter_ = 2.0 * geodetic.a;
  places_ = toEarthCentred(geodetic, loop);
}

double EdgeMeter::between(std::uint32_t a, std::uint32_t b) const {
  if (places_ == nullptr) return std::hypot(nodes_[b].x - nodes_[a].x, nodes_[b].y - nodes_[a].y);
  const Vector along = places_[b] - places_[a];
  // The arc over the chord, on a sphere whose radius is the semi-major axis.
  return diameter_ * std::asin(std::min(1.0, std::sqrt(dot(along, along)) / diameter_));
}

double EdgeMeter::shortestOf(const std::array<std::uint32_t, 3>& corners) const {
  if (places_ == nullptr) return std::ranges::min(of(corners));
  const auto squaredChord = [&](std::size_t a, std::size_t b) {
    const Vector along = places_[corners[b]] - places_[corners[a]];
    return dot(along, along);
  };
  const std::array<double, 3> squared{squaredChord(0, 1), squaredChord(1, 2), squaredChord(2, 0)};
  const auto least = static_cast<std::size_t>(std::ranges::min_element(squared) - squared.begin());
  return between(corners[least], corners[(least + 1) % 3]);
}

std::vector<std::array<double, 3>> edgeLengths(std::span<const Point> nodes,
                                               std::span<const std::array<std::uint32_t, 3>> triangles,
                                               const Crs& crs) {
  const EdgeMeter meter(nodes, crs);
  std::vector<std::array<double, 3>> lengths(triangles.size());
  std::ranges::transform(triangles, lengths.begin(), [&](const auto& corners) { return meter.of(corners); });
  return lengths;
}

std::vector<double> chainLengths(const std::vector<std::vector<Point>>& chains, const Crs& crs, const ItemLoop& loop) {
  std::vector<double> lengths(chains.size(), 0.0);
  if (crs.isPlane()) {
    for (std::size_t c = 0; c < chains.size(); ++c)
      for (std::size_t i = 1; i < chains[c].size(); ++i)
        lengths[c] += std::hypot(chains[c][i].x - chains[c][i - 1].x, chains[c][i].y - chains[c][i - 1].y);
    return lengths;
  }
  std::vector<Point> points;
  for (const std::vector<Point>& chain : chains) points.insert(points.end(), chain.begin(), chain.end());
  const Geodetic geodetic = toGeodetic(points, crs);
  const GeographicLib::Geodesic geodesic(geodetic.a, geodetic.f);
  std::vector<std::uint8_t> is_last(points.size(), 0);  // of its chain
  for (std::size_t c = 0, end = 0; c < chains.size(); ++c)
    if (end += chains[c].size(); !chains[c].empty()) is_last[end - 1] = 1;
  std::vector<double> pieces(points.size(), 0.0);  // from each point to the next one
  constexpr std::size_t kWorthAStretch = 256;
  forStretches(
      loop, points.size(),
      [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          if (is_last[i]) continue;
          const LonLat p = geodetic.at(i), q = geodetic.at(i + 1);
          geodesic.Inverse(p.lat, p.lon, q.lat, q.lon, pieces[i]);
        }
      },
      kWorthAStretch);
  std::size_t at = 0;
  for (std::size_t c = 0; c < chains.size(); ++c) {
    for (std::size_t i = 1; i < chains[c].size(); ++i) lengths[c] += pieces[at + i - 1];
    at += chains[c].size();
  }
  return lengths;
}

}  // namespace coastmesh
