#pragma once

#include "gis/clean/domain.hpp"

namespace coastmesh {

// Takes the coast between the water and a flood plain out of the PSLG, with its points that nothing else needs, and
// keeps it as `Domain::coast`. For shores that follow sizes: both banks of each creek as lines, within an element of
// one another, would make the mesh's triangles as small as those of the data.
void takeOutCoast(Domain& domain);

}  // namespace coastmesh
