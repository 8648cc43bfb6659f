#include "apps/plot/plot_legend.hpp"

#include <cairo.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/plot/plot_style.hpp"

namespace coastmesh {

namespace {

std::vector<LegendItem> fiveItems() {
  constexpr LegendItem::Mark kLine = LegendItem::Mark::Line, kDot = LegendItem::Mark::Dot;
  // Colours that pictures hold without rounding.
  return {{kLine, {1.0, 0.0, 0.0}, "open"},
          {kLine, {0.0, 1.0, 0.0}, "island"},
          {kLine, {0.0, 0.0, 1.0}, "land"},
          {kDot, {1.0, 0.0, 1.0}, "5 neighbours"},
          {kDot, {0.0, 1.0, 1.0}, "other"}};
}

constexpr Color kOfRamp{1.0, 1.0, 0.0};

std::uint32_t rgb(const Color& color) {
  const auto byte = [](double share) { return static_cast<std::uint32_t>(std::lround(share * 255.0)); };
  return byte(color.red) << 16 | byte(color.green) << 8 | byte(color.blue);
}

// The colours of the pixels that a legend draws below a map of this width and no height.
std::multiset<std::uint32_t> drawn(const PlotLegend& legend, double width, bool has_ramp) {
  std::string folder = (std::filesystem::temp_directory_path() / "coastmesh-legend-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no folder for the picture");
  const std::string path = folder + "/legend.png";
  PlotCanvas canvas(path, {0.0, 0.0}, {width, 1.0}, width, legend.height());
  canvas.fillRectangle({0.0, 0.0}, width, legend.height() + 1.0, kPaper);
  legend.drawItems(canvas);
  if (has_ramp) legend.drawRamp(canvas, {[](double) { return kOfRamp; }, "-1234 m", "12 m up"});
  canvas.finish();
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> picture(
      cairo_image_surface_create_from_png(path.c_str()), cairo_surface_destroy);
  std::filesystem::remove_all(folder);
  std::multiset<std::uint32_t> colors;
  for (int y = 0; y < cairo_image_surface_get_height(picture.get()); ++y) {
    const unsigned char* row =
        cairo_image_surface_get_data(picture.get()) + y * cairo_image_surface_get_stride(picture.get());
    for (int x = 0; x < cairo_image_surface_get_width(picture.get()); ++x)
      colors.insert(reinterpret_cast<const std::uint32_t*>(row)[x] & 0xffffff);
  }
  return colors;
}

}  // namespace

TEST(PlotLegend, NothingCoversAnythingElseHoweverNarrowThePicture) {
  for (const double width : {1600.0, 600.0, 400.0, 250.0, 140.0}) {
    const double left = 70.0;
    const PlotLegend all(width, left, fiveItems(), true);
    const std::multiset<std::uint32_t> together = drawn(all, width, true);
    // Whatever lay over another would leave less of it than it draws alone.
    const std::multiset<std::uint32_t> without_ramp = drawn(all, width, false);
    for (const LegendItem& item : fiveItems()) {
      EXPECT_GT(together.count(rgb(item.color)), 10u) << width << " " << item.name;
      EXPECT_EQ(together.count(rgb(item.color)), without_ramp.count(rgb(item.color))) << width << " " << item.name;
    }
    EXPECT_GE(static_cast<double>(together.count(rgb(kOfRamp))), 7.0 * std::min(kRampPx, width - 24.0)) << width;
  }
}

TEST(PlotLegend, AWidePictureHasOneRowAndANarrowOneMore) {
  EXPECT_EQ(PlotLegend(1600.0, 70.0, fiveItems(), true).height(), kStripPx);
  EXPECT_EQ(PlotLegend(400.0, 70.0, {}, true).height(), kStripPx);
  EXPECT_GE(PlotLegend(200.0, 70.0, {}, true).height(), 2.0 * kStripPx);
  EXPECT_GT(PlotLegend(200.0, 70.0, fiveItems(), true).height(), PlotLegend(200.0, 70.0, {}, true).height());
}

TEST(PlotLegend, NamesWiderThanThePictureAreLeftOut) {
  const PlotLegend legend(40.0, 30.0, fiveItems(), true);
  EXPECT_EQ(drawn(legend, 40.0, false).count(rgb(fiveItems().front().color)), 0u);
}

TEST(PlotLegend, LengthsAreRoundedToTwoDigits) {
  EXPECT_EQ(roundedLengthText(1234567.0, false), "1200 km");
  EXPECT_EQ(roundedLengthText(0.1234, false), "0.12 m");
  EXPECT_EQ(roundedLengthText(1987.0, true), "2000");
}

}  // namespace coastmesh
