#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// Places triangles and lines that cross the end of the longitudes, or reach a pole, on a map of longitudes and
// latitudes: cuts them where the longitudes end, as RFC 7946 requires, and leads triangles along the map's edge at a
// pole, which is a line there.
class MapCutter {
 public:
  // REQUIRES: `grid` outlives it. Longitudes end outside the range of the nodes: at 180, else at 0 degrees if possible,
  // else in the middle of the gap. If the nodes span more than a turn, or less than half a turn without a pole, nothing
  // is cut.
  explicit MapCutter(const Grid& grid);

  // True if the triangle on the map is not its corners joined by straight lines.
  bool cuts(const std::array<std::uint32_t, 3>& corners) const;
  bool cutsAny() const;

  using Ring = std::vector<Point>;  // does not repeat its first point; oriented like the triangle
  // The triangle's parts on the map, or itself if nothing is cut; its corners keep the bits of the nodes. Points on a
  // cutting meridian lie on the great circle between two nodes, and are the same for both triangles at that edge.
  std::vector<Ring> partsOf(const std::array<std::uint32_t, 3>& corners) const;

  // The same for a line along nodes.
  bool cutsLine(std::span<const std::uint32_t> nodes) const;
  // Its parts, in its direction; one part if nothing is cut. A part ends where the next one begins on the ground: at
  // the map's end, at the same latitude a turn away, or at a pole. No part runs along the pole's line.
  std::vector<std::vector<Point>> partsOfLine(std::span<const std::uint32_t> nodes) const;

 private:
  const Grid& grid_;
  std::optional<double> end_;  // the largest longitude of the map; nullopt: nothing is cut
};

}  // namespace coastmesh
