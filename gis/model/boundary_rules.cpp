#include "gis/model/boundary_rules.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "gis/coast/feature_names.hpp"
#include "gis/coast/turned_rings.hpp"
#include "gis/crs/crs_map.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/grid/ibtype.hpp"
#include "gis/lower_case.hpp"
#include "gis/read/cleaned_layers.hpp"
#include "gis/read/raw_layer.hpp"
#include "gis/read/read_layers.hpp"
#include "gis/rules/rough_lines.hpp"
#include "gis/rules/rule_shapes.hpp"

namespace coastmesh {

// Edges whose types are wanted: see `BoundaryRules::kindsOf`.
struct EdgesToType {
  const Crs& crs;
  std::span<const Point> places;
  const std::vector<NodePair>& edges;
  const std::vector<bool>& outer;
  const std::vector<double>& share;
  const std::vector<BoundaryKind>& before;
};

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

// The feature's attribute `name`, in whatever case; empty if it has none.
std::string givenName(const Feature& feature) {
  for (const auto& [key, value] : feature.attributes)
    if (lowerCase(key) == "name") return value;
  return {};
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

constexpr double kTurn = 360.0;
constexpr double kAround = 3.0;  // elements: lines farther away have nothing to do with an edge
constexpr double kSmall = 2.0;   // elements: a smaller polygon may be about a single edge

std::vector<Point> turnedLine(const std::vector<Point>& line, const Turns& turns) {
  std::vector<Point> turned = line;
  for (std::size_t i = 0; i < turned.size(); ++i) turned[i].x += kTurn * turns.of[i];
  return turned;
}

// A ring without jumps; one around a pole is closed through the pole.
Ring turnedRing(const Ring& ring) {
  const Turns turns = turnsOf(ring, true);
  return turns.round != 0 ? turnedRings(ring)[1] : turnedLine(ring, turns);
}

Polygon turnedPolygon(const Polygon& polygon) {
  Polygon turned{turnedRing(polygon.outer), {}};
  for (const Ring& hole : polygon.holes) turned.holes.push_back(turnedRing(hole));
  return turned;
}

bool jumps(const Polygon& polygon) {
  const auto ringJumps = [](const Ring& ring) { return turnsOf(ring, true).any; };
  return ringJumps(polygon.outer) || std::ranges::any_of(polygon.holes, ringJumps);
}

// Converts places of a mesh to coordinates of a layer, and back.
class LayerPlaces {
 public:
  LayerPlaces(const Crs& crs, const std::optional<Crs>& layer)
      // Coordinates in a plane are not degrees, whatever CRS a GeoJSON layer implies.
      : plane_(!crs.isPlane() && (layer ? layer->geographic : crs.geographic)) {
    const bool as_is = crs.isPlane() || !layer || layer->isPlane() || sameCrs(crs, *layer);
    if (!as_is) map_.emplace(toOgr(crs), toOgr(*layer));
  }

  const RulePlane& plane() const { return plane_; }
  Point toLayer(const Point& p) const { return map_ ? map_->forward(p) : p; }
  Point toMesh(const Point& p) const { return map_ ? map_->inverse(p) : p; }

  // nullopt if it has no place in the layer's CRS.
  std::optional<PlacedEdge> place(const EdgesToType& edges, std::size_t e) const {
    PlacedEdge edge{toLayer(edges.places[edges.edges[e][0]]), toLayer(edges.places[edges.edges[e][1]])};
    if (!std::isfinite(edge.a.x + edge.a.y + edge.b.x + edge.b.y)) return std::nullopt;
    if (plane_.geographic()) edge.b.x = edge.a.x + std::remainder(edge.b.x - edge.a.x, kTurn);
    edge.length = plane_.distance(edge.a, edge.b);
    edge.element = edge.length / (edges.share.empty() ? 1.0 : edges.share[e]);
    edge.outer = edges.outer[e];
    return edge;
  }

 private:
  RulePlane plane_;
  std::optional<CrsMap> map_;
};

// As a rule's, which says neither names nor where boundaries end.
BoundaryKind typeAlone(const BoundaryKind& kind) { return {kind.role, kind.ibtype}; }

// Sets the edges after each other. Where the boundary touches itself in a node, the next in order is taken.
void linkEdges(const EdgesToType& edges, const std::vector<std::size_t>& index, std::vector<NearEdge>& near) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> by_start;  // first node, place in `near`
  for (std::uint32_t i = 0; i < index.size(); ++i) by_start.emplace_back(edges.edges[index[i]][0], i);
  std::ranges::sort(by_start);
  for (std::uint32_t i = 0; i < index.size(); ++i) {
    const std::uint32_t end = edges.edges[index[i]][1];
    const auto first = std::ranges::lower_bound(by_start, std::pair(end, std::uint32_t{0}));
    if (first == by_start.end() || first->first != end) continue;
    const auto after = std::ranges::lower_bound(by_start, std::pair(end, i + 1));
    near[i].next = after != by_start.end() && after->first == end ? after->second : first->second;
  }
}

}  // namespace

