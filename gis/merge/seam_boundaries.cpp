#include "gis/merge/seam_boundaries.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "gis/cut/cut_boundaries.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/ibtype.hpp"

namespace coastmesh {

namespace {

bool isWeir(const Boundary& boundary) { return !boundary.back_nodes.empty() || !boundary.weir.empty(); }

class SeamBoundaries {
 public:
  SeamBoundaries(Grid& grid, const TriMesh& mesh, const SeamOrigin& origin, const ItemLoop& loop)
      : grid_(grid), origin_(origin), loops_(boundaryLoops(mesh, loop)), changed_(origin.cut) {
    for (const std::vector<VertexId>& ring : loops_)
      forEachEdgeOf(ring, [&](std::uint32_t a, std::uint32_t b) { outer_.push_back(edgeKey(a, b)); });
    std::ranges::sort(outer_);
    for (TriId t = origin.first_gap; t < mesh.triangles.size(); ++t)
      for (unsigned i = 0; i < 3; ++i)
        if (const EdgeRef e = edgeRef(t, i); mesh.twin(e) == kNone)
          changed_.push_back(edgeKey(mesh.origin(e), mesh.target(e)));
  }

  std::size_t set() {
    keepOuter();
    if (!origin_.weirs.empty()) joinWeirs();
    std::ranges::sort(changed_);
    numberEdges();
    std::vector<std::vector<std::uint32_t>> changed;
    for (const std::vector<std::uint32_t>& loop : loops_) {
      if (!isChanged(loop)) continue;
      changed.push_back(loop);
      resolve(loop);
    }
    replaceOn(changed);
    return walls_;
  }

 private:
  // Kinds by edge; `segment` is 1 + the index of the boundary that has it, 0 for none.
  static constexpr std::uint32_t kWeir = kNone;  // segment of edges of weirs, which stay as they are

  static void forEachEdgeOf(const std::vector<std::uint32_t>& loop, const auto& use) {
    for (std::size_t i = 0; i < loop.size(); ++i) use(loop[i], loop[(i + 1) % loop.size()]);
  }

  bool isOuter(std::uint32_t a, std::uint32_t b) const { return std::ranges::binary_search(outer_, edgeKey(a, b)); }

  // True for a loop with edges that are to have a boundary, and for one of both meshes.
  bool isChanged(const std::vector<std::uint32_t>& loop) const {
    bool is_changed = false, of_inserted = false, of_other = false;
    forEachEdgeOf(loop, [&](std::uint32_t a, std::uint32_t b) {
      const NodePair key = edgeKey(a, b);
      is_changed = is_changed || std::ranges::binary_search(changed_, key);
      const auto known = kinds_.find(key);
      if (known == kinds_.end() || known->second.segment == kWeir) return;
      (inserted_[known->second.segment - 1] ? of_inserted : of_other) = true;
    });
    return is_changed || (of_inserted && of_other);
  }

  bool isAlongShore(const std::vector<NodePair>& edges) const {
    return std::ranges::all_of(
        edges, [&](const NodePair& edge) { return origin_.is_at_shore(grid_.nodes[edge[0]], grid_.nodes[edge[1]]); });
  }

