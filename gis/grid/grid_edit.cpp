#include "gis/grid/grid_edit.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "gis/grid/boundary_chains.hpp"

namespace coastmesh {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

template <typename Arrays, typename Use>
void forEachArray(Arrays arrays, const Use& use) {
  std::apply([&use](auto&... array) { (use(array), ...); }, arrays);
}

// The arrays of two grids side by side.
template <typename Arrays, typename Use>
void forEachArray(Arrays to, Arrays from, const Use& use) {
  const auto both = [&]<std::size_t... I>(std::index_sequence<I...>) {
    (use(std::get<I>(to), std::get<I>(from)), ...);
  };
  both(std::make_index_sequence<std::tuple_size_v<Arrays>>());
}

template <typename T, typename Allocator>
void copyLast(std::vector<T, Allocator>& values, std::size_t source) {
  if (!values.empty()) values.push_back(T(values[source]));
}

// Calls `use(from, to)` for each edge of a chain.
void forEachEdge(std::span<const std::uint32_t> nodes, bool closed, auto&& use) {
  for (std::size_t i = 1; i < nodes.size(); ++i) use(nodes[i - 1], nodes[i]);
  if (closed && nodes.size() > 1) use(nodes.back(), nodes.front());
}

// A remaining stretch of a chain: positions of its nodes.
struct Stretch {
  std::vector<std::size_t> at;
  bool closed = false;
};

// The stretches that remain of a chain of `n` nodes if only edges with `holds(edge)` are kept; edge i follows node i.
std::vector<Stretch> stretchesOf(std::size_t n, bool closed, auto&& holds) {
  const std::size_t edges = closed ? n : n - std::min<std::size_t>(n, 1);
  std::vector<bool> held;
  for (std::size_t i = 0; i < edges; ++i) held.push_back(holds(i));
  std::vector<Stretch> stretches;
  const auto lost = std::ranges::find(held, false);
  if (lost == held.end()) {
    Stretch& whole = stretches.emplace_back();
    for (std::size_t i = 0; i < n; ++i) whole.at.push_back(i);
    whole.closed = closed;
    return stretches;
  }
  // A loop is followed from the end of a gap.
  const std::size_t first = closed ? static_cast<std::size_t>(lost - held.begin()) + 1 : 0;
  bool follows = false;
  for (std::size_t k = 0; k < edges; ++k) {
    const std::size_t i = (first + k) % n;
    if (held[i] && !follows) stretches.push_back({{i}, false});
    if (held[i]) stretches.back().at.push_back((i + 1) % n);
    follows = held[i];
  }
  return stretches;
}

// The values of a stretch, from those of a chain with `each` values per node.
template <typename T>
std::vector<T> partOf(const std::vector<T>& values, std::size_t each, const Stretch& stretch) {
  std::vector<T> part;
  if (values.empty()) return part;
  for (const std::size_t i : stretch.at)
    for (std::size_t k = 0; k < each; ++k) part.push_back(values[i * each + k]);
  return part;
}

void cutBoundaries(Grid& grid, auto&& keeps) {
  std::vector<Boundary> cut;
  for (Boundary& boundary : grid.boundaries) {
    const auto isKept = [&](std::uint32_t node) { return keeps(node); };
    if (std::ranges::all_of(boundary.nodes, isKept) && std::ranges::all_of(boundary.back_nodes, isKept)) {
      cut.push_back(std::move(boundary));
      continue;
    }
    const std::size_t n = boundary.nodes.size();
    if (n < 2) continue;
    // The node across a weir may be the missing one.
    const auto stands = [&](std::size_t i) {
      return keeps(boundary.nodes[i]) && (boundary.back_nodes.empty() || keeps(boundary.back_nodes[i]));
    };
    std::ranges::move(piecesOf(boundary, [&](std::size_t i) { return stands(i) && stands((i + 1) % n); }),
                      std::back_inserter(cut));
  }
  grid.boundaries = std::move(cut);
}

void cutLines(Grid& grid, auto&& holds) {
  std::vector<GridLine> cut;
  for (GridLine& line : grid.lines)
    for (const Stretch& stretch : stretchesOf(line.nodes.size(), line.closed, [&](std::size_t i) {
           return holds(line.nodes[i], line.nodes[(i + 1) % line.nodes.size()]);
         }))
      cut.push_back({line.kind, line.name, stretch.closed, partOf(line.nodes, 1, stretch)});
  grid.lines = std::move(cut);
}

// The edges of all lines, sorted, with their number of triangles.
std::vector<std::pair<NodePair, int>> edgesOfLines(const Grid& grid) {
  std::vector<std::pair<NodePair, int>> edges;
  for (const GridLine& line : grid.lines)
    forEachEdge(line.nodes, line.closed,
                [&](std::uint32_t a, std::uint32_t b) { edges.emplace_back(edgeKey(a, b), 0); });
  std::ranges::sort(edges);
  const auto repeated = std::ranges::unique(edges);
  edges.erase(repeated.begin(), repeated.end());
  if (edges.empty()) return edges;
  std::vector<bool> on_line(grid.nodes.size(), false);
  for (const auto& [edge, count] : edges) on_line[edge[0]] = on_line[edge[1]] = true;
  for (const GridCorners& v : grid.triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint32_t a = v[i], b = v[(i + 1) % 3];
      if (!on_line[a] || !on_line[b]) continue;
      const auto at = std::ranges::lower_bound(edges, edgeKey(a, b), {}, &std::pair<NodePair, int>::first);
      if (at != edges.end() && at->first == edgeKey(a, b)) ++at->second;
    }
  }
  return edges;
}

