#include "gis/clean/geodesic_area.hpp"

#include <GeographicLib/Accumulator.hpp>
#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/Math.hpp>
#include <GeographicLib/PolygonArea.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <utility>

#include "gis/geometry/ring_area.hpp"

namespace coastmesh {

namespace {

// The ring with longitudes that continue past ±180 across the antimeridian. Its first point is repeated at the end, 360
// degrees further if the ring surrounds a pole.
std::vector<LonLat> unrolled(const std::vector<LonLat>& ring) {
  std::vector<LonLat> result = ring;
  result.push_back(ring.front());
  for (std::size_t i = 1; i < result.size(); ++i) {
    result[i].lon = result[i - 1].lon + GeographicLib::Math::AngDiff(ring[i - 1].lon, ring[i % ring.size()].lon);
  }
  return result;
}

// Area of a closed ring with straight edges on Lambert's cylindrical map of the unit sphere.
double roughArea(const std::vector<LonLat>& ring) {
  const double degree = GeographicLib::Math::degree();
  double area = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const LonLat &a = ring[i], &b = ring[(i + 1) % ring.size()];
    area += (b.lon - a.lon) * degree * (std::sin(a.lat * degree) + std::sin(b.lat * degree)) / 2;
  }
  return std::abs(area);
}

// True iff some edge jumps across the antimeridian. An edge from pole to pole has no length, whatever its longitudes.
bool jumps(const std::vector<LonLat>& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const LonLat &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if (std::abs(a.lon - b.lon) > 180 && !(a.lat == b.lat && std::abs(a.lat) == 90)) return true;
  }
  return false;
}

}  // namespace

RingArea::RingArea(const Crs& crs) : edges_(crs.semi_major_m, crs.flattening) {
  if (!crs.isPlane()) to_geographic_.emplace(crs);
}

double RingArea::of(const Ring& ring) const {
  if (ring.size() < 3) return 0;
  if (!to_geographic_) return std::abs(signedAreaOf(ring));
  std::vector<LonLat> places;
  places.reserve(ring.size());
  for (const Point& p : ring) places.push_back(to_geographic_->forward(p));
  return onEllipsoid(places);
}

// Returns nullopt for rings whose longitudes jump or that come near to a pole.
std::optional<double> RingArea::awayFromPoles(const std::vector<LonLat>& ring) const {
  constexpr double kWidest = 90, kHighest = 89;  // degrees
  GeographicLib::Accumulator<double> sum;
  EdgeArea::Vertex from = edges_.at(ring.back());
  for (const LonLat& p : ring) {
    const EdgeArea::Vertex to = edges_.at(p);
    if (std::abs(p.lat) > kHighest || std::abs(to.lon_deg - from.lon_deg) > kWidest) return std::nullopt;
    sum += edges_.under(from, to);
    from = to;
  }
  return std::abs(sum());
}

double RingArea::onEllipsoid(const std::vector<LonLat>& ring) const {
  if (const std::optional<double> area = awayFromPoles(ring)) return *area;
  GeographicLib::PolygonArea polygon(edges_.geodesic());
  for (const LonLat& p : ring) polygon.AddPoint(p.lat, p.lon);
  double perimeter, area;  // the smaller part of the globe, negative where it lies to the right
  polygon.Compute(false, true, perimeter, area);
  area = std::abs(area);
  const double globe = edges_.geodesic().EllipsoidArea(), rest = globe - area;
  std::vector<LonLat> plain = ring;
  if (jumps(ring)) {
    plain = unrolled(ring);
    if (std::abs(plain.back().lon - plain.front().lon) > 180) return area;
  }
  const double rough = roughArea(plain) / (4 * std::numbers::pi) * globe;
  return std::abs(area - rough) <= std::abs(rest - rough) ? area : rest;
}

