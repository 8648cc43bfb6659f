#include "gis/coast/group_features.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "gis/crs/crs.hpp"
#include "gis/geometry/chain_index.hpp"
#include "gis/read/read_coastline.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

using Groups = std::vector<std::vector<std::size_t>>;

Groups group(std::vector<Feature> features) { return groupFeatures(coastlineOf(std::move(features))); }

TEST(GroupFeatures, WhatLiesApartStaysApart) {
  EXPECT_EQ(
      group({polygonFeature(0, square(0, 0, 1)), polygonFeature(1, square(2, 0, 1)), lineFeature(2, {{5, 5}, {6, 6}})}),
      (Groups{{0}, {1}, {2}}));
  EXPECT_EQ(group({}), Groups{});
}

TEST(GroupFeatures, TouchingInAVertexOrAlongAnEdge) {
  EXPECT_EQ(group({polygonFeature(0, square(0, 0, 1)), polygonFeature(1, square(9, 9, 1)),
                   polygonFeature(2, square(1, 1, 1))}),
            (Groups{{0, 2}, {1}}));
  EXPECT_EQ(group({polygonFeature(0, square(0, 0, 1)), polygonFeature(1, square(1, 0, 1))}), (Groups{{0, 1}}));
  // A vertex inside an edge.
  EXPECT_EQ(group({polygonFeature(0, square(0, 0, 3)), polygonFeature(1, {{3, 1}, {5, 0}, {5, 2}})}), (Groups{{0, 1}}));
}

TEST(GroupFeatures, CrossingAndContaining) {
  EXPECT_EQ(group({polygonFeature(0, square(0, 0, 3)), polygonFeature(1, square(2, 2, 3))}), (Groups{{0, 1}}));
  EXPECT_EQ(group({polygonFeature(0, square(0, 0, 9)), polygonFeature(1, square(2, 2, 3))}), (Groups{{0, 1}}));
  EXPECT_EQ(group({polygonFeature(1, square(2, 2, 3)), polygonFeature(0, square(0, 0, 9))}), (Groups{{0, 1}}));
  EXPECT_EQ(group({polygonFeature(0, square(0, 0, 9)), lineFeature(1, {{1, 1}, {2, 2}})}), (Groups{{0, 1}}));
  EXPECT_EQ(group({polygonFeature(0, square(0, 0, 9)), polygonFeature(1, square(0, 0, 9))}), (Groups{{0, 1}}));
}

TEST(GroupFeatures, ALakeOnAnIslandIsALakeOfItsOwn) {
  const Feature sea = polygonFeature(0, square(0, 0, 9), {square(2, 2, 4)});
  EXPECT_EQ(group({sea, polygonFeature(1, square(3, 3, 1))}), (Groups{{0}, {1}}));
  // A lake that fills the island to its shore touches the sea.
  EXPECT_EQ(group({sea, polygonFeature(1, square(2, 2, 4))}), (Groups{{0, 1}}));
  // And so does one inside the island with a corner on its shore.
  EXPECT_EQ(group({sea, polygonFeature(1, square(2, 2, 1))}), (Groups{{0, 1}}));
}

TEST(GroupFeatures, AFeatureOfWhichOnlyAPartLiesInAnother) {
  Feature two_parts = polygonFeature(0, square(20, 20, 1));
  two_parts.polygons.push_back({square(3, 3, 1), {}});
  EXPECT_EQ(group({two_parts, polygonFeature(1, square(0, 0, 9))}), (Groups{{0, 1}}));
}

// Features are grouped by edges, and such a ring has none.
TEST(GroupFeatures, ARingOfOnePointBelongsToNothing) {
  EXPECT_EQ(group({polygonFeature(0, square(0, 0, 9)), polygonFeature(1, {{2, 1}}), polygonFeature(2, {})}),
            (Groups{{0}, {1}, {2}}));
}

TEST(GroupFeatures, LinesJoinWhatTheyTouch) {
  EXPECT_EQ(group({polygonFeature(0, square(0, 0, 1)), polygonFeature(1, square(4, 0, 1)),
                   lineFeature(2, {{1, 0.5}, {4, 0.5}})}),
            (Groups{{0, 1, 2}}));
}

