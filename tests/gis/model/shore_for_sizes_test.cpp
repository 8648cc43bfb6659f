// The parts of a domain's boundary that are not shore for sizes, because files or depths will open them.
#include "gis/model/shore_for_sizes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "core/metric.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/model/assign_boundaries.hpp"
#include "gis/model/make_grid.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/gis/size/size_samples.hpp"

namespace coastmesh {
namespace {

using testing::planeDomain;

class ShoreForSizes : public testing::SizeFiles {
 protected:
  // 10 by 6 km, with an island of 1 by 1 km at (4000, 2000).
  ShoreForSizes() {
    Pslg pslg = testing::rectangle(10000.0, 6000.0);
    for (const Point& p : {Point{4000, 2000}, {4000, 3000}, {5000, 3000}, {5000, 2000}}) pslg.points.push_back(p);
    for (VertexId i = 0; i < 4; ++i) pslg.segments.push_back({4 + i, 4 + (i + 1) % 4, 0, 0, kOutside});
    domain = planeDomain(pslg);
  }

  BoundaryOptions of(const std::string& type, const std::string& geometry, const std::string& coordinates) {
    std::ofstream(file("types.geojson")) << R"({"type":"FeatureCollection","features":[)"
                                         << R"({"type":"Feature","properties":{"type":")" << type
                                         << R"("},"geometry":{"type":")" << geometry << R"(","coordinates":)"
                                         << coordinates << "}}]}";
    BoundaryOptions options;
    options.files = {file("types.geojson")};
    options.of_files = readBoundaryFiles(options);
    return options;
  }

  // The lengths of shore left at the outer boundary and at the island, metres.
  struct Left {
    double outer = 0.0, island = 0.0;
  };
  Left leftBy(const BoundaryOptions& options, const DepthOptions& depths = {},
              const ElementLengths& lengths = {50.0, 1000.0}) const {
    const std::optional<Pslg> shore = shoreForSizes(domain, {}, options, depths, lengths);
    const Pslg& pslg = shore ? *shore : domain.pslg;
    Left left;
    for (const Segment& s : pslg.segments) {
      const Point &a = pslg.points[s.a], &b = pslg.points[s.b], middle = midpoint(a, b);
      const bool inner = middle.x > 3000 && middle.x < 6000 && middle.y > 1000 && middle.y < 4000;
      (inner ? left.island : left.outer) += distance(a, b);
      EXPECT_EQ(s.left >= 0, s.right < 0);
    }
    return left;
  }

  Domain domain;
};

TEST_F(ShoreForSizes, PolygonsOpenPartsOfOuterSegmentsAndNoIslands) {
  // The western half, which divides the southern and northern sides in the middle.
  const auto west = of("open", "Polygon", "[[[-10,-10],[5020,-10],[5020,6010],[-10,6010],[-10,-10]]]");
  const Left left = leftBy(west);
  EXPECT_NEAR(left.outer, 32000.0 - 6000.0 - 2 * 5020.0, 2 * 50.0);
  EXPECT_EQ(left.island, 4000.0);
}

TEST_F(ShoreForSizes, LinesOpenWhatTheyRunAlongIslandsToo) {
  // Less than half an element off, and more.
  for (const std::string y : {"-150", "-450"})
    EXPECT_NEAR(leftBy(of("open", "LineString", "[[2000," + y + "],[8000," + y + "]]")).outer, 32000.0 - 6000.0, 800.0);
  EXPECT_EQ(leftBy(of("open", "LineString", "[[2000,-550],[8000,-550]]")).outer, 32000.0);
  EXPECT_EQ(leftBy(of("open", "LineString", "[[4000,2000],[4000,3000],[5000,3000],[5000,2000],[4000,2000]]")).island,
            0.0);
}

TEST_F(ShoreForSizes, LandAndRiversStayShores) {
  for (const std::string type : {"land", "river", "22"})
    EXPECT_EQ(leftBy(of(type, "Polygon", "[[[-10,-10],[5020,-10],[5020,6010],[-10,6010],[-10,-10]]]")).outer, 32000.0);
}

TEST_F(ShoreForSizes, WhatTheFrameOpensStaysAsItIs) {
  domain.pslg.segments[3].tag = kOpenTag;
  const auto all = of("land", "Polygon", "[[[-10,-10],[10010,-10],[10010,6010],[-10,6010],[-10,-10]]]");
  EXPECT_FALSE(shoreForSizes(domain, {}, all, {}, {50.0, 1000.0}).has_value());
}

TEST_F(ShoreForSizes, ShortShoresAreMergedButStayShores) {
  auto options = of("open", "LineString", "[[2000,0],[3000,0]]");
  options.least_length_m = 1500.0;
  EXPECT_NEAR(leftBy(options).outer, 32000.0 - 1000.0, 400.0);  // no file's opening is merged
  // All but a short piece of the south is open. The grid's boundary loses that piece; here it stays a shore.
  options =
      of("open", "Polygon",
         "[[[-10,-10],[4500,-10],[4500,100],[5500,100],[5500,-10],[10010,-10],[10010,6010],[-10,6010],[-10,-10]]]");
  options.least_length_m = 1500.0;
  EXPECT_NEAR(leftBy(options).outer, 1000.0, 100.0);
}

