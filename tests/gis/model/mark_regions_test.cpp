#include "gis/model/mark_regions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/triangulate/delaunay.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {

namespace {

constexpr int kSide = 30;

// The square from (0, 0) to (kSide, kSide), two triangles per unit square, in feature 0.
TriMesh squares() {
  TriMesh mesh;
  for (int y = 0; y <= kSide; ++y)
    for (int x = 0; x <= kSide; ++x) mesh.points.push_back({static_cast<double>(x), static_cast<double>(y)});
  for (VertexId y = 0; y < kSide; ++y)
    for (VertexId x = 0; x < kSide; ++x) {
      const VertexId at = y * (kSide + 1) + x;
      for (const auto& v : {std::array{at, at + 1, at + kSide + 2}, std::array{at, at + kSide + 2, at + kSide + 1}}) {
        Triangle& triangle = mesh.triangles.emplace_back();
        triangle.v = {v[0], v[1], v[2]};
        mesh.regions.push_back(0);
      }
    }
  return mesh;
}

Feature region(std::int64_t fid, const Ring& outer, std::vector<Ring> holes = {}) {
  Feature feature = polygonFeature(fid, outer, std::move(holes));
  feature.use = FeatureUse::Region;
  feature.attributes = {{"name", "region " + std::to_string(fid)}};
  return feature;
}

// One for every second square, and wider ones that overlap these, one with a hole: the first that holds a triangle
// counts.
TEST(MarkRegions, TheFirstThatHoldsATriangleCounts) {
  Coastline coastline = coastlineOf({polygonFeature(0, square(0, 0, kSide))});
  coastline.features.push_back(region(1, square(4, 4, 6), {square(6, 6, 2)}));
  for (int i = 2; i < 2 + kSide * kSide; i += 2)
    coastline.features.push_back(region(i, square((i - 2) % kSide, (i - 2) / kSide, 1)));
  coastline.features.push_back(region(5000, square(0, 0, kSide / 2)));
  std::vector<std::size_t> members(coastline.features.size());
  for (std::size_t m = 0; m < members.size(); ++m) members[m] = m;
  TriMesh mesh = squares();
  Coastline names = coastlineOf({polygonFeature(0, {})});
  const std::vector<std::uint32_t> used = markRegions(coastline, members, Projection::plane(), mesh, names);
  EXPECT_EQ(used.size() + 1, names.features.size());
  EXPECT_TRUE(std::ranges::is_sorted(used));
  RegionId next = 1;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const int x = static_cast<int>(t / 2) % kSide, y = static_cast<int>(t / 2) / kSide;
    const auto in = [&](int from, int side) { return x >= from && x < from + side && y >= from && y < from + side; };
    const int square_of = 2 + y * kSide + x;
    std::string expected;
    if (in(4, 6) && !in(6, 2)) {
      expected = "region 1";
    } else if (square_of % 2 == 0) {
      expected = "region " + std::to_string(square_of);
    } else if (in(0, kSide / 2)) {
      expected = "region 5000";
    }
    ASSERT_LT(static_cast<std::size_t>(mesh.regions[t]), names.features.size());
    EXPECT_EQ(names.features[static_cast<std::size_t>(mesh.regions[t])].region, expected) << x << ' ' << y;
    EXPECT_LE(mesh.regions[t], next) << "numbered as they come";
    next = std::max(next, mesh.regions[t] + 1);
  }
  EXPECT_EQ(names.features.size(), static_cast<std::size_t>(next));
}

// In a plane that shows the globe, one region round the place at infinity and one apart from it.
TEST(MarkRegions, OneMayHoldThePlaceAtInfinity) {
  const Projection projection =
      Projection::fitted(coastlineOf({polygonFeature(0, square(-5, -5, 10))}, wgs84()), {0}, SurfaceKind::Ellipsoid);
  const Coastline coastline = coastlineOf(
      {region(0, {{150, -40}, {-150, -40}, {-150, 40}, {150, 40}}), region(1, square(20, 20, 30))}, wgs84());
  const std::vector<std::pair<Point, std::string>> expected{{{175, 10}, "region 0"}, {{-160, -20}, "region 0"},
                                                            {{30, 30}, "region 1"},  {{0, 0}, ""},
                                                            {{80, -10}, ""},         {{180, 80}, ""}};
  TriMesh mesh;
  for (const auto& [place, name] : expected) {
    const auto first = static_cast<VertexId>(mesh.points.size());
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.1, 0.0}, {0.0, 0.1}})
      mesh.points.push_back(projection.forward({place.x + x, place.y + y}));
    mesh.triangles.emplace_back().v = {first, first + 1, first + 2};
    mesh.regions.push_back(0);
  }
  Coastline names = coastlineOf({polygonFeature(0, {})});
  markRegions(coastline, {0, 1}, projection, mesh, names);
  for (std::size_t t = 0; t < expected.size(); ++t)
    EXPECT_EQ(names.features[static_cast<std::size_t>(mesh.regions[t])].region, expected[t].second) << t;
}

TEST(MarkRegions, WithoutRegionsNothingChanges) {
  const Coastline coastline = coastlineOf({polygonFeature(0, square(0, 0, kSide))});
  TriMesh mesh = squares();
  Coastline names = coastlineOf({polygonFeature(0, {})});
  EXPECT_TRUE(markRegions(coastline, {0}, Projection::plane(), mesh, names).empty());
  EXPECT_EQ(mesh.regions, BulkList<RegionId>(mesh.triangles.size(), 0));
  EXPECT_EQ(names.features.size(), 1u);
}

}  // namespace

}  // namespace coastmesh
