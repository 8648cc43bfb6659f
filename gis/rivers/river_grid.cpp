#include "gis/rivers/river_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/metric.hpp"
#include "core/quality.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/places.hpp"
#include "gis/rivers/fill_junction.hpp"

namespace coastmesh {

namespace {

class GridMaker {
 public:
  GridMaker(const RiverParts& parts, const std::vector<RiverLine>& lines, const RiverPlane& plane,
            const RefineOptions& options)
      : parts_(parts), lines_(lines), plane_(plane), options_(options) {}

  RiverGrid make(const Crs& crs, bool sizes, const ItemLoop& loop) {
    Grid& grid = made_.grid;
    grid.crs = crs;
    addFeatures();
    for (std::uint32_t reach = 0; reach < parts_.rows.size(); ++reach) addRows(reach);
    std::vector<JunctionOutline> outlines;
    for (const RiverJunction& junction : parts_.junctions) outlines.push_back(outlineOf(junction));
    std::vector<JunctionMesh> meshes(outlines.size());
    loop(outlines.size(), [&](std::size_t i) { meshes[i] = fill(outlines[i]); });
    for (std::size_t i = 0; i < meshes.size(); ++i) addJunction(parts_.junctions[i], meshes[i]);
    if (sizes) setSizes();
    const std::vector<std::uint32_t> number = removeUnusedNodes(grid);
    for (std::vector<std::uint32_t>& end : made_.ends)
      for (std::uint32_t& node : end) node = number[node];
    sortFeatures(grid);
    return std::move(made_);
  }

 private:
  std::uint32_t nodeOf(std::uint32_t reach, std::size_t row, std::size_t i) const {
    return first_node_[reach] + static_cast<std::uint32_t>(row * (parts_.rows[reach].cells + 1) + i);
  }

  // Parts of a line follow one another.
  void addFeatures() {
    for (const RiverLine& line : lines_) {
      std::vector<GridFeature>& features = made_.grid.features;
      if (features.empty() || features.back().fid != line.fid || features.back().source != line.source) {
        features.push_back({line.fid, line.source, {}});
        if (!line.name.empty()) features.back().attributes.emplace_back("name", line.name);
      }
      feature_of_.push_back(static_cast<std::uint32_t>(features.size() - 1));
    }
  }

  void addPlace(const Point& place) {
    places_.push_back(place);
    made_.grid.nodes.push_back(plane_.inverse(place));
  }

  void addRows(std::uint32_t reach) {
    const RiverRows& rows = parts_.rows[reach];
    first_node_.push_back(static_cast<std::uint32_t>(places_.size()));
    for (const RiverSection& section : rows.sections) {
      const double depth = lines_[section.line].depth_m;
      made_.grid.z.insert(made_.grid.z.end(), rows.cells + 1, -depth);
    }
    for (const Point& place : rows.nodes) addPlace(place);
    for (std::size_t row = 0; row + 1 < rows.sections.size(); ++row) {
      if (parts_.has_row[reach][row] == 0) continue;
      for (std::size_t i = 0; i < rows.cells; ++i) {
        const std::array corners{nodeOf(reach, row, i), nodeOf(reach, row + 1, i), nodeOf(reach, row + 1, i + 1),
                                 nodeOf(reach, row, i + 1)};
        addElement(made_.grid, corners);
        made_.grid.feature_of.resize(made_.grid.triangles.size(), feature_of_[rows.sections[row].line]);
      }
    }
    if (rows.sections.empty()) return;
    const std::size_t last = rows.sections.size() - 1;
    const std::uint8_t is_free = parts_.is_free[reach];
    if ((is_free & 1u) != 0 && parts_.has_row[reach].front() != 0) addEnd(reach, 0);
    if ((is_free & 2u) != 0 && parts_.has_row[reach].back() != 0) addEnd(reach, last);
  }

