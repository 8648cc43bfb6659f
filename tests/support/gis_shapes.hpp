#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// Features and random shapes for tests of gis.

Feature polygonFeature(std::int64_t fid, Ring outer, std::vector<Ring> holes = {});
Feature lineFeature(std::int64_t fid, std::vector<Point> line);
Coastline coastlineOf(std::vector<Feature> features, Crs crs = {});
std::vector<std::size_t> allMembers(const Coastline& coastline);

Ring square(double x, double y, double side);  // counter-clockwise from its lower left corner
// A simple ring around a centre, with radii from half of `radius` to all of it.
Ring starRing(std::mt19937_64& random, const Point& centre, double radius, std::size_t n);
// Uniform points in the unit square, joined in the order drawn: the ring has many self-intersections.
Ring tangledRing(std::mt19937_64& random, std::size_t n);
// The same with points on a grid of `cells` by `cells`: repeated points, spikes, overlaps, touches.
Ring gridRing(std::mt19937_64& random, std::size_t n, int cells);

}  // namespace coastmesh
