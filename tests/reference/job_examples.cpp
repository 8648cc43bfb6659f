// Examples of the headers in gis/size and apps/job: each is run as a test and shown in the API reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "apps/input/job_input.hpp"
#include "apps/job/finish_grid.hpp"
#include "apps/job/group_exchange.hpp"
#include "apps/job/mesh_group.hpp"
#include "apps/job/mesh_job.hpp"
#include "apps/job/mesh_job_options.hpp"
#include "apps/job/mesh_job_result.hpp"
#include "apps/job/step_outcome.hpp"
#include "gis/flood_plain/dry_sides.hpp"
#include "gis/flood_plain/flood_options.hpp"
#include "gis/flood_plain/low_land.hpp"
#include "gis/flood_plain/plain_land.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/size/size_depth.hpp"
#include "gis/size/size_distance.hpp"
#include "gis/size/size_features.hpp"
#include "gis/size/size_field.hpp"
#include "gis/size/size_raster.hpp"
#include "gis/size/size_source.hpp"
#include "gis/weirs/beds_at_weirs.hpp"
#include "gis/weirs/raster_crests.hpp"
#include "gis/weirs/weir_crests.hpp"
#include "gis/weirs/weir_report.hpp"
#include "tests/reference/folder.hpp"

namespace coastmesh {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class JobExamples : public ::testing::Test {
 protected:
  JobExamples() { reference::WorkFolder::write("lake.geojson", reference::kLake); }

  static double sizeAt(const SizeField& field, const Point& place) {
    double size = 0.0;
    field.sample({&place, 1}, {&size, 1});
    return size;
  }
  static MeshJobResult meshedLake() {
    MeshJob job;
    job.input.files = {"lake.geojson"};
    return runMeshJob(job);
  }

