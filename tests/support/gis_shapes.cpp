#include "tests/support/gis_shapes.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

namespace coastmesh {

Feature polygonFeature(std::int64_t fid, Ring outer, std::vector<Ring> holes) {
  Feature feature;
  feature.fid = fid;
  feature.source = "test";
  feature.polygons.push_back({std::move(outer), std::move(holes)});
  return feature;
}

Feature lineFeature(std::int64_t fid, std::vector<Point> line) {
  Feature feature;
  feature.fid = fid;
  feature.source = "test";
  feature.lines.push_back(std::move(line));
  return feature;
}

Coastline coastlineOf(std::vector<Feature> features, Crs crs) {
  return {std::move(features), std::move(crs), std::nullopt, {}};
}

std::vector<std::size_t> allMembers(const Coastline& coastline) {
  std::vector<std::size_t> members(coastline.features.size());
  std::iota(members.begin(), members.end(), std::size_t{0});
  return members;
}

Ring square(double x, double y, double side) { return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}; }

Ring starRing(std::mt19937_64& random, const Point& centre, double radius, std::size_t n) {
  std::uniform_real_distribution<double> factor(0.5, 1.0);
  Ring ring;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    const double r = radius * factor(random);
    ring.push_back({centre.x + r * std::cos(angle), centre.y + r * std::sin(angle)});
  }
  return ring;
}

Ring tangledRing(std::mt19937_64& random, std::size_t n) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Ring ring;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = unit(random), y = unit(random);
    ring.push_back({x, y});
  }
  return ring;
}

Ring gridRing(std::mt19937_64& random, std::size_t n, int cells) {
  std::uniform_int_distribution<int> cell(0, cells - 1);
  Ring ring;
  for (std::size_t i = 0; i < n; ++i) {
    const int x = cell(random), y = cell(random);
    ring.push_back({static_cast<double>(x), static_cast<double>(y)});
  }
  return ring;
}

}  // namespace coastmesh
