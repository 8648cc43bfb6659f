#include "gis/model/assign_boundaries.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "gis/crs/crs_map.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/grid/ibtype.hpp"
#include "gis/grid/loop_role.hpp"
#include "gis/read/cleaned_layers.hpp"
#include "gis/read/read_layers.hpp"

namespace coastmesh {
namespace {

std::string lowerCase(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

constexpr std::array kColumns{"type", "role", "boundary", "ibtype", "kind"};

// The feature's type as text; none where it has no such column, or nothing in it.
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

// A polygon or a line in its layer's CRS, and what it makes of the boundary.
struct Rule {
  BoundaryKind kind;
  const Polygon* polygon = nullptr;
  const std::vector<Point>* line = nullptr;
  Box box;
};

// Even-odd over one ring: whether a ray from `p` eastwards crosses it an odd number of times.
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
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  Point a, b;

  Point middle() const { return {(a.x + b.x) / 2.0, (a.y + b.y) / 2.0}; }
};

double distanceToSegment(const Point& p, const Point& a, const Point& b, double shrink) {
  const double dx = (b.x - a.x) * shrink, dy = b.y - a.y, px = (p.x - a.x) * shrink, py = p.y - a.y;
  const double square = dx * dx + dy * dy;
  const double t = square > 0.0 ? std::clamp((px * dx + py * dy) / square, 0.0, 1.0) : 0.0;
  return std::hypot(px - t * dx, py - t * dy);
}

// The pieces of all lines, to be searched by place.
class LinePieces {
 public:
  explicit LinePieces(const std::vector<Rule>& rules) {
    std::vector<Box> boxes;
    for (std::size_t r = 0; r < rules.size(); ++r) {
      if (rules[r].line == nullptr) continue;
      const std::vector<Point>& line = *rules[r].line;
      for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        Box& box = boxes.emplace_back();
        box.add(line[i]);
        box.add(line[i + 1]);
        pieces_.push_back({r, &line[i]});
      }
    }
    tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
  }

