#include "gis/merge/tidy_gap.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "core/metric.hpp"
#include "core/union_find.hpp"
#include "gis/grid/local_plane.hpp"

namespace coastmesh {

namespace {

// Smaller angles than these cannot be filled with good triangles: at a corner, where edges of the inserted mesh stay as
// they are, and between such an edge and a node of the shore.
constexpr double kSharpDeg = 30.0, kFlatDeg = 20.0;

class GapTidier {
 public:
  GapTidier(const TriMesh& mesh, const Gap& gap, std::vector<std::uint8_t>& taken)
      : mesh_(mesh), gap_(gap), taken_(taken) {
    for (const VertexId v : gap.changed) at_node_[v];
    for (TriId t = gap.first_gap; t < mesh.triangles.size(); ++t)
      for (const VertexId v : mesh.triangles[t].v) at_node_[v];
    for (TriId t = 0; t < mesh.triangles.size(); ++t)
      for (const VertexId v : mesh.triangles[t].v)
        if (const auto found = at_node_.find(v); found != at_node_.end()) found->second.push_back(t);
  }

  std::size_t tidy() {
    std::size_t left_out = 0;
    for (std::size_t before = 1; before > 0;) {  // each round leaves triangles out, or is the last
      before = 0;
      for (TriId t = gap_.first_gap; t < mesh_.triangles.size(); ++t)
        if (taken_[t] != 0 && (isTooth(t) || isFlat(t))) before += leaveOut(t);
      for (const auto& [node, triangles] : at_node_) {
        before += leaveOutLoose(triangles);
        before += leaveOutSharp(node, triangles);
      }
      left_out += before;
    }
    return left_out - takeEnclosed();
  }

 private:
  // Triangles that were left out, and that what is taken encloses, would be an island that neither mesh has: they are
  // taken after all. Returns how many.
  std::size_t takeEnclosed() {
    const auto isLeft = [&](TriId t) { return t >= gap_.first_gap && taken_[t] == 0; };
    std::vector<std::uint8_t> seen(mesh_.triangles.size() - gap_.first_gap, 0);
    std::size_t count = 0;
    for (TriId first = gap_.first_gap; first < mesh_.triangles.size(); ++first) {
      if (!isLeft(first) || seen[first - gap_.first_gap] != 0) continue;
      std::vector<TriId> part(1, first);
      seen[first - gap_.first_gap] = 1;
      bool is_enclosed = true;
      for (std::size_t i = 0; i < part.size(); ++i) {
        for (const EdgeRef across : mesh_.triangles[part[i]].adj) {
          if (across == kNone || (triOf(across) < gap_.first_gap && taken_[triOf(across)] == 0)) {
            is_enclosed = false;
          } else if (isLeft(triOf(across)) && seen[triOf(across) - gap_.first_gap] == 0) {
            seen[triOf(across) - gap_.first_gap] = 1;
            part.push_back(triOf(across));
          }
        }
      }
      if (!is_enclosed) continue;
      for (const TriId t : part) taken_[t] = 1;
      count += part.size();
    }
    return count;
  }

  std::size_t leaveOut(TriId t) {
    taken_[t] = 0;
    return 1;
  }

  bool isBare(EdgeRef e) const { return mesh_.twin(e) == kNone || taken_[triOf(mesh_.twin(e))] == 0; }

  bool isTooth(TriId t) const {
    unsigned bare = 0, new_bare = 0;
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (!isBare(e)) continue;
      ++bare;
      if (!std::ranges::binary_search(gap_.shore, edgeKey(mesh_.origin(e), mesh_.target(e)))) ++new_bare;
    }
    return bare == 3 || new_bare > 1;
  }

  bool isInserted(TriId t) const { return t >= gap_.first_inserted && t < gap_.first_gap; }

  double angleOf(TriId t, unsigned corner) const {
    std::array<Point, 3> places;
    for (unsigned i = 0; i < 3; ++i) places[i] = mesh_.points[mesh_.triangles[t].v[i]];
    flattenLocally(gap_.crs, places);
    return toDegrees(angleAt(places[corner], places[next3(corner)], places[prev3(corner)]));
  }

  bool isOnBoundary(VertexId v) const {
    const auto& triangles = at_node_.at(v);
    return std::ranges::any_of(triangles, [&](TriId t) {
      if (taken_[t] == 0) return false;
      const unsigned i = mesh_.cornerOf(t, v);
      return isBare(edgeRef(t, next3(i))) || isBare(edgeRef(t, prev3(i)));
    });
  }

