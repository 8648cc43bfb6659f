#include "gis/format/poly_io.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "gis/clean/clean.hpp"
#include "gis/error.hpp"
#include "gis/grid/hole_points.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

class PolyIo : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("coastmesh-poly-") + info->name() + "-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    const auto path = folder_ / name;
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  void expectRefused(const std::string& text, const std::string& why) const {
    const std::string file = write("bad.poly", text);
    try {
      readPoly(file);
      ADD_FAILURE() << "read: " << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("bad.poly"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(PolyIo, ReadsWhatTriangleReads) {
  const Pslg pslg = readPoly(write("a.poly", R"(# a box with a hole
4 2 1 1   # vertices, dimensions, attributes, markers
1 0 0     3.5 1
2 10 0    3.5 1

3 1e1 10  3.5 1
4 0 +10   3.5 0
4 1
1 1 2 5
2 2 3
3 3 4 -7
4 4 1 0
1
1 5 5.25
1   # regions
1 1 1 17 0.5
)"));
  ASSERT_EQ(pslg.points.size(), 4u);
  EXPECT_EQ(pslg.points[3], (Point{0, 10}));
  ASSERT_EQ(pslg.segments.size(), 4u);
  EXPECT_EQ(pslg.segments[0].a, 0u);
  EXPECT_EQ(pslg.segments[3].b, 0u);
  EXPECT_EQ(pslg.segments[0].tag, 5);
  EXPECT_EQ(pslg.segments[1].tag, 0);
  EXPECT_EQ(pslg.segments[2].tag, -7);
  EXPECT_EQ(pslg.segments[0].left, kUnlabelled);
  ASSERT_EQ(pslg.holes.size(), 1u);
  EXPECT_EQ(pslg.holes[0], (Point{5, 5.25}));
}

TEST_F(PolyIo, ReadsVerticesFromTheNodeFileAndNumbersFromZero) {
  write("b.node", "3 2 0 0\r\n0 0 0\r\n1 1 0\r\n2 0 1\r\n");
  const Pslg pslg = readPoly(write("b.poly", "0 2 0 0\n3 0\n0 0 1\n1 1 2\n2 2 0\n"));
  EXPECT_EQ(pslg.points, (std::vector<Point>{{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_EQ(pslg.segments.size(), 3u);
  EXPECT_TRUE(pslg.holes.empty());
  expectRefused("0 2 0 0\n0 0\n0\n", "bad.node");
}

TEST_F(PolyIo, NamesTheLineOfWhatIsWrong) {
  expectRefused("", "empty");
  expectRefused("no poly\n", "line 1");
  expectRefused("3 3 0 0\n", "line 1");
  expectRefused("-1 2 0 0\n", "line 1");
  expectRefused("2 2 0 0\n1 0 0\n1 1 1\n0 0\n0\n", "1");
  expectRefused("2 2 0 0\n1 0 0\n2 nan 1\n0 0\n0\n", "line 3");
  expectRefused("2 2 0 0\n1 0 0\n2 1\n0 0\n0\n", "line 3");
  expectRefused("2 2 0 0\n1 0 0\n2 1 1\n1 0\n1 1 3\n0\n", "line 5");
  expectRefused("2 2 0 0\n1 0 0\n2 1 1\n1 1\n1 1 2 99999999999\n0\n", "line 5");
  expectRefused("2 2 0 0\n1 0 0\n", "ends too early");
  expectRefused("2 2 0 0\n1 0 0\n2 1 1\n1 0\n1 1 2\n1\n", "ends too early");
}

TEST_F(PolyIo, WhatIsWrittenComesBackBitForBit) {
  std::mt19937_64 random(7);
  Pslg pslg;
  pslg.points = tangledRing(random, 100);
  pslg.points.push_back({1.0 / 3, -1e-310});
  pslg.points.push_back({1e70, -0.1});
  for (VertexId v = 1; v < pslg.points.size(); ++v) {
    pslg.segments.push_back({v - 1, v, static_cast<std::int32_t>(v) - 50, kUnlabelled, kUnlabelled});
  }
  pslg.holes = {{0.1, 0.2}, {0.3, 1.0 / 7}};
  writePoly(pslg, path("c.poly"));
  const Pslg back = readPoly(path("c.poly"));
  EXPECT_EQ(back.points, pslg.points);
  EXPECT_EQ(back.holes, pslg.holes);
  ASSERT_EQ(back.segments.size(), pslg.segments.size());
  for (std::size_t i = 0; i < pslg.segments.size(); ++i) {
    EXPECT_EQ(back.segments[i].a, pslg.segments[i].a);
    EXPECT_EQ(back.segments[i].b, pslg.segments[i].b);
    EXPECT_EQ(back.segments[i].tag, pslg.segments[i].tag);
  }
}

TEST_F(PolyIo, LabelsBecomeHolePoints) {
  // Two islands, and a lake on one of them, which is a feature of its own.
  std::mt19937_64 random(3);
  const Ring island = starRing(random, {5, 5}, 2, 40);
  const Coastline coastline = coastlineOf(
      {polygonFeature(1, square(0, 0, 20), {island, square(10, 10, 4)}), polygonFeature(2, square(11, 11, 1))});
  CleanReport report;
  const Domain domain = cleanFeatures(coastline, {0, 1}, Projection::plane(), {.snap_m = 0}, report);
  writePoly(domain.pslg, path("d.poly"));
  const Pslg back = readPoly(path("d.poly"));
  ASSERT_EQ(back.holes.size(), 2u);
  const auto inside = [](const Ring& ring, const Point& p) {
    bool in = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if ((a.y <= p.y) != (b.y <= p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) in = !in;
    }
    return in;
  };
  for (const Point& hole : back.holes) {
    EXPECT_TRUE(inside(island, hole) || (inside(square(10, 10, 4), hole) && !inside(square(11, 11, 1), hole)));
  }
  EXPECT_NE(inside(island, back.holes[0]), inside(island, back.holes[1]));
}

TEST_F(PolyIo, RefusesWhereItCannotWrite) {
  EXPECT_THROW(writePoly(Pslg{}, path("no/such/folder/e.poly")), OutputError);
  EXPECT_THROW(readPoly(path("missing.poly")), InputError);
}

TEST_F(PolyIo, CoordinatesBeyondTheRangeAreRefusedWithTheirLine) {
  expectRefused("3 2 0 0\n1 0 0\n2 1e160 0\n3 0 1\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n", "line 3");
  expectRefused("3 2 0 0\n1 0 0\n2 1 -1e71\n3 0 1\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n", "beyond");
  expectRefused("3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n3 0\n1 1 2\n2 2 3\n3 3 1\n1\n1 0 1e300\n", "line 10");
}

}  // namespace
}  // namespace coastmesh
