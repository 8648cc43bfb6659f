#pragma once

#include <string>

#include "gis/size/size_source.hpp"

namespace coastmesh {

// Sizes for users who give none: a size at the shore for which a mesh of about 30,000 vertices is expected, 20 elements
// of the largest size across the domain. Both are rounded, to be written as options; the other `options` (wavelengths,
// time step, gradation) are unchanged. Throws like `makeSizeFunction`.
SizeOptions chooseSizes(const SizeOptions& options, const SizeInputs& inputs, const Domain& domain,
                        const ItemLoop& loop);

// As given on the command line: "--size-shore 1200 --size-max 40000 --grade 0.2 ...".
std::string sizesAsOptions(const SizeOptions& options);

}  // namespace coastmesh
