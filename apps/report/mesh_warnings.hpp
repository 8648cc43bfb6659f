#pragma once

#include <string>
#include <vector>

#include "apps/job/mesh_job.hpp"

namespace coastmesh {

// The warnings of a job, one sentence each: oddities of the input, what could not be done for depths and models,
// triangles that are not counter-clockwise on the ground, groups left out. If nothing was meshed and there is a single
// reason, that becomes the error and is not included.
std::vector<std::string> warningsOf(const MeshJobResult& result);

// The notes for a summary, each a line: the first of them if there are many, since each of thousands of lakes may have
// some.
std::string shownNotes(const std::vector<std::string>& notes);

}  // namespace coastmesh
