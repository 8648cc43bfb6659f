#include "core/optimise/exchange_diagonal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/optimise/triangle_cost.hpp"
#include "core/predicates.hpp"

namespace coastmesh {

namespace {

// Passes over the four corners; further ones move them by less than a hundredth of an edge.
constexpr int kTurns = 6;
// Largest ratio of costs after and before; later moves gain more.
constexpr double kMostCost = 1.1;

}  // namespace

std::uint32_t DiagonalExchange::numberOf(VertexId v) {
  const auto at = std::ranges::find(vertices_, v);
  const auto number = static_cast<std::uint32_t>(at - vertices_.begin());
  if (at == vertices_.end()) {
    vertices_.push_back(v);
    in_plane_.push_back(mesh_.point(v));
    seen_.push_back(frame_.to(mesh_.point(v)));
  }
  return number;
}

void DiagonalExchange::number() {
  numbered_.clear();
  for (std::vector<std::uint32_t>& around : around_) around.clear();
  for (const Corners& v : fresh_) {
    const auto at = static_cast<std::uint32_t>(numbered_.size());
    numbered_.push_back({numberOf(v[0]), numberOf(v[1]), numberOf(v[2])});
    for (const std::uint32_t n : numbered_.back())
      if (n < kMoved) around_[n].push_back(at);
  }
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

// Infinite if a bound is violated.
double DiagonalExchange::costAfter() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < fresh_.size(); ++i) {
    const Corners& n = numbered_[i];
    const Point &a = in_plane_[n[0]], &b = in_plane_[n[1]], &c = in_plane_[n[2]];
    if (orient2d(a, b, c) <= 0 || isBad(a, b, c, bound_)) return std::numeric_limits<double>::infinity();
    sum += costOf(seen_[n[0]], seen_[n[1]], seen_[n[2]], wantedIn(fresh_[i]));
  }
  return sum;
}

// Moves each of the four in turn to the weighted mean of the centroids around it.
void DiagonalExchange::relax() {
  for (int turn = 0; turn < kTurns; ++turn) {
    for (std::uint32_t moved = 0; moved < kMoved; ++moved) {
      Point& place = seen_[moved];
      Point sum;
      double weight = 0.0;
      for (const std::uint32_t i : around_[moved]) {
        const Corners& n = numbered_[i];
        const Point &a = seen_[n[0]], &b = seen_[n[1]], &c = seen_[n[2]];
        const double size = wantedIn(fresh_[i]);
        const double own = std::abs(cross(b - a, c - a)) / (size * size);
        sum = sum + own * (centroid(a, b, c) - place);
        weight += own;
      }
      if (weight > 0.0) place = place + (1.0 / weight) * sum;
    }
  }
  for (std::uint32_t moved = 0; moved < kMoved; ++moved) in_plane_[moved] = frame_.from(seen_[moved]);
}

bool DiagonalExchange::isDelaunay() const {
  for (std::size_t i = 0; i < fresh_.size(); ++i) {
    for (unsigned k = 0; k < 3; ++k) {
      const VertexId a = fresh_[i][k], b = fresh_[i][next3(k)];
      const Corners& n = numbered_[i];
      const Point &pa = in_plane_[n[k]], &pb = in_plane_[n[next3(k)]], &pc = in_plane_[n[prev3(k)]];
      const auto outer =
          std::ranges::find_if(patch_.boundary, [&](const BoundaryEdge& r) { return r.a == a && r.b == b; });
      if (outer != patch_.boundary.end()) {
        if (outer->seg != kNone || outer->beyond == kNone) continue;
        if (inCircle(pa, pb, pc, mesh_.point(mesh_.apex(outer->beyond))) > 0) return false;
        continue;
      }
      for (std::size_t j = i + 1; j < fresh_.size(); ++j)
        for (unsigned m = 0; m < 3; ++m)
          if (fresh_[j][m] == b && fresh_[j][next3(m)] == a &&
              inCircle(pa, pb, pc, in_plane_[numbered_[j][prev3(m)]]) > 0)
            return false;
    }
  }
  return true;
}

bool DiagonalExchange::tryExchange(VertexId v, VertexId w, VertexId c, VertexId d, std::vector<TriId>& touched) {
  const std::array<VertexId, kMoved> corners{v, w, c, d};
  if (!mesh_.gatherPatch(corners, patch_)) return false;
  if (std::ranges::any_of(patch_.boundary,
                          [&](const BoundaryEdge& r) { return r.seg == kFrozen || ops_.isBadBeyond(r.beyond); }))
    return false;
  frame_ = Frame(bound_.surface, mesh_.point(v));
  vertices_.clear();
  seen_.clear();
  in_plane_.clear();
  for (const VertexId corner : corners) numberOf(corner);
  fresh_.clear();
  for (const TriId t : patch_.triangles) {
    const Corners& k = mesh_.triangle(t).v;
    if (std::ranges::count(k, v) + std::ranges::count(k, w) < 2) fresh_.push_back(k);
  }
  fresh_.push_back({c, v, d});
  fresh_.push_back({d, w, c});
  number();
  relax();
  if (!(costAfter() < kMostCost * costBefore()) || !isDelaunay()) return false;
  for (std::uint32_t moved = 0; moved < kMoved; ++moved) mesh_.setPoint(corners[moved], in_plane_[moved]);
  mesh_.replace(patch_, fresh_, {}, touched);
  return true;
}

}  // namespace coastmesh