  reference::WorkFolder folder_;
};

// gis/flood_plain/dry_sides.hpp: Open boundaries across dry land.
TEST_F(JobExamples, DrySides) {
  //! [gis/flood_plain/dry_sides.hpp]
  Grid grid;
  grid.nodes = {{0, 0}, {2, 0}, {1, 2}};
  grid.triangles = {{0, 1, 2}};
  grid.z = {1.0, 2.0, -3.0};  // two nodes are above the water
  grid.boundaries = {{BoundaryRole::Open, false, {0, 1, 2}}, {BoundaryRole::Land, false, {2, 0}}};
  const DrySides dry = closeDrySides(grid, /*to_the_coast=*/false);
  //! [gis/flood_plain/dry_sides.hpp]
  EXPECT_EQ(dry.edges, 2u);
  ASSERT_EQ(grid.boundaries.size(), 1u);
  EXPECT_EQ(grid.boundaries.front().role, BoundaryRole::Land);
}

// gis/flood_plain/plain_land.hpp: The land of a flood plain, whatever its height.
TEST_F(JobExamples, PlainLand) {
  Domain lake;  // a triangle in a plane
  lake.pslg.points = lake.input_points = {{0, 0}, {9, 0}, {0, 9}};
  for (VertexId i = 0; i < 3; ++i) lake.pslg.segments.push_back({i, (i + 1) % 3, 0, 0, kOutside});
  //! [gis/flood_plain/plain_land.hpp]
  const PlainLand land({lake});  // the waters of the coastline
  const bool is_water = !land.isLand({2, 2});
  Grid grid;
  grid.nodes = {{1, 1}, {8, 8}, {2, 9}};
  grid.triangles = {{0, 1, 2}};
  const LandFlags flags = landFlags(grid, &land);  // the node at (1, 1) is water
  //! [gis/flood_plain/plain_land.hpp]
  EXPECT_TRUE(is_water);
  EXPECT_FALSE(flags.isLandNode(0));
  EXPECT_TRUE(flags.isLandNode(1));
}

// gis/flood_plain/low_land.hpp: Polders.
TEST_F(JobExamples, LowLand) {
  //! [gis/flood_plain/low_land.hpp]
  Grid grid;
  grid.nodes = {{0, 0}, {2, 0}, {1, 2}};
  grid.triangles = {{0, 1, 2}};
  grid.z = {-1.0, -2.0, 3.0};
  const LowLand low = findLowLand(grid, {{1, 1, 1}, {1}});  // all of it is land of a flood plain
  markStartDry(grid, low);                                  // an attribute for ADCIRC
  //! [gis/flood_plain/low_land.hpp]
  EXPECT_EQ(low.apart.size(), 2u);
  EXPECT_EQ(low.lowest_m, 2.0);
  ASSERT_EQ(grid.node_fields.size(), 1u);
  EXPECT_EQ(grid.node_fields[0].values[2], 0.0);
  EXPECT_NE(noteOf(low, true), "");
}

// gis/weirs/weir_crests.hpp: Heights of levees from the lines of a file.
TEST_F(JobExamples, WeirCrests) {
  //! [gis/weirs/weir_crests.hpp]
  Coastline coastline;
  Feature& levee = coastline.features.emplace_back();
  levee.use = FeatureUse::Weir;
  levee.lines = {{{0, 0}, {500, 0}}};
  levee.attributes = {{"name", "west dike"}, {"height", "4.5"}};
  const std::vector<WeirSource> weirs = weirSources(coastline, /*zero_m=*/0.5);
  //! [gis/weirs/weir_crests.hpp]
  EXPECT_EQ(weirs.at(0).crest.height_m, 4.0);
  EXPECT_EQ(weirs[0].name, "west dike");
}

// gis/weirs/raster_crests.hpp: Heights of levees from terrain.
TEST_F(JobExamples, RasterCrests) {
  //! [gis/weirs/raster_crests.hpp]
  Grid grid;
  grid.nodes = {{0, 0}, {500, 0}, {250, 400}, {250, -400}};
  grid.triangles = {{0, 1, 2}, {0, 3, 1}};
  grid.lines = {{LineKind::Weir, "west dike", false, {0, 1}}};
  const std::vector<WeirSource> weirs{{"west dike", {{{0, 0}, {500, 0}}}, WeirCrest{.height_m = 4.5}}};
  const RasterCrests crests = findRasterCrests(grid, weirs, CrestRasters{.files = {"lidar.tif"}, .search_m = 20}, {});
  const bool has_any = !crests.of_edges.empty();  // the only weir has a height, and the raster is not read
  //! [gis/weirs/raster_crests.hpp]
  EXPECT_FALSE(has_any);
  EXPECT_EQ(crests.warnings.size(), 1u);
}

// gis/weirs/weir_report.hpp: What became of levees.
TEST_F(JobExamples, WeirReport) {
  Grid grid;
  //! [gis/weirs/weir_report.hpp]
  FinishOptions options;
  options.targets = {"adcirc"};
  const FinishReport report = finishGrid(grid, options);
  const bool has_weirs = report.weirs.pairs > 0;
  const std::vector<std::string> notes = report.weirs.notes();
  //! [gis/weirs/weir_report.hpp]
  EXPECT_FALSE(has_weirs);
  EXPECT_TRUE(notes.empty());
}

// gis/weirs/beds_at_weirs.hpp: Beds and crests that go together.
TEST_F(JobExamples, WeirBeds) {
  //! [gis/weirs/beds_at_weirs.hpp]
  Grid grid;
  grid.nodes = {{0, 0}, {2, 0}, {1, 2}};
  grid.triangles = {{0, 1, 2}};
  grid.z = {1.0, 1.0, -3.0};
  Boundary& shore = grid.boundaries.emplace_back(Boundary{BoundaryRole::Land, false, {0, 1}, 3});
  shore.weir = {0.5, 1.0, 0.5, 1.0};           // crests of 0.5 m, below their nodes
  const WeirBeds beds = fitWeirsToBeds(grid);  // the nodes get the depth beside them
  //! [gis/weirs/beds_at_weirs.hpp]
  EXPECT_EQ(beds.lowered, 2u);
  EXPECT_EQ(grid.z[0], -3.0);
}

// gis/flood_plain/flood_options.hpp: Land that is meshed besides the water.
TEST_F(JobExamples, FloodOptions) {
  //! [gis/flood_plain/flood_options.hpp]
  MeshJob job;
  job.input.flood.height_m = 10.0;
  job.input.flood.heights.files = {"dem.tif"};
  job.input.flood.size_m = 200.0;
  job.finish.depth = job.input.flood.heights;
  job.finish.depth.has_land = true;
  //! [gis/flood_plain/flood_options.hpp]
  EXPECT_TRUE(job.finish.any());
}

// gis/size/size_depth.hpp: Sizes that follow from depths.
TEST_F(JobExamples, SizeDepth) {
  //! [gis/size/size_depth.hpp]
  const DepthRules tide;  // the M2 tide
  const double wavelength_m = wavelengthOf(tide.period_s, 4000.0);
  DepthRules rules;
  rules.wave_elements = 300.0;             // elements per wavelength
  rules.bands = {{0.0, 10.0, 200.0}};      // and 200 m where the depth is below 10 m
  const TileRule rule = depthRule(rules);  // for a RasterField
  //! [gis/size/size_depth.hpp]
  EXPECT_NEAR(wavelength_m, tide.period_s * std::sqrt(9.81 * 4000.0), 0.01 * wavelength_m);
  EXPECT_TRUE(rules.any());
  EXPECT_TRUE(rule.sizes != nullptr);
}

// gis/size/size_distance.hpp: Sizes that grow with the distance from lines.
TEST_F(JobExamples, SizeDistance) {
  //! [gis/size/size_distance.hpp]
  const SizedLine shore{{0, 0}, {1000, 0}, /*size_m=*/50.0, /*rate=*/0.1};
  const DistanceField field({shore}, [](const Point&) { return 1.0; });
  //! [gis/size/size_distance.hpp]
  EXPECT_NEAR(sizeAt(field, {500, 0}), 50.0, 1e-9);
  EXPECT_NEAR(sizeAt(field, {500, 300}), 80.0, 1e-9);
}

// gis/size/size_features.hpp: Sizes requested by the features of a vector layer.
TEST_F(JobExamples, SizeFeatures) {
  reference::WorkFolder::write("wanted.geojson", R"({"type": "Feature", "properties": {"size": 25}, "geometry":
      {"type": "Point", "coordinates": [100, 100]}})");
  //! [gis/size/size_features.hpp]
  const Crs plane = parseCrs("EPSG:4326");
  const SizedFeatures features = readSizedFeatures("wanted.geojson", plane, /*usual_rate=*/0.2);
  //! [gis/size/size_features.hpp]
  ASSERT_EQ(features.parts.size(), 1u);
  EXPECT_EQ(features.parts[0].size_m, 25.0);
  EXPECT_EQ(features.parts[0].rate, 0.2);
}

