#include <algorithm>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/feasible_region.hpp"
#include "core/label_regions.hpp"
#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "core/refine.hpp"
#include "core/shortfalls.hpp"

namespace coastmesh {

namespace {

// Takes out vertices that the bounds do not need: one at a time where the hole triangulates without a bad triangle, or
// the two ends of an edge for one vertex in the feasible region of both stars together.
class Shrinker {
 public:
  Shrinker(TriMesh&& mesh, const Pslg& pslg, const RefineOptions& options)
      : pslg_(pslg),
        bound_(options.min_angle_deg, options.max_angle_deg, options.size_max),
        mesh_(std::move(mesh)),
        waits_(mesh_.vertexSlots(), false) {}

  void run(const RunControl& control) {
    for (VertexId v = mesh_.inputVertices(); v < mesh_.vertexSlots(); ++v) await(v);
    const double first = static_cast<double>(std::max<std::size_t>(1, queue_.size()));
    // Every success takes a vertex out, so the queue is refilled as often as there are vertices at most.
    for (std::uint64_t steps = 1; !queue_.empty(); ++steps) {
      if (steps % 1024 == 0) control.checkpoint(std::max(0.0, 1.0 - static_cast<double>(queue_.size()) / first));
      const VertexId v = queue_.front();
      queue_.pop_front();
      waits_[v] = false;
      if (!mesh_.isLiveVertex(v)) continue;
      if (removeVertex(v) || mergeWithNeighbour(v)) awaitTouched();
    }
  }

  TriMesh release() { return mesh_.release(); }
  RefineStats stats() const { return stats_; }

 private:
  void await(VertexId v) {
    if (v < mesh_.inputVertices() || waits_[v] || !mesh_.isLiveVertex(v)) return;
    waits_[v] = true;
    queue_.push_back(v);
  }

  void awaitTouched() {
    for (const TriId t : touched_)
      if (mesh_.isLive(t))
        for (const VertexId v : mesh_.triangle(t).v) await(v);
    touched_.clear();
  }

  bool isGood(VertexId a, VertexId b, VertexId c) const {
    return !isBad(mesh_.point(a), mesh_.point(b), mesh_.point(c), bound_);
  }

  // The edge from v to the origin of the first edge of its star, and so on round it.
  EdgeRef spokeBefore(EdgeRef opposite) const { return edgeRef(triOf(opposite), prev3(indexOf(opposite))); }
  EdgeRef spokeAfter(EdgeRef opposite) const { return edgeRef(triOf(opposite), next3(indexOf(opposite))); }

  bool removeVertex(VertexId v) {
    const bool closed = mesh_.star(v, star_);
    patch_.triangles.clear();
    patch_.rim.clear();
    inner_.clear();
    for (const EdgeRef e : star_) {
      patch_.triangles.push_back(triOf(e));
      patch_.rim.push_back({mesh_.origin(e), mesh_.target(e), mesh_.twin(e), mesh_.segment(e)});
    }
    if (mesh_.kind(v) == VertexKind::Free) {
      if (!fillHole(0, star_.size())) return false;
      all_fresh_ = fresh_;
    } else if (!closed) {
      // At the rim: the two subsegments become the last side of the hole.
      const SegmentId seg = mesh_.segment(spokeBefore(star_.front()));
      if (seg == kNone || mesh_.segment(spokeAfter(star_.back())) != seg || star_.size() < 2) return false;
      if (!fillHole(0, star_.size())) return false;
      all_fresh_ = fresh_;
      patch_.rim.push_back({patch_.rim.back().b, patch_.rim.front().a, kNone, seg});
    } else {
      // Inside the mesh: one hole on either side of the segment.
      std::size_t first = star_.size(), second = star_.size();
      for (std::size_t i = 0; i < star_.size(); ++i) {
        if (mesh_.segment(spokeBefore(star_[i])) == kNone) continue;
        (first == star_.size() ? first : second) = i;
      }
      if (second == star_.size() || second - first < 2 || star_.size() - second + first < 2) return false;
      inner_.push_back({patch_.rim[first].a, patch_.rim[second].a, kNone, mesh_.segment(spokeBefore(star_[first]))});
      if (!fillHole(first, second)) return false;
      all_fresh_ = fresh_;
      std::ranges::rotate(patch_.rim, patch_.rim.begin() + static_cast<std::ptrdiff_t>(second));
      if (!fillHole(0, star_.size() - (second - first))) return false;
      all_fresh_.insert(all_fresh_.end(), fresh_.begin(), fresh_.end());
    }
    mesh_.replace(patch_, all_fresh_, {&v, 1}, touched_, inner_);
    mesh_.restoreDelaunay(touched_);
    ++stats_.removals;
    return true;
  }

  // Triangulates the polygon of the rim edges first..last, closed by a straight edge where they are not closed
  // themselves.
  bool fillHole(std::size_t first, std::size_t last) {
    polygon_.clear();
    for (std::size_t i = first; i < last; ++i) polygon_.push_back(patch_.rim[i].a);
    if (patch_.rim[last - 1].b != polygon_.front()) polygon_.push_back(patch_.rim[last - 1].b);
    if (static_cast<double>(polygon_.size()) * bound_.min_angle > kMostTurn) return false;
    if (!triangulatePolygon(mesh_, polygon_, fresh_)) return false;
    return std::ranges::all_of(fresh_, [this](const Corners& c) { return isGood(c[0], c[1], c[2]); });
  }

