#include "gis/flood_plain/flooded_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/metric.hpp"

namespace coastmesh {

namespace {

// Sets a flag of the cells whose centres lie between the edges, by the even-odd rule.
void markInside(const CellLattice& lattice, std::span<const PlaceEdge> edges, std::uint8_t flag,
                std::vector<std::uint8_t>& flags) {
  struct Crossing {
    std::uint32_t row;
    double column;
    auto operator<=>(const Crossing&) const = default;
  };
  std::vector<Crossing> crossings;
  const auto rows = static_cast<double>(lattice.rows), columns = static_cast<double>(lattice.columns);
  for (auto [a, b] : edges) {
    if (b.y < a.y) std::swap(a, b);
    const double first = std::max(0.0, std::ceil((a.y - lattice.south) / lattice.height));
    for (double row = first; row < rows; ++row) {
      const double y = lattice.south + row * lattice.height;
      if (y < a.y) continue;  // by rounding
      if (y >= b.y) break;
      const double x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
      crossings.push_back({static_cast<std::uint32_t>(row), (x - lattice.west) / lattice.width});
    }
  }
  std::ranges::sort(crossings);
  for (std::size_t c = 0; c + 1 < crossings.size(); c += 2) {
    const double from = std::clamp(std::ceil(crossings[c].column), 0.0, columns);
    const double to = std::clamp(std::ceil(crossings[c + 1].column), 0.0, columns);
    for (auto i = static_cast<std::size_t>(from); i < static_cast<std::size_t>(to); ++i)
      flags[lattice.at(i, crossings[c].row)] |= flag;
  }
}

// Sets a flag of the cells that the edges pass, but for some that they pass only near a corner.
void markAlong(const CellLattice& lattice, std::span<const PlaceEdge> edges, std::uint8_t flag,
               std::vector<std::uint8_t>& flags) {
  constexpr double kStep = 0.25;  // of a cell
  const auto rows = static_cast<double>(lattice.rows), columns = static_cast<double>(lattice.columns);
  for (const auto& [a, b] : edges) {
    const Point from{(a.x - lattice.west) / lattice.width + 0.5, (a.y - lattice.south) / lattice.height + 0.5};
    const Point way =
        Point{(b.x - lattice.west) / lattice.width + 0.5, (b.y - lattice.south) / lattice.height + 0.5} - from;
    double begin = 0.0, end = 1.0;  // the part of the edge in the lattice
    const auto keep = [&](double start, double along, double most) {
      if (along == 0.0) {
        if (start < 0.0 || start >= most) end = -1.0;
        return;
      }
      const double enters = -start / along, leaves = (most - start) / along;
      begin = std::max(begin, std::min(enters, leaves));
      end = std::min(end, std::max(enters, leaves));
    };
    keep(from.x, way.x, columns);
    keep(from.y, way.y, rows);
    if (end < begin) continue;
    const double steps = std::ceil((end - begin) * std::hypot(way.x, way.y) / kStep);
    for (double k = 0.0; k <= steps; ++k) {
      const Point at = from + (steps > 0.0 ? begin + k / steps * (end - begin) : begin) * way;
      const double column = std::floor(at.x), row = std::floor(at.y);
      if (column < 0.0 || row < 0.0 || column >= columns || row >= rows) continue;
      flags[lattice.at(static_cast<std::size_t>(column), static_cast<std::size_t>(row))] |= flag;
    }
  }
}

}  // namespace

FloodedCells::FloodedCells(const HeightCells& heights, double limit_m, std::span<const PlaceEdge> shores,
                           std::span<const PlaceEdge> open, std::span<const PlaceEdge> frame)
    : heights_(heights), limit_m_(static_cast<float>(limit_m)), flags_(heights.lattice.count(), 0) {
  const CellLattice& lattice = heights.lattice;
  std::vector<PlaceEdge> water(shores.begin(), shores.end());
  water.insert(water.end(), open.begin(), open.end());
  markInside(lattice, water, kWaterCell, flags_);
  if (!frame.empty()) {
    markInside(lattice, frame, kBeyondFrame, flags_);
    for (std::uint8_t& flags : flags_) flags ^= kBeyondFrame;
  }
  markAlong(lattice, shores, kShoreCell, flags_);
  flood();
  ringFlooded();
}

bool FloodedCells::isLow(std::size_t cell) const {
  return !has(cell, kWaterCell | kBeyondFrame) && heights_.z[cell] < limit_m_;
}

bool FloodedCells::passesAcross(std::size_t column, std::size_t row, bool falling) const {
  const CellLattice& lattice = heights_.lattice;
  const std::size_t low = lattice.at(column, row), high = lattice.at(column, row + 1);
  const std::array<std::size_t, 2> across{falling ? low + 1 : low, falling ? high : high + 1},
      others{falling ? low : low + 1, falling ? high + 1 : high};
  float sum = 0.0f;
  for (const std::size_t cell : across) {
    if (!isLow(cell)) return false;
    sum += heights_.z[cell];
  }
  for (const std::size_t cell : others) {
    if (has(cell, kWaterCell | kBeyondFrame) || !(heights_.z[cell] >= limit_m_)) return false;
    sum += heights_.z[cell];
  }
  return sum < 4.0f * limit_m_;
}

// Calls `visit(cell)` for the low land that water reaches from a cell.
template <typename Visit>
void FloodedCells::forNeighbours(std::size_t cell, const Visit& visit) const {
  const CellLattice& lattice = heights_.lattice;
  const std::size_t i = cell % lattice.columns, j = cell / lattice.columns;
  const bool west = i > 0, east = i + 1 < lattice.columns, south = j > 0, north = j + 1 < lattice.rows;
  const auto look = [&](bool exists, std::size_t other) {
    if (exists && isLow(other)) visit(other);
  };
  look(west, cell - 1);
  look(east, cell + 1);
  look(south, cell - lattice.columns);
  look(north, cell + lattice.columns);
  if (south && west && passesAcross(i - 1, j - 1, false)) visit(cell - lattice.columns - 1);
  if (north && east && passesAcross(i, j, false)) visit(cell + lattice.columns + 1);
  if (south && east && passesAcross(i, j - 1, true)) visit(cell - lattice.columns + 1);
  if (north && west && passesAcross(i - 1, j, true)) visit(cell + lattice.columns - 1);
}

void FloodedCells::flood() {
  const CellLattice& lattice = heights_.lattice;
  std::vector<std::size_t> queue;
  const auto reach = [&](std::size_t cell) {
    if (!isLow(cell) || has(cell, kFlooded)) return;
    flags_[cell] |= kFlooded;
    queue.push_back(cell);
  };
  for (std::size_t cell = 0; cell < flags_.size(); ++cell) {
    if (has(cell, kShoreCell)) reach(cell);
    if (!has(cell, kWaterCell)) continue;
    const std::size_t i = cell % lattice.columns, j = cell / lattice.columns;
    if (i > 0) reach(cell - 1);
    if (i + 1 < lattice.columns) reach(cell + 1);
    if (j > 0) reach(cell - lattice.columns);
    if (j + 1 < lattice.rows) reach(cell + lattice.columns);
  }
  while (!queue.empty()) {
    const std::size_t cell = queue.back();
    queue.pop_back();
    forNeighbours(cell, reach);
  }
}

// Flags water beside flooded land, and what is low beyond the frame, so that contours of the land lie within it.
void FloodedCells::ringFlooded() {
  const CellLattice& lattice = heights_.lattice;
  for (std::size_t cell = 0; cell < flags_.size(); ++cell) {
    if (!has(cell, kFlooded)) continue;
    const std::size_t i = cell % lattice.columns, j = cell / lattice.columns;
    for (std::size_t row = j - std::min<std::size_t>(j, 1); row <= std::min(j + 1, lattice.rows - 1); ++row)
      for (std::size_t column = i - std::min<std::size_t>(i, 1); column <= std::min(i + 1, lattice.columns - 1);
           ++column) {
        const std::size_t other = lattice.at(column, row);
        const bool is_low_beyond = has(other, kBeyondFrame) && heights_.z[other] < limit_m_;
        if (has(other, kWaterCell) || is_low_beyond) flags_[other] |= kBesideFlooded;
      }
  }
}

DryHollows FloodedCells::findHollows() {
  DryHollows hollows;
  for (std::size_t start = 0; start < flags_.size(); ++start) {
    if (!isLow(start) || has(start, kFlooded | kCounted)) continue;
    std::vector<std::size_t> cells{start};
    flags_[start] |= kCounted;
    for (std::size_t k = 0; k < cells.size(); ++k)
      forNeighbours(cells[k], [&](std::size_t other) {
        if (has(other, kCounted)) return;
        flags_[other] |= kCounted;
        cells.push_back(other);
      });
    ++hollows.count;
    hollows.cells.insert(hollows.cells.end(), cells.begin(), cells.end());
    if (cells.size() > hollows.largest.size()) hollows.largest = std::move(cells);
  }
  return hollows;
}

}  // namespace coastmesh
