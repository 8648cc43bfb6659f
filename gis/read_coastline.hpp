#pragma once

#include <string>
#include <vector>

#include "gis/coastline.hpp"

namespace coastmesh {

// Reads every vector layer of every source that OGR opens. Polygons become polygons; lines are joined end to end
// (bit-equal ends) over all sources, closed ones become polygons by even-odd nesting, open ones stay lines. All sources
// are brought to the CRS of the first. Empty and null geometries are skipped and counted. Throws InputError: no such
// file, empty file, no vector file, no polygon or line in it, a coordinate that is not finite (with fid and position),
// CRS that do not go together.
struct ReadReport {
  std::uint64_t features = 0;
  std::uint64_t points = 0;
  std::uint64_t rings = 0;
  std::uint64_t skipped_empty = 0;
  std::uint64_t skipped_points = 0;  // point features: nothing to mesh in them
  std::vector<std::string> warnings;
};
Coastline readCoastline(const std::vector<std::string>& sources, ReadReport& report);

// Features that touch, cross or contain one another have to be meshed as one. Every feature is in one group; members
// ascend, groups are ordered by their first member.
std::vector<std::vector<std::size_t>> groupFeatures(const Coastline& coastline);

}  // namespace coastmesh