void renumberNodes(Grid& grid, const auto& index_of) {
  const auto renumber = [&](auto& nodes) {
    for (std::uint32_t& node : nodes) node = index_of(node);
  };
  for (GridCorners& corners : grid.triangles) renumber(corners);
  for (Boundary& boundary : grid.boundaries) {
    renumber(boundary.nodes);
    renumber(boundary.back_nodes);
  }
  for (GridLine& line : grid.lines) renumber(line.nodes);
}

// One more than the largest number of a quadrilateral.
std::uint32_t firstFreeQuad(const Grid& grid) {
  std::uint32_t free = 0;
  for (const std::uint32_t quad : grid.quad_of)
    if (quad != kNone) free = std::max(free, quad + 1);
  return free;
}

// The new index of each item, kNone for removed ones.
std::vector<std::uint32_t> indexWithout(const std::vector<bool>& gone) {
  std::vector<std::uint32_t> index_of(gone.size(), kNone);
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < gone.size(); ++i)
    if (!gone[i]) index_of[i] = count++;
  return index_of;
}

// For arrays: leaves out the items without an index.
auto keepIndexed(const std::vector<std::uint32_t>& index_of) {
  return [&index_of](auto& values) {
    if (values.empty()) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < index_of.size(); ++i)
      if (index_of[i] != kNone) values[kept++] = std::move(values[i]);
    values.resize(kept);
  };
}

// Gives `grid` the fields of `other` that it lacks, unknown everywhere.
void addFieldsOf(const Grid& other, Grid& grid) {
  for (const NodeField& field : other.node_fields) {
    const auto isIt = [&](const NodeField& own) { return own.name == field.name && own.component == field.component; };
    if (std::ranges::any_of(grid.node_fields, isIt)) continue;
    grid.node_fields.push_back({field.name, field.unit, field.component, field.usual, {}});
    grid.node_fields.back().values.assign(grid.nodes.size(), kUnknown);
  }
}

