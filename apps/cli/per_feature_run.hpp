#pragma once

#include "apps/cli/mesh_run.hpp"

namespace coastmesh {

// Declares --per-feature and --name-field.
void declarePerFeature(OptionTable& table, MeshRunUsage& usage);

// Meshes each feature of the input alone into files of its own, whose names are those of the outputs with the feature's
// name for "{}". Each feature's files come into place as soon as they are made, all of them or none. A feature that
// cannot be meshed is warned of, and the others are made. REQUIRES: `usage.mesh` is settled. Gives an exit code; throws
// what main turns into messages and codes.
int runPerFeature(const MeshRunUsage& usage, Run& run);

}  // namespace coastmesh
