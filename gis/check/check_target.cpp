#include "gis/check/check_target.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

#include "core/bulk_list.hpp"
#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "core/quality.hpp"
#include "core/tri_mesh.hpp"
#include "gis/check/check_segments.hpp"
#include "gis/check/check_weirs.hpp"
#include "gis/check/flow_links.hpp"
#include "gis/check/node_meets.hpp"
#include "gis/check/target_limits.hpp"
#include "gis/check/triangle_overlaps.hpp"
#include "gis/elements/quads.hpp"
#include "gis/geometry/box.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/geographic_nodes.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "gis/grid/local_plane.hpp"
#include "gis/grid/on_sphere.hpp"
#include "gis/grid/one_turn.hpp"
#include "gis/model/time_step.hpp"

namespace coastmesh {

bool isOfLongWaves(Target target) {
  return target != Target::Swan && target != Target::Fesom && target != Target::Mpas;
}

namespace {

// The other models have no open boundaries, or accept dry nodes there.
bool mindsDryOpenings(Target target) {
  return target == Target::Adcirc || target == Target::Schism || target == Target::Fvcom || target == Target::Telemac;
}

// The other models use longitudes modulo a turn, or places on the sphere.
bool mindsJumps(Target target) {
  return target == Target::Adcirc || target == Target::Telemac || target == Target::Swan;
}

// Metres: in shallower water, as on tidal flats, Courant numbers are small at any size.
constexpr double kShallow = 1.0;

// Triangles with Courant numbers above the limit of explicit schemes, or below that of SCHISM; the worst first.
std::vector<TargetDefect> courantsBeyond(const Grid& grid, double time_step_s, bool from_below, const ItemLoop& loop) {
  std::vector<TargetDefect> found;
  const std::vector<double> steps = timeSteps(grid, loop);
  for (std::uint32_t t = 0; t < steps.size(); ++t) {
    if (!std::isfinite(steps[t])) continue;  // dry, or unknown
    const double courant = time_step_s / steps[t];
    if (from_below && !(deepestOf(grid, t) >= kShallow)) continue;
    if (from_below ? courant < kSchismLeastCourant : courant > kLargestCourant)
      found.push_back({TargetDefectKind::Courant, middleOf(grid, t), t, -1, courant, {}});
  }
  std::ranges::stable_sort(
      found, {}, [from_below](const TargetDefect& defect) { return from_below ? defect.value : -defect.value; });
  return found;
}

class TargetCheck {
 public:
  TargetCheck(const Grid& grid, const LinkedGrid& linked, Target target, const TargetCheckOptions& options,
              const ItemLoop& loop)
      : grid_(grid),
        mesh_(linked.mesh),
        conflicts_(linked.conflicts),
        target_(target),
        options_(options),
        loop_(loop),
        quads_(quadsOf(grid)) {}

  std::vector<TargetDefect> run() {
    for (const std::string& note : grid_.notes)
      defects_.push_back(
          {TargetDefectKind::WrongCount, grid_.nodes.empty() ? Point{} : grid_.nodes.front(), -1, -1, 0.0, note});
    boundary_edges_ = boundaryEdges(mesh_, loop_);
    for (const EdgeConflict& conflict : conflicts_) add(TargetDefectKind::BrokenEdge, middle(conflict.a, conflict.b));
    if (mindsJumps(target_) && grid_.crs.geographic) checkJumps();
    if (target_ == Target::Mpas && isProjectedForMpas(grid_.crs)) on_earth_ = geographicNodes(grid_);
    checkTriangles();
    checkNodes();
    for (const std::uint32_t node : hangingNodes(grid_, mesh_, loop_))
      add(TargetDefectKind::HangingNode, grid_.nodes[node], -1, node);
    if (options_.overlaps) checkOverlaps();
    if (target_ == Target::Adcirc || target_ == Target::Schism)
      std::ranges::move(checkSegments(grid_, mesh_, boundary_edges_, target_, loop_), std::back_inserter(defects_));
    if (target_ == Target::Adcirc) std::ranges::move(checkWeirs(grid_), std::back_inserter(defects_));
    if (mindsDryOpenings(target_)) checkOpenings();
    if (target_ == Target::Fvcom) checkOpenCells();
    if (target_ == Target::Fvcom || target_ == Target::Telemac || target_ == Target::Mike) checkLoneWalls();
    if (target_ == Target::Dflowfm) checkFlowLinks();
    checkQuads();
    if (options_.time_step_s > 0.0 && isOfLongWaves(target_) && !grid_.z.empty()) checkCourant();
    std::ranges::stable_sort(defects_, {},
                             [](const TargetDefect& defect) { return std::pair(defect.advice, defect.kind); });
    return std::move(defects_);
  }

