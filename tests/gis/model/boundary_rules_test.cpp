// Which polygon or line determines the type of a boundary edge.
#include "gis/model/boundary_rules.hpp"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <iomanip>
#include <random>
#include <sstream>
#include <string>

#include "gis/error.hpp"
#include "gis/read/raw_layer.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using testing::TemporaryFolder;
using Kinds = std::vector<std::optional<BoundaryKind>>;

const BoundaryKind kOpen{BoundaryRole::Open}, kRiver{BoundaryRole::River}, kLand{BoundaryRole::Land};

RawLayer layerOf(FeatureUse use) {
  RawLayer layer;
  layer.source = "input";
  layer.use = use;
  layer.crs = Crs{};
  return layer;
}

void addPolygon(RawLayer& layer, const std::string& column, const std::string& type, Ring ring) {
  Feature& feature = layer.features.emplace_back();
  feature.use = layer.use;
  feature.attributes = {{column, type}};
  feature.polygons.push_back({std::move(ring), {}});
}

void addLine(RawLayer& layer, const std::string& column, const std::string& type, std::vector<Point> line) {
  layer.lines.push_back({std::move(line), layer.line_features.size()});
  Feature& feature = layer.line_features.emplace_back();
  feature.use = layer.use;
  feature.attributes = {{column, type}};
}

// The types of two edges, from (0, 0) to (1, 0) and on to (2, 0).
Kinds kindsOfTwo(const BoundaryRules& rules) {
  return rules.kindsOf(Crs{}, std::vector<Point>{{0, 0}, {1, 0}, {2, 0}}, {{0, 1}, {1, 2}}, {true, true});
}

const Ring kSquare{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

// Rules are found by a spatial search; the result is that of testing each of them.
TEST(BoundaryRules, TheLastOfManyPolygonsCountsAndNoneOpensIslands) {
  const TemporaryFolder folder;
  std::mt19937 random(20261125);
  std::uniform_real_distribution<double> place(0.0, 10.0), size(0.1, 3.0);
  std::vector<Box> squares;
  std::vector<BoundaryKind> types;
  const std::string path = folder / "squares.geojson";
  {
    std::ofstream file(path);
    file << std::setprecision(17) << R"({"type": "FeatureCollection", "features": [)";
    for (int i = 0; i < 500; ++i) {
      const double x = place(random), y = place(random), side = size(random);
      squares.push_back({x, y, x + side, y + side});
      types.push_back(i % 3 == 0 ? kOpen : i % 3 == 1 ? kRiver : kLand);
      file << (i == 0 ? "" : ",") << R"({"type": "Feature", "properties": {"role": ")" << toString(types.back().role)
           << R"("}, "geometry": {"type": "Polygon", "coordinates": [[[)" << x << "," << y << "],[" << x + side << ","
           << y << "],[" << x + side << "," << y + side << "],[" << x << "," << y + side << "],[" << x << "," << y
           << "]]]}}";
    }
    file << "]}";
  }
  std::vector<Point> places;
  std::vector<NodePair> edges;
  std::vector<bool> outer;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const Point p{place(random), place(random)};
    places.push_back(p);
    places.push_back({p.x + 0.25, p.y + 0.125});
    edges.push_back({2 * i, 2 * i + 1});
    outer.push_back(i % 4 != 0);
  }
  const Kinds kinds = BoundaryRules::ofFile(path, "").kindsOf(wgs84(), places, edges, outer);
  std::size_t none = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Point &a = places[edges[e][0]], &b = places[edges[e][1]];
    const Point middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
    std::optional<BoundaryKind> expected;
    for (std::size_t i = 0; i < squares.size(); ++i) {
      const bool opens = types[i] != kLand;
      if (squares[i].contains(Box::of(middle, middle)) && (outer[e] || !opens)) expected = types[i];
    }
    EXPECT_EQ(kinds[e], expected) << e;
    none += !expected;
  }
  EXPECT_GT(none, 0u);
  EXPECT_LT(none, edges.size() / 2);
}

