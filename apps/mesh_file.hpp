#pragma once

#include <string>

#include "apps/command_line.hpp"
#include "gis/grid.hpp"

namespace coastmesh {

// A mesh file named on the command line.
struct MeshFile {
  std::string path;
  std::string crs;  // taken where the file does not tell; empty then means a plane
};

// Declares the argument `name` and the option --assume-crs.
void declareMeshFile(CommandLine& line, const std::string& name, const std::string& help, MeshFile& file);

// Throws InputError, also for a mesh without triangles.
Grid readMeshFile(const MeshFile& file);

}  // namespace coastmesh