// gis/size/size_field.hpp: One source of sizes.
TEST_F(JobExamples, SizeField) {
  //! [gis/size/size_field.hpp]
  class Western final : public SizeField {  // 100 m west of 0, nothing east of it
   public:
    void sample(std::span<const Point> places, std::span<double> sizes) const override {
      for (std::size_t i = 0; i < places.size(); ++i) sizes[i] = places[i].x < 0.0 ? 100.0 : kInfinity;
    }
    void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override {
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const double west = boxes[i].centre.x - boxes[i].half, east = boxes[i].centre.x + boxes[i].half;
        ranges[i] = {west < 0.0 ? 100.0 : kInfinity, east < 0.0 ? 100.0 : kInfinity};
      }
    }
    double least() const override { return 100.0; }
  };
  const Western field;
  //! [gis/size/size_field.hpp]
  EXPECT_EQ(sizeAt(field, {-1, 0}), 100.0);
  EXPECT_EQ(sizeAt(field, {1, 0}), kInfinity);
}

// gis/size/size_rule.hpp: Sizes from a raster's values.
TEST_F(JobExamples, SizeRule) {
  reference::WorkFolder::write("sizes.asc",
                               "ncols 4\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize 100\n"
                               "60 60 60 60\n60 60 60 60\n60 60 60 60\n60 60 60 60\n");
  //! [gis/size/size_rule.hpp]
  TileRule as_it_says;
  as_it_says.sizes = [](const RasterTile& tile, std::span<float> sizes) {
    for (int y = 0; y < tile.height; ++y) {
      for (int x = 0; x < tile.width; ++x) sizes[static_cast<std::size_t>(y * tile.width + x)] = tile.at(x, y);
    }
  };
  const RasterField field(readRasterGeometry("sizes.asc"), Crs{}, Projection::plane(), Box{0, 0, 400, 400}, as_it_says,
                          inOrder);
  //! [gis/size/size_rule.hpp]
  EXPECT_NEAR(sizeAt(field, {200, 200}), 60.0, 0.1);
}

