#include "gis/repair_target.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "core/predicates.hpp"
#include "core/quality.hpp"
#include "gis/error.hpp"
#include "gis/geodesy.hpp"
#include "gis/grid_edit.hpp"
#include "gis/local_plane.hpp"
#include "gis/rim_boundaries.hpp"
#include "gis/target_limits.hpp"

namespace coastmesh {
namespace {

constexpr int kMostRounds = 40;
constexpr double kMoveApart = 0.05;  // of the way into the fan of triangles that gets a node of its own

using Corners = GridCorners;

NodePair keyOf(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

// The rim's edges and what they are.
using RimKinds = std::map<NodePair, RimKind>;

// A triangle of the part that is looked at, and the grid's triangle that it is, or is cut from.
struct PatchTriangle {
  Corners v{};
  std::uint32_t slot = kNone;  // kNone for a new one
  std::uint32_t source = kNone;
};

// What an edit leaves of a patch: fewer defects are better, then a larger smallest angle.
struct Score {
  int defects = 0;
  double min_angle = 0.0;

  bool betterThan(const Score& other) const {
    return defects != other.defects ? defects < other.defects : min_angle > other.min_angle;
  }
};

std::string metres(double length) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g", length);
  return text;
}

class Repairer {
 public:
  Repairer(Grid& grid, std::span<const Target> targets) : grid_(grid), targets_(targets.begin(), targets.end()) {}

  RepairReport run() {
    for (int round = 0; round < kMostRounds; ++round) {
      const auto defects = findDefects();
      if (defects.empty()) break;
      requireNoWeirs();
      if (round == 0) takeKinds();
      if (!mend(defects)) break;
    }
    if (grid_.triangles.empty())
      throw InputError(std::string("no triangle is left once those that ") +
                       kTargetNames[static_cast<std::size_t>(targets_.front())] +
                       " refuses are taken out: each stood alone; a smaller --size-max makes more of them");
    for (auto& [target, defect] : findDefects()) report_.left.emplace_back(target, std::move(defect));
    measureChanged();
    requireConsistent(grid_);
    return std::move(report_);
  }

 private:
  using Found = std::vector<std::pair<Target, TargetDefect>>;

  bool isFor(Target target) const { return std::ranges::count(targets_, target) > 0; }

  Found findDefects() const {
    Found found;
    for (const Target target : targets_)
      for (TargetDefect& defect : checkTarget(grid_, target)) found.emplace_back(target, std::move(defect));
    return found;
  }

  void requireNoWeirs() const {
    if (std::ranges::any_of(grid_.boundaries, [](const Boundary& boundary) { return !boundary.weir.empty(); }))
      throw InputError("the mesh has weirs and defects; mend these by hand, or take the weirs out");
  }

  void takeKinds() {
    changed_.assign(grid_.triangles.size(), false);
    const EdgeKinds told(grid_);
    link();
    for (TriId t = 0; t < mesh_.triangles.size(); ++t) {
      for (unsigned i = 0; i < 3; ++i) {
        if (mesh_.triangles[t].adj[i] != kNone) continue;
        const std::uint32_t a = mesh_.origin(edgeRef(t, i)), b = mesh_.target(edgeRef(t, i));
        const RimKind* const kind = told.find(a, b);
        RimKind made = kind != nullptr ? RimKind{kind->role, kind->ibtype} : RimKind{};
        if (made.role == BoundaryRole::Island) made.role = BoundaryRole::Land;
        kinds_[keyOf(a, b)] = made;
      }
    }
  }

  void link() {
    std::vector<EdgeConflict> conflicts;
    mesh_ = linkTriangles(grid_.nodes, grid_.triangles, conflicts);
    triangles_at_.assign(grid_.nodes.size(), {});
    for (std::uint32_t t = 0; t < grid_.triangles.size(); ++t)
      for (const std::uint32_t node : grid_.triangles[t]) triangles_at_[node].push_back(t);
    touched_.assign(grid_.triangles.size(), false);
    dead_.assign(grid_.triangles.size(), false);
    line_edges_.clear();
    for (const GridLine& line : grid_.lines)
      for (const auto& [a, b] : edgesOf({BoundaryRole::Land, line.closed, line.nodes})) line_edges_.insert(keyOf(a, b));
  }