double geodesicArea(const Coastline& coastline, const std::vector<std::size_t>& members, const ItemLoop& loop) {
  const RingArea area(coastline.crs);
  std::vector<std::pair<const Ring*, double>> rings;  // and its sign in the sum
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
// with the inside to their left. The sum is ambiguous by half the globe; the parity of crossings of a meridian decides.
class AreaSum {
 public:
  explicit AreaSum(const EdgeArea& edges) : edges_(edges) {}

  void add(const EdgeArea::Vertex& from, const EdgeArea::Vertex& to) {
    using GeographicLib::Math;
    constexpr double kWidest = 90, kHighest = 89;  // degrees
    double area = 0, unused = 0;
    if (std::abs(from.lon_deg - to.lon_deg) < kWidest &&
        std::max(std::abs(from.lat_deg), std::abs(to.lat_deg)) < kHighest) {
      area = edges_.under(from, to);
    } else {
      edges_.geodesic().GenInverse(from.lat_deg, from.lon_deg, to.lat_deg, to.lon_deg, GeographicLib::Geodesic::AREA,
                                   unused, unused, unused, unused, unused, unused, area);
    }
    sum_ -= area;
    const double step = Math::AngDiff(from.lon_deg, to.lon_deg);
    const bool west_before = Math::AngNormalize(from.lon_deg) < 0, west_after = Math::AngNormalize(to.lon_deg) < 0;
    // Only at the meridian of 0 degrees, not at that of 180.
    if ((step > 0 && west_before && !west_after) || (step < 0 && !west_before && west_after)) odd_ = !odd_;
  }
  void add(const AreaSum& other) {
    const double sum = other.sum_();
    sum_ += sum;
    sum_ += other.sum_(-sum);  // the rest lost by rounding
    odd_ = odd_ != other.odd_;
  }

  // A negative sum means the rest of the globe; if that exceeds `most()`, the sum is of slivers between geodesics.
  template <typename Most>
  double area(const Most& most) const {
    const double globe = edges_.geodesic().EllipsoidArea();
    const double area = std::fmod(sum_() + (odd_ ? globe / 2 : 0), globe);
    return area >= 0 || area + globe > most() ? std::abs(area) : area + globe;
  }

 private:
  const EdgeArea& edges_;
  GeographicLib::Accumulator<double> sum_;
  bool odd_ = false;
};

// The ends of a segment between inside and outside, with the inside to the left; nullopt for other segments.
std::optional<std::pair<VertexId, VertexId>> borderOf(const Segment& s) {
  if ((s.left >= 0) == (s.right >= 0)) return std::nullopt;
  return s.left >= 0 ? std::pair(s.a, s.b) : std::pair(s.b, s.a);
}

double planeArea(const Domain& domain, const std::vector<Point>& points) {
  double twice = 0;
  for (const Segment& s : domain.pslg.segments) {
    const auto border = borderOf(s);
    if (!border) continue;
    const Point &a = points[border->first], &b = points[border->second], &o = points.front();
    twice += (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
  }
  return std::abs(twice) / 2;
}

// Upper bound of a domain's area on the ground, from its area in the working plane.
double mostArea(const Domain& domain) {
  constexpr double kDegree = 112e3, kCare = 2.0;  // metres per degree, the largest unit of an identity; factor
  double least = domain.projection.isIdentity() ? 1 / kDegree : domain.projection.scaleAt({});
  for (const Point& p : domain.pslg.points)
    if (!domain.projection.isIdentity()) least = std::min(least, domain.projection.scaleAt(p));
  return kCare * planeArea(domain, domain.pslg.points) / (least * least);
}

}  // namespace

double geodesicArea(const Domain& domain, const Crs& crs, const ItemLoop& loop) {
  const EdgeArea edges(crs.semi_major_m, crs.flattening);
  if (domain.closed()) return edges.geodesic().EllipsoidArea();
  if (crs.isPlane()) return planeArea(domain, domain.input_points);
  const std::vector<Point>& points = domain.input_points;
  const std::vector<Segment>& segments = domain.pslg.segments;
  const GeographicMap to_geographic(crs);
  std::vector<EdgeArea::Vertex> vertices(points.size());
  forEachByStretches(loop, points.size(),
                     [&](std::size_t i) { vertices[i] = edges.at(to_geographic.forward(points[i])); });
  AreaSum sum(edges);
  const auto sumOf = [&](std::size_t first, std::size_t last) {
    auto part = std::make_unique<AreaSum>(edges);
    for (std::size_t i = first; i < last; ++i)
      if (const auto border = borderOf(segments[i])) part->add(vertices[border->first], vertices[border->second]);
    return part;
  };
  for (const auto& part : overStretches(loop, segments.size(), sumOf)) sum.add(*part);
  return sum.area([&domain] { return mostArea(domain); });
}

}  // namespace coastmesh
