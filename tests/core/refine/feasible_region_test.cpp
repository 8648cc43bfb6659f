#include "core/refine/feasible_region.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/quality.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

constexpr double kNoSize = std::numeric_limits<double>::infinity();

// The bounds, independent of the code under test.
struct Asked {
  double min_angle_deg;
  double max_angle_deg;
  double size_max;
  TriangleBound bound() const { return {min_angle_deg, max_angle_deg, size_max}; }
};

// The margin by which a point satisfies the bounds in all triangles of the star: the smallest over angles, in degrees,
// and over lengths, also in degrees, at one per hundredth of the size. The largest angle at the point itself is not
// bounded.
double roomAt(const Point& at, const std::vector<LinkEdge>& link, const Asked& asked) {
  double room = 180.0;
  for (const LinkEdge& e : link) {
    if (signedArea(e.x, e.y, at) <= 0.0) return -180.0;
    const auto angles = anglesDeg(e.x, e.y, at);
    room =
        std::min({room, angles[0] - asked.min_angle_deg, angles[1] - asked.min_angle_deg,
                  angles[2] - asked.min_angle_deg, asked.max_angle_deg - angles[0], asked.max_angle_deg - angles[1]});
    if (!std::isinf(asked.size_max)) {
      const double longest = std::max(distance(at, e.x), distance(at, e.y));
      room = std::min(room, 100.0 * (1.0 - longest / asked.size_max));
    }
  }
  return room;
}

// The link of a vertex near `centre`, with corners in all directions at various distances.
std::vector<LinkEdge> randomLink(std::mt19937_64& random, const Point& centre, double size) {
  const int n = 4 + static_cast<int>(random() % 5);
  const double nearest = uniform(random, 0.2, 1.0);
  std::vector<Point> corners;
  for (int i = 0; i < n; ++i) {
    const double at = toRadians(360.0 * (i + uniform(random, 0.0, 0.6)) / n);
    corners.push_back(centre + size * uniform(random, nearest, 1.2) * Point{std::cos(at), std::sin(at)});
  }
  std::vector<LinkEdge> link;
  for (int i = 0; i < n; ++i) link.push_back({corners[i], corners[(i + 1) % n]});
  return link;
}

// The largest margin at any point of a grid over the link.
double bestOfSamples(const std::vector<LinkEdge>& link, const Asked& asked, int cells) {
  Point low{kNoSize, kNoSize}, high{-kNoSize, -kNoSize};
  for (const LinkEdge& e : link) {
    low = {std::min(low.x, e.x.x), std::min(low.y, e.x.y)};
    high = {std::max(high.x, e.x.x), std::max(high.y, e.x.y)};
  }
  double best = -180.0;
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= cells; ++j)
      best = std::max(
          best, roomAt({low.x + (high.x - low.x) * i / cells, low.y + (high.y - low.y) * j / cells}, link, asked));
  return best;
}

class FeasibleRegionAt : public ::testing::TestWithParam<Asked> {};

void PrintTo(const Asked& asked, std::ostream* out) {
  *out << asked.min_angle_deg << " to " << asked.max_angle_deg << " degrees, size " << asked.size_max;
}

// Against sampling: a point that is found satisfies the bounds; if a sample has a clear margin, a point is found.
TEST_P(FeasibleRegionAt, AgreesWithSampling) {
  const Asked asked = GetParam();
  FeasibleRegion region(asked.bound());
  int found = 0, empty = 0, roomy = 0;
  for (unsigned seed = 1; seed <= 80; ++seed) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const auto link = randomLink(random, {}, 1.0);
    const auto place = region.findPoint(link);
    if (place) {
      EXPECT_GE(roomAt(*place, link, asked), 0.0) << place->x << ", " << place->y;
    }
    constexpr double kRoomDeg = 0.5;
    const bool sampled = bestOfSamples(link, asked, 40) > kRoomDeg;
    EXPECT_TRUE(place || !sampled);
    found += place.has_value();
    empty += !place;
    roomy += sampled;
  }
  // Both outcomes must occur, or the test proves little.
  EXPECT_GT(roomy, 3);
  EXPECT_GE(found, roomy);
  EXPECT_GT(empty, 0);
}

TEST_P(FeasibleRegionAt, BetweenTwoPointsAgreesWithSampling) {
  const Asked asked = GetParam();
  int found = 0, empty = 0;
  for (unsigned seed = 1; seed <= 120; ++seed) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    std::mt19937_64 random(1000 + seed);
    // A point between two corners of the link, as on a segment; in every other case only one half of the link.
    auto link = randomLink(random, {}, 1.0);
    const Point a = link[0].x, b = link[link.size() / 2].x;
    if (seed % 2 == 0) link.resize(link.size() / 2);
    const auto place = FeasibleRegion(asked.bound()).findPointBetween(a, b, link);
    double best = -180.0, low = 2.0, high = -1.0;
    for (int i = 1; i < 600; ++i) {
      const double share = i / 600.0, room = roomAt(a + share * (b - a), link, asked);
      best = std::max(best, room);
      if (room < 0.0) continue;
      low = std::min(low, share);
      high = std::max(high, share);
    }
    EXPECT_TRUE(place || best <= 0.1);
    found += place.has_value();
    empty += !place;
    // Edge by edge in another order the same is left; what one edge rules out is ruled out.
    LinePart part(a, b);
    for (auto e = link.rbegin(); e != link.rend(); ++e)
      if (!FeasibleRegion(asked.bound()).cut(part, *e)) break;
    EXPECT_EQ(part.isEmpty(), !place);
    if (!place) continue;
    EXPECT_LT(distance(a + 0.5 * (part.low + part.high) * (b - a), *place), 1e-12);
    const double share = dot(*place - a, b - a) / squaredDistance(a, b);
    EXPECT_GE(roomAt(*place, link, asked), -1e-9);
    EXPECT_NEAR(cross(*place - a, b - a), 0.0, 1e-12);
    if (low < high) {
      EXPECT_NEAR(share, 0.5 * (low + high), 2e-3) << "in the middle of what is feasible";
    }
  }
  EXPECT_GT(found, 3);
  EXPECT_GT(empty, 3);
}