TEST_F(ShoreForSizes, DepthsOpenOuterBoundariesThatAreDeep) {
  DepthOptions depths;
  // Deeper by 1 m every 100 m eastwards; unknown in the south-east.
  depths.files = {raster("depths.tif", 120, 80, {-1000, 100, 0, 7000, 0, -100}, 0,
                         [](double x, double y) { return x > 7000.0 && y < 1000.0 ? -9999.0 : -x / 100.0; })};
  BoundaryOptions options;
  options.open_deeper_m = 60.0;
  const Left left = leftBy(options, depths);
  // Open: from 6000 on, the southern side to 7000, the eastern from 1000 on.
  EXPECT_NEAR(left.outer, 32000.0 - 4000.0 - 1000.0 - 5000.0, 300.0);
  EXPECT_EQ(left.island, 4000.0);
  EXPECT_EQ(leftBy(options, {}).outer, 32000.0);
  options.least_length_m = 20000.0;  // short openings by depth are merged
  EXPECT_EQ(leftBy(options, depths).outer, 32000.0);
}

TEST_F(ShoreForSizes, GraphsWithoutLabelsToo) {
  for (Segment& s : domain.pslg.segments) s.left = s.right = kUnlabelled;
  domain.pslg.holes = {{4500, 2500}};
  const auto all = of("open", "Polygon", "[[[-10,-10],[10010,-10],[10010,6010],[-10,6010],[-10,-10]]]");
  const std::optional<Pslg> shore = shoreForSizes(domain, {}, all, {}, {50.0, 1000.0});
  ASSERT_TRUE(shore.has_value());
  EXPECT_EQ(shore->segments.size(), 4u);  // the island's
}

// The same parts as open segments of a domain, which is divided where they begin and end.
TEST_F(ShoreForSizes, OpeningsAreTaggedForCoastsThatFollow) {
  const auto west = of("open", "Polygon", "[[[-10,-10],[5020,-10],[5020,6010],[-10,6010],[-10,-10]]]");
  const std::optional<Pslg> shore = shoreForSizes(domain, {}, west, {}, {50.0, 1000.0});
  ASSERT_TRUE(shore.has_value());
  const Domain opened = withOpenings(Domain(domain), {}, west, {}, {50.0, 1000.0});
  const auto lengthOf = [](const Pslg& pslg, bool with_open) {
    double length = 0.0;
    for (const Segment& s : pslg.segments)
      if (with_open || !isOpenTag(s.tag)) length += distance(pslg.points[s.a], pslg.points[s.b]);
    return length;
  };
  EXPECT_NEAR(lengthOf(opened.pslg, true), 36000.0, 1e-6);
  EXPECT_NEAR(lengthOf(opened.pslg, false), lengthOf(*shore, true), 1e-6);
  EXPECT_EQ(opened.pslg.points.size(), domain.pslg.points.size() + 2);
  EXPECT_EQ(opened.input_points.size(), opened.pslg.points.size());
  EXPECT_EQ(opened.input_points.back(), opened.pslg.points.back());  // the domain is in a plane
  EXPECT_NO_THROW(constrainedDelaunay(opened.pslg));
  EXPECT_EQ(withOpenings(Domain(domain), {}, {}, {}, {50.0, 1000.0}).pslg.segments.size(), 8u);
}

// A boundary in pieces as long as elements is opened like that of a mesh with these elements.
TEST_F(ShoreForSizes, ItIsWhatTheGridsBoundaryBecomes) {
  Domain fine = planeDomain({});
  const auto side = [&](Point from, Point to, int count) {
    for (int i = 0; i < count; ++i) fine.pslg.points.push_back(from + (static_cast<double>(i) / count) * (to - from));
  };
  side({0, 0}, {10000, 0}, 20);
  side({10000, 0}, {10000, 6000}, 12);
  side({10000, 6000}, {0, 6000}, 20);
  side({0, 6000}, {0, 0}, 12);
  const auto count = static_cast<VertexId>(fine.pslg.points.size());
  for (VertexId i = 0; i < count; ++i) fine.pslg.segments.push_back({i, (i + 1) % count, 0, 0, kOutside});
  fine.input_points = fine.pslg.points;
  domain = fine;
  const TriMesh mesh = constrainedDelaunay(fine.pslg);
  Coastline coastline;
  coastline.features.emplace_back();
  Grid grid = makeGrid({MeshedDomain{&fine, &mesh}}, coastline);
  const auto options = of("open", "LineString", "[[1000,60],[9900,-90],[10000,3500]]");
  assignBoundaries(grid, options);
  double open = 0.0;
  for (const Boundary& boundary : grid.boundaries)
    for (const NodePair& edge : edgesOf(boundary))
      if (boundary.role == BoundaryRole::Open) open += distance(grid.nodes[edge[0]], grid.nodes[edge[1]]);
  EXPECT_GT(open, 10000.0);
  EXPECT_NEAR(leftBy(options, {}, {500.0, 500.0}).outer, 32000.0 - open, 1e-6);
}

}  // namespace
}  // namespace coastmesh