 private:
  void add(TargetDefectKind kind, const Point& place, std::int64_t triangle = -1, std::int64_t node = -1,
           double value = 0.0) {
    defects_.push_back({kind, place, triangle, node, value, {}});
  }

  // Adds what `find(i, found)` appends to `found`, for every i below `count`.
  template <typename Find>
  void addForEach(std::size_t count, const Find& find) {
    std::vector<TargetDefect> all = joined(overStretches(loop_, count, [&](std::size_t first, std::size_t last) {
      std::vector<TargetDefect> found;
      for (std::size_t i = first; i < last; ++i) find(i, found);
      return found;
    }));
    std::ranges::move(all, std::back_inserter(defects_));
  }

  // Degrees: the largest angle of a triangle if the model rejects it, else 0.
  double angleBeyond(const std::array<std::uint32_t, 3>& corners) const {
    const std::span nodes = on_earth_.empty() ? std::span(grid_.nodes) : std::span(on_earth_);
    const Point &a = nodes[corners[0]], &b = nodes[corners[1]], &c = nodes[corners[2]];
    if (target_ == Target::Swan) {
      const double largest = largestFileAngle(a, b, c);
      return largest > kSwanLargestAngleDeg ? largest : 0.0;
    }
    if (target_ == Target::Mpas) {
      const double largest = grid_.crs.isPlane() ? largestFileAngle(a, b, c) : largestSphereAngle(a, b, c);
      return largest > kMpasLargestAngleDeg ? largest : 0.0;
    }
    return 0.0;
  }

  // A quick test: far from poles a triangle of less than a degree has the same orientation in degrees as on the ground,
  // unless it is so flat that a bent side could turn it.
  bool isSurelyCounterClockwise(const std::array<std::uint32_t, 3>& corners) const {
    constexpr double kSmall = 1.0, kFarFromPoles = 80.0;  // degrees
    constexpr double kNotFlat = 0.05;                     // height over the longest side
    const Point &a = grid_.nodes[corners[0]], &b = grid_.nodes[corners[1]], &c = grid_.nodes[corners[2]];
    Box box = Box::of(a, b);
    box.add(c);
    const double width = box.xmax - box.xmin, height = box.ymax - box.ymin;
    if (grid_.crs.geographic &&
        (width > kSmall || height > kSmall || box.ymin < -kFarFromPoles || box.ymax > kFarFromPoles))
      return false;
    return cross(b - a, c - a) > kNotFlat * (width * width + height * height);
  }

  Point middle(std::uint32_t a, std::uint32_t b) const {
    return meanPlace(grid_.crs, std::array{grid_.nodes[a], grid_.nodes[b]});
  }

  Point middle(std::size_t t) const { return middleOf(grid_, static_cast<std::uint32_t>(t)); }

  void checkTriangles() {
    addForEach(grid_.triangles.size(), [&](std::size_t t, std::vector<TargetDefect>& found) {
      const auto report = [&](TargetDefectKind kind, double value = 0.0) {
        found.push_back({kind, middle(t), static_cast<std::int64_t>(t), -1, value, {}});
      };
      if (!isSurelyCounterClockwise(grid_.triangles[t])) {
        const auto [a, b, c] = localPlane(grid_, grid_.triangles[t]);
        if (orient2d(a, b, c) <= 0) return report(TargetDefectKind::Clockwise);
      }
      const auto& adj = mesh_.triangles[t].adj;
      const auto neighbours = 3 - std::ranges::count(adj, kNone);
      if (neighbours == 0) {
        report(TargetDefectKind::OrphanCell);
      } else if (target_ == Target::Fesom && neighbours < kFesomFewestNeighbours) {
        report(TargetDefectKind::OneNeighbour);
      }
      // In a mesh around a pole, angles in degrees are meaningless, and no change of the mesh helps.
      if (target_ == Target::Swan && goes_round_) return;
      if (const double largest = angleBeyond(grid_.triangles[t]); largest > 0.0)
        report(TargetDefectKind::LargeAngle, largest);
    });
  }

