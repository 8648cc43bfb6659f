#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "apps/python/mesh_result.hpp"
#include "apps/python/wording.hpp"

namespace coastmesh {

// What a function that changes a mesh is called with.
struct EditArguments {
  pybind11::dict keywords;   // options, see setFromKeywords; messages use these names
  const MemoryFiles& texts;  // those of the files that are in memory
  pybind11::object mesh;     // a MeshResult, or a path as bytes
  pybind11::object progress;
};

// The functions `cut`, `remesh`, `merge` and `rivers`: what the commands of these names do, but for writing. They run
// like `runInBackground`. Throw OptionError, InputError.
MeshResult cutFromPython(const EditArguments& given);
MeshResult remeshFromPython(const EditArguments& given);
// `inserted`: as EditArguments::mesh, with a name for messages.
MeshResult mergeFromPython(const EditArguments& given, const pybind11::list& inserted);
MeshResult riversFromPython(const EditArguments& given, const std::vector<std::string>& lines);

// A mesh from a file. `crs`: that of a file without one, as for the keyword assume_crs. Throws OptionError, InputError.
MeshResult readFromPython(const std::string& path, const pybind11::object& crs);

// The options as JSON, in the form of --json-usage.
std::string usageOfCut();
std::string usageOfRemesh();
std::string usageOfMerge();
std::string usageOfRivers();

}  // namespace coastmesh
