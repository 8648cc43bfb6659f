#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gis/rivers/plane_river.hpp"

namespace coastmesh {

// A part of a line that no wider river holds.
struct RiverPiece {
  PlaneRiver river;
  std::uint32_t line = 0;
};

// The parts of each line that are not within half a width of a wider one, of the earlier of equally wide ones: these
// are that river's own water. Each part goes on into it by up to a quarter of its own width, to be joined there. What
// goes on from the end of a line is not within it. Lines without any part, as those given twice, have no piece.
std::vector<RiverPiece> piecesOf(std::span<const PlaneRiver> rivers);

}  // namespace coastmesh
