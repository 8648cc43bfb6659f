// Pictures of globes, checked pixel by pixel: positions, and that the far side is hidden.
#include "apps/plot/plot_globe.hpp"

#include <cairo.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "apps/plot/plot_style.hpp"
#include "gis/error.hpp"
#include "tests/gis/globe_samples.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using testing::octahedralGlobe;
using testing::SpaceVector;
using testing::TemporaryFolder;

constexpr std::uint64_t kSize = 400;

enum class Pixel { Paper, Land, Water, Line };

// A picture whose disk fills the square except for a narrow margin.
class Picture {
 public:
  Picture(const Grid& grid, const std::string& view) {
    PlotOptions options;
    options.size_px = kSize;
    options.edges = false;
    const TemporaryFolder folder;
    plotGlobe(grid, options, globeViewNamed(view).value(), folder / "a.png");
    picture_.reset(cairo_image_surface_create_from_png((folder / "a.png").c_str()));
  }

  // `right` and `up` are shares of the globe's radius.
  Pixel at(double right, double up) const {
    const double half = kSize / 2.0, radius = half / 1.04;
    return atPixel(static_cast<int>(half + right * radius), static_cast<int>(half - up * radius));
  }

  Pixel atPixel(int x, int y) const {
    const unsigned char* const row =
        cairo_image_surface_get_data(picture_.get()) + y * cairo_image_surface_get_stride(picture_.get());
    const std::uint32_t color = reinterpret_cast<const std::uint32_t*>(row)[x] & 0xffffff;
    const auto is = [color](const Color& wanted) {
      int shift = 24;
      for (const double share : {wanted.red, wanted.green, wanted.blue}) {
        shift -= 8;
        if (std::abs(static_cast<double>(color >> shift & 255) - 255.0 * share) > 1.5) return false;
      }
      return true;
    };
    return is(kPaper) ? Pixel::Paper : is(kLand) ? Pixel::Land : is(kWater) ? Pixel::Water : Pixel::Line;
  }

  // The number of such pixels among 60 by 60 places of the disk, without its outline.
  int count(Pixel wanted) const {
    int found = 0;
    for (int i = -30; i <= 30; ++i)
      for (int j = -30; j <= 30; ++j)
        if (std::hypot(i, j) < 29.0) found += at(i / 30.0, j / 30.0) == wanted;
    return found;
  }

 private:
  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> picture_{nullptr, cairo_surface_destroy};
};

// The part of a globe within some degrees of a place.
Grid cap(const Point& middle, double degrees) {
  const SpaceVector axis = testing::vectorOf(middle);
  return octahedralGlobe(5, [&](const SpaceVector& sum) {
    return testing::dot(sum, axis) / testing::lengthOf(sum) > std::cos(degrees * M_PI / 180.0);
  });
}

TEST(PlotGlobe, AClosedGlobeFillsTheDiskFromAnywhere) {
  const Grid globe = octahedralGlobe(3, [](const SpaceVector&) { return true; });
  for (const char* view :
       {"orthographic=0,0", "orthographic=180,10", "orthographic=-77,-90", "orthographic=13,90", "orthographic"}) {
    const Picture picture(globe, view);
    EXPECT_EQ(picture.count(Pixel::Land), 0) << view;
    EXPECT_EQ(picture.count(Pixel::Paper), 0) << view;
    for (const double side : {-1.03, 1.03}) EXPECT_EQ(picture.at(side, 0.3), Pixel::Paper) << view;
  }
}

TEST(PlotGlobe, TheOtherSideIsNotSeen) {
  const Grid grid = cap({20, 10}, 40);
  EXPECT_EQ(Picture(grid, "orthographic=-160,-10").count(Pixel::Water), 0);
  EXPECT_EQ(Picture(grid, "orthographic=20,10").at(0.0, 0.0), Pixel::Water);
  EXPECT_EQ(Picture(grid, "orthographic").at(0.02, 0.02), Pixel::Water);  // above the cap's centre by default
  // Half of the cap is beyond the horizon.
  const Picture aslant(grid, "orthographic=110,0");
  EXPECT_EQ(aslant.at(-0.97, 0.1), Pixel::Water);
  EXPECT_EQ(aslant.at(0.1, 0.1), Pixel::Land);
  EXPECT_EQ(aslant.at(0.9, 0.1), Pixel::Land);
}

// Seen from above 0, 0: east is right, north is up, distances from the centre are sines.
TEST(PlotGlobe, PlacesLieWhereAGlobeShowsThem) {
  struct Place {
    double lon, lat, right, up;
  };
  for (const auto& [lon, lat, right, up] :
       {Place{36.87, 3.44, 0.5989, 0.06}, Place{-36.87, 3.44, -0.5989, 0.06}, Place{4.0, 33, 0.0585, 0.5446},
        Place{4.0, -53.13, 0.0419, -0.8}, Place{53.13, 36.87, 0.64, 0.6}}) {
    const Picture picture(cap({lon, lat}, 8), "orthographic=0,0");
    EXPECT_EQ(picture.at(right, up), Pixel::Water) << lon << ' ' << lat;
    EXPECT_EQ(picture.at(-right, -up), Pixel::Land) << lon << ' ' << lat;
  }
  // Across the antimeridian and round a pole.
  const Picture behind(cap({180, 0}, 20), "orthographic=180,0");
  for (const double right : {-0.2, 0.06, 0.2}) EXPECT_EQ(behind.at(right, 0.1), Pixel::Water);
  EXPECT_EQ(behind.at(0.53, 0.1), Pixel::Land);
  const Picture pole(cap({0, 90}, 20), "orthographic=77,60");
  EXPECT_EQ(pole.at(0.0, 0.5), Pixel::Water);
  EXPECT_EQ(pole.at(0.0, -0.4), Pixel::Land);
}