  std::uint32_t featureOf(std::uint32_t t) const { return grid_.feature_of.empty() ? 0 : grid_.feature_of[t]; }

  // An inner edge that has to stay: it is part of a line, or features meet there.
  bool isFixed(std::uint32_t a, std::uint32_t b, std::uint32_t left, std::uint32_t right) const {
    return line_edges_.contains(keyOf(a, b)) || featureOf(left) != featureOf(right);
  }
  // The other ends of such edges at a node.
  std::set<std::uint32_t> fixedNeighbours(std::uint32_t node) const {
    std::set<std::uint32_t> fixed;
    std::map<std::uint32_t, std::uint32_t> triangle_at;  // one with the edge to a neighbour
    for (const std::uint32_t t : triangles_at_[node]) {
      for (const std::uint32_t other : grid_.triangles[t]) {
        if (other == node) continue;
        const std::uint32_t seen = triangle_at.try_emplace(other, t).first->second;
        if (isFixed(node, other, t, seen)) fixed.insert(other);
      }
    }
    return fixed;
  }

  void tell(TargetDefectKind kind, Target target, const Point& place, std::string what) {
    report_.repairs.push_back({kind, target, place, std::move(what)});
  }

  // Returns whether anything was done.
  bool mend(const Found& defects) {
    link();
    std::size_t before = report_.repairs.size();
    std::set<std::pair<TargetDefectKind, std::int64_t>> done;  // a defect that several models mind is mended once
    bool boundaries = false, unused = false;
    for (const auto& [target, defect] : defects) {
      const bool has_place = defect.node >= 0 || defect.triangle >= 0;
      const std::int64_t what = defect.triangle >= 0 ? defect.triangle : defect.node;
      if (has_place && !done.emplace(defect.kind, what).second) continue;
      switch (defect.kind) {
        case TargetDefectKind::WrongCount:
          tell(defect.kind, target, defect.place, "counted anew: " + defect.text);
          break;
        case TargetDefectKind::Clockwise:
          turn(static_cast<std::uint32_t>(defect.triangle), target);
          break;
        case TargetDefectKind::UnusedNode:
          unused = true;
          tell(defect.kind, target, defect.place, "node taken out");
          break;
        case TargetDefectKind::PinchedNode:
          splitPinch(static_cast<std::uint32_t>(defect.node), target);
          break;
        case TargetDefectKind::OrphanCell:
          removeOrphan(static_cast<std::uint32_t>(defect.triangle), target);
          break;
        case TargetDefectKind::LoneWall:
          openWall(static_cast<std::uint32_t>(defect.node), target);
          break;
        case TargetDefectKind::NoBoundary:
        case TargetDefectKind::BoundaryOffRim:
        case TargetDefectKind::BoundaryTwice:
        case TargetDefectKind::BoundaryTurned:
        case TargetDefectKind::LoopedBoundary:
        case TargetDefectKind::WrongShore:
          boundaries = true;
          pending_.emplace_back(target, defect);
          break;
        case TargetDefectKind::TwoOpenEdges:
        case TargetDefectKind::OpenAndSolid:
        case TargetDefectKind::LargeAngle:
        case TargetDefectKind::NotOrthogonal:
          reshape({static_cast<std::uint32_t>(defect.triangle)}, defect, target);
          break;
        case TargetDefectKind::Valence:
          mendValence(static_cast<std::uint32_t>(defect.node), defect, target);
          break;
        case TargetDefectKind::BrokenEdge:
        case TargetDefectKind::RepeatedNode:
        case TargetDefectKind::HangingNode:
        case TargetDefectKind::UnknownDepth:
        case TargetDefectKind::Courant:
          break;
      }
    }
    const bool changed = report_.repairs.size() > before;
    grid_.notes.clear();
    if (!changed && !boundaries) return false;
    if (changed || unused) compact();
    const auto old = grid_.boundaries.size();
    rebuildBoundaries();
    std::map<std::pair<Target, TargetDefectKind>, std::pair<std::size_t, Point>> by_kind;
    for (const auto& [target, defect] : pending_)
      ++by_kind.try_emplace({target, defect.kind}, 0, defect.place).first->second.first;
    for (const auto& [which, count] : by_kind)
      tell(which.second, which.first, count.second,
           "boundaries put together anew for " + std::to_string(count.first) + " of it: " + std::to_string(old) +
               " before, " + std::to_string(grid_.boundaries.size()) + " now");
    const bool again = changed || !boundaries_done_;
    boundaries_done_ = true;
    pending_.clear();
    return again;
  }