  // Around a pole or the globe some triangle must jump, and there are versions of ADCIRC that accept such meshes.
  void checkJumps() {
    addForEach(grid_.triangles.size(), [&](std::size_t t, std::vector<TargetDefect>& found) {
      if (longitudesJump(grid_.nodes, grid_.triangles[t]))
        found.push_back({TargetDefectKind::RoundTheGlobe, middle(t), static_cast<std::int64_t>(t), -1, 0.0, {}});
    });
    goes_round_ = std::ranges::any_of(defects_, isJump) && !inOneTurn(grid_.nodes, grid_.triangles);
    if (!goes_round_ || target_ != Target::Adcirc) return;
    for (TargetDefect& defect : defects_)
      if (isJump(defect)) defect.advice = true;
  }
  static bool isJump(const TargetDefect& defect) { return defect.kind == TargetDefectKind::RoundTheGlobe; }

  void checkNodes() {
    // For each node: its triangles, or 1 if the model takes any number; and its boundary edges.
    const bool counts = target_ == Target::Swan || target_ == Target::Fesom;
    BulkList<int> cells, boundary_starts;
    resizeUnset(cells, grid_.nodes.size());
    resizeUnset(boundary_starts, grid_.nodes.size());
    forEachByStretches(loop_, grid_.nodes.size(), [&](std::size_t node) { cells[node] = boundary_starts[node] = 0; });
    forEachByStretches(loop_, grid_.triangles.size(), [&](std::size_t t) {
      for (const std::uint32_t node : grid_.triangles[t]) {
        if (counts) {
          __atomic_add_fetch(&cells[node], 1, __ATOMIC_RELAXED);
        } else {
          __atomic_store_n(&cells[node], 1, __ATOMIC_RELAXED);
        }
      }
    });
    forEachByStretches(loop_, boundary_edges_.size(), [&](std::size_t e) {
      __atomic_add_fetch(&boundary_starts[mesh_.origin(boundary_edges_[e])], 1, __ATOMIC_RELAXED);
    });
    addForEach(grid_.nodes.size(), [&](std::size_t node, std::vector<TargetDefect>& found) {
      const auto report = [&](TargetDefectKind kind, double value = 0.0) {
        found.push_back({kind, grid_.nodes[node], -1, static_cast<std::int64_t>(node), value, {}});
      };
      if (cells[node] == 0) report(TargetDefectKind::UnusedNode);
      if (boundary_starts[node] > 1) report(TargetDefectKind::PinchedNode, boundary_starts[node]);
      if (!grid_.z.empty() && std::isnan(grid_.z[node])) report(TargetDefectKind::UnknownDepth);
      const bool inner = cells[node] > 0 && boundary_starts[node] == 0;
      const bool refused =
          (target_ == Target::Swan && inner && (cells[node] < kSwanFewestCells || cells[node] > kSwanMostCells)) ||
          (target_ == Target::Fesom && cells[node] > kFesomMostCells);
      if (refused) report(TargetDefectKind::Valence, cells[node]);
    });
    for (const std::uint32_t again : repeatedNodes(grid_, loop_))
      add(TargetDefectKind::RepeatedNode, grid_.nodes[again], -1, again);
  }

  void checkOverlaps() {
    for (const TriangleOverlap& overlap : triangleOverlaps(grid_, mesh_, loop_)) {
      add(TargetDefectKind::Overlap, middle(overlap.triangle), overlap.triangle);
      defects_.back().text = "with triangle " + std::to_string(overlap.other + 1);
    }
  }

  NodePair nodesOf(EdgeRef e) const { return {mesh_.origin(e), mesh_.target(e)}; }

  void checkOpenings() {
    if (grid_.z.empty()) return;
    std::vector<std::uint32_t> dry;
    for (const Boundary& boundary : grid_.boundaries)
      if (isOpening(boundary.role))
        std::ranges::copy_if(boundary.nodes, std::back_inserter(dry),
                             [this](std::uint32_t node) { return grid_.z[node] > 0.0; });
    std::ranges::sort(dry);
    dry.erase(std::unique(dry.begin(), dry.end()), dry.end());
    for (const std::uint32_t node : dry) add(TargetDefectKind::DryOpening, grid_.nodes[node], -1, node, grid_.z[node]);
  }

