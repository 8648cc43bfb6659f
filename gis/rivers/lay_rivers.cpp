#include "gis/rivers/lay_rivers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "core/metric.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/places.hpp"
#include "gis/rivers/mesh_water.hpp"
#include "gis/rivers/river_connection.hpp"
#include "gis/rivers/river_course.hpp"
#include "gis/rivers/river_grid.hpp"
#include "gis/rivers/river_junctions.hpp"
#include "gis/rivers/river_network.hpp"
#include "gis/rivers/river_overlaps.hpp"
#include "gis/rivers/river_plane.hpp"
#include "gis/rivers/river_room.hpp"
#include "gis/rivers/river_rows.hpp"
#include "gis/rivers/river_widths.hpp"

namespace coastmesh {

namespace {

// A river that comes closer to itself than its width gets this share of it there, several times if need be.
constexpr double kNarrowing = 0.8;
constexpr int kMostNarrowings = 12;

constexpr double kMostCells = 1000.0;  // across

// Shorter reaches between two others, in their widths, may be left out without notice.
constexpr double kSpur = 4.0;

// In water, rivers as far apart as this share of a row leave no room for triangles between them.
constexpr double kClearance = 0.08;

// The lines in the turn of longitudes in which the mesh is.
std::vector<RiverLine> besideMesh(std::vector<RiverLine> lines, const Grid& mesh) {
  if (!mesh.crs.geographic) return lines;
  constexpr double kTurn = 360.0;
  const Box box = boxAround(mesh.nodes, inOrder);
  for (RiverLine& line : lines) {
    const Box own = boxAround(line.points, inOrder);
    const double turns = kTurn * std::round((box.xmin + box.xmax - own.xmin - own.xmax) / (2.0 * kTurn));
    for (Point& p : line.points) p.x += turns;
  }
  return lines;
}

// The lines' box with room for what is beside them.
Box boxOf(const std::vector<RiverLine>& lines, const Crs& crs, double reach_m) {
  constexpr double kWidths = 10.0;
  constexpr double kMetresOfDegree = 111e3;
  Box box;
  for (const RiverLine& line : lines) {
    const Box own = boxAround(line.points, inOrder);
    double room = kWidths * line.width_m + (std::isfinite(reach_m) ? 2.0 * reach_m : 0.0);
    if (crs.geographic) {
      const double polewards = std::min(89.0, std::max(std::abs(own.ymin), std::abs(own.ymax)));
      room /= kMetresOfDegree * std::cos(polewards * std::numbers::pi / 180.0);
    }
    box.add(own.grownBy(room));
  }
  return box;
}

class RiverLayer {
 public:
  RiverLayer(const std::vector<RiverLine>& lines, const Grid& mesh, const RiverOptions& options,
             const RunControl& control, const ItemLoop& loop)
      : lines_(besideMesh(lines, mesh)),
        mesh_(mesh),
        mesh_box_(boxAround(mesh.nodes, inOrder)),
        options_(options),
        control_(control),
        loop_(loop),
        plane_(lines_, mesh.crs),
        water_(mesh, plane_, boxOf(lines_, mesh.crs, options.reach_m), loop) {}

  LaidRivers lay() {
    for (const RiverLine& line : lines_) rivers_.push_back(inPlane(line));
    network_ = riverNetwork(rivers_);
    for (const std::uint32_t line : network_.within)
      report_.lost.push_back({RiverLoss::Within, nameOf(lines_[line]), reported(lines_[line].points.front()), 0.0});
    reportWithoutReach();
    const double scale = plane_.scaleAt(rivers_.front().points.front());
    connection_ =
        connectRivers(network_, rivers_, water_, options_.reach_m * scale, options_.extent == RiverExtent::All);
    for (const Point& place : connection_.extended) report_.extended.push_back(reported(plane_.inverse(place)));
    for (const Point& place : connection_.left) report_.left.push_back(reported(plane_.inverse(place)));
    for (const Point& place : connection_.led_out) report_.led_out.push_back(reported(plane_.inverse(place)));
    barred_.assign(network_.reaches.size(), 0);
    narrowed_.assign(network_.reaches.size(), 0);
    reaches_at_.resize(network_.nodes.size());
    for (std::uint32_t r = 0; r < network_.reaches.size(); ++r)
      for (const std::uint32_t node : {network_.reaches[r].from, network_.reaches[r].to})
        reaches_at_[node].push_back(r);
    followCourses();
    planner_.emplace(network_, courses_, shapes_);
    loseApart();
    makeRows();
    loseApart();
    chooseRows();
    RiverGrid made = makeGrid();
    LaidRivers laid;
    if (!made.grid.triangles.empty()) {
      RiverEnds ends = setRiverBoundaries(made, water_, plane_);
      report_.inflows = ends.inflows;
      report_.on_land = std::move(ends.on_land);
    }
    report_.below = made.below;
    report_.least_angle_deg = made.least_angle_deg;
    report_.least_place = made.least_place;
    report_.quads = quadsOf(made.grid).size();
    report_.triangles = made.grid.triangles.size() - 2 * report_.quads;
    laid.grid = std::move(made.grid);
    if (laid.grid.triangles.empty() && report_.lost.empty()) report_.lost = std::move(spurs_);
    for (const Point& place : laid.grid.nodes) laid.mesh_z.push_back(water_.zAt(plane_.forward(place)));
    laid.report = std::move(report_);
    return laid;
  }

