#include "gis/geometry/chain_index.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

ChainIndex indexOf(const std::vector<Ring>& rings) {
  ChainIndex index(ChainIndex::Kind::Rings);
  for (const Ring& ring : rings) index.add(ring);
  index.build();
  return index;
}

// Textbook point location, edge by edge; exact for integer coordinates.
Location slowLocate(const std::vector<Ring>& rings, const Point& p) {
  bool inside = false;
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
      const double cross = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
      if (cross == 0 && Box::of(a, b).meets({p.x, p.y, p.x, p.y})) return Location::Boundary;
      if ((a.y <= p.y) != (b.y <= p.y) && (cross > 0) == (a.y < b.y)) inside = !inside;
    }
  }
  return inside ? Location::Inside : Location::Outside;
}

TEST(ChainIndex, LocatesInASquareWithAHole) {
  const ChainIndex index = indexOf({square(0, 0, 10), square(2, 2, 3)});
  EXPECT_EQ(index.locate({1, 1}), Location::Inside);
  EXPECT_EQ(index.locate({3, 3}), Location::Outside);
  EXPECT_EQ(index.locate({2, 3}), Location::Boundary);
  EXPECT_EQ(index.locate({10, 10}), Location::Boundary);
  EXPECT_EQ(index.locate({11, 5}), Location::Outside);
  EXPECT_EQ(index.locate({-1, 0}), Location::Outside);
  EXPECT_EQ(indexOf({}).locate({0, 0}), Location::Outside);
}

TEST(ChainIndex, LocatesAsTheTextbookDoes) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937_64 random(seed);
    std::vector<Ring> rings;
    for (int r = 0; r < 6; ++r) rings.push_back(gridRing(random, 3 + 17 * r, 12));
    const ChainIndex index = indexOf(rings);
    for (int x = -1; x <= 12; ++x) {
      for (int y = -1; y <= 12; ++y) {
        const Point p{static_cast<double>(x), static_cast<double>(y)};
        EXPECT_EQ(index.locate(p), slowLocate(rings, p)) << "seed " << seed << " at " << x << ", " << y;
      }
    }
  }
}

TEST(ChainIndex, TellsAPointOneStepFromAnEdge) {
  const ChainIndex index = indexOf({{{0, 0}, {3, 1}, {0, 1}}});
  const double y = 1.0 / 3;  // the double below a third
  EXPECT_EQ(index.locate({1, y}), Location::Outside);
  EXPECT_EQ(index.locate({1, std::nextafter(y, 1)}), Location::Inside);
}

TEST(SegmentsMeet, AllWaysOfTouching) {
  const Point a{0, 0}, b{4, 0};
  EXPECT_TRUE(segmentsMeet(a, b, {2, -1}, {2, 1}));  // crosses
  EXPECT_TRUE(segmentsMeet(a, b, {2, 0}, {2, 1}));   // ends on it
  EXPECT_TRUE(segmentsMeet(a, b, {4, 0}, {5, 5}));   // end to end
  EXPECT_TRUE(segmentsMeet(a, b, {1, 0}, {3, 0}));   // along it
  EXPECT_TRUE(segmentsMeet(a, b, {4, 0}, {9, 0}));   // end to end on a line
  EXPECT_FALSE(segmentsMeet(a, b, {5, 0}, {9, 0}));  // further on the line
  EXPECT_FALSE(segmentsMeet(a, b, {0, 1}, {4, 1}));  // beside
  EXPECT_FALSE(segmentsMeet(a, b, {2, 1e-300}, {2, 1}));
  EXPECT_FALSE(segmentsMeet(a, b, {5, -1}, {3.9, 2}));
}

TEST(ChainIndex, OpenLinesHaveNoClosingEdge) {
  ChainIndex index(ChainIndex::Kind::OpenLines);
  index.add(std::vector<Point>{{0, 0}, {1, 0}, {1, 1}});
  index.add(std::vector<Point>{{5, 5}});
  index.add(std::vector<Point>{{2, 2}, {3, 3}});
  index.build();
  EXPECT_EQ(index.edgeCount(), 3u);
  EXPECT_EQ(index.chainCount(), 2u);
  EXPECT_EQ(index.start(2), (Point{2, 2}));
  EXPECT_EQ(index.end(2), (Point{3, 3}));
}

}  // namespace
}  // namespace coastmesh
