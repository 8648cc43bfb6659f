#pragma once

#include <string>

#include "apps/python/mesh_result.hpp"

namespace coastmesh {

// A result as bytes, for Python's pickle, and back: the same bits. Throws InputError for bytes of another version, or
// damaged ones.
std::string bytesOf(const MeshResult& result);
MeshResult resultOf(const std::string& bytes);

}  // namespace coastmesh