 private:
  // A place for messages. Lines were brought beside the mesh, which may be a turn from where their file has them: what
  // is beyond the mesh's longitudes is reported from -180 to 180.
  Point reported(const Point& place) const {
    constexpr double kTurn = 360.0;
    if (!mesh_.crs.geographic || (place.x >= mesh_box_.xmin && place.x <= mesh_box_.xmax)) return place;
    return {place.x - kTurn * std::round(place.x / kTurn), place.y};
  }

  PlaneRiver inPlane(const RiverLine& line) const {
    PlaneRiver river;
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const Point& p = line.points[i];
      const Point place = plane_.forward(p);
      if (!std::isfinite(place.x) || !std::isfinite(place.y))
        throw InputError(nameOf(line) + " has a place, (" + placeInWords(reported(p)) + "), that cannot be projected");
      if (!river.points.empty() && river.points.back() == place) continue;
      river.points.push_back(place);
      if (!line.widths_m.empty()) river.widths.push_back(line.widths_m[i] * plane_.scaleAt(place));
    }
    if (river.points.size() < 2)
      throw InputError(nameOf(line) + " has a line of no length at (" + placeInWords(reported(line.points.front())) +
                       "); take it out");
    river.width = line.width_m * plane_.scaleAt(river.points.front());
    return river;
  }

  // Of lines that are not within others: too short for their width.
  void reportWithoutReach() {
    std::vector<std::uint8_t> is_known(lines_.size(), 0);
    for (const std::uint32_t line : network_.within) is_known[line] = 1;
    for (const RiverReach& reach : network_.reaches)
      for (const std::uint32_t line : reach.line_of) is_known[line] = 1;
    for (std::uint32_t line = 0; line < lines_.size(); ++line)
      if (is_known[line] == 0)
        report_.lost.push_back({RiverLoss::Short, nameOf(lines_[line]), reported(lines_[line].points.front()), 0.0});
  }

  void followCourses() {
    const RiverWidths widths(rivers_);
    for (const RiverReach& reach : network_.reaches) {
      control_.checkpoint(0.0);
      courses_.emplace_back(reach, widths);
      const RiverCourse& course = courses_.back();
      const Point middle = course.sectionAt(0.5 * course.length()).place;
      const double scale = plane_.scaleAt(middle);
      cells_.push_back(cellsOf(reach, course.maxWidth() / scale));
      const double cell = course.meanWidth() / static_cast<double>(cells_.back());
      shapes_.push_back({0.5 * options_.aspect * cell, cell});
      countQuads();
      if (course.moved() / scale <= report_.moved_m) continue;
      report_.moved_m = course.moved() / scale;
      report_.moved_place = reported(plane_.inverse(course.movedPlace()));
    }
    std::vector<double> longest;
    for (const ReachShape& shape : shapes_) longest.push_back(options_.aspect * shape.cell);
    limitRows(courses_, longest, water_, options_.extent == RiverExtent::All);
  }

  std::size_t cellsOf(const RiverReach& reach, double width_m) const {
    const double wanted = std::ceil(width_m / options_.most_cell_width_m);
    if (wanted > kMostCells)
      throw InputError(nameOf(lines_[reach.line_of.front()]) + " would take " + std::to_string(std::llround(wanted)) +
                       " quadrilaterals across: request a larger --max-cell-width");
    return std::max(options_.cells, static_cast<std::size_t>(wanted));
  }

  // Adds those of the last course.
  void countQuads() {
    const double rows = courses_.back().length() / (options_.aspect * shapes_.back().cell);
    quads_ += rows * static_cast<double>(cells_.back());
    if (quads_ <= options_.most_quads) return;
    throw InputError("these rivers take more quadrilaterals than there is memory for, some " +
                     std::to_string(std::llround(options_.most_quads)) +
                     ": request fewer --elements, a larger --aspect, or larger widths");
  }

