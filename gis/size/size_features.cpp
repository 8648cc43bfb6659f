#include "gis/size/size_features.hpp"

#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/metric.hpp"
#include "gis/coast/turned_rings.hpp"
#include "gis/crs/crs_map.hpp"
#include "gis/crs/ground_balls.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/read/ogr_geometry.hpp"
#include "gis/read/open_source.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Sizes inside polygons, whose boundaries are half-open; outside them another field applies.
class PolygonField final : public SizeField {
 public:
  struct SizedPolygon {
    std::vector<Ring> rings;  // in the plane
    double size_m;
  };

  explicit PolygonField(std::vector<SizedPolygon> polygons) : polygons_(std::move(polygons)) {
    std::vector<Box> boxes;
    for (const SizedPolygon& polygon : polygons_) {
      std::vector<Box> edges;
      Box whole;
      for (const Ring& ring : polygon.rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
          const Point &a = ring[i], &b = ring[i + 1 == ring.size() ? 0 : i + 1];
          edges_.push_back({a, b});
          edges.push_back(Box::of(a, b));
          whole.add(edges.back());
        }
      }
      first_edge_.push_back(edges_.size() - edges.size());
      trees_.emplace_back(edges, BoxTree::Order::Given);
      boxes.push_back(whole);
    }
    tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
  }

  void sample(std::span<const Point> places, std::span<double> sizes) const override {
    for (std::size_t i = 0; i < places.size(); ++i) {
      sizes[i] = kInfinity;
      tree_.visit(Box::of(places[i], places[i]), [&](std::uint32_t p) {
        if (polygons_[p].size_m < sizes[i] && contains(p, places[i])) sizes[i] = polygons_[p].size_m;
      });
    }
  }

  // Outside, sizes grow from the edges, which are also lines of a `DistanceField`.
  bool isGraded() const override { return true; }
  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const Point& c = boxes[i].centre;
      const Box box = Box::of(c, c).grownBy(boxes[i].half);
      ranges[i] = {kInfinity, kInfinity};
      tree_.visit(box, [&](std::uint32_t p) {
        bool crossed = false;
        trees_[p].visit(box, [&](std::uint32_t) { crossed = true; });
        const bool within = contains(p, c);
        if (crossed || within) ranges[i].low = std::min(ranges[i].low, polygons_[p].size_m);
        if (!crossed && within) ranges[i].high = std::min(ranges[i].high, polygons_[p].size_m);
      });
    }
  }

 private:
  // Even-odd rule: counts the edges that a ray to the right meets.
  bool contains(std::uint32_t p, const Point& x) const {
    bool inside = false;
    trees_[p].visit(Box{x.x, x.y, kInfinity, x.y}, [&](std::uint32_t e) {
      const auto& [a, b] = edges_[first_edge_[p] + e];
      if ((a.y > x.y) == (b.y > x.y)) return;
      inside ^= x.x < a.x + (x.y - a.y) / (b.y - a.y) * (b.x - a.x);
    });
    return inside;
  }

  std::vector<SizedPolygon> polygons_;
  std::vector<std::pair<Point, Point>> edges_;  // polygon after polygon
  std::vector<std::size_t> first_edge_;
  std::vector<BoxTree> trees_;  // of each polygon's edges
  BoxTree tree_;                // of the polygons
};

void collectPoints(const OGRGeometry& geometry, std::vector<std::vector<Point>>& lines) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPoint && !geometry.IsEmpty()) {
    lines.push_back({{geometry.toPoint()->getX(), geometry.toPoint()->getY()}});
  } else if (type == wkbMultiPoint || type == wkbGeometryCollection) {
    for (const OGRGeometry* part : *geometry.toGeometryCollection()) collectPoints(*part, lines);
  }
}

// The attribute's value; nullopt if it is null. Throws InputError if it is not a number of at least `least`.
std::optional<double> numberOf(const OGRFeature& feature, int field, double least, const std::string& what) {
  if (field < 0 || !feature.IsFieldSetAndNotNull(field)) return std::nullopt;
  double value = feature.GetFieldAsDouble(field);
  if (feature.GetFieldDefnRef(field)->GetType() == OFTString) {
    // OGR accepts a text that begins with a number: 1 for "1 km".
    const std::string text = feature.GetFieldAsString(field);
    char* end = nullptr;
    value = CPLStrtod(text.c_str(), &end);
    while (*end == ' ') ++end;
    if (text.empty() || *end != '\0') value = std::numeric_limits<double>::quiet_NaN();
  }
  if (std::isfinite(value) && value >= least) return value;
  throw InputError(what + ": its attribute '" + feature.GetFieldDefnRef(field)->GetNameRef() + "' is " +
                   feature.GetFieldAsString(field) + ", not a number " + (least > 0.0 ? "above 0" : "of 0 or more") +
                   "; correct it, or leave it empty");
}