  void addEnd(std::uint32_t reach, std::size_t row) {
    std::vector<std::uint32_t>& end = made_.ends.emplace_back();
    for (std::size_t i = 0; i <= parts_.rows[reach].cells; ++i) end.push_back(nodeOf(reach, row, i));
    if (row == 0) std::ranges::reverse(end);
    made_.end_names.push_back(lines_[parts_.rows[reach].sections[row].line].name);
  }

  // The nodes of the last sections of a junction's branches, in the order of its outline.
  std::vector<std::uint32_t> nodesAround(const RiverJunction& junction) const {
    std::vector<std::uint32_t> nodes;
    for (const RiverBranch& branch : junction.branches) {
      const RiverRows& rows = parts_.rows[branch.reach];
      const std::size_t row = branch.at_end ? rows.sections.size() - 1 : 0;
      for (std::size_t i = 0; i <= rows.cells; ++i)
        nodes.push_back(nodeOf(branch.reach, row, branch.at_end ? rows.cells - i : i));
    }
    return nodes;
  }

  JunctionOutline outlineOf(const RiverJunction& junction) const {
    JunctionOutline outline;
    for (const std::uint32_t node : nodesAround(junction)) outline.points.push_back(places_[node]);
    for (const RiverBranch& branch : junction.branches) {
      outline.keeps.insert(outline.keeps.end(), parts_.rows[branch.reach].cells, 1);
      outline.keeps.push_back(0);
    }
    return outline;
  }

  JunctionMesh fill(const JunctionOutline& outline) const {
    try {
      return fillJunction(outline, options_);
    } catch (const BadPslg& error) {
      throw InputError("rivers cannot be joined at (" + placeInWords(plane_.inverse(error.defect.place)) +
                       "): " + error.what() + "; leave one of them out");
    }
  }

  void addJunction(const RiverJunction& junction, const JunctionMesh& mesh) {
    std::vector<std::uint32_t> nodes = nodesAround(junction);
    for (std::size_t i = nodes.size(); i < mesh.points.size(); ++i) {
      nodes.push_back(static_cast<std::uint32_t>(places_.size()));
      addPlace(mesh.points[i]);
      made_.grid.z.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    const std::uint32_t line = parts_.rows[junction.branches.front().reach].sections.front().line;
    for (const auto& corners : mesh.triangles) {
      addElement(made_.grid, std::array{nodes[corners[0]], nodes[corners[1]], nodes[corners[2]]});
      made_.grid.feature_of.push_back(feature_of_[line]);
      judge(mesh.points[corners[0]], mesh.points[corners[1]], mesh.points[corners[2]]);
    }
  }

  void judge(const Point& a, const Point& b, const Point& c) {
    constexpr double kRoundingDeg = 1e-6;
    const double angle = leastAngleDeg(a, b, c);
    if (angle >= options_.min_angle_deg - kRoundingDeg) return;
    ++made_.below;
    if (angle >= made_.least_angle_deg) return;
    made_.least_angle_deg = angle;
    made_.least_place = plane_.inverse(centroid(a, b, c));
  }

  void setSizes() {
    const Grid& grid = made_.grid;
    std::vector<double> sum(places_.size(), 0.0), count(places_.size(), 0.0);
    const std::vector<std::uint8_t> diagonals = diagonalsOf(grid);
    for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
      for (unsigned i = 0; i < 3; ++i) {
        if (!diagonals.empty() && diagonals[t] == i) continue;
        const std::uint32_t a = grid.triangles[t][(i + 1) % 3], b = grid.triangles[t][(i + 2) % 3];
        const double length = distance(places_[a], places_[b]) / plane_.scaleAt(places_[a]);
        for (const std::uint32_t node : {a, b}) {
          sum[node] += length;
          count[node] += 1.0;
        }
      }
    }
    for (std::size_t i = 0; i < sum.size(); ++i) made_.grid.size_m.push_back(sum[i] / std::max(1.0, count[i]));
  }