  // Drops what is not on the mesh's boundary any more, and open boundaries that are joined.
  void keepOuter() {
    std::vector<Boundary> kept;
    for (std::size_t b = 0; b < grid_.boundaries.size(); ++b) {
      Boundary& boundary = grid_.boundaries[b];
      const std::vector<NodePair> edges = edgesOf(boundary);
      const std::size_t n = boundary.nodes.size();
      std::vector<std::uint8_t> outer(edges.size());
      for (std::size_t i = 0; i < edges.size(); ++i) {
        outer[i] = isOuter(edges[i][0], edges[i][1]) ? 1 : 0;
        if (!boundary.back_nodes.empty() && !isOuter(boundary.back_nodes[i], boundary.back_nodes[(i + 1) % n]))
          outer[i] = 0;
      }
      const bool is_inserted = b >= origin_.first_inserted, is_open = boundary.role == BoundaryRole::Open;
      if (std::ranges::count(outer, 1) == std::ssize(outer) && !(is_inserted && is_open && isAlongShore(edges))) {
        kept.push_back(std::move(boundary));
        inserted_.push_back(is_inserted);
        continue;
      }
      if (is_inserted && is_open) {
        for (std::size_t i = 0; i < edges.size(); ++i)
          if (outer[i] != 0) left_open_.push_back(edgeKey(edges[i][0], edges[i][1]));
        continue;
      }
      for (Boundary& piece : piecesOf(boundary, [&](std::size_t i) { return outer[i] != 0; })) {
        asPartOfShore(piece);
        kept.push_back(std::move(piece));
        inserted_.push_back(is_inserted);
      }
    }
    grid_.boundaries = std::move(kept);
    changed_.insert(changed_.end(), left_open_.begin(), left_open_.end());
    std::ranges::sort(left_open_);
  }

  // Where the inserted mesh's weir ends at its outline, and an edge of each shore leads from there to a pair of nodes
  // of a weir of the other mesh, it goes on to that, with the crest there.
  void joinWeirs() {
    struct Pair {
      const Boundary* weir;
      std::size_t at;
    };
    std::map<NodePair, Pair> pairs;
    for (const Boundary& weir : origin_.weirs)
      for (std::size_t i = 0; i < weir.nodes.size(); ++i)
        pairs.try_emplace(edgeKey(weir.nodes[i], weir.back_nodes[i]), Pair{&weir, i});
    std::map<std::uint32_t, std::uint32_t> after, before;  // on loops; kNone at a node that these pass twice
    for (const std::vector<VertexId>& ring : loops_)
      forEachEdgeOf(ring, [&](std::uint32_t a, std::uint32_t b) {
        if (!after.try_emplace(a, b).second) after[a] = kNone;
        if (!before.try_emplace(b, a).second) before[b] = kNone;
      });
    const auto nodeIn = [](const std::map<std::uint32_t, std::uint32_t>& nodes, std::uint32_t node) {
      const auto found = nodes.find(node);
      return found == nodes.end() ? kNone : found->second;
    };
    std::set<NodePair> of_weirs;
    for (const Boundary& boundary : grid_.boundaries)
      if (!boundary.back_nodes.empty())
        for (const auto& [a, b] : edgesOf(boundary)) of_weirs.insert(edgeKey(a, b));
    for (std::size_t b = 0; b < grid_.boundaries.size(); ++b) {
      Boundary& own = grid_.boundaries[b];
      if (!inserted_[b] || own.back_nodes.empty() || own.closed) continue;
      for (const bool at_end : {false, true}) {
        const std::uint32_t node = at_end ? own.nodes.back() : own.nodes.front(),
                            across = at_end ? own.back_nodes.back() : own.back_nodes.front();
        const std::uint32_t next = nodeIn(at_end ? after : before, node),
                            next_across = nodeIn(at_end ? before : after, across);
        if (next == kNone || next_across == kNone || of_weirs.contains(edgeKey(node, next))) continue;
        const auto found = pairs.find(edgeKey(next, next_across));
        if (found == pairs.end()) continue;
        const auto& [weir, at] = found->second;
        const std::size_t each = own.weir.size() / own.nodes.size();
        if (weir->ibtype != own.ibtype || weir->weir.size() != each * weir->nodes.size()) continue;
        own.nodes.insert(at_end ? own.nodes.end() : own.nodes.begin(), next);
        own.back_nodes.insert(at_end ? own.back_nodes.end() : own.back_nodes.begin(), next_across);
        const auto crest = weir->weir.begin() + static_cast<std::ptrdiff_t>(each * at);
        own.weir.insert(at_end ? own.weir.end() : own.weir.begin(), crest, crest + static_cast<std::ptrdiff_t>(each));
      }
    }
  }

