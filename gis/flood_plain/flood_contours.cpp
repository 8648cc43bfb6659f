#include "gis/flood_plain/flood_contours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace coastmesh {

namespace {

constexpr double kNearest = 0.1;  // of a cell: contours are no nearer to centres, as short edges would serve nothing

// The side between the centres of a cell and the next one east (even) or north (odd).
using SideId = std::uint64_t;

// A piece of a contour within the square between four centres: from side to side.
struct Piece {
  SideId from, to;
};

class Contours {
 public:
  Contours(const FloodedCells& cells, const HeightCells& heights, double limit_m)
      : cells_(cells), heights_(heights), lattice_(heights.lattice), limit_m_(limit_m) {}

  std::vector<Ring> run() {
    for (std::size_t j = 0; j + 1 < lattice_.rows; ++j)
      for (std::size_t i = 0; i + 1 < lattice_.columns; ++i) addPieces(i, j);
    std::ranges::sort(pieces_, {}, &Piece::from);
    std::vector<bool> done(pieces_.size(), false);
    std::vector<Ring> rings;
    for (std::size_t first = 0; first < pieces_.size(); ++first) {
      if (done[first]) continue;
      Ring& ring = rings.emplace_back();
      for (std::size_t p = first; !done[p]; p = pieceFrom(pieces_[p].to)) {
        done[p] = true;
        ring.push_back(placeOn(pieces_[p].from));
      }
    }
    return rings;
  }

 private:
  // The outermost cells are out, so that all contours close.
  bool isIn(std::size_t cell) const {
    const std::size_t i = cell % lattice_.columns, j = cell / lattice_.columns;
    return i > 0 && j > 0 && i + 1 < lattice_.columns && j + 1 < lattice_.rows &&
           cells_.has(cell, kFlooded | kBesideFlooded);
  }

  // Corners and sides are counted counter-clockwise, from the lower left corner and the lower side.
  void addPieces(std::size_t i, std::size_t j) {
    const std::size_t low = lattice_.at(i, j), high = lattice_.at(i, j + 1);
    const std::array<bool, 4> in{isIn(low), isIn(low + 1), isIn(high + 1), isIn(high)};
    const std::array<SideId, 4> sides{2 * low, 2 * (low + 1) + 1, 2 * high, 2 * low + 1};
    const bool saddle = in[0] == in[2] && in[1] == in[3] && in[0] != in[1];
    const bool joined = saddle && cells_.passesAcross(i, j, in[1]);
    for (unsigned k = 0; k < 4; ++k) {
      if (!in[k] || in[(k + 1) % 4]) continue;  // a run of corners ends at k
      unsigned first = k;
      while (in[(first + 3) % 4]) first = (first + 3) % 4;
      if (joined) first = (first + 2) % 4;
      pieces_.push_back({sides[k], sides[(first + 3) % 4]});
    }
  }

  std::size_t pieceFrom(SideId side) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(pieces_, side, {}, &Piece::from) - pieces_.begin());
  }

  // Where a contour crosses a side.
  Point placeOn(SideId side) const {
    const auto cell = static_cast<std::size_t>(side / 2);
    const std::size_t next = side % 2 == 0 ? cell + 1 : cell + lattice_.columns;
    const double share = isIn(cell) ? shareOut(cell, next) : 1.0 - shareOut(next, cell);
    const auto i = static_cast<double>(cell % lattice_.columns), j = static_cast<double>(cell / lattice_.columns);
    return side % 2 == 0 ? lattice_.placeOf(i + share, j) : lattice_.placeOf(i, j + share);
  }

  // The share of the way from a cell that is in to one that is out at which the contour passes.
  double shareOut(std::size_t in, std::size_t out) const {
    const double low = heights_.z[in], high = heights_.z[out];
    if (!(low < limit_m_)) return kNearest;  // water, whatever its height
    if (cells_.has(out, kWaterCell) || !(high >= limit_m_)) return 0.5;
    return std::clamp((limit_m_ - low) / (high - low), kNearest, 1.0 - kNearest);
  }

  const FloodedCells& cells_;
  const HeightCells& heights_;
  const CellLattice& lattice_;
  double limit_m_;
  std::vector<Piece> pieces_;
};

}  // namespace

std::vector<Ring> floodContours(const FloodedCells& cells, const HeightCells& heights, double limit_m) {
  return Contours(cells, heights, limit_m).run();
}

}  // namespace coastmesh
