#include "gis/weirs/weir_cuts.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/grid_lines.hpp"

namespace coastmesh {
namespace {

using Neighbours = std::map<std::uint32_t, std::vector<std::uint32_t>>;  // across edges that are cut

class Planner {
 public:
  Planner(const Grid& grid, const TriMesh& mesh) : grid_(grid), mesh_(mesh), outgoing_(outgoingEdges(mesh)) {
    boundary_starts_.assign(grid.nodes.size(), 0);
    for (TriId t = 0; t < mesh.triangles.size(); ++t)
      for (unsigned i = 0; i < 3; ++i)
        if (mesh.triangles[t].adj[i] == kNone) ++boundary_starts_[mesh.origin(edgeRef(t, i))];
    whole_.assign(grid.nodes.size(), false);
    for (const Boundary& boundary : grid.boundaries)
      if (isOpening(boundary.role))
        for (const std::uint32_t node : boundary.nodes) whole_[node] = true;
    for (std::size_t node = 0; node < whole_.size(); ++node)
      if (boundary_starts_[node] > 1) whole_[node] = true;
  }

  WeirCuts plan(std::vector<std::uint32_t> lines, std::vector<ClosedLine>& closed) {
    for (;;) {
      cutAlong(lines);
      const std::size_t before = closed.size();
      closeLoneTriangles(closed);
      if (closed.size() == before) closeShort(lines, closed);
      if (closed.size() == before) break;
      std::erase_if(lines, [&](std::uint32_t line) {
        return std::any_of(closed.begin() + static_cast<std::ptrdiff_t>(before), closed.end(),
                           [line](const ClosedLine& each) { return each.line == line; });
      });
    }
    findRuns();
    for (const auto& [node, others] : neighbours_)
      if (divides(node)) cuts_.sectors.emplace(node, sectorsAt(node));
    return std::move(cuts_);
  }

 private:
  bool onBoundary(std::uint32_t node) const { return boundary_starts_[node] > 0; }
  std::size_t cutsAt(std::uint32_t node) const {
    const auto found = neighbours_.find(node);
    return found == neighbours_.end() ? 0 : found->second.size();
  }
  std::size_t sectorCount(std::uint32_t node) const { return cutsAt(node) + (onBoundary(node) ? 1 : 0); }
  bool divides(std::uint32_t node) const { return sectorCount(node) > 1; }
  bool isPair(std::uint32_t node) const { return sectorCount(node) == 2; }
  bool isCut(std::uint32_t a, std::uint32_t b) const { return cuts_.line_of.contains(edgeKey(a, b)); }
  bool isWeir(const NodePair& edge) const { return isPair(edge[0]) && isPair(edge[1]); }

  void cutAlong(const std::vector<std::uint32_t>& lines) {
    cuts_ = {};
    neighbours_.clear();
    for (const std::uint32_t line : lines) {
      for (const auto& [a, b] : edgesOf(grid_.lines[line])) {
        if (whole_[a] || whole_[b] || !cuts_.line_of.emplace(edgeKey(a, b), line).second) continue;
        neighbours_[a].push_back(b);
        neighbours_[b].push_back(a);
      }
    }
  }

  // Lines of triangles that keep no neighbour.
  void closeLoneTriangles(std::vector<ClosedLine>& closed) const {
    std::set<std::uint32_t> found;
    for (const auto& [key, line] : cuts_.line_of) {
      const EdgeRef e = edgeFrom(key[0], key[1]);
      for (const TriId t : {triOf(e), triOf(mesh_.twin(e))}) {
        if (keepsNeighbour(t) || !found.insert(line).second) continue;
        closed.push_back({line, grid_.nodes[mesh_.triangles[t].v[0]], "a triangle would have no neighbour"});
      }
    }
  }

  bool keepsNeighbour(TriId t) const {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (mesh_.twin(e) != kNone && !isCut(mesh_.origin(e), mesh_.target(e))) return true;
    }
    return false;
  }

