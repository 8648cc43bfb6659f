#pragma once

#include <cstdint>
#include <vector>

#include "core/ids.hpp"
#include "core/point.hpp"

namespace coastmesh {

// Points of a growing list, found again by place: a hash over square cells.
class PointGrid {
 public:
  // `tolerance`: how near a point has to be in order to be found; 0 finds equal points only. `points` outlives the
  // grid.
  PointGrid(const std::vector<Point>& points, double tolerance, std::size_t expected_size);

  void add(VertexId v);  // REQUIRES: v is the next that was not added yet
  // The nearest of the points added within the tolerance of `p`, of equally near ones the first; kNone if there is
  // none.
  VertexId find(const Point& p) const;
  // Tells the processor that `p` will be asked for soon.
  void prefetch(const Point& p) const { __builtin_prefetch(&slots_[slotOf(hashOf(cellOf(p.x, p.y)))]); }

 private:
  struct Cell {
    std::int64_t x, y;
  };
  // A place in an open-addressing table; the tag, of the cell's hash, spares most looks at points of other cells.
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
  std::vector<Slot> slots_;  // a power of two of them
  std::size_t size_ = 0;
};

}  // namespace coastmesh
