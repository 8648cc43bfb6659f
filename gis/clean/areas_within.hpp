#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

// Finds areas that lie in holes of others, as lakes on an island in a lake.
class AreasWithin {
 public:
  // Of all features that are areas.
  explicit AreasWithin(const Coastline& coastline);

  // True if a polygon of another feature than `owner` lies in the ring; it may touch the ring from within, or fill it.
  // REQUIRES: the coastline it was made of, to which features may have been added.
  bool any(const Coastline& coastline, const Ring& hole, std::size_t owner) const;

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> polygons_;  // of which feature, and its number there
  std::vector<Box> boxes_;
  BoxTree tree_;
};

}  // namespace coastmesh