TEST(BoundaryRules, OfLinesAndPolygonsOfAnInputTheLastCounts) {
  RawLayer layer = layerOf(FeatureUse::Area);
  addPolygon(layer, "type", "open", kSquare);
  addLine(layer, "type", "river", {{1, 0}, {2, 0}});
  addLine(layer, "type", "land", {{-1, 0}, {0.5, 0}});  // along half of the first edge
  addLine(layer, "other", "land", {{0, 0}, {2, 0}});
  BoundaryRules rules;
  rules.addInput({layer}, "Type");
  EXPECT_EQ(kindsOfTwo(rules), (Kinds{kOpen, kRiver}));
  RawLayer later = layerOf(FeatureUse::Area);
  addLine(later, "type", "10", {{0, 0}, {1, 0}});
  rules.addInput({later}, "type");
  EXPECT_EQ(kindsOfTwo(rules), (Kinds{BoundaryKind{BoundaryRole::Land, 10}, kRiver}));
}

// From 179.9 to -179.9, in a polygon or along a line of which longitudes go on to 181; the third edge is at 0.
TEST(BoundaryRules, AnEdgeAcrossTheAntimeridianHasItsMiddleThere) {
  const TemporaryFolder folder;
  const std::string path = folder / "rules.geojson";
  for (const char* geometry :
       {R"({"type":"LineString","coordinates":[[179,60],[181,60]]})",
        R"({"type":"Polygon","coordinates":[[[179,59],[181,59],[181,61],[179,61],[179,59]]]})"}) {
    std::ofstream(path) << R"({"type":"Feature","properties":{"kind":"open"},"geometry":)" << geometry << "}";
    const std::vector<Point> places{{179.9, 60}, {-179.9, 60}, {0.1, 60}, {-0.1, 60}};
    const Kinds kinds =
        BoundaryRules::ofFile(path, "").kindsOf(wgs84(), places, {{0, 1}, {1, 0}, {2, 3}}, {true, true, true});
    EXPECT_EQ(kinds, (Kinds{kOpen, kOpen, std::nullopt})) << geometry;
  }
}

RawLayer onEarth(FeatureUse use) {
  RawLayer layer = layerOf(use);
  layer.crs = wgs84();
  return layer;
}

// The types of edges from 176 to 184 east and back, a degree each, at 10 north and 20 north.
Kinds kindsAcross(const RawLayer& layer) {
  BoundaryRules rules;
  rules.addInput({layer}, "type");
  std::vector<Point> places;
  std::vector<NodePair> edges;
  for (const double y : {10.0, 20.0}) {
    for (std::uint32_t i = 0; i <= 8; ++i) {
      if (i > 0)
        edges.push_back({static_cast<std::uint32_t>(places.size()) - 1, static_cast<std::uint32_t>(places.size())});
      places.push_back({176.0 + i, y});
    }
  }
  return rules.kindsOf(wgs84(), places, edges, std::vector(edges.size(), true));
}

Kinds firstOpen(std::size_t begin, std::size_t end) {
  Kinds kinds(16);
  for (std::size_t i = begin; i < end; ++i) kinds[i] = kOpen;
  return kinds;
}

// Lines of map sheets, exploded ones, and those cut at the antimeridian or that jump there are what they are whole.
TEST(BoundaryRules, LinesOfOneTypeContinueEachOther) {
  RawLayer sheets = onEarth(FeatureUse::Area), cut = sheets, jumping = sheets;
  addLine(sheets, "type", "open", {{176, 10}, {178.45, 10}});
  addLine(sheets, "type", "open", {{182.6, 10}, {178.45, 10}});
  addLine(sheets, "type", "open", {{182.6, 10}, {184, 10}});
  EXPECT_EQ(kindsAcross(sheets), firstOpen(0, 8));
  addLine(cut, "type", "open", {{176.5, 10}, {180, 10}});
  addLine(cut, "type", "open", {{-180, 10}, {-176, 10}});
  EXPECT_EQ(kindsAcross(cut), firstOpen(1, 8));
  addLine(jumping, "type", "open", {{176, 10}, {178.5, 10}, {-178.5, 10}, {-176, 10}});
  EXPECT_EQ(kindsAcross(jumping), firstOpen(0, 8));
}

