#pragma once

#include <cstdint>
#include <string>

#include "core/pslg.hpp"

namespace coastmesh {

// What a .poly has that is not meshed.
struct PolyExtras {
  bool attributes = false;    // of points
  bool markers = false;       // of segments: a user's other than 1, which Triangle gives to all at the edge
  std::uint64_t regions = 0;  // with an attribute or a limit of areas
};

// "2 regions with their attributes and limits of areas, markers of segments"; empty if there is nothing.
std::string textOf(const PolyExtras& extras);

// Reads Triangle's .poly (with its .node beside it if the vertex count is 0), numbered from 0 or 1, with comments,
// markers and hole points. `ignored` gets what is ignored, unless it is null. Segments are unlabelled; cleaning is left
// to the caller. Throws InputError with file and line.
Pslg readPoly(const std::string& path, PolyExtras* ignored = nullptr);

// Coordinates are read back bit for bit. The format has no labels: a face inside that they exclude from the domain gets
// a hole point. Throws OutputError.
void writePoly(const Pslg& pslg, const std::string& path);

}  // namespace coastmesh
