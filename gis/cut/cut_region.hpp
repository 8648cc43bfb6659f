#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/geometry/box.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// A part of a grid: triangles whose middle is in the box, in a polygon of `within`, and in no polygon of `outside`.
struct CutRegion {
  // West, south, east, north, in the grid's CRS. In degrees, an east less than the west is beyond the antimeridian.
  std::optional<Box> box{};
  // Vector files with polygons or closed lines, in any CRS. A file without a CRS, or for a grid in a plane, is taken to
  // have the grid's coordinates.
  std::vector<std::string> within{}, outside{};

  bool any() const { return box || !within.empty() || !outside.empty(); }
};

// For each triangle: 1 if it is in the region, by its `middleOf`. Edges of polygons are straight in their own CRS, also
// past the antimeridian. Appends remarks about the files to `warnings`. Throws InputError for a file without polygons,
// for one that cannot be transformed, and for a box that only degrees allow.
std::vector<std::uint8_t> trianglesIn(const CutRegion& region, const Grid& grid, std::vector<std::string>& warnings,
                                      const ItemLoop& loop = inOrder);

}  // namespace coastmesh