TEST(BoundaryRules, LinesOfTwoTypesThatMeetWithinAnEdgeLeaveNoGap) {
  RawLayer layer = layerOf(FeatureUse::Area);
  addLine(layer, "type", "open", {{0, 0}, {1.3, 0}});
  addLine(layer, "type", "river", {{1.3, 0}, {2, 0}});
  BoundaryRules rules;
  rules.addInput({layer}, "type");
  EXPECT_EQ(kindsOfTwo(rules), (Kinds{kOpen, kRiver}));
}

// The names that rules give to edges, one after another.
std::string namesOf(const Kinds& kinds) {
  std::string names;
  for (const auto& kind : kinds) names += !kind ? "-" : kind->name.empty() ? "." : kind->name;
  return names;
}

// The name of a lake is not that of its shore, while lines and polygons of a file are about the boundary.
TEST(BoundaryRules, NamesOfMeshedPolygonsAreNotThoseOfBoundaries) {
  RawLayer layer = layerOf(FeatureUse::Area);
  addPolygon(layer, "type", "open", kSquare);
  layer.features[0].attributes.emplace_back("name", "A");
  BoundaryRules rules;
  rules.addInput({layer}, "type");
  EXPECT_EQ(namesOf(kindsOfTwo(rules)), ".-");
  const TemporaryFolder folder;
  const std::string path = folder / "box.geojson";
  std::ofstream(path) << R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties":
      {"role": "open", "NAME": "A"}, "geometry": {"type": "Polygon", "coordinates":
      [[[-1, -1], [1.2, -1], [1.2, 1], [-1, 1], [-1, -1]]]}}]})";
  EXPECT_EQ(namesOf(kindsOfTwo(BoundaryRules::ofFile(path, ""))), "A-");
}

TEST(BoundaryRules, PolygonsThatJumpAtTheAntimeridianLieAcrossIt) {
  const TemporaryFolder folder;
  const std::string path = folder / "jump.geojson";
  std::ofstream(path) << R"({"type":"Feature","properties":{"kind":"open"},"geometry":{"type":"Polygon","coordinates":
      [[[178,9],[-178,9],[-178,11],[178,11],[178,9]],
      [[-179.9,9.5],[-179.1,9.5],[-179.1,10.5],[-179.9,10.5],[-179.9,9.5]]]}})";
  std::vector<Point> places;
  std::vector<NodePair> edges;
  for (std::uint32_t i = 0; i <= 8; ++i) places.push_back({176.0 + i, 10.0});
  for (std::uint32_t i = 0; i < 8; ++i) edges.push_back({i, i + 1});
  Kinds expected(8);
  for (const std::size_t i : {2u, 3u, 5u}) expected[i] = kOpen;  // 180 to 181 is in the hole
  EXPECT_EQ(BoundaryRules::ofFile(path, "").kindsOf(wgs84(), places, edges, std::vector(8, true)), expected);
}

TEST(BoundaryRules, AShoreThatJumpsHasItsTypeOnAllSides) {
  RawLayer layer = onEarth(FeatureUse::Area);
  addPolygon(layer, "type", "open", {{178, 10}, {-178, 10}, {-178, 20}, {178, 20}});
  Kinds expected = firstOpen(2, 6);
  for (std::size_t i = 10; i < 14; ++i) expected[i] = kOpen;
  EXPECT_EQ(kindsAcross(layer), expected);
}

// A square of 10 by 10 edges of length 1, counter-clockwise from (0, 0): 10 edges of the south, the east and so on.
RuledEdges roughlyRuled(const BoundaryRules& rules) {
  std::vector<Point> places;
  std::vector<NodePair> edges;
  const std::array<Point, 5> corners{{{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}}};
  for (std::uint32_t i = 0; i < 40; ++i) {
    const Point &a = corners[i / 10], &b = corners[i / 10 + 1];
    const double share = (i % 10) / 10.0;
    places.push_back({a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)});
    edges.push_back({i, (i + 1) % 40});
  }
  return rules.roughKindsOf(Crs{}, places, edges, std::vector(40, true));
}

RuledEdges roughlyRuled(const RawLayer& layer) {
  BoundaryRules rules;
  rules.addInput({layer}, "type");
  return roughlyRuled(rules);
}

