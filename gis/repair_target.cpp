#include "gis/repair_target.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <set>

#include "core/predicates.hpp"
#include "core/quality.hpp"
#include "gis/error.hpp"
#include "gis/geodesy.hpp"
#include "gis/grid_edit.hpp"
#include "gis/local_plane.hpp"
#include "gis/repair_patch.hpp"
#include "gis/repair_search.hpp"
#include "gis/rim_boundaries.hpp"

namespace coastmesh {
namespace {

constexpr int kMostRounds = 40;
constexpr double kMoveApart = 0.05;  // of the way into the fan of triangles that gets a node of its own

using Corners = GridCorners;

std::string metres(double length) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g", length);
  return text;
}

class Repairer {
 public:
  Repairer(Grid& grid, std::span<const Target> targets)
      : grid_(grid), targets_(targets), view_{grid, links_, targets} {}

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
    hopeless_triangles_ = disturbed_ = changed_;
    hopeless_nodes_.assign(grid_.nodes.size(), false);
    const EdgeKinds told(grid_);
    link();
    for (TriId t = 0; t < links_.mesh.triangles.size(); ++t) {
      for (unsigned i = 0; i < 3; ++i) {
        if (links_.mesh.triangles[t].adj[i] != kNone) continue;
        const std::uint32_t a = links_.mesh.origin(edgeRef(t, i)), b = links_.mesh.target(edgeRef(t, i));
        const RimKind* const kind = told.find(a, b);
        RimKind made = kind != nullptr ? RimKind{kind->role, kind->ibtype} : RimKind{};
        if (made.role == BoundaryRole::Island) made.role = BoundaryRole::Land;
        links_.kinds[edgeKey(a, b)] = made;
      }
    }
  }

  void link() {
    std::vector<EdgeConflict> conflicts;
    links_.mesh = linkTriangles(grid_.nodes, grid_.triangles, conflicts);
    links_.triangles_at.assign(grid_.nodes.size(), {});
    for (std::uint32_t t = 0; t < grid_.triangles.size(); ++t)
      for (const std::uint32_t node : grid_.triangles[t]) links_.triangles_at[node].push_back(t);
    forgetNear();
    touched_.assign(grid_.triangles.size(), false);
    disturbed_ = touched_;
    dead_.assign(grid_.triangles.size(), false);
    links_.on_boundary.assign(grid_.nodes.size(), false);
    for (const auto& [edge, kind] : links_.kinds) links_.on_boundary[edge[0]] = links_.on_boundary[edge[1]] = true;
    links_.line_edges.clear();
    for (const GridLine& line : grid_.lines)
      for (const auto& [a, b] : edgesOf({BoundaryRole::Land, line.closed, line.nodes}))
        links_.line_edges.insert(edgeKey(a, b));
  }

  // What was tried in vain as near to a change as an attempt looks is worth another.
  void forgetNear() {
    if (std::ranges::count(disturbed_, true) == 0) return;
    std::vector<bool> near(grid_.nodes.size(), false);
    for (std::size_t t = 0; t < disturbed_.size(); ++t)
      if (disturbed_[t])
        for (const std::uint32_t node : grid_.triangles[t]) near[node] = true;
    const auto isNear = [&near](const Corners& corners) {
      return std::ranges::any_of(corners, [&near](std::uint32_t node) { return near[node]; });
    };
    const auto grow = [&] {
      std::vector<bool> wider = near;
      for (const Corners& corners : grid_.triangles)
        if (isNear(corners))
          for (const std::uint32_t node : corners) wider[node] = true;
      near = std::move(wider);
    };
    grow();
    grow();
    for (std::size_t t = 0; t < grid_.triangles.size(); ++t)
      if (isNear(grid_.triangles[t])) hopeless_triangles_[t] = false;
    grow();
    for (std::size_t node = 0; node < near.size(); ++node)
      if (near[node]) hopeless_nodes_[node] = false;
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
          reshapeTriangle(static_cast<std::uint32_t>(defect.triangle), defect, target);
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
    disturbed_[t] = true;
    tell(TargetDefectKind::Clockwise, target, grid_.nodes[corners[0]], "triangle turned");
  }

  // The triangles round a node in fans that share edges, the largest first.
  std::vector<std::vector<std::uint32_t>> fansAt(std::uint32_t node) const {
    std::vector<std::vector<std::uint32_t>> fans;
    std::set<std::uint32_t> left(links_.triangles_at[node].begin(), links_.triangles_at[node].end());
    while (!left.empty()) {
      std::vector<std::uint32_t>& fan = fans.emplace_back();
      fan.push_back(*left.begin());
      left.erase(left.begin());
      for (std::size_t k = 0; k < fan.size(); ++k) {
        for (unsigned i = 0; i < 3; ++i) {
          const EdgeRef twin = links_.mesh.triangles[fan[k]].adj[i];
          if (twin == kNone || links_.mesh.triangles[fan[k]].v[i] == node) continue;
          if (left.erase(triOf(twin)) > 0) fan.push_back(triOf(twin));
        }
      }
    }
    std::ranges::stable_sort(fans, std::greater(), [](const auto& fan) { return fan.size(); });
    return fans;
  }