  // True for a short reach between two places of others, as where a line crosses the river that it ends in.
  bool isSpur(std::uint32_t reach) const {
    double widest = courses_[reach].maxWidth();
    for (const std::uint32_t node : {network_.reaches[reach].from, network_.reaches[reach].to}) {
      bool has_other = false;
      for (const std::uint32_t r : reaches_at_[node]) {
        has_other = has_other || r != reach;
        widest = std::max(widest, courses_[r].maxWidth());
      }
      if (!has_other) return false;
    }
    return courses_[reach].length() < kSpur * widest;
  }

  void lose(std::uint32_t reach, RiverLoss why, const Point& place, double distance = 0.0) {
    barred_[reach] = 1;
    planner_->bar(reach);
    const std::vector<std::uint32_t>& line_of = network_.reaches[reach].line_of;
    LostRiver lost{why, nameOf(lines_[line_of[line_of.size() / 2]]), reported(plane_.inverse(place)), distance};
    (why == RiverLoss::Crowded && isSpur(reach) ? spurs_ : report_.lost).push_back(std::move(lost));
  }

  Point middleOf(std::uint32_t reach) const { return courses_[reach].sectionAt(0.5 * courses_[reach].length()).place; }

  void loseApart() {
    const std::vector<std::uint8_t> connected = connectedReaches(network_, connection_.touches, barred_);
    for (std::uint32_t r = 0; r < network_.reaches.size(); ++r)
      if (barred_[r] == 0 && connected[r] == 0)
        lose(r, RiverLoss::Apart, middleOf(r), connection_.gap[r] / plane_.scaleAt(middleOf(r)));
  }

  // Rows of all reaches that have room; each turn but the last takes some reach away, or narrows it.
  void makeRows() {
    rows_.assign(network_.reaches.size(), {});
    for (bool again = true; again;) {
      control_.checkpoint(0.0);
      JunctionPlan plan = planner_->plan();
      std::swap(plan_, plan);
      again = false;
      for (std::uint32_t r = 0; r < network_.reaches.size(); ++r) {
        if (barred_[r] != 0 || plan_.left_out[r] == 0) continue;
        const bool is_alone = plan_.trim_start[r] == 0.0 && plan_.trim_end[r] == 0.0;
        lose(r, is_alone ? RiverLoss::Short : RiverLoss::Crowded, middleOf(r));
      }
      for (std::uint32_t r = 0; r < network_.reaches.size(); ++r) {
        if (barred_[r] != 0 || plan_.in_junction[r] != 0) {
          rows_[r] = {};
          continue;
        }
        const bool is_as_before = !rows_[r].sections.empty() && plan.trim_start[r] == plan_.trim_start[r] &&
                                  plan.trim_end[r] == plan_.trim_end[r];
        if (is_as_before) continue;
        rows_[r] = riverRows(courses_[r], plan_.trim_start[r], courses_[r].length() - plan_.trim_end[r], cells_[r],
                             options_.aspect);
        if (!rows_[r].sections.empty()) continue;
        lose(r, RiverLoss::Crowded, middleOf(r));
        again = true;
      }
      if (!again) again = loseOverlaps();
    }
  }

  // Of two reaches that overlap, the narrower one is left out. A reach that overlaps itself becomes narrower there.
  bool loseOverlaps() {
    bool any = false;
    const double clearance = options_.extent == RiverExtent::All ? kClearance : 0.0;
    for (const RiverOverlap& overlap : overlapsOf(rows_, plan_.junctions, clearance)) {
      const auto [a, b] = std::pair(overlap.first, overlap.second);
      if (barred_[a] != 0 || barred_[b] != 0) continue;
      if (a != b || overlap.rows.empty() || ++narrowed_[a] > kMostNarrowings)
        lose(courses_[a].meanWidth() < courses_[b].meanWidth() ? a : b, RiverLoss::Crowded, overlap.place);
      else
        narrow(a, overlap);
      any = true;
    }
    return any;
  }

  void narrow(std::uint32_t reach, const RiverOverlap& overlap) {
    if (narrowed_[reach] == 1) {
      ++report_.narrowed;
      report_.narrowed_place = reported(plane_.inverse(overlap.place));
    }
    for (const std::size_t row : overlap.rows)
      courses_[reach].narrow(rows_[reach].sections[row].along, rows_[reach].sections[row + 1].along, kNarrowing);
    rows_[reach] = {};
    planner_->look(reach);
  }

