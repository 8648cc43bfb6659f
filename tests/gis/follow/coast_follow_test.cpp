#include "gis/follow/coast_follow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

#include "core/delaunay.hpp"
#include "core/metric.hpp"
#include "core/refine/refine.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/size/node_sizes.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/pslgs.hpp"
#include "tests/support/size_figures.hpp"

namespace coastmesh {
namespace {

Coastline oneFeature() {
  Coastline coast;
  coast.features.emplace_back();
  return coast;
}

void addRing(Domain& domain, const Point& centre, double radius, int points, bool is_island, double wiggle = 0.0) {
  const auto first = static_cast<VertexId>(domain.pslg.points.size());
  const auto count = static_cast<VertexId>(points);
  for (VertexId i = 0; i < count; ++i) {
    const double angle = 6.283185307179586 * i / points, r = radius * (1.0 + (i % 2 ? wiggle : 0.0));
    domain.pslg.points.push_back(centre + Point{r * std::cos(angle), r * std::sin(angle)});
    Segment s{first + i, first + (i + 1) % count, 0, 0, kOutside};
    if (is_island) std::swap(s.left, s.right);
    domain.pslg.segments.push_back(s);
  }
  domain.input_points = domain.pslg.points;
}

std::size_t countOf(const CleanReport& report, EditKind kind) { return report.counts[static_cast<std::size_t>(kind)]; }

// A ring of shore round water, counter-clockwise, or round an island, clockwise.
void addShore(Domain& domain, const std::vector<Point>& ring) {
  const auto first = static_cast<VertexId>(domain.pslg.points.size()), count = static_cast<VertexId>(ring.size());
  for (VertexId i = 0; i < count; ++i) {
    domain.pslg.points.push_back(ring[i]);
    domain.pslg.segments.push_back({first + i, first + (i + 1) % count, 0, 0, kOutside});
  }
  domain.input_points = domain.pslg.points;
}

// Two square lakes of side 20 with a channel between them, 10 long and so wide.
Domain twoLakes(double width) {
  const double low = 10.0 - width / 2, high = 10.0 + width / 2;
  Domain domain;
  addShore(domain, {{0, 0},
                    {20, 0},
                    {20, low},
                    {30, low},
                    {30, 0},
                    {50, 0},
                    {50, 20},
                    {30, 20},
                    {30, high},
                    {20, high},
                    {20, 20},
                    {0, 20}});
  return domain;
}

double areaOf(const Domain& domain) {
  double area = 0.0;
  for (const Segment& s : domain.pslg.segments) {
    const Point &a = domain.pslg.points[s.a], &b = domain.pslg.points[s.b];
    if (s.left >= 0) area += 0.5 * cross(a, b);
    if (s.right >= 0) area -= 0.5 * cross(a, b);
  }
  return area;
}

std::size_t parts(const Domain& domain) {
  const TriMesh mesh = constrainedDelaunay(domain.pslg);
  std::vector<bool> seen(mesh.triangles.size(), false);
  std::size_t count = 0;
  for (TriId t = 0; t < seen.size(); ++t) {
    if (seen[t]) continue;
    ++count;
    std::vector<TriId> stack{t};
    seen[t] = true;
    while (!stack.empty()) {
      const TriId at = stack.back();
      stack.pop_back();
      for (const EdgeRef e : mesh.triangles[at].adj) {
        if (e == kNone || seen[triOf(e)]) continue;
        seen[triOf(e)] = true;
        stack.push_back(triOf(e));
      }
    }
  }
  return count;
}

// The least distance of two segments that share no vertex.
double leastApart(const Domain& domain) {
  double least = 1e300;
  for (const Segment& s : domain.pslg.segments) {
    for (VertexId v = 0; v < domain.pslg.points.size(); ++v) {
      if (v == s.a || v == s.b) continue;
      least = std::min(
          least, squaredDistanceToSegment(domain.pslg.points[v], domain.pslg.points[s.a], domain.pslg.points[s.b]));
    }
  }
  return std::sqrt(least);
}

double farthestFrom(const std::vector<Point>& before, const Domain& after) {
  double farthest = 0.0;
  for (const Point& p : before) {
    double least = 1e300;
    for (const Segment& s : after.pslg.segments)
      least = std::min(least, squaredDistanceToSegment(p, after.pslg.points[s.a], after.pslg.points[s.b]));
    farthest = std::max(farthest, std::sqrt(least));
  }
  return farthest;
}

TEST(FollowSizes, CoarseWhereElementsAreLarge) {
  Domain domain;
  addRing(domain, {0.0, 0.0}, 10.0, 2000, false, 0.003);
  const SizeOf size(0.02, 5.0, [](const Point& p) { return p.x < 0.0 ? 2.0 : 0.02; });
  CleanReport report;
  const std::vector<Point> before = domain.pslg.points;
  const Domain coarse = followSizes(std::move(domain), size, {}, oneFeature(), report);
  std::size_t fine = 0, rough = 0;
  for (const Point& p : coarse.pslg.points) ++(p.x < 0.0 ? rough : fine);
  EXPECT_GT(fine, 800u);
  EXPECT_LT(rough, 40u);
  EXPECT_GT(countOf(report, EditKind::SimplifiedPoint), 900u);
  EXPECT_LE(farthestFrom(before, coarse), 0.45 * 2.0 + 1e-9);
  EXPECT_NO_THROW(constrainedDelaunay(coarse.pslg));
}

TEST(FollowSizes, ARoughShoreGetsNoSegmentsMuchShorterThanTheSizeAndKeepsApart) {
  Domain domain;
  std::vector<Point> ring;
  for (int i = 0; i < 3000; ++i) {
    const double angle = 6.283185307179586 * i / 3000.0;
    const double r =
        100.0 + 6.0 * std::sin(22.0 * angle) + 3.0 * std::sin(74.0 * angle + 1.0) + std::sin(280.0 * angle);
    ring.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  addShore(domain, ring);
  const double area = areaOf(domain);
  const std::size_t points = domain.pslg.points.size();
  constexpr double kSize = 4.0;
  CleanReport report;
  const Domain coarse = followSizes(std::move(domain), ConstantSize(kSize), {}, oneFeature(), report);
  for (const Segment& s : coarse.pslg.segments) {
    const double length = distance(coarse.pslg.points[s.a], coarse.pslg.points[s.b]);
    EXPECT_GE(length, 0.45 * kSize);
  }
  EXPECT_LT(coarse.pslg.points.size(), points / 8);
  EXPECT_GE(leastApart(coarse), 0.4 * kSize);
  EXPECT_NEAR(areaOf(coarse), area, 0.01 * area);
}

// A sea of side 100 with inlets on its western side, 30 deep: pairs of the land before an inlet and its width,
// southwards.
Domain combedSea(const std::vector<std::pair<double, double>>& inlets) {
  std::vector<Point> ring{{0, 0}, {100, 0}, {100, 100}, {0, 100}};
  double y = 95.0;
  for (const auto& [land, water] : inlets) {
    y -= land;
    for (const Point& p : {Point{0, y}, Point{-30, y}, Point{-30, y - water}, Point{0, y - water}}) ring.push_back(p);
    y -= water;
  }
  Domain domain;
  addShore(domain, ring);
  return domain;
}

TEST(FollowSizes, TheWaterKeepsItsAreaWhereNarrowWaterIsClosed) {
  const Domain sea = combedSea({{15.0, 2.5}, {15.0, 2.5}});
  const double area = areaOf(sea);
  ASSERT_GT(2 * 2.5 * 30.0, 0.014 * area);  // what closing takes
  CleanReport report;
  const Domain coarse = followSizes(Domain(sea), ConstantSize(4.0), {}, oneFeature(), report);
  EXPECT_GE(countOf(report, EditKind::ClosedWater), 2u);
  EXPECT_NEAR(areaOf(coarse), area, 0.007 * area);
  for (const Point& p : coarse.pslg.points) {
    double least = 1e300;
    for (const Segment& s : sea.pslg.segments)
      least = std::min(least, squaredDistanceToSegment(p, sea.pslg.points[s.a], sea.pslg.points[s.b]));
    EXPECT_LE(std::sqrt(least), 0.4 + 1e-9);  // a tenth of the size
  }
}

TEST(FollowSizes, WhereLandAndWaterAreNarrowNeitherGivesWayToAllOfTheOther) {
  std::vector<std::pair<double, double>> inlets;
  for (int i = 0; i < 12; ++i) inlets.emplace_back(2.1 + 0.15 * ((5 * i) % 12), 2.5 + 0.1 * ((7 * i) % 12));
  Domain sea = combedSea(inlets);
  const double area = areaOf(sea);
  CleanReport report;
  const Domain coarse = followSizes(std::move(sea), ConstantSize(4.0), {}, oneFeature(), report);
  EXPECT_NEAR(areaOf(coarse), area, 0.01 * area);
  EXPECT_GE(leastApart(coarse), 0.45 * 4.0);
  EXPECT_GT(countOf(report, EditKind::ClosedWater), 0u);
  EXPECT_GT(countOf(report, EditKind::DroppedSpit), 0u);
}

// Behind a bar, with one narrow mouth, and a quarter of an element deep: simplifying alone may be caught in its shore.
TEST(FollowSizes, AShallowBayWithAWindingShoreIsNotLeftToSimplifying) {
  std::vector<Point> ring{{0, 0}, {100, 0}, {100, 100}, {0, 100}, {0, 50.3}, {-1, 50.3}, {-1, 55}};
  // Comb by comb, from the west and from the bar.
  for (double y = 55.0; y > 45.5; y -= 0.8)
    for (const Point& p :
         {Point{-5, y}, Point{-5, y - 0.5}, Point{-1.5, y - 0.5}, Point{-1.5, y - 0.6}, Point{-5, y - 0.6}})
      ring.push_back(p);
  ring.insert(ring.end(), {{-5, 45}, {-1, 45}, {-1, 50}, {0, 50}});
  Domain domain;
  addShore(domain, ring);
  constexpr double kSize = 20.0;
  CleanReport report;
  const Domain coarse = followSizes(std::move(domain), ConstantSize(kSize), {}, oneFeature(), report);
  EXPECT_GE(countOf(report, EditKind::DroppedSpit) + countOf(report, EditKind::ClosedWater), 10u);
  for (const Segment& s : coarse.pslg.segments)
    EXPECT_GE(distance(coarse.pslg.points[s.a], coarse.pslg.points[s.b]), 0.45 * kSize);
  EXPECT_NEAR(areaOf(coarse), 1e4, 100.0);
}

TEST(FollowSizes, AChannelNarrowerThanAnElementIsClosed) {
  const ConstantSize size(2.0);
  CleanReport wide, narrow, kept;
  EXPECT_EQ(parts(followSizes(twoLakes(3.0), size, {}, oneFeature(), wide)), 1u);
  EXPECT_EQ(countOf(wide, EditKind::ClosedWater), 0u);
  EXPECT_EQ(parts(followSizes(twoLakes(0.6), size, {}, oneFeature(), narrow)), 2u);
  EXPECT_GE(countOf(narrow, EditKind::ClosedWater), 1u);
  const Domain open = followSizes(twoLakes(0.6), size, {.channel_min = 0.0}, oneFeature(), kept);
  EXPECT_EQ(parts(open), 1u);
  EXPECT_GE(leastApart(open), 0.6 - 1e-9);
  const FollowOptions wider{.channel_min = 2.0, .strait_min = 1.6};
  EXPECT_EQ(parts(followSizes(twoLakes(3.0), size, wider, oneFeature(), kept)), 2u);
}

TEST(FollowSizes, AStraitALittleNarrowerThanAnElementThatAloneJoinsWatersIsWidened) {
  for (const double width : {0.9, 1.5}) {
    for (const double channel_min : {1.0, 1.5}) {
      const Domain before = twoLakes(width);
      const double area = areaOf(before);
      CleanReport report;
      const Domain coarse = followSizes(Domain(before), ConstantSize(2.0),
                                        {.channel_min = channel_min, .strait_min = 0.4}, oneFeature(), report);
      EXPECT_EQ(parts(coarse), 1u);
      EXPECT_GE(countOf(report, EditKind::WidenedPassage), 1u);
      EXPECT_EQ(countOf(report, EditKind::CutOffWater), 0u);
      EXPECT_NEAR(areaOf(coarse), area, 0.01 * area + 20.0 * channel_min - 10.0 * width);
      EXPECT_GE(leastApart(coarse), 0.75 * 2.0);
      ASSERT_EQ(report.notes.size(), 1u);
      double x = 0.0, y = 0.0, wide = 0.0, length = 0.0, behind = 0.0;
      ASSERT_EQ(std::sscanf(report.notes[0].c_str(),
                            "straits that alone join waters were widened to an element instead of closed, for the "
                            "largest of 1 waters: (%lf, %lf), %lf wide, about %lf long, to %lf",
                            &x, &y, &wide, &length, &behind),
                5)
          << report.notes[0];
      EXPECT_NEAR(x, 25.0, 6.0);
      EXPECT_NEAR(y, 10.0, 1.0);
      EXPECT_NEAR(wide, width, 0.4);
      EXPECT_NEAR(behind, 400.0, 20.0);
    }
  }
  CleanReport closed;
  EXPECT_EQ(parts(followSizes(twoLakes(1.5), ConstantSize(2.0), {.strait_min = 1.0}, oneFeature(), closed)), 2u);
}

// A pond of side 6 behind a strait 15 long, which would take more than a quarter of it.
TEST(FollowSizes, NoStraitIsWidenedThatTakesAsMuchAsTheWaterBehindItHas) {
  Domain domain;
  addShore(domain, {{0, 0},
                    {20, 0},
                    {20, 9.5},
                    {35, 9.5},
                    {35, 7},
                    {41, 7},
                    {41, 13},
                    {35, 13},
                    {35, 10.5},
                    {20, 10.5},
                    {20, 20},
                    {0, 20}});
  CleanReport report;
  followSizes(std::move(domain), ConstantSize(2.0), {.keep = KeepWater::Largest}, oneFeature(), report);
  EXPECT_EQ(countOf(report, EditKind::WidenedPassage), 0u);
  EXPECT_EQ(countOf(report, EditKind::CutOffWater), 1u);
}

// Two lakes behind a sea, one behind the other.
TEST(FollowSizes, WatersBehindOneAnotherAreAllJoined) {
  Domain domain;
  addShore(domain,
           {{0, 0},   {20, 0},  {20, 9.3},  {24, 9.3},  {24, 0},  {36, 0},  {36, 9.3},  {40, 9.3},  {40, 0},  {52, 0},
            {52, 20}, {40, 20}, {40, 10.7}, {36, 10.7}, {36, 20}, {24, 20}, {24, 10.7}, {20, 10.7}, {20, 20}, {0, 20}});
  CleanReport report;
  EXPECT_EQ(
      parts(followSizes(std::move(domain), ConstantSize(2.0), {.keep = KeepWater::Largest}, oneFeature(), report)), 1u);
  EXPECT_EQ(countOf(report, EditKind::CutOffWater), 0u);
}

TEST(FollowSizes, OfWaterThatIsCutApartWhatIsAskedForStays) {
  const auto followed = [](KeepWater keep, bool open_to_the_east) {
    Domain domain = twoLakes(0.6);
    for (const VertexId v : {0u, 11u, 10u})
      domain.pslg.points[v].x -= v == 10 ? 0.0 : 5.0;  // the western one is larger
    domain.input_points = domain.pslg.points;
    if (open_to_the_east) domain.pslg.segments[5].tag = kOpenTag;
    CleanReport report;
    Domain coarse = followSizes(std::move(domain), ConstantSize(2.0), {.keep = keep}, oneFeature(), report);
    const std::vector<std::string>& texts = keep == KeepWater::All ? report.notes : report.warnings;
    EXPECT_EQ(texts.size(), 1u);
    EXPECT_NE(texts.front().find("behind water 0.6 wide at ("), std::string::npos) << texts.front();
    EXPECT_NE(texts.front().find("--passages"), std::string::npos) << texts.front();
    EXPECT_EQ(countOf(report, EditKind::CutOffWater), keep == KeepWater::All ? 0u : 1u);
    return coarse;
  };
  EXPECT_EQ(parts(followed(KeepWater::All, true)), 2u);
  const Domain largest = followed(KeepWater::Largest, true), open = followed(KeepWater::Open, true),
               none_open = followed(KeepWater::Open, false);
  for (const Point& p : largest.pslg.points) EXPECT_LT(p.x, 25.0);
  for (const Point& p : open.pslg.points) EXPECT_GT(p.x, 25.0);
  for (const Point& p : none_open.pslg.points) EXPECT_LT(p.x, 25.0);
}

// A large lake, and one beside it at an open boundary.
TEST(FollowSizes, AFrameThatGrazesAnotherWaterDoesNotDropTheOneThatIsMeant) {
  for (const double side : {12.0, 20.0}) {
    Domain domain;
    addShore(domain, {{0, 0}, {40, 0}, {40, 40}, {0, 40}});
    addShore(domain, {{50, 0}, {50 + side, 0}, {50 + side, side}, {50, side}});
    domain.pslg.segments[5].tag = kOpenTag;
    for (const KeepWater keep : {KeepWater::Modelled, KeepWater::Open}) {
      CleanReport report;
      const Domain coarse = followSizes(Domain(domain), ConstantSize(2.0), {.keep = keep}, oneFeature(), report);
      const bool grazed = side == 12.0 && keep == KeepWater::Modelled;  // 144 of 1744, 400 of 2000
      for (const Point& p : coarse.pslg.points) EXPECT_EQ(p.x < 45.0, grazed) << side;
      ASSERT_EQ(report.warnings.size(), 1u);
      EXPECT_NE(report.warnings[0].find(grazed ? "144 (8.3 %) of the water is left out" : "1.6e+03"), std::string::npos)
          << report.warnings[0];
      EXPECT_EQ(report.warnings[0].find("which has an open boundary") != std::string::npos, grazed);
      EXPECT_NE(report.warnings[0].find("nothing joins to them in the data"), std::string::npos);
    }
  }
}

// Two lakes of two features: each is judged by itself, whichever comes first.
TEST(FollowSizes, TheLakeOfAnotherFeatureStays) {
  for (const bool large_first : {true, false}) {
    Domain domain;
    addShore(domain, {{0, 0}, {40, 0}, {40, 40}, {0, 40}});
    addShore(domain, {{50, 0}, {62, 0}, {62, 12}, {50, 12}});
    for (SegmentId s = 0; s < 8; ++s) domain.pslg.segments[s].left = (s < 4) == large_first ? 0 : 1;
    Coastline coast = oneFeature();
    coast.features.emplace_back();
    for (const KeepWater keep : {KeepWater::Modelled, KeepWater::Open, KeepWater::Largest}) {
      CleanReport report;
      const Domain coarse = followSizes(Domain(domain), ConstantSize(2.0), {.keep = keep}, coast, report);
      EXPECT_EQ(parts(coarse), 2u);
      EXPECT_EQ(countOf(report, EditKind::CutOffWater), 0u);
    }
  }
}

// The same with an open boundary at both: the small one is left out, unless it is asked for.
TEST(FollowSizes, AFrameThatGrazesAWaterBesideTheSeaLeavesOneWater) {
  Domain domain;
  addShore(domain, {{0, 0}, {40, 0}, {40, 40}, {0, 40}});
  addShore(domain, {{50, 0}, {62, 0}, {62, 12}, {50, 12}});
  for (const SegmentId s : {3u, 5u}) domain.pslg.segments[s].tag = kOpenTag;
  for (const KeepWater keep : {KeepWater::Modelled, KeepWater::Open}) {
    CleanReport report;
    EXPECT_EQ(parts(followSizes(Domain(domain), ConstantSize(2.0), {.keep = keep}, oneFeature(), report)),
              keep == KeepWater::Open ? 2u : 1u);
    EXPECT_EQ(countOf(report, EditKind::CutOffWater), keep == KeepWater::Open ? 0u : 1u);
  }
}

// Water whose opening is too short for an element would be left without any.
TEST(FollowSizes, AShortOpeningKeepsNoWater) {
  Domain domain = twoLakes(0.6);
  domain.pslg.segments[5].tag = kOpenTag;  // the eastern side of the eastern lake
  const auto count = static_cast<VertexId>(domain.pslg.points.size());
  domain.pslg.points.push_back({0, 10.3});
  domain.pslg.points.push_back({0, 9.7});
  domain.pslg.segments[11].b = count;
  domain.pslg.segments.push_back({count, count + 1, kOpenTag, 0, kOutside});
  domain.pslg.segments.push_back({count + 1, 0, 0, 0, kOutside});
  domain.input_points = domain.pslg.points;
  CleanReport report;
  const Domain coarse =
      followSizes(std::move(domain), ConstantSize(2.0), {.keep = KeepWater::Open}, oneFeature(), report);
  EXPECT_EQ(countOf(report, EditKind::CutOffWater), 1u);
  for (const Point& p : coarse.pslg.points) EXPECT_GT(p.x, 25.0);
}

TEST(FollowSizes, ASpitNarrowerThanAnElementGoesAndABarThatPartsWatersStays) {
  const std::vector<Point> spit{{0, 0}, {19.5, 0}, {19.5, 12}, {20.5, 12}, {20.5, 0}, {40, 0}, {40, 20}, {0, 20}};
  const ConstantSize size(2.0);
  for (const double least : {1.0, 0.0}) {
    Domain domain;
    addShore(domain, spit);
    CleanReport report;
    const Domain coarse = followSizes(std::move(domain), size, {.land_min = least}, oneFeature(), report);
    EXPECT_EQ(countOf(report, EditKind::DroppedSpit), least > 0.0 ? 1u : 0u);
    EXPECT_EQ(std::ranges::any_of(coarse.pslg.points,
                                  [](const Point& p) { return p.x > 15 && p.x < 25 && p.y > 5 && p.y < 15; }),
              least == 0.0);
    EXPECT_NEAR(areaOf(coarse), 788.0, 8.0);
  }
  Domain barred;
  addShore(barred, {{0, 0}, {19.5, 0}, {19.5, 20}, {0, 20}});
  addShore(barred, {{20.5, 0}, {40, 0}, {40, 20}, {20.5, 20}});
  CleanReport report;
  EXPECT_EQ(parts(followSizes(std::move(barred), size, {}, oneFeature(), report)), 2u);
}

// A frame of side 40 with a short way out through land, or with a bit of land at it: neither leaves short edges.
TEST(FollowSizes, ShortPiecesOfAnOpenBoundaryAndOfShoreAtItGo) {
  for (const bool way_out : {true, false}) {
    Domain domain;
    addShore(domain, {{0, 0}, {40, 0}, {40, 19.8}, {way_out ? 39.0 : 39.5, 20}, {40, 20.2}, {40, 40}, {0, 40}});
    if (way_out) {
      domain = {};
      addShore(domain, {{0, 0}, {36, 0}, {36, 12}, {40, 19.8}, {40, 20.2}, {36, 28}, {36, 40}, {0, 40}});
      domain.pslg.segments[3].tag = kOpenTag;
    } else {
      for (const SegmentId s : {0u, 1u, 4u, 5u, 6u}) domain.pslg.segments[s].tag = kOpenTag;
    }
    CleanReport report;
    const Domain coarse = followSizes(std::move(domain), ConstantSize(2.0), {}, oneFeature(), report);
    for (const Segment& s : coarse.pslg.segments) {
      EXPECT_GE(distance(coarse.pslg.points[s.a], coarse.pslg.points[s.b]), 0.9);
      EXPECT_EQ(s.tag, way_out ? 0 : kOpenTag);
    }
    for (const Point& p : coarse.pslg.points) EXPECT_LE(p.x, 40.0);
  }
}

// A sea of side 60 and an island along its southern shore, 30 long, with a strait 1 wide between them.
Domain seaWithStrait() {
  Domain domain;
  addShore(domain, {{0, 0}, {60, 0}, {60, 60}, {0, 60}});
  addShore(domain, {{15, 1}, {15, 11}, {45, 11}, {45, 1}});
  return domain;
}

TEST(FollowSizes, AStraitThatIsClosedIsNamedThoughNothingIsCutOff) {
  CleanReport report;
  const Domain coarse = followSizes(seaWithStrait(), ConstantSize(2.0), {}, oneFeature(), report);
  EXPECT_EQ(boundaryLoops(constrainedDelaunay(coarse.pslg)).size(), 1u);
  ASSERT_EQ(report.notes.size(), 1u);
  double x = 0.0, y = 0.0, length = 0.0, width = 0.0;
  ASSERT_EQ(std::sscanf(report.notes[0].c_str(),
                        "straits closed, the longest of 1: (%lf, %lf), about %lf long, %lf wide; keep it", &x, &y,
                        &length, &width),
            4)
      << report.notes[0];
  EXPECT_NEAR(x, 30.0, 2.0);
  EXPECT_NEAR(y, 0.5, 0.5);
  EXPECT_NEAR(length, 30.0, 3.0);
  EXPECT_NEAR(width, 1.0, 0.3);
  EXPECT_NE(report.notes[0].find("--passages"), std::string::npos);
}

TEST(FollowSizes, APassageStaysOpenAndIsWidened) {
  for (const double elements : {1.0, 2.0}) {
    CleanReport report;
    const ShoreGuides guides{{{{{5, 0.5}, {55, 0.5}}, "narrows", elements}}, {}};
    const Domain coarse = followSizes(seaWithStrait(), ConstantSize(2.0), {}, oneFeature(), report, guides);
    EXPECT_EQ(boundaryLoops(constrainedDelaunay(coarse.pslg)).size(), 2u);
    EXPECT_EQ(countOf(report, EditKind::WidenedPassage), 1u);
    ASSERT_EQ(report.notes.size(), 1u);
    EXPECT_NE(report.notes[0].find("passage 'narrows' was widened to " + std::string(elements == 1.0 ? "2" : "4")),
              std::string::npos)
        << report.notes[0];
    double width = 1e300;
    for (const Point& p : coarse.pslg.points) {
      if (p.x < 10 || p.x > 50 || p.y < 0.6 || p.y > 8) continue;
      for (const Segment& segment : coarse.pslg.segments) {
        const Point &a = coarse.pslg.points[segment.a], &b = coarse.pslg.points[segment.b];
        if (a.y < 0.6 && b.y < 0.6) width = std::min(width, std::sqrt(squaredDistanceToSegment(p, a, b)));
      }
    }
    EXPECT_GE(width, 0.8 * 2.0 * elements);
    EXPECT_LE(width, 1.5 * 2.0 * elements);
  }
}

TEST(FollowSizes, APassageThatIsWideEnoughChangesNothingAndOneOnLandIsSaidToBeSo) {
  CleanReport plain, guided;
  const ShoreGuides guides{{{{{5, 25}, {55, 25}}, "", 2.0}, {{{20, 5}, {40, 5}}, "", 2.0}}, {}};
  const Domain before = followSizes(seaWithStrait(), ConstantSize(2.0), {}, oneFeature(), plain);
  const Domain after = followSizes(seaWithStrait(), ConstantSize(2.0), {}, oneFeature(), guided, guides);
  EXPECT_EQ(after.pslg.points, before.pslg.points);
  EXPECT_EQ(countOf(guided, EditKind::WidenedPassage), 0u);
  ASSERT_EQ(guided.notes.size(), plain.notes.size() + 1);
  EXPECT_NE(guided.notes[0].find("passage 2 meets no water"), std::string::npos) << guided.notes[0];
}

TEST(FollowSizes, APassageIsCutThroughLand) {
  Domain domain;
  addShore(domain, {{0, 0}, {20, 0}, {20, 20}, {0, 20}});
  addShore(domain, {{30, 0}, {50, 0}, {50, 20}, {30, 20}});
  CleanReport report;
  const ShoreGuides guides{{{{{-5, 10}, {60, 10}}, ""}}, {}};
  const Domain coarse = followSizes(std::move(domain), ConstantSize(2.0), {}, oneFeature(), report, guides);
  EXPECT_EQ(parts(coarse), 1u);
  for (const Point& p : coarse.pslg.points) EXPECT_TRUE(p.x > -1.0 && p.x < 51.0) << p.x;  // not beyond the last water
}

TEST(FollowSizes, ABarrierClosesTheWaterItCrosses) {
  CleanReport open, report;
  const ShoreGuides guides{{}, {{{{25, 4}, {25, 16}}, ""}}};
  EXPECT_EQ(parts(followSizes(twoLakes(5.0), ConstantSize(2.0), {}, oneFeature(), open)), 1u);
  const Domain closed = followSizes(twoLakes(5.0), ConstantSize(2.0), {}, oneFeature(), report, guides);
  EXPECT_EQ(parts(closed), 2u);
  EXPECT_EQ(countOf(report, EditKind::Barrier), 1u);
  CleanReport one;
  EXPECT_EQ(
      parts(followSizes(twoLakes(5.0), ConstantSize(2.0), {.keep = KeepWater::Largest}, oneFeature(), one, guides)),
      1u);
}

TEST(FollowSizes, LinesInTheWaterStay) {
  Domain domain = twoLakes(1.0);
  const auto first = static_cast<VertexId>(domain.pslg.points.size());
  for (int i = 0; i <= 12; ++i) domain.pslg.points.push_back({19.0 + i, 10.0});
  for (VertexId i = 0; i < 12; ++i) domain.pslg.segments.push_back({first + i, first + i + 1, kFirstLineTag, 0, 0});
  domain.lines.emplace_back();
  domain.input_points = domain.pslg.points;
  CleanReport report;
  const Domain coarse = followSizes(std::move(domain), ConstantSize(2.0), {}, oneFeature(), report);
  EXPECT_EQ(std::ranges::count(coarse.pslg.segments, kFirstLineTag, &Segment::tag), 12);
  EXPECT_EQ(parts(coarse), 1u);
}

// The last vertex of a shore whose ends a border between two waters joins stays: without it the border would run twice.
TEST(FollowSizes, AShoreIsNotCoarsenedOntoTheBorderBesideIt) {
  Domain domain;
  domain.pslg.points = {{0, 0}, {40, 0}, {40, 40}, {0, 40}, {10, 41}, {20, 42}, {30, 41}};
  domain.pslg.segments = {{0, 1, 0, 0, kOutside}, {1, 2, 0, 0, kOutside}, {2, 3, 0, 0, 1},
                          {3, 0, 0, 0, kOutside}, {2, 6, 0, 1, kOutside}, {6, 5, 0, 1, kOutside},
                          {5, 4, 0, 1, kOutside}, {4, 3, 0, 1, kOutside}};
  domain.input_points = domain.pslg.points;
  Coastline two = oneFeature();
  two.features.emplace_back();
  CleanReport report;
  const Domain followed = followSizes(std::move(domain), ConstantSize(40.0), {}, two, report);
  EXPECT_GT(countOf(report, EditKind::SimplifiedPoint), 0u);
  std::set<std::pair<VertexId, VertexId>> ends;
  for (const Segment& s : followed.pslg.segments)
    EXPECT_TRUE(ends.insert(std::minmax(s.a, s.b)).second) << s.a << " " << s.b;
  const TriMesh mesh = constrainedDelaunay(followed.pslg);
  EXPECT_EQ(std::set<RegionId>(mesh.regions.begin(), mesh.regions.end()), (std::set<RegionId>{0, 1}));
}

TEST(FollowSizes, OpenBoundaryKeepsItsCorners) {
  Domain domain;
  constexpr VertexId kOnASide = 50;
  const Point corners[] = {{0.0, 0.0}, {100.0, 0.0}, {100.0, 100.0}, {0.0, 100.0}};
  for (unsigned side = 0; side < 4; ++side) {
    const Point &from = corners[side], &to = corners[(side + 1) % 4];
    const Point out{(to - from).y / 100.0, (from - to).x / 100.0};
    for (VertexId i = 0; i < kOnASide; ++i) {
      const double t = static_cast<double>(i) / kOnASide;
      domain.pslg.points.push_back(from + t * (to - from) + 0.8 * t * (1.0 - t) * out);
    }
  }
  const auto count = static_cast<VertexId>(domain.pslg.points.size());
  for (VertexId v = 0; v < count; ++v) domain.pslg.segments.push_back({v, (v + 1) % count, kOpenTag, 0, kOutside});
  domain.input_points = domain.pslg.points;
  for (const double length : {10.0, 500.0}) {
    const SizeOf size(length, length, [length](const Point&) { return length; });
    CleanReport report;
    const Domain coarse = followSizes(Domain(domain), size, {}, oneFeature(), report);
    EXPECT_LT(coarse.pslg.points.size(), 20u);
    for (const Point& corner : corners)
      EXPECT_EQ(std::ranges::count(coarse.pslg.points, corner), 1) << corner.x << ", " << corner.y;
    for (const Segment& s : coarse.pslg.segments) EXPECT_EQ(s.tag, kOpenTag);
  }
}

TEST(FollowSizes, SmallIslandsGoAndAreCounted) {
  Domain domain;
  addRing(domain, {0.0, 0.0}, 10.0, 400, false);
  addRing(domain, {-5.0, 0.0}, 0.2, 20, true);
  addRing(domain, {5.0, 0.0}, 0.2, 20, true);
  addRing(domain, {0.0, 5.0}, 2.0, 60, true);
  const SizeOf size(0.1, 1.0, [](const Point& p) { return p.x < 0.0 ? 1.0 : 0.1; });
  CleanReport report;
  const Domain coarse = followSizes(std::move(domain), size, {}, oneFeature(), report);
  EXPECT_EQ(report.counts[static_cast<std::size_t>(EditKind::SmallIsland)], 1u);
  const TriMesh mesh = constrainedDelaunay(coarse.pslg);
  std::size_t loops = boundaryLoops(mesh).size();
  EXPECT_EQ(loops, 3u);
}

// A .poly says with a point in each hole what the labels of a cleaned domain say.
TEST(FollowSizes, AGraphWithoutLabelsIsFollowedAsWell) {
  Domain labelled;
  addRing(labelled, {0.0, 0.0}, 10.0, 400, false, 0.003);
  addRing(labelled, {-5.0, 0.0}, 0.2, 20, true);
  addRing(labelled, {0.0, 5.0}, 2.0, 60, true);
  Domain bare = labelled;
  for (Segment& s : bare.pslg.segments) s.left = s.right = kUnlabelled;
  bare.pslg.holes = {{-5.0, 0.0}, {0.0, 5.0}};
  const SizeOf size(1.0, 1.0, [](const Point&) { return 1.0; });
  CleanReport report, bare_report;
  const Domain coarse = followSizes(std::move(labelled), size, {}, oneFeature(), report);
  const Domain bare_coarse = followSizes(std::move(bare), size, {}, oneFeature(), bare_report);
  EXPECT_EQ(bare_coarse.pslg.points, coarse.pslg.points);
  EXPECT_EQ(bare_report.counts, report.counts);
  EXPECT_GT(report.counts[static_cast<std::size_t>(EditKind::SimplifiedPoint)], 300u);
  EXPECT_EQ(boundaryLoops(constrainedDelaunay(bare_coarse.pslg)).size(), 2u);
}

TEST(NodeSizes, NoTwoNeighboursDifferMore) {
  const Pslg pslg = squarePslg();
  const SizeOf size(0.01, 1.0, [](const Point& p) { return 0.02 + 0.4 * std::hypot(p.x - 0.3, p.y - 0.3); });
  TriMesh mesh = constrainedDelaunay(pslg);
  refine(mesh, pslg, {.min_angle_deg = 30.0, .size = &size});
  constexpr double kGradation = 0.2, kScale = 2.0;
  const std::vector<double> sizes = nodeSizes(mesh, size, kGradation, [](VertexId) { return kScale; });
  ASSERT_EQ(sizes.size(), mesh.points.size());
  bool lowered = false;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const VertexId a = mesh.origin(edgeRef(t, i)), b = mesh.target(edgeRef(t, i));
      EXPECT_LE(std::abs(sizes[a] - sizes[b]), kGradation * distance(mesh.points[a], mesh.points[b]) / kScale);
      EXPECT_LE(sizes[a], size.at(mesh.points[a]) / kScale + 1e-12);
      lowered |= sizes[a] < 0.9 * size.at(mesh.points[a]) / kScale;
    }
  }
  EXPECT_TRUE(lowered);
}

// A square sea of side 20 whose lower side is open, cut finely.
Domain seaWithFineOpening() {
  Domain sea;
  std::vector<Point> ring;
  for (int i = 0; i < 40; ++i) ring.push_back({0.5 * i, 0.0});
  for (const Point& p : {Point{20, 0}, Point{20, 20}, Point{0, 20}}) ring.push_back(p);
  addShore(sea, ring);
  for (int i = 0; i < 40; ++i) sea.pslg.segments[static_cast<std::size_t>(i)].tag = kOpenTag;
  return sea;
}

// A lake with a fine winding shore and a fine island, and one island too small for an element.
Domain fineLake() {
  Domain lake;
  addRing(lake, {0.0, 0.0}, 100.0, 4000, false, 0.0004);
  addRing(lake, {10.0, 0.0}, 20.0, 800, true, 0.001);
  addRing(lake, {-60.0, 0.0}, 0.5, 40, true);
  return lake;
}

TEST(ThinToLeast, TakesOutWhatIsFinerAndIsKnownAfterwards) {
  const Domain lake = fineLake();
  for (const double size : {2.0, 4.0}) {
    CleanReport thinning, report, plain;
    FollowStart start;
    Domain thin = thinToLeast(Domain(lake), 2.0, {}, oneFeature(), {}, thinning, start);
    EXPECT_EQ(start.thinned_m, 2.0);
    EXPECT_LT(thin.pslg.points.size(), lake.pslg.points.size() / 5);
    EXPECT_EQ(countOf(thinning, EditKind::SmallIsland), 1u);
    // The island's vertices are one edit.
    EXPECT_EQ(countOf(thinning, EditKind::SimplifiedPoint), lake.pslg.points.size() - thin.pslg.points.size() - 40u);
    EXPECT_NEAR(start.gained.at(0), areaOf(thin) - areaOf(lake), 1e-6 * areaOf(lake));
    const std::size_t left = thin.pslg.points.size();
    const Domain after = followSizes(std::move(thin), ConstantSize(size), {}, oneFeature(), report, {}, inOrder, start);
    const Domain at_once = followSizes(Domain(lake), ConstantSize(size), {}, oneFeature(), plain);
    EXPECT_NEAR(areaOf(after) / areaOf(lake), 1.0, 0.005);
    EXPECT_NEAR(static_cast<double>(after.pslg.points.size()) / static_cast<double>(at_once.pslg.points.size()), 1.0,
                0.25);
    EXPECT_EQ(countOf(plain, EditKind::SmallIsland), 1u);
    EXPECT_EQ(countOf(report, EditKind::SmallIsland), 0u);
    EXPECT_LT(after.pslg.points.size(), left);
  }
}

TEST(ThinToLeast, LeavesWhatIsHardlyFiner) {
  CleanReport report;
  FollowStart start;
  const Domain lake = fineLake();
  const Domain same = thinToLeast(Domain(lake), 0.2, {}, oneFeature(), {}, report, start);
  EXPECT_EQ(start.thinned_m, 0.0);
  EXPECT_EQ(same.pslg.points, lake.pslg.points);
  EXPECT_TRUE(report.edits.empty());
}

TEST(FollowSizes, LargerSizesAtOpenBoundariesMakeTheseCoarserAlone) {
  const Domain sea = seaWithFineOpening();
  const SizeOf before(0.5, 20.0, [](const Point& p) { return p.y < 1.0 ? 0.5 : 20.0; });
  const SizeOf after(4.0, 20.0, [](const Point& p) { return p.y < 1.0 ? 4.0 : 20.0; });
  // The corners are of both, and count as shore.
  EXPECT_EQ(growthOf(sea.pslg, before, before).elsewhere, 1.0);
  EXPECT_EQ(growthOf(sea.pslg, before, after).elsewhere, 8.0);
  const SizeOf inland(0.5, 40.0, [](const Point& p) { return p.y < 10.0 ? 0.5 : 40.0; });
  EXPECT_EQ(growthOf(sea.pslg, before, inland).elsewhere, 1.0);
  EXPECT_EQ(growthOf(sea.pslg, before, inland).shore, 2.0);
  CleanReport report;
  const Domain coarse = coarsenFurther(Domain(sea), after, oneFeature(), report);
  EXPECT_LE(coarse.pslg.points.size(), 12u);
  EXPECT_EQ(countOf(report, EditKind::SimplifiedPoint), sea.pslg.points.size() - coarse.pslg.points.size());
  EXPECT_DOUBLE_EQ(areaOf(coarse), 400.0);
  double open = 0.0;
  for (const Segment& s : coarse.pslg.segments)
    if (s.tag == kOpenTag) open += distance(coarse.pslg.points[s.a], coarse.pslg.points[s.b]);
  EXPECT_DOUBLE_EQ(open, 20.0);
}

}  // namespace
}  // namespace coastmesh