  void numberEdges() {
    for (std::uint32_t b = 0; b < grid_.boundaries.size(); ++b) {
      const Boundary& boundary = grid_.boundaries[b];
      const std::uint32_t segment = isWeir(boundary) ? kWeir : b + 1;
      for (const auto& [from, to] : edgesOf(boundary))
        kinds_[edgeKey(from, to)] = {boundary.role, boundary.ibtype, segment, boundary.name};
      if (boundary.back_nodes.empty()) continue;
      for (const auto& [from, to] : edgesOf({boundary.role, boundary.closed, boundary.back_nodes}))
        kinds_.try_emplace(edgeKey(from, to), BoundaryKind{boundary.role, boundary.ibtype, kWeir});
    }
  }

  // Sets the kinds of all edges of a loop.
  void resolve(const std::vector<std::uint32_t>& loop) {
    const std::size_t n = loop.size();
    std::vector<std::optional<BoundaryKind>> kinds(n);
    std::vector<bool> is_new(n);
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t from = loop[i], to = loop[(i + 1) % n];
      if (const auto known = kinds_.find(edgeKey(from, to)); known != kinds_.end()) {
        kinds[i] = known->second;
      } else {
        is_new[i] = true;
        if (const BoundaryKind* const before = origin_.kind_before(from, to))
          kinds[i] =
              BoundaryKind{!isOpening(*before) ? BoundaryRole::Land : before->role, before->ibtype, 0, before->name};
      }
    }
    resolveUnknown(kinds);
    for (std::size_t i = 0; i < n; ++i)
      if (is_new[i] && kinds[i]->role != BoundaryRole::Open &&
          std::ranges::binary_search(left_open_, edgeKey(loop[i], loop[(i + 1) % n])))
        ++walls_;
    for (const auto& kind : kinds) on_changed_.insert(kind->segment);
    uniteAlike(kinds, loop);
    for (std::size_t i = 0; i < n; ++i) kinds_[edgeKey(loop[i], loop[(i + 1) % n])] = *kinds[i];
  }

  // True for edges of an opening of each mesh, one after the other, unless the other mesh had two openings there.
  bool areOneOpening(const BoundaryKind& a, const BoundaryKind& b, const std::vector<std::uint32_t>& loop,
                     std::size_t i) const {
    if (inserted_[a.segment - 1] == inserted_[b.segment - 1]) return false;
    const std::size_t n = loop.size();
    const BoundaryKind* const before = origin_.kind_before(loop[i], loop[(i + 1) % n]);
    const BoundaryKind* const after = origin_.kind_before(loop[(i + 1) % n], loop[(i + 2) % n]);
    return before == nullptr || after == nullptr || before->segment == after->segment;
  }

  // Boundaries and new edges of one kind that follow one another on a loop are one: shores, others with new edges
  // between them, and openings of both meshes. It takes the place of the first of them.
  void uniteAlike(std::vector<std::optional<BoundaryKind>>& kinds, const std::vector<std::uint32_t>& loop) const {
    const std::size_t n = kinds.size();
    for (auto& kind : kinds)
      if (!isOpening(*kind) && kind->segment != kWeir)
        kind = BoundaryKind{BoundaryRole::Land, isRolesOwn(kind->ibtype) ? -1 : kind->ibtype, kind->segment};
    const auto goesOn = [&](std::size_t i, std::size_t j) {
      const BoundaryKind &a = *kinds[i], &b = *kinds[j];
      if (a.segment == kWeir || b.segment == kWeir || a.role != b.role || a.ibtype != b.ibtype) return false;
      if (a.name != b.name && !a.name.empty() && !b.name.empty()) return false;
      return a.segment == b.segment || !isOpening(a) || a.segment == 0 || b.segment == 0 ||
             areOneOpening(a, b, loop, i);
    };
    std::size_t start = 0;
    while (start < n && goesOn((start + n - 1) % n, start)) ++start;
    start %= n;
    for (std::size_t k = 0; k < n;) {
      std::size_t end = k + 1;
      while (end < n && goesOn((start + end - 1) % n, (start + end) % n)) ++end;
      std::uint32_t least = 0;
      std::string name;  // of the first that has one
      for (std::size_t i = k; i < end; ++i) {
        const BoundaryKind& kind = *kinds[(start + i) % n];
        if (kind.segment != 0) least = least == 0 ? kind.segment : std::min(least, kind.segment);
        if (name.empty()) name = kind.name;
      }
      for (; k < end; ++k) {
        kinds[(start + k) % n]->segment = least;
        kinds[(start + k) % n]->name = name;
      }
    }
  }

