#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "gis/coast/feature_names.hpp"
#include "gis/coast/flood_plains.hpp"
#include "gis/coast/turned_rings.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/crs/geographic_map.hpp"
#include "gis/error.hpp"
#include "gis/projection/fit_map.hpp"
#include "gis/projection/projection.hpp"
#include "gis/projection/projection_map.hpp"

namespace coastmesh {

namespace {

// A turn around the globe in coordinates of a projected CRS, such as Mercator's, that continue past its edge.
struct Turn {
  double width = 0;   // 0: they do not continue
  double middle = 0;  // of the input's x
};

// The turn of an input with the outermost points `west` and `east`: if beyond the edge, they come back a turn away.
Turn turnOf(const Point& west, const Point& east, const GeographicMap& to_geographic) {
  Turn turn;
  for (const Point& p : {west, east}) {
    const Point back = to_geographic.inverse(to_geographic.forward(p));
    const double apart = std::abs(back.x - p.x);
    constexpr double kRounding = 1e-9;  // and the error of a round trip, in a large CRS
    const double size = std::max(std::abs(p.x), std::abs(back.x));
    if (!(apart > size) || !(std::abs(back.y - p.y) <= kRounding * size)) continue;
    if (std::abs(back.x + p.x) <= kRounding * size) continue;  // on the edge, which has two images
    if (turn.width == 0 || apart < turn.width) turn.width = apart;
  }
  turn.middle = west.x + (east.x - west.x) / 2;
  return turn;
}

class Fitted final : public ProjectionMap {
 public:
  Fitted(GeographicMap to_geographic, FittedMap fitted, double middle_longitude, const Turn& turn)
      : to_geographic_(std::move(to_geographic)), map_(std::move(fitted.map)), middle_(middle_longitude), turn_(turn) {
    if (fitted.is_surface) surface_ = map_->sphere();
    description = std::move(fitted.description);
    reason = std::move(fitted.reason);
  }

  Point forward(const Point& input) const override { return map_->forward(to_geographic_.forward(input)); }
  Point inverse(const Point& plane) const override { return asInput(map_->inverse(plane)); }
  double scaleAt(const Point& plane) const override { return map_->scaleAt(plane); }
  Surface surface() const override { return surface_; }
  // A two-hundredth of the Earth's radius: for most places short against the distance to a pole, where longitudes are
  // not smooth.
  double smoothOver() const override { return 32000.0; }
  GroundPlace groundAt(const Point& plane) const override {
    const auto [place, space, scale] = map_->onGround(plane);
    return {asInput(place), space, scale * surface_.shrinkAt(plane)};
  }
  std::optional<Point> infinity() const override {
    const std::optional<LonLat> beyond = to_geographic_.isIdentity() ? map_->infinity() : std::nullopt;
    if (!beyond) return std::nullopt;
    return asGeographic(*beyond);
  }

 private:
  // Coordinates in the same turn around the globe as the input.
  Point asInput(LonLat place) const {
    if (place.lon < middle_ - 180) place.lon += 360;
    if (place.lon > middle_ + 180) place.lon -= 360;
    Point input = to_geographic_.inverse(place);
    if (turn_.width > 0) input.x -= turn_.width * std::round((input.x - turn_.middle) / turn_.width);
    return input;
  }

