#include "apps/plot/globe_chart.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "gis/crs/crs.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {
namespace {

std::string formatted(const char* format, double value) {
  char text[60];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string longitudeText(double lon) { return formatted("%.4g\u00b0 ", std::abs(lon)) + (lon < 0.0 ? "W" : "E"); }

class Orthographic final : public GlobeChart {
 public:
  explicit Orthographic(const LonLat& above)
      : above_(above),
        up_(onSphere(above)),
        east_(onSphere({above.lon + 90.0, 0.0})),  // defined at a pole too
        north_(cross(up_, east_)) {}

  Point half() const override { return {1.0, 1.0}; }
  std::vector<Point> outline() const override {
    constexpr int kCorners = 720;
    std::vector<Point> circle;
    for (int k = 0; k < kCorners; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kCorners;
      circle.push_back({std::cos(angle), std::sin(angle)});
    }
    return circle;
  }
  std::string caption() const override {
    return "seen from above " + longitudeText(above_.lon) + ", " + formatted("%.4g\u00b0 ", std::abs(above_.lat)) +
           (above_.lat < 0.0 ? "S" : "N");
  }
  // z towards the eye.
  SphereVector see(const SphereVector& v) const override { return {dot(v, east_), dot(v, north_), dot(v, up_)}; }

  void addArea(const std::vector<SphereVector>& outline, Triangles& triangles) const override {
    if (std::ranges::none_of(outline, [](const SphereVector& p) { return p[2] > 0.0; })) return;
    if (outline.size() == 3) {
      triangles.push_back({atMost(outline[0]), atMost(outline[1]), atMost(outline[2])});
      return;
    }
    SphereVector middle{};
    for (const SphereVector& p : outline)
      for (std::size_t k = 0; k < 3; ++k) middle[k] += p[k];
    const Point centre = atMost(unit(middle));
    for (std::size_t i = 0; i < outline.size(); ++i)
      triangles.push_back({centre, atMost(outline[i]), atMost(outline[(i + 1) % outline.size()])});
  }

  // Adds the parts on this side of the horizon.
  void addLine(const std::vector<SphereVector>& line, Lines& lines) const override {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      SphereVector p = line[i], q = line[i + 1];
      if (p[2] < 0.0 && q[2] < 0.0) continue;
      if (p[2] < 0.0) std::swap(p, q);
      if (q[2] < 0.0) {
        const double share = p[2] / (p[2] - q[2]);
        q = unit({p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1]), 0.0});
      }
      lines.push_back({Point{p[0], p[1]}, Point{q[0], q[1]}});
    }
  }

  double lengthOf(const SphereVector& a, const SphereVector& b) const override {
    return std::hypot(a[0] - b[0], a[1] - b[1]);
  }
  // Lines get thinner towards the horizon, where everything is foreshortened.
  double widthAt(const SphereVector& a, const SphereVector& b) const override {
    constexpr double kLeast = 0.2;
    return std::clamp((a[2] + b[2]) / 2.0, 0.0, 1.0) * (1.0 - kLeast) + kLeast;
  }

 private:
  // Moves points beyond the horizon onto it.
  static Point atMost(const SphereVector& seen) {
    const double reach = std::hypot(seen[0], seen[1]);
    if (seen[2] >= 0.0 || reach == 0.0) return {seen[0], seen[1]};
    return {seen[0] / reach, seen[1] / reach};
  }

  LonLat above_;
  SphereVector up_, east_, north_;
};

class NaturalEarth final : public GlobeChart {
 public:
  explicit NaturalEarth(double middle)
      : middle_(middle),
        map_(Projection::to(parseCrs("EPSG:4326"),
                            parseCrs("+proj=natearth +lon_0=0 +datum=WGS84 +units=m +no_defs"))) {}

  Point half() const override { return {chart({kSide, 0.0}).x, chart({0.0, 90.0}).y}; }
  std::vector<Point> outline() const override {
    std::vector<Point> points;
    for (double lat = -90.0; lat <= 90.0; lat += 0.5) points.push_back(chart({kSide, lat}));
    for (double lat = 90.0; lat >= -90.0; lat -= 0.5) points.push_back(chart({-kSide, lat}));
    return points;
  }
  std::string caption() const override { return "Natural Earth projection about " + longitudeText(middle_); }
  // x towards the middle meridian, z towards the north pole.
  SphereVector see(const SphereVector& v) const override {
    const SphereVector front = onSphere({middle_, 0.0}), right = onSphere({middle_ + 90.0, 0.0});
    return {dot(v, front), dot(v, right), v[2]};
  }