  void turn(std::uint32_t t, Target target) {
    Corners& corners = grid_.triangles[t];
    const std::vector<Point> p = localPlane(grid_, corners);
    if (orient2d(p[0], p[1], p[2]) == 0) return;
    std::swap(corners[1], corners[2]);
    tell(TargetDefectKind::Clockwise, target, grid_.nodes[corners[0]], "triangle turned");
  }

  // The triangles round a node in fans that share edges, the largest first.
  std::vector<std::vector<std::uint32_t>> fansAt(std::uint32_t node) const {
    std::vector<std::vector<std::uint32_t>> fans;
    std::set<std::uint32_t> left(triangles_at_[node].begin(), triangles_at_[node].end());
    while (!left.empty()) {
      std::vector<std::uint32_t>& fan = fans.emplace_back();
      fan.push_back(*left.begin());
      left.erase(left.begin());
      for (std::size_t k = 0; k < fan.size(); ++k) {
        for (unsigned i = 0; i < 3; ++i) {
          const EdgeRef twin = mesh_.triangles[fan[k]].adj[i];
          if (twin == kNone || mesh_.triangles[fan[k]].v[i] == node) continue;
          if (left.erase(triOf(twin)) > 0) fan.push_back(triOf(twin));
        }
      }
    }
    std::ranges::stable_sort(fans, std::greater(), [](const auto& fan) { return fan.size(); });
    return fans;
  }

  void splitPinch(std::uint32_t node, Target target) {
    if (std::ranges::any_of(triangles_at_[node], [&](std::uint32_t t) { return touched_[t] || dead_[t]; })) return;
    const auto fans = fansAt(node);
    for (std::size_t f = 1; f < fans.size(); ++f) {
      const Point place = grid_.nodes[node];
      std::vector<Point> corners;
      for (const std::uint32_t t : fans[f])
        for (const std::uint32_t corner : grid_.triangles[t]) corners.push_back(grid_.nodes[corner]);
      const std::uint32_t twin = detachTriangles(
          grid_, node, fans[f], placeBetween(grid_.crs, place, meanPlace(grid_.crs, corners), kMoveApart));
      for (const std::uint32_t t : fans[f]) {
        for (unsigned i = 0; i < 3; ++i) {
          const std::uint32_t a = mesh_.origin(edgeRef(t, i)), b = mesh_.target(edgeRef(t, i));
          if (mesh_.triangles[t].adj[i] != kNone || (a != node && b != node)) continue;
          const std::uint32_t other = a == node ? b : a;
          kinds_[keyOf(twin, other)] = kinds_[keyOf(node, other)];
          kinds_.erase(keyOf(node, other));
        }
      }
      const std::vector<Point> plane = localPlane(grid_.crs, std::array{place, grid_.nodes[twin]});
      tell(TargetDefectKind::PinchedNode, target, place,
           "node doubled, and moved apart by " + metres(std::hypot(plane[1].x - plane[0].x, plane[1].y - plane[0].y)) +
               (grid_.crs.geographic ? " m" : ""));
    }
    for (const std::uint32_t t : triangles_at_[node]) touched_[t] = changed_[t] = true;
  }

