#pragma once

#include <pybind11/pybind11.h>

#include <functional>

#include "apps/job/mesh_job_options.hpp"

namespace coastmesh {

// Runs `work` on a thread of its own, without the GIL, which it must not take; calls `progress(phase, share)`, unless
// that is None, and handles signals in the caller's thread. What either raises ends the work and is raised again, as is
// what the work throws.
void runInBackground(const std::function<void(const JobControl& control)>& work, const pybind11::object& progress);

}  // namespace coastmesh
