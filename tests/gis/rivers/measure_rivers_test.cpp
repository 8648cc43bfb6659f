#include "gis/rivers/measure_rivers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/metric.hpp"
#include "gis/error.hpp"
#include "gis/rivers/lay_rivers.hpp"
#include "tests/gis/merge/merged.hpp"

namespace coastmesh {
namespace {

using ::testing::HasSubstr;

constexpr double kNoWidth = std::numeric_limits<double>::quiet_NaN();

RiverLine lineOf(std::vector<Point> points, double width = kNoWidth) {
  RiverLine line;
  line.points = std::move(points);
  line.width_m = width;
  line.name = "R";
  line.source = "rivers";
  return line;
}

using Curve = std::function<double(double x)>;

// The banks of a river along x, `half(x)` to both sides of `middle(x)`.
void addBanks(RiverBanks& banks, double from, double to, const Curve& middle, const Curve& half) {
  std::vector<Point> ring;
  constexpr int kEdges = 400;
  for (int i = 0; i <= kEdges; ++i) {
    const double x = from + (to - from) * i / kEdges;
    ring.push_back({x, middle(x) - half(x)});
  }
  for (int i = kEdges; i >= 0; --i) {
    const double x = from + (to - from) * i / kEdges;
    ring.push_back({x, middle(x) + half(x)});
  }
  for (std::size_t i = 0; i < ring.size(); ++i) banks.edges.emplace_back(ring[i], ring[(i + 1) % ring.size()]);
}

double straight(double) { return 0.0; }
Curve constant(double value) {
  return [value](double) { return value; };
}

TEST(MeasureRivers, ALineGoesToTheMiddleOfItsBanks) {
  RiverBanks banks;
  addBanks(banks, 0, 5000, straight, constant(50.0));
  const MeasuredRivers measured = measureRivers({lineOf({{0, 20}, {5000, 20}})}, banks, {});
  ASSERT_EQ(measured.lines.size(), 1u);
  const RiverLine& line = measured.lines[0];
  ASSERT_EQ(line.widths_m.size(), line.points.size());
  EXPECT_NEAR(line.width_m, 100.0, 1e-6);
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    EXPECT_NEAR(line.points[i].y, 0.0, 1e-6);
    EXPECT_NEAR(line.widths_m[i], 100.0, 1e-6);
  }
  EXPECT_EQ(line.name, "R");
  EXPECT_NEAR(measured.length_m, 5000.0, 1e-6);
  EXPECT_NEAR(measured.measured_m, 5000.0, 100.0);  // an end of the line is on the edge
  EXPECT_NEAR(measured.least_width_m, 100.0, 1e-6);
}

TEST(MeasureRivers, WidthsFollowTheBanksInPartsOfAlikeWidths) {
  const Curve middle = [](double x) { return 300.0 * std::sin(x / 1500.0); };
  const Curve half = [](double x) { return 20.0 + 0.01 * x; };  // 40 m to 440 m wide
  RiverBanks banks;
  addBanks(banks, 0, 20000, middle, half);
  std::vector<Point> drawn;
  for (double x = 0.0; x <= 20000.0; x += 100.0) drawn.push_back({x, middle(x) + 0.5 * half(x) * std::sin(x / 700.0)});
  const MeasuredRivers measured = measureRivers({lineOf(drawn)}, banks, {});
  EXPECT_GT(measured.lines.size(), 3u);
  EXPECT_LT(measured.lines.size(), 8u);
  Point end = measured.lines[0].points.front();
  for (const RiverLine& line : measured.lines) {
    EXPECT_EQ(line.points.front(), end);
    end = line.points.back();
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const Point& p = line.points[i];
      if (p.x < 300.0 || p.x > 19000.0) continue;  // beside the ends, lines across the river meet the ends
      const double slope = 0.2 * std::cos(p.x / 1500.0), across = 2.0 * half(p.x) / std::sqrt(1.0 + slope * slope);
      EXPECT_NEAR(line.widths_m[i], across, 0.06 * across) << p.x;
      EXPECT_NEAR(p.y, middle(p.x), 0.06 * half(p.x)) << p.x;
      EXPECT_LT(line.widths_m[i], 1.6 * line.width_m);
      EXPECT_GT(line.widths_m[i], line.width_m / 1.6);
    }
  }
}