  // The last rule whose line the edge runs along.
  std::optional<std::size_t> along(const PlacedEdge& edge, double shrink) const {
    constexpr double kFarthest = 0.2;  // of the edge's length
    const double length = std::hypot((edge.b.x - edge.a.x) * shrink, edge.b.y - edge.a.y), far = kFarthest * length;
    std::vector<std::size_t> common;
    const std::array<Point, 3> places{edge.a, edge.middle(), edge.b};
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Point& p = places[k];
      Box query;
      query.add(Point{p.x - far / shrink, p.y - far});
      query.add(Point{p.x + far / shrink, p.y + far});
      std::vector<std::size_t> near;
      tree_.visit(query, [&](std::uint32_t piece) {
        const auto& [rule, from] = pieces_[piece];
        if (distanceToSegment(p, from[0], from[1], shrink) <= far) near.push_back(rule);
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

 private:
  struct Piece {
    std::size_t rule = 0;
    const Point* from = nullptr;
  };
  std::vector<Piece> pieces_;
  BoxTree tree_;
};

// Shifted by whole turns, so that edge and layer may count longitudes from different meridians.
std::vector<double> turnsToTry(bool geographic) {
  return geographic ? std::vector<double>{0.0, -360.0, 360.0} : std::vector<double>{0.0};
}

class RuleSet {
 public:
  RuleSet(const std::string& path, const std::string& column, bool all_have_it) {
    ReadReport ignored;
    layers_ = readLayers({path, FeatureUse::Area}, {}, ignored);
    // What a cleaned file says of its boundary edge by edge counts alone.
    if (ignored.boundary_types) std::erase_if(layers_, [](const RawLayer& l) { return l.use != FeatureUse::Boundary; });
    for (const RawLayer& layer : layers_) {
      Layer& made = made_.emplace_back();
      made.raw = &layer;
      const auto addKind = [&](const Feature& feature) -> std::optional<BoundaryKind> {
        const auto text = typeOf(feature, feature.use == FeatureUse::Boundary ? kBoundaryField : column);
        const std::string what = feature.source + ", feature " + std::to_string(feature.fid);
        if (text) return kindOfText(*text, what);
        if (all_have_it)
          throw InputError(what + ": has no type of boundary in " +
                           (column.empty() ? "a column called type or role" : "the column \"" + column + "\""));
        return std::nullopt;
      };
      for (const Feature& feature : layer.features) {
        const auto kind = addKind(feature);
        if (!kind) continue;
        for (const Polygon& polygon : feature.polygons) {
          // A polygon of the input is meshed: its own boundary is meant.
          if (all_have_it) {
            made.add({*kind, &polygon, nullptr, {}}, polygon.outer);
          } else {
            addRing(made, *kind, polygon.outer);
            for (const Ring& hole : polygon.holes) addRing(made, *kind, hole);
          }
        }
      }
      for (const RawLayer::Line& line : layer.lines) {
        if (const auto kind = addKind(layer.line_features[line.feature]))
          made.add({*kind, nullptr, &line.points, {}}, line.points);
      }
    }
  }

  // Calls `said(edge index, kind)` for edges that the rules say something of, in the layers' order.
  template <typename Said>
  void apply(const Grid& grid, const std::vector<NodePair>& edges, const std::vector<bool>& outer, Said&& said) const {
    for (const Layer& layer : made_) {
      const bool as_is =
          grid.crs.isPlane() || !layer.raw->crs || layer.raw->crs->isPlane() || sameCrs(grid.crs, *layer.raw->crs);
      std::optional<CrsMap> map;
      if (!as_is) map.emplace(toOgr(grid.crs), toOgr(*layer.raw->crs));
      const auto place = [&](std::uint32_t node) { return map ? map->forward(grid.nodes[node]) : grid.nodes[node]; };
      const bool geographic = layer.raw->crs ? layer.raw->crs->geographic : grid.crs.geographic;
      const LinePieces pieces(layer.rules);
      for (std::size_t e = 0; e < edges.size(); ++e) {
        const Point a = place(edges[e][0]), b = place(edges[e][1]);
        if (!std::isfinite(a.x + a.y + b.x + b.y)) continue;
        std::optional<std::size_t> found;
        for (const double turn : turnsToTry(geographic)) {
          const PlacedEdge edge{edges[e][0], edges[e][1], {a.x + turn, a.y}, {b.x + turn, b.y}};
          const double shrink = geographic ? std::max(1e-6, std::cos(edge.middle().y * std::numbers::pi / 180.0)) : 1.0;
          auto rule = pieces.along(edge, shrink);
          for (std::size_t r = layer.rules.size(); r-- > 0 && (!rule || r > *rule);) {
            const Rule& candidate = layer.rules[r];
            // Islands stay closed where a polygon that opens the boundary happens to hold them; a line along them is
            // meant.
            const bool opens = candidate.kind.role == BoundaryRole::Open || candidate.kind.role == BoundaryRole::River;
            if (opens && !outer[e]) continue;
            if (candidate.polygon != nullptr && candidate.box.contains(Box::of(edge.middle(), edge.middle())) &&
                contains(*candidate.polygon, edge.middle()))
              rule = r;
          }
          if (rule && (!found || *rule > *found)) found = rule;
        }
        if (found) said(e, layer.rules[*found].kind);
      }
    }
  }

 private:
  struct Layer {
    const RawLayer* raw = nullptr;
    std::vector<Rule> rules;

    void add(Rule rule, const std::vector<Point>& points) {
      for (const Point& p : points) rule.box.add(p);
      rules.push_back(rule);
    }
  };

  void addRing(Layer& layer, const BoundaryKind& kind, const Ring& ring) {
    std::vector<Point>& closed = *closed_rings_.emplace_back(std::make_unique<std::vector<Point>>(ring));
    closed.push_back(ring.front());
    layer.add({kind, nullptr, &closed, {}}, closed);
  }

  std::vector<RawLayer> layers_;
  std::vector<std::unique_ptr<std::vector<Point>>> closed_rings_;
  std::vector<Layer> made_;
};

// The boundary's edges, loop after loop, with what each is.
struct BoundaryEdges {
  std::vector<std::vector<std::uint32_t>> loops;
  std::vector<NodePair> edges;
  std::vector<BoundaryKind> kinds;
  std::vector<bool> outer;  // of each edge: its loop goes round the mesh
};

BoundaryEdges boundaryWithKinds(const Grid& grid) {
  BoundaryEdges boundary;
  boundary.loops = boundaryLoops(grid);
  const EdgeKinds before(grid);
  for (const auto& loop : boundary.loops) {
    const bool outer = roleOfLoop(grid.nodes, loop, grid.crs) == BoundaryRole::Land;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const NodePair edge{loop[i], loop[(i + 1) % loop.size()]};
      const BoundaryKind* const kind = before.find(edge[0], edge[1]);
      boundary.edges.push_back(edge);
      boundary.kinds.push_back(kind != nullptr ? BoundaryKind{kind->role, kind->ibtype} : BoundaryKind{});
      // An island and a shore are told apart by their loops alone.
      if (boundary.kinds.back().role == BoundaryRole::Island) boundary.kinds.back().role = BoundaryRole::Land;
      boundary.outer.push_back(outer);
    }
  }
  return boundary;
}

std::vector<Boundary> boundariesOf(const Grid& grid, const BoundaryEdges& boundary) {
  std::vector<std::pair<NodePair, std::size_t>> index;
  for (std::size_t e = 0; e < boundary.edges.size(); ++e) index.emplace_back(boundary.edges[e], e);
  std::ranges::sort(index);
  return cutLoops(grid, boundary.loops, [&](std::uint32_t from, std::uint32_t to) {
    const auto at =
        std::ranges::lower_bound(index, NodePair{from, to}, {}, [](const auto& entry) { return entry.first; });
    return boundary.kinds[at->second];
  });
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
    // An island and a shore are told apart by their loops alone.
    const BoundaryRole role = type->role == BoundaryRole::River ? BoundaryRole::River : BoundaryRole::Land;
    return {role, isRolesOwn(number) ? -1 : number};
  }
  throw InputError(what + ": \"" + text +
                   "\" is not a type of boundary; give land, open or river, or a number of ADCIRC's (" +
                   givableIbtypes() + "; -1 for open)");
}

namespace {

// Edges of a loop that follow one another and are of one kind.
struct Run {
  std::size_t first = 0;  // edge of the loop
  std::size_t count = 0;
  BoundaryKind kind;
  double length = 0.0;
};

std::vector<Run> runsOf(const std::vector<BoundaryKind>& kinds, const std::vector<double>& lengths, std::size_t begin,
                        std::size_t n) {
  std::vector<Run> runs;
  std::size_t start = 0;
  while (start < n && kinds[begin + start] == kinds[begin + (start + n - 1) % n]) ++start;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (start + k) % n;
    if (runs.empty() || kinds[begin + i] != runs.back().kind) runs.push_back({i, 0, kinds[begin + i]});
    ++runs.back().count;
    runs.back().length += lengths[begin + i];
  }
  return runs;
}

// Gives runs shorter than `least`, the shortest first, to the longer of their neighbours; each round leaves a run less.
std::size_t mergeShortRuns(std::vector<Run>& runs, double least) {
  std::size_t merged = 0;
  while (runs.size() > 1) {
    const auto shortest = std::ranges::min_element(runs, {}, &Run::length);
    if (!(shortest->length < least)) break;
    const std::size_t r = static_cast<std::size_t>(shortest - runs.begin()), n = runs.size();
    const std::size_t before = (r + n - 1) % n, after = (r + 1) % n;
    runs[r].kind = runs[runs[before].length >= runs[after].length ? before : after].kind;
    ++merged;
    // Neighbours of one kind now are one run.
    std::vector<Run> joined;
    for (const Run& run : runs) {
      if (!joined.empty() && joined.back().kind == run.kind) {
        joined.back().count += run.count;
        joined.back().length += run.length;
      } else {
        joined.push_back(run);
      }
    }
    if (joined.size() > 1 && joined.front().kind == joined.back().kind) {
      joined.front().first = joined.back().first;
      joined.front().count += joined.back().count;
      joined.front().length += joined.back().length;
      joined.pop_back();
    }
    runs = std::move(joined);
  }
  return merged;
}

std::size_t mergeShort(const Grid& grid, double least_m, BoundaryEdges& boundary) {
  if (!(least_m > 0.0)) return 0;
  std::vector<std::vector<Point>> edges;
  for (const auto& [from, to] : boundary.edges) edges.push_back({grid.nodes[from], grid.nodes[to]});
  const std::vector<double> lengths = chainLengths(edges, grid.crs);
  std::size_t merged = 0, begin = 0;
  for (const auto& loop : boundary.loops) {
    const std::size_t n = loop.size();
    std::vector<Run> runs = runsOf(boundary.kinds, lengths, begin, n);
    merged += mergeShortRuns(runs, least_m);
    for (const Run& run : runs)
      for (std::size_t k = 0; k < run.count; ++k) boundary.kinds[begin + (run.first + k) % n] = run.kind;
    begin += n;
  }
  return merged;
}

}  // namespace

std::vector<std::string> boundaryTexts(const Crs& crs, const std::vector<Point>& places,
                                       const std::vector<NodePair>& edges, const std::vector<std::string>& inputs,
                                       const std::string& column) {
  Grid grid;
  grid.crs = crs;
  grid.nodes = places;
  std::vector<std::string> texts(edges.size());
  for (const std::string& input : inputs) {
    RuleSet(input, column, false)
        .apply(grid, edges, std::vector<bool>(edges.size(), true), [&](std::size_t e, const BoundaryKind& kind) {
          texts[e] = kind.ibtype >= 0 ? std::to_string(kind.ibtype) : std::string(toString(kind.role));
        });
  }
  return texts;
}

BoundaryReport assignBoundaries(Grid& grid, const BoundaryOptions& options) {
  BoundaryReport report;
  if (!options.any()) return report;
  const auto isWeir = [](const Boundary& boundary) { return !boundary.weir.empty(); };
  if (std::ranges::any_of(grid.boundaries, isWeir))
    throw InputError("the mesh has weirs, whose boundaries cannot be set anew; leave the options of boundaries out");
  BoundaryEdges boundary = boundaryWithKinds(grid);
  std::vector<bool> said(boundary.edges.size(), false);
  const auto applyFiles = [&](const std::vector<std::string>& files, bool all_have_it) {
    for (const std::string& file : files) {
      bool any = false;
      RuleSet(file, options.column, all_have_it)
          .apply(grid, boundary.edges, boundary.outer, [&](std::size_t e, const BoundaryKind& kind) {
            boundary.kinds[e] = kind;
            said[e] = any = true;
          });
      if (all_have_it && !any)
        report.warnings.push_back(file +
                                  ": says nothing of the mesh's boundary: no edge of it has its middle in one of the "
                                  "polygons, or runs along one of the lines within a fifth of its length (polygons "
                                  "open no islands)");
    }
  };
  applyFiles(options.inputs, false);
  applyFiles(options.files, true);
  report.edges_by_file = static_cast<std::size_t>(std::ranges::count(said, true));
  if (options.open_deeper_m < 1e300) {
    if (grid.z.empty()) throw InputError("to open boundaries by their depth takes depths; give --bathymetry");
    for (std::size_t e = 0; e < boundary.edges.size(); ++e) {
      const auto isDeep = [&](std::uint32_t node) { return 0.0 - grid.z[node] > options.open_deeper_m; };
      if (said[e] || !boundary.outer[e] || !isDeep(boundary.edges[e][0]) || !isDeep(boundary.edges[e][1])) continue;
      boundary.kinds[e] = {BoundaryRole::Open};
      ++report.edges_by_depth;
    }
  }
  report.merged = mergeShort(grid, options.least_length_m, boundary);
  grid.boundaries = boundariesOf(grid, boundary);
  return report;
}

}  // namespace coastmesh
