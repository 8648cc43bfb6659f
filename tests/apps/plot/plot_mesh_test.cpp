#include "apps/plot/plot_mesh.hpp"

#include <cairo.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <set>

#include "apps/plot/plot_globe.hpp"
#include "apps/plot/plot_style.hpp"
#include "apps/usage/command_line.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "tests/gis/globe_samples.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {

namespace {

namespace fs = std::filesystem;

class PlotMesh : public ::testing::Test {
 protected:
  PlotMesh() {
    std::string name = (fs::temp_directory_path() / "coastmesh-plot-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~PlotMesh() override { fs::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  std::string textOf(const std::string& name) const {
    std::ifstream stream(file(name));
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  // `n` by `n` squares of two triangles each, in a plane.
  static Grid board(std::uint32_t n) {
    Grid grid;
    for (std::uint32_t y = 0; y <= n; ++y) {
      for (std::uint32_t x = 0; x <= n; ++x) grid.nodes.push_back({static_cast<double>(x), static_cast<double>(y)});
    }
    for (std::uint32_t y = 0; y < n; ++y) {
      for (std::uint32_t x = 0; x < n; ++x) {
        const std::uint32_t a = y * (n + 1) + x;
        grid.triangles.push_back({a, a + 1, a + n + 2});
        grid.triangles.push_back({a, a + n + 2, a + n + 1});
      }
    }
    return grid;
  }

  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> drawn(const Grid& grid, const PlotOptions& options) {
    plotMesh(grid, options, file("a.png"));
    return {cairo_image_surface_create_from_png(file("a.png").c_str()), cairo_surface_destroy};
  }

  // The colour of the pixel in the middle of the map.
  std::uint32_t colorInTheMiddle(const Grid& grid, PlotColor color) {
    PlotOptions options;
    options.color = color;
    options.size_px = 400;
    options.edges = false;
    const auto picture = drawn(grid, options);
    const int x = cairo_image_surface_get_width(picture.get()) / 2;
    const int y = (cairo_image_surface_get_height(picture.get()) - static_cast<int>(kStripPx)) / 2;
    const unsigned char* row =
        cairo_image_surface_get_data(picture.get()) + y * cairo_image_surface_get_stride(picture.get());
    return reinterpret_cast<const std::uint32_t*>(row)[x] & 0xffffff;
  }

  // The colours of all pixels of the map, each as 0xRRGGBB.
  std::set<std::uint32_t> colors(const Grid& grid, PlotColor color, std::uint64_t size, bool degrees = false) {
    PlotOptions options;
    options.color = color;
    options.size_px = size;
    options.edges = false;
    options.degrees = degrees;
    const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> picture = drawn(grid, options);
    const int stride = cairo_image_surface_get_stride(picture.get());
    std::set<std::uint32_t> found;
    // The longer side of the map has `size` pixels; the legend is below the map.
    const auto [west, east] = std::ranges::minmax(grid.nodes, {}, &Point::x);
    const auto [south, north] = std::ranges::minmax(grid.nodes, {}, &Point::y);
    const double scale = static_cast<double>(size) / std::max(east.x - west.x, north.y - south.y);
    const int margin = static_cast<int>(size / 10);
    const int width = static_cast<int>(scale * (east.x - west.x)),
              height = static_cast<int>(scale * (north.y - south.y));
    for (int y = margin; y < height - margin; ++y) {
      const unsigned char* row = cairo_image_surface_get_data(picture.get()) + y * stride;
      for (int x = margin; x < width - margin; ++x) {
        found.insert(reinterpret_cast<const std::uint32_t*>(row)[x] & 0xffffff);
      }
    }
    return found;
  }

  // True if one of the colours is `wanted`, apart from rounding.
  static bool holds(const std::set<std::uint32_t>& colors, std::uint32_t wanted) {
    const auto near = [wanted](std::uint32_t color) {
      for (const unsigned shift : {0u, 8u, 16u}) {
        const int a = static_cast<int>(color >> shift & 255), b = static_cast<int>(wanted >> shift & 255);
        if (std::abs(a - b) > 2) return false;
      }
      return true;
    };
    return std::ranges::any_of(colors, near);
  }

  fs::path folder_;
};

TEST_F(PlotMesh, TrianglesCoverEveryPixelOnceWhateverTheirSize) {
  // All triangles have the same shape: one colour and no gap, whether they are large or smaller than a pixel.
  for (std::uint32_t n : {1u, 7u, 40u, 300u}) {
    EXPECT_EQ(colors(board(n), PlotColor::Angle, 200).size(), 1u) << n;
  }
}

TEST_F(PlotMesh, PartsOfOneFeatureThatDoNotTouchDifferInColor) {
  Grid grid = board(4);
  EXPECT_EQ(colors(grid, PlotColor::Region, 200).size(), 1u);
  // Two features, the left half and the right: two colours and that of the border.
  for (const auto& corners : grid.triangles) {
    const double middle = (grid.nodes[corners[0]].x + grid.nodes[corners[1]].x + grid.nodes[corners[2]].x) / 3;
    grid.feature_of.push_back(middle < 2.0 ? 0 : 1);
  }
  grid.features.resize(2);
  EXPECT_GE(colors(grid, PlotColor::Region, 200).size(), 2u);
}

TEST_F(PlotMesh, DepthColorsByHeightAndNeedsOne) {
  Grid grid = board(4);
  EXPECT_THROW(colors(grid, PlotColor::Depth, 100), InputError);
  for (const Point& p : grid.nodes) grid.z.push_back(-10.0 * p.x);
  EXPECT_GE(colors(grid, PlotColor::Depth, 100).size(), 4u);
  grid.z.assign(grid.nodes.size(), std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(colors(grid, PlotColor::Depth, 100), InputError);
}

// In the plane of the picture, the triangles at the corners are the larger ones.
TEST_F(PlotMesh, SizesAreThoseOnTheGround) {
  constexpr std::uint32_t kLargest = 0x2e7da8;
  Grid grid;
  grid.crs = wgs84();
  const auto add = [&](const Point& middle, double size_deg) {
    const double stretch = 1.0 / std::cos(middle.y * M_PI / 180.0);
    const auto first = static_cast<std::uint32_t>(grid.nodes.size());
    for (const Point& p : {Point{-0.5, -0.3}, Point{0.5, -0.3}, Point{0.0, 0.6}})
      grid.nodes.push_back({middle.x + size_deg * stretch * p.x, middle.y + size_deg * p.y});
    grid.triangles.push_back({first, first + 1, first + 2});
  };
  add({0.0, 0.0}, 6.0);
  for (const double x : {-25.0, 25.0})
    for (const double y : {-25.0, 25.0}) add({x, y}, 5.8);
  EXPECT_TRUE(holds({colorInTheMiddle(grid, PlotColor::Size)}, kLargest));
}

TEST_F(PlotMesh, ATooLargeMeshIsDrawnOnAGlobe) {
  const auto all = [](const testing::SpaceVector&) { return true; };
  const Grid globe = testing::octahedralGlobe(3, all);
  const PlotOptions options;
  EXPECT_FALSE(plotMesh(globe, options, file("plane.png")));
  const std::string note = plotMeshOrGlobe(globe, options, file("plane.png"));
  EXPECT_NE(note.find("drawn on a globe"), std::string::npos) << note;
  plotGlobe(globe, options, {}, file("globe.png"));
  EXPECT_TRUE(textOf("plane.png") == textOf("globe.png"));
  const auto is_northern = [](const testing::SpaceVector& place) { return place[2] > 0.0; };
  EXPECT_EQ(plotMeshOrGlobe(testing::octahedralGlobe(3, is_northern), options, file("half.png")), "");
  PlotOptions box;
  box.bbox = PlotBox{-170, -60, 170, 70};
  EXPECT_THROW(plotMeshOrGlobe(globe, box, file("box.png")), OptionError);
}

// Blue is the end of the scale, reached only by equilateral triangles; halves of squares have 0.87.
TEST_F(PlotMesh, QualityIsThatOfTheShapeAlone) {
  constexpr std::uint32_t kBest = 0x2e7da8;
  const std::set<std::uint32_t> halves = colors(board(7), PlotColor::Quality, 200);
  EXPECT_EQ(halves.size(), 1u);
  EXPECT_FALSE(holds(halves, kBest));
  Grid grid = board(1);
  const double h = std::sqrt(3.0) / 2.0;
  grid.nodes = {{0, 0}, {1, 0}, {0.5, h}, {1.5, h}};
  grid.triangles = {{0, 1, 2}, {1, 3, 2}};
  EXPECT_TRUE(holds(colors(grid, PlotColor::Quality, 200), kBest));
}

// Two by two quadrilaterals beside one another, each `wide` and 1 high, leaning by `lean`.
Grid quadBoard(double wide, double lean) {
  Grid grid;
  for (const double y : {0.0, 1.0, 2.0})
    for (const double x : {0.0, wide, 2.0 * wide}) grid.nodes.push_back({x + lean * y, y});
  for (const std::uint32_t a : {0u, 1u, 3u, 4u}) addElement(grid, std::array{a, a + 1, a + 4, a + 3});
  return grid;
}

// The halves of such a rectangle have 14 degrees, and a quality of 0.41.
TEST_F(PlotMesh, RectanglesAreOfTheBestColor) {
  constexpr std::uint32_t kBest = 0x2e7da8;
  const Grid rectangles = quadBoard(4.0, 0.0);
  for (const PlotColor color : {PlotColor::Angle, PlotColor::Quality}) {
    const std::set<std::uint32_t> found = colors(rectangles, color, 400);
    EXPECT_EQ(found.size(), 1u);
    EXPECT_TRUE(holds(found, kBest));
    Grid halves = rectangles;
    halves.quad_of.clear();
    EXPECT_FALSE(holds(colors(halves, color, 400), kBest));
  }
}

TEST_F(PlotMesh, HalvesOfALeaningQuadrilateralHaveTheColorOfItsAngle) {
  const double lean = 1.0;  // 45 and 135 degrees
  const Grid grid = quadBoard(3.0, lean);
  const auto is = [this, &grid](PlotColor color, double share) {
    const Color wanted = rampColor(share);
    const auto byte = [](double channel) { return static_cast<std::uint32_t>(std::lround(channel * 255.0)); };
    return holds({colorInTheMiddle(grid, color)}, byte(wanted.red) << 16 | byte(wanted.green) << 8 | byte(wanted.blue));
  };
  EXPECT_TRUE(is(PlotColor::Angle, 45.0 / 60.0));
  EXPECT_TRUE(is(PlotColor::Quality, (std::sqrt(0.5) - kLeastQuality) / (1.0 - kLeastQuality)));
}

// Whole quadrilaterals are red if an angle of theirs is too small, also on a globe.
TEST_F(PlotMesh, TooSmallAnglesOfQuadrilateralsAreRed) {
  constexpr std::uint32_t kRed = 0xe01a1a;
  PlotOptions options;
  options.color = PlotColor::None;
  options.edges = false;
  options.size_px = 400;
  const auto reds = [&](double lean, bool globe) {
    Grid grid = quadBoard(2.0, lean);
    options.min_angle_deg = 30.0;
    if (globe) {
      grid.crs = wgs84();
      plotGlobe(grid, options, GlobeView{.above = LonLat{2.0, 1.0}}, file("red.png"));
    } else {
      plotMesh(grid, options, file("red.png"));
    }
    const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> picture(
        cairo_image_surface_create_from_png(file("red.png").c_str()), cairo_surface_destroy);
    const unsigned char* const bytes = cairo_image_surface_get_data(picture.get());
    const int stride = cairo_image_surface_get_stride(picture.get());
    std::size_t count = 0;
    for (int y = 0; y < cairo_image_surface_get_height(picture.get()) - static_cast<int>(kStripPx); ++y)
      for (int x = 0; x < cairo_image_surface_get_width(picture.get()); ++x)
        count += holds({reinterpret_cast<const std::uint32_t*>(bytes + y * stride)[x] & 0xffffff}, kRed);
    return count;
  };
  for (const bool globe : {false, true}) {
    EXPECT_EQ(reds(0.0, globe), 0u) << globe;  // the halves have 27 degrees
    EXPECT_GT(reds(3.0, globe), 0u) << globe;  // 18 degrees
  }
}

// The inner nodes of a board have six neighbours; flipping the diagonal of one square takes one from two of its corners
// and adds one to the other two.
TEST_F(PlotMesh, DegreesAreDotsWhereNeighboursAreNotSix) {
  constexpr std::uint32_t kGreen = 0x0c9933, kOrange = 0xed730d, kPurple = 0x8c0d8c;
  Grid grid = board(8);
  const auto dots = [&](bool degrees) {
    const std::set<std::uint32_t> all = colors(grid, PlotColor::None, 400, degrees);
    return std::array{holds(all, kGreen), holds(all, kOrange), holds(all, kPurple)};
  };
  EXPECT_EQ(dots(true), (std::array{false, false, false}));
  auto& lower = grid.triangles[2 * (8 * 4 + 4)];
  auto& upper = grid.triangles[2 * (8 * 4 + 4) + 1];
  const std::uint32_t a = lower[0], b = lower[1], c = lower[2], d = upper[2];
  lower = {a, b, d};
  upper = {b, c, d};
  EXPECT_EQ(dots(true), (std::array{true, true, false}));
  EXPECT_EQ(dots(false), (std::array{false, false, false}));
  // A node inside a triangle has three neighbours.
  grid.nodes.push_back({(grid.nodes[a].x + grid.nodes[b].x + grid.nodes[d].x) / 3,
                        (grid.nodes[a].y + grid.nodes[b].y + grid.nodes[d].y) / 3});
  const auto e = static_cast<std::uint32_t>(grid.nodes.size() - 1);
  lower = {a, b, e};
  grid.triangles.push_back({b, d, e});
  grid.triangles.push_back({d, a, e});
  EXPECT_TRUE(dots(true)[2]);
}

// Two by two squares: of quadrilaterals the sides show, and not the diagonals, whichever corner is the first.
TEST_F(PlotMesh, SidesOfQuadrilateralsShowAndDiagonalsDoNot) {
  const auto edgesAt = [&](const Grid& grid) {
    PlotOptions options;
    options.color = PlotColor::None;
    options.size_px = 400;
    const auto picture = drawn(grid, options);
    const int x = cairo_image_surface_get_width(picture.get()) / 2;
    const int y = (cairo_image_surface_get_height(picture.get()) - static_cast<int>(kStripPx)) / 2;
    const int stride = cairo_image_surface_get_stride(picture.get());
    const auto at = [&](int dx, int dy) {
      const unsigned char* row = cairo_image_surface_get_data(picture.get()) + (y + dy) * stride;
      return reinterpret_cast<const std::uint32_t*>(row)[x + dx] & 0xffffff;
    };
    // A pixel beside the line, and two that are nearest to it.
    const auto isLine = [&](int dx, int dy) {
      const std::uint32_t water = at(60, 30);
      return at(dx, dy) != water || at(dx - 1, dy) != water || at(dx, dy - 1) != water;
    };
    std::array<bool, 5> found{isLine(0, -60), isLine(0, 60), isLine(-60, 0), isLine(60, 0), isLine(60, -60)};
    return found;
  };
  EXPECT_EQ(edgesAt(board(2)), (std::array{true, true, true, true, true}));
  for (std::size_t first = 0; first < 4; ++first) {
    Grid grid;
    grid.nodes = board(2).nodes;
    for (const std::uint32_t a : {0u, 1u, 3u, 4u}) {
      std::array<std::uint32_t, 4> nodes{a, a + 1, a + 4, a + 3};
      std::ranges::rotate(nodes, nodes.begin() + static_cast<std::ptrdiff_t>(first));
      addElement(grid, nodes);
    }
    EXPECT_EQ(edgesAt(grid), (std::array{true, true, true, true, false})) << first;
  }
}

TEST_F(PlotMesh, OpenBoundariesShow) {
  Grid grid = board(4);
  const std::set<std::uint32_t> without = colors(grid, PlotColor::None, 200);
  grid.boundaries.push_back({BoundaryRole::Open, false, {10, 11, 12, 13}});
  EXPECT_GT(colors(grid, PlotColor::None, 200).size(), without.size());
}

// Rivers, weirs and lines in the mesh have different colours.
TEST_F(PlotMesh, RiversWeirsAndLinesShow) {
  const Grid bare = board(4);
  Grid grid = bare;
  grid.boundaries = {{BoundaryRole::River, false, {16, 17, 18}}};
  grid.lines = {{LineKind::Weir, "", false, {6, 7, 8}}, {LineKind::Constraint, "", false, {11, 12, 13}}};
  constexpr std::uint32_t kRiverColor = 0x0078bf, kWeirColor = 0xbf4514, kLineColor = 0x6e3396;
  const auto shown = [&](const Grid& drawn) {
    const std::set<std::uint32_t> all = colors(drawn, PlotColor::None, 400);
    return std::array{holds(all, kRiverColor), holds(all, kWeirColor), holds(all, kLineColor)};
  };
  EXPECT_EQ(shown(bare), (std::array{false, false, false}));
  EXPECT_EQ(shown(grid), (std::array{true, true, true}));
  // In an ADCIRC file a weir is a boundary.
  grid = bare;
  grid.boundaries = {{BoundaryRole::Land, false, {6, 7, 8}, 24, {11, 12, 13}, false, {1, 1, 1, 1, 1, 1}}};
  EXPECT_EQ(shown(grid), (std::array{false, true, false}));
}

TEST_F(PlotMesh, VeryManyTrianglesMakeASmallVectorDrawing) {
  PlotOptions options;
  options.color = PlotColor::Size;
  options.size_px = 400;
  plotMesh(board(300), options, file("many.svg"));
  EXPECT_LT(fs::file_size(file("many.svg")), 3'000'000u);
  const std::string text = textOf("many.svg");
  EXPECT_NE(text.find("<image"), std::string::npos);
  EXPECT_NE(text.find("</svg>"), std::string::npos);
}

TEST(PlotColorNames, AreThoseOfTheColors) {
  EXPECT_EQ(plotColorNamed("depth"), PlotColor::Depth);
  EXPECT_EQ(plotColorNamed("none"), PlotColor::None);
  EXPECT_EQ(plotColorNamed("timestep"), PlotColor::TimeStep);
  EXPECT_THROW(plotColorNamed("pink"), OptionError);
}

}  // namespace

}  // namespace coastmesh