// Appends those of `part` to those of `whole`. REQUIRES: called before nodes are appended.
void appendFields(Grid& whole, Grid& part) {
  addFieldsOf(part, whole);
  addFieldsOf(whole, part);
  for (NodeField& field : whole.node_fields) {
    const auto isIt = [&](const NodeField& other) {
      return other.name == field.name && other.component == field.component;
    };
    const std::vector<double>& added = std::ranges::find_if(part.node_fields, isIt)->values;
    field.values.insert(field.values.end(), added.begin(), added.end());
  }
}

[[noreturn]] void fail(const std::string& what) { throw std::logic_error("the mesh is not consistent: " + what); }

void requireIndices(std::span<const std::uint32_t> indices, std::size_t count, const char* what) {
  if (std::ranges::any_of(indices, [count](std::uint32_t i) { return i >= count; }))
    fail(std::string(what) + " out of range");
}

}  // namespace

Point placeBetween(const Crs& crs, const Point& a, const Point& b, double share) {
  double dx = b.x - a.x;
  const bool across = crs.geographic && std::abs(dx) > 180.0;
  if (across) dx -= std::copysign(360.0, dx);
  Point place{a.x + share * dx, a.y + share * (b.y - a.y)};
  if (!across) return place;
  const double west = std::min(a.x, b.x) < 0.0 ? -180.0 : 0.0;
  if (place.x < west) place.x += 360.0;
  if (place.x > west + 360.0) place.x -= 360.0;
  return place;
}

Point meanPlace(const Crs& crs, std::span<const Point> places) {
  Point mean = places.front();
  for (std::size_t i = 1; i < places.size(); ++i)
    mean = placeBetween(crs, mean, places[i], 1.0 / static_cast<double>(i + 1));
  return mean;
}

std::uint32_t addNode(Grid& grid, const Point& place) {
  const auto added = static_cast<std::uint32_t>(grid.nodes.size());
  forEachNodeArray(grid, [&]<typename T, typename Allocator>(std::vector<T, Allocator>& values) {
    if constexpr (std::is_same_v<T, Point>) {
      values.push_back(place);
    } else if constexpr (std::is_integral_v<T>) {
      if (!values.empty()) values.push_back(0);  // a part must own it
    } else {
      static_assert(std::is_floating_point_v<T>, "say what is unknown");
      if (!values.empty()) values.push_back(kUnknown);
    }
  });
  return added;
}

std::uint32_t copyNode(Grid& grid, std::uint32_t source, const Point& place) {
  const auto added = static_cast<std::uint32_t>(grid.nodes.size());
  forEachNodeArray(grid, [source](auto& values) { copyLast(values, source); });
  grid.nodes.back() = place;
  return added;
}

std::uint32_t addNodeBetween(Grid& grid, std::uint32_t a, std::uint32_t b, double share) {
  const auto added = static_cast<std::uint32_t>(grid.nodes.size());
  forEachNodeArray(grid, [&]<typename T, typename Allocator>(std::vector<T, Allocator>& values) {
    if constexpr (std::is_same_v<T, Point>) {
      values.push_back(placeBetween(grid.crs, values[a], values[b], share));
    } else if constexpr (std::is_integral_v<T>) {
      if (!values.empty()) values.push_back(values[a]);
    } else {
      static_assert(std::is_floating_point_v<T>, "say what lies between two");
      if (!values.empty()) values.push_back(values[a] + share * (values[b] - values[a]));
    }
  });
  for (GridLine& line : grid.lines) {
    std::vector<std::uint32_t>& nodes = line.nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const bool last = i + 1 == nodes.size();
      if (last && !line.closed) break;
      if (edgeKey(nodes[i], nodes[last ? 0 : i + 1]) != edgeKey(a, b)) continue;
      nodes.insert(nodes.begin() + static_cast<std::ptrdiff_t>(i) + 1, added);
      ++i;
    }
  }
  return added;
}

