// Sizes from rasters that go round the Earth, in domains across their seam and around a pole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "core/size/size_tree.hpp"
#include "gis/clean/clean.hpp"
#include "gis/size/size_raster.hpp"
#include "tests/gis/size/size_samples.hpp"

namespace coastmesh {
namespace {

using namespace coastmesh::testing;

class RasterRoundGlobe : public SizeFiles {
 protected:
  static double sizeAt(const Point& p) {
    const double lon = p.x * std::numbers::pi / 180.0, lat = p.y * std::numbers::pi / 180.0;
    return 60000.0 + 20000.0 * std::cos(lat) * std::cos(lon + 1.0);
  }
  // Pixels of one degree, the first column east of `west`.
  std::string world(double west) {
    return raster(west == 0.0 ? "r0.tif" : "r180.tif", 360, 180, {west, 1.0, 0.0, 90.0, 0.0, -1.0}, 4326,
                  [](double x, double y) {
                    return sizeAt({x, y});
                  });
  }
  static Domain domainOf(const Ring& shore) {
    Coastline coast;
    coast.crs = wgs84();
    coast.features.emplace_back().polygons.push_back({shore, {}});
    CleanReport report;
    return cleanFeatures(coast, {0}, Projection::fitted(coast, {0}), {}, report);
  }
  static Domain across180() { return domainOf({{172, 40}, {188, 40}, {188, 52}, {172, 52}}); }
  static Domain aroundPole() {
    Ring ring;
    for (int lon = -180; lon < 180; lon += 10) ring.push_back({static_cast<double>(lon), 75.0});
    return domainOf(ring);
  }
};

TEST_F(RasterRoundGlobe, SizesAreTheSameWhereverTheSeamIs) {
  const std::vector<std::pair<Domain, std::vector<double>>> cases{{across180(), {41.0, 46.3, 51.5}},
                                                                  {aroundPole(), {76.0, 83.0, 89.7}}};
  for (const auto& [domain, latitudes] : cases) {
    SizeOptions at_seam, beside;
    at_seam.rasters = {world(-180.0)};
    beside.rasters = {world(0.0)};
    const auto size = sizesIn(at_seam, domain, wgs84()), other = sizesIn(beside, domain, wgs84());
    for (double lon = 172.5; lon < 187.5; lon += 0.37) {
      for (const double lat : latitudes) {
        const Point place = domain.projection.forward({lon, lat});
        EXPECT_NEAR(size->at(place) / other->at(place), 1.0, 0.03) << lon << " " << lat;
        EXPECT_NEAR(size->at(place) / domain.projection.scaleAt(place) / sizeAt({lon, lat}), 1.0, 0.04)
            << lon << " " << lat;
      }
    }
    // Cells are as many: none are divided for the seam's sake.
    const auto cells = [](const SizeFunction& of) { return dynamic_cast<const SizeTree&>(of).cells(); };
    EXPECT_LT(cells(*size), 2 * cells(*other) + 100);
  }
}

TEST_F(RasterRoundGlobe, BoundsHoldAndAreTightAcrossTheSeam) {
  const Domain domain = across180();
  const TileRule as_is{0.0, [](const RasterTile& tile, std::span<float> sizes) {
                         for (int y = 0; y < tile.height; ++y)
                           for (int x = 0; x < tile.width; ++x)
                             sizes[static_cast<std::size_t>(y * tile.width + x)] = tile.at(x, y);
                       }};
  Box around;
  for (const Point& p : domain.pslg.points) around.add(p);
  const RasterField field(readRasterGeometry(world(-180.0)), wgs84(), domain.projection, around.grownBy(1e5), as_is,
                          inOrder);
  for (int i = 0; i < 200; ++i) {
    const SizeBox box{domain.projection.forward({180.0 + 0.002 * (i % 7), 41.0 + 0.05 * i}), 500.0 * (1 + i % 60)};
    SizeRange range;
    field.bound(std::span(&box, 1), std::span(&range, 1));
    EXPECT_LT(range.high, 1.1 * range.low);
    for (int k = 0; k < 25; ++k) {
      const Point place = box.centre + box.half * Point{0.5 * (k % 5) - 1.0, 0.5 * (k / 5) - 1.0};
      double size = 0.0;
      field.sample(std::span(&place, 1), std::span(&size, 1));
      EXPECT_GE(size, range.low);
      EXPECT_LE(size, range.high);
    }
  }
}

TEST_F(RasterRoundGlobe, NoSizeAroundAPoleIsBelowTheLeast) {
  const Domain domain = aroundPole();
  const TileRule same{0.0, [](const RasterTile&, std::span<float> sizes) { std::ranges::fill(sizes, 5000.0F); }};
  const RasterField field(readRasterGeometry(world(0.0)), wgs84(), domain.projection, Box::of({-2e6, -2e6}, {2e6, 2e6}),
                          same, inOrder);
  for (const double half : {1.0, 1e3, 1e5, 1e6}) {
    const SizeBox box{domain.projection.forward({30.0, 89.999}), half};
    SizeRange range;
    field.bound(std::span(&box, 1), std::span(&range, 1));
    EXPECT_EQ(range.low, 5000.0) << half;
  }
}

}  // namespace
}  // namespace coastmesh