  void removeOrphan(std::uint32_t t, Target target) {
    if (touched_[t] || grid_.triangles.size() < 2) return;
    touched_[t] = dead_[t] = true;
    for (unsigned i = 0; i < 3; ++i) kinds_.erase(keyOf(grid_.triangles[t][i], grid_.triangles[t][next3(i)]));
    tell(TargetDefectKind::OrphanCell, target, grid_.nodes[grid_.triangles[t][0]], "triangle taken out");
  }

  // The solid edge of the rim that starts at the node becomes like the opening before it.
  void openWall(std::uint32_t node, Target target) {
    const auto isChanged = [&](std::uint32_t t) { return touched_[t] || dead_[t]; };
    if (std::ranges::any_of(triangles_at_[node], isChanged)) return;
    for (const std::uint32_t t : triangles_at_[node]) {
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(t, i);
        if (mesh_.triangles[t].adj[i] != kNone || mesh_.origin(e) != node) continue;
        RimKind opening{BoundaryRole::Open};
        for (const auto& [edge, kind] : kindsAt(node))
          if (kind.role == BoundaryRole::Open || kind.role == BoundaryRole::River) opening = kind;
        kinds_[keyOf(node, mesh_.target(e))] = opening;
        tell(TargetDefectKind::LoneWall, target, grid_.nodes[node], "solid edge between openings opened");
        return;
      }
    }
  }

  std::vector<std::pair<NodePair, RimKind>> kindsAt(std::uint32_t node) const {
    std::vector<std::pair<NodePair, RimKind>> found;
    for (const std::uint32_t t : triangles_at_[node])
      for (const std::uint32_t other : grid_.triangles[t])
        if (const auto at = kinds_.find(keyOf(node, other)); other != node && at != kinds_.end()) found.push_back(*at);
    return found;
  }

  // --- Flips and splits, tried on a part of the mesh. ---

  struct Patch {
    std::vector<PatchTriangle> triangles;
    RimKinds halves;             // edges of the rim that splitting made
    std::vector<NodePair> gone;  // and the one it split
    Point fresh{};               // of the node that is to be added, which has the number after the grid's last
  };

  std::vector<Point> planeOf(const Patch& patch, std::span<const std::uint32_t> nodes) const {
    std::vector<Point> places;
    for (const std::uint32_t node : nodes)
      places.push_back(node < grid_.nodes.size() ? grid_.nodes[node] : patch.fresh);
    return localPlane(grid_.crs, places);
  }

  Patch patchRound(const std::vector<std::uint32_t>& middle) const {
    std::set<std::uint32_t> members;
    for (const std::uint32_t t : middle)
      for (const std::uint32_t node : grid_.triangles[t])
        members.insert(triangles_at_[node].begin(), triangles_at_[node].end());
    Patch patch;
    for (const std::uint32_t t : members) patch.triangles.push_back({grid_.triangles[t], t, t});
    return patch;
  }

  const RimKind* kindOf(const Patch& patch, std::uint32_t a, std::uint32_t b) const {
    const NodePair key = keyOf(a, b);
    if (const auto half = patch.halves.find(key); half != patch.halves.end()) return &half->second;
    if (std::ranges::count(patch.gone, key) > 0) return nullptr;
    const auto at = kinds_.find(key);
    return at == kinds_.end() ? nullptr : &at->second;
  }

