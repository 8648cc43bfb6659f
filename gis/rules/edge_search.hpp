#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/ids.hpp"
#include "core/item_loop.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/rules/rule_shapes.hpp"

namespace coastmesh {

// A boundary edge that may be near a rule's line or polygon.
struct NearEdge {
  PlacedEdge edge;
  std::optional<std::size_t> rule{};  // the last that applies to it
  std::uint32_t next = kNone;         // the edge after it along the boundary; kNone if that is not near
  BoundaryKind before{};              // its type without rules
};

// The closest edge.
struct Closest {
  std::size_t edge = 0;
  double distance = std::numeric_limits<double>::infinity();
  double share = 0.0;  // of the way from its first end

  bool any() const { return distance < std::numeric_limits<double>::infinity(); }
};

// Finds the edge of the boundary that is closest to a place.
class EdgeSearch {
 public:
  // Keeps references to `edges` and `plane`.
  EdgeSearch(const std::vector<NearEdge>& edges, const RulePlane& plane, const ItemLoop& loop);

  // Of equally close edges the first. `guess`: an edge that may be close, kNone if unknown; it saves time and changes
  // nothing else.
  Closest closestTo(const Point& p, bool outer_only, std::size_t guess = kNone) const;

 private:
  class Query;

  const std::vector<NearEdge>& edges_;
  const RulePlane& plane_;
  BoxTree tree_;
  double edge_size_ = 0.0;  // mean of the edges' boxes
};

}  // namespace coastmesh
