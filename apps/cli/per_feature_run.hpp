#pragma once

#include "apps/cli/mesh_run.hpp"

namespace coastmesh {

// Declares --per-feature and --name-field.
void declarePerFeature(OptionTable& table, MeshRunUsage& usage);

// Meshes each feature of the input alone, into its own files, named like the outputs with the feature's name in place
// of "{}". The files of a feature are moved into place together, as soon as they are made. A feature that cannot be
// meshed causes a warning, and the others are meshed. REQUIRES: `usage.mesh` is settled. Returns an exit code; main
// turns its exceptions into messages and codes.
int runPerFeature(const MeshRunUsage& usage, Run& run);

}  // namespace coastmesh