  Score scoreOf(const Patch& patch, const Patch& before) const {
    Score score{0, 180.0};
    std::map<NodePair, std::vector<std::uint32_t>> apexes;
    for (const PatchTriangle& triangle : patch.triangles) {
      const std::vector<Point> p = planeOf(patch, triangle.v);
      if (orient2d(p[0], p[1], p[2]) <= 0) return {std::numeric_limits<int>::max(), 0.0};
      const auto angles = anglesDeg(p[0], p[1], p[2]);
      score.min_angle = std::min(score.min_angle, std::ranges::min(angles));
      if (isFor(Target::Swan)) score.defects += std::ranges::max(angles) > kSwanLargestAngleDeg;
      int open = 0, solid = 0;
      for (unsigned i = 0; i < 3; ++i) {
        const std::uint32_t a = triangle.v[next3(i)], b = triangle.v[prev3(i)];
        apexes[keyOf(a, b)].push_back(triangle.v[i]);
        const RimKind* const kind = kindOf(patch, a, b);
        if (kind != nullptr) ++(kind->role == BoundaryRole::Open ? open : solid);
      }
      if (isFor(Target::Fvcom)) score.defects += (open > 1 ? 1 : 0) + (open > 0 && solid > 0 ? 1 : 0);
      score.defects += open + solid == 3;
    }
    if (isFor(Target::Dflowfm)) {
      for (const auto& [edge, ends] : apexes) {
        if (ends.size() != 2) continue;
        const std::array<std::uint32_t, 4> nodes{edge[0], edge[1], ends[0], ends[1]};
        std::vector<Point> p = planeOf(patch, nodes);
        if (orient2d(p[0], p[1], p[2]) < 0) std::swap(p[0], p[1]);
        score.defects += orthogonality(p[0], p[1], p[2], p[3]) > kDflowfmLargestCosine;
      }
    }
    if (isFor(Target::Swan)) score.defects += badValences(patch, before);
    return score;
  }

  int badValences(const Patch& patch, const Patch& before) const {
    std::map<std::uint32_t, int> cells;
    const auto globalCells = [&](std::uint32_t node) {
      return node < triangles_at_.size() ? static_cast<int>(triangles_at_[node].size()) : 0;
    };
    for (const PatchTriangle& triangle : before.triangles)
      for (const std::uint32_t node : triangle.v) --cells.try_emplace(node, globalCells(node)).first->second;
    for (const PatchTriangle& triangle : patch.triangles)
      for (const std::uint32_t node : triangle.v) ++cells.try_emplace(node, globalCells(node)).first->second;
    std::set<std::uint32_t> on_rim;
    for (const PatchTriangle& triangle : patch.triangles)
      for (unsigned i = 0; i < 3; ++i)
        if (kindOf(patch, triangle.v[i], triangle.v[next3(i)]) != nullptr)
          on_rim.insert({triangle.v[i], triangle.v[next3(i)]});
    int bad = 0;
    for (const auto& [node, count] : cells) {
      const bool inner = !on_rim.contains(node) && (node >= triangles_at_.size() || kindsAt(node).empty());
      if (inner && count > 0) bad += std::max({0, kSwanFewestCells - count, count - kSwanMostCells});
    }
    return bad;
  }

  static std::optional<std::size_t> findEdge(const Patch& patch, std::uint32_t a, std::uint32_t b) {
    for (std::size_t k = 0; k < patch.triangles.size(); ++k)
      for (unsigned i = 0; i < 3; ++i)
        if (patch.triangles[k].v[i] == a && patch.triangles[k].v[next3(i)] == b) return k;
    return std::nullopt;
  }

  static std::uint32_t apexOf(const PatchTriangle& triangle, std::uint32_t a, std::uint32_t b) {
    return *std::ranges::find_if(triangle.v, [&](std::uint32_t node) { return node != a && node != b; });
  }

