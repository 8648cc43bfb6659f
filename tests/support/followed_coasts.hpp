#pragma once

#include <cstddef>
#include <vector>

#include "gis/clean/clean.hpp"
#include "gis/follow/coast_follow.hpp"

namespace coastmesh {

// Small coasts for tests of coasts that follow sizes, and measures of the results.

Coastline oneFeature();

// Adds a regular polygon with odd vertices moved outward by the share `wiggle`.
void addRing(Domain& domain, const Point& centre, double radius, int points, bool is_island, double wiggle = 0.0);

// Adds a ring of shore: counter-clockwise around water, clockwise around an island.
void addShore(Domain& domain, const std::vector<Point>& ring);

// Two square lakes with sides of 20, joined by a channel 10 long and `width` wide.
Domain twoLakes(double width);

std::size_t countOf(const CleanReport& report, EditKind kind);

double areaOf(const Domain& domain);

// Adds the notes and warnings on waters to the report, as after the only group of features.
void addWaterNotes(CleanReport& report, const FollowOptions& options);

// The number of connected waters.
std::size_t parts(const Domain& domain);

// The smallest distance between a segment and a vertex that is not one of its ends.
double leastApart(const Domain& domain);

}  // namespace coastmesh