  bool mergeWithNeighbour(VertexId v) {
    mesh_.star(v, star_);
    neighbours_.clear();
    for (const EdgeRef e : star_) neighbours_.push_back(mesh_.origin(e));
    if (const VertexId last = mesh_.target(star_.back()); last != neighbours_.front()) neighbours_.push_back(last);
    for (const VertexId w : neighbours_) {
      if (mesh_.kind(w) == VertexKind::Input) continue;
      const bool v_on = mesh_.kind(v) == VertexKind::Segment, w_on = mesh_.kind(w) == VertexKind::Segment;
      // The vertex that stays is the one on the segment.
      if (v_on && !w_on ? merge(w, v) : merge(v, w)) return true;
    }
    return false;
  }

  // Gathers what is round `v`, without the triangles of `other`, into patch, link and spokes.
  void gather(VertexId v, VertexId other, VertexId stays) {
    const bool closed = mesh_.star(v, star_);
    for (const EdgeRef e : star_) {
      const VertexId a = mesh_.origin(e), b = mesh_.target(e);
      const bool shared = a == other || b == other;
      if (!shared || v == stays) patch_.triangles.push_back(triOf(e));
      if (!shared) patch_.rim.push_back({a, b, mesh_.twin(e), mesh_.segment(e)});
      const SegmentId seg = mesh_.segment(spokeBefore(e));
      if (a != other && seg != kNone) {
        inner_.push_back({stays, a, kNone, seg});
        if (mesh_.twin(spokeBefore(e)) == kNone) outer_.push_back({stays, a, kNone, seg});
      }
    }
    if (closed) return;
    const EdgeRef last = spokeAfter(star_.back());
    if (mesh_.origin(last) == other) return;
    inner_.push_back({stays, mesh_.origin(last), kNone, mesh_.segment(last)});
    outer_.push_back({mesh_.origin(last), stays, kNone, mesh_.segment(last)});
  }

  bool merge(VertexId goes, VertexId stays) {
    const bool on_segment = mesh_.kind(stays) == VertexKind::Segment;
    patch_.triangles.clear();
    patch_.rim.clear();
    inner_.clear();
    outer_.clear();
    gather(goes, stays, stays);
    const std::size_t own = patch_.rim.size();
    gather(stays, goes, stays);
    if (static_cast<double>(patch_.rim.size()) * bound_.min_angle > kMostTurn) return false;
    // Link condition: the two stars share the two corners beside their edge and no others.
    std::size_t common = 0;
    for (std::size_t i = own; i < patch_.rim.size(); ++i)
      for (std::size_t j = 0; j < own; ++j) common += patch_.rim[i].a == patch_.rim[j].b;
    if (common > 1) return false;
    link_.clear();
    for (const RimEdge& r : patch_.rim) link_.push_back({mesh_.point(r.a), mesh_.point(r.b)});
    std::optional<Point> place;
    if (!on_segment) {
      place = region_.findPoint(link_, bound_);
    } else {
      // Between the two neighbours along one segment.
      if (inner_.size() != 2 || inner_[0].seg != inner_[1].seg) return false;
      const Point &sa = pslg_.points[pslg_.segments[inner_[0].seg].a],
                  &sb = pslg_.points[pslg_.segments[inner_[0].seg].b];
      place = FeasibleRegion::findPointBetween(mesh_.point(otherEnd(inner_[0], stays)),
                                               mesh_.point(otherEnd(inner_[1], stays)), link_, bound_);
      if (place) place = sa + (dot(*place - sa, sb - sa) / squaredDistance(sa, sb)) * (sb - sa);
    }
    if (!place) return false;
    for (const LinkEdge& e : link_)
      if (orient2d(e.x, e.y, *place) <= 0 || isBad(e.x, e.y, *place, bound_)) return false;
    all_fresh_.clear();
    for (const RimEdge& r : patch_.rim) all_fresh_.push_back({stays, r.a, r.b});
    mesh_.setPoint(stays, *place);
    patch_.rim.insert(patch_.rim.end(), outer_.begin(), outer_.end());
    mesh_.replace(patch_, all_fresh_, {&goes, 1}, touched_, inner_);
    mesh_.restoreDelaunay(touched_);
    ++stats_.merges;
    return true;
  }

  static VertexId otherEnd(const RimEdge& r, VertexId v) { return r.a == v ? r.b : r.a; }

  static constexpr double kMostTurn = 2.0 * std::numbers::pi;

  const Pslg& pslg_;
  TriangleBound bound_;
  EditMesh mesh_;
  RefineStats stats_;
  FeasibleRegion region_;
  std::deque<VertexId> queue_;
  std::vector<bool> waits_;

  // Scratch.
  std::vector<TriId> touched_;
  std::vector<EdgeRef> star_;
  std::vector<VertexId> neighbours_;
  std::vector<VertexId> polygon_;
  std::vector<Corners> fresh_, all_fresh_;
  std::vector<RimEdge> inner_, outer_;
  std::vector<LinkEdge> link_;
  Patch patch_;
};

}  // namespace

RefineStats shrink(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, const RunControl& control) {
  Shrinker shrinker(std::move(mesh), pslg, options);
  shrinker.run(control);
  mesh = shrinker.release();
  labelRegions(mesh, pslg);
  RefineStats stats = shrinker.stats();
  stats.unresolved = findShortfalls(mesh, options);
  return stats;
}

}  // namespace coastmesh
