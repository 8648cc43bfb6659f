#include "core/triangulate/merge_halves.hpp"

#include <span>

#include "core/links.hpp"
#include "core/predicates.hpp"

namespace coastmesh {

namespace {

// Edges of a hull are named by the edges of their ghosts: the hull, counter-clockwise, runs from the target to the
// origin of such an edge.
class Merger {
 public:
  Merger(Triangulation& triangulation, Sweep sweep)
      : all_(triangulation), mesh_(all_.mesh), triangles_(all_.mesh.triangles), sweep_(sweep) {}

  TriId run(TriId first, TriId second, std::array<TriId, 2> slots) {
    EdgeRef left = hullEdgeFrom(first, [&](VertexId a, VertexId b) { return isBefore(sweep_, at(b), at(a)); });
    EdgeRef right = hullEdgeFrom(second, [&](VertexId a, VertexId b) { return isBefore(sweep_, at(a), at(b)); });
    findLowerTangent(left, right);
    fill(left, right, slots);
    return slots[1];
  }

 private:
  const Point& at(VertexId v) const { return all_.points[v]; }
  VertexId startOf(EdgeRef hull) const { return mesh_.target(hull); }
  VertexId endOf(EdgeRef hull) const { return mesh_.origin(hull); }
  // The edges of a ghost from the ghost corner to the end of its hull edge, and from the start to the ghost corner.
  static EdgeRef endSide(EdgeRef hull) { return edgeRef(triOf(hull), prev3(indexOf(hull))); }
  static EdgeRef startSide(EdgeRef hull) { return edgeRef(triOf(hull), next3(indexOf(hull))); }
  EdgeRef nextOnHull(EdgeRef hull) const {
    const EdgeRef there = mesh_.twin(endSide(hull));
    return edgeRef(triOf(there), prev3(indexOf(there)));
  }
  EdgeRef previousOnHull(EdgeRef hull) const {
    const EdgeRef there = mesh_.twin(startSide(hull));
    return edgeRef(triOf(there), next3(indexOf(there)));
  }

  // The hull edge whose start comes first by `isBetter`.
  template <typename Better>
  EdgeRef hullEdgeFrom(TriId ghost, const Better& isBetter) const {
    const EdgeRef begin = edgeRef(ghost, mesh_.cornerOf(ghost, all_.ghost));
    EdgeRef best = begin;
    for (EdgeRef e = nextOnHull(begin); e != begin; e = nextOnHull(e))
      if (isBetter(startOf(e), startOf(best))) best = e;
    return best;
  }

  // Moves both down their hulls until both hulls lie above the line through their starts. If further points lie on the
  // line, then not between these two.
  void findLowerTangent(EdgeRef& left, EdgeRef& right) const {
    for (;;) {
      const EdgeRef lower_left = previousOnHull(left);
      if (orient2d(at(startOf(left)), at(startOf(right)), at(startOf(lower_left))) < 0) {
        left = lower_left;
      } else if (orient2d(at(startOf(left)), at(startOf(right)), at(endOf(right))) < 0) {
        right = nextOnHull(right);
      } else {
        return;
      }
    }
  }

