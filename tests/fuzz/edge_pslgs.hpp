#pragma once

#include "core/pslg.hpp"
#include "tests/fuzz/choices.hpp"
#include "tests/fuzz/placement.hpp"

namespace coastmesh {

// Random points (on a small grid, on a circle, on lines, in clusters, near-duplicates from 1 ulp to 1e-3 apart) and
// some edges of their Delaunay triangulation, so that nothing crosses. Either unlabelled, with hole points, or labelled
// from regions drawn for the triangles, which gives islands, pinches and touching holes.
Pslg edgePslg(Choices& choices, const Placement& placement);

}  // namespace coastmesh