BoundaryKind kindOfText(const std::string& text, const std::string& what) {
  if (const auto role = roleOfWord(text)) return {*role};
  if (text == "-1") return {BoundaryRole::Open};
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc() && end == text.data() + text.size();
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

// The types of boundary that the features of a layer define, in its CRS: one rule for each polygon and line, numbered
// in the layer's order; the last that applies counts.
class BoundaryLayer {
 public:
  explicit BoundaryLayer(std::optional<Crs> crs) : crs_(std::move(crs)) {}

  void addArea(const BoundaryKind& kind, const Feature& feature, const Polygon& polygon);
  void addLine(const BoundaryKind& kind, const Feature& feature, const std::vector<Point>& line);
  // A polygon's own shore.
  void addShore(const BoundaryKind& kind, const Feature& feature, const Ring& ring);
  // Call after the last rule is added.
  void build();

  bool empty() const { return rules_.empty(); }
  std::size_t size() const { return rules_.size(); }

  // Sets the types of the edges that it has rules for. `first` is the number of its first rule in `ruled`. `roughly`:
  // see `BoundaryRules::roughKindsOf`.
  void apply(const EdgesToType& edges, bool roughly, std::size_t first, const ItemLoop& loop, RuledEdges& ruled) const;

 private:
  struct Typing;

  void addRule(const BoundaryKind& kind, const Feature& feature, RuleForm form);
  void set(std::size_t edge, std::size_t rule, std::size_t first, RuledEdges& ruled) const;
  void applyRoughly(Typing& typing, std::size_t first, const ItemLoop& loop, RuledEdges& ruled) const;

  std::optional<Crs> crs_;
  std::vector<BoundaryRule> rules_;
  std::vector<std::string> names_;  // that each rule gives to the boundary; lines go on in others whatever their names
  RuleShapes as_given_;
  RuleShapes turned_;   // continued past the antimeridian
  bool jumps_ = false;  // true if the two differ
};

// What is known while edges get their types.
struct BoundaryLayer::Typing {
  const RuleShapes* shapes = nullptr;
  const LayerPlaces* places = nullptr;
  std::vector<bool> used{};          // rules with an area that contains an edge
  std::vector<NearEdge> near{};      // edges that may be near a line
  std::vector<std::size_t> index{};  // of these among all
  Box bounds{};                      // of all edges

  // Adds what is known of later edges.
  void add(const Typing& later) {
    for (std::size_t rule = 0; rule < used.size(); ++rule) used[rule] = used[rule] || later.used[rule];
    near.insert(near.end(), later.near.begin(), later.near.end());
    index.insert(index.end(), later.index.begin(), later.index.end());
    bounds.add(later.bounds);
  }
};

void BoundaryLayer::addRule(const BoundaryKind& kind, const Feature& feature, RuleForm form) {
  rules_.push_back({kind, form, feature.fid, std::string(nameOf(feature.attributes))});
  // A polygon that is meshed is named for its water.
  names_.push_back(isOpening(kind) && form != RuleForm::Shore ? givenName(feature) : "");
}

void BoundaryLayer::addArea(const BoundaryKind& kind, const Feature& feature, const Polygon& polygon) {
  if (polygon.outer.empty()) return;
  as_given_.addArea(rules_.size(), polygon);
  turned_.addArea(rules_.size(), turnedPolygon(polygon));
  jumps_ = jumps_ || jumps(polygon);
  addRule(kind, feature, RuleForm::Area);
}

void BoundaryLayer::addLine(const BoundaryKind& kind, const Feature& feature, const std::vector<Point>& line) {
  const Turns turns = turnsOf(line, false);
  as_given_.addLine(rules_.size(), line, false);
  turned_.addLine(rules_.size(), turnedLine(line, turns), false);
  jumps_ = jumps_ || turns.any;
  addRule(kind, feature, RuleForm::Line);
}

void BoundaryLayer::addShore(const BoundaryKind& kind, const Feature& feature, const Ring& ring) {
  if (ring.empty()) return;
  const Turns turns = turnsOf(ring, true);
  as_given_.addLine(rules_.size(), ring, true);
  std::vector<Point> turned = turnedLine(ring, turns);
  turned.push_back({ring.front().x + kTurn * turns.round, ring.front().y});
  turned_.addLine(rules_.size(), turned, false);
  jumps_ = jumps_ || turns.any;
  addRule(kind, feature, RuleForm::Shore);
}

void BoundaryLayer::build() {
  as_given_.build();
  if (jumps_) turned_.build();
  if (!jumps_) turned_ = {};
}

void BoundaryLayer::set(std::size_t edge, std::size_t rule, std::size_t first, RuledEdges& ruled) const {
  ruled.kinds[edge] = rules_[rule].kind;
  ruled.kinds[edge]->name = names_[rule];
  ruled.rules[edge] = static_cast<std::uint32_t>(first + rule);
}

void BoundaryLayer::apply(const EdgesToType& edges, bool roughly, std::size_t first, const ItemLoop& loop,
                          RuledEdges& ruled) const {
  constexpr std::size_t kLeast = 512;  // edges for one thread
  const LayerPlaces places(edges.crs, crs_);
  const RulePlane& plane = places.plane();
  const RuleShapes& shapes = plane.geographic() && jumps_ ? turned_ : as_given_;
  std::vector<std::optional<PlacedEdge>> placed;  // by one thread, as PROJ demands
  for (std::size_t e = 0; e < edges.edges.size(); ++e) placed.push_back(places.place(edges, e));
  const auto typeSome = [&](std::size_t begin, std::size_t end) {
    Typing some{&shapes, &places, std::vector(rules_.size(), false)};
    for (std::size_t e = begin; e < end; ++e) {
      const std::optional<PlacedEdge>& edge = placed[e];
      if (!edge) continue;
      const auto last =
          std::max(shapes.lastAlong(*edge, rules_, plane), shapes.lastAround(*edge, rules_, plane, some.used));
      if (last) set(e, *last, first, ruled);
      if (!roughly) continue;
      some.bounds.add(Box::of(edge->a, edge->b));
      if (!shapes.anyNear(*edge, kAround * edge->element, kSmall * edge->element, plane)) continue;
      some.near.push_back({*edge, last, kNone, edges.before.empty() ? BoundaryKind{} : typeAlone(edges.before[e])});
      some.index.push_back(e);
    }
    return some;
  };
  Typing typing{&shapes, &places, std::vector(rules_.size(), false)};
  for (const Typing& some : overStretches(loop, placed.size(), typeSome, kLeast)) typing.add(some);
  if (!roughly) return;
  linkEdges(edges, typing.index, typing.near);
  applyRoughly(typing, first, loop, ruled);
  for (std::size_t i = 0; i < typing.near.size(); ++i)
    if (typing.near[i].rule) set(typing.index[i], *typing.near[i].rule, first, ruled);
}

void BoundaryLayer::applyRoughly(Typing& typing, std::size_t first, const ItemLoop& loop, RuledEdges& ruled) const {
  const RulePlane& plane = typing.places->plane();
  for (const MissedPart& part : takeRoughly(*typing.shapes, rules_, plane, typing.used, typing.near, loop)) {
    const bool inside = std::ranges::any_of(plane.turns(), [&](double turn) {
      const Point place{part.place.x + turn, part.place.y};
      return typing.bounds.meets(Box::of(place, place));
    });
    ruled.missed.push_back({static_cast<std::uint32_t>(first + part.rule),
                            rules_[part.rule].fid,
                            rules_[part.rule].name,
                            part.whole,
                            inside,
                            typing.places->toMesh(part.place),
                            part.parts,
                            {}});
    if (rules_[part.rule].form != RuleForm::Area) continue;
    const Box box = typing.shapes->boxOf(part.rule);
    for (const double x : {box.xmin, box.xmax})
      for (const double y : {box.ymin, box.ymax}) ruled.missed.back().corners.push_back(typing.places->toMesh({x, y}));
  }
}

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
    throw InputError(sourceInWords(layers.front().source) + ": has no column \"" + column + "\" of boundary types; " +
                     inWords(columns));
  for (const RawLayer& raw : layers) {
    if (edge_by_edge && !isOfTypes(raw)) continue;
    const auto layer = std::make_shared<BoundaryLayer>(raw.crs);
    const auto kindOf = [&](const Feature& feature) -> std::optional<BoundaryKind> {
      const auto text = typeOf(feature, feature.use == FeatureUse::Boundary ? kBoundaryField : column);
      const std::string what = featureInWords(feature);
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
          layer->addArea(*kind, feature, polygon);
        } else {
          layer->addShore(*kind, feature, polygon.outer);
          for (const Ring& hole : polygon.holes) layer->addShore(*kind, feature, hole);
        }
      }
    }
    for (const RawLayer::Line& line : raw.lines) {
      const Feature& feature = raw.line_features[line.feature];
      if (const auto kind = kindOf(feature)) layer->addLine(*kind, feature, line.points);
    }
    layer->build();
    if (!layer->empty()) layers_.push_back(layer);
  }
}