  void addArea(const std::vector<SphereVector>& outline, Triangles& triangles) const override {
    std::vector<LonLat> way;  // longitudes are unwrapped beyond the cut
    for (const SphereVector& p : outline) way.push_back(follows(way, placeOf(p)));
    const LonLat back = follows(way, way.front());
    const double turn = back.lon - way.front().lon;
    LonLat middle{};
    for (const LonLat& p : way) {
      middle.lon += p.lon / static_cast<double>(way.size());
      middle.lat += p.lat / static_cast<double>(way.size());
    }
    const bool round_pole = std::abs(turn) > 180.0;
    if (!round_pole && way.size() == 3) return addClipped(way, triangles);
    const double pole = turn > 0.0 ? 90.0 : -90.0;
    way.push_back(back);
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      if (round_pole) {
        addClipped({way[i], way[i + 1], {way[i + 1].lon, pole}, {way[i].lon, pole}}, triangles);
      } else {
        addClipped({middle, way[i], way[i + 1]}, triangles);
      }
    }
  }

  void addLine(const std::vector<SphereVector>& line, Lines& lines) const override {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const LonLat a = placeOf(line[i]);
      const LonLat b = follows({a}, placeOf(line[i + 1]));
      if (std::abs(b.lon) <= 180.0) {
        lines.push_back({chart(a), chart(b)});
        continue;
      }
      const double side = b.lon > 0.0 ? kSide : -kSide;
      const double lat = a.lat + (b.lat - a.lat) * (side - a.lon) / (b.lon - a.lon);
      lines.push_back({chart(a), chart({side, lat})});
      lines.push_back({chart({-side, lat}), chart({b.lon - 2.0 * side, b.lat})});
    }
  }

  double lengthOf(const SphereVector& a, const SphereVector& b) const override {
    const SphereVector way = minus(b, a);
    return std::sqrt(dot(way, way));
  }
  double widthAt(const SphereVector&, const SphereVector&) const override { return 1.0; }

 private:
  static constexpr double kSide = 180.0;
  static constexpr double kRadius = 6378137.0;  // metres; PROJ's for this sphere

  Point chart(const LonLat& place) const {
    constexpr double kInside = 1.0 - 1e-12;  // a longitude of 180 may come out on either side
    const Point metres = map_.forward({std::clamp(place.lon, -kSide, kSide) * kInside, place.lat});
    return {metres.x / kRadius, metres.y / kRadius};
  }

  // The place with its longitude unwrapped: less than half a turn from the last one.
  static LonLat follows(const std::vector<LonLat>& way, LonLat place) {
    if (way.empty()) return place;
    while (place.lon - way.back().lon > 180.0) place.lon -= 360.0;
    while (place.lon - way.back().lon < -180.0) place.lon += 360.0;
    return place;
  }

  // The part of a convex area west of the longitude `most`, or east of it if `sign` is -1.
  static std::vector<LonLat> clipped(const std::vector<LonLat>& area, double most, double sign) {
    std::vector<LonLat> left;
    for (std::size_t i = 0; i < area.size(); ++i) {
      const LonLat &a = area[i], &b = area[(i + 1) % area.size()];
      const double beyond_a = sign * (a.lon - most), beyond_b = sign * (b.lon - most);
      if (beyond_a <= 0.0) left.push_back(a);
      if ((beyond_a < 0.0 && beyond_b > 0.0) || (beyond_a > 0.0 && beyond_b < 0.0))
        left.push_back({most, a.lat + (b.lat - a.lat) * beyond_a / (beyond_a - beyond_b)});
    }
    return left;
  }

  // An area that crosses the cut is split into parts on both sides of the map.
  void addClipped(const std::vector<LonLat>& area, Triangles& triangles) const {
    for (const double turn : {-360.0, 0.0, 360.0}) {
      std::vector<LonLat> part = area;
      for (LonLat& p : part) p.lon += turn;
      part = clipped(clipped(part, kSide, 1.0), -kSide, -1.0);
      for (std::size_t i = 1; i + 1 < part.size(); ++i)
        triangles.push_back({chart(part[0]), chart(part[i]), chart(part[i + 1])});
    }
  }

  double middle_;
  Projection map_;
};

}  // namespace

std::unique_ptr<GlobeChart> orthographicChart(const LonLat& above) { return std::make_unique<Orthographic>(above); }

std::unique_ptr<GlobeChart> naturalEarthChart(double middle_longitude) {
  return std::make_unique<NaturalEarth>(middle_longitude);
}

}  // namespace coastmesh
