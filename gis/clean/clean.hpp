#pragma once

#include <vector>

#include "core/item_loop.hpp"
#include "gis/clean/clean_options.hpp"
#include "gis/clean/clean_report.hpp"
#include "gis/clean/domain.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/error.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// Projects and cleans `coastline.features[members]`, each feature by its use. The inside of a polygon is even-odd over
// the rings of its feature; where two features overlap, the first one applies. Open lines inside become segments with
// the same label on both sides; those outside are dropped. If longitudes span exactly 360 degrees and the projection
// brings the first and the last meridian together, the cut along them is healed. Points of the PSLG are in the order of
// the input, new ones last; a whole globe may have none. Throws NothingWanted; InputError for a group that encloses no
// area, for coasts that do not separate water from land, and for a point that the projection cannot map.
Domain cleanFeatures(const Coastline& coastline, const std::vector<std::size_t>& members, const Projection& projection,
                     const CleanOptions& options, CleanReport& report, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
