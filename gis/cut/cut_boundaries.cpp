#include "gis/cut/cut_boundaries.hpp"

#include <algorithm>
#include <iterator>
#include <ranges>
#include <utility>

#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/ibtype.hpp"
#include "gis/grid/loop_role.hpp"

namespace coastmesh {

namespace {

// Where the grid's mesh ends, and whether the triangle there is taken.
class OuterEdges {
 public:
  enum class State { Stray, Lost, Kept };  // Stray: the mesh does not end there

  OuterEdges(const TriMesh& mesh, const std::vector<std::uint8_t>& taken, const ItemLoop& loop)
      : edges_(joined(overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
          std::vector<Edge> found;
          for (auto t = static_cast<TriId>(first); t < last; ++t) {
            for (unsigned i = 0; i < 3; ++i) {
              const EdgeRef e = edgeRef(t, i);
              if (mesh.twin(e) == kNone) found.emplace_back(edgeKey(mesh.origin(e), mesh.target(e)), taken[t] != 0);
            }
          }
          return found;
        }))) {
    sortOn(loop, edges_);
  }

  State at(std::uint32_t a, std::uint32_t b) const {
    const auto [first, last] = std::ranges::equal_range(edges_, edgeKey(a, b), {}, &Edge::first);
    if (first == last) return State::Stray;
    return std::prev(last)->second ? State::Kept : State::Lost;
  }

 private:
  using Edge = std::pair<NodePair, bool>;
  std::vector<Edge> edges_;  // sorted, those with a taken triangle after others
};

std::size_t edgesIn(const Boundary& boundary) {
  const std::size_t n = boundary.nodes.size();
  return boundary.closed ? n : n - std::min<std::size_t>(n, 1);
}

class BoundaryDivider {
 public:
  BoundaryDivider(const Grid& grid, const OuterEdges& outer, CutBoundaries& found)
      : grid_(grid), outer_(outer), found_(found) {}

  void divide(const Boundary& boundary) {
    using State = OuterEdges::State;
    const std::size_t n = boundary.nodes.size(), edges = edgesIn(boundary);
    std::vector<State> front(edges), back(boundary.back_nodes.empty() ? 0 : edges);
    for (std::size_t i = 0; i < edges; ++i) front[i] = outer_.at(boundary.nodes[i], boundary.nodes[(i + 1) % n]);
    for (std::size_t i = 0; i < back.size(); ++i)
      back[i] = outer_.at(boundary.back_nodes[i], boundary.back_nodes[(i + 1) % n]);
    const auto isKept = [](const std::vector<State>& states, std::size_t i) { return states[i] == State::Kept; };
    found_.stray_edges += static_cast<std::size_t>(std::ranges::count(front, State::Stray));
    std::vector<Boundary> pieces =
        piecesOf(boundary, [&](std::size_t i) { return isKept(front, i) && (back.empty() || isKept(back, i)); });
    if (edges > 0) std::ranges::for_each(pieces, [&](Boundary& piece) { asPartOf(boundary, piece); });
    std::ranges::move(pieces, std::back_inserter(found_.kept));
    if (back.empty()) return;
    addWalls({BoundaryRole::Land, boundary.closed, boundary.nodes},
             [&](std::size_t i) { return isKept(front, i) && !isKept(back, i); });
    // The shore across runs the other way; its edges may be in another boundary.
    const EdgeKinds& kinds = kindsOfEdges();
    std::vector<bool> alone(edges);
    for (std::size_t i = 0; i < edges; ++i)
      alone[i] = !isKept(front, i) && isKept(back, i) &&
                 kinds.find(boundary.back_nodes[i], boundary.back_nodes[(i + 1) % n]) == nullptr;
    const std::vector<std::uint32_t> across(boundary.back_nodes.rbegin(), boundary.back_nodes.rend());
    addWalls({BoundaryRole::Land, boundary.closed, across},
             [&](std::size_t i) { return alone[boundary.closed ? (2 * n - 2 - i) % n : edges - 1 - i]; });
  }

 private:
  static void asPartOf(const Boundary& boundary, Boundary& piece) {
    if (piece.nodes.size() < boundary.nodes.size() || piece.closed != boundary.closed) asPartOfShore(piece);
  }

