#include "gis/size/globe_start.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "core/metric.hpp"
#include "gis/clean/clean.hpp"
#include "gis/clean/geodesic_area.hpp"
#include "gis/coast/frame.hpp"
#include "gis/crs/crs.hpp"

namespace coastmesh {
namespace {

// A whole globe with these rings as separate features.
Domain wholeGlobe(const std::vector<Ring>& rings, const std::vector<Point>& points = {}) {
  Coastline coastline;
  coastline.crs = wgs84();
  for (const Ring& ring : rings) coastline.features.emplace_back().polygons.push_back({ring, {}});
  if (!points.empty()) {
    Feature& constraint = coastline.features.emplace_back();
    constraint.use = FeatureUse::Constraint;
    constraint.points = points;
  }
  frameCoastline(coastline, {.side = DomainSide::Globe});
  std::vector<std::size_t> all(coastline.features.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  CleanReport report;
  return cleanFeatures(coastline, all, Projection::fitted(coastline, all), {}, report);
}

const Ring kIsland{{10, 10}, {20, 10}, {20, 20}, {10, 20}};
// Closed along the pole, with a cut along the antimeridian.
const Ring kContinent{{-180, -90}, {180, -90}, {180, -70}, {90, -65}, {0, -72}, {-90, -64}, {-180, -70}};

TEST(WholeGlobe, HasNothingOnItWhereNothingIsGiven) {
  const Domain domain = wholeGlobe({});
  EXPECT_TRUE(domain.closed());
  EXPECT_EQ(domain.rest, 0);
  EXPECT_EQ(domain.beyond, 0);
  EXPECT_TRUE(domain.pslg.points.empty());
  EXPECT_TRUE(domain.projection.surface().isCurved());
  EXPECT_NEAR(geodesicArea(domain, wgs84()) / 5.10065621724e14, 1.0, 1e-11);
}

TEST(WholeGlobe, BothSidesOfACoastAreRegions) {
  const Domain domain = wholeGlobe({kIsland, kContinent});
  EXPECT_EQ(domain.rest, 2);
  EXPECT_EQ(domain.beyond, 2);
  for (const Segment& s : domain.pslg.segments) EXPECT_TRUE((s.left == 2) != (s.right == 2));
  // Four sides of the island; the continent's without its cut, its closing line and the pole.
  EXPECT_EQ(domain.pslg.segments.size(), 4u + 4u);
  EXPECT_TRUE(std::ranges::none_of(domain.input_points, [](const Point& p) { return p.y == -90; }));
}

TEST(WholeGlobe, ThePlaceBeyondThePlaneMayLieInAFeature) {
  // All except a hole: the point beyond the plane is in the hole or, otherwise, in the feature.
  Coastline coastline;
  coastline.crs = wgs84();
  coastline.features.emplace_back().polygons.push_back(
      {{{-180, -90}, {180, -90}, {180, 90}, {-180, 90}}, {{{0, 0}, {0, 1}, {1, 1}, {1, 0}}}});
  frameCoastline(coastline, {.side = DomainSide::Globe});
  CleanReport report;
  const std::vector<std::size_t> all{0, 1};
  const Domain domain = cleanFeatures(coastline, all, Projection::fitted(coastline, all), {}, report);
  EXPECT_EQ(domain.pslg.segments.size(), 4u);
  for (const Segment& s : domain.pslg.segments) EXPECT_EQ(std::minmax(s.left, s.right), std::minmax(0, 1));
}

TEST(GlobeStart, OneLengthHasALatticeClearOfTheCoast) {
  const Domain domain = wholeGlobe({kIsland});
  SizeOptions options;
  options.size_m = 2e5;
  ASSERT_TRUE(isUniform(options));
  const ConstantSize size(2e5);
  const GlobeStart start = globeStart(domain, options, &size);
  EXPECT_EQ(start.cap.ring.size(), 5u);
  EXPECT_GT(start.seeds.size(), 14000u);
  const Surface surface = domain.projection.surface();
  for (const Point& seed : start.seeds)
    for (const Point& p : domain.pslg.points) EXPECT_GT(surface.chord(seed, p), 0.59 * 2e5);
}

TEST(GlobeStart, GrownSizesHaveTheLatticeOfTheGreatest) {
  const Domain domain = wholeGlobe({kIsland});
  SizeOptions options;
  options.shore_m = 5e4;
  options.most_m = 5e5;
  ASSERT_FALSE(isUniform(options));
  const DomainSizes sized = makeSizeFunction(options, {}, withRing(domain, options), 1e7, inOrder);
  const GlobeStart start = globeStart(domain, options, sized.function.get());
  EXPECT_EQ(start.cap.ring.size(), 6u);
  const Surface surface = domain.projection.surface();
  EXPECT_NEAR(surface.chord(start.cap.ring[0], start.cap.ring[1]), 5e5, 2e4);
  EXPECT_GT(start.seeds.size(), 1000u);
  for (const Point& seed : start.seeds) EXPECT_GT(sized.function->at(seed), 0.8 * 5e5);
}

TEST(GlobeStart, NothingWantedBeginsWithFewVertices) {
  const Domain domain = wholeGlobe({}, {{10, 45}, {10, 45.00001}});
  const GlobeStart start = globeStart(domain, {}, nullptr);
  EXPECT_GT(start.seeds.size(), 30u);
  EXPECT_LT(start.seeds.size(), 80u);
}

TEST(GlobeStart, RefusesMoreVerticesThanCanBeNumbered) {
  SizeOptions options;
  options.size_m = 100.0;
  const ConstantSize size(100.0);
  EXPECT_THROW(globeStart(wholeGlobe({}), options, &size), InputError);
}

}  // namespace
}  // namespace coastmesh
