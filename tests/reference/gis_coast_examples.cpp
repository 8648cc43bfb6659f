// Examples of the headers in gis that read, project and clean coasts: each is run as a test and shown in the API
// reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "core/triangulate/delaunay.hpp"
#include "gis/clean/bend_edges.hpp"
#include "gis/clean/clean.hpp"
#include "gis/clean/clean_options.hpp"
#include "gis/clean/clean_report.hpp"
#include "gis/clean/domain.hpp"
#include "gis/clean/followed_waters.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/coast/frame.hpp"
#include "gis/coast/group_features.hpp"
#include "gis/coast/snap_distance.hpp"
#include "gis/crs/crs.hpp"
#include "gis/crs/crs_definition.hpp"
#include "gis/crs/resolution.hpp"
#include "gis/crs/space_ball.hpp"
#include "gis/error.hpp"
#include "gis/file/output_files.hpp"
#include "gis/file/staged_files.hpp"
#include "gis/follow/follow_options.hpp"
#include "gis/follow/shore_guides.hpp"
#include "gis/follow/shore_sizes.hpp"
#include "gis/follow/shore_triangles.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/geometry/box.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/projection/plane_table.hpp"
#include "gis/projection/projection.hpp"
#include "gis/projection/scale_table.hpp"
#include "gis/projection/surface_kind.hpp"
#include "gis/read/read_coastline.hpp"
#include "gis/read/read_report.hpp"
#include "gis/read/source.hpp"
#include "gis/shore/even_sizes.hpp"
#include "gis/shore/shore_graph.hpp"
#include "tests/reference/folder.hpp"

namespace coastmesh {
namespace {

class GisCoastExamples : public ::testing::Test {
 protected:
  GisCoastExamples() { reference::WorkFolder::write("lake.geojson", reference::kLake); }

  static Coastline lake() {
    ReadReport report;
    return readCoastline({"lake.geojson"}, report);
  }
  static Coastline squareFeature(double side) {
    Coastline coastline;
    coastline.features.resize(1);
    coastline.features[0].polygons = {{{{0, 0}, {side, 0}, {side, side}, {0, side}}, {}}};
    return coastline;
  }
  // Water 20 long and 1 wide, as a graph whose coast is to be fitted to sizes.
  static ShoreGraph channel() {
    ShoreGraph graph;
    graph.pslg.points = {{0, 0}, {20, 0}, {20, 1}, {0, 1}};
    for (VertexId i = 0; i < 4; ++i) {
      graph.pslg.segments.push_back({i, (i + 1) % 4, 0, 0, kOutside});
      graph.source.push_back(i);
    }
    return graph;
  }

