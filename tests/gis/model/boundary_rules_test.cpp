// Which polygon or line determines the type of a boundary edge.
#include "gis/model/boundary_rules.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iomanip>
#include <random>
#include <sstream>

#include "gis/error.hpp"
#include "gis/read/raw_layer.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using testing::TemporaryFolder;
using Kinds = std::vector<std::optional<BoundaryKind>>;

constexpr BoundaryKind kOpen{BoundaryRole::Open}, kRiver{BoundaryRole::River}, kLand{BoundaryRole::Land};

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
  return rules.kindsOf(Crs{}, {{0, 0}, {1, 0}, {2, 0}}, {{0, 1}, {1, 2}}, {true, true});
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
