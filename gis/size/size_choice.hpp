#pragma once

#include <string>

#include "gis/size/size_source.hpp"

namespace coastmesh {

// Sizes for whoever asks for none: the size at the shore such that a mesh of some 30,000 vertices is to be expected, 20
// elements of the largest size across the domain. Both are rounded, so that options say them: what `options` tell
// besides (wavelengths, time step, gradation) stays as it is. Throws as `makeSizeFunction` does.
SizeOptions chooseSizes(const SizeOptions& options, const SizeInputs& inputs, const Domain& domain,
                        const ItemLoop& loop);

// As they are given at the command line: "--size-shore 1200 --size-max 40000 --grade 0.2 ...".
std::string sizesAsOptions(const SizeOptions& options);

}  // namespace coastmesh
