// Examples of the headers in gis that write, repair and partition grids: each is run as a test and shown in the API
// reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "gis/check/check_target.hpp"
#include "gis/check/target_defect.hpp"
#include "gis/error.hpp"
#include "gis/fields/field_source.hpp"
#include "gis/format/grid_format.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/format/poly_io.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid.hpp"
#include "gis/grid/grid_parts.hpp"
#include "gis/grid/linked_grid.hpp"
#include "gis/model/apart_waters.hpp"
#include "gis/model/assign_boundaries.hpp"
#include "gis/model/boundary_edges.hpp"
#include "gis/model/boundary_rules.hpp"
#include "gis/model/depth.hpp"
#include "gis/model/set_fields.hpp"
#include "gis/model/target.hpp"
#include "gis/model/time_step.hpp"
#include "gis/raster/raster_axes.hpp"
#include "gis/raster/raster_band.hpp"
#include "gis/repair/repair_options.hpp"
#include "gis/repair/repair_report.hpp"
#include "gis/repair/repair_target.hpp"
#include "gis/solver/mesh_graph.hpp"
#include "gis/solver/partition_graph.hpp"
#include "gis/solver/partition_grid.hpp"
#include "gis/solver/vertical_levels.hpp"
#include "tests/reference/folder.hpp"

namespace coastmesh {
namespace {

class GisGridExamples : public ::testing::Test {
 protected:
  // Four by four squares of 1 km, two triangles each, 20 m deep, in UTM zone 35.
  static Grid squares() {
    Grid grid;
    grid.crs = parseCrs("EPSG:32635");
    for (int j = 0; j <= 4; ++j) {
      for (int i = 0; i <= 4; ++i) grid.nodes.push_back({500000.0 + 1000.0 * i, 6800000.0 + 1000.0 * j});
    }
    for (std::uint32_t j = 0; j < 4; ++j) {
      for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t k = 5 * j + i;
        grid.triangles.push_back({k, k + 1, k + 6});
        grid.triangles.push_back({k, k + 6, k + 5});
      }
    }
    grid.z.assign(grid.nodes.size(), -20.0);
    std::vector<EdgeConflict> conflicts;
    grid.boundaries = findBoundaries(toTriMesh(grid, Projection::plane(), conflicts));
    return grid;
  }

