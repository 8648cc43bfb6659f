#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "apps/python/mesh_result.hpp"
#include "apps/python/wording.hpp"

namespace coastmesh {

pybind11::list refusalsOf(const MeshResult& result);

// Meshes `files`, or `graph`, a tuple (points, segments, holes), if that is not None. `keywords` are options, see
// setFromKeywords; messages use these names. `texts`: those of the files that are in memory. Runs like
// `runInBackground`. Throws OptionError, InputError. `refusals` of a result without triangles has the reasons; if
// nothing was to be meshed, throws InputError.
MeshResult runFromPython(const pybind11::dict& keywords, const MemoryFiles& texts, std::vector<std::string> files,
                         const pybind11::object& graph, const pybind11::object& progress);

// Rewords a message of the library: options as keywords.
std::string inKeywordsOfMesh(const std::string& message);

// The options as JSON, in the form of `coastmesh mesh --json-usage`.
std::string usageOfMesh();

}  // namespace coastmesh
