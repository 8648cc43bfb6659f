#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/input/job_input.hpp"
#include "apps/usage/option_table.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

// Declares the options on reading, the domain, cleaning and the working plane: from --layer to --crs.
void declareInputOptions(OptionTable& table, InputOptions& options);

// Stores the sides of a --bbox, as an `OptionTable::StoreNumbers`. W may be more than E: in degrees such a box lies
// across the antimeridian.
std::string storeBox(const std::vector<double>& sides, std::optional<Box>& box);

// --surface; separate, since commands on meshes have it too.
void declareSurface(OptionTable& table, SurfaceChoice& surface);
// To be called once all is set: chooses the surface that target models need, unless the user chose one.
void chooseSurface(const std::vector<std::string>& targets, SurfaceChoice& surface);

// --pinches; separate, since it has another meaning in `check`.
void declarePinches(OptionTable& table, InputOptions& options);
void declarePinches(OptionTable& table, const OptionNames& names, const std::string& help, InputOptions& options);

}  // namespace coastmesh
