#pragma once

#include <cstdint>
#include <vector>

#include "apps/input/job_input.hpp"
#include "apps/job/group_task.hpp"
#include "apps/job/mesh_job_options.hpp"
#include "apps/job/mesh_job_result.hpp"

namespace coastmesh {

// Meshes this run's groups, or takes them from the job's exchange, and merges them in their order into `result`.
// Returns where each is in its grid. Throws InputError, Cancelled.
std::vector<MergedGroup> meshGroups(const MeshJob& job, const JobInput& input, const SizeInputs& sizes,
                                    const JobControl& control, MeshJobResult& result);

// The digest of a mesh of several groups: theirs in their order.
std::uint64_t combineDigests(std::uint64_t digest, std::uint64_t next);

}  // namespace coastmesh
