#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <string>
#include <vector>

#include "apps/python/mesh_result.hpp"

namespace coastmesh {

// What a function that changes a mesh is called with.
struct EditArguments {
  pybind11::dict keywords;                                // options, see setFromKeywords; messages use these names
  std::map<std::string, std::vector<std::string>> texts;  // by keyword: GeoJSON as further files of such an option
  pybind11::object mesh;                                  // a MeshResult, or a path as bytes
  pybind11::object progress;
};

// Lines that a function reads.
struct GivenLines {
  std::vector<std::string> paths, texts;  // files and GeoJSON
};

// The functions `cut`, `remesh`, `merge` and `rivers`: what the commands of these names do, but for writing. They run
// like `runInBackground`. Throw OptionError, InputError.
MeshResult cutFromPython(const EditArguments& given);
MeshResult remeshFromPython(const EditArguments& given);
// `inserted`: as EditArguments::mesh, with a name for messages.
MeshResult mergeFromPython(const EditArguments& given, const pybind11::list& inserted);
MeshResult riversFromPython(const EditArguments& given, const GivenLines& given_lines);

// A mesh from a file. `crs`: that of a file without one, as for the keyword assume_crs. Throws OptionError, InputError.
MeshResult readFromPython(const std::string& path, const pybind11::object& crs);

// The options as JSON, in the form of --json-usage.
std::string usageOfCut();
std::string usageOfRemesh();
std::string usageOfMerge();
std::string usageOfRivers();

}  // namespace coastmesh
