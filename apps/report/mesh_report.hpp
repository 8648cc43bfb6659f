#pragma once

#include <string>
#include <vector>

#include "apps/job/mesh_job.hpp"

namespace coastmesh {

// The names that --algorithm and --quality take, in the order of `Algorithm` and `QualityGoal`.
inline constexpr const char* kAlgorithmNames[] = {"circumcenter", "offcenter", "optimal", "relocate"};
inline constexpr const char* kGoalNames[] = {"shape", "centred", "links"};

// The report of a job as JSON text, its keys as documented in apps/README.md. `threads`: number that the job ran on;
// `warnings`: all of the run.
std::string meshReport(const MeshJob& job, const MeshJobResult& result, int threads,
                       const std::vector<std::string>& warnings);

// A few lines for people.
std::string meshSummary(const MeshJob& job, const MeshJobResult& result);

std::string digestText(std::uint64_t digest);  // 16 hexadecimal digits

}  // namespace coastmesh