  std::optional<Patch> flipped(Patch patch, std::uint32_t a, std::uint32_t b) const {
    const auto left = findEdge(patch, a, b), right = findEdge(patch, b, a);
    if (!left || !right) return std::nullopt;
    if (isFixed(a, b, patch.triangles[*left].source, patch.triangles[*right].source)) return std::nullopt;
    const std::uint32_t c = apexOf(patch.triangles[*left], a, b), d = apexOf(patch.triangles[*right], a, b);
    patch.triangles[*left].v = {a, d, c};
    patch.triangles[*right].v = {d, b, c};
    return patch;
  }

  // The patch with a new node on the edge.
  Patch split(Patch patch, std::uint32_t a, std::uint32_t b, double share) const {
    const auto middle = static_cast<std::uint32_t>(grid_.nodes.size());
    patch.fresh = placeBetween(grid_.crs, grid_.nodes[a], grid_.nodes[b], share);
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      const auto side = findEdge(patch, from, to);
      if (!side) continue;
      const std::uint32_t apex = apexOf(patch.triangles[*side], from, to);
      patch.triangles.push_back({{middle, to, apex}, kNone, patch.triangles[*side].source});
      patch.triangles[*side].v = {from, middle, apex};
    }
    if (const RimKind* const kind = kindOf(patch, a, b)) {
      const RimKind half = *kind;
      patch.halves[keyOf(a, middle)] = patch.halves[keyOf(middle, b)] = half;
      patch.gone.push_back(keyOf(a, b));
    }
    return patch;
  }

  // The nodes round an inner node, counter-clockwise; empty where they do not close.
  std::vector<std::uint32_t> ringRound(std::uint32_t node) const {
    std::map<std::uint32_t, std::uint32_t> next;
    for (const std::uint32_t t : triangles_at_[node]) {
      const Corners& v = grid_.triangles[t];
      const auto k = static_cast<unsigned>(std::ranges::find(v, node) - v.begin());
      next[v[next3(k)]] = v[prev3(k)];
    }
    std::vector<std::uint32_t> ring{next.begin()->first};
    while (ring.size() < next.size() && next.contains(ring.back())) ring.push_back(next[ring.back()]);
    const bool closes = next.contains(ring.back()) && next[ring.back()] == ring.front();
    return closes ? ring : std::vector<std::uint32_t>();
  }

  // Too many triangles round a node: half of them get a node of their own, between it and their other ends.
  void splitNode(std::uint32_t node, const TargetDefect& defect, Target target) {
    const auto isChanged = [&](std::uint32_t t) { return touched_[t] || dead_[t]; };
    if (std::ranges::any_of(triangles_at_[node], isChanged)) return;
    const std::vector<std::uint32_t> ring = ringRound(node);
    const Patch before = patchRound(triangles_at_[node]);
    const auto isTaken = [&](const PatchTriangle& triangle) { return touched_[triangle.slot] || dead_[triangle.slot]; };
    if (ring.size() < 8 || std::ranges::any_of(before.triangles, isTaken)) return;
    const std::size_t n = ring.size(), half = n / 2;
    const auto fresh = static_cast<std::uint32_t>(grid_.nodes.size());
    const Point place = grid_.nodes[node];
    Score best = scoreOf(before, before);
    const int defects_before = best.defects;
    std::optional<Patch> chosen;
    const std::set<std::uint32_t> fixed = fixedNeighbours(node);
    for (std::size_t first = 0; first < n; ++first) {
      // From `first` on, `half` triangles go to the new node.
      std::vector<Point> places;
      std::set<NodePair> moved;
      bool moves_fixed = false;
      for (std::size_t k = 0; k <= half; ++k) {
        places.push_back(grid_.nodes[ring[(first + k) % n]]);
        if (k < half) moved.insert({ring[(first + k) % n], ring[(first + k + 1) % n]});
        moves_fixed = moves_fixed || (k > 0 && k < half && fixed.contains(ring[(first + k) % n]));
      }
      if (moves_fixed) continue;
      const Point middle = meanPlace(grid_.crs, places);
      Patch patch = before;
      std::uint32_t source = kNone;
      for (PatchTriangle& triangle : patch.triangles) {
        const auto at = std::ranges::find(triangle.v, node);
        if (at == triangle.v.end()) continue;
        const auto k = static_cast<unsigned>(at - triangle.v.begin());
        if (!moved.contains({triangle.v[next3(k)], triangle.v[prev3(k)]})) continue;
        *at = fresh;
        source = triangle.source;
      }
      patch.triangles.push_back({{node, ring[first], fresh}, kNone, source});
      patch.triangles.push_back({{node, fresh, ring[(first + half) % n]}, kNone, source});
      for (const double share : {0.3, 0.5, 0.7}) {
        patch.fresh = placeBetween(grid_.crs, place, middle, share);
        const Score score = scoreOf(patch, before);
        if (score.defects >= defects_before || (chosen && !score.betterThan(best))) continue;
        best = score;
        chosen = patch;
      }
    }
    if (!chosen) return;
    copyNode(grid_, node, chosen->fresh);
    put(*chosen);
    tell(defect.kind, target, defect.place, "node split in two");
  }

