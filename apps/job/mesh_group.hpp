#pragma once

#include "apps/job/group_task.hpp"

namespace coastmesh {

// Projects, cleans, meshes and checks a group. Reasons why it cannot be meshed go to `refusal`. Sizes that require many
// more vertices than there is room for are refused before meshing. Throws Cancelled, BadMesh, BadCheckpoint, and what
// the job's exchange throws.
GroupResult meshGroup(const MeshJob& job, const JobInput& input, const SizeInputs& sizes, std::size_t group,
                      const GroupRoom& room, const RunControl& control);

}  // namespace coastmesh