std::vector<std::optional<BoundaryKind>> BoundaryRules::kindsOf(const Crs& crs, std::span<const Point> places,
                                                                const std::vector<NodePair>& edges,
                                                                const std::vector<bool>& outer,
                                                                const std::vector<double>& share) const {
  return ruledEdges({crs, places, edges, outer, share, {}}, false, inOrder).kinds;
}

RuledEdges BoundaryRules::roughKindsOf(const Crs& crs, std::span<const Point> places,
                                       const std::vector<NodePair>& edges, const std::vector<bool>& outer,
                                       const std::vector<double>& share, const std::vector<BoundaryKind>& before,
                                       const ItemLoop& loop) const {
  return ruledEdges({crs, places, edges, outer, share, before}, true, loop);
}

std::size_t BoundaryRules::size() const {
  std::size_t size = 0;
  for (const auto& layer : layers_) size += layer->size();
  return size;
}

RuledEdges BoundaryRules::ruledEdges(const EdgesToType& edges, bool roughly, const ItemLoop& loop) const {
  RuledEdges ruled;
  ruled.kinds.resize(edges.edges.size());
  ruled.rules.resize(edges.edges.size(), kNone);
  std::size_t first = 0;
  for (const auto& layer : layers_) {
    layer->apply(edges, roughly, first, loop, ruled);
    first += layer->size();
  }
  return ruled;
}

}  // namespace coastmesh
