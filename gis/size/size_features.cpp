#include "gis/size/size_features.hpp"

#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/metric.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/coast/input_polygons.hpp"
#include "gis/coast/turned_rings.hpp"
#include "gis/crs/crs_map.hpp"
#include "gis/crs/ground_balls.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/read/geojson_crs.hpp"
#include "gis/read/number_attribute.hpp"
#include "gis/read/ogr_geometry.hpp"
#include "gis/read/open_source.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A line or ring in the plane.
struct PlaneChain {
  std::vector<std::vector<Point>> pieces;
  bool is_whole = true;  // one piece, closed if a ring; otherwise parts of it have no place in the plane
};

// Rings in the plane, with what a place needs to be located in them. Boundaries are half-open.
class PlaneRings {
 public:
  explicit PlaneRings(const std::vector<PlaneChain>& rings) {
    std::vector<Box> boxes;
    for (const PlaneChain& ring : rings) {
      for (const auto& piece : ring.pieces) {
        const bool closed = ring.is_whole;
        for (std::size_t i = 0; i + (closed ? 0 : 1) < piece.size(); ++i) {
          edges_.push_back({piece[i], piece[i + 1 == piece.size() ? 0 : i + 1]});
          boxes.push_back(Box::of(edges_.back().first, edges_.back().second));
        }
      }
    }
    tree_ = BoxTree(boxes, BoxTree::Order::Given);
  }

  Box bounds() const { return tree_.bounds(); }
  bool cross(const Box& box) const {
    bool crossed = false;
    tree_.visit(box, [&](std::uint32_t) { crossed = true; });
    return crossed;
  }
  // Even-odd rule: counts the edges that a ray to the right meets.
  bool hold(const Point& x) const {
    bool inside = false;
    tree_.visit(Box{x.x, x.y, kInfinity, x.y}, [&](std::uint32_t e) {
      const auto& [a, b] = edges_[e];
      if ((a.y > x.y) == (b.y > x.y)) return;
      inside ^= x.x < a.x + (x.y - a.y) / (b.y - a.y) * (b.x - a.x);
    });
    return inside;
  }

 private:
  std::vector<std::pair<Point, Point>> edges_;
  BoxTree tree_;
};

// True if the inside of the polygons is that of their rings in the plane: these are whole, and a place is on the same
// side of them in both. (It is the other side if the plane shows most of the globe, and the polygons hold the place
// that is at infinity.)
bool keepsInside(const std::vector<PlaneChain>& chains, const PlaneRings& rings, const InputPolygons& polygons,
                 bool geographic, const Projection& projection) {
  constexpr double kSame = 1e-6;  // of the box, for a place that is brought to the input and back
  const Box box = rings.bounds();
  if (box.empty() || !std::ranges::all_of(chains, &PlaneChain::is_whole)) return false;
  const Point middle{box.xmin / 2 + box.xmax / 2, box.ymin / 2 + box.ymax / 2};
  const Point place = projection.inverse(middle);
  if (!std::isfinite(place.x) || !std::isfinite(place.y)) return false;
  const Point back = projection.forward(place);
  if (!(distance(back, middle) <= kSame * (box.xmax - box.xmin + box.ymax - box.ymin))) return false;
  const bool holds = geographic ? polygons.holdAtAnyTurn(place) : polygons.locate(place) == Location::Inside;
  return holds == rings.hold(middle);
}

// Sizes inside polygons; outside them another field applies.
class PolygonField final : public SizeField {
 public:
  PolygonField(const Projection& projection, bool geographic) : projection_(projection), geographic_(geographic) {}

  void add(const std::vector<Polygon>& polygons, const std::vector<PlaneChain>& chains, double size_m) {
    PlaneRings rings(chains);
    InputPolygons given(polygons, geographic_);
    Sized& sized = sized_.emplace_back(Sized{std::move(rings), size_m});
    if (keepsInside(chains, sized.rings, given, geographic_, projection_)) return;
    sized.by_place = true;
    given_.push_back(std::move(given));
    sized_of_given_.push_back(static_cast<std::uint32_t>(sized_.size() - 1));
  }
  // Call it after the last polygon.
  void build() {
    std::vector<Box> boxes;
    for (const Sized& sized : sized_) boxes.push_back(sized.rings.bounds());
    tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
    by_place_ = PolygonsByPlace(std::exchange(given_, {}), geographic_);
  }
  bool isEmpty() const { return sized_.empty(); }

