#pragma once

#include "apps/job/job_input.hpp"
#include "apps/usage/option_table.hpp"

namespace coastmesh {

// Declares the options that say how an input becomes domains of the plane: --crs, --snap, --simplify,
// --min-island-area.
void declareInputOptions(OptionTable& table, InputOptions& options);

// --surface; apart, since files are measured on one too.
void declareSurface(OptionTable& table, SurfaceChoice& surface);
// Once all is set: the surface that models among the targets need, where the user chose none.
void chooseSurface(const std::vector<std::string>& targets, SurfaceChoice& surface);

// --pinches; apart, since `check` means something else by it.
void declarePinches(OptionTable& table, InputOptions& options);
void declarePinches(OptionTable& table, const OptionNames& names, const std::string& help, InputOptions& options);

}  // namespace coastmesh
