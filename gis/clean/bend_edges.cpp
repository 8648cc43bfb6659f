#include "gis/clean/bend_edges.hpp"

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/GeodesicLine.hpp>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <tuple>

#include "core/metric.hpp"
#include "gis/crs/geographic_map.hpp"

namespace coastmesh {

namespace {

constexpr int kMostHalvings = 12;

// The point at a share, 0 to 1, of the way along the line of an edge.
using Line = std::function<Point(double)>;

// Takes the shorter way in longitude. Longitudes beyond the range of 360 degrees that contains both ends are wrapped
// into it.
Line lonLatLine(const Point& a, const Point& b, bool geographic) {
  const double east = geographic ? std::remainder(b.x - a.x, 360.0) : b.x - a.x;
  const auto [low, high] = std::minmax(a.x, b.x);
  const bool goes_over = geographic && high - low > 180.0;
  const double west = low >= 0.0 && high > 180.0 ? 0.0 : -180.0;
  return [=](double t) {
    Point p{a.x + t * east, a.y + t * (b.y - a.y)};
    if (goes_over && p.x > west + 360.0) p.x -= 360.0;
    if (goes_over && p.x < west) p.x += 360.0;
    return p;
  };
}

class Bender {
 public:
  Bender(const Coastline& coastline, const Projection& projection, EdgeLine line, double tolerance_m)
      : projection_(projection),
        to_geographic_(coastline.crs),
        geodesic_(coastline.crs.semi_major_m, coastline.crs.flattening),
        geographic_(coastline.crs.geographic),
        line_(line),
        tolerance_m_(tolerance_m) {}

  std::size_t count() const { return count_; }

  void bend(std::vector<Point>& chain, bool closed) {
    if (chain.size() < 2) return;
    std::vector<Point> bent;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      bent.push_back(chain[i]);
      if (i + 1 < chain.size() || closed) addBetween(chain[i], chain[(i + 1) % chain.size()], bent);
    }
    count_ += bent.size() - chain.size();
    chain = std::move(bent);
  }

 private:
  Line lineOf(const Point& a, const Point& b) const {
    if (line_ == EdgeLine::LonLat) return lonLatLine(a, b, geographic_);
    const LonLat from = to_geographic_.forward(a), to = to_geographic_.forward(b);
    const GeographicLib::GeodesicLine way = geodesic_.InverseLine(from.lat, from.lon, to.lat, to.lon);
    const auto [low, high] = std::minmax(from.lon, to.lon);
    return [=, low = low, high = high, this](double t) {
      LonLat place;
      way.Position(t * way.Distance(), place.lat, place.lon);
      // In the same range of 360 degrees as the ends.
      if (place.lon < low - 180.0) place.lon += 360.0;
      if (place.lon > high + 180.0) place.lon -= 360.0;
      return to_geographic_.inverse(place);
    };
  }

  // Adds the same points for either direction of the edge.
  void addBetween(const Point& a, const Point& b, std::vector<Point>& bent) {
    if (a == b || (geographic_ && std::abs(a.y) == 90.0 && a.y == b.y)) return;  // a pole is one point
    const bool in_order = std::tie(a.x, a.y) < std::tie(b.x, b.y);
    const Point &from = in_order ? a : b, &to = in_order ? b : a;
    const std::size_t before = bent.size();
    halve(lineOf(from, to), 0.0, projection_.forward(from), 1.0, projection_.forward(to), 0, bent);
    if (!in_order) std::reverse(bent.begin() + static_cast<std::ptrdiff_t>(before), bent.end());
  }

  // Adds points between the shares t and u of the line, in order; p and q are the places of t and u in the plane.
  void halve(const Line& line, double t, const Point& p, double u, const Point& q, int halvings,
             std::vector<Point>& bent) {
    if (halvings == kMostHalvings || isStraight(line, t, p, u, q)) return;
    const double middle = 0.5 * (t + u);
    const Point place = line(middle), in_plane = projection_.forward(place);
    halve(line, t, p, middle, in_plane, halvings + 1, bent);
    bent.push_back(place);
    halve(line, middle, in_plane, u, q, halvings + 1, bent);
  }

  // Tests three points, since a line that bends to both sides may cross its chord in the middle. True where the line
  // has no place in the plane.
  bool isStraight(const Line& line, double t, const Point& p, double u, const Point& q) const {
    if (!(distance(p, q) > tolerance_m_ * projection_.scaleAt(midpoint(p, q)))) return true;
    for (const double share : {0.25, 0.5, 0.75}) {
      const Point x = projection_.forward(line(t + share * (u - t)));
      const double off = std::sqrt(squaredDistanceToSegment(x, p, q));
      if (off > tolerance_m_ * projection_.scaleAt(x)) return false;
    }
    return true;
  }

  const Projection& projection_;
  GeographicMap to_geographic_;
  GeographicLib::Geodesic geodesic_;
  bool geographic_;
  EdgeLine line_;
  double tolerance_m_;
  std::size_t count_ = 0;
};

}  // namespace

std::size_t bendEdges(Coastline& coastline, const std::vector<std::size_t>& members, const Projection& projection,
                      EdgeLine line, double tolerance_m) {
  assert(!coastline.crs.isPlane() && tolerance_m > 0.0);
  if (line == EdgeLine::Plane) return 0;
  Bender bender(coastline, projection, line, tolerance_m);
  for (const std::size_t member : members) {
    Feature& feature = coastline.features[member];
    if (feature.use == FeatureUse::Frame || !feature.vertex_order.empty()) continue;
    for (Polygon& polygon : feature.polygons) {
      bender.bend(polygon.outer, true);
      for (Ring& hole : polygon.holes) bender.bend(hole, true);
    }
    for (auto& chain : feature.lines) bender.bend(chain, false);
  }
  return bender.count();
}

}  // namespace coastmesh
