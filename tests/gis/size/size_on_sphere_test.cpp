#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "core/metric.hpp"
#include "core/size/on_surface.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/follow/coast_follow.hpp"
#include "gis/size/domain_mask.hpp"
#include "gis/size/node_sizes.hpp"
#include "gis/size/size_channel.hpp"
#include "gis/size/size_choice.hpp"
#include "gis/size/size_distance.hpp"
#include "gis/size/size_floor.hpp"
#include "gis/size/size_source.hpp"
#include "tests/support/gis_shapes.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr RegionId kSea = 0;

const GeographicLib::Geodesic& earth() { return GeographicLib::Geodesic::WGS84(); }

Point away(const Point& from, double azimuth, double metres) {
  Point to;
  earth().Direct(from.y, from.x, azimuth, metres, to.y, to.x);
  return to;
}

double metresBetween(const Point& a, const Point& b) {
  double metres = 0.0;
  earth().Inverse(a.y, a.x, b.y, b.x, metres);
  return metres;
}

Ring circle(const Point& centre, double radius_m, int corners) {
  Ring ring;
  for (int i = 0; i < corners; ++i) ring.push_back(away(centre, 360.0 / corners * i, radius_m));
  return ring;
}

// The whole Earth is sea except a continent and some islands. In the plane, whose centre is opposite the continent,
// lengths are up to 26 times those on the Earth.
class OceanPlanet : public ::testing::Test {
 protected:
  static constexpr double kContinent = 2.5e6;  // metres from its middle to its shore
  const Point middle_{90.0, 45.0};             // of the continent
  const std::vector<Point> islands_ = {{-90.0, -45.0}, {0.0, 0.0}, {60.0, 10.0}, {170.0, 60.0}, {90.0, 10.0}};
  static constexpr double kIsland = 3e5;  // metres

  const Projection projection_ = [&] {
    Ring all;
    for (int lon = -180; lon <= 180; lon += 10) all.push_back({1.0 * lon, -90.0});
    for (int lon = 180; lon >= -180; lon -= 10) all.push_back({1.0 * lon, 90.0});
    return Projection::fitted(coastlineOf({polygonFeature(1, all, {circle(middle_, kContinent, 72)})}, wgs84()), {0},
                              SurfaceKind::Ellipsoid);
  }();
  const Surface surface_ = projection_.surface();

  Domain domain() const {
    Domain domain;
    domain.projection = projection_;
    const auto add = [&](const Ring& ring) {
      const auto first = static_cast<VertexId>(domain.input_points.size());
      const auto count = static_cast<VertexId>(ring.size());
      double twice = 0.0;
      for (const Point& p : ring) {
        domain.input_points.push_back(p);
        domain.pslg.points.push_back(projection_.forward(p));
      }
      for (VertexId i = 0; i < count; ++i)
        twice += cross(domain.pslg.points[first + i], domain.pslg.points[first + (i + 1) % count]);
      // The continent is the outside: the sea is inside its ring, and outside the islands' rings.
      const bool outer = ring.size() == 72, inside_left = (twice > 0.0) == outer;
      for (VertexId i = 0; i < count; ++i)
        domain.pslg.segments.push_back(
            {first + i, first + (i + 1) % count, 0, inside_left ? kSea : kOutside, inside_left ? kOutside : kSea});
    };
    add(circle(middle_, kContinent, 72));
    for (const Point& island : islands_) add(circle(island, kIsland, 24));
    return domain;
  }

  // Uniform on the Earth, outside the continent.
  Point randomPlace(std::mt19937_64& random) const {
    while (true) {
      const Point p{uniform(random, -180.0, 180.0), toDegrees(std::asin(uniform(random, -1.0, 1.0)))};
      if (metresBetween(p, middle_) > 1.01 * kContinent) return p;
    }
  }
  std::function<double(const Point&)> scale() const {
    return [projection = projection_](const Point& x) { return projection.scaleAt(x); };
  }
};

TEST_F(OceanPlanet, IsWhatTheseTestsNeed) {
  ASSERT_TRUE(surface_.isCurved());
  EXPECT_GT(projection_.scaleAt(projection_.forward(away(middle_, 10.0, kContinent))), 20.0);
  EXPECT_NEAR(projection_.scaleAt(projection_.forward({-90.0, -45.0})), 1.0, 0.01);
}

