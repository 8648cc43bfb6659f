#pragma once

#include "core/pslg.hpp"
#include "tests/fuzz/choices.hpp"
#include "tests/fuzz/placement.hpp"

namespace coastmesh {

// Random points (on a small grid, on a circle, in clusters, near-duplicates from 1 ulp to 1e-3 apart) and some edges of
// their Delaunay triangulation, so that nothing crosses. Either unlabelled, with hole points, or labelled by what
// triangles were drawn into which region: then islands, pinches and touching holes come by themselves.
Pslg edgePslg(Choices& choices, const Placement& placement);

}  // namespace coastmesh