TEST(GroupFeatures, WhatACutAlongAMeridianPartsBelongsTogether) {
  const std::vector<Feature> halves{polygonFeature(0, square(179, 10, 1)), polygonFeature(1, square(-180, 10.5, 1)),
                                    polygonFeature(2, square(-180, 50, 1)), polygonFeature(3, square(178, 50, 1)),
                                    polygonFeature(4, {{180, 11.5}, {179, 12}, {179, 11.6}})};
  EXPECT_EQ(groupFeatures(coastlineOf(halves, wgs84())), (Groups{{0, 1, 4}, {2}, {3}}));
  // A guest beyond the end of the data's longitudes does not hide the cut.
  std::vector<Feature> with_guest = halves;
  with_guest.push_back(lineFeature(5, {{179.5, 10.2}, {180.5, 10.7}}));
  with_guest.back().use = FeatureUse::Constraint;
  EXPECT_EQ(groupFeatures(coastlineOf(with_guest, wgs84())), (Groups{{0, 1, 4, 5}, {2}, {3}}));
  // Nor does an area that reaches past it.
  std::vector<Feature> with_area = halves;
  with_area.push_back(polygonFeature(5, square(179.5, -50, 1)));
  EXPECT_EQ(groupFeatures(coastlineOf(with_area, wgs84())), (Groups{{0, 1, 4}, {2}, {3}, {5}}));
  // A plane has no antimeridian.
  EXPECT_EQ(group(halves).size(), 5u);
}

// A sea and a line across the antimeridian meet what lies there on either side, and nothing of the same latitudes.
TEST(GroupFeatures, WhatJumpsMeetsOnlyWhatLiesAcrossTheAntimeridian) {
  const Ring sea{{179, -18}, {-179, -18}, {-179, -16}, {179, -16}};
  const std::vector<Feature> features{
      polygonFeature(0, sea),
      polygonFeature(1, square(10, -17.5, 0.3)),                            // far away
      polygonFeature(2, square(-179.9, -17.2, 0.4)),                        // inside, east of the antimeridian
      polygonFeature(3, square(179.1, -17.2, 0.4)),                         // inside, west of it
      polygonFeature(4, square(-179, -17, 0.5)),                            // along a side
      polygonFeature(5, {{179.5, -16.5}, {-179.5, -16.5}, {-179.5, -15}}),  // jumps too
      lineFeature(6, {{179.9, -15.5}, {-179.5, -15.2}}),
      lineFeature(7, {{30, -17}, {31, -17}})};
  EXPECT_EQ(groupFeatures(coastlineOf(features, wgs84())), (Groups{{0, 2, 3, 4, 5, 6}, {1}, {7}}));
  Feature with_hole = polygonFeature(0, sea, {{{179.5, -17.5}, {-179.5, -17.5}, {-179.5, -16.5}, {179.5, -16.5}}});
  EXPECT_EQ(groupFeatures(coastlineOf({with_hole, polygonFeature(1, square(-179.8, -17.2, 0.1))}, wgs84())),
            (Groups{{0}, {1}}));
  // In data from 0 to 360.
  EXPECT_EQ(groupFeatures(coastlineOf({polygonFeature(0, {{359, 0}, {1, 0}, {1, 2}, {359, 2}}),
                                       polygonFeature(1, square(0.2, 1, 0.3)), polygonFeature(2, square(100, 1, 1))},
                                      wgs84())),
            (Groups{{0, 1}, {2}}));
}

// Snapping merges points and edges of two features only if they are cleaned together.
TEST(GroupFeatures, WhatSnappingMayMergeBelongsTogether) {
  const auto groupsOf = [](double gap, const SnapDistance& snap) {
    return groupFeatures(coastlineOf({polygonFeature(0, square(0, 0, 1)), polygonFeature(1, square(1 + gap, 0, 1))}),
                         snap)
        .size();
  };
  EXPECT_EQ(groupsOf(1e-4, {}), 2u);
  EXPECT_EQ(groupsOf(1e-4, {1e-3}), 1u);
  EXPECT_EQ(groupsOf(1e-2, {1e-3}), 2u);
  // A vertex close to the middle of an edge.
  EXPECT_EQ(
      groupFeatures(coastlineOf({polygonFeature(0, square(0, 0, 3)), polygonFeature(1, {{3.01, 1}, {5, 0}, {5, 2}})}),
                    {0.1}),
      (Groups{{0, 1}}));
  // A line beside a shore, and one in a hole, beside the hole's shore.
  EXPECT_EQ(groupFeatures(coastlineOf({polygonFeature(0, square(0, 0, 9), {square(2, 2, 4)}),
                                       lineFeature(1, {{9.01, 1}, {12, 1}}), lineFeature(2, {{3, 3}, {5.99, 3}}),
                                       lineFeature(3, {{3, 4}, {5.8, 4}})}),
                          {0.1}),
            (Groups{{0, 1, 2}, {3}}));
}