// Against geodesics to a hundred points per line, over the whole Earth: for lines with equal and different sizes, with
// and without a maximum.
TEST_F(OceanPlanet, DistancesAreThoseOnTheGround) {
  std::mt19937_64 random(5);
  for (const bool alike : {true, false}) {
    std::vector<SizedLine> lines;
    for (int i = 0; i < 60; ++i) {
      const Point a = randomPlace(random);
      const Point b = i % 6 == 0 ? a : away(a, uniform(random, 0.0, 360.0), std::exp(uniform(random, 7.0, 13.5)));
      lines.push_back({projection_.forward(a), projection_.forward(b), alike ? 1e3 : uniform(random, 0.0, 1e5),
                       alike ? 0.2 : uniform(random, 0.0, 0.5)});
    }
    const auto naive = [&](const Point& x) {
      double least = kInfinity;
      for (const SizedLine& l : lines) {
        double nearest = kInfinity;
        const int steps = l.a == l.b ? 0 : 100;
        for (int k = 0; k <= steps; ++k)
          nearest = std::min(
              nearest, metresBetween(x, projection_.inverse(l.a + (k / std::max(1.0, 1.0 * steps)) * (l.b - l.a))));
        least = std::min(least, l.size_m + l.rate * nearest);
      }
      return least;
    };
    for (const double most : {kInfinity, 2e5}) {
      const DistanceField field(lines, scale(), most, surface_);
      std::vector<Point> ground, places;
      std::vector<SizeBox> boxes;
      for (int i = 0; i < 30; ++i) {
        ground.push_back(i % 3 == 0 ? away(middle_, uniform(random, 0.0, 360.0), 1.05 * kContinent)
                                    : randomPlace(random));
        places.push_back(projection_.forward(ground.back()));
        // Some as large as the Earth.
        const double reach = std::exp(uniform(random, 8.0, 15.5));
        boxes.push_back({places.back(), reach * projection_.scaleAt(places.back())});
      }
      std::vector<double> sizes(places.size());
      std::vector<SizeRange> ranges(boxes.size());
      field.sample(places, sizes);
      field.bound(boxes, ranges);
      for (std::size_t i = 0; i < places.size(); ++i) {
        const double wanted = std::min(naive(ground[i]), most);
        EXPECT_NEAR(sizes[i] / wanted, 1.0, 0.01) << ground[i].x << ", " << ground[i].y;
        const Point inside = places[i] + boxes[i].half * Point{uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)};
        const double there = std::min(naive(projection_.inverse(inside)), most);
        EXPECT_GE(1.01 * there, ranges[i].low);
        EXPECT_LE(0.99 * there, ranges[i].high);
      }
    }
  }
}

TEST_F(OceanPlanet, OneSizeIsThatOnTheGround) {
  SizeOptions options;
  options.size_m = 2e5;
  const Domain sea = domain();
  const DomainSizes sizes = makeSizeFunction(options, {}, sea, 1e9, inOrder);
  std::mt19937_64 random(1);
  for (int i = 0; i < 1000; ++i) {
    const Point place = projection_.forward(randomPlace(random));
    EXPECT_NEAR(sizes.function->at(place) / projection_.measureAt(place), 2e5, 1000.0);
  }
  // The Earth without caps of 2 pi R² (1 - cos) each; chords to the corners of the rims hardly change that.
  const double radius = 6371007.2;
  const auto cap = [&](double metres) {
    return 2.0 * std::numbers::pi * radius * radius * (1.0 - std::cos(metres / radius));
  };
  const double area = 5.10065622e14 - cap(kContinent) - 5.0 * cap(kIsland);
  EXPECT_NEAR(sizes.demand.vertices / (2.0 / std::sqrt(3.0) * area / 4e10), 1.0, 0.01);
}

TEST_F(OceanPlanet, SizesGrowFromTheShoreAsOnTheGround) {
  SizeOptions options;
  options.shore_m = 2e4;
  options.shore_rate = 0.15;
  options.most_m = 3e5;
  options.gradation = 0.2;
  const Domain sea = domain();
  const auto size = makeSizeFunction(options, {}, sea, 1e9, inOrder).function;
  const auto sizeAt = [&](const Point& p) {
    const Point place = projection_.forward(p);
    return size->at(place) / projection_.measureAt(place);
  };
  std::mt19937_64 random(2);
  double most = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const Point p = randomPlace(random);
    double to_shore = metresBetween(p, middle_) - kContinent;
    for (const Point& island : islands_) to_shore = std::min(to_shore, std::abs(metresBetween(p, island) - kIsland));
    EXPECT_NEAR(sizeAt(p) / std::min(3e5, 2e4 + 0.15 * to_shore), 1.0, 0.06) << p.x << ", " << p.y;
    const Point q = away(p, uniform(random, 0.0, 360.0), std::exp(uniform(random, std::log(10.0), std::log(3e6))));
    if (metresBetween(q, middle_) < kContinent) continue;
    most = std::max(most, std::abs(sizeAt(p) - sizeAt(q)) / metresBetween(p, q));
  }
  EXPECT_LE(most, 0.2);
  EXPECT_GE(most, 0.12);
}