void moveNode(Grid& grid, std::uint32_t node, std::uint32_t a, std::uint32_t b, double share) {
  forEachNodeArray(grid, [&]<typename T, typename Allocator>(std::vector<T, Allocator>& values) {
    if constexpr (std::is_same_v<T, Point>) {
      values[node] = placeBetween(grid.crs, values[node], placeBetween(grid.crs, values[a], values[b], 0.5), share);
    } else if constexpr (!std::is_integral_v<T>) {
      static_assert(std::is_floating_point_v<T>, "say what lies between two");
      if (values.empty()) return;
      const T step = static_cast<T>(share) * ((values[a] + values[b]) / 2 - values[node]);
      if (!std::isnan(step)) values[node] += step;
    }
  });
}

std::uint32_t detachTriangles(Grid& grid, std::uint32_t node, std::span<const std::uint32_t> triangles,
                              const Point& place) {
  const std::uint32_t twin = copyNode(grid, node, place);
  std::vector<std::uint32_t> neighbours;
  for (const std::uint32_t t : triangles) {
    neighbours.insert(neighbours.end(), grid.triangles[t].begin(), grid.triangles[t].end());
    std::ranges::replace(grid.triangles[t], node, twin);
  }
  std::vector<GridLine> lines;
  for (GridLine& line : grid.lines) {
    if (std::ranges::count(line.nodes, node) == 0) {
      lines.push_back(std::move(line));
      continue;
    }
    std::vector<NodePair> edges;
    forEachEdge(line.nodes, line.closed, [&](std::uint32_t a, std::uint32_t b) {
      const bool goes = (a == node || b == node) && std::ranges::count(neighbours, a == node ? b : a) > 0;
      edges.push_back(goes ? NodePair{a == node ? twin : a, b == node ? twin : b} : NodePair{a, b});
    });
    const auto parted = [&](std::size_t i) { return edges[(i + edges.size() - 1) % edges.size()][1] != edges[i][0]; };
    std::size_t first = 0;
    while (line.closed && first < edges.size() && !parted(first)) ++first;
    const bool closed = line.closed && first == edges.size();
    if (closed) first = 0;
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const NodePair& edge = edges[(first + k) % edges.size()];
      if (k == 0 || parted((first + k) % edges.size())) lines.push_back({line.kind, line.name, false, {edge[0]}});
      lines.back().nodes.push_back(edge[1]);
    }
    if (closed) {
      lines.back().closed = true;
      lines.back().nodes.pop_back();
    }
  }
  grid.lines = std::move(lines);
  return twin;
}

std::uint32_t copyTriangle(Grid& grid, std::uint32_t source, const GridCorners& corners) {
  const auto added = static_cast<std::uint32_t>(grid.triangles.size());
  forEachArray(triangleArrays(grid), [source](auto& values) { copyLast(values, source); });
  grid.triangles.back() = corners;
  if (!grid.quad_of.empty()) grid.quad_of.back() = kNone;
  return added;
}

std::vector<std::uint32_t> removeTriangles(Grid& grid, const std::vector<bool>& gone) {
  assert(gone.size() == grid.triangles.size());
  const std::vector<std::uint32_t> index_of = indexWithout(gone);
  forEachArray(triangleArrays(grid), keepIndexed(index_of));
  cutLinesOffEdges(grid);
  return index_of;
}

std::vector<std::uint32_t> removeNodes(Grid& grid, const std::vector<bool>& gone) {
  assert(gone.size() == grid.nodes.size());
  const std::vector<std::uint32_t> index_of = indexWithout(gone);
  const auto keeps = [&](std::uint32_t node) { return !gone[node]; };
  cutBoundaries(grid, keeps);
  cutLines(grid, [&](std::uint32_t a, std::uint32_t b) { return keeps(a) && keeps(b); });
  forEachNodeArray(grid, keepIndexed(index_of));
  renumberNodes(grid, [&](std::uint32_t node) { return index_of[node]; });
  return index_of;
}