INSTANTIATE_TEST_SUITE_P(Bounds, FeasibleRegionAt,
                         ::testing::Values(Asked{20, 180, kNoSize}, Asked{30, 180, kNoSize}, Asked{34, 180, kNoSize},
                                           Asked{25, 100, kNoSize}, Asked{30, 85, kNoSize}, Asked{20, 180, 1.1},
                                           Asked{25, 95, 1.2}));

TEST(FeasibleRegion, RegularLinkHasItsCentre) {
  std::vector<LinkEdge> link;
  const auto corner = [](int i) { return Point{std::cos(toRadians(60.0 * i)), std::sin(toRadians(60.0 * i))}; };
  for (int i = 0; i < 6; ++i) link.push_back({corner(i), corner(i + 1)});
  for (const double angle : {0.0, 30.0, 45.0, 59.0}) {
    const auto place = FeasibleRegion(TriangleBound(angle, 180.0, kNoSize)).findPoint(link);
    ASSERT_TRUE(place) << angle;
    EXPECT_GE(roomAt(*place, link, {angle, 180.0, kNoSize}), 0.0);
  }
  EXPECT_FALSE(FeasibleRegion(TriangleBound(60.5, 180.0, kNoSize)).findPoint(link));
  EXPECT_FALSE(FeasibleRegion(TriangleBound(30.0, 180.0, 0.9)).findPoint(link));
}

TEST(FeasibleRegion, WithoutAnAngleTheKernelOfTheLink) {
  // An L-shaped link: its kernel is the square at the corner.
  const std::vector<Point> corners{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  std::vector<LinkEdge> link;
  for (std::size_t i = 0; i < corners.size(); ++i) link.push_back({corners[i], corners[(i + 1) % corners.size()]});
  const auto place = FeasibleRegion(TriangleBound(0.0, 180.0, kNoSize)).findPoint(link);
  ASSERT_TRUE(place);
  EXPECT_GT(place->x, 0.0);
  EXPECT_LT(place->x, 1.0);
  EXPECT_GT(place->y, 0.0);
  EXPECT_LT(place->y, 1.0);
}

TEST(FeasibleRegion, SizeAndPlaceDoNotMatter) {
  for (const double size : {1e-9, 1.0, 1e9}) {
    for (const double far : {0.0, 1e5}) {
      int found = 0;
      for (unsigned seed = 1; seed <= 60; ++seed) {
        std::mt19937_64 random(seed);
        const auto link = randomLink(random, {far * size, -2.0 * far * size}, size);
        const auto place = FeasibleRegion(TriangleBound(25.0, 180.0, kNoSize)).findPoint(link);
        if (!place) continue;
        ++found;
        EXPECT_GE(roomAt(*place, link, {25.0, 180.0, kNoSize}), -1e-6) << "seed " << seed << ", size " << size;
      }
      EXPECT_GT(found, 5);
    }
  }
}

TEST(FeasibleRegion, ALookFindsAPlaceOrThatThereIsNone) {
  constexpr double kLong = 1e6;  // never reached; with it, findPoint does not use `look`, which has no sizes
  int empty = 0, found = 0;
  for (unsigned seed = 1; seed <= 2000; ++seed) {
    std::mt19937_64 random(seed);
    const auto link = randomLink(random, {3.0, -2.0}, 1.0);
    const double angle = uniform(random, 5.0, 45.0);
    const Asked asked{angle, 180.0, kNoSize};
    const auto place = FeasibleRegion(TriangleBound(angle, 180.0, kLong)).findPoint(link);
    const FeasibleRegion::Look look = FeasibleRegion(TriangleBound(angle, 180.0, kNoSize)).look(link);
    EXPECT_FALSE(look.is_empty && look.point);
    if (look.point) {
      EXPECT_GE(roomAt(*look.point, link, asked), -1e-9) << "seed " << seed;
    }
    if (look.is_empty && place) {
      EXPECT_LT(roomAt(*place, link, asked), 1e-6) << "seed " << seed;
    }
    empty += look.is_empty;
    found += look.point.has_value();
    EXPECT_TRUE(!place || look.point || roomAt(*place, link, asked) < 1e-3) << "seed " << seed;
  }
  EXPECT_GT(empty, 100);
  EXPECT_GT(found, 100);
}

TEST(FeasibleRegion, ALookAtPartOfALinkRulesOutTheWhole) {
  int empty = 0;
  for (unsigned seed = 1; seed <= 500; ++seed) {
    std::mt19937_64 random(seed);
    auto link = randomLink(random, {3.0, -2.0}, 1.0);
    FeasibleRegion region(TriangleBound(uniform(random, 20.0, 45.0), 180.0, kNoSize));
    const bool whole_has_place = region.look(link).point.has_value();
    link.resize(link.size() - 2);
    if (!region.look(link).is_empty) continue;
    ++empty;
    EXPECT_FALSE(whole_has_place) << "seed " << seed;
  }
  EXPECT_GT(empty, 20);
}

}  // namespace
}  // namespace coastmesh