  void addWalls(const Boundary& shore, const std::function<bool(std::size_t)>& alone) {
    for (Boundary& piece : piecesOf(shore, alone)) {
      if (piece.closed) piece.role = roleOfLoop(grid_.nodes, piece.nodes, grid_.crs);
      found_.walls.push_back(std::move(piece));
    }
  }

  const EdgeKinds& kindsOfEdges() {
    if (!kinds_) kinds_.emplace(grid_);
    return *kinds_;
  }

  const Grid& grid_;
  const OuterEdges& outer_;
  CutBoundaries& found_;
  std::optional<EdgeKinds> kinds_;  // made for the first weir
};

// The edges of taken triangles across which another one is not taken, ascending.
std::vector<EdgeRef> cutEdges(const TriMesh& mesh, const std::vector<std::uint8_t>& taken, const ItemLoop& loop) {
  return joined(overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
    std::vector<EdgeRef> found;
    for (auto t = static_cast<TriId>(first); t < last; ++t) {
      if (taken[t] == 0) continue;
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef across = mesh.twin(edgeRef(t, i));
        if (across != kNone && taken[triOf(across)] == 0) found.push_back(edgeRef(t, i));
      }
    }
    return found;
  }));
}

// The edge that follows along the boundary of the taken triangles.
EdgeRef edgeAfter(const TriMesh& mesh, const std::vector<std::uint8_t>& taken, EdgeRef e) {
  for (;;) {
    e = edgeRef(triOf(e), next3(indexOf(e)));
    const EdgeRef across = mesh.twin(e);
    if (across == kNone || taken[triOf(across)] == 0) return e;
    e = across;
  }
}

// Chains of cut edges, those that do not close first.
std::vector<Boundary> chainsOfCut(const Grid& grid, const TriMesh& mesh, const std::vector<std::uint8_t>& taken,
                                  BoundaryRole role, const ItemLoop& loop) {
  const std::vector<EdgeRef> edges = cutEdges(mesh, taken, loop);
  std::vector<std::uint32_t> next(edges.size(), kNone);
  std::vector<bool> follows(edges.size(), false), done(edges.size(), false);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const EdgeRef after = edgeAfter(mesh, taken, edges[i]);
    const auto at = std::ranges::lower_bound(edges, after);
    if (at == edges.end() || *at != after) continue;
    next[i] = static_cast<std::uint32_t>(at - edges.begin());
    follows[next[i]] = true;
  }
  std::vector<Boundary> chains;
  const auto follow = [&](std::uint32_t first) {
    Boundary chain{role, false, {mesh.origin(edges[first])}};
    for (std::uint32_t i = first; i != kNone && !done[i]; i = next[i]) {
      done[i] = true;
      chain.nodes.push_back(mesh.target(edges[i]));
      chain.closed = next[i] == first;
    }
    if (chain.closed) {
      chain.nodes.pop_back();
      if (role == BoundaryRole::Land) chain.role = roleOfLoop(grid.nodes, chain.nodes, grid.crs);
    }
    chains.push_back(std::move(chain));
  };
  for (std::uint32_t i = 0; i < edges.size(); ++i)
    if (!follows[i]) follow(i);
  for (std::uint32_t i = 0; i < edges.size(); ++i)
    if (!done[i]) follow(i);
  return chains;
}

}  // namespace

void asPartOfShore(Boundary& piece) {
  if (piece.closed) return;
  if (piece.role == BoundaryRole::Island) piece.role = BoundaryRole::Land;
  if (isPartOfIsland(piece)) piece.ibtype = mainlandType(piece.ibtype);
}

CutBoundaries boundariesOfPart(const Grid& grid, const TriMesh& mesh, const std::vector<std::uint8_t>& taken,
                               BoundaryRole cut_role, const ItemLoop& loop) {
  CutBoundaries found;
  const OuterEdges outer(mesh, taken, loop);
  BoundaryDivider divider(grid, outer, found);
  for (const Boundary& boundary : grid.boundaries) divider.divide(boundary);
  found.cuts = chainsOfCut(grid, mesh, taken, cut_role, loop);
  return found;
}

}  // namespace coastmesh