  // FVCOM adds up marks of a triangle's nodes, 1 for the shore and 2 for open boundaries, and stops at more than 4. A
  // triangle with two solid edges has no velocity, so that the node between them keeps its first level.
  void checkOpenCells() {
    const EdgeKinds kinds(grid_);
    std::vector<bool> on_opening(grid_.nodes.size(), false), on_boundary(grid_.nodes.size(), false);
    for (const EdgeRef e : boundary_edges_) {
      const auto [from, to] = nodesOf(e);
      on_boundary[from] = on_boundary[to] = true;
      if (kinds.isOpen(from, to)) on_opening[from] = on_opening[to] = true;
    }
    for (std::size_t first = 0, last = 0; first < boundary_edges_.size(); first = last) {
      const TriId t = triOf(boundary_edges_[first]);
      int open = 0, solid = 0;
      bool faces_shore = false;
      for (; last < boundary_edges_.size() && triOf(boundary_edges_[last]) == t; ++last) {
        const auto [from, to] = nodesOf(boundary_edges_[last]);
        const std::uint32_t apex = mesh_.apex(boundary_edges_[last]);
        const bool is_open = kinds.isOpen(from, to);
        ++(is_open ? open : solid);
        faces_shore |= is_open && on_boundary[apex] && !on_opening[apex];
      }
      if (open > 1) add(TargetDefectKind::TwoOpenEdges, middle(t), t, -1, open);
      if (open > 0 && (solid > 0 || faces_shore)) add(TargetDefectKind::OpenAndSolid, middle(t), t);
      if (open > 0 || solid != 2) continue;
      add(TargetDefectKind::OneNeighbour, middle(t), t);
      defects_.back().advice = true;
    }
    addForEach(mesh_.triangles.size(), [&](std::size_t t, std::vector<TargetDefect>& found) {
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(static_cast<TriId>(t), i);
        const auto [from, to] = nodesOf(e);
        if (mesh_.twin(e) == kNone || !on_opening[from] || !on_opening[to]) continue;
        found.push_back({TargetDefectKind::OpenBridge, middle(t), static_cast<std::int64_t>(t), -1, 0.0, {}});
        break;
      }
    });
  }

  // TELEMAC also rejects a single solid node between openings, a wall of two edges: the first one is reported.
  void checkLoneWalls() {
    const bool of_telemac = target_ == Target::Telemac, with_rivers = target_ != Target::Fvcom;
    std::vector<bool> on_opening(grid_.nodes.size(), false);
    const auto opens = [&](BoundaryRole role) {
      return role == BoundaryRole::Open || (with_rivers && isOpening(role));
    };
    for (const Boundary& boundary : grid_.boundaries)
      if (opens(boundary.role))
        for (const std::uint32_t node : boundary.nodes) on_opening[node] = true;
    std::vector<std::uint32_t> after(grid_.nodes.size(), kNone);
    for (const EdgeRef e : boundary_edges_) after[mesh_.origin(e)] = mesh_.target(e);
    const EdgeKinds kinds(grid_);
    for (const EdgeRef e : boundary_edges_) {
      const auto [from, to] = nodesOf(e);
      if (!on_opening[from]) continue;
      const bool ends_here = on_opening[to];
      const bool ends_next = of_telemac && after[to] != kNone && on_opening[after[to]] && after[to] != from;
      if (!ends_here && !ends_next) continue;
      const BoundaryKind* const kind = kinds.find(from, to);
      if (kind == nullptr || !opens(kind->role)) add(TargetDefectKind::LoneWall, middle(from, to), -1, from);
    }
  }

  void checkQuads() {
    const bool refused = !acceptsQuads(target_);
    for (const Quad& quad : quads_) {
      const Point place = middle(quad.nodes[0], quad.nodes[2]);
      if (refused) add(TargetDefectKind::Quadrilateral, place, quad.halves[0]);
      std::ptrdiff_t sides = 0;  // with a neighbour, the diagonal from both halves
      for (const std::uint32_t t : quad.halves) sides += 3 - std::ranges::count(mesh_.triangles[t].adj, kNone);
      if (sides == 2) add(TargetDefectKind::OrphanCell, place, quad.halves[0]);
    }
  }

  // Links lead from element to element: none crosses a diagonal.
  void checkFlowLinks() {
    std::vector<const Quad*> quad_of(quads_.empty() ? 0 : grid_.triangles.size(), nullptr);
    for (const Quad& quad : quads_)
      for (const std::uint32_t t : quad.halves) quad_of[t] = &quad;
    addForEach(mesh_.triangles.size(), [&](std::size_t t, std::vector<TargetDefect>& found) {
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(static_cast<TriId>(t), i), twin = mesh_.twin(e);
        if (twin == kNone || triOf(twin) < t) continue;
        const Quad* const left = quads_.empty() ? nullptr : quad_of[t];
        const Quad* const right = quads_.empty() ? nullptr : quad_of[triOf(twin)];
        if (left != nullptr && left == right) continue;
        const std::uint32_t from = mesh_.origin(e), to = mesh_.target(e);
        const FlowLink link = left == nullptr && right == nullptr
                                  ? linkOfTriangles({from, to, mesh_.apex(e), mesh_.apex(twin)})
                                  : linkOf(cellAt(left, e), cellAt(right, twin));
        const auto report = [&](TargetDefectKind kind, double value) {
          found.push_back({kind, middle(from, to), static_cast<std::int64_t>(t), from, value, {}});
        };
        if (link.cosine > kDflowfmLargestCosine) report(TargetDefectKind::NotOrthogonal, link.cosine);
        if (link.length < kDflowfmSmallestLink) report(TargetDefectKind::SmallFlowLink, link.length);
      }
    });
  }