  reference::WorkFolder folder_;
};

// gis/format/grid_format.hpp: A file format, and what it can hold.
TEST_F(GisGridExamples, GridFormat) {
  //! [gis/format/grid_format.hpp]
  std::vector<std::string_view> with_sizes;  // formats that keep the requested edge lengths
  for (const GridFormat& format : gridFormats()) {
    if (format.writable && format.holds.has(GridPart::Sizes)) with_sizes.push_back(format.name);
  }
  //! [gis/format/grid_format.hpp]
  EXPECT_NE(std::ranges::find(with_sizes, "ugrid"), with_sizes.end());
  EXPECT_EQ(std::ranges::find(with_sizes, "adcirc"), with_sizes.end());
}

// gis/format/grid_io.hpp: Grids written to files, completely or not at all, and read back.
TEST_F(GisGridExamples, GridIo) {
  const Grid grid = squares();
  //! [gis/format/grid_io.hpp]
  StagedOutput output("squares.nc", gridFormatFor("squares.nc"), /*overwrite=*/false);
  output.write(grid);
  output.commit();
  const Grid read = readGrid("squares.nc");
  //! [gis/format/grid_io.hpp]
  EXPECT_EQ(read.nodes, grid.nodes);
  EXPECT_EQ(read.triangles, grid.triangles);
}

// gis/format/poly_io.hpp: Plane graphs in Triangle's .poly files.
TEST_F(GisGridExamples, PolyIo) {
  //! [gis/format/poly_io.hpp]
  Pslg square;
  square.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  square.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  writePoly(square, "square.poly");
  const Pslg read = readPoly("square.poly");
  //! [gis/format/poly_io.hpp]
  EXPECT_EQ(read.points, square.points);
  EXPECT_EQ(read.segments.size(), 4u);
}

// gis/grid/boundary_chains.hpp: Boundaries found in a mesh.
TEST_F(GisGridExamples, BoundaryChains) {
  const Grid grid = squares();
  std::vector<EdgeConflict> conflicts;
  const TriMesh mesh = toTriMesh(grid, Projection::plane(), conflicts);
  //! [gis/grid/boundary_chains.hpp]
  const std::vector<Boundary> boundaries = findBoundaries(mesh);
  const std::vector<NodePair> edges = edgesOf(boundaries[0]);
  //! [gis/grid/boundary_chains.hpp]
  EXPECT_EQ(edges.size(), 16u);
}

// gis/grid/boundary_kinds.hpp: The boundary divided by the kind of its edges.
TEST_F(GisGridExamples, BoundaryKinds) {
  //! [gis/grid/boundary_kinds.hpp]
  Grid grid = squares();
  const auto southern = [&](std::uint32_t node) { return grid.nodes[node].y == 6800000.0; };
  grid.boundaries = cutLoops(grid, boundaryLoops(grid), [&](std::uint32_t from, std::uint32_t to) {
    return BoundaryKind{southern(from) && southern(to) ? BoundaryRole::Open : BoundaryRole::Land};
  });
  //! [gis/grid/boundary_kinds.hpp]
  ASSERT_EQ(grid.boundaries.size(), 2u);
  const auto open = std::ranges::find(grid.boundaries, BoundaryRole::Open, &Boundary::role);
  ASSERT_NE(open, grid.boundaries.end());
  EXPECT_EQ(open->nodes.size(), 5u);
}

// gis/grid/grid.hpp: A mesh in the terms of models and GIS.
TEST_F(GisGridExamples, Grid) {
  //! [gis/grid/grid.hpp]
  Grid grid;
  grid.crs = parseCrs("EPSG:32635");
  grid.nodes = {{500000, 6800000}, {501000, 6800000}, {501000, 6801000}, {500000, 6801000}};
  grid.triangles = {{0, 1, 2}, {0, 2, 3}};
  grid.z = {-5, -8, -8, -5};
  std::vector<EdgeConflict> conflicts;  // empty if every edge has at most two triangles
  const TriMesh mesh = toTriMesh(grid, Projection::plane(), conflicts);
  //! [gis/grid/grid.hpp]
  EXPECT_TRUE(conflicts.empty());
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_NO_THROW(requireZ(grid, "fort.14"));
}

// gis/grid/grid_parts.hpp: What a grid may contain besides nodes and triangles.
TEST_F(GisGridExamples, GridParts) {
  //! [gis/grid/grid_parts.hpp]
  const GridParts kept{GridPart::Title, GridPart::Ibtypes};
  const bool rivers = kept.has(GridPart::Rivers);
  //! [gis/grid/grid_parts.hpp]
  EXPECT_FALSE(rivers);
  EXPECT_TRUE(kept.has(GridPart::Title));
}

// gis/grid/linked_grid.hpp: A grid's triangles with their neighbours.
TEST_F(GisGridExamples, LinkedGrid) {
  //! [gis/grid/linked_grid.hpp]
  Grid grid;
  grid.nodes = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  grid.triangles = {{0, 1, 2}, {0, 2, 3}};
  const LinkedGrid linked = linkGrid(grid);
  const std::vector<std::vector<VertexId>> loops = boundaryLoops(linked.mesh);
  //! [gis/grid/linked_grid.hpp]
  EXPECT_TRUE(linked.conflicts.empty());
  EXPECT_EQ(loops, (std::vector<std::vector<VertexId>>{{0, 1, 2, 3}}));
}

// gis/model/apart_waters.hpp: Water without a connection to an open boundary.
TEST_F(GisGridExamples, ApartWaters) {
  //! [gis/model/apart_waters.hpp]
  Grid grid;
  grid.nodes = {{0, 0}, {2, 0}, {1, 2}, {5, 0}, {6, 0}, {5, 1}};
  grid.triangles = {{0, 1, 2}, {3, 4, 5}};
  grid.area_m2 = {2.0, 0.5};
  grid.boundaries = {{BoundaryRole::Open, true, {0, 1, 2}}, {BoundaryRole::Land, true, {3, 4, 5}}};
  const DroppedWaters dropped = dropApartWaters(grid);
  //! [gis/model/apart_waters.hpp]
  EXPECT_EQ(dropped.waters, 1u);
  EXPECT_EQ(grid.triangles.size(), 1u);
  EXPECT_TRUE(apartWaters(grid).empty());
}

// gis/model/assign_boundaries.hpp: Divides the boundary into open parts, rivers and shore.
TEST_F(GisGridExamples, AssignBoundaries) {
  //! [gis/model/assign_boundaries.hpp]
  Grid grid = squares();
  for (std::size_t node = 0; node < 5; ++node) grid.z[node] = -300.0;  // deep water in the south
  BoundaryOptions options;
  options.open_deeper_m = 200.0;
  const BoundaryReport report = assignBoundaries(grid, options);
  //! [gis/model/assign_boundaries.hpp]
  EXPECT_EQ(report.edges_by_depth, 4u);
  EXPECT_TRUE(std::ranges::any_of(grid.boundaries, [](const Boundary& b) { return b.role == BoundaryRole::Open; }));
}

// gis/model/boundary_edges.hpp: Kinds of the boundary edges of a mesh, or of a domain before meshing.
TEST_F(GisGridExamples, BoundaryEdges) {
  //! [gis/model/boundary_edges.hpp]
  const Crs crs = parseCrs("EPSG:32635");
  const std::vector<Point> corners{{0, 0}, {1000, 0}, {1000, 1000}, {0, 1000}};
  const std::vector<double> z{-300, -300, -20, -20};
  BoundaryEdges boundary{
      {{0, 1}, {1, 2}, {2, 3}, {3, 0}}, {4}, std::vector<BoundaryKind>(4), std::vector<bool>(4, true)};
  BoundaryOptions options;
  options.open_deeper_m = 200.0;
  const BoundaryReport report = defineKinds({crs, corners, z}, options, boundary);
  //! [gis/model/boundary_edges.hpp]
  EXPECT_EQ(report.edges_by_depth, 1u);
  EXPECT_EQ(boundary.kinds[0].role, BoundaryRole::Open);
  EXPECT_EQ(mergeShort({crs, corners, z}, 2000.0, boundary), 1u);
}

// gis/model/boundary_rules.hpp: Boundary types from polygons and lines, read once for any number of grids.
TEST_F(GisGridExamples, BoundaryRules) {
  reference::WorkFolder::write("types.geojson", R"({"type": "Feature", "properties": {"type": "tidal"}, "geometry":
      {"type": "LineString", "coordinates": [[0, 0], [10, 0]]}})");
  //! [gis/model/boundary_rules.hpp]
  const BoundaryRules rules = BoundaryRules::ofFile("types.geojson", "type");
  const std::vector<Point> places{{1, 0}, {2, 0}, {2, 1}};
  const auto kinds = rules.kindsOf(wgs84(), places, {{0, 1}, {1, 2}}, {true, true});
  //! [gis/model/boundary_rules.hpp]
  ASSERT_TRUE(kinds[0].has_value());
  EXPECT_EQ(textOfKind(*kinds[0]), "open");
  EXPECT_FALSE(kinds[1].has_value());
  EXPECT_EQ(kindOfText("tidal", "column type").role, BoundaryRole::Open);
}

