#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

// The position of a point relative to rings, by the even-odd rule.
enum class Location { Outside, Boundary, Inside };

// True if the closed segments ab and cd share a point; exact.
bool segmentsMeet(const Point& a, const Point& b, const Point& c, const Point& d);

// Closed rings or open chains, indexed by their edges.
class ChainIndex {
 public:
  enum class Kind { Rings, OpenLines };

  explicit ChainIndex(Kind kind) : kind_(kind) {}
  // Chains of less than two points are dropped. Call `build` after the last.
  void add(std::span<const Point> chain);
  void build();

  std::size_t edgeCount() const { return chain_of_.size(); }
  std::size_t chainCount() const { return chain_begin_.size(); }
  Box bounds() const { return tree_.bounds(); }
  const Point& start(std::size_t edge) const { return points_[edge + chain_of_[edge]]; }
  const Point& end(std::size_t edge) const { return points_[edge + chain_of_[edge] + 1]; }
  std::uint32_t chainOf(std::size_t edge) const { return chain_of_[edge]; }
  const Point& chainStart(std::size_t chain) const { return points_[chain_begin_[chain]]; }

  // Calls `found(edge)` for every edge whose box meets `box`.
  template <typename Found>
  void visit(const Box& box, Found&& found) const {
    tree_.visit(box, found);
  }
  // The position of `p`; exact; rings may cross themselves and one another. REQUIRES: Kind::Rings.
  Location locate(const Point& p) const;

 private:
  Kind kind_;
  std::vector<Point> points_;             // chain after chain; a ring's first point is repeated at its end
  std::vector<std::size_t> chain_begin_;  // first point of each chain
  std::vector<std::uint32_t> chain_of_;   // by edge
  BoxTree tree_;                          // over the edges
};

}  // namespace coastmesh