  bool isWithin(const RiverRows& rows, std::size_t row) const {
    for (std::size_t i = 0; i <= rows.cells; ++i)
      if (!water_.holds(rows.node(row, i))) return false;
    return true;
  }

  // Junctions stay if they are not all in the water of the mesh, and those rows of which this holds, or of which it
  // holds for a row or junction beside them.
  void chooseRows() {
    const std::size_t n = network_.reaches.size();
    std::vector<std::vector<std::uint8_t>> outside(n);  // of each section: not all of it is in the water
    for (std::uint32_t r = 0; r < n; ++r) {
      outside[r].assign(rows_[r].sections.size(), 1);
      if (options_.extent == RiverExtent::Outside)
        forEachByStretches(loop_, outside[r].size(),
                           [&](std::size_t row) { outside[r][row] = isWithin(rows_[r], row) ? 0 : 1; });
    }
    std::vector<std::uint8_t> begins(n, 0), ends(n, 0);  // a junction that stays is there
    std::erase_if(plan_.junctions, [&](const RiverJunction& junction) {
      bool stays = false;
      for (const RiverBranch& branch : junction.branches)
        if (barred_[branch.reach] == 0)
          stays = stays || (branch.at_end ? outside[branch.reach].back() : outside[branch.reach].front()) != 0;
      for (const RiverBranch& branch : junction.branches)
        if (stays) (branch.at_end ? ends : begins)[branch.reach] = 1;
      return !stays;
    });
    for (std::uint32_t r = 0; r < n; ++r) {
      const std::size_t count = rows_[r].sections.empty() ? 0 : rows_[r].sections.size() - 1;
      has_row_.emplace_back(count, 0);
      const auto isOutside = [&](std::size_t row) { return outside[r][row] != 0 || outside[r][row + 1] != 0; };
      for (std::size_t row = 0; row < count; ++row)
        if (isOutside(row) || (row > 0 ? isOutside(row - 1) : begins[r] != 0) ||
            (row + 1 < count ? isOutside(row + 1) : ends[r] != 0))
          has_row_[r][row] = 1;
      if (barred_[r] != 0) rows_[r] = {}, has_row_[r].clear();
      if (count > 0 && barred_[r] == 0 && std::ranges::count(has_row_[r], 1) == 0)
        lose(r, RiverLoss::InWater, middleOf(r));
      else if (!has_row_[r].empty())
        ++report_.reaches;
    }
    report_.junctions = plan_.junctions.size();
  }

  RiverGrid makeGrid() {
    std::vector<std::uint32_t> degree(network_.nodes.size(), 0);
    for (std::uint32_t r = 0; r < network_.reaches.size(); ++r) {
      if (rows_[r].sections.empty() && plan_.in_junction[r] == 0) continue;
      ++degree[network_.reaches[r].from];
      ++degree[network_.reaches[r].to];
    }
    std::vector<std::uint8_t> is_free;
    for (const RiverReach& reach : network_.reaches)
      is_free.push_back(
          static_cast<std::uint8_t>((degree[reach.from] == 1 ? 1u : 0u) | (degree[reach.to] == 1 ? 2u : 0u)));
    return riverGrid({rows_, has_row_, plan_.junctions, is_free}, lines_, plane_, mesh_.crs, options_.junctions,
                     !mesh_.size_m.empty(), loop_);
  }

  const std::vector<RiverLine> lines_;
  const Grid& mesh_;
  const Box mesh_box_;
  const RiverOptions& options_;
  const RunControl& control_;
  const ItemLoop& loop_;
  const RiverPlane plane_;
  const MeshWater water_;
  std::vector<PlaneRiver> rivers_;  // by line
  RiverNetwork network_;
  std::vector<std::vector<std::uint32_t>> reaches_at_;  // by node
  RiverConnection connection_;
  // Of each reach.
  std::vector<RiverCourse> courses_;
  std::vector<std::size_t> cells_;
  std::vector<ReachShape> shapes_;
  double quads_ = 0.0;  // of all of them, about
  std::vector<std::uint8_t> barred_;
  std::vector<int> narrowed_;  // how often
  std::vector<RiverRows> rows_;
  std::vector<std::vector<std::uint8_t>> has_row_;
  std::optional<JunctionPlanner> planner_;
  JunctionPlan plan_;
  std::vector<LostRiver> spurs_;  // not worth a message, unless there is nothing else
  RiverReport report_;
};

}  // namespace

LaidRivers layRivers(const std::vector<RiverLine>& lines, const Grid& mesh, const RiverOptions& options,
                     const RunControl& control, const ItemLoop& loop) {
  return RiverLayer(lines, mesh, options, control, loop).lay();
}

}  // namespace coastmesh
