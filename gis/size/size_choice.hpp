#pragma once

#include <string>

#include "gis/size/size_source.hpp"

namespace coastmesh {

// Sizes for users who give none: a size at the shore for which 18,000 to 50,000 vertices are expected, and 20 elements
// of the largest size across the domain. More across it if the shore is too short for so many vertices, or finer sizes
// there not allowed, and one size everywhere if there is no shore. The minimum size of `options` and the time step are
// kept, even if that allows fewer vertices only. Sizes are rounded, to be written as options. Elements per wavelength
// are reduced if the size at the shore does not determine the number of vertices; the other `options` are unchanged.
// `share` of the vertices is for this domain, the others are for the rest of the mesh. Throws like `makeSizeFunction`.
SizeOptions chooseSizes(const SizeOptions& options, const SizeInputs& inputs, const Domain& domain,
                        const ItemLoop& loop, double share = 1.0);

// Three in four segments of the domain's shore are at least this long, metres; 0 if there is no shore.
double shoreSpacing(const Domain& domain);

// As given on the command line, besides the options that were given: "--size-shore 1200 --size-max 40000 ...".
std::string sizesAsOptions(const SizeOptions& options);

}  // namespace coastmesh