// gis/size/size_source.hpp: All requested sizes as one function on the plane.
TEST_F(JobExamples, SizeSource) {
  //! [gis/size/size_source.hpp]
  const JobInput input({.files = {"lake.geojson"}});
  CleanReport report;
  const Domain domain = input.domain(0, report);

  SizeOptions options;
  options.shore_m = 200.0;
  options.most_m = 1000.0;
  const SizeInputs inputs = readSizeInputs(options, input.coastline().crs);
  const DomainSizes sizes = makeSizeFunction(options, inputs, domain, /*most_vertices=*/1e6, inOrder);
  //! [gis/size/size_source.hpp]
  const double at_the_shore = sizes.function->at(domain.pslg.points[0]);
  EXPECT_GT(at_the_shore, 180.0);
  EXPECT_LT(at_the_shore, 220.0);
  EXPECT_GT(sizes.demand.vertices, 100.0);
}

// apps/job/mesh_job.hpp: The whole way from files to a grid.
TEST_F(JobExamples, MeshJob) {
  //! [apps/job/mesh_job.hpp]
  MeshJob job;
  job.input.files = {"lake.geojson"};
  job.mesh.refine.min_angle_deg = 34.0;
  const MeshJobResult result = runMeshJob(job);

  StagedOutput output("lake.nc", gridFormatFor("lake.nc"), /*overwrite=*/false);
  output.write(result.grid);
  output.commit();
  //! [apps/job/mesh_job.hpp]
  EXPECT_TRUE(result.complete());
  EXPECT_TRUE(std::filesystem::exists("lake.nc"));
}

// apps/job/mesh_job_options.hpp: What to mesh and how, and communication with the caller.
TEST_F(JobExamples, MeshJobOptions) {
  //! [apps/job/mesh_job_options.hpp]
  MeshJob job;
  job.input.files = {"lake.geojson"};
  job.sizes.most_m = 500.0;  // no edge is longer
  job.parallel.threads = 2;
  std::vector<std::string> phases;
  JobControl control;
  control.progress = [&](std::string_view phase, double) {
    if (phases.empty() || phases.back() != phase) phases.emplace_back(phase);
  };
  const MeshJobResult result = runMeshJob(job, control);
  //! [apps/job/mesh_job_options.hpp]
  EXPECT_NE(std::ranges::find(phases, "refine"), phases.end());
  EXPECT_LE(result.quality.longest_edge, 501.0);
}