class FeatureReader {
 public:
  FeatureReader(const Crs& crs, double usual_rate, SizedFeatures& features)
      : crs_(crs), balls_(crs), usual_rate_(usual_rate), features_(features) {
    features_.crs = crs;
  }

  void read(OGRLayer& layer, const std::string& source, bool one_of_several) {
    const int size_field = layer.GetLayerDefn()->GetFieldIndex("size");
    const int rate_field = layer.GetLayerDefn()->GetFieldIndex("rate");
    if (size_field < 0) {
      throw InputError(source + ": has no attribute 'size', which says the size wanted in metres; add it" +
                       (one_of_several ? ", or name the layer that has it as FILE|LAYER" : ""));
    }
    std::optional<CrsMap> map;
    const OGRSpatialReference* srs = layer.GetSpatialRef();
    if (srs && !srs->IsEmpty() && !crs_.isPlane()) {
      OGRSpatialReference from(*srs);
      from.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
      map.emplace(from, toOgr(crs_));
    }
    layer.ResetReading();
    for (const OGRFeatureUniquePtr& feature : layer) {
      const OGRGeometry* geometry = feature->GetGeometryRef();
      const std::string what = source + ", feature " + std::to_string(feature->GetFID());
      const std::optional<double> size = numberOf(*feature, size_field, std::numeric_limits<double>::min(), what);
      if (!geometry || geometry->IsEmpty() || !size) continue;
      GeometryParts parts;
      takeApart(*geometry, what, parts);
      SizedFeatures::Part part;
      part.size_m = *size;
      part.rate = numberOf(*feature, rate_field, 0.0, what).value_or(usual_rate_);
      part.polygons = std::move(parts.polygons);
      part.lines = std::move(parts.lines);
      collectPoints(*geometry, part.lines);
      const auto move = [&](std::vector<Point>& points) {
        if (!map) return;
        for (Point& p : points) {
          p = map->forward(p);
          if (!std::isfinite(p.x) || !std::isfinite(p.y))
            throw InputError(what + ": has a place that the input's coordinate system does not reach; take it out");
        }
      };
      std::vector<Point> all;
      const auto moveAndKeep = [&](std::vector<Point>& points) {
        move(points);
        all.insert(all.end(), points.begin(), points.end());
      };
      for (Polygon& polygon : part.polygons) {
        moveAndKeep(polygon.outer);
        for (Ring& hole : polygon.holes) moveAndKeep(hole);
      }
      for (auto& line : part.lines) moveAndKeep(line);
      part.ball = balls_.around(all);
      features_.parts.push_back(std::move(part));
    }
  }

 private:
  const Crs& crs_;
  GroundBalls balls_;
  double usual_rate_;
  SizedFeatures& features_;
};

// Lines and rings of features in the working plane, with more points where an edge that is straight in the features'
// CRS is bent there.
class PlaneLines {
 public:
  // `scale` is plane length over metres.
  PlaneLines(const Crs& crs, const Projection& projection, const std::function<double(const Point&)>& scale,
             double size_m)
      : geographic_(crs.geographic), projection_(projection), scale_(scale), size_m_(size_m) {}

  // Empty if it leaves the area of the projection: it is too far away to matter.
  std::vector<Point> of(const std::vector<Point>& points, bool closed) const {
    std::vector<Point> plane;
    const Turns turns = geographic_ ? turnsOf(points, closed) : Turns{};
    for (std::size_t i = 0; i < points.size(); ++i) {
      plane.push_back(projection_.forward(points[i]));
      if (!isFinite(plane.back())) return {};
      if (i + 1 == points.size() && (!closed || i == 0)) continue;
      const std::size_t next = (i + 1) % points.size();
      Point end = points[next];
      if (turns.any) end.x += 360.0 * ((next == 0 ? turns.round : turns.of[next]) - turns.of[i]);
      if (!addBetween({points[i], plane.back()}, {end, projection_.forward(end)}, kMostHalvings, plane)) return {};
    }
    return plane;
  }

 private:
  static constexpr int kMostHalvings = 10;

  struct Place {
    Point input, plane;
  };

