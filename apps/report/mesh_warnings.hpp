#pragma once

#include <string>
#include <vector>

#include "apps/job/mesh_job.hpp"

namespace coastmesh {

// What a job warns of, a sentence each: what is odd in the input, what could not be done for depths and models,
// triangles turned over on the ground, what was left out. Where nothing was meshed and there is one reason, that is the
// error to come and not among them.
std::vector<std::string> warningsOf(const MeshJobResult& result);

}  // namespace coastmesh
