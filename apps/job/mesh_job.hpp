#pragma once

#include "apps/job/mesh_job_options.hpp"
#include "apps/job/mesh_job_result.hpp"

namespace coastmesh {

// Reads, projects, cleans, meshes, checks and finishes. Only `seconds` depends on the number of threads. Throws
// InputError, Cancelled, BadMesh.
MeshJobResult runMeshJob(const MeshJob& job, const JobControl& control = {});

// The same on the available threads, for jobs that run in parallel: to be called within `withThreads`. Jobs that read
// files must not run in parallel, since libraries for some formats do not allow it.
MeshJobResult runMeshJobHere(const MeshJob& job, const JobControl& control = {});

}  // namespace coastmesh
