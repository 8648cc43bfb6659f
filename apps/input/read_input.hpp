#pragma once

#include "apps/input/input_options.hpp"
#include "gis/model/boundary_rules.hpp"

namespace coastmesh {

// Reads all the files of `options`, which must not be a .poly, once; what `files` define about boundaries is added to
// `boundaries`. Throws OptionError, InputError.
// With `by_frame`, features far outside a box may be left out, which framing would exclude.
Coastline readInput(const InputOptions& options, ReadReport& report, BoundaryRules& boundaries, bool by_frame = false);

// Throws InputError if the mesh would be clockwise in the coordinates that it is written in: those of the input mirror
// the ground, or `options.crs` mirrors them.
void requireUnmirrored(const Coastline& coastline, const InputOptions& options);

}  // namespace coastmesh