  static bool isFinite(const Point& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

  // Returns false if a place is beyond the projection's area.
  bool addBetween(const Place& from, const Place& to, int halvings, std::vector<Point>& plane) const {
    // The bend that is allowed: a share of the size, and of the edge.
    constexpr double kOfSize = 0.1, kOfLength = 1e-3;
    const Point input = midpoint(from.input, to.input);
    const Place middle{input, projection_.forward(input)};
    if (!isFinite(middle.plane) || !isFinite(to.plane)) return false;
    const double bend = distance(middle.plane, midpoint(from.plane, to.plane));
    const double least = kOfLength * distance(from.plane, to.plane);
    if (halvings == 0 || bend <= least || bend <= kOfSize * size_m_ * scale_(middle.plane)) return true;
    if (!addBetween(from, middle, halvings - 1, plane)) return false;
    plane.push_back(middle.plane);
    return addBetween(middle, to, halvings - 1, plane);
  }

  bool geographic_;
  const Projection& projection_;
  const std::function<double(const Point&)>& scale_;
  double size_m_;
};

// True if the part's size has grown to more than `most_m` everywhere in the scope. Distances in the plane may be
// shorter than on the ground, hence `kSure`; how much shorter is unknown for large parts.
bool isTooFar(const SizedFeatures::Part& part, const FeatureScope& scope) {
  constexpr double kSure = 0.5, kLarge = 2e6;
  if (!scope.ball || !(scope.ball->radius < kLarge) || !(part.ball.radius < kLarge)) return false;
  const double gap_m = distance(part.ball.centre, scope.ball->centre) - part.ball.radius - scope.ball->radius;
  return gap_m > 0.0 && kSure * gap_m * std::min(part.rate, scope.rate) > scope.most_m - part.size_m;
}

}  // namespace

SizedFeatures readSizedFeatures(const std::string& path, const Crs& crs, double usual_rate) {
  const OgrErrors errors;
  const OgrOption any_size("OGR_GEOJSON_MAX_OBJ_SIZE", "0");
  const OgrOption what_is_left_out("CPL_DEBUG", "GeoJSON");
  const OpenSource source = openSource(path, {}, errors);
  refuseOddGeojson(source, errors);
  SizedFeatures features;
  FeatureReader reader(crs, usual_rate, features);
  const bool only = source.dataset->GetLayerCount() == 1;
  for (OGRLayer* layer : source.layers) {
    reader.read(*layer, only ? source.name : source.name + "|" + layer->GetName(), source.layers.size() > 1);
    requireReadToEnd(source, errors);
  }
  if (features.parts.empty()) throw InputError(source.name + ": no feature in it has a geometry and a size");
  return features;
}

std::vector<std::unique_ptr<SizeField>> featureFields(const SizedFeatures& features, const Projection& projection,
                                                      const std::function<double(const Point&)>& scale,
                                                      const FeatureScope& scope) {
  std::vector<SizedLine> lines;
  std::vector<PolygonField::SizedPolygon> polygons;
  for (const SizedFeatures::Part& part : features.parts) {
    if (isTooFar(part, scope)) continue;
    const PlaneLines plane(features.crs, projection, scale, part.size_m);
    const auto addLine = [&](const std::vector<Point>& points, bool closed) {
      if (points.size() == 1) lines.push_back({points[0], points[0], part.size_m, part.rate});
      for (std::size_t i = 0; i + (closed ? 0 : 1) < points.size(); ++i)
        lines.push_back({points[i], points[(i + 1) % points.size()], part.size_m, part.rate});
    };
    PolygonField::SizedPolygon sized{{}, part.size_m};
    for (const Polygon& polygon : part.polygons) {
      Ring outer = plane.of(polygon.outer, true);
      if (outer.empty()) continue;
      addLine(outer, true);
      sized.rings.push_back(std::move(outer));
      for (const Ring& hole : polygon.holes) {
        sized.rings.push_back(plane.of(hole, true));
        addLine(sized.rings.back(), true);
      }
    }
    for (const auto& line : part.lines) addLine(plane.of(line, false), false);
    if (!sized.rings.empty()) polygons.push_back(std::move(sized));
  }
  std::vector<std::unique_ptr<SizeField>> fields;
  fields.push_back(std::make_unique<DistanceField>(std::move(lines), scale, kInfinity, projection.surface()));
  if (!polygons.empty()) fields.push_back(std::make_unique<PolygonField>(std::move(polygons)));
  return fields;
}

}  // namespace coastmesh