  void reshape(const std::vector<std::uint32_t>& middle, const TargetDefect& defect, Target target) {
    std::set<std::uint32_t> concerned(middle.begin(), middle.end());
    for (const std::uint32_t t : middle)
      for (const EdgeRef twin : mesh_.triangles[t].adj)
        if (twin != kNone) concerned.insert(triOf(twin));
    const std::vector<std::uint32_t> inside(concerned.begin(), concerned.end());
    const auto isChanged = [&](std::uint32_t t) { return touched_[t] || dead_[t]; };
    if (std::ranges::any_of(inside, isChanged)) return;
    const Patch before = patchRound(inside);
    const auto isTaken = [&](const PatchTriangle& triangle) { return touched_[triangle.slot] || dead_[triangle.slot]; };
    if (std::ranges::any_of(before.triangles, isTaken)) return;  // in another round
    std::set<NodePair> edges;
    for (const std::uint32_t t : inside)
      for (unsigned i = 0; i < 3; ++i) edges.insert(keyOf(grid_.triangles[t][i], grid_.triangles[t][next3(i)]));

    Score best = scoreOf(before, before);
    const int defects_before = best.defects;
    std::optional<Patch> chosen;
    NodePair edge{};
    std::optional<double> split_at;  // the share of the edge, none where it is flipped
    const auto consider = [&](const Patch& patch, const NodePair& at_edge, std::optional<double> share) {
      const Score score = scoreOf(patch, before);
      if (score.defects >= defects_before || (chosen && !score.betterThan(best))) return;
      best = score;
      chosen = patch;
      edge = at_edge;
      split_at = share;
    };
    for (const auto& [a, b] : edges) {
      if (const auto patch = flipped(before, a, b)) consider(*patch, {a, b}, std::nullopt);
      for (const double share : {0.5, 0.4, 0.6, 0.3, 0.7}) consider(split(before, a, b, share), {a, b}, share);
    }
    if (!chosen) return;
    if (split_at) splitEdge(edge[0], edge[1], *split_at);
    put(*chosen);
    tell(defect.kind, target, defect.place, split_at ? "edge split" : "edge flipped");
  }

  void splitEdge(std::uint32_t a, std::uint32_t b, double share) {
    const std::uint32_t middle = addNodeBetween(grid_, a, b, share);
    if (line_edges_.erase(keyOf(a, b)) > 0) line_edges_.insert({keyOf(a, middle), keyOf(middle, b)});
  }

  void put(const Patch& patch) {
    for (const NodePair& edge : patch.gone) kinds_.erase(edge);
    for (const auto& [edge, kind] : patch.halves) kinds_[edge] = kind;
    for (const PatchTriangle& triangle : patch.triangles) {
      if (triangle.slot == kNone) {
        copyTriangle(grid_, triangle.source, triangle.v);
        changed_.push_back(true);
        touched_.push_back(true);
        dead_.push_back(false);
        continue;
      }
      touched_[triangle.slot] = true;
      if (grid_.triangles[triangle.slot] == triangle.v) continue;
      grid_.triangles[triangle.slot] = triangle.v;
      changed_[triangle.slot] = true;
    }
  }

