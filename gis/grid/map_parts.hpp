#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// How triangles and lines that reach over the end of the longitudes, or to a pole, lie on a map of longitudes and
// latitudes: cut where the longitudes end, as RFC 7946 asks; triangles also along the edge where the pole is, which
// is a line there.
class MapCutter {
 public:
  // REQUIRES: `grid` outlives it. Longitudes end where no node lies: at 180 or 0 degrees where that is so there, else
  // in the gap beside them. Where they go round more than once nothing is cut.
  explicit MapCutter(const Grid& grid);

  // Whether the triangle's corners, joined by straight lines, are not what it is on the map.
  bool cuts(const std::array<std::uint32_t, 3>& corners) const;
  bool cutsAny() const;

  using Ring = std::vector<Point>;  // does not repeat its first point; goes round as the triangle does
  // The triangle's parts on the map; its own corners have the bits of the nodes. Where nothing is cut: itself. Where a
  // meridian is met lies on the great circle between two nodes, the same for both triangles at that edge.
  std::vector<Ring> partsOf(const std::array<std::uint32_t, 3>& corners) const;

  // The same for a line along nodes.
  bool cutsLine(std::span<const std::uint32_t> nodes) const;
  // Its parts in its direction. A part ends where the next one begins on the ground: at the map's end, at the same
  // latitude a turn away, or at a pole, where no part runs along the pole's line. One that is cut nowhere is one part.
  std::vector<std::vector<Point>> partsOfLine(std::span<const std::uint32_t> nodes) const;

 private:
  const Grid& grid_;
  std::optional<double> end_;  // the largest longitude of the map; none: nothing is cut
};

}  // namespace coastmesh
