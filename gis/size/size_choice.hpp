#pragma once

#include <string>

#include "gis/size/size_source.hpp"

namespace coastmesh {

// Sizes for users who give none: a size at the shore for which a mesh of 18,000 to 50,000 vertices is expected, 20
// elements of the largest size across the domain; more across it where the shore is too short for so many, and one
// size everywhere where there is none. They are rounded, to be written as options. Elements per wavelength become fewer
// where the shore's size does not decide; the other `options` (time step, gradation) are unchanged. Throws like
// `makeSizeFunction`.
SizeOptions chooseSizes(const SizeOptions& options, const SizeInputs& inputs, const Domain& domain,
                        const ItemLoop& loop);

// As given on the command line: "--size-shore 1200 --size-max 40000 --grade 0.2 ...".
std::string sizesAsOptions(const SizeOptions& options);

}  // namespace coastmesh