  // Triangulates the space between the hulls from the lower tangent to the upper one; `left` and `right` start at the
  // ends of the lower tangent. A triangle takes the slot of the ghost whose hull edge it covers.
  void fill(EdgeRef left, EdgeRef right, std::array<TriId, 2> slots) {
    VertexId l = startOf(left), r = startOf(right);
    const EdgeRef l_below = previousOnHull(left), r_below = right;  // remain below the tangent, unless covered
    right = previousOnHull(right);                                  // from now on the edge that ends at r
    const TriId lower = slots[0];
    triangles_[lower] = unlinked({all_.ghost, r, l});
    setTwins(triangles_, edgeRef(lower, 1), endSide(l_below));
    setTwins(triangles_, edgeRef(lower, 2), startSide(r_below));
    EdgeRef base = edgeRef(lower, 0);
    bool left_used_up = false, right_used_up = false;
    for (;;) {
      const bool sees_left = !left_used_up && orient2d(at(l), at(r), at(endOf(left))) > 0;
      const bool sees_right = !right_used_up && orient2d(at(l), at(r), at(startOf(right))) > 0;
      if (!sees_left && !sees_right) break;
      while (sees_left && reachesBehind(left, l, r, endOf(left))) left = open(left, true);
      while (sees_right && reachesBehind(right, l, r, startOf(right))) right = open(right, false);
      const bool takes_left =
          sees_left && (!sees_right || inCircle(at(l), at(r), at(endOf(left)), at(startOf(right))) <= 0);
      const EdgeRef covered = takes_left ? left : right, inside = mesh_.twin(covered);
      const TriId t = triOf(covered);
      const VertexId apex = takes_left ? endOf(left) : startOf(right);
      if (takes_left) {
        left_used_up = covered == l_below;
        if (!left_used_up) left = nextOnHull(covered);
      } else {
        right_used_up = covered == r_below;
        if (!right_used_up) right = previousOnHull(covered);
      }
      triangles_[t] = unlinked({l, r, apex});
      setTwins(triangles_, edgeRef(t, takes_left ? 1 : 0), inside);
      setTwins(triangles_, edgeRef(t, 2), base);
      for (const VertexId v : {l, r, apex}) all_.triangle_of[v] = t;
      base = edgeRef(t, takes_left ? 0 : 1);
      (takes_left ? l : r) = apex;
    }
    const TriId upper = slots[1];
    triangles_[upper] = unlinked({all_.ghost, l, r});
    setTwins(triangles_, edgeRef(upper, 0), base);
    setTwins(triangles_, edgeRef(upper, 1), right_used_up ? edgeRef(lower, 2) : endSide(right));
    setTwins(triangles_, edgeRef(upper, 2), left_used_up ? edgeRef(lower, 1) : startSide(left));
  }

  // True if the circle through l, r and the other end of a hull edge contains the corner behind that edge, whose
  // triangle then is not Delaunay in the whole.
  bool reachesBehind(EdgeRef hull, VertexId l, VertexId r, VertexId other) const {
    const VertexId behind = mesh_.apex(mesh_.twin(hull));
    return behind != all_.ghost && inCircle(at(l), at(r), at(other), at(behind)) > 0;
  }

  // Removes the triangle behind a hull edge; two of its edges take that edge's place. Returns the one at the start of
  // the hull edge, or at its end; its ghost takes the triangle's slot, and is not linked to the ghost beyond, which has
  // been covered. The other edge keeps the ghost.
  EdgeRef open(EdgeRef hull, bool at_start) {
    const EdgeRef inside = mesh_.twin(hull);
    const TriId ghost = triOf(hull), opened = triOf(inside);
    const VertexId near = at_start ? startOf(hull) : endOf(hull), far = at_start ? endOf(hull) : startOf(hull);
    const VertexId middle = mesh_.apex(inside);
    const EdgeRef behind_end = mesh_.twin(edgeRef(opened, next3(indexOf(inside))));
    const EdgeRef behind_start = mesh_.twin(edgeRef(opened, prev3(indexOf(inside))));
    triangles_[ghost].v[at_start ? prev3(indexOf(hull)) : next3(indexOf(hull))] = middle;
    setTwins(triangles_, hull, at_start ? behind_end : behind_start);
    triangles_[opened] = at_start ? unlinked({all_.ghost, middle, near}) : unlinked({all_.ghost, near, middle});
    const EdgeRef made = edgeRef(opened, 0);
    setTwins(triangles_, made, at_start ? behind_start : behind_end);
    setTwins(triangles_, at_start ? endSide(made) : startSide(made), at_start ? startSide(hull) : endSide(hull));
    all_.triangle_of[near] = all_.triangle_of[middle] = opened;
    all_.triangle_of[far] = ghost;
    return made;
  }

  Triangulation& all_;
  const LinkedTriangles& mesh_;
  std::span<Triangle> triangles_;
  Sweep sweep_;
};

}  // namespace

bool isBefore(Sweep sweep, const Point& a, const Point& b) {
  if (sweep == Sweep::Right) return a.x < b.x || (a.x == b.x && a.y < b.y);
  return a.y < b.y || (a.y == b.y && a.x > b.x);
}

TriId mergeHalves(Triangulation& triangulation, Sweep sweep, TriId first, TriId second, std::array<TriId, 2> slots) {
  return Merger(triangulation, sweep).run(first, second, slots);
}

}  // namespace coastmesh