  void sample(std::span<const Point> places, std::span<double> sizes) const override {
    for (std::size_t i = 0; i < places.size(); ++i) {
      sizes[i] = kInfinity;
      visitHolders(places[i], [&](const Sized& sized) { sizes[i] = std::min(sizes[i], sized.size_m); });
    }
  }

  // Outside, sizes grow from the edges, which are also lines of a `DistanceField`.
  bool isGraded() const override { return true; }
  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const Point& c = boxes[i].centre;
      const Box box = Box::of(c, c).grownBy(boxes[i].half);
      ranges[i] = {kInfinity, kInfinity};
      tree_.visit(box, [&](std::uint32_t s) {
        if (sized_[s].rings.cross(box)) ranges[i].low = std::min(ranges[i].low, sized_[s].size_m);
      });
      visitHolders(c, [&](const Sized& sized) {
        ranges[i].low = std::min(ranges[i].low, sized.size_m);
        if (!sized.rings.cross(box)) ranges[i].high = std::min(ranges[i].high, sized.size_m);
      });
    }
  }

 private:
  struct Sized {
    PlaneRings rings;
    double size_m;
    bool by_place = false;  // its inside is that of the input's coordinates
  };

  template <typename Found>
  void visitHolders(const Point& x, Found&& found) const {
    tree_.visit(Box::of(x, x), [&](std::uint32_t s) {
      if (!sized_[s].by_place && sized_[s].rings.hold(x)) found(sized_[s]);
    });
    if (sized_of_given_.empty()) return;
    by_place_.visit(projection_.inverse(x), [&](std::uint32_t p) { found(sized_[sized_of_given_[p]]); });
  }

  Projection projection_;
  bool geographic_;
  std::vector<Sized> sized_;
  BoxTree tree_;  // of `sized_`
  std::vector<InputPolygons> given_;
  std::vector<std::uint32_t> sized_of_given_;
  PolygonsByPlace by_place_{{}, false};
};