// The types of edges as letters, one for each side.
std::string inLetters(const Kinds& kinds) {
  std::string text;
  for (std::size_t i = 0; i < kinds.size(); ++i)
    text += (i > 0 && i % 10 == 0 ? " " : "") + std::string(!kinds[i] ? "." : kinds[i] == kRiver ? "r" : "o");
  return text;
}

TEST(RoughBoundaryRules, ALineDrawnByHandLeavesNoWalls) {
  RawLayer layer = layerOf(FeatureUse::Area);
  // As far as half an edge, and farther for a short way.
  addLine(layer, "type", "open",
          {{-0.1, 0.1}, {2, 0.1}, {3.5, -0.45}, {4.4, 0.4}, {6, 0.1}, {6.5, -1.2}, {7, 0.1}, {8, 0}});
  RuledEdges ruled = roughlyRuled(layer);
  EXPECT_EQ(inLetters(ruled.kinds), "oooooooo.. .......... .......... ..........");
  EXPECT_TRUE(ruled.missed.empty());
  layer = layerOf(FeatureUse::Area);  // in two, with a gap between
  addLine(layer, "type", "open", {{10, 3.7}, {9.6, 2.5}, {10, 1}, {10, 0}});
  addLine(layer, "type", "open", {{10.2, 4}, {10.45, 5.5}, {10, 7}});
  ruled = roughlyRuled(layer);
  EXPECT_EQ(inLetters(ruled.kinds), ".......... ooooooo... .......... ..........");
  EXPECT_TRUE(ruled.missed.empty());
}

RawLayer namedLines() {
  RawLayer layer = layerOf(FeatureUse::Area);
  addLine(layer, "type", "open", {{-0.1, 0.1}, {4.2, 0.1}});
  addLine(layer, "type", "open", {{4.2, 0.1}, {9.9, 0.1}});
  addLine(layer, "type", "land", {{10, 0}, {10, 2}});
  addLine(layer, "type", "river", {{10, 3}, {10, 4}});
  addLine(layer, "type", "open", {{10, 5}, {10, 7}});
  for (std::size_t i = 0; i < 4; ++i)
    layer.line_features[i].attributes.emplace_back("Name",
                                                   std::string(1, static_cast<char>('A' + static_cast<int>(i))));
  layer.line_features[4].attributes.emplace_back("username", "E");
  return layer;
}

// Lines of one type are followed as one, whatever their names: the edge where they meet has one of these.
TEST(RoughBoundaryRules, OpeningsHaveTheNamesOfTheirFeatures) {
  const RuledEdges ruled = roughlyRuled(namedLines());
  EXPECT_EQ(namesOf({ruled.kinds.begin(), ruled.kinds.begin() + 20}), "AAAAABBBBB..-D-..---");
  EXPECT_TRUE(ruled.missed.empty());
}

TEST(RoughBoundaryRules, WhatIsDrawnApartStaysApart) {
  RawLayer layer = layerOf(FeatureUse::Area);
  addLine(layer, "type", "open", {{1, 0}, {3, 0.1}});
  addLine(layer, "type", "open", {{4, 0}, {6, 0.1}});
  addLine(layer, "type", "open", {{10.4, 4}, {10, 5}, {10, 7}, {13, 7}});  // leads away at its end
  const RuledEdges ruled = roughlyRuled(layer);
  EXPECT_EQ(inLetters(ruled.kinds), ".oo.oo.... ....ooo... .......... ..........");
  EXPECT_TRUE(ruled.missed.empty());
}

TEST(RoughBoundaryRules, AMouthNarrowerThanAnEdgeIsTheClosestEdge) {
  RawLayer layer = layerOf(FeatureUse::Area);
  addLine(layer, "type", "river", {{2.6, -0.3}, {2.8, -0.2}});
  addLine(layer, "type", "river", {{10.1, 2.4}, {9.9, 3.5}});  // longer than an edge, along none
  RuledEdges ruled = roughlyRuled(layer);
  EXPECT_EQ(inLetters(ruled.kinds), "..r....... ..r....... .......... ..........");
  EXPECT_TRUE(ruled.missed.empty());
  const TemporaryFolder folder;
  const std::string path = folder / "mouth.geojson";
  std::ofstream(path) << R"({"type":"Feature","properties":{"kind":"river"},"geometry":{"type":"Polygon","coordinates":
      [[[7.1,9.9],[7.2,9.9],[7.2,10.2],[7.1,10.2],[7.1,9.9]]]}})";
  ruled = roughlyRuled(BoundaryRules::ofFile(path, ""));
  EXPECT_EQ(inLetters(ruled.kinds), ".......... .......... ..r....... ..........");
  EXPECT_TRUE(ruled.missed.empty());
}

