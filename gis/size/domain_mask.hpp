#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/pslg.hpp"
#include "core/size/size_box.hpp"
#include "core/surface.hpp"

namespace coastmesh {

// Which squares of the plane have anything of a domain in them, to the cells of a grid that is about as fine as the
// domain's segments are many: what lies outside by less may be taken for inside, never the other way round.
class DomainMask {
 public:
  // Over a square that holds the domain; areas are those on `surface`. Where no segment is labelled nothing lies
  // outside for `meets`. Throws BadPslg.
  DomainMask(const Pslg& pslg, const SizeBox& square, const Surface& surface = {});

  bool meets(const SizeBox& box) const;
  // How much of a box lies inside, 0 to 1, within a few hundredths. REQUIRES: the box is a cell of a quadtree over the
  // square.
  double share(const SizeBox& box) const;

 private:
  struct Crossing {
    double x;
    bool inside;  // to its right
  };

  std::vector<std::vector<Crossing>> crossRows(const Pslg& pslg, int level) const;
  std::vector<bool> rasterize(const Pslg& pslg, int level) const;
  void measureShares(const Pslg& pslg);
  float shareOf(const std::array<float, 4>& below, std::size_t i, std::size_t j, std::size_t cells) const;
  void listBoundary(const Pslg& pslg);
  static constexpr std::size_t kProbes = 3;  // along each side of a box
  int holdsOf(double x, const std::array<double, kProbes>& ys, std::size_t cell) const;

  Point origin_;
  double side_ = 1.0;
  Surface surface_;
  std::vector<std::vector<bool>> levels_;  // of 2^level rows of 2^level cells; empty where all is inside
  // Of such cells, to a level of their own: how much lies inside.
  std::vector<std::vector<float>> shares_;
  std::vector<std::vector<Crossing>>
      rows_;  // of the finest of these: where what is inside begins and ends on their middles
  struct BoundaryPiece {
    Point a, b;
  };
  std::vector<BoundaryPiece> boundary_;  // edges between inside and outside, in units of the finest cells, cell by cell
  std::vector<std::uint32_t> boundary_begin_;  // of each cell, and the end
};

}  // namespace coastmesh
