#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <vector>

#include "apps/job/mesh_job.hpp"

namespace coastmesh {

// What a run leaves behind; the arrays that Python sees lie in `grid`.
struct MeshResult {
  Grid grid;
  std::string report;  // JSON, as --report writes it; empty for a mesh that was read
  std::vector<std::string> warnings;
  std::vector<Refusal> refusals;
  bool complete = true;
};

pybind11::list refusalsOf(const MeshResult& result);

// Meshes what it reads from `files`, from `text` (GeoJSON), or from `graph`, a tuple (points, segments, holes), where
// that is not None. `keywords` are options: see setFromKeywords; messages name them so. The work is done on threads of
// its own, without Python's lock; `progress(phase, share)` is called, and signals are handled, in the caller's thread.
// What either raises ends the run and is raised again. Throws OptionError, InputError. A result without a triangle says
// in `refusals` why; where nothing was to be meshed that is an InputError.
MeshResult runFromPython(const pybind11::dict& keywords, std::vector<std::string> files,
                         std::optional<std::string> text, const pybind11::object& graph,
                         const pybind11::object& progress);

// The options as JSON, in the form of `coastmesh mesh --json-usage`.
std::string usageOfOptions();

}  // namespace coastmesh
