#pragma once

#include <cstdint>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "core/pslg.hpp"

namespace coastmesh {

// Planar straight-line graphs for tests of the core: each an input that is easy to get wrong. All fit in a box of a
// few units round the origin. What is random comes from a seed and is the same on every machine.

// Uniform in [low, high).
double uniform(std::mt19937_64& random, double low, double high);

Pslg squarePslg();                        // one region, sides of length 1, no labels
Pslg squareWithHole();                    // the middle ninth taken out, by a hole point
Pslg randomPoints(unsigned seed, int n);  // no segments: the domain is the convex hull
Pslg randomPointsInBox(unsigned seed, int n);
Pslg nearDuplicates(unsigned seed, int pairs);  // pairs of points a billionth of the box apart
Pslg starPolygon(unsigned seed, int n);
// A hexagon whose sides are broken up `levels` times into four (6 * 4^levels points), and such islands, one level
// less, in its middle.
Pslg fractalCoast(unsigned seed, int levels, int islands);
Pslg combPolygon(int teeth);                   // teeth ten times as high as wide
Pslg fanOfAngles(int rays, double angle_deg);  // rays of uneven length from one vertex, `angle_deg` apart, in a box
Pslg nestedRings();                            // a hole, in it an island with a hole of its own
Pslg touchingHoles();              // two holes with one vertex in common, a third that touches the outer ring
Pslg collinearRuns();              // sides broken up by vertices at uneven distances
Pslg narrowChannel(double width);  // two basins of size 1 and a channel between them
Pslg openLines();                  // lines that end inside the domain, single and joined
Pslg twoRegions();                 // labels 0 and 1 with a bent border

Pslg scaled(Pslg pslg, double factor);
Pslg moved(Pslg pslg, const Point& by);
Pslg turned(Pslg pslg, double angle_deg);  // about the origin

// The least distance between two points, or from a point to a segment that does not end there.
double smallestSpacing(const Pslg& pslg);

struct NamedPslg {
  std::string name;
  Pslg pslg;
};
void PrintTo(const NamedPslg& named, std::ostream* out);

// One or more of each kind, some hundred points at most.
std::vector<NamedPslg> assortedPslgs();
// A name that GoogleTest takes.
std::string nameOf(const NamedPslg& named);

}  // namespace coastmesh
