#pragma once

#include <string>

#include "gis/size/size_source.hpp"

namespace coastmesh {

// Sizes for users who give none: a size at the shore for which 18,000 to 50,000 vertices are expected, and 20 elements
// of the largest size across the domain. More across it if the shore is too short for so many vertices, and one size
// everywhere if there is no shore. Sizes are rounded, to be written as options. Elements per wavelength are reduced if
// the size at the shore does not determine the number of vertices; the other `options` (time step, gradation) are
// unchanged. Throws like `makeSizeFunction`.
SizeOptions chooseSizes(const SizeOptions& options, const SizeInputs& inputs, const Domain& domain,
                        const ItemLoop& loop);

// As given on the command line: "--size-shore 1200 --size-max 40000 --grade 0.2 ...".
std::string sizesAsOptions(const SizeOptions& options);

}  // namespace coastmesh
