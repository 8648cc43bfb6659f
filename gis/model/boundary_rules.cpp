#include "gis/model/boundary_rules.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include "gis/crs/crs_map.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/grid/ibtype.hpp"
#include "gis/lower_case.hpp"
#include "gis/read/cleaned_layers.hpp"
#include "gis/read/raw_layer.hpp"
#include "gis/read/read_layers.hpp"

namespace coastmesh {
namespace {

constexpr std::array kColumns{"type", "role", "boundary", "ibtype", "kind"};

// "type, role, boundary, ibtype or kind"
std::string namesOfColumns() {
  std::string names;
  for (std::size_t i = 0; i < kColumns.size(); ++i)
    names += std::string(i == 0 ? "" : i + 1 < kColumns.size() ? ", " : " or ") + kColumns[i];
  return names;
}

// The feature's type as text; nullopt if it has no such column, or no value in it.
std::optional<std::string> typeOf(const Feature& feature, const std::string& column) {
  const auto find = [&](const std::string& name) -> std::optional<std::string> {
    for (const auto& [key, value] : feature.attributes)
      if (lowerCase(key) == lowerCase(name)) return value;
    return std::nullopt;
  };
  if (!column.empty()) return find(column);
  for (const char* name : kColumns)
    if (auto value = find(name)) return value;
  return std::nullopt;
}

bool isOfTypes(const RawLayer& layer) { return layer.use == FeatureUse::Boundary; }

// The columns of tables, and attributes that features of a cleaned file have kept.
std::set<std::string> columnsOf(const std::vector<RawLayer>& layers) {
  std::set<std::string> columns;
  for (const RawLayer& layer : layers) {
    columns.insert(layer.columns.begin(), layer.columns.end());
    for (const auto* const features : {&layer.features, &layer.line_features})
      for (const Feature& feature : *features)
        for (const auto& [name, value] : feature.attributes) columns.insert(name);
  }
  return columns;
}

bool hasColumn(const std::set<std::string>& columns, const std::string& wanted) {
  return std::ranges::any_of(columns, [&](const std::string& name) { return lowerCase(name) == lowerCase(wanted); });
}

std::string inWords(const std::set<std::string>& columns) {
  if (columns.empty()) return "there are no columns";
  constexpr std::size_t kShown = 20;
  std::string text = columns.size() == 1 ? "there is only" : "there are";
  std::size_t shown = 0;
  for (const std::string& name : columns)
    if (shown++ < kShown) text += (shown == 1 ? " " : ", ") + name;
  return columns.size() > kShown ? text + " and " + std::to_string(columns.size() - kShown) + " more" : text;
}

// Even-odd rule for one ring: true if a ray from `p` eastwards crosses it an odd number of times.
bool crossesOddly(const Ring& ring, const Point& p) {
  bool odd = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Point &a = ring[i], &b = ring[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
  }
  return odd;
}

bool contains(const Polygon& polygon, const Point& p) {
  bool inside = crossesOddly(polygon.outer, p);
  for (const Ring& hole : polygon.holes) inside = inside != crossesOddly(hole, p);
  return inside;
}

// An edge of the boundary in the layer's CRS.
struct PlacedEdge {
  Point a, b;
  double share = 1.0;  // of the mesh edge that it is a piece of

  Point middle() const { return {(a.x + b.x) / 2.0, (a.y + b.y) / 2.0}; }
};

double distanceToSegment(const Point& p, const Point& a, const Point& b, double shrink) {
  const double dx = (b.x - a.x) * shrink, dy = b.y - a.y, px = (p.x - a.x) * shrink, py = p.y - a.y;
  const double square = dx * dx + dy * dy;
  const double t = square > 0.0 ? std::clamp((px * dx + py * dy) / square, 0.0, 1.0) : 0.0;
  return std::hypot(px - t * dx, py - t * dy);
}

constexpr double kTurn = 360.0;

// Shifts to try, in degrees: longitudes of edge and layer may be in different turns.
std::vector<double> turnsToTry(bool geographic) {
  return geographic ? std::vector<double>{0.0, -kTurn, kTurn} : std::vector<double>{0.0};
}

}  // namespace

BoundaryKind kindOfText(const std::string& text, const std::string& what) {
  const std::string word = lowerCase(text);
  const auto isOneOf = [&](std::initializer_list<const char*> names) { return std::ranges::count(names, word) > 0; };
  if (isOneOf({"open", "ocean", "sea", "tidal", "tide", "level", "-1"})) return {BoundaryRole::Open};
  if (isOneOf({"river", "inflow", "discharge", "flow", "flux"})) return {BoundaryRole::River};
  if (isOneOf({"land", "shore", "coast", "wall", "closed", "solid", "mainland", "island"})) return {BoundaryRole::Land};
  int number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const bool whole = error == std::errc() && end == word.data() + word.size();
  const Ibtype* const type = whole ? findIbtype(number) : nullptr;
  if (type != nullptr && !type->isWeir()) {
    // Islands and shores are distinguished by their loops alone.
    const BoundaryRole role = type->role == BoundaryRole::River ? BoundaryRole::River : BoundaryRole::Land;
    return {role, isRolesOwn(number) ? -1 : number};
  }
  throw InputError(what + ": \"" + text +
                   "\" is not a type of boundary; give land, open or river, or a number of ADCIRC's (" +
                   givableIbtypes() + "; -1 for open)");
}

std::string textOfKind(const BoundaryKind& kind) {
  return kind.ibtype >= 0 ? std::to_string(kind.ibtype) : std::string(toString(kind.role));
}

// The rules of a layer, in its CRS, numbered in the layer's order; the last that applies counts.
class BoundaryRules::Layer {
 public:
  explicit Layer(const RawLayer& raw) : crs_(raw.crs) {}