  reference::WorkFolder folder_;
};

// gis/clean/bend_edges.hpp: Bends long edges along the lines on the Earth that they represent.
TEST_F(GisCoastExamples, BendEdges) {
  //! [gis/clean/bend_edges.hpp]
  Coastline coastline = squareFeature(10.0);  // degrees: its northern edge runs along a parallel
  coastline.crs = wgs84();
  const Projection projection = Projection::fitted(coastline, {0});
  const std::size_t added = bendEdges(coastline, {0}, projection, EdgeLine::LonLat, 100.0);
  //! [gis/clean/bend_edges.hpp]
  EXPECT_GT(added, 0u);
  EXPECT_EQ(coastline.features[0].polygons[0].outer.size(), 4 + added);
}

// gis/clean/clean.hpp: From features to a plane graph that can be meshed.
TEST_F(GisCoastExamples, Clean) {
  //! [gis/clean/clean.hpp]
  const Coastline coastline = lake();
  const std::vector<std::size_t> members = {0};  // features that are meshed together
  CleanReport report;
  const Domain domain = cleanFeatures(coastline, members, Projection::fitted(coastline, members), {}, report);
  const TriMesh mesh = constrainedDelaunay(domain.pslg);
  //! [gis/clean/clean.hpp]
  EXPECT_EQ(domain.pslg.points.size(), 9u);
  EXPECT_TRUE(report.edits.empty());
  EXPECT_GT(mesh.triangles.size(), 0u);
}

// gis/clean/clean_options.hpp: What cleaning may change.
TEST_F(GisCoastExamples, CleanOptions) {
  //! [gis/clean/clean_options.hpp]
  CleanOptions options;
  options.simplify_m = 20.0;           // no shore is moved further
  options.min_island_area_m2 = 2.0e6;  // smaller islands become water
  //! [gis/clean/clean_options.hpp]
  const Coastline coastline = lake();
  CleanReport report;
  const Domain domain = cleanFeatures(coastline, {0}, Projection::fitted(coastline, {0}), options, report);
  EXPECT_EQ(domain.pslg.points.size(), 6u);
  EXPECT_EQ(report.counts[static_cast<std::size_t>(EditKind::SmallIsland)], 1u);
}

// gis/clean/clean_report.hpp: What cleaning changed, and where.
TEST_F(GisCoastExamples, CleanReport) {
  //! [gis/clean/clean_report.hpp]
  Coastline coastline = squareFeature(4.0);
  coastline.features[0].polygons[0].outer = {{0, 0}, {4, 4}, {4, 0}, {0, 4}};  // crosses itself in the middle
  CleanReport report;
  cleanFeatures(coastline, {0}, Projection::plane(), {}, report);
  std::vector<std::string> changes;
  for (const Edit& edit : report.edits) changes.emplace_back(toString(edit.kind));
  //! [gis/clean/clean_report.hpp]
  EXPECT_NE(std::ranges::find(changes, "self-crossing"), changes.end()) << changes.front();
}

// gis/clean/domain.hpp: A group of features as a plane graph, with the data that lead back to the map.
TEST_F(GisCoastExamples, Domain) {
  const Coastline coastline = lake();
  CleanReport report;
  //! [gis/clean/domain.hpp]
  const Domain domain = cleanFeatures(coastline, {0}, Projection::fitted(coastline, {0}), {}, report);
  const Point in_the_plane = domain.pslg.points[0];  // metres
  const Point on_the_map = domain.input_points[0];   // degrees, bit for bit as they were read
  //! [gis/clean/domain.hpp]
  EXPECT_EQ(on_the_map, (Point{25.0, 62.0}));
  EXPECT_GT(std::hypot(in_the_plane.x, in_the_plane.y), 1000.0);
  EXPECT_FALSE(domain.closed());
}

// gis/clean/followed_waters.hpp: Changes of the water made by following sizes, for notes.
TEST_F(GisCoastExamples, FollowedWaters) {
  //! [gis/clean/followed_waters.hpp]
  FollowedWaters all, group;
  group.area_m2 = 3e6;
  group.cut_off.add({1.5e5, "0.15 km²", " at (10, 50)"});
  all.append(std::move(group));
  const double left_out = all.cut_off.area_m2 / all.area_m2;  // of all groups
  //! [gis/clean/followed_waters.hpp]
  EXPECT_DOUBLE_EQ(left_out, 0.05);
  EXPECT_EQ(all.cut_off.count, 1u);
}

// gis/coast/coastline.hpp: Polygons and lines as read, and the purpose of each.
TEST_F(GisCoastExamples, Coastline) {
  //! [gis/coast/coastline.hpp]
  Coastline coastline;
  Feature water;
  water.fid = 7;
  water.polygons = {{{{0, 0}, {100, 0}, {100, 60}, {0, 60}}, {}}};
  Feature dyke;
  dyke.use = FeatureUse::Constraint;
  dyke.lines = {{{20, 30}, {80, 30}}};
  coastline.features = {water, dyke};
  //! [gis/coast/coastline.hpp]
  CleanReport report;
  const Domain domain = cleanFeatures(coastline, {0, 1}, Projection::plane(), {}, report);
  EXPECT_EQ(domain.pslg.segments.size(), 5u);
  EXPECT_EQ(domain.lines.size(), 1u);
}

// gis/coast/frame.hpp: The sea within a box, where the polygons are land.
TEST_F(GisCoastExamples, Frame) {
  //! [gis/coast/frame.hpp]
  Coastline coastline = squareFeature(10.0);  // an island
  FrameOptions options;
  options.side = DomainSide::Outside;
  options.box = Box{-20.0, -20.0, 40.0, 30.0};
  const FrameReport report = frameCoastline(coastline, options);
  //! [gis/coast/frame.hpp]
  EXPECT_EQ(report.beyond_frame, 0u);
  ASSERT_EQ(coastline.features.size(), 2u);
  EXPECT_EQ(coastline.features[0].use, FeatureUse::Land);
  EXPECT_EQ(coastline.features[1].use, FeatureUse::Frame);
}

// gis/coast/snap_distance.hpp: Which features are meshed together.
TEST_F(GisCoastExamples, SnapDistance) {
  //! [gis/coast/snap_distance.hpp]
  Coastline coastline = squareFeature(10.0);
  coastline.features.push_back(coastline.features[0]);
  for (Point& p : coastline.features[1].polygons[0].outer) p.x += 10.001;  // a gap of 0.001 between the two
  const SnapDistance snap{.length = 0.01, .in_plane = true};
  const std::vector<std::vector<std::size_t>> groups = groupFeatures(coastline, snap);
  //! [gis/coast/snap_distance.hpp]
  EXPECT_EQ(groups.size(), 1u);
  EXPECT_EQ(groupFeatures(coastline).size(), 2u);
}

// gis/crs/crs.hpp: Coordinate reference systems, parsed from the user's text.
TEST_F(GisCoastExamples, CrsText) {
  //! [gis/crs/crs.hpp]
  const Crs utm = parseCrs("EPSG:32635");
  const bool same = sameCrs(utm, parseCrs("+proj=utm +zone=35 +datum=WGS84"));
  const double metres = metresPerUnit(wgs84());  // a degree at the equator
  //! [gis/crs/crs.hpp]
  EXPECT_TRUE(same);
  EXPECT_NEAR(metres, 111319.49, 0.01);
  EXPECT_EQ(nameOf(utm), "EPSG:32635");
}

// gis/crs/crs_definition.hpp: A coordinate reference system as text.
TEST_F(GisCoastExamples, CrsDefinition) {
  //! [gis/crs/crs_definition.hpp]
  const Crs nowhere;  // a plane without a place on Earth
  const Crs degrees = wgs84();
  //! [gis/crs/crs_definition.hpp]
  EXPECT_TRUE(nowhere.isPlane());
  EXPECT_TRUE(degrees.geographic);
}

// gis/crs/resolution.hpp: How close vertices may be before rounding matters.
TEST_F(GisCoastExamples, Resolution) {
  //! [gis/crs/resolution.hpp]
  const std::vector<Point> plane = {{500000, 6900000}, {500100, 6900000}, {500000, 6900100}};
  const Resolution resolution = resolutionOf(plane);
  //! [gis/crs/resolution.hpp]
  EXPECT_NEAR(resolution.grain, 6900100 * std::ldexp(1.0, -44), 1e-9);
}

// gis/crs/space_ball.hpp: A ball in space around places of the ground.
TEST_F(GisCoastExamples, SpaceBall) {
  //! [gis/crs/space_ball.hpp]
  const SpaceBall harbour{{6371000.0, 0.0, 0.0}, 500.0}, lake{{6371000.0, 4000.0, 0.0}, 1500.0};
  const double least_apart_m = distance(harbour.centre, lake.centre) - harbour.radius - lake.radius;
  //! [gis/crs/space_ball.hpp]
  EXPECT_EQ(least_apart_m, 2000.0);
}

// gis/error.hpp: Errors by cause: the options, the input, or the output.
TEST_F(GisCoastExamples, Error) {
  //! [gis/error.hpp]
  std::string why;
  try {
    ReadReport report;
    readCoastline({"no_such_file.geojson"}, report);
  } catch (const InputError& error) {
    why = error.what();  // one sentence, with the name of the file
  }
  //! [gis/error.hpp]
  EXPECT_NE(why.find("no_such_file.geojson"), std::string::npos);
}

// gis/file/output_files.hpp: Which files an output consists of.
TEST_F(GisCoastExamples, OutputFiles) {
  //! [gis/file/output_files.hpp]
  const OutputFiles files = filesOf(gridFormatFor("lake.node"), "lake.node");
  const std::vector<std::string> beside = companionsOf("lake.shp");
  //! [gis/file/output_files.hpp]
  EXPECT_NE(std::ranges::find(files.targets, "lake.ele"), files.targets.end());
  EXPECT_NE(std::ranges::find(beside, "lake.dbf"), beside.end());
}

// gis/file/staged_files.hpp: Files that appear complete or not at all.
TEST_F(GisCoastExamples, StagedFiles) {
  //! [gis/file/staged_files.hpp]
  StagedFiles output("notes.txt", /*overwrite=*/false);
  output.write("all of it\n");
  const bool before = std::filesystem::exists("notes.txt");
  output.commit();
  const bool after = std::filesystem::exists("notes.txt");
  //! [gis/file/staged_files.hpp]
  EXPECT_FALSE(before);
  EXPECT_TRUE(after);
  EXPECT_THROW(StagedFiles("notes.txt", false), OutputError);
}

// gis/follow/follow_options.hpp: The least widths at which water and land are followed.
TEST_F(GisCoastExamples, FollowOptions) {
  //! [gis/follow/follow_options.hpp]
  FollowOptions options;
  options.channel_min = 2.0;  // water narrower than two elements is closed
  options.keep = KeepWater::Largest;
  //! [gis/follow/follow_options.hpp]
  EXPECT_LT(options.strait_min, options.channel_min);
}

// gis/follow/shore_guides.hpp: Passages to keep open, and barriers.
TEST_F(GisCoastExamples, ShoreGuides) {
  //! [gis/follow/shore_guides.hpp]
  ShoreGuides guides;
  guides.passages.push_back({{{0, 0}, {10, 0}}, "the strait", 2.0});
  const LineZone zone(guides.passages);
  const bool beside = zone.holds({4, 0.5}, {5, 0.5}, {4.5, 1.0}, 1.0);  // within 1 of the line for each of two elements
  const bool far_off = zone.holds({4, 9}, {5, 9}, {4.5, 10}, 1.0);
  //! [gis/follow/shore_guides.hpp]
  EXPECT_TRUE(beside);
  EXPECT_FALSE(far_off);
}

// gis/follow/shore_sizes.hpp: The requested sizes where shores follow them.
TEST_F(GisCoastExamples, ShoreSizes) {
  const Projection projection = Projection::plane();
  //! [gis/follow/shore_sizes.hpp]
  const ConstantSize wanted(2.0);
  const ScaleTable scale(projection, Box{0, 0, 20, 1});
  const ShoreSizes sizes{wanted, scale};
  ShoreTriangles triangles = triangulateShores(channel(), wanted);
  std::size_t edits = 0;
  ShoreGuides guides;
  guides.barriers.push_back({{{10, -1}, {10, 2}}, "", 1.0});
  std::vector<OpenBarrier> open;
  closeBarriers(
      triangles, sizes, guides, [&](EditKind, const Point&, RegionId) { ++edits; }, open);
  //! [gis/follow/shore_sizes.hpp]
  EXPECT_GT(edits, 0u);
}

// gis/follow/shore_triangles.hpp: Both sides of the shores as triangles, with their widths.
TEST_F(GisCoastExamples, ShoreTriangles) {
  //! [gis/follow/shore_triangles.hpp]
  const ConstantSize wanted(2.0);
  ShoreGraph graph = channel();  // water 20 long and 1 wide
  sampleShores(graph, wanted);
  const ShoreTriangles triangles = triangulateShores(std::move(graph), wanted);
  std::size_t narrow = 0;
  for (TriId t = 0; t < triangles.mesh.triangles.size(); ++t) {
    if (triangles.mesh.regions[t] != triangles.land && triangles.width[t] < 1.0) ++narrow;
  }
  //! [gis/follow/shore_triangles.hpp]
  EXPECT_GT(narrow, 10u);
}

// gis/geometry/box.hpp: A box on the map.
TEST_F(GisCoastExamples, Box) {
  //! [gis/geometry/box.hpp]
  Box box = Box::of({3, 1}, {1, 2});
  box.add(Point{0, 0});
  const Box wider = box.grownBy(0.5);
  //! [gis/geometry/box.hpp]
  EXPECT_EQ(box.xmax, 3.0);
  EXPECT_TRUE(wider.contains(box));
  EXPECT_TRUE(Box{}.empty());
}

// gis/geometry/box_tree.hpp: Finds the boxes that meet a given one.
TEST_F(GisCoastExamples, BoxTree) {
  //! [gis/geometry/box_tree.hpp]
  std::vector<Box> boxes;
  for (int i = 0; i < 100; ++i) boxes.push_back({i * 1.0, 0.0, i + 0.5, 1.0});
  const BoxTree tree(boxes, BoxTree::Order::Hilbert);
  std::vector<std::uint32_t> found;
  tree.visit({41.7, 0.0, 43.1, 1.0}, [&](std::uint32_t item) { found.push_back(item); });
  //! [gis/geometry/box_tree.hpp]
  std::ranges::sort(found);
  EXPECT_EQ(found, (std::vector<std::uint32_t>{42, 43}));
}

// gis/projection/plane_table.hpp: A smooth map of the plane, tabulated.
TEST_F(GisCoastExamples, PlaneTable) {
  //! [gis/projection/plane_table.hpp]
  const auto map = [](const Point& p) { return Point{std::sin(p.x), std::cos(p.y)}; };
  const PlaneTable table(map, Box{0, 0, 1, 1}, 1e-6);
  const Point near = table.at({0.3, 0.4});
  //! [gis/projection/plane_table.hpp]
  EXPECT_TRUE(table.isTabulated());
  EXPECT_NEAR(near.x, std::sin(0.3), 2e-6);
}

// gis/projection/projection.hpp: A conformal plane fitted to the features to be meshed.
TEST_F(GisCoastExamples, Projection) {
  //! [gis/projection/projection.hpp]
  const Coastline coastline = lake();
  const Projection projection = Projection::fitted(coastline, {0});
  const Point metres = projection.forward({25.1, 62.05});
  const Point degrees = projection.inverse(metres);
  const double scale = projection.scaleAt(metres);  // plane length over ground length
  //! [gis/projection/projection.hpp]
  EXPECT_NEAR(degrees.x, 25.1, 1e-10);
  EXPECT_NEAR(scale, 1.0, 1e-5);
  EXPECT_NE(projection.description(), "");
}

// gis/projection/scale_table.hpp: The scale of a projection, tabulated.
TEST_F(GisCoastExamples, ScaleTable) {
  //! [gis/projection/scale_table.hpp]
  const Projection utm = Projection::to(wgs84(), parseCrs("EPSG:32635"));
  const ScaleTable scale(utm, Box{480000, 6870000, 520000, 6890000});
  const double on_the_meridian = scale.at({500000, 6880000});
  //! [gis/projection/scale_table.hpp]
  EXPECT_NEAR(on_the_meridian, 0.9996, 2e-5);
}

// gis/projection/surface_kind.hpp: The surface on which lengths and angles are measured.
TEST_F(GisCoastExamples, SurfaceKind) {
  //! [gis/projection/surface_kind.hpp]
  Coastline coastline = squareFeature(40.0);  // degrees
  coastline.crs = wgs84();
  const Projection plane = Projection::fitted(coastline, {0}, SurfaceKind::Plane);
  const Projection sphere = Projection::fitted(coastline, {0}, SurfaceKind::Sphere);
  //! [gis/projection/surface_kind.hpp]
  EXPECT_FALSE(plane.surface().isCurved());
  EXPECT_TRUE(sphere.surface().isCurved());
}

// gis/read/read_coastline.hpp: Coasts and lakes from any vector source.
TEST_F(GisCoastExamples, ReadCoastline) {
  //! [gis/read/read_coastline.hpp]
  ReadReport report;
  const Coastline coastline = readCoastline({"lake.geojson"}, report);
  //! [gis/read/read_coastline.hpp]
  ASSERT_EQ(coastline.features.size(), 1u);
  EXPECT_EQ(coastline.features[0].polygons[0].holes.size(), 1u);
  EXPECT_TRUE(sameCrs(coastline.crs, wgs84()));
}

// gis/read/read_report.hpp: What was read, and what was skipped.
TEST_F(GisCoastExamples, ReadReport) {
  //! [gis/read/read_report.hpp]
  ReadReport report;
  readCoastline({"lake.geojson"}, report);
  const std::uint64_t rings = report.rings, points = report.points;
  //! [gis/read/read_report.hpp]
  EXPECT_EQ(rings, 2u);
  EXPECT_EQ(points, 11u);  // as in the file, where a ring's first point is repeated at its end
}

// gis/read/source.hpp: A source, its purpose, and a filter for its features.
TEST_F(GisCoastExamples, Source) {
  //! [gis/read/source.hpp]
  ReadFilter filter;
  filter.where = "name = 'a lake'";
  ReadReport report;
  const Coastline coastline = readCoastline({{"lake.geojson", FeatureUse::Land}}, filter, report);
  //! [gis/read/source.hpp]
  ASSERT_EQ(coastline.features.size(), 1u);
  EXPECT_EQ(coastline.features[0].use, FeatureUse::Land);
}

// gis/shore/even_sizes.hpp: Sizes that grow evenly with the distance from the shore.
TEST_F(GisCoastExamples, EvenSizes) {
  //! [gis/shore/even_sizes.hpp]
  const ConstantSize on_shore(100.0), elsewhere(500.0);
  const EvenSizes even{0.1, on_shore};
  const std::vector<Point> places{{0, 0}, {9000, 0}};
  const std::vector<char> lies_on_shore{1, 0};
  const std::vector<double> sizes = sizesAt(places, lies_on_shore, elsewhere, &even, inOrder);
  //! [gis/shore/even_sizes.hpp]
  EXPECT_EQ(sizes, (std::vector<double>{100.0, 500.0}));
}

// gis/shore/shore_graph.hpp: A domain's graph while its coast is being fitted to sizes.
TEST_F(GisCoastExamples, ShoreGraph) {
  //! [gis/shore/shore_graph.hpp]
  ShoreGraph graph;
  graph.pslg.points = {{0, 0}, {1, 0}, {0, 1}};
  graph.pslg.segments = {{0, 1, 0, 0, kOutside}, {1, 2, 0, 0, kOutside}, {2, 0, 0, 0, kOutside}};
  graph.source = {0, 1, 2};
  const bool is_shore = isBoundary(graph.pslg.segments[0]);
  const RegionId water = waterOf(graph.pslg.segments[0]);
  //! [gis/shore/shore_graph.hpp]
  EXPECT_TRUE(is_shore);
  EXPECT_EQ(water, 0);
}

}  // namespace
}  // namespace coastmesh