  GeographicMap to_geographic_;
  std::unique_ptr<ConformalMap> map_;
  Surface surface_;
  double middle_;
  Turn turn_;
};

bool hasFramedWater(const Coastline& coastline, const std::vector<std::size_t>& members) {
  return std::ranges::any_of(members, [&](std::size_t member) {
    const FeatureUse use = coastline.features[member].use;
    return use == FeatureUse::Land || use == FeatureUse::Coast;
  });
}

// Calls `act(feature, chain, is_ring)` for every ring and line of the members that shape the domain; for a whole globe,
// for those of all members and for their points.
template <typename Act>
void forEachChain(const Coastline& coastline, const std::vector<std::size_t>& members, Act&& act) {
  const bool with_frame = hasFramedWater(coastline, members), globe = coastline.rest.has_value();
  for (const std::size_t member : members) {
    const Feature& feature = coastline.features[member];
    const bool guest = feature.use == FeatureUse::Constraint || feature.use == FeatureUse::Weir ||
                       feature.use == FeatureUse::Region || feature.use == FeatureUse::Open ||
                       (feature.use == FeatureUse::Frame && !with_frame);
    if ((guest && !globe) || (with_frame && isFloodPlain(feature))) continue;
    for (const Polygon& polygon : feature.polygons) {
      act(feature, polygon.outer, true);
      for (const Ring& hole : polygon.holes) act(feature, hole, true);
    }
    for (const auto& line : feature.lines) act(feature, line, false);
    if (globe && !feature.points.empty()) act(feature, feature.points, false);
  }
}

[[noreturn]] void refuse(const Feature& feature, const Point& input, const Crs& crs) {
  const bool swapped = crs.geographic && std::abs(input.x) <= 90 && std::abs(input.y) <= 180;
  throw InputError(featureInWords(feature) + ": the point " + std::to_string(input.x) + ", " + std::to_string(input.y) +
                   " is not a place on Earth in " + nameOf(crs) +
                   (swapped ? ": are latitude and longitude swapped? The longitude comes first; QGIS changes them "
                              "with Swap X and Y Coordinates"
                            : ": put the CRS that the data are in into the file (ogr2ogr -a_srs, or Assign Projection "
                              "in QGIS), or take them as a plane with --crs plane"));
}

std::shared_ptr<const ProjectionMap> fitTo(const Coastline& coastline, const std::vector<std::size_t>& members,
                                           const GeographicMap& to_geographic, SurfaceKind kind) {
  std::vector<LonLat> places;
  std::deque<Ring> projected_rings;
  std::vector<RingGroup> groups(1);  // the frame and coasts; then one for each area or land
  const Feature* last = nullptr;
  double west = std::numeric_limits<double>::infinity(), east = -west;
  Point first_of_input{west, 0}, last_of_input{east, 0};  // by x
  std::size_t count = 0;
  forEachChain(coastline, members,
               [&](const Feature&, const std::vector<Point>& chain, bool) { count += chain.size(); });
  places.reserve(count);
  forEachChain(coastline, members, [&](const Feature& feature, const std::vector<Point>& chain, bool is_ring) {
    for (const Point& input : chain) {
      const LonLat place = to_geographic.forward(input);
      if (!isOnEarth(place)) refuse(feature, input, coastline.crs);
      west = std::min(west, place.lon);
      east = std::max(east, place.lon);
      if (input.x < first_of_input.x) first_of_input = input;
      if (input.x > last_of_input.x) last_of_input = input;
      places.push_back(place);
    }
    if (!is_ring || (coastline.rest && feature.use != FeatureUse::Area)) return;
    const bool is_whole = feature.use == FeatureUse::Land || feature.use == FeatureUse::Area;
    if (is_whole && std::exchange(last, &feature) != &feature) groups.push_back({{}, feature.use == FeatureUse::Land});
    std::vector<const Ring*>& rings = (is_whole ? groups.back() : groups.front()).rings;
    const auto addProjected = [&](Ring ring) { rings.push_back(&projected_rings.emplace_back(std::move(ring))); };
    if (to_geographic.isIdentity()) {
      if (feature.use == FeatureUse::Frame || !longitudesJump(chain)) {
        rings.push_back(&chain);
      } else {
        for (Ring& turned : turnedRings(chain)) addProjected(std::move(turned));
      }
    } else {
      Ring ring;
      for (auto i = places.end() - static_cast<std::ptrdiff_t>(chain.size()); i != places.end(); ++i)
        ring.push_back(asGeographic(*i));
      for (Ring& turned : turnedRings(ring)) addProjected(std::move(turned));
    }
  });
  if (places.empty() && !coastline.rest) throw InputError(featuresInWords(coastline, members) + ": holds no point");
  const double middle = west >= -180 && east <= 180 ? 0 : (west + east) / 2;
  const Ellipsoid ellipsoid = kind == SurfaceKind::Sphere
                                  ? Ellipsoid{kSphereRadius, 0.0}
                                  : Ellipsoid{coastline.crs.semi_major_m, coastline.crs.flattening};
  const auto fit = [&] {
    if (places.empty()) return mapOfEmptyGlobe(ellipsoid);
    try {
      return fitMap(places, groups, ellipsoid, coastline.rest ? SurfaceKind::Ellipsoid : kind);
    } catch (const InputError& error) {
      throw InputError(featuresInWords(coastline, members) + ": " + error.what());
    }
  };
  FittedMap map = fit();
  const Turn turn =
      to_geographic.isIdentity() || places.empty() ? Turn{} : turnOf(first_of_input, last_of_input, to_geographic);
  return std::make_shared<Fitted>(to_geographic, std::move(map), middle, turn);
}

}  // namespace

std::vector<Projection> Projection::fittedEach(const Coastline& coastline,
                                               const std::vector<std::vector<std::size_t>>& groups, SurfaceKind kind) {
  if (coastline.crs.isPlane()) return std::vector<Projection>(groups.size(), plane());
  const GeographicMap to_geographic(coastline.crs);
  std::vector<Projection> projections;
  projections.reserve(groups.size());
  for (const auto& members : groups) projections.push_back(Projection(fitTo(coastline, members, to_geographic, kind)));
  return projections;
}

Projection Projection::fitted(const Coastline& coastline, const std::vector<std::size_t>& members, SurfaceKind kind) {
  return fittedEach(coastline, {members}, kind).front();
}

}  // namespace coastmesh