  bool empty() const { return kinds_.empty(); }

  void addArea(const BoundaryKind& kind, const Polygon& polygon) {
    areas_.push_back({kinds_.size(), polygon});
    kinds_.push_back(kind);
  }
  void addLine(const BoundaryKind& kind, const std::vector<Point>& line) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) pieces_.push_back({kinds_.size(), line[i], line[i + 1]});
    kinds_.push_back(kind);
  }
  void addRing(const BoundaryKind& kind, const Ring& ring) {
    if (ring.empty()) return;
    addLine(kind, ring);
    pieces_.push_back({kinds_.size() - 1, ring.back(), ring.front()});
  }

  // Call after the last rule is added.
  void build() {
    std::vector<Box> boxes;
    for (const Area& area : areas_) {
      Box& box = boxes.emplace_back();
      for (const Point& p : area.polygon.outer) box.add(p);
    }
    area_tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
    boxes.clear();
    for (const Piece& piece : pieces_) boxes.push_back(Box::of(piece.a, piece.b));
    piece_tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
  }

  // Sets the kinds of edges that it has rules for.
  void apply(const Crs& crs, const std::vector<Point>& places, const std::vector<NodePair>& edges,
             const std::vector<bool>& outer, const std::vector<double>& share,
             std::vector<std::optional<BoundaryKind>>& kinds) const {
    const bool as_is = crs.isPlane() || !crs_ || crs_->isPlane() || sameCrs(crs, *crs_);
    std::optional<CrsMap> map;
    if (!as_is) map.emplace(toOgr(crs), toOgr(*crs_));
    const auto place = [&](std::uint32_t node) { return map ? map->forward(places[node]) : places[node]; };
    // Coordinates in a plane are not degrees, whatever CRS a GeoJSON layer implies.
    const bool geographic = !crs.isPlane() && (crs_ ? crs_->geographic : crs.geographic);
    const std::vector<double> turns = turnsToTry(geographic);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const Point a = place(edges[e][0]);
      Point b = place(edges[e][1]);
      if (!std::isfinite(a.x + a.y + b.x + b.y)) continue;
      if (geographic) b.x = a.x + std::remainder(b.x - a.x, kTurn);
      std::optional<std::size_t> last;
      for (const double turn : turns) {
        const PlacedEdge edge{{a.x + turn, a.y}, {b.x + turn, b.y}, share.empty() ? 1.0 : share[e]};
        const double shrink = geographic ? std::max(1e-6, std::cos(edge.middle().y * std::numbers::pi / 180.0)) : 1.0;
        last = std::max({last, lastLineAlong(edge, shrink), lastAreaAround(edge.middle(), outer[e])});
      }
      if (last) kinds[e] = kinds_[*last];
    }
  }

 private:
  struct Area {
    std::size_t rule = 0;
    Polygon polygon;
  };
  struct Piece {  // of a line
    std::size_t rule = 0;
    Point a, b;
  };

  std::optional<std::size_t> lastLineAlong(const PlacedEdge& edge, double shrink) const {
    constexpr double kFarthest = 0.2;  // share of the edge's length
    const double length = std::hypot((edge.b.x - edge.a.x) * shrink, edge.b.y - edge.a.y);
    const double far = kFarthest * length / edge.share;
    std::vector<std::size_t> common;
    const std::array<Point, 3> places{edge.a, edge.middle(), edge.b};
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Point& p = places[k];
      Box query;
      query.add(Point{p.x - far / shrink, p.y - far});
      query.add(Point{p.x + far / shrink, p.y + far});
      std::vector<std::size_t> near;
      piece_tree_.visit(query, [&](std::uint32_t i) {
        const Piece& piece = pieces_[i];
        if (distanceToSegment(p, piece.a, piece.b, shrink) <= far) near.push_back(piece.rule);
      });
      std::ranges::sort(near);
      const auto repeated = std::ranges::unique(near);
      near.erase(repeated.begin(), repeated.end());
      if (k == 0) {
        common = std::move(near);
      } else {
        std::erase_if(common, [&](std::size_t rule) { return !std::ranges::binary_search(near, rule); });
      }
      if (common.empty()) return std::nullopt;
    }
    return common.back();
  }

  std::optional<std::size_t> lastAreaAround(const Point& p, bool outer) const {
    std::optional<std::size_t> last;
    area_tree_.visit(Box::of(p, p), [&](std::uint32_t i) {
      const auto& [rule, polygon] = areas_[i];
      if (last && rule < *last) return;
      const BoundaryRole role = kinds_[rule].role;
      if (!outer && (role == BoundaryRole::Open || role == BoundaryRole::River)) return;
      if (contains(polygon, p)) last = rule;
    });
    return last;
  }

  std::optional<Crs> crs_;
  std::vector<BoundaryKind> kinds_;  // one for each rule
  std::vector<Area> areas_;
  std::vector<Piece> pieces_;
  BoxTree area_tree_, piece_tree_;
};