  // An element's nodes, counter-clockwise.
  struct FlowCell {
    std::array<std::uint32_t, 4> nodes{};
    std::size_t count = 3;
  };

  // The nodes of a quadrilateral, or of the triangle if that is null, from the origin of one of its sides.
  FlowCell cellAt(const Quad* quad, EdgeRef side) const {
    const std::uint32_t from = mesh_.origin(side);
    if (quad == nullptr) return {{from, mesh_.target(side), mesh_.apex(side)}, 3};
    FlowCell cell{quad->nodes, 4};
    std::ranges::rotate(cell.nodes, std::ranges::find(cell.nodes, from));
    return cell;
  }

  // `nodes`: the ends of the side, then the apexes on both sides.
  FlowLink linkOfTriangles(const std::array<std::uint32_t, 4>& nodes) const {
    const auto [a, b, c, d] = localPlane(grid_, nodes, EarthShape::Sphere);
    return flowLinkAcross(a, b, c, d);
  }

  // Across the side from the first to the second node of `left`, which is from the second to the first of `right`.
  FlowLink linkOf(const FlowCell& left, const FlowCell& right) const {
    std::array<Point, 8> places;
    for (std::size_t i = 0; i < left.count; ++i) places[i] = grid_.nodes[left.nodes[i]];
    for (std::size_t i = 0; i < right.count; ++i) places[left.count + i] = grid_.nodes[right.nodes[i]];
    const std::span all = std::span(places).first(left.count + right.count);
    flattenLocally(grid_.crs, all, EarthShape::Sphere);
    return flowLinkAcross(all.first(left.count), all.subspan(left.count));
  }

  void checkCourant() {
    const bool from_below = target_ == Target::Schism;
    const bool advice =
        from_below || target_ == Target::Telemac || target_ == Target::Mike || target_ == Target::Dflowfm;
    for (TargetDefect& defect : courantsBeyond(grid_, options_.time_step_s, from_below, loop_)) {
      defect.advice = advice;
      defects_.push_back(std::move(defect));
    }
  }

  const Grid& grid_;
  const TriMesh& mesh_;
  const std::vector<EdgeConflict>& conflicts_;
  const Target target_;
  const TargetCheckOptions& options_;
  const ItemLoop& loop_;
  const std::vector<Quad> quads_;
  std::vector<EdgeRef> boundary_edges_;  // ascending
  std::vector<TargetDefect> defects_;
  std::vector<Point> on_earth_;  // longitudes and latitudes of the nodes, if the model uses these instead
  bool goes_round_ = false;      // around a pole or the globe
};

}  // namespace

double largestSphereAngle(const Point& a, const Point& b, const Point& c) {
  return std::ranges::max(flatAnglesDeg(onSphere(asLonLat(a)), onSphere(asLonLat(b)), onSphere(asLonLat(c))));
}

bool isProjectedForMpas(const Crs& crs) { return !crs.geographic && !crs.isPlane(); }

double largestFileAngle(const Point& a, const Point& b, const Point& c) { return std::ranges::max(anglesDeg(a, b, c)); }

std::vector<TargetDefect> checkTimeStep(const Grid& grid, double time_step_s, const ItemLoop& loop) {
  return courantsBeyond(grid, time_step_s, false, loop);
}

std::vector<TargetDefect> checkTarget(const Grid& grid, Target target, const TargetCheckOptions& options,
                                      const ItemLoop& loop) {
  return checkTarget(grid, linkGrid(grid, loop), target, options, loop);
}

std::vector<TargetDefect> checkTarget(const Grid& grid, const LinkedGrid& linked, Target target,
                                      const TargetCheckOptions& options, const ItemLoop& loop) {
  return TargetCheck(grid, linked, target, options, loop).run();
}

}  // namespace coastmesh
