#pragma once

#include "gis/shore/shore_chains.hpp"

namespace coastmesh {

// Removes vertices of boundaries, the least important first, until segments are about as long as the size wanted.
// Shores move by at most a quarter of the size, or nearly half of it if segments are much shorter; open boundaries by a
// hundredth. A vertex is removed only if its triangle with its neighbours contains no other, so that nothing crosses,
// and if the segment that replaces it comes no nearer to other vertices than half the size, or than what it replaces,
// and makes no small angle in the water. At last, land that is narrower may become narrower still where segments are
// much shorter than the size.
void coarsenShores(ShoreChains& chains, const ShoreLoss& gone);

}  // namespace coastmesh
