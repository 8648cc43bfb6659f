#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "core/refine/refine_options.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"
#include "gis/rivers/mesh_water.hpp"
#include "gis/rivers/river_junctions.hpp"
#include "gis/rivers/river_lines.hpp"
#include "gis/rivers/river_plane.hpp"
#include "gis/rivers/river_rows.hpp"

namespace coastmesh {

// What is to become a grid.
struct RiverParts {
  std::span<const RiverRows> rows;                     // of each reach; those without sections are not there
  std::span<const std::vector<std::uint8_t>> has_row;  // of each reach: a flag for each of its rows
  std::span<const RiverJunction> junctions;            // all of whose branches have rows
  std::span<const std::uint8_t> is_free;  // of each reach: 1 if it begins, 2 if it ends at a free end, 3 both
};

struct RiverGrid {
  Grid grid;
  // The nodes across each free end, from bank to bank, with the river to the left.
  std::vector<std::vector<std::uint32_t>> ends;
  std::vector<std::string> end_names;  // of the river at each; empty: none
  // Triangles at junctions that miss the bound on angles, since edges of quadrilaterals leave no room.
  std::size_t below = 0;
  double least_angle_deg = 180.0;  // of them
  Point least_place;               // in the mesh's CRS
};

// The rows and junctions as a grid without boundaries; its features are the lines. `triangle_options`: of junctions.
// `sizes`: set the requested length of each node, the mean of the sides of its cells.
RiverGrid riverGrid(const RiverParts& parts, const std::vector<RiverLine>& lines, const RiverPlane& plane,
                    const Crs& crs, const RefineOptions& triangle_options, bool sizes, const ItemLoop& loop = inOrder);

// A free end within the land of the mesh, where there is no edge for a boundary.
struct LandEnd {
  std::string name;  // of the river; empty: none
  Point place;       // in the mesh's CRS
};

struct RiverEnds {
  std::size_t inflows = 0;  // river boundaries
  std::vector<LandEnd> on_land;
};

// Sets the boundaries of such a grid: free ends without water of the mesh beyond are rivers, other edges that touch
// that water are open, all others are land. Rivers get their names.
RiverEnds setRiverBoundaries(RiverGrid& rivers, const MeshWater& water, const RiverPlane& plane);

}  // namespace coastmesh