// gis/check/check_target.hpp: Everything that makes a model refuse a grid.
TEST_F(GisGridExamples, CheckTarget) {
  //! [gis/check/check_target.hpp]
  Grid grid = squares();
  std::swap(grid.triangles[3][0], grid.triangles[3][1]);  // now clockwise
  std::vector<std::string_view> found;
  for (const TargetDefect& defect : checkTarget(grid, Target::Adcirc)) found.push_back(toString(defect.kind));
  //! [gis/check/check_target.hpp]
  EXPECT_NE(std::ranges::find(found, toString(TargetDefectKind::Clockwise)), found.end());
  EXPECT_TRUE(checkTarget(squares(), Target::Adcirc).empty());
}

// gis/check/target_defect.hpp: What a model refuses, by kind and place.
TEST_F(GisGridExamples, TargetDefect) {
  //! [gis/check/target_defect.hpp]
  Grid grid = squares();
  grid.boundaries.clear();
  std::size_t bare = 0;  // edges of the mesh that are in no boundary
  for (const TargetDefect& defect : checkTarget(grid, Target::Schism))
    if (defect.kind == TargetDefectKind::NoBoundary) ++bare;
  //! [gis/check/target_defect.hpp]
  EXPECT_GT(bare, 0u);
}

// gis/model/depth.hpp: Depths at the nodes, from rasters.
TEST_F(GisGridExamples, Depth) {
  reference::WorkFolder::write("bed.asc",
                               "ncols 3\nnrows 3\nxllcorner 498000\nyllcorner 6798000\ncellsize 3000\n"
                               "-10 -10 -10\n-30 -30 -30\n-50 -50 -50\n");
  //! [gis/model/depth.hpp]
  Grid grid = squares();
  DepthOptions options;
  options.files = {"bed.asc"};  // elevations, metres
  options.min_depth_m = 15.0;
  const DepthReport report = setDepths(grid, options);
  //! [gis/model/depth.hpp]
  EXPECT_EQ(report.unknown, 0u);
  EXPECT_EQ(report.nodes_of_file, (std::vector<std::size_t>{25}));
  EXPECT_GE(report.least_m, 15.0);
  EXPECT_GT(grid.z[24], grid.z[0]);
}