  void mendValence(std::uint32_t node, const TargetDefect& defect, Target target) {
    const std::vector<std::uint32_t>& round = triangles_at_[node];
    if (round.size() > 3) {
      const std::size_t before = report_.repairs.size();
      reshape(round, defect, target);
      if (report_.repairs.size() == before) splitNode(node, defect, target);
      return;
    }
    if (round.size() < 3 || !fixedNeighbours(node).empty()) return;
    if (std::ranges::any_of(round, [&](std::uint32_t t) { return touched_[t] || dead_[t]; })) return;
    Corners corners = grid_.triangles[round[0]];
    // What the other two have and the first has not takes the node's place.
    for (const std::uint32_t other : grid_.triangles[round[1]])
      if (std::ranges::count(corners, other) == 0) std::ranges::replace(corners, node, other);
    grid_.triangles[round[0]] = corners;
    for (const std::uint32_t t : round) touched_[t] = true;
    changed_[round[0]] = dead_[round[1]] = dead_[round[2]] = true;
    tell(defect.kind, target, defect.place, "node taken out");
  }

  // --- What remains. ---

  // Takes out dead triangles and nodes without triangles.
  void compact() {
    const std::vector<std::uint32_t> triangle_index = removeTriangles(grid_, dead_);
    std::vector<bool> changed(grid_.triangles.size(), false);
    for (std::size_t t = 0; t < changed_.size(); ++t)
      if (triangle_index[t] != kNone) changed[triangle_index[t]] = changed_[t];
    changed_ = std::move(changed);
    const std::vector<std::uint32_t> index = removeUnusedNodes(grid_);
    RimKinds kinds;
    for (const auto& [edge, kind] : kinds_)
      if (index[edge[0]] != kNone && index[edge[1]] != kNone) kinds[keyOf(index[edge[0]], index[edge[1]])] = kind;
    kinds_ = std::move(kinds);
  }

  void rebuildBoundaries() {
    const auto kindOfEdge = [&](std::uint32_t a, std::uint32_t b) {
      const auto at = kinds_.find(keyOf(a, b));
      return at == kinds_.end() ? RimKind{} : at->second;
    };
    grid_.boundaries = cutLoops(grid_.nodes, rimOf(grid_), kindOfEdge);
  }

  void measureChanged() {
    std::vector<Corners> corners;
    std::vector<std::size_t> which;
    for (std::size_t t = 0; t < changed_.size(); ++t) {
      if (!changed_[t]) continue;
      which.push_back(t);
      corners.push_back(grid_.triangles[t]);
      if (grid_.min_angle_deg.empty()) continue;
      const std::vector<Point> p = localPlane(grid_, grid_.triangles[t]);
      grid_.min_angle_deg[t] = std::ranges::min(anglesDeg(p[0], p[1], p[2]));
    }
    if (grid_.area_m2.empty() || which.empty()) return;
    const std::vector<double> areas = triangleAreas(grid_.nodes, corners, grid_.crs);
    for (std::size_t k = 0; k < which.size(); ++k) grid_.area_m2[which[k]] = areas[k];
  }

  Grid& grid_;
  std::vector<Target> targets_;
  RepairReport report_;
  TriMesh mesh_;
  std::vector<std::vector<std::uint32_t>> triangles_at_;
  std::vector<bool> touched_, dead_, changed_;
  RimKinds kinds_;
  std::set<NodePair> line_edges_;
  Found pending_;
  bool boundaries_done_ = false;
};

}  // namespace

RepairReport repairForTargets(Grid& grid, std::span<const Target> targets) { return Repairer(grid, targets).run(); }

}  // namespace coastmesh