// apps/job/mesh_job_result.hpp: The grid, and how it was made.
TEST_F(JobExamples, MeshJobResult) {
  //! [apps/job/mesh_job_result.hpp]
  const MeshJobResult result = meshedLake();
  const bool as_asked = result.complete();  // nothing refused, all bounds met
  const double least_angle = result.quality.min_angle_deg;
  const std::uint64_t digest = result.digest;  // the same for any number of threads
  //! [apps/job/mesh_job_result.hpp]
  EXPECT_TRUE(as_asked);
  EXPECT_GT(least_angle, 33.0);
  EXPECT_EQ(digest, meshedLake().digest);
}

// apps/input/input_options.hpp: What to read, and what of it is the domain.
TEST_F(JobExamples, InputOptions) {
  //! [apps/input/input_options.hpp]
  InputOptions options;
  options.files = {"land.geojson"};
  options.frame.side = DomainSide::Outside;  // the water between these polygons and the box
  options.frame.box = Box{-4.0, 50.0, -2.0, 51.0};
  options.constraints = {"piers.geojson"};
  const std::vector<Source> sources = sourcesOf(options);
  //! [apps/input/input_options.hpp]
  requireOneFrame(options);
  ASSERT_EQ(sources.size(), 2u);
  EXPECT_EQ(sources[1].use, FeatureUse::Constraint);
}

// apps/input/job_input.hpp: The features read, in groups, and the domains in the plane made from them.
TEST_F(JobExamples, JobInput) {
  //! [apps/input/job_input.hpp]
  InputOptions options;
  options.files = {"lake.geojson"};
  options.simplify_m = 50.0;
  const JobInput input(options);
  CleanReport report;
  const Domain domain = input.domain(0, report);
  const std::optional<double> area_m2 = input.area(0);
  //! [apps/input/job_input.hpp]
  EXPECT_EQ(input.groups(), 1u);
  EXPECT_GE(domain.pslg.points.size(), 8u);
  ASSERT_TRUE(area_m2.has_value());
  EXPECT_NEAR(*area_m2, 1.1e8, 0.2e8);
}

// apps/job/finish_grid.hpp: What is done to a mesh before it is written.
TEST_F(JobExamples, FinishGrid) {
  Grid grid = meshedLake().grid;
  grid.z.assign(grid.nodes.size(), -30.0);
  //! [apps/job/finish_grid.hpp]
  FinishOptions options;
  options.boundaries.open_deeper_m = 20.0;
  options.targets = {"adcirc"};
  const FinishReport report = finishGrid(grid, options);
  //! [apps/job/finish_grid.hpp]
  EXPECT_TRUE(report.mended);
  EXPECT_GT(report.boundaries.edges_by_depth, 0u);
  EXPECT_TRUE(report.repairs.left.empty());
}

// apps/job/group_exchange.hpp: Groups of features that are meshed separately, as in shards of a large job.
TEST_F(JobExamples, GroupExchange) {
  //! [apps/job/group_exchange.hpp]
  std::mutex mutex;
  std::size_t kept = 0;
  MeshJob job;
  job.input.files = {"lake.geojson"};
  job.exchange.keep = [&](std::size_t, const GroupResult&) {
    const std::lock_guard lock(mutex);
    ++kept;
  };
  runMeshJob(job);
  //! [apps/job/group_exchange.hpp]
  EXPECT_EQ(kept, 1u);
}

// apps/job/step_outcome.hpp: Time step and shortest edges of a finished grid, compared with those requested.
TEST_F(JobExamples, StepOutcome) {
  Grid grid = meshedLake().grid;
  grid.z.assign(grid.nodes.size(), -30.0);
  //! [apps/job/step_outcome.hpp]
  SizeOptions sizes;
  sizes.time_step_s = 600.0;  // far too long
  const StepOutcome outcome = measureOutcome(grid, sizes, inOrder);
  const std::string line = stepText(outcome.step, /*plane=*/false);
  //! [apps/job/step_outcome.hpp]
  EXPECT_FALSE(outcome.held());
  EXPECT_NE(line, "");
}

}  // namespace
}  // namespace coastmesh