// gis/fields/field_source.hpp: Where a nodal attribute comes from, as the user says it.
TEST_F(GisGridExamples, FieldSource) {
  //! [gis/fields/field_source.hpp]
  std::vector<FieldSource> sources;
  std::string wrong = addFieldSource("manning=cover.tif,n.csv", sources);  // classes, and their values
  wrong += addFieldSource("manning=0.022", sources);                       // for all other nodes
  const std::vector<std::string> files = filesOfFieldSource("manning=cover.tif,n.csv");
  //! [gis/fields/field_source.hpp]
  EXPECT_EQ(wrong, "");
  EXPECT_EQ(sources.front().table, "n.csv");
  EXPECT_EQ(sources.back().number, 0.022);
  EXPECT_EQ(files.size(), 2u);
}

// gis/model/set_fields.hpp: Nodal attributes, from rasters and numbers.
TEST_F(GisGridExamples, SetFields) {
  reference::WorkFolder::write("n.asc",
                               "ncols 2\nnrows 1\nxllcorner 490000\nyllcorner 6790000\ncellsize 20000\n0.03 0.03\n");
  //! [gis/model/set_fields.hpp]
  Grid grid = squares();
  const std::vector<FieldSource> sources{{"mannings_n_at_sea_floor", {}, "n.asc"}, {"surface_canopy_coefficient", 1.0}};
  const std::vector<FieldReport> reports = setFields(grid, sources, DepthMethod::Bilinear, DepthFill::Neighbours);
  //! [gis/model/set_fields.hpp]
  EXPECT_EQ(reports.front().nodes_of_file, (std::vector<std::size_t>{25}));
  EXPECT_EQ(grid.node_fields.front().values, std::vector<double>(25, 0.03));
  EXPECT_EQ(grid.node_fields.back().values, std::vector<double>(25, 1.0));
}

// gis/model/target.hpp: The models that a grid may be made for.
TEST_F(GisGridExamples, Target) {
  //! [gis/model/target.hpp]
  const std::vector<Target> targets = targetsNamed({"schism", "adcirc", "schism"});
  //! [gis/model/target.hpp]
  EXPECT_EQ(targets, (std::vector<Target>{Target::Adcirc, Target::Schism}));
  EXPECT_THROW(targetsNamed({"no model"}), OptionError);
}

// gis/model/time_step.hpp: The time step that a grid allows an explicit model.
TEST_F(GisGridExamples, TimeStep) {
  const Grid grid = squares();
  //! [gis/model/time_step.hpp]
  const StepReport step = measureStep(grid);  // 1000 m over the speed of a long wave in 20 m of water
  const std::vector<ShortStep> too_short = stepsBelow(grid, /*time_step_s=*/100.0, /*courant=*/1.0);
  //! [gis/model/time_step.hpp]
  EXPECT_NEAR(step.step_s, 1000.0 / std::sqrt(9.81 * 20.0), 0.2);
  EXPECT_EQ(too_short.size(), grid.triangles.size());
}

// gis/raster/raster_axes.hpp: Positions of pixels in a raster with uneven axes.
TEST_F(GisGridExamples, RasterAxes) {
  //! [gis/raster/raster_axes.hpp]
  const RasterAxis rows{"lat", "degrees_north", "latitude", {10.0, 10.9, 11.7, 12.4}};
  const double step = (12.4 - 10.0) / 3.0;  // as reported by GDAL
  const auto axis = UnevenAxis::from(rows, step, "bed.nc");
  const double pixel = axis->pixelOf((10.9 - 10.0) / step + 0.5);  // of a place at 10.9 degrees
  //! [gis/raster/raster_axes.hpp]
  EXPECT_NEAR(pixel, 1.5, 1e-9);  // the centre of the second pixel
  EXPECT_TRUE(rows.isLatitude());
}

// gis/raster/raster_band.hpp: The first band of a raster, read in windows.
TEST_F(GisGridExamples, RasterBand) {
  reference::WorkFolder::write("bed.asc",
                               "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999\n"
                               "1 2 3\n4 -9999 6\n");
  //! [gis/raster/raster_band.hpp]
  const RasterBand band("bed.asc");
  const std::vector<double> values = band.read({0, 0, band.columns(), band.rows()});
  const Point pixel = band.pixelOf({15.0, 5.0});  // columns and rows from the upper left corner
  //! [gis/raster/raster_band.hpp]
  EXPECT_EQ(values[2], 3.0);
  EXPECT_TRUE(std::isnan(values[4]));
  EXPECT_EQ(pixel, (Point{1.5, 1.5}));
}

