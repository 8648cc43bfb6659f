#pragma once

#include <cstdint>
#include <vector>

#include "core/ids.hpp"
#include "core/point.hpp"

namespace coastmesh {

// Finds points of a growing list by their place: a hash table of square cells.
class PointGrid {
 public:
  // `tolerance`: the largest distance to a point found; 0 finds equal points only. REQUIRES: `points` outlives the
  // grid.
  PointGrid(const std::vector<Point>& points, double tolerance, std::size_t expected_size);

  void add(VertexId v);  // REQUIRES: v is the number of points added before
  // The nearest point added within the tolerance of `p`, the first of equally near ones; kNone if there is none.
  VertexId find(const Point& p) const;
  // Prefetches the memory for a later `find(p)`.
  void prefetch(const Point& p) const { __builtin_prefetch(&slots_[slotOf(hashOf(cellOf(p.x, p.y)))]); }

 private:
  struct Cell {
    std::int64_t x, y;
  };
  // An entry of an open-addressing table; the tag, from the cell's hash, avoids most accesses to points of other cells.
  struct Slot {
    std::uint32_t tag = 0;
    VertexId vertex = kNone;
  };

  Cell cellOf(double x, double y) const;
  static std::uint64_t hashOf(const Cell& cell);
  static std::uint32_t tagOf(std::uint64_t hash) { return static_cast<std::uint32_t>(hash >> 32); }
  std::size_t slotOf(std::uint64_t hash) const { return static_cast<std::size_t>(hash >> 20) & (slots_.size() - 1); }
  void put(VertexId v);

  const std::vector<Point>* points_;
  double tolerance_;
  double per_unit_;          // cells in a unit of length
  std::vector<Slot> slots_;  // their number is a power of two
  std::size_t size_ = 0;
};

}  // namespace coastmesh
