// Vertices that the user requested on shores that follow sizes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/triangulate/delaunay.hpp"
#include "gis/follow/coast_follow.hpp"
#include "gis/follow/least_edges.hpp"
#include "tests/support/followed_coasts.hpp"

namespace coastmesh {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

// The places of the requested vertices, sorted.
std::vector<Point> askedOf(const Domain& domain) {
  std::vector<Point> places;
  for (const VertexId v : domain.asked) places.push_back(domain.pslg.points[v]);
  std::ranges::sort(places, lexLess);
  return places;
}

// A lake of radius 10 with a rough shore, and requested vertices on it.
Domain roughLake() {
  Domain domain;
  addRing(domain, {0.0, 0.0}, 10.0, 800, false, 0.01);
  domain.asked = {6, 201, 420, 677, 420};
  return domain;
}

TEST(AskedPoints, OnAShoreTheyStay) {
  const std::vector<Point> wanted = [] {
    Domain lake = roughLake();
    lake.asked.pop_back();
    return askedOf(lake);
  }();
  CleanReport report;
  FollowStart start;
  Domain domain = thinToLeast(roughLake(), 2.0, {}, oneFeature(), {}, report, start);
  EXPECT_LT(domain.pslg.points.size(), 200u);
  EXPECT_EQ(askedOf(domain), wanted);
  domain = followSizes(std::move(domain), ConstantSize(2.0), {}, oneFeature(), report, {}, inOrder, std::move(start));
  EXPECT_LT(domain.pslg.points.size(), 60u);
  EXPECT_EQ(askedOf(domain), wanted);
  domain = coarsenFurther(std::move(domain), ConstantSize(4.0), oneFeature(), report);
  domain = lengthenShores(std::move(domain), {3.0, false}, ConstantSize(4.0), oneFeature(), report);
  EXPECT_EQ(askedOf(domain), wanted);
  EXPECT_THAT(report.warnings, Not(Contains(HasSubstr("left out"))));
}

TEST(AskedPoints, OnAnIslandThatGoesTheyAreInTheWater) {
  Domain domain;
  addShore(domain, {{0, 0}, {300, 0}, {300, 200}, {0, 200}});
  addShore(domain, {{150, 100}, {148, 103}, {152, 103}});
  domain.asked = {4};
  domain.input_points = domain.pslg.points;
  CleanReport report;
  const Domain followed = followSizes(std::move(domain), ConstantSize(20.0), {}, oneFeature(), report);
  EXPECT_EQ(countOf(report, EditKind::SmallIsland), 1u);
  EXPECT_EQ(askedOf(followed), (std::vector<Point>{{150, 100}}));
  for (const Segment& s : followed.pslg.segments)
    for (const VertexId v : {s.a, s.b}) EXPECT_NE(followed.pslg.points[v], (Point{150, 100}));
  EXPECT_NO_THROW(constrainedDelaunay(followed.pslg));
}

TEST(AskedPoints, OnTheShoreOfAnInletThatIsClosedTheyAreNamed) {
  Domain domain;
  addShore(domain, {{0, 0}, {300, 0}, {300, 200}, {0, 200}, {0, 103}, {-80, 103}, {-80, 97}, {0, 97}});
  domain.asked = {2, 5};
  domain.input_points = domain.pslg.points;
  CleanReport report;
  const Domain followed = followSizes(std::move(domain), ConstantSize(20.0), {}, oneFeature(), report);
  EXPECT_EQ(askedOf(followed), (std::vector<Point>{{300, 200}}));
  EXPECT_THAT(report.warnings,
              Contains(HasSubstr("1 point lies in water that is closed, and is left out: (-80, 103)")));
}

}  // namespace
}  // namespace coastmesh