// gis/repair/repair_options.hpp: The properties that repairs should keep.
TEST_F(GisGridExamples, RepairOptions) {
  //! [gis/repair/repair_options.hpp]
  RepairOptions options;
  options.min_angle_deg = 33.0;  // met by the mesh, and to be kept by repairs
  options.time_step_s = 20.0;
  //! [gis/repair/repair_options.hpp]
  EXPECT_FALSE(options.shore_moves);
}

// gis/repair/repair_report.hpp: What was repaired, and what could not be.
TEST_F(GisGridExamples, RepairReport) {
  Grid grid = squares();
  std::swap(grid.triangles[3][0], grid.triangles[3][1]);
  //! [gis/repair/repair_report.hpp]
  const std::array targets{Target::Adcirc};
  const RepairReport report = repairForTargets(grid, targets);
  std::vector<std::string> done;
  for (const Repair& repair : report.repairs) done.push_back(repair.what);
  //! [gis/repair/repair_report.hpp]
  EXPECT_FALSE(done.empty());
  EXPECT_TRUE(report.left.empty());
}

// gis/repair/repair_target.hpp: Changes a grid as little as models require.
TEST_F(GisGridExamples, RepairTarget) {
  //! [gis/repair/repair_target.hpp]
  Grid grid = squares();
  grid.nodes.push_back({600000, 6800000});  // a node of no triangle
  grid.z.push_back(-1.0);
  const std::array targets{Target::Adcirc, Target::Schism};
  repairForTargets(grid, targets);
  //! [gis/repair/repair_target.hpp]
  EXPECT_EQ(grid.nodes.size(), 25u);
  EXPECT_TRUE(checkTarget(grid, Target::Schism).empty());
}

// gis/solver/mesh_graph.hpp: A solver's units of work, and the communication between them.
TEST_F(GisGridExamples, MeshGraph) {
  const Grid grid = squares();
  //! [gis/solver/mesh_graph.hpp]
  const MeshGraph elements = elementGraph(grid);
  const MeshGraph nodes = nodeGraph(grid);
  //! [gis/solver/mesh_graph.hpp]
  EXPECT_EQ(elements.size(), 32u);
  EXPECT_EQ(elements.neighbours.size(), 2u * (32u * 3u - 16u) / 2u);
  EXPECT_EQ(nodes.size(), 25u);
}

// gis/solver/partition_graph.hpp: A graph divided into parts of equal work.
TEST_F(GisGridExamples, PartitionGraph) {
  //! [gis/solver/partition_graph.hpp]
  const MeshGraph graph = elementGraph(squares());
  const std::vector<std::uint32_t> part_of = partitionGraph(graph, 4);
  const PartitionFigures figures = figuresOf(graph, part_of, 4);
  //! [gis/solver/partition_graph.hpp]
  EXPECT_EQ(figures.least, 8u);
  EXPECT_EQ(figures.most, 8u);
  EXPECT_LE(figures.balance, kMostImbalance);
}

// gis/solver/partition_grid.hpp: A grid divided among the processes of a solver.
TEST_F(GisGridExamples, PartitionGrid) {
  //! [gis/solver/partition_grid.hpp]
  Grid grid = squares();
  PartitionOptions options;
  options.parts = 2;
  options.elements = true;
  const PartitionReport report = partitionGrid(grid, options);
  //! [gis/solver/partition_grid.hpp]
  EXPECT_EQ(grid.part_of.size(), grid.triangles.size());
  ASSERT_TRUE(report.elements.has_value());
  EXPECT_EQ(report.elements->connected_parts, 2u);
}

// gis/solver/vertical_levels.hpp: Parts with the same number of layers of water.
TEST_F(GisGridExamples, VerticalLevels) {
  //! [gis/solver/vertical_levels.hpp]
  Grid grid = squares();
  PartitionOptions options;
  options.parts = 2;
  options.nodes = true;
  options.levels = VerticalLevels{{}, FesomLevels{{0, 5, 10, 20, 50, 100}}};
  const PartitionReport report = partitionGrid(grid, options);
  //! [gis/solver/vertical_levels.hpp]
  EXPECT_EQ(report.weight, "layers");
  EXPECT_EQ(grid.node_part_of.size(), grid.nodes.size());
}

}  // namespace
}  // namespace coastmesh
