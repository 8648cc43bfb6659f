#pragma once

#include "core/pslg.hpp"
#include "tests/fuzz/choices.hpp"

namespace coastmesh {

// Inputs made of rings and rays, about 1 in size. Few intersect themselves.

// Star-shaped rings inside one another, some of which touch at a vertex: alternately sea, island and lake.
Pslg nestedStars(Choices& choices);

// Rays from one point at angles down to a millionth of a degree: lines in a box, or spikes joined to a ring.
Pslg tinyAngles(Choices& choices);

// Combs, spirals and channels down to a thousandth of their length in width.
Pslg narrowStrip(Choices& choices);

// A polygon whose sides are broken up by vertices at uneven distances, down to 1e-9 of the side.
Pslg brokenSides(Choices& choices);

}  // namespace coastmesh