TEST(MeasureRivers, MouthsAndOtherWaterWidenNothing) {
  RiverBanks banks;
  addBanks(banks, 0, 4000, straight, constant(100.0));
  // A tributary from the north, 60 m wide: its mouth opens the bank between x = 1970 and 2030.
  const auto cut = std::ranges::remove_if(banks.edges, [](const auto& edge) {
    return edge.first.y > 0.0 && std::min(edge.first.x, edge.second.x) > 1965.0 &&
           std::max(edge.first.x, edge.second.x) < 2035.0;
  });
  banks.edges.erase(cut.begin(), cut.end());
  const std::vector<Point> bank{{1970, 100}, {1970, 3000}, {2030, 3000}, {2030, 100}};
  for (std::size_t i = 0; i + 1 < bank.size(); ++i) banks.edges.emplace_back(bank[i], bank[i + 1]);
  const MeasuredRivers measured =
      measureRivers({lineOf({{0, 0}, {4000, 0}}), lineOf({{2000, 3000}, {2000, 0}})}, banks, {});
  ASSERT_EQ(measured.lines.size(), 2u);
  for (const double width : measured.lines[0].widths_m) EXPECT_NEAR(width, 200.0, 1.0);
  for (const double width : measured.lines[1].widths_m) EXPECT_NEAR(width, 60.0, 1.0);
  for (const Point& p : measured.lines[0].points) EXPECT_NEAR(p.y, 0.0, 1.0);
  for (const Point& p : measured.lines[1].points) EXPECT_NEAR(p.x, 2000.0, 1.0);
}

TEST(MeasureRivers, BeyondTheBanksLinesKeepTheirWidthOrThatAtTheBanks) {
  RiverBanks banks;
  addBanks(banks, 0, 2000, straight, constant(50.0));
  for (const double given : {kNoWidth, 60.0}) {
    const MeasuredRivers measured = measureRivers({lineOf({{0, 0}, {4000, 0}}, given)}, banks, {});
    double last = 0.0;
    for (const RiverLine& line : measured.lines) last = line.widths_m.back();
    EXPECT_NEAR(last, std::isnan(given) ? 100.0 : 60.0, 1e-6);
    EXPECT_NEAR(measured.measured_m, 2000.0, 60.0);
    EXPECT_EQ(measured.without, 0u);
  }
  const MeasuredRivers away = measureRivers({lineOf({{0, 900}, {4000, 900}}, 60.0)}, banks, {});
  EXPECT_EQ(away.without, 1u);
  ASSERT_EQ(away.lines.size(), 1u);
  EXPECT_EQ(away.lines[0].points.size(), 2u);
  EXPECT_EQ(away.measured_m, 0.0);
  try {
    measureRivers({lineOf({{0, 900}, {4000, 900}})}, banks, {});
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'R' has no width, and no part of it is between banks: near (0, 900)"));
  }
}

TEST(MeasureRivers, ALineBesideTheWaterCountsAsInIt) {
  RiverBanks banks;
  addBanks(banks, 0, 4000, straight, constant(50.0));
  const MeasuredRivers measured = measureRivers({lineOf({{0, 70}, {4000, 70}}, 80.0)}, banks, {});
  ASSERT_EQ(measured.lines.size(), 1u);
  for (std::size_t i = 4; i + 4 < measured.lines[0].points.size(); ++i) {
    EXPECT_NEAR(measured.lines[0].points[i].y, 0.0, 1e-6);
    EXPECT_NEAR(measured.lines[0].widths_m[i], 100.0, 1e-6);
  }
}

TEST(MeasureRivers, RowsReachTheBanks) {
  const Curve middle = [](double x) { return 2050.0 + 200.0 * std::sin(x / 800.0); };
  const Curve half = [](double x) { return 60.0 + 20.0 * std::sin(x / 500.0); };
  RiverBanks banks;
  addBanks(banks, -6000, 500, middle, half);
  std::vector<Point> drawn;
  for (double x = -6000.0; x <= 500.0; x += 50.0) drawn.push_back({x, middle(x) + 15.0 * std::sin(x / 300.0)});
  const MeasuredRivers measured = measureRivers({lineOf(drawn)}, banks, {});
  const LaidRivers laid = layRivers(measured.lines, testing::gridOf({20, 20, 200.0}), {});
  ASSERT_EQ(laid.report.reaches, 1u);
  EXPECT_EQ(laid.grid.features.size(), 1u);
  std::size_t on_banks = 0;
  for (const Boundary& boundary : laid.grid.boundaries) {
    if (boundary.role == BoundaryRole::River) continue;
    for (const std::uint32_t node : boundary.nodes) {
      const Point& p = laid.grid.nodes[node];
      if (p.x < -5800.0 || p.x > -100.0) continue;
      double gap = std::numeric_limits<double>::infinity();
      for (const auto& [a, b] : banks.edges) gap = std::min(gap, squaredDistanceToSegment(p, a, b));
      EXPECT_LT(std::sqrt(gap), 4.0) << p.x << " " << p.y;
      ++on_banks;
    }
  }
  EXPECT_GT(on_banks, 40u);
}

}  // namespace
}  // namespace coastmesh