  void splitPinch(std::uint32_t node, Target target) {
    if (anyTaken(links_.triangles_at[node])) return;
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
          const std::uint32_t a = links_.mesh.origin(edgeRef(t, i)), b = links_.mesh.target(edgeRef(t, i));
          if (links_.mesh.triangles[t].adj[i] != kNone || (a != node && b != node)) continue;
          const std::uint32_t other = a == node ? b : a;
          links_.kinds[edgeKey(twin, other)] = links_.kinds[edgeKey(node, other)];
          links_.kinds.erase(edgeKey(node, other));
        }
      }
      const std::vector<Point> plane = localPlane(grid_.crs, std::array{place, grid_.nodes[twin]});
      tell(TargetDefectKind::PinchedNode, target, place,
           "node doubled, and moved apart by " + metres(std::hypot(plane[1].x - plane[0].x, plane[1].y - plane[0].y)) +
               (grid_.crs.geographic ? " m" : ""));
    }
    for (const std::uint32_t t : links_.triangles_at[node]) touched_[t] = changed_[t] = disturbed_[t] = true;
  }

  void removeOrphan(std::uint32_t t, Target target) {
    if (touched_[t] || grid_.triangles.size() < 2) return;
    touched_[t] = dead_[t] = true;
    for (unsigned i = 0; i < 3; ++i) links_.kinds.erase(edgeKey(grid_.triangles[t][i], grid_.triangles[t][next3(i)]));
    tell(TargetDefectKind::OrphanCell, target, grid_.nodes[grid_.triangles[t][0]], "triangle taken out");
  }

  // The solid edge of the rim that starts at the node becomes like the opening before it.
  void openWall(std::uint32_t node, Target target) {
    if (anyTaken(links_.triangles_at[node])) return;
    for (const std::uint32_t t : links_.triangles_at[node]) {
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(t, i);
        if (links_.mesh.triangles[t].adj[i] != kNone || links_.mesh.origin(e) != node) continue;
        RimKind opening{BoundaryRole::Open};
        for (const auto& [edge, kind] : kindsAt(node))
          if (kind.role == BoundaryRole::Open || kind.role == BoundaryRole::River) opening = kind;
        links_.kinds[edgeKey(node, links_.mesh.target(e))] = opening;
        disturbed_[t] = true;
        tell(TargetDefectKind::LoneWall, target, grid_.nodes[node], "solid edge between openings opened");
        return;
      }
    }
  }

  std::vector<std::pair<NodePair, RimKind>> kindsAt(std::uint32_t node) const {
    std::vector<std::pair<NodePair, RimKind>> found;
    for (const std::uint32_t t : links_.triangles_at[node])
      for (const std::uint32_t other : grid_.triangles[t])
        if (const auto at = links_.kinds.find(edgeKey(node, other)); other != node && at != links_.kinds.end())
          found.push_back(*at);
    return found;
  }

  // --- Flips and splits. ---

  bool isTaken(std::uint32_t t) const { return touched_[t] || dead_[t]; }
  bool anyTaken(const std::vector<std::uint32_t>& triangles) const {
    return std::ranges::any_of(triangles, [this](std::uint32_t t) { return isTaken(t); });
  }
  // The patch round the triangles, none where part of it has been changed in this round: then another one will do.
  std::optional<Patch> untouchedPatch(const std::vector<std::uint32_t>& middle) const {
    if (anyTaken(middle)) return std::nullopt;
    Patch patch = patchRound(view_, middle);
    if (anyTaken(patch.triangles)) return std::nullopt;
    return patch;
  }

  // Whether the attempt was made; `done` says whether it did anything.
  struct Attempt {
    bool made = false, done = false;
  };

  Attempt splitNode(std::uint32_t node, const TargetDefect& defect, Target target) {
    const auto before = untouchedPatch(links_.triangles_at[node]);
    if (!before) return {};
    const std::optional<PatchEdit> chosen = bestNodeSplit(view_, node, *before);
    if (!chosen) return {true, false};
    copyNode(grid_, node, *chosen->fresh);
    put(*before, *chosen);
    tell(defect.kind, target, defect.place, "node split in two");
    return {true, true};
  }

  Attempt reshape(const std::vector<std::uint32_t>& middle, const TargetDefect& defect, Target target) {
    std::set<std::uint32_t> concerned(middle.begin(), middle.end());
    for (const std::uint32_t t : middle)
      for (const EdgeRef twin : links_.mesh.triangles[t].adj)
        if (twin != kNone) concerned.insert(triOf(twin));
    const std::vector<std::uint32_t> inside(concerned.begin(), concerned.end());
    const auto before = untouchedPatch(inside);
    if (!before) return {};
    const std::optional<Reshaping> chosen = bestReshaping(view_, inside, *before);
    if (!chosen) return {true, false};
    if (chosen->split_at) splitEdge(chosen->edge[0], chosen->edge[1], *chosen->split_at);
    put(*before, chosen->edit);
    tell(defect.kind, target, defect.place, chosen->split_at ? "edge split" : "edge flipped");
    return {true, true};
  }

  void reshapeTriangle(std::uint32_t t, const TargetDefect& defect, Target target) {
    if (hopeless_triangles_[t]) return;
    const Attempt attempt = reshape({t}, defect, target);
    hopeless_triangles_[t] = attempt.made && !attempt.done;
  }

  void splitEdge(std::uint32_t a, std::uint32_t b, double share) {
    const std::uint32_t middle = addNodeBetween(grid_, a, b, share);
    if (links_.line_edges.erase(edgeKey(a, b)) > 0) links_.line_edges.insert({edgeKey(a, middle), edgeKey(middle, b)});
  }

  void put(const Patch& patch, const PatchEdit& edit) {
    if (edit.gone) links_.kinds.erase(*edit.gone);
    for (const auto& [edge, kind] : edit.halves) links_.kinds[edge] = kind;
    for (const std::uint32_t t : patch.triangles) touched_[t] = true;
    for (const EditedTriangle& triangle : edit.triangles) {
      if (triangle.slot == kNone) {
        copyTriangle(grid_, triangle.source, triangle.v);
        changed_.push_back(true);
        touched_.push_back(true);
        disturbed_.push_back(true);
        dead_.push_back(false);
        continue;
      }
      grid_.triangles[triangle.slot] = triangle.v;
      changed_[triangle.slot] = disturbed_[triangle.slot] = true;
    }
  }

  void mendValence(std::uint32_t node, const TargetDefect& defect, Target target) {
    const std::vector<std::uint32_t>& round = links_.triangles_at[node];
    if (round.size() > 3) {
      if (hopeless_nodes_[node]) return;
      const Attempt reshaped = reshape(round, defect, target);
      if (reshaped.done) return;
      const Attempt was_split = splitNode(node, defect, target);
      hopeless_nodes_[node] = reshaped.made && was_split.made && !was_split.done;
      return;
    }
    if (round.size() < 3 || !fixedNeighbours(view_, node).empty()) return;
    if (anyTaken(round)) return;
    Corners corners = grid_.triangles[round[0]];
    // What the other two have and the first has not takes the node's place.
    for (const std::uint32_t other : grid_.triangles[round[1]])
      if (std::ranges::count(corners, other) == 0) std::ranges::replace(corners, node, other);
    grid_.triangles[round[0]] = corners;
    for (const std::uint32_t t : round) touched_[t] = disturbed_[t] = true;
    changed_[round[0]] = dead_[round[1]] = dead_[round[2]] = true;
    tell(defect.kind, target, defect.place, "node taken out");
  }

  // --- What remains. ---

  // Flags of what got another index; of what was added since, they are not set.
  static std::vector<bool> renumbered(const std::vector<bool>& flags, const std::vector<std::uint32_t>& index_of,
                                      std::size_t count) {
    std::vector<bool> kept(count, false);
    for (std::size_t i = 0; i < flags.size(); ++i)
      if (index_of[i] != kNone) kept[index_of[i]] = flags[i];
    return kept;
  }

  // Takes out dead triangles and nodes without triangles.
  void compact() {
    const std::vector<std::uint32_t> triangle_index = removeTriangles(grid_, dead_);
    for (std::vector<bool>* flags : {&changed_, &disturbed_, &hopeless_triangles_})
      *flags = renumbered(*flags, triangle_index, grid_.triangles.size());
    const std::vector<std::uint32_t> index = removeUnusedNodes(grid_);
    hopeless_nodes_ = renumbered(hopeless_nodes_, index, grid_.nodes.size());
    BoundaryKinds kinds;
    for (const auto& [edge, kind] : links_.kinds)
      if (index[edge[0]] != kNone && index[edge[1]] != kNone) kinds[edgeKey(index[edge[0]], index[edge[1]])] = kind;
    links_.kinds = std::move(kinds);
  }

  void rebuildBoundaries() {
    const auto kindOfEdge = [&](std::uint32_t a, std::uint32_t b) {
      const auto at = links_.kinds.find(edgeKey(a, b));
      return at == links_.kinds.end() ? RimKind{} : at->second;
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
  std::span<const Target> targets_;
  RepairReport report_;
  GridLinks links_;
  RepairView view_;
  // One a triangle: changed or looked at in this round, taken out in it, changed since it was measured.
  std::vector<bool> touched_, dead_, changed_;
  // One a triangle and one a node: in vain tried to mend. `disturbed_` are triangles that have changed since, which
  // gives those round them another chance.
  std::vector<bool> hopeless_triangles_, hopeless_nodes_, disturbed_;
  Found pending_;
  bool boundaries_done_ = false;
};

}  // namespace

RepairReport repairForTargets(Grid& grid, std::span<const Target> targets) { return Repairer(grid, targets).run(); }

}  // namespace coastmesh
