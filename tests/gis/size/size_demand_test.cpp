#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "gis/error.hpp"
#include "gis/size/size_source.hpp"
#include "tests/gis/size/size_samples.hpp"

namespace coastmesh {
namespace {

using testing::kInfinity;
using testing::planeDomain;
using testing::rectangle;
using testing::SizeFiles;

// Demand is found before sizes are made, on few cells. None of these tests should take more than about a second, which
// a test cannot check; it can check that memory suffices.
class Demand : public SizeFiles {
 protected:
  // A lake of 80 km by 30 km in an area of 100 km by 50 km.
  const Domain domain_ = planeDomain([] {
    Pslg pslg = rectangle(80e3, 30e3);
    for (Point& p : pslg.points) p = p + Point{10e3, 10e3};
    return pslg;
  }());
  std::string pixels(double there) {
    return raster("a.tif", 20, 10, {0.0, 5e3, 0.0, 50e3, 0.0, -5e3}, 0, [=](double x, double y) {
      return std::abs(x - 47.5e3) < 1.0 && std::abs(y - 22.5e3) < 1.0 ? there : 5e3;
    });
  }
  VertexDemand refused(const SizeOptions& options, double most_vertices) {
    try {
      makeSizeFunction(options, readSizeInputs(options, {}), domain_, most_vertices, inOrder);
    } catch (const TooManyVertices& error) {
      EXPECT_GT(error.demand.vertices, most_vertices);
      return error.demand;
    }
    ADD_FAILURE() << "was not refused";
    return {};
  }
};

TEST_F(Demand, OfOnePixel) {
  SizeOptions options;
  options.rasters = {pixels(1.0)};
  const double needed = 2.0 / std::sqrt(3.0) * 25e6;
  for (const double most : {2e4, 1e6}) {
    const VertexDemand demand = refused(options, most);
    EXPECT_NEAR(std::log(demand.vertices / needed), 0.0, std::log(3.0)) << most;
    EXPECT_EQ(demand.option, "--size-raster");
    EXPECT_NEAR(demand.size_m, 1.0, 1e-6);
    EXPECT_NEAR(demand.place.x, 47.5e3, 2.5e3);
    EXPECT_NEAR(demand.place.y, 22.5e3, 2.5e3);
  }
  options.rasters = {pixels(1e-38)};
  refused(options, 1e9);
  // With a lower bound it gets what it needs: nothing is refused that fits.
  options.least_m = 100.0;
  const DomainSizes sizes = makeSizeFunction(options, readSizeInputs(options, {}), domain_, 2e4, inOrder);
  EXPECT_GT(sizes.demand.vertices, 2500.0);
  EXPECT_NEAR(sizes.function->at({47.5e3, 22.5e3}), 100.0, 1.0);
}

TEST_F(Demand, OfExtremes) {
  const auto with = [](auto&& set) {
    SizeOptions options;
    set(options);
    return options;
  };
  const std::vector<std::pair<std::string, SizeOptions>> cases = {
      {"--size", with([](SizeOptions& o) { o.size_m = 1e-3; })},
      {"--size", with([](SizeOptions& o) { o.size_m = 1e-300; })},
      {"--size-shore", with([](SizeOptions& o) { o.shore_m = 1e-3; })},
      {"--size-shore", with([](SizeOptions& o) { o.shore_m = 1e-300; })},
      {"--size-max", with([](SizeOptions& o) {
         o.shore_m = 5.0;
         o.most_m = 1e-3;
       })},
      {"--size-min", with([](SizeOptions& o) {
         o.shore_m = 1e-300;
         o.shore_rate = 0.0;
         o.least_m = 1e-2;
       })},
      {"--channel-elements", with([](SizeOptions& o) {
         o.channel_elements = 1e5;
         o.least_m = 1e-3;
       })},
  };
  for (const auto& [option, options] : cases) {
    for (const double most : {3e3, 1e6}) EXPECT_EQ(refused(options, most).option, option) << most;
  }
  SizeOptions waves;
  waves.bathymetry = {pixels(-100.0)};
  for (const double elements : {1e9, 1e308}) {
    waves.depth.wave_elements = elements;
    EXPECT_EQ(refused(waves, 3e3).option, "--wave-elements");
  }
}

// A place too small for coordinates to resolve needs few vertices all the same.
TEST_F(Demand, SizesBelowWhatCoordinatesTellApartAreRefused) {
  std::ofstream(file("p.geojson"))
      << R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"size":1e-300},
    "geometry":{"type":"Point","coordinates":[50000,25000]}}]})";
  SizeOptions options;
  options.size_m = 1e3;
  options.features = {file("p.geojson")};
  EXPECT_THROW(makeSizeFunction(options, readSizeInputs(options, {}), domain_, 1e6, inOrder), InputError);
  options.least_m = 0.1;
  EXPECT_NO_THROW(makeSizeFunction(options, readSizeInputs(options, {}), domain_, 1e6, inOrder));
}

TEST_F(Demand, IsTheIntegralOverTheDomain) {
  SizeOptions options;
  options.shore_m = 200.0;
  options.shore_rate = 0.1;
  options.most_m = 1500.0;
  const DomainSizes sizes = makeSizeFunction(options, readSizeInputs(options, {}), domain_, kInfinity, inOrder);
  // Midpoint rule on squares of 20 m.
  double sum = 0.0;
  for (double x = 10e3 + 10.0; x < 90e3; x += 20.0)
    for (double y = 10e3 + 10.0; y < 40e3; y += 20.0) {
      const double h = sizes.function->at({x, y});
      sum += 2.0 / std::sqrt(3.0) * 400.0 / h / h;
    }
  EXPECT_NEAR(sizes.demand.vertices / sum, 1.0, 0.1);
}

// A graph whose holes determine what is inside.
TEST_F(Demand, OfAnUnlabelledGraph) {
  Pslg pslg = rectangle(10.0, 10.0);
  const Pslg island = rectangle(8.0, 8.0);
  for (const Point& p : island.points) pslg.points.push_back(p + Point{1.0, 1.0});
  for (const Segment& s : island.segments) pslg.segments.push_back({s.a + 4, s.b + 4});
  for (Segment& s : pslg.segments) s.left = s.right = kUnlabelled;
  pslg.holes = {{5.0, 5.0}};
  SizeOptions options;
  options.size_m = 0.1;
  const DomainSizes sizes =
      makeSizeFunction(options, readSizeInputs(options, {}), planeDomain(pslg), kInfinity, inOrder);
  EXPECT_NEAR(sizes.demand.vertices, 36.0 * 2.0 / std::sqrt(3.0) / 0.01, 400.0);
}

}  // namespace
}  // namespace coastmesh
