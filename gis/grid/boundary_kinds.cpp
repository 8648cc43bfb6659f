#include "gis/grid/boundary_kinds.hpp"

#include <algorithm>
#include <map>
#include <ranges>
#include <set>

#include "gis/grid/linked_grid.hpp"
#include "gis/grid/loop_role.hpp"
#include "gis/lower_case.hpp"

namespace coastmesh {
namespace {

bool isShore(BoundaryRole role) { return role == BoundaryRole::Land || role == BoundaryRole::Island; }

// By boundary: 0, or for open boundaries and rivers the least number that no adjacent one of the same kind has.
std::vector<std::uint32_t> separatorsOf(const std::vector<Boundary>& boundaries) {
  std::vector<std::uint32_t> separators(boundaries.size(), 0);
  std::multimap<std::uint32_t, std::size_t> at_end;  // node → boundaries that have a separator
  for (std::size_t b = 0; b < boundaries.size(); ++b) {
    const Boundary& boundary = boundaries[b];
    if (boundary.closed || boundary.nodes.empty()) continue;
    if (boundary.role != BoundaryRole::Open && boundary.role != BoundaryRole::River) continue;
    std::set<std::uint32_t> taken;
    for (const std::uint32_t node : {boundary.nodes.front(), boundary.nodes.back()}) {
      const auto [first, last] = at_end.equal_range(node);
      for (const auto& [end, other] : std::ranges::subrange(first, last))
        if (boundaries[other].role == boundary.role && boundaries[other].ibtype == boundary.ibtype)
          taken.insert(separators[other]);
    }
    while (taken.contains(separators[b])) ++separators[b];
    at_end.emplace(boundary.nodes.front(), b);
    at_end.emplace(boundary.nodes.back(), b);
  }
  return separators;
}

// A weir around an area repeats its first node at its end.
void closeRing(Boundary& shore, const Grid& grid) {
  if (shore.closed || shore.nodes.size() < 4 || shore.nodes.front() != shore.nodes.back()) return;
  shore.nodes.pop_back();
  shore.closed = true;
  shore.repeats_first = false;
  shore.role = roleOfLoop(grid.nodes, shore.nodes, grid.crs);
}

}  // namespace

std::optional<BoundaryRole> roleOfWord(const std::string& given) {
  const std::string word = lowerCase(given);
  const auto isOneOf = [&](std::initializer_list<const char*> names) { return std::ranges::count(names, word) > 0; };
  if (isOneOf({"open", "ocean", "sea", "tidal", "tide", "level"})) return BoundaryRole::Open;
  if (isOneOf({"river", "inflow", "discharge", "flow", "flux"})) return BoundaryRole::River;
  if (isOneOf({"land", "shore", "coast", "wall", "closed", "solid", "mainland", "island"})) return BoundaryRole::Land;
  return std::nullopt;
}

std::vector<std::vector<std::uint32_t>> boundaryLoops(const Grid& grid, const ItemLoop& loop) {
  return boundaryLoops(linkGrid(grid, loop).mesh, loop);
}

std::vector<Boundary> cutLoops(const Grid& grid, const std::vector<std::vector<std::uint32_t>>& loops,
                               const BoundaryKindOf& kind_of) {
  std::vector<Boundary> boundaries;
  std::vector<BoundaryKind> kinds;
  for (const std::vector<std::uint32_t>& loop : loops) {
    const std::size_t n = loop.size();
    kinds.clear();
    for (std::size_t i = 0; i < n; ++i) kinds.push_back(kind_of(loop[i], loop[(i + 1) % n]));
    const auto changesAt = [&](std::size_t i) { return kinds[i] != kinds[(i + n - 1) % n]; };
    std::size_t first = 0;
    while (first < n && !changesAt(first)) ++first;
    if (first == n) {
      const BoundaryKind& kind = kinds.front();
      const BoundaryRole role = isShore(kind.role) ? roleOfLoop(grid.nodes, loop, grid.crs) : kind.role;
      boundaries.push_back({role, true, loop, kind.ibtype});
      boundaries.back().name = kind.name;
      continue;
    }
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = (first + k) % n;
      if (changesAt(i)) {
        const BoundaryRole role = isShore(kinds[i].role) ? BoundaryRole::Land : kinds[i].role;
        boundaries.push_back({role, false, {loop[i]}, kinds[i].ibtype});
        boundaries.back().name = kinds[i].name;
      }
      boundaries.back().nodes.push_back(loop[(i + 1) % n]);
    }
  }
  return boundaries;
}

EdgeKinds::EdgeKinds(const Grid& grid) {
  for (std::uint32_t b = 0; b < grid.boundaries.size(); ++b) {
    kinds_.push_back({grid.boundaries[b].role, grid.boundaries[b].ibtype, b, grid.boundaries[b].name});
    for (const auto& [from, to] : edgesOf(grid.boundaries[b])) edges_.emplace_back(edgeKey(from, to), b);
  }
  std::ranges::sort(edges_);
  separators_ = separatorsOf(grid.boundaries);
}

BoundaryKind EdgeKinds::forCutting(std::uint32_t a, std::uint32_t b) const {
  const BoundaryKind* const kind = find(a, b);
  if (kind == nullptr) return {};
  const BoundaryRole role = kind->role == BoundaryRole::Island ? BoundaryRole::Land : kind->role;
  return {role, kind->ibtype, separators_[kind->segment], kind->name};
}

const BoundaryKind* EdgeKinds::find(std::uint32_t a, std::uint32_t b) const& {
  const NodePair key = edgeKey(a, b);
  const auto at = std::ranges::lower_bound(edges_, key, {}, [](const auto& entry) { return entry.first; });
  return at != edges_.end() && at->first == key ? &kinds_[at->second] : nullptr;
}

std::vector<Boundary> weirsAsShores(const Grid& grid) {
  std::vector<std::vector<NodePair>> across;  // by boundary
  for (const Boundary& boundary : grid.boundaries)
    across.push_back(edgesOf({boundary.role, boundary.closed, boundary.back_nodes}));
  keepBoundaryEdges(grid.triangles, across);
  const EdgeKinds kinds(grid);
  std::vector<Boundary> shores;
  for (std::size_t b = 0; b < grid.boundaries.size(); ++b) {
    const Boundary& boundary = grid.boundaries[b];
    shores.push_back(boundary);
    if (boundary.weir.empty() && boundary.back_nodes.empty()) continue;
    shores.back().back_nodes.clear();
    shores.back().weir.clear();
    closeRing(shores.back(), grid);
    std::erase_if(across[b], [&](const NodePair& edge) { return kinds.find(edge[0], edge[1]) != nullptr; });
    for (Boundary& shore : chainEdges(across[b])) {
      shore.role = shore.closed ? roleOfLoop(grid.nodes, shore.nodes, grid.crs) : BoundaryRole::Land;
      shore.ibtype = boundary.ibtype;
      shores.push_back(std::move(shore));
    }
  }
  return shores;
}

std::vector<Boundary> boundariesOfOpenNodes(const Grid& grid, const std::vector<bool>& is_open) {
  return cutLoops(grid, boundaryLoops(grid), [&](std::uint32_t from, std::uint32_t to) {
    return BoundaryKind{is_open[from] && is_open[to] ? BoundaryRole::Open : BoundaryRole::Land};
  });
}

}  // namespace coastmesh