std::vector<std::uint32_t> removeUnusedNodes(Grid& grid) {
  std::vector<bool> unused(grid.nodes.size(), true);
  for (const GridCorners& corners : grid.triangles)
    for (const std::uint32_t node : corners) unused[node] = false;
  return removeNodes(grid, unused);
}

void replaceNodes(Grid& grid, const std::vector<std::uint32_t>& instead) {
  renumberNodes(grid, [&](std::uint32_t node) { return instead[node]; });
}

void orderNodes(Grid& grid, const std::vector<std::uint32_t>& order) {
  forEachNodeArray(grid, [&](auto& values) { reorder(values, order); });
  std::vector<std::uint32_t> index_of(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) index_of[order[i]] = i;
  renumberNodes(grid, [&](std::uint32_t node) { return index_of[node]; });
}

void orderTriangles(Grid& grid, const std::vector<std::uint32_t>& order) {
  forEachArray(triangleArrays(grid), [&](auto& values) { reorder(values, order); });
}

std::vector<Boundary> piecesOf(const Boundary& boundary, const std::function<bool(std::size_t edge)>& holds) {
  std::vector<Boundary> pieces;
  const std::size_t n = boundary.nodes.size();
  for (const Stretch& stretch : stretchesOf(n, boundary.closed, holds)) {
    const bool whole = stretch.closed == boundary.closed && stretch.at.size() == n;
    pieces.push_back({boundary.role, stretch.closed, partOf(boundary.nodes, 1, stretch), boundary.ibtype,
                      partOf(boundary.back_nodes, 1, stretch), whole && boundary.repeats_first,
                      partOf(boundary.weir, boundary.weir.size() / std::max<std::size_t>(1, n), stretch),
                      boundary.name});
  }
  return pieces;
}

void sortFeatures(Grid& grid) {
  std::vector<std::uint32_t> rank(grid.features.size(), kNone), order;
  for (std::uint32_t& feature : grid.feature_of) {
    if (rank[feature] == kNone) {
      rank[feature] = static_cast<std::uint32_t>(order.size());
      order.push_back(feature);
    }
    feature = rank[feature];
  }
  reorder(grid.features, order);
}

void appendGrid(Grid& whole, Grid&& part, std::optional<std::uint32_t> first_piece) {
  if (whole.nodes.empty() && whole.triangles.empty()) {
    whole = std::move(part);
    return;
  }
  if (part.triangles.empty() && part.nodes.empty()) return;
  if (whole.feature_of.empty() != part.feature_of.empty() && !whole.triangles.empty() && !part.triangles.empty())
    throw std::logic_error("a grid with features was put together with one without");
  if (whole.piece_of.empty() != part.piece_of.empty()) {
    Grid& silent = whole.piece_of.empty() ? whole : part;
    silent.piece_of.assign(silent.triangles.size(), 0);
  }
  if (whole.quad_of.empty() != part.quad_of.empty()) {
    Grid& plain = whole.quad_of.empty() ? whole : part;
    plain.quad_of.assign(plain.triangles.size(), kNone);
  }
  // A partition is valid for the whole mesh only.
  for (Grid* grid : {&whole, &part}) {
    grid->part_of.clear();
    grid->node_part_of.clear();
  }
  const auto node_shift = static_cast<std::uint32_t>(whole.nodes.size());
  const auto feature_shift = static_cast<std::uint32_t>(whole.features.size());
  const std::uint32_t piece_shift =
      whole.piece_of.empty() ? 0 : (first_piece ? *first_piece : std::ranges::max(whole.piece_of) + 1);
  renumberNodes(part, [node_shift](std::uint32_t node) { return node_shift + node; });
  for (std::uint32_t& feature : part.feature_of) feature += feature_shift;
  for (std::uint32_t& piece : part.piece_of) piece += piece_shift;
  const std::uint32_t quad_shift = firstFreeQuad(whole);
  for (std::uint32_t& quad : part.quad_of)
    if (quad != kNone) quad += quad_shift;

  const auto append = [](auto& to, auto& from) { std::move(from.begin(), from.end(), std::back_inserter(to)); };
  const auto appendUnlessSilent = [&]<typename T, typename Allocator>(std::vector<T, Allocator>& to,
                                                                      std::vector<T, Allocator>& from,
                                                                      std::size_t to_count, std::size_t from_count) {
    if constexpr (std::is_floating_point_v<T>) {
      if (to.empty() && !from.empty()) to.assign(to_count, kUnknown);
      if (from.empty() && !to.empty()) from.assign(from_count, kUnknown);
    }
    append(to, from);
  };
  const std::size_t nodes = whole.nodes.size(), part_nodes = part.nodes.size();
  const std::size_t triangles = whole.triangles.size(), part_triangles = part.triangles.size();
  appendFields(whole, part);
  forEachArray(nodeArrays(whole), nodeArrays(part),
               [&](auto& to, auto& from) { appendUnlessSilent(to, from, nodes, part_nodes); });
  forEachArray(triangleArrays(whole), triangleArrays(part),
               [&](auto& to, auto& from) { appendUnlessSilent(to, from, triangles, part_triangles); });
  append(whole.features, part.features);
  append(whole.boundaries, part.boundaries);
  append(whole.lines, part.lines);
  append(whole.notes, part.notes);
}