BoundaryRules BoundaryRules::ofFile(const std::string& path, const std::string& column) {
  BoundaryRules rules;
  ReadReport ignored;
  rules.add(readLayers({path, FeatureUse::Area}, {}, ignored), column, true);
  return rules;
}

void BoundaryRules::addInput(const std::vector<RawLayer>& layers, const std::string& column) {
  if (!column.empty()) {
    columns_of_input_.merge(columnsOf(layers));
    input_is_typed_ = input_is_typed_ || std::ranges::any_of(layers, isOfTypes);
  }
  add(layers, column, false);
}

void BoundaryRules::requireInputColumn(const std::string& column) const {
  if (!input_is_typed_ && !hasColumn(columns_of_input_, column))
    throw InputError("no input has the column \"" + column + "\" of boundary types; " + inWords(columns_of_input_));
}

void BoundaryRules::add(const std::vector<RawLayer>& layers, const std::string& column, bool all_have_it) {
  // If a cleaned file defines its boundary edge by edge, only that counts.
  const bool edge_by_edge = std::ranges::any_of(layers, isOfTypes);
  if (!edge_by_edge && !all_have_it && column.empty()) return;
  if (const std::set<std::string> columns = columnsOf(layers);
      !edge_by_edge && all_have_it && !column.empty() && !layers.empty() && !hasColumn(columns, column))
    throw InputError(layers.front().source + ": has no column \"" + column + "\" of boundary types; " +
                     inWords(columns));
  for (const RawLayer& raw : layers) {
    if (edge_by_edge && !isOfTypes(raw)) continue;
    const auto layer = std::make_shared<Layer>(raw);
    const auto kindOf = [&](const Feature& feature) -> std::optional<BoundaryKind> {
      const auto text = typeOf(feature, feature.use == FeatureUse::Boundary ? kBoundaryField : column);
      const std::string what = feature.source + ", feature " + std::to_string(feature.fid);
      if (text) return kindOfText(*text, what);
      if (all_have_it)
        throw InputError(what + ": has no type of boundary in " +
                         (column.empty() ? "a column called " + namesOfColumns() : "the column \"" + column + "\""));
      return std::nullopt;
    };
    for (const Feature& feature : raw.features) {
      const auto kind = kindOf(feature);
      if (!kind) continue;
      for (const Polygon& polygon : feature.polygons) {
        // A polygon of the input is meshed, so its type is meant for its own boundary.
        if (all_have_it) {
          layer->addArea(*kind, polygon);
        } else {
          layer->addRing(*kind, polygon.outer);
          for (const Ring& hole : polygon.holes) layer->addRing(*kind, hole);
        }
      }
    }
    for (const RawLayer::Line& line : raw.lines)
      if (const auto kind = kindOf(raw.line_features[line.feature])) layer->addLine(*kind, line.points);
    layer->build();
    if (!layer->empty()) layers_.push_back(layer);
  }
}

std::vector<std::optional<BoundaryKind>> BoundaryRules::kindsOf(const Crs& crs, const std::vector<Point>& places,
                                                                const std::vector<NodePair>& edges,
                                                                const std::vector<bool>& outer,
                                                                const std::vector<double>& share) const {
  std::vector<std::optional<BoundaryKind>> kinds(edges.size());
  for (const auto& layer : layers_) layer->apply(crs, places, edges, outer, share, kinds);
  return kinds;
}

}  // namespace coastmesh
