#include "core/refine/exchange_diagonal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/predicates.hpp"
#include "core/refine/triangle_cost.hpp"

namespace coastmesh {

namespace {

// Turns of the four corners; further ones move them by less than a hundredth of an edge.
constexpr int kTurns = 10;
// What follows makes good more than this.
constexpr double kMostCost = 1.1;

}  // namespace

Point DiagonalExchange::placeOf(VertexId v) const {
  for (const Moved& moved : moved_)
    if (moved.vertex == v) return moved.place;
  return frame_.to(mesh_.point(v));
}

Point DiagonalExchange::inPlane(VertexId v) const {
  for (const Moved& moved : moved_)
    if (moved.vertex == v) return frame_.from(moved.place);
  return mesh_.point(v);
}

double DiagonalExchange::costBefore() const {
  double sum = 0.0;
  for (const TriId t : patch_.triangles) {
    const Corners& v = mesh_.triangle(t).v;
    const auto seen = [&](VertexId u) { return frame_.to(mesh_.point(u)); };
    sum += costOf(seen(v[0]), seen(v[1]), seen(v[2]), wantedIn(v));
  }
  return sum;
}

// Infinite where a bound is broken.
double DiagonalExchange::costAfter() const {
  double sum = 0.0;
  for (const Corners& v : fresh_) {
    const Point a = inPlane(v[0]), b = inPlane(v[1]), c = inPlane(v[2]);
    if (orient2d(a, b, c) <= 0 || isBad(a, b, c, bound_)) return std::numeric_limits<double>::infinity();
    sum += costOf(placeOf(v[0]), placeOf(v[1]), placeOf(v[2]), wantedIn(v));
  }
  return sum;
}

// Moves each of the four to the weighted mean of the centroids round it, in turns.
void DiagonalExchange::relax() {
  for (int turn = 0; turn < kTurns; ++turn) {
    for (Moved& moved : moved_) {
      Point sum;
      double weight = 0.0;
      for (const Corners& v : fresh_) {
        const auto at = std::ranges::find(v, moved.vertex);
        if (at == v.end()) continue;
        const Point a = placeOf(v[0]), b = placeOf(v[1]), c = placeOf(v[2]);
        const double size = wantedIn(v);
        const double own = std::abs(cross(b - a, c - a)) / (size * size);
        sum = sum + own * (centroid(a, b, c) - moved.place);
        weight += own;
      }
      if (weight > 0.0) moved.place = moved.place + (1.0 / weight) * sum;
    }
  }
}

bool DiagonalExchange::isDelaunay() const {
  for (std::size_t i = 0; i < fresh_.size(); ++i) {
    for (unsigned k = 0; k < 3; ++k) {
      const VertexId a = fresh_[i][k], b = fresh_[i][next3(k)];
      const Point pa = inPlane(a), pb = inPlane(b), pc = inPlane(fresh_[i][prev3(k)]);
      const auto outer =
          std::ranges::find_if(patch_.boundary, [&](const BoundaryEdge& r) { return r.a == a && r.b == b; });
      if (outer != patch_.boundary.end()) {
        if (outer->seg != kNone || outer->beyond == kNone) continue;
        if (inCircle(pa, pb, pc, mesh_.point(mesh_.apex(outer->beyond))) > 0) return false;
        continue;
      }
      for (std::size_t j = i + 1; j < fresh_.size(); ++j)
        for (unsigned m = 0; m < 3; ++m)
          if (fresh_[j][m] == b && fresh_[j][next3(m)] == a && inCircle(pa, pb, pc, inPlane(fresh_[j][prev3(m)])) > 0)
            return false;
    }
  }
  return true;
}

bool DiagonalExchange::tryExchange(VertexId v, VertexId w, VertexId c, VertexId d, std::vector<TriId>& touched) {
  const std::array<VertexId, 4> corners{v, w, c, d};
  if (!mesh_.gatherPatch(corners, patch_)) return false;
  if (std::ranges::any_of(patch_.boundary,
                          [&](const BoundaryEdge& r) { return r.seg == kFrozen || ops_.isBadBeyond(r.beyond); }))
    return false;
  frame_ = Frame(bound_.surface, mesh_.point(v));
  for (std::size_t i = 0; i < corners.size(); ++i) moved_[i] = {corners[i], frame_.to(mesh_.point(corners[i]))};
  fresh_.clear();
  for (const TriId t : patch_.triangles) {
    const Corners& k = mesh_.triangle(t).v;
    if (std::ranges::count(k, v) + std::ranges::count(k, w) < 2) fresh_.push_back(k);
  }
  fresh_.push_back({c, v, d});
  fresh_.push_back({d, w, c});
  relax();
  if (!(costAfter() < kMostCost * costBefore()) || !isDelaunay()) return false;
  for (const Moved& moved : moved_) mesh_.setPoint(moved.vertex, frame_.from(moved.place));
  mesh_.replace(patch_, fresh_, {}, touched);
  return true;
}

}  // namespace coastmesh