void collectPoints(const OGRGeometry& geometry, std::vector<std::vector<Point>>& lines) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbPoint && !geometry.IsEmpty()) {
    lines.push_back({{geometry.toPoint()->getX(), geometry.toPoint()->getY()}});
  } else if (type == wkbMultiPoint || type == wkbGeometryCollection) {
    for (const OGRGeometry* part : *geometry.toGeometryCollection()) collectPoints(*part, lines);
  }
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
      throw InputError(sourceInWords(source) +
                       ": has no attribute 'size', which says the size wanted in metres; add it" +
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
      const std::string what = "'" + source + "', feature " + std::to_string(feature->GetFID());
      const std::optional<double> size =
          numberAttribute(*feature, size_field, std::numeric_limits<double>::min(), what);
      if (!geometry || geometry->IsEmpty() || !size) continue;
      GeometryParts parts;
      takeApart(*geometry, what, parts);
      SizedFeatures::Part part;
      part.size_m = *size;
      part.rate = numberAttribute(*feature, rate_field, 0.0, what).value_or(usual_rate_);
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
// CRS is bent there, and without the parts that leave the area of the projection: they are too far away to matter.
class PlaneLines {
 public:
  // `scale` is plane length over metres.
  PlaneLines(const Crs& crs, const Projection& projection, const std::function<double(const Point&)>& scale,
             double size_m)
      : geographic_(crs.geographic), projection_(projection), scale_(scale), size_m_(size_m) {}

  PlaneChain of(const std::vector<Point>& points, bool closed) const {
    Pieces pieces;
    const Turns turns = geographic_ ? turnsOf(points, closed) : Turns{};
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Place from = placeOf(points[i]);
      pieces.add(from.plane);
      if (i + 1 == points.size() && (!closed || i == 0)) continue;
      const std::size_t next = (i + 1) % points.size();
      Point end = points[next];
      if (turns.any) end.x += 360.0 * ((next == 0 ? turns.round : turns.of[next]) - turns.of[i]);
      addBetween(from, placeOf(end), kMostHalvings, pieces);
    }
    if (closed && !pieces.isWhole()) pieces.add(projection_.forward(points.front()));
    return pieces.take();
  }

 private:
  static constexpr int kMostHalvings = 10;

  struct Place {
    Point input, plane;
  };

  static bool isFinite(const Point& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

  class Pieces {
   public:
    void add(const Point& p) {
      if (!isFinite(p)) return end();
      if (ended_) chain_.pieces.emplace_back();
      ended_ = false;
      chain_.pieces.back().push_back(p);
    }
    // What is added next begins another piece.
    void end() { ended_ = true, chain_.is_whole = false; }
    bool isWhole() const { return chain_.is_whole; }
    PlaneChain take() { return std::move(chain_); }

   private:
    PlaneChain chain_;
    bool ended_ = true;
  };

  Place placeOf(const Point& input) const { return {input, projection_.forward(input)}; }

  // Adds what lies between the two places.
  void addBetween(const Place& from, const Place& to, int halvings, Pieces& pieces) const {
    // The bend that is allowed: a share of the size, and of the edge. Of a short edge, it shows that the projection
    // has its ends apart.
    constexpr double kOfSize = 0.1, kOfLength = 1e-3, kTorn = 0.25;
    const Place middle = placeOf(midpoint(from.input, to.input));
    const int places = isFinite(from.plane) + isFinite(middle.plane) + isFinite(to.plane);
    if (places == 0) return;
    double bend = kInfinity, length = kInfinity;
    if (places == 3) {
      length = distance(from.plane, to.plane);
      bend = distance(middle.plane, midpoint(from.plane, to.plane));
      if (bend <= kOfLength * length || bend <= kOfSize * size_m_ * scale_(middle.plane)) return;
    }
    if (halvings == 0) {
      if (!(bend <= kTorn * length)) pieces.end();
      return;
    }
    addBetween(from, middle, halvings - 1, pieces);
    pieces.add(middle.plane);
    addBetween(middle, to, halvings - 1, pieces);
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
  requireKnownCrs(source);
  SizedFeatures features;
  FeatureReader reader(crs, usual_rate, features);
  const bool only = source.dataset->GetLayerCount() == 1;
  for (OGRLayer* layer : source.layers) {
    reader.read(*layer, only ? source.name : source.name + "|" + layer->GetName(), source.layers.size() > 1);
    requireReadToEnd(source, errors);
  }
  if (features.parts.empty())
    throw InputError(sourceInWords(source.name) + ": no feature in it has a geometry and a size");
  return features;
}

std::vector<std::unique_ptr<SizeField>> featureFields(const SizedFeatures& features, const Projection& projection,
                                                      const std::function<double(const Point&)>& scale,
                                                      const FeatureScope& scope) {
  std::vector<SizedLine> lines;
  auto inside = std::make_unique<PolygonField>(projection, features.crs.geographic);
  for (const SizedFeatures::Part& part : features.parts) {
    if (isTooFar(part, scope)) continue;
    const PlaneLines plane(features.crs, projection, scale, part.size_m);
    const auto addLine = [&](const PlaneChain& chain, bool closed) {
      for (const std::vector<Point>& points : chain.pieces) {
        if (points.size() == 1) lines.push_back({points[0], points[0], part.size_m, part.rate});
        for (std::size_t i = 0; i + (closed && chain.is_whole ? 0 : 1) < points.size(); ++i)
          lines.push_back({points[i], points[(i + 1) % points.size()], part.size_m, part.rate});
      }
    };
    std::vector<PlaneChain> rings;
    const auto addRing = [&](const Ring& ring) { addLine(rings.emplace_back(plane.of(ring, true)), true); };
    for (const Polygon& polygon : part.polygons) {
      addRing(polygon.outer);
      std::ranges::for_each(polygon.holes, addRing);
    }
    for (const auto& line : part.lines) addLine(plane.of(line, false), false);
    if (!rings.empty()) inside->add(part.polygons, rings, part.size_m);
  }
  std::vector<std::unique_ptr<SizeField>> fields;
  fields.push_back(std::make_unique<DistanceField>(std::move(lines), scale, kInfinity, projection.surface()));
  inside->build();
  if (!inside->isEmpty()) fields.push_back(std::move(inside));
  return fields;
}

}  // namespace coastmesh
