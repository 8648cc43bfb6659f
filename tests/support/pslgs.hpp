#pragma once

#include <cstdint>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "core/pslg.hpp"

namespace coastmesh {

// Planar straight-line graphs for tests of the core, each an input that is easy to get wrong. All fit in a box of a few
// units around the origin. Random ones depend on a seed and are the same on every machine.

// Uniform in [low, high).
double uniform(std::mt19937_64& random, double low, double high);

Pslg squarePslg();                        // one region, sides of length 1, no labels
Pslg squareWithHole();                    // with the middle ninth removed by a hole point
Pslg randomPoints(unsigned seed, int n);  // no segments: the domain is the convex hull
Pslg randomPointsInBox(unsigned seed, int n);
Pslg nearDuplicates(unsigned seed, int pairs);  // pairs of points a billionth of the box apart
Pslg starPolygon(unsigned seed, int n);
// A hexagon with sides subdivided `levels` times into four (6 * 4^levels points), and islands of the same kind, one
// level less, in its middle.
Pslg fractalCoast(unsigned seed, int levels, int islands);
Pslg combPolygon(int teeth);                   // teeth ten times as high as wide
Pslg fanOfAngles(int rays, double angle_deg);  // rays of uneven length from one vertex, `angle_deg` apart, in a box
Pslg nestedRings();                            // a hole that contains an island with a hole
Pslg touchingHoles();                          // two holes that share a vertex, and a third that touches the outer ring
Pslg collinearRuns();                          // sides subdivided by vertices at uneven distances
Pslg narrowChannel(double width);              // two basins of size 1 and a channel between them
Pslg openLines();                              // lines that end inside the domain, single and joined
Pslg twoRegions();                             // labels 0 and 1 with a bent border

Pslg scaled(Pslg pslg, double factor);
Pslg moved(Pslg pslg, const Point& by);
Pslg turned(Pslg pslg, double angle_deg);  // about the origin

// The smallest distance between two points, or between a point and a segment that does not end there.
double smallestSpacing(const Pslg& pslg);

struct NamedPslg {
  std::string name;
  Pslg pslg;
};
void PrintTo(const NamedPslg& named, std::ostream* out);

// At least one of each kind, each of at most some hundred points.
std::vector<NamedPslg> assortedPslgs();
// A name valid in GoogleTest.
std::string nameOf(const NamedPslg& named);

}  // namespace coastmesh