void cutLinesOffEdges(Grid& grid) {
  if (grid.lines.empty()) return;
  const auto edges = edgesOfLines(grid);
  cutLines(grid, [&](std::uint32_t a, std::uint32_t b) {
    return std::ranges::lower_bound(edges, edgeKey(a, b), {}, &std::pair<NodePair, int>::first)->second == 2;
  });
}

void requireConsistent(const Grid& grid, const ItemLoop& loop) {
  const std::size_t nodes = grid.nodes.size(), triangles = grid.triangles.size();
  const auto requireLength = [](std::size_t length, std::size_t wanted, const char* of) {
    if (length != 0 && length != wanted)
      fail("an array of " + std::string(of) + " has " + std::to_string(length) + " entries, not " +
           std::to_string(wanted));
  };
  forEachNodeArray(grid, [&](const auto& values) { requireLength(values.size(), nodes, "nodes"); });
  for (const NodeField& field : grid.node_fields)
    if (field.values.size() != nodes)
      fail("'" + field.name + "' has " + std::to_string(field.values.size()) + " values");
  forEachArray(triangleArrays(grid), [&](const auto& values) { requireLength(values.size(), triangles, "triangles"); });
  forEachByStretches(loop, triangles,
                     [&](std::size_t t) { requireIndices(grid.triangles[t], nodes, "a corner of a triangle is"); });
  forStretches(loop, grid.feature_of.size(), [&](std::size_t first, std::size_t last) {
    requireIndices(std::span(grid.feature_of).subspan(first, last - first), grid.features.size(),
                   "the feature of a triangle is");
  });
  for (const Boundary& boundary : grid.boundaries) {
    requireIndices(boundary.nodes, nodes, "a node of a boundary is");
    requireIndices(boundary.back_nodes, nodes, "a back node of a weir is");
    requireLength(boundary.back_nodes.size(), boundary.nodes.size(), "back nodes");
    if (boundary.weir.size() % std::max<std::size_t>(1, boundary.nodes.size()) != 0)
      fail("a weir does not have as many values at each node");
  }
  for (const GridLine& line : grid.lines) {
    requireIndices(line.nodes, nodes, "a node of a line is");
    if (line.nodes.size() < (line.closed ? 3u : 2u)) fail("line '" + line.name + "' has too few nodes");
  }
  for (const auto& [edge, count] : edgesOfLines(grid)) {
    if (count != 2)
      fail("nodes " + std::to_string(edge[0] + 1) + " and " + std::to_string(edge[1] + 1) +
           " follow one another in a line, but are not an edge inside the mesh");
  }
}

}  // namespace coastmesh