// A channel 30 km wide at several distances from the centre of the projection.
TEST_F(OceanPlanet, ChannelsAreAsWideAsOnTheGround) {
  for (const double degrees : {2.0, 60.0, 120.0, 150.0}) {
    const Point from = away({-90.0, -45.0}, 120.0, 111e3 * degrees);
    Domain channel;
    channel.projection = projection_;
    for (int side = 0; side < 2; ++side) {
      for (int k = 0; k <= 40; ++k) {
        const Point at = away(from, 30.0, 1e4 * (side == 0 ? k : 40 - k));
        channel.pslg.points.push_back(projection_.forward(away(at, side == 0 ? 120.0 : -60.0, 15e3)));
      }
    }
    double twice = 0.0;
    const auto count = static_cast<VertexId>(channel.pslg.points.size());
    for (VertexId i = 0; i < count; ++i) twice += cross(channel.pslg.points[i], channel.pslg.points[(i + 1) % count]);
    for (VertexId i = 0; i < count; ++i)
      channel.pslg.segments.push_back(
          {i, (i + 1) % count, 0, twice > 0.0 ? kSea : kOutside, twice > 0.0 ? kOutside : kSea});
    const ChannelLines lines = channelLines(channel.pslg, 3.0, 0.2, 100.0, 1e6, scale(), {}, surface_);
    ASSERT_GT(lines.lines.size(), 20u);
    std::vector<double> sizes;
    for (const SizedLine& line : lines.lines) sizes.push_back(line.size_m);
    std::ranges::nth_element(sizes, sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2));
    EXPECT_NEAR(sizes[sizes.size() / 2], 1e4, 200.0) << degrees;
  }
}

// Floors of 100 km within 100 km of each top, and of 1 km elsewhere.
class Plateaus final : public SizeField {
 public:
  Plateaus(std::vector<Point> tops, Surface surface) : tops_(std::move(tops)), surface_(surface) {}
  void sample(std::span<const Point> places, std::span<double> sizes) const override {
    std::ranges::transform(places, sizes.begin(), [&](const Point& p) { return isTop(p) ? 1e5 : 1e3; });
  }
  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const double reach = std::sqrt(2.0) * boxes[i].half * shrinkIn(surface_, boxes[i]).high;
      double nearest = kInfinity;
      for (const Point& top : tops_) nearest = std::min(nearest, arcBetween(surface_, boxes[i].centre, top));
      ranges[i] = {nearest + reach < kTop ? 1e5 : 1e3, nearest - reach < kTop ? 1e5 : 1e3};
    }
  }

 private:
  static constexpr double kTop = 1e5;
  bool isTop(const Point& p) const {
    return std::ranges::any_of(tops_, [&](const Point& top) { return arcBetween(surface_, p, top) < kTop; });
  }
  std::vector<Point> tops_;
  Surface surface_;
};

// Areas of high floors: each floor falls with the distance on the ground, wherever it is.
TEST_F(OceanPlanet, FloorsFallWithTheDistanceOnTheGround) {
  const Domain sea = domain();
  const std::vector<Point> tops = {{-60.0, -30.0}, {120.0, 12.0}, {30.0, 60.0}};
  std::vector<Point> in_plane;
  for (const Point& top : tops) in_plane.push_back(projection_.forward(top));
  double reach = 0.0;
  for (const Point& p : sea.pslg.points) reach = std::max({reach, std::abs(p.x), std::abs(p.y)});
  const SizeBox root{{0.0, 0.0}, 1.01 * reach};
  const DomainMask mask(sea.pslg, root, surface_);
  const SizeFloor floor(std::make_unique<Plateaus>(in_plane, surface_), 0.2, 1e3, scale(), root, mask, inOrder,
                        surface_);
  std::mt19937_64 random(3);
  for (int i = 0; i < 500; ++i) {
    const std::size_t near = static_cast<std::size_t>(i) % tops.size();
    const Point p = away(tops[near], uniform(random, 0.0, 360.0), uniform(random, 0.0, 8e5));
    const Point place = projection_.forward(p);
    double wanted = 1e3;
    for (const Point& top : tops) wanted = std::max(wanted, 1e5 - 0.2 * std::max(0.0, metresBetween(p, top) - 1e5));
    double is = 0.0;
    floor.sample(std::span(&place, 1), std::span(&is, 1));
    EXPECT_GE(is, wanted - 1e3);
    EXPECT_LE(is, 1.08 * wanted + 6e3);
    SizeRange range;
    const SizeBox box{place + Point{1e5, -5e4}, 1e5};
    floor.bound(std::span(&box, 1), std::span(&range, 1));
    EXPECT_GE(1.01 * is, range.low);
    EXPECT_LE(0.99 * is, range.high);
  }
}