// A triangle that covers an octant: its sides bulge like great circles.
TEST(PlotGlobe, EdgesAreGreatCircles) {
  Grid octant;
  octant.crs = wgs84();
  octant.nodes = {{-45, 0}, {45, 0}, {0, 90}};
  octant.triangles = {{0, 1, 2}};
  const Picture picture(octant, "orthographic=0,0");
  // The meridian at 45 degrees east is half an ellipse; the chord would be a straight line at 0.7071 (1 - up).
  EXPECT_EQ(picture.at(0.55, 0.45), Pixel::Water);
  EXPECT_EQ(picture.at(-0.55, 0.45), Pixel::Water);
  EXPECT_EQ(picture.at(0.66, 0.45), Pixel::Land);
  EXPECT_EQ(picture.at(0.3, -0.05), Pixel::Land);
}

// Positions on the map of the whole Earth, in the Natural Earth projection of a sphere of radius 1, which extends to
// 2.7354 on the right and 1.4224 at the top.
class WorldPicture : public Picture {
 public:
  using Picture::Picture;
  Pixel atChart(double x, double y) const {
    const double pixels = kSize / (2.0 * 1.04 * 2.7354);
    return atPixel(static_cast<int>(kSize / 2.0 + x * pixels), static_cast<int>((1.04 * 1.4224 - y) * pixels));
  }
};

TEST(PlotGlobe, AllOfTheEarthIsSeenAtOnce) {
  const WorldPicture all(octahedralGlobe(3, [](const SpaceVector&) { return true; }), "natural-earth");
  for (const double x : {-2.6, -1.3, 0.05, 1.3, 2.6}) EXPECT_EQ(all.atChart(x, 0.07), Pixel::Water) << x;
  for (const double y : {-1.38, -0.7, 0.7, 1.38}) EXPECT_EQ(all.atChart(0.07, y), Pixel::Water) << y;
  EXPECT_EQ(all.atChart(2.7, 1.3), Pixel::Paper);
}

TEST(PlotGlobe, WhatTheMapCutsLiesOnBothItsSides) {
  const WorldPicture behind(cap({180, 0}, 20), "natural-earth");
  for (const double x : {-2.6, 2.6}) EXPECT_EQ(behind.atChart(x, 0.1), Pixel::Water) << x;
  EXPECT_EQ(behind.atChart(0.1, 0.1), Pixel::Land);
  const WorldPicture turned(cap({180, 0}, 20), "natural-earth=180");
  EXPECT_EQ(turned.atChart(0.1, 0.1), Pixel::Water);
  for (const double x : {-2.6, 2.6}) EXPECT_EQ(turned.atChart(x, 0.1), Pixel::Land) << x;
  const WorldPicture pole(cap({0, -90}, 15), "natural-earth");
  for (const double x : {-1.2, 0.07, 1.2}) {
    EXPECT_EQ(pole.atChart(x, -1.37), Pixel::Water) << x;
    EXPECT_EQ(pole.atChart(x, -0.9), Pixel::Land) << x;
  }
}

TEST(PlotGlobe, ViewsAreNamed) {
  EXPECT_FALSE(globeViewNamed("plane"));
  EXPECT_FALSE(globeViewNamed("orthographic").value().above);
  EXPECT_EQ(globeViewNamed("orthographic=-40.5,25").value().above, (LonLat{-40.5, 25.0}));
  EXPECT_TRUE(globeViewNamed("natural-earth").value().all);
  EXPECT_EQ(globeViewNamed("natural-earth=150").value().above, (LonLat{150.0, 0.0}));
  EXPECT_FALSE(globeViewNamed("orthographic=1,2").value().all);
  for (const char* wrong : {"", "natural-earth=", "natural-earth=1,2", "natural-earth=east", "plane=1", "globe",
                            "orthographic=", "orthographic=1", "orthographic=1,", "orthographic=1,2,3",
                            "orthographic=1,91", "orthographic=nan,0", "orthographic 1,2"})
    EXPECT_THROW(globeViewNamed(wrong), OptionError) << wrong;
}

TEST(PlotGlobe, WhatItCannotDrawIsRefused) {
  const TemporaryFolder folder;
  Grid grid = cap({0, 0}, 10);
  PlotOptions options;
  options.color = PlotColor::Depth;
  EXPECT_THROW(plotGlobe(grid, options, {}, folder / "a.png"), InputError);
  options.color = PlotColor::Piece;
  EXPECT_THROW(plotGlobe(grid, options, {}, folder / "a.png"), OptionError);
  options.color = PlotColor::None;
  EXPECT_THROW(plotGlobe(grid, options, {}, folder / "a.gif"), OutputError);
  grid.crs = {};
  EXPECT_THROW(plotGlobe(grid, options, {}, folder / "a.png"), InputError);
}

}  // namespace
}  // namespace coastmesh
