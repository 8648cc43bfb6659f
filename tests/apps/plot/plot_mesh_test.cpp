#include "apps/plot/plot_mesh.hpp"

#include <cairo.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <set>

#include "apps/usage/command_line.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

namespace fs = std::filesystem;

class PlotMesh : public testing::Test {
 protected:
  PlotMesh() {
    std::string name = (fs::temp_directory_path() / "coastmesh-plot-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~PlotMesh() override { fs::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  // `n` by `n` squares of two triangles each, side by side; in a plane.
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

  // The colours of all pixels of the map, each as 0xRRGGBB.
  std::set<std::uint32_t> colors(const Grid& grid, PlotColor color, std::uint64_t size) {
    PlotOptions options;
    options.color = color;
    options.size_px = size;
    options.edges = false;
    plotMesh(grid, options, file("a.png"));
    const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> picture(
        cairo_image_surface_create_from_png(file("a.png").c_str()), cairo_surface_destroy);
    const int stride = cairo_image_surface_get_stride(picture.get());
    std::set<std::uint32_t> found;
    const int margin = static_cast<int>(size / 10);
    for (int y = margin; y < static_cast<int>(size) - margin; ++y) {
      const unsigned char* row = cairo_image_surface_get_data(picture.get()) + y * stride;
      for (int x = margin; x < static_cast<int>(size) - margin; ++x) {
        found.insert(reinterpret_cast<const std::uint32_t*>(row)[x] & 0xffffff);
      }
    }
    return found;
  }

  fs::path folder_;
};

TEST_F(PlotMesh, TrianglesCoverEveryPixelOnceWhateverTheirSize) {
  // All triangles are alike: one colour and no gap, for large ones and for those smaller than a pixel.
  for (std::uint32_t n : {1u, 7u, 40u, 300u}) {
    EXPECT_EQ(colors(board(n), PlotColor::Angle, 200).size(), 1u) << n;
  }
}

TEST_F(PlotMesh, PartsOfOneFeatureThatDoNotTouchDifferInColor) {
  Grid grid = board(4);
  EXPECT_EQ(colors(grid, PlotColor::Region, 200).size(), 1u);
  // Two features, the left half and the right: two colours and the border's.
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

TEST_F(PlotMesh, OpenBoundariesShow) {
  Grid grid = board(4);
  const std::set<std::uint32_t> without = colors(grid, PlotColor::None, 200);
  grid.boundaries.push_back({BoundaryRole::Open, false, {10, 11, 12, 13}});
  EXPECT_GT(colors(grid, PlotColor::None, 200).size(), without.size());
}

TEST_F(PlotMesh, VeryManyTrianglesMakeASmallVectorDrawing) {
  PlotOptions options;
  options.color = PlotColor::Size;
  options.size_px = 400;
  plotMesh(board(300), options, file("many.svg"));
  EXPECT_LT(fs::file_size(file("many.svg")), 3'000'000u);
  std::ifstream stream(file("many.svg"));
  const std::string text((std::istreambuf_iterator<char>(stream)), {});
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
