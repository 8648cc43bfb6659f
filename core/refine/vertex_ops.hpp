#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/metric.hpp"
#include "core/pslg.hpp"
#include "core/refine/feasible_region.hpp"
#include "core/refine/look_edges.hpp"
#include "core/refine/ring_look.hpp"

namespace coastmesh {

// Operations on one or two vertices that leave only good triangles: moving a vertex, removing it, merging two into one.
// Each is tested on the link alone and done only if it succeeds; flips then restore the Delaunay property, which never
// reduces the smallest angle. Changed triangles are appended to `touched`.
class VertexOps {
 public:
  VertexOps(EditMesh& mesh, const Pslg& pslg, const TriangleBound& bound);

  // From now on skips stars next to a frozen edge, since others may change them too.
  void keepClearOfFrozen() { clear_of_frozen_ = true; }

  // From now on rejects any flip that involves a bad triangle: an input angle may excuse that triangle but not the
  // result of the flip.
  void keepBadInPlace();

  // Algorithm 2 of Erten & Üngör (2007), for one vertex: moves it to where every triangle of its star is good. We
  // differ: the feasible region is computed exactly, and a vertex on a segment slides along it.
  bool relocate(VertexId v, std::vector<TriId>& touched);

  // Removes a vertex if the hole can be triangulated without a bad triangle. On a segment the two subsegments become
  // one.
  bool remove(VertexId v, std::vector<TriId>& touched);

  // The same, except that one triangle, its corners in any order, need not be good.
  bool removeInto(const Corners& excused, VertexId v, std::vector<TriId>& touched);

  // The same for any triangles.
  bool removeAnyway(VertexId v, std::vector<TriId>& touched);

  // Replaces the two ends of an edge by one vertex in the feasible region of both stars; `stays` moves there and keeps
  // its kind. Either both are free, or `stays` is on a segment and `goes` is free or its neighbour there.
  bool merge(VertexId goes, VertexId stays, std::vector<TriId>& touched);

  // Tries to merge v with each neighbour that is not an input vertex, unless their edge is much longer than the others
  // around v; a vertex on a segment only along it. If each vertex is processed, two free ones are tried from the one
  // with the smaller number only; otherwise v is assumed to have a bad triangle, and much shorter edges are out too.
  bool mergeWithNeighbour(VertexId v, bool each_gets_its_turn, std::vector<TriId>& touched);

  // The operations to try on a vertex, in this order until one succeeds.
  struct Tries {
    std::size_t removes_up_to = 0;  // removal, if the vertex has at most this many triangles
    bool merges = false;            // like mergeWithNeighbour, if each is processed
    bool moves = false;             // like relocate
  };
  enum class Change { None, Removed, Merged, Moved };
  // The same as these one after another, with a single walk around the vertex.
  Change tryInTurn(VertexId v, const Tries& tries, std::vector<TriId>& touched);

  // True if there is a bad triangle beyond an edge, given as seen from there (kNone: boundary).
  bool isBadBeyond(EdgeRef e) const;

 private:
  // The triangles to replace around a vertex, or around two that become one.
  struct Star {
    Patch patch;                       // the triangles, and their boundary without the following edges at the vertex
    std::vector<BoundaryEdge> spokes;  // subsegments that end at the vertex, as edges from it
    std::vector<BoundaryEdge> sides;   // those of them on the boundary of the mesh, with the mesh to their left

    void clear();
  };
  // Any: flips after a change may make triangles that were not tested.
  enum class Flips { Watched, Any };

  bool gather(VertexId v, Star& star);
  bool gatherBoth(VertexId goes, VertexId stays, Star& star);
  bool appendStar(VertexId v, VertexId other, VertexId stays, Star& star);
  const Ring* gatherRing(VertexId v, std::size_t most);
  bool relocateFree(VertexId v, const Ring& ring, std::vector<TriId>& touched);
  bool relocateWatchingFlips(VertexId v, std::vector<TriId>& touched);
  bool mergeFree(VertexId v, const Ring& ring, bool each_gets_its_turn, std::vector<TriId>& touched);
  bool hasTooManyTogether(VertexId v, VertexId w) const;
  bool cannotMerge(const Frame& frame, VertexId v, const Ring& ring, std::size_t k);
  std::optional<std::pair<VertexId, VertexId>> alongSegment(VertexId w, TriId between) const;
  bool cannotMergeOnto(const Frame& frame, const Ring& ring, std::size_t k) const;
  std::optional<Point> placeTowards(const Point& to, const Frame& frame, const Point& here, const Ring& ring);
  bool fitsAt(const Point& place, const Frame& frame, const Ring& ring);
  bool isClearOfBad(VertexId v) const { return v < at_bad_.size() && at_bad_[v] == 0; }
  bool isBesideBad(VertexId v, const Ring& ring) const;
  bool needsFlips(VertexId v, const Ring& ring, bool all_clear);
  template <typename Accept>
  bool removeWhere(VertexId v, Flips flips, const Accept& accept, std::vector<TriId>& touched);
  template <typename Accept>
  bool takeOut(VertexId v, Flips flips, const Accept& accept, std::vector<TriId>& touched);
  template <typename Accept>
  bool fillHole(std::span<const BoundaryEdge> side, const Accept& accept, std::vector<Corners>& fresh);
  template <typename Accept>
  bool fillBesideSegment(std::span<const EdgeRef> opposite, StarKind kind, const Accept& accept, Star& star,
                         std::vector<Corners>& fresh);
  std::optional<Point> findPlace(VertexId v, const Star& star);
  std::optional<Point> findFeasible(VertexId v, const Star& star, std::span<const LinkEdge> link);
  std::span<const LinkEdge> framed(const Frame& frame, std::span<const LinkEdge> link);
  bool isGood(const Corners& c) const;
  bool fanFlips(const Star& star, const Point& place) const;
  bool holeFlips(const Star& star, std::span<const Corners> fresh) const;
  bool isBarred(const Star& star) const;
  bool mayNotFlip(const Star& star) const;
  EdgeRef spokeBefore(EdgeRef opposite) const { return edgeRef(triOf(opposite), prev3(indexOf(opposite))); }
  EdgeRef spokeAfter(EdgeRef opposite) const { return edgeRef(triOf(opposite), next3(indexOf(opposite))); }

  EditMesh& mesh_;
  const Pslg& pslg_;
  const TriangleBound& bound_;
  bool clear_of_frozen_ = false;
  bool bad_stays_ = false;
  // For each vertex, in the plane: whether it was a corner of a bad triangle at `keepBadInPlace`. No other triangle
  // becomes bad, since flips preserve the smallest angle. Later vertices are not included.
  std::vector<std::uint8_t> at_bad_;
  std::size_t most_triangles_;  // no vertex can have more triangles without a bad one among them
  std::size_t most_merged_;     // the same for a vertex that two were merged into
  double cot_safe_;             // of the largest angle opposite an edge that no good triangle beyond it makes flip
  bool flips_may_harm_;         // flips preserve the smallest angle, but not the largest, nor the longest edge

  FeasibleRegion region_;

  // Reused memory. Each user fills it first and passes it on as an argument: nothing in it is kept for others.
  struct Memory {
    Ring ring;
    Star star;
    std::vector<EdgeRef> opposite;
    std::vector<VertexId> neighbours, polygon;
    std::vector<Corners> fresh, fresh_beyond;
    std::vector<LinkEdge> link, framed_link;
    Fan fan;
    RingLook ring_look;
    LookEdges look_edges;
  } memory_;
};

}  // namespace coastmesh
