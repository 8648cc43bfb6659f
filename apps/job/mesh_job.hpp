#pragma once

#include "apps/job/mesh_job_options.hpp"
#include "apps/job/mesh_job_result.hpp"

namespace coastmesh {

// Reads, projects, cleans, meshes, checks and finishes. Nothing but `seconds` depends on the number of threads. Throws
// InputError, Cancelled, BadMesh.
MeshJobResult runMeshJob(const MeshJob& job, const JobControl& control = {});

// The same on the threads at hand, for jobs that are done side by side: to be called within `withThreads`. Jobs that
// read files are not to be done so, as libraries that read some formats cannot.
MeshJobResult runMeshJobHere(const MeshJob& job, const JobControl& control = {});

}  // namespace coastmesh