  // A triangle between an edge of the inserted mesh and a node of a shore close to it, both of which stay.
  bool isFlat(TriId t) const {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef across = mesh_.twin(edgeRef(t, i));
      if (across == kNone || !isInserted(triOf(across)) || !isOnBoundary(mesh_.triangles[t].v[i])) continue;
      if (angleOf(t, i) > 90.0 && std::min(angleOf(t, next3(i)), angleOf(t, prev3(i))) < kFlatDeg) return true;
    }
    return false;
  }

  // The triangles of the gap around a corner, from one shore or edge of the inserted mesh to the next, if their angle
  // is too small. Corners of the shore before are as they were.
  std::size_t leaveOutSharp(VertexId node, const std::vector<TriId>& all) {
    std::size_t left_out = 0;
    for (const TriId first : all) {
      if (first < gap_.first_gap || taken_[first] == 0) continue;
      const auto isEnd = [&](EdgeRef e) { return isBare(e) || isInserted(triOf(mesh_.twin(e))); };
      const auto wasShore = [&](EdgeRef e) {
        return std::ranges::binary_search(gap_.shore, edgeKey(mesh_.origin(e), mesh_.target(e)));
      };
      // Counter-clockwise around the node: a triangle's edge from the node, then the one to it.
      const EdgeRef from = edgeRef(first, prev3(mesh_.cornerOf(first, node)));
      if (!isEnd(from)) continue;
      std::vector<TriId> fan;
      double angle = 0.0;
      bool of_gap = true;
      EdgeRef to = from;
      for (TriId t = first;;) {
        fan.push_back(t);
        of_gap = of_gap && t >= gap_.first_gap;
        angle += angleOf(t, mesh_.cornerOf(t, node));
        to = edgeRef(t, next3(mesh_.cornerOf(t, node)));
        if (isEnd(to) || fan.size() > all.size()) break;
        t = triOf(mesh_.twin(to));
      }
      if (!of_gap || angle >= kSharpDeg || (wasShore(from) && wasShore(to))) continue;
      for (const TriId t : fan) left_out += leaveOut(t);
    }
    return left_out;
  }

  // Of the sets of triangles that edges at a node connect, the inserted mesh's stay; if there are none, the largest one
  // does, of the other mesh if possible.
  std::size_t leaveOutLoose(const std::vector<TriId>& all) {
    std::vector<TriId> triangles;
    for (const TriId t : all)
      if (taken_[t] != 0) triangles.push_back(t);
    UnionFind sets(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      for (const EdgeRef across : mesh_.triangles[triangles[i]].adj) {
        if (across == kNone) continue;
        const auto at = std::ranges::find(triangles, triOf(across));
        if (at != triangles.end()) sets.unite(i, static_cast<std::uint32_t>(at - triangles.begin()));
      }
    }
    std::map<std::uint32_t, std::vector<TriId>> by_root;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) by_root[sets.find(i)].push_back(triangles[i]);
    if (by_root.size() < 2) return 0;
    const auto rank = [&](const std::vector<TriId>& set) {
      const bool inserted = std::ranges::any_of(set, [&](TriId t) { return isInserted(t); });
      const bool other = std::ranges::any_of(set, [&](TriId t) { return t < gap_.first_inserted; });
      return std::pair(inserted ? 2 : other ? 1 : 0, set.size());
    };
    std::pair<int, std::size_t> most{0, 0};
    for (const auto& [root, set] : by_root) most = std::max(most, rank(set));
    std::size_t left_out = 0;
    bool is_kept = false;
    for (const auto& [root, set] : by_root) {
      const bool stays = most.first == 2 ? rank(set).first == 2 : !is_kept && rank(set) == most;
      is_kept = is_kept || stays;
      if (!stays)
        for (const TriId t : set) left_out += leaveOut(t);
    }
    return left_out;
  }

  const TriMesh& mesh_;
  const Gap& gap_;
  std::vector<std::uint8_t>& taken_;
  std::map<VertexId, std::vector<TriId>> at_node_;  // of nodes where something may be left out
};

}  // namespace

std::size_t tidyGap(const TriMesh& mesh, const Gap& gap, std::vector<std::uint8_t>& taken) {
  return GapTidier(mesh, gap, taken).tidy();
}

}  // namespace coastmesh