TEST(GroupFeatures, SnapsByMetresOnTheGround) {
  const double degree = 111319.49;
  const auto groupsOf = [](const Ring& a, const Ring& b, const Crs& crs, const SnapDistance& snap) {
    return groupFeatures(coastlineOf({polygonFeature(0, a), polygonFeature(1, b)}, crs), snap).size();
  };
  // 9 and 15 m at 60 degrees north, where a degree of longitude is half as long.
  for (const double metres : {9.0, 15.0})
    EXPECT_EQ(groupsOf(square(0, 59, 1), square(1 + 2 * metres / degree, 59.5, 0.5), wgs84(), {10.0}),
              metres < 10 ? 1u : 2u);
  // A snap distance in units of the CRS; and at the pole, where differences in longitude have no length.
  EXPECT_EQ(groupsOf(square(0, 59, 1), square(1.001, 59, 1), wgs84(), {0.01, true}), 1u);
  EXPECT_EQ(groupsOf({{0, 80}, {10, 80}, {5, 90}}, {{50, 80}, {60, 80}, {55, 89.99999}}, wgs84(), {10.0}), 1u);
  // At 60 degrees north, a metre of Mercator is half a metre on the ground.
  const Crs mercator = parseCrs("EPSG:3857");
  for (const double metres : {9.0, 15.0})
    EXPECT_EQ(groupsOf(square(0, 8.3997e6, 1000), square(1000 + 2 * metres, 8.3997e6, 1000), mercator, {10.0}),
              metres < 10 ? 1u : 2u);
}

// Compares every vertex and edge with every other.
bool slowlyBelongTogether(const Feature& a, const Feature& b) {
  const auto ringsOf = [](const Feature& f) {
    std::vector<Ring> rings;
    for (const Polygon& p : f.polygons) {
      rings.push_back(p.outer);
      rings.insert(rings.end(), p.holes.begin(), p.holes.end());
    }
    return rings;
  };
  const auto touches = [&](const Ring& r, const Ring& s) {
    for (std::size_t i = 0; i < r.size(); ++i) {
      for (std::size_t j = 0; j < s.size(); ++j) {
        if (segmentsMeet(r[i], r[(i + 1) % r.size()], s[j], s[(j + 1) % s.size()])) return true;
      }
    }
    return false;
  };
  const auto holds = [&](const Feature& outer, const Feature& inner) {
    ChainIndex index(ChainIndex::Kind::Rings);
    for (const Ring& ring : ringsOf(outer)) index.add(ring);
    index.build();
    for (const Ring& ring : ringsOf(inner)) {
      if (index.locate(ring.front()) != Location::Outside) return true;
    }
    return false;
  };
  for (const Ring& r : ringsOf(a)) {
    for (const Ring& s : ringsOf(b)) {
      if (touches(r, s)) return true;
    }
  }
  return holds(a, b) || holds(b, a);
}

TEST(GroupFeatures, AgreesWithASlowSearch) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(0, 30), radius(0.3, 3);
    std::uniform_int_distribution<std::size_t> size(3, 120);
    std::vector<Feature> features;
    for (int f = 0; f < 60; ++f) {
      const Point centre{place(random), place(random)};
      const double r = radius(random);
      std::vector<Ring> holes;
      if (f % 3 == 0) holes.push_back(starRing(random, centre, 0.4 * r, size(random)));
      features.push_back(polygonFeature(f, starRing(random, centre, r, size(random)), holes));
    }
    std::vector<std::size_t> group_of(features.size());
    std::iota(group_of.begin(), group_of.end(), std::size_t{0});
    for (std::size_t i = 0; i < features.size(); ++i) {
      for (std::size_t j = i + 1; j < features.size(); ++j) {
        if (!slowlyBelongTogether(features[i], features[j])) continue;
        const std::size_t from = std::max(group_of[i], group_of[j]), to = std::min(group_of[i], group_of[j]);
        for (std::size_t& g : group_of) g = g == from ? to : g;
      }
    }
    Groups expected;
    for (std::size_t i = 0; i < features.size(); ++i) {
      if (group_of[i] == i) expected.emplace_back();
      for (Groups::value_type& members : expected) {
        if (members.empty() || group_of[members.front()] == group_of[i]) {
          members.push_back(i);
          break;
        }
      }
    }
    EXPECT_EQ(group(features), expected) << "seed " << seed;
  }
}

}  // namespace
}  // namespace coastmesh
