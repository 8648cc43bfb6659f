#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "gis/flood_plain/height_cells.hpp"

namespace coastmesh {

using PlaceEdge = std::pair<Point, Point>;

// What a cell is by its centre. `kFlooded`: land below the limit, connected with water through such land.
inline constexpr std::uint8_t kWaterCell = 1, kBeyondFrame = 2, kShoreCell = 4, kFlooded = 8, kBesideFlooded = 16,
                              kCounted = 32;

// Low land that is not connected with the water.
struct DryHollows {
  std::size_t count = 0;
  std::vector<std::size_t> cells;    // all of them
  std::vector<std::size_t> largest;  // those of the largest
};

// Cells of a lattice, each with a set of flags.
class FloodedCells {
 public:
  // `shores`: edges with water on one side; `open`: further edges that bound water; `frame`: edges of the frame, or
  // none. Inside is even-odd.
  FloodedCells(const HeightCells& heights, double limit_m, std::span<const PlaceEdge> shores,
               std::span<const PlaceEdge> open, std::span<const PlaceEdge> frame);

  const std::vector<std::uint8_t>& flags() const { return flags_; }
  bool has(std::size_t cell, std::uint8_t flag) const { return (flags_[cell] & flag) != 0; }
  // Finds the low land that is not connected. May be called once.
  DryHollows findHollows();
  // True if water passes between the cells (column, row) and (column + 1, row + 1), or if `falling` between
  // (column + 1, row) and (column, row + 1): both are low land, the other two are high, and their mean is low.
  bool passesAcross(std::size_t column, std::size_t row, bool falling) const;

 private:
  bool isLow(std::size_t cell) const;
  void flood();
  void ringFlooded();
  template <typename Visit>
  void forNeighbours(std::size_t cell, const Visit& visit) const;

  const HeightCells& heights_;
  float limit_m_;
  std::vector<std::uint8_t> flags_;
};

}  // namespace coastmesh