  // Stretches of edges whose kind is unknown get that of an open boundary at either end, else land.
  static void resolveUnknown(std::vector<std::optional<BoundaryKind>>& kinds) {
    const std::size_t n = kinds.size();
    const auto known = std::ranges::find_if(kinds, [](const auto& kind) { return kind.has_value(); });
    if (known == kinds.end()) {
      std::ranges::fill(kinds, BoundaryKind{});
      return;
    }
    const auto start = static_cast<std::size_t>(known - kinds.begin());
    for (std::size_t k = 0; k < n; ++k) {
      if (kinds[(start + k) % n]) continue;
      std::size_t end = k;
      while (!kinds[(start + end) % n]) ++end;
      const BoundaryKind before = *kinds[(start + k - 1) % n], after = *kinds[(start + end) % n];
      const BoundaryKind kind =
          before.role == BoundaryRole::Open  ? BoundaryKind{before.role, before.ibtype, 0, before.name}
          : after.role == BoundaryRole::Open ? BoundaryKind{after.role, after.ibtype, 0, after.name}
                                             : BoundaryKind{};
      for (; k < end; ++k) kinds[(start + k) % n] = kind;
    }
  }

  void replaceOn(const std::vector<std::vector<std::uint32_t>>& changed) {
    std::map<std::uint32_t, std::vector<Boundary>> made;  // by segment
    const auto kindOf = [&](std::uint32_t a, std::uint32_t b) { return kinds_.at(edgeKey(a, b)); };
    for (Boundary& boundary : cutLoops(grid_, changed, kindOf)) {
      const std::uint32_t segment = kindOf(boundary.nodes[0], boundary.nodes[1]).segment;
      if (segment != kWeir) made[segment].push_back(std::move(boundary));
    }
    std::vector<Boundary> all;
    for (std::uint32_t b = 0; b < grid_.boundaries.size(); ++b) {
      Boundary& boundary = grid_.boundaries[b];
      const auto found = made.find(b + 1);
      if (found != made.end() && edgesOf(boundary).size() != edgesIn(found->second)) {
        std::ranges::move(found->second, std::back_inserter(all));
      } else if (found != made.end() || !on_changed_.contains(b + 1)) {
        all.push_back(std::move(boundary));  // as it was
      }                                      // else it is a part of an earlier one now
    }
    if (const auto fresh = made.find(0); fresh != made.end()) std::ranges::move(fresh->second, std::back_inserter(all));
    grid_.boundaries = std::move(all);
  }

  static std::size_t edgesIn(const std::vector<Boundary>& boundaries) {
    std::size_t edges = 0;
    for (const Boundary& boundary : boundaries) edges += edgesOf(boundary).size();
    return edges;
  }

  Grid& grid_;
  const SeamOrigin& origin_;
  std::vector<std::vector<VertexId>> loops_;
  std::vector<NodePair> outer_;      // keys of the edges of loops, sorted
  std::vector<NodePair> changed_;    // of edges whose loops are completed
  std::vector<NodePair> left_open_;  // of them, those of open boundaries that are joined
  std::vector<bool> inserted_;       // of each boundary that is kept: it is the inserted mesh's
  std::map<NodePair, BoundaryKind> kinds_;
  std::set<std::uint32_t> on_changed_;  // segments in `kinds_` of boundaries on loops that are completed
  std::size_t walls_ = 0;
};

}  // namespace

std::size_t setSeamBoundaries(Grid& grid, const TriMesh& mesh, const SeamOrigin& origin, const ItemLoop& loop) {
  return SeamBoundaries(grid, mesh, origin, loop).set();
}

}  // namespace coastmesh