  // Lines in parts of the cuts without a pair of edges that water could pass.
  void closeShort(const std::vector<std::uint32_t>& lines, std::vector<ClosedLine>& closed) const {
    std::set<std::uint32_t> seen, of_weirs;
    for (const auto& [start, others] : neighbours_) {
      if (!seen.insert(start).second) continue;
      std::vector<std::uint32_t> part{start};
      std::set<std::uint32_t> of_part;
      bool any = false;
      for (std::size_t k = 0; k < part.size(); ++k) {
        for (const std::uint32_t other : neighbours_.at(part[k])) {
          of_part.insert(cuts_.line_of.at(edgeKey(part[k], other)));
          any = any || isWeir({part[k], other});
          if (seen.insert(other).second) part.push_back(other);
        }
      }
      if (any) of_weirs.insert(of_part.begin(), of_part.end());
    }
    for (const std::uint32_t line : lines)
      if (!of_weirs.contains(line))
        closed.push_back({line, grid_.nodes[grid_.lines[line].nodes.front()],
                          "no two of its nodes in a row can be doubled; smaller elements there may help"});
  }

  // The edge from `a` to `b`. REQUIRES: there is one, with triangles on both sides.
  EdgeRef edgeFrom(std::uint32_t a, std::uint32_t b) const {
    EdgeRef e = outgoing_[a];
    while (mesh_.target(e) != b) e = mesh_.twin(edgeRef(triOf(e), prev3(indexOf(e))));
    return e;
  }

  // The triangles around a node, from a shore or an edge that is cut.
  std::vector<NodeSector> sectorsAt(std::uint32_t node) const {
    EdgeRef e = onBoundary(node) ? outgoing_[node] : edgeFrom(node, neighbours_.at(node).front());
    const EdgeRef start = e;
    std::vector<NodeSector> sectors;
    bool is_new = true;
    do {
      if (is_new) sectors.push_back({{}, mesh_.target(e), kNone, isCut(node, mesh_.target(e)), false});
      NodeSector& sector = sectors.back();
      sector.triangles.push_back(triOf(e));
      sector.last = mesh_.apex(e);
      sector.last_is_cut = is_new = isCut(node, sector.last);
      e = mesh_.twin(edgeRef(triOf(e), prev3(indexOf(e))));
    } while (e != kNone && e != start);
    return sectors;
  }

  // Follows weirs from their ends, in the direction of the first line; then those without ends.
  void findRuns() {
    std::set<NodePair> used;
    for (const bool rings : {false, true})
      for (const auto& [key, line] : cuts_.line_of)
        if (isWeir(key) && !used.contains(key) && (rings || isEnd(key[0], key[1]) || isEnd(key[1], key[0])))
          addRun(rings || isEnd(key[0], key[1]) ? key : NodePair{key[1], key[0]}, used);
  }

  // True if no weir goes on at the first node of the edge.
  bool isEnd(std::uint32_t first, std::uint32_t second) const { return nextAfter(second, first) == kNone; }

  // The node after `to`, where the run came from `from`; kNone if it ends.
  std::uint32_t nextAfter(std::uint32_t from, std::uint32_t to) const {
    if (onBoundary(to)) return kNone;
    for (const std::uint32_t other : neighbours_.at(to))
      if (other != from && isWeir({to, other})) return other;
    return kNone;
  }

  void addRun(NodePair edge, std::set<NodePair>& used) {
    std::vector<std::uint32_t> nodes{edge[0]};
    const std::uint32_t line = cuts_.line_of.at(edgeKey(edge[0], edge[1]));
    const bool along = runsAlong(line, edge);
    for (auto [from, to] = edge; to != kNone && used.insert(edgeKey(from, to)).second;) {
      nodes.push_back(to);
      const std::uint32_t next = nextAfter(from, to);
      from = std::exchange(to, next);
    }
    if (!along) std::ranges::reverse(nodes);
    WeirRun& run = cuts_.runs.emplace_back();
    run.closed = nodes.front() == nodes.back();
    for (std::size_t i = 1; i < nodes.size(); ++i) run.edges.push_back(edgeFrom(nodes[i - 1], nodes[i]));
  }

  bool runsAlong(std::uint32_t line, const NodePair& edge) const {
    const std::vector<NodePair> edges = edgesOf(grid_.lines[line]);
    return std::ranges::find(edges, edge) != edges.end();
  }

  const Grid& grid_;
  const TriMesh& mesh_;
  const std::vector<EdgeRef> outgoing_;
  std::vector<std::uint8_t> boundary_starts_;  // by node: boundary edges that start there
  std::vector<bool> whole_;                    // by node: no edge there is cut
  WeirCuts cuts_;
  Neighbours neighbours_;
};

}  // namespace

WeirCuts planWeirCuts(const Grid& grid, const TriMesh& mesh, std::vector<std::uint32_t> lines,
                      std::vector<ClosedLine>& closed) {
  return Planner(grid, mesh).plan(std::move(lines), closed);
}

}  // namespace coastmesh
