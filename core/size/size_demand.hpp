#pragma once

#include <cstddef>
#include <vector>

#include "core/item_loop.hpp"
#include "core/size/size_box.hpp"
#include "core/size/size_cells.hpp"
#include "core/size/size_leaves.hpp"
#include "core/size/size_tree_task.hpp"
#include "core/size/size_vertices.hpp"

namespace coastmesh {

// The vertices that a cell requires, from the range of its lengths: at least, and probably.
struct CellDemand {
  double least = 0.0, likely = 0.0;
  double central = 0.0;  // from the length at the centre, if known
  double size = 0.0;
};
CellDemand demandIn(const SizeBox& box, const SizeRange& range, const SizeTreeTask& task);

// The sums over some cells.
struct DemandSum {
  double least = 0.0, likely = 0.0, central = 0.0;
  double most_here = 0.0;  // the largest `likely` of a cell
  SizeBox most_in;
  double size = 0.0;

  void add(const CellDemand& cell, const SizeBox& box) {
    add({cell.least, cell.likely, cell.central, cell.likely, box, cell.size});
  }
  void add(const DemandSum& other) {
    least += other.least;
    likely += other.likely;
    central += other.central;
    if (!(other.most_here > most_here)) return;
    most_here = other.most_here;
    most_in = other.most_in;
    size = other.size;
  }
};

// `sum` and what `addTo(sum, k)` adds to it for every k below `count`.
template <typename AddTo>
DemandSum sumOver(const ItemLoop& loop, std::size_t count, const DemandSum& sum, const AddTo& addTo) {
  DemandSum all = sum;
  const auto sumOf = [&](std::size_t first, std::size_t last) {
    DemandSum here;
    for (std::size_t k = first; k < last; ++k) addTo(here, k);
    return here;
  };
  for (const DemandSum& part : overStretches(loop, count, sumOf)) all.add(part);
  return all;
}

// Judges from the demand known at each level of a growing tree whether it will exceed a limit.
class DemandLimit {
 public:
  explicit DemandLimit(double most_vertices) : most_(most_vertices) {}

  // Takes in the demand of all cells at the next level.
  void see(const DemandSum& demand);
  // True if a level was certainly too much, or likely demand is far too large and has hardly decreased over some
  // levels: the apparent demand of small places halves from level to level, that of lines and areas stays.
  bool isExceeded() const { return is_exceeded_; }
  // True if the demand from lengths at the centres of cells has exceeded the limit over some levels. A single level may
  // mislead, where a straight shore runs through the centres; on the next one it is far from them.
  bool isExceededOnAverage() const;

 private:
  double most_;
  std::vector<double> likely_;  // at each level
  bool is_exceeded_ = false;
  int levels_beyond_ = 0;  // consecutive levels whose centres require too much
};

// The demand of graded sizes.
SizeDemand demandOfLeaves(const SizeCells& cells, const SizeVertices& vertices, const SizeLeaves& leaves,
                          const SizeTreeTask& task);

}  // namespace coastmesh