  const RiverParts& parts_;
  const std::vector<RiverLine>& lines_;
  const RiverPlane& plane_;
  const RefineOptions& options_;
  std::vector<std::uint32_t> feature_of_;  // by line
  std::vector<std::uint32_t> first_node_;  // of each reach
  std::vector<Point> places_;              // of nodes, in the plane
  RiverGrid made_;
};

// Gives river boundaries the names of the rivers at whose ends they are.
void nameBoundaries(RiverGrid& rivers) {
  std::map<NodePair, std::size_t> end_of;
  for (std::size_t e = 0; e < rivers.ends.size(); ++e)
    for (std::size_t i = 0; i + 1 < rivers.ends[e].size(); ++i)
      end_of.emplace(edgeKey(rivers.ends[e][i], rivers.ends[e][i + 1]), e);
  for (Boundary& boundary : rivers.grid.boundaries) {
    if (boundary.role != BoundaryRole::River) continue;
    const auto end = end_of.find(edgeKey(boundary.nodes[0], boundary.nodes[1]));
    if (end != end_of.end()) boundary.name = rivers.end_names[end->second];
  }
}

}  // namespace

RiverGrid riverGrid(const RiverParts& parts, const std::vector<RiverLine>& lines, const RiverPlane& plane,
                    const Crs& crs, const RefineOptions& triangle_options, bool sizes, const ItemLoop& loop) {
  return GridMaker(parts, lines, plane, triangle_options).make(crs, sizes, loop);
}

RiverEnds setRiverBoundaries(RiverGrid& rivers, const MeshWater& water, const RiverPlane& plane) {
  Grid& grid = rivers.grid;
  const auto touchesWater = [&](std::uint32_t a, std::uint32_t b) {
    const Point from = plane.forward(grid.nodes[a]), to = plane.forward(grid.nodes[b]);
    return water.holds(from) || water.holds(to) || water.holds(midpoint(from, to));
  };
  // Just beyond an end: one at the edge of the water is not in it.
  const auto hasWaterBeyond = [&](std::uint32_t a, std::uint32_t b) {
    constexpr double kBeyond = 0.02;  // of the edge
    const Point from = plane.forward(grid.nodes[a]), to = plane.forward(grid.nodes[b]);
    const Point out{kBeyond * (to.y - from.y), kBeyond * (from.x - to.x)};
    return water.holds(from + out) || water.holds(to + out) || water.holds(midpoint(from, to) + out);
  };
  RiverEnds ends;
  std::vector<NodePair> inflows;
  for (std::size_t e = 0; e < rivers.ends.size(); ++e) {
    const std::vector<std::uint32_t>& end = rivers.ends[e];
    bool is_inflow = true;
    for (std::size_t i = 0; i + 1 < end.size(); ++i) is_inflow = is_inflow && !hasWaterBeyond(end[i], end[i + 1]);
    // A mouth may be wider than the water there: what is beside that is no inflow.
    for (std::size_t i = 0; i + 1 < end.size() && is_inflow; ++i) inflows.push_back(edgeKey(end[i], end[i + 1]));
    const Point middle = midpoint(plane.forward(grid.nodes[end.front()]), plane.forward(grid.nodes[end.back()]));
    if (!is_inflow && water.isLandAt(middle)) ends.on_land.push_back({rivers.end_names[e], plane.inverse(middle)});
  }
  std::ranges::sort(inflows);
  const auto kindOf = [&](std::uint32_t a, std::uint32_t b) {
    if (std::ranges::binary_search(inflows, edgeKey(a, b))) return BoundaryKind{BoundaryRole::River};
    return BoundaryKind{touchesWater(a, b) ? BoundaryRole::Open : BoundaryRole::Land};
  };
  grid.boundaries = cutLoops(grid, boundaryLoops(grid), kindOf);
  nameBoundaries(rivers);
  ends.inflows = static_cast<std::size_t>(
      std::ranges::count_if(grid.boundaries, [](const Boundary& b) { return b.role == BoundaryRole::River; }));
  return ends;
}

}  // namespace coastmesh
