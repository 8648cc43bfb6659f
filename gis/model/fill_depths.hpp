#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Each fills values at the nodes of a grid, NaN where unknown; those made of others are `rounded`.

// Sets unknown values so that each is the mean of its neighbours, as smooth as a membrane between the known nodes.
// Returns the number of nodes filled; connected parts of the mesh without a known node are unchanged.
std::size_t fillFromNeighbours(const Grid& grid, std::vector<double>& values, double (*rounded)(double),
                               const ItemLoop& loop = inOrder);

// Sets unknown values to that of the nearest known node along the mesh's edges. Returns the number of nodes filled.
std::size_t fillFromNearest(const Grid& grid, std::vector<double>& values, const ItemLoop& loop = inOrder);

// Sets unknown values to that of the nearest known node in space: for waters without any, which the above leave
// unchanged. Returns the nodes filled, ascending; none if nothing is known.
std::vector<std::uint32_t> fillWatersApart(const Grid& grid, std::vector<double>& values);

// The same for depths.
std::size_t fillFromNeighbours(Grid& grid, const ItemLoop& loop = inOrder);
std::size_t fillFromNearest(Grid& grid, const ItemLoop& loop = inOrder);
std::vector<std::uint32_t> fillWatersApart(Grid& grid);

}  // namespace coastmesh
