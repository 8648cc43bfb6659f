#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/point.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/rivers/plane_river.hpp"

namespace coastmesh {

// The widths of rivers at places on their lines, or close to them.
class RiverWidths {
 public:
  // REQUIRES: `rivers` outlive it.
  explicit RiverWidths(std::span<const PlaneRiver> rivers);

  // That at the nearest place of the line, which is expected within its usual width; else that of the nearer end.
  double at(std::uint32_t line, const Point& place) const;
  double usualOf(std::uint32_t line) const { return rivers_[line].width; }
  // How fast the width may change along the line.
  double slopeOf(std::uint32_t line) const;

 private:
  std::span<const PlaneRiver> rivers_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;  // line and number, of those with widths at their points
  BoxTree tree_;
};

}  // namespace coastmesh