// All of the shore is open, though the line takes a shorter way through the water.
TEST(RoughBoundaryRules, AWayAcrossOpenedWaterIsNoWall) {
  RawLayer layer = layerOf(FeatureUse::Area);
  addLine(layer, "type", "open", {{8, 0}, {8, 2.5}, {10, 2.5}, {10, 0}, {3, 0}});
  const RuledEdges ruled = roughlyRuled(layer);
  EXPECT_EQ(inLetters(ruled.kinds), "...ooooooo oo........ .......... ..........");
  EXPECT_TRUE(ruled.missed.empty());
}

TEST(RoughBoundaryRules, WhatIsMissedHasItsPlace) {
  RawLayer layer = layerOf(FeatureUse::Area);
  addLine(layer, "type", "open", {{0, 0}, {2, 0}, {2.5, 2.5}, {7.5, 2.5}, {8, 0}, {10, 0}});  // a wall of six edges
  addLine(layer, "type", "river", {{5, 5}, {5, 5.1}});                                        // in the water
  addLine(layer, "type", "river", {{30, 5}, {30, 5.1}});                                      // outside
  addLine(layer, "type", "land", {{5, 6}, {5, 6.1}});                                         // opens nothing
  for (std::size_t i = 0; i < layer.line_features.size(); ++i) layer.line_features[i].fid = static_cast<int>(i);
  const RuledEdges ruled = roughlyRuled(layer);
  EXPECT_EQ(inLetters(ruled.kinds), "oo......oo .......... .......... ..........");
  ASSERT_EQ(ruled.missed.size(), 3u);
  EXPECT_EQ(ruled.missed[0].fid, 0);
  EXPECT_FALSE(ruled.missed[0].whole);
  EXPECT_NEAR(ruled.missed[0].place.x, 5.0, 0.1);
  EXPECT_EQ(ruled.missed[1].fid, 1);
  EXPECT_TRUE(ruled.missed[1].whole && ruled.missed[1].inside);
  EXPECT_NEAR(ruled.missed[1].place.y, 5.05, 0.01);
  EXPECT_EQ(ruled.missed[2].fid, 2);
  EXPECT_FALSE(ruled.missed[2].inside);
}

TEST(BoundaryRules, AnInputDefinesNothingUnlessItsColumnIsGiven) {
  RawLayer layer = layerOf(FeatureUse::Area);
  addPolygon(layer, "type", "reed", kSquare);  // a lake's column of this name may well contain this
  BoundaryRules rules;
  rules.addInput({layer}, "");
  EXPECT_TRUE(rules.empty());
  rules.addInput({layer}, "kind");
  EXPECT_TRUE(rules.empty());
  EXPECT_THROW(rules.addInput({layer}, "type"), InputError);
}

TEST(BoundaryRules, WhatACleanedFileSaysOfItsEdgesCountsAlone) {
  RawLayer areas = layerOf(FeatureUse::Area), edges = layerOf(FeatureUse::Boundary);
  addPolygon(areas, "type", "open", kSquare);
  addLine(edges, "boundary", "river", {{1, 0}, {2, 0}});
  for (const std::string column : {"", "type"}) {
    BoundaryRules rules;
    rules.addInput({areas, edges}, column);
    EXPECT_EQ(kindsOfTwo(rules), (Kinds{std::nullopt, kRiver})) << column;
  }
}

TEST(BoundaryRules, TextsMeanTheirKinds) {
  for (const BoundaryKind& kind : {kOpen, kRiver, kLand, BoundaryKind{BoundaryRole::Land, 10}})
    EXPECT_EQ(kindOfText(textOfKind(kind), ""), kind);
}

}  // namespace
}  // namespace coastmesh