TEST_F(OceanPlanet, SharesOfSquaresAreThoseOfTheirGround) {
  const Domain sea = domain();
  double reach = 0.0;
  for (const Point& p : sea.pslg.points) reach = std::max({reach, std::abs(p.x), std::abs(p.y)});
  const SizeBox root{{0.0, 0.0}, 1.01 * reach};
  const DomainMask mask(sea.pslg, root, surface_), in_plane(sea.pslg, root);
  const double radius = surface_.radius(), corner = areaOn(surface_, root);
  const auto cap = [&](double metres) {
    return 2.0 * std::numbers::pi * radius * radius * (1.0 - std::cos(metres / radius));
  };
  const double wet = 4.0 * std::numbers::pi * radius * radius - cap(kContinent) - 5.0 * cap(kIsland);
  EXPECT_NEAR(mask.share(root), wet / corner, 0.005);
  EXPECT_LT(in_plane.share(root), 0.8) << "of the plane's area much less";
}

TEST_F(OceanPlanet, ChosenSizesAreAShareOfTheEarth) {
  SizeOptions options;
  options.choose = true;
  const Domain sea = domain();
  const SizeOptions chosen = chooseSizes(options, {}, sea, inOrder);
  EXPECT_GT(chosen.most_m, 0.5 * std::sqrt(5.1e14) / 20.0);
  EXPECT_LT(chosen.most_m, 1.5 * std::sqrt(5.1e14) / 20.0);
}

TEST_F(OceanPlanet, NodesSizesAreMetres) {
  const Domain sea = domain();
  const TriMesh mesh = constrainedDelaunay(sea.pslg);
  // A constant size; and sizes that are too steep, which are reduced along edges by their length on the ground.
  const auto measure = [&](VertexId v) { return projection_.measureAt(mesh.points[v]); };
  for (const double s : nodeSizes(mesh, ConstantSize(1e5), 0.2, measure, surface_)) EXPECT_NEAR(s, 1e5, 500.0);
  class Steep final : public SizeFunction {
   public:
    explicit Steep(Point foot) : foot_(foot) {}
    double at(const Point& x) const override { return x == foot_ ? 1e3 : 1e7; }
    double least() const override { return 1e3; }
    double most() const override { return 1e7; }

   private:
    Point foot_;
  };
  const std::vector<double> sizes = nodeSizes(mesh, Steep(mesh.points.front()), 0.2, measure, surface_);
  for (const Triangle& t : mesh.triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      const VertexId a = t.v[i], b = t.v[(i + 1) % 3];
      const double metres = metresBetween(projection_.inverse(mesh.points[a]), projection_.inverse(mesh.points[b]));
      EXPECT_LE(std::abs(sizes[a] - sizes[b]), 0.2 * metres * 1.001);
    }
  }
}

// Shores with corners every 80 to 220 km follow sizes of 300 km, wherever they are.
TEST_F(OceanPlanet, ShoresFollowSizesOfTheGround) {
  Domain sea = domain();
  const Coastline coastline = coastlineOf({polygonFeature(1, circle(middle_, kContinent, 72))}, wgs84());
  CleanReport report;
  const Domain followed = followSizes(std::move(sea), ConstantSize(3e5), {}, coastline, report);
  std::vector<double> lengths;
  for (const Segment& s : followed.pslg.segments)
    lengths.push_back(metresBetween(followed.input_points[s.a], followed.input_points[s.b]));
  ASSERT_GT(lengths.size(), 40u) << "the continent and five islands";
  for (const double length : lengths) {
    EXPECT_GT(length, 0.5 * 3e5);
    EXPECT_LT(length, 1.6 * 3e5);
  }
}

}  // namespace
}  // namespace coastmesh
