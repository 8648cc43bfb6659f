#pragma once

#include <cstddef>
#include <vector>

#include "gis/clean/clean.hpp"
#include "gis/follow/coast_follow.hpp"

namespace coastmesh {

// Small coasts for tests of what follows them, by their shapes, and what is measured of the result.

Coastline oneFeature();

// A regular polygon, its odd vertices farther out by the share `wiggle`.
void addRing(Domain& domain, const Point& centre, double radius, int points, bool is_island, double wiggle = 0.0);

// A ring of shore round water, counter-clockwise, or round an island, clockwise.
void addShore(Domain& domain, const std::vector<Point>& ring);

// Two square lakes of side 20 with a channel between them, 10 long and so wide.
Domain twoLakes(double width);

std::size_t countOf(const CleanReport& report, EditKind kind);

double areaOf(const Domain& domain);

// Adds the sentences on waters to the report's notes and warnings, as after the only group of features.
void addWaterNotes(CleanReport& report, const FollowOptions& options);

// How many waters there are that nothing joins.
std::size_t parts(const Domain& domain);

// The least distance of a segment from a vertex that is not its own.
double leastApart(const Domain& domain);

}  // namespace coastmesh
