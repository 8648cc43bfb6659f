#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/pslg.hpp"
#include "core/size/size_box.hpp"
#include "core/surface.hpp"

namespace coastmesh {

// The squares of the plane that intersect a domain, at the resolution of a grid whose number of cells is proportional
// to that of the domain's segments, up to 4096 by 4096. A square that is outside by less than a cell may count as
// inside, never the reverse.
class DomainMask {
 public:
  // `square` contains the domain; areas are measured on `surface`. If no segment is labelled, `meets` is always true.
  // Throws BadPslg.
  DomainMask(const Pslg& pslg, const SizeBox& square, const Surface& surface = {});

  bool meets(const SizeBox& box) const;
  // The share of a box that is inside, 0 to 1, to a few hundredths. REQUIRES: the box is a cell of a quadtree over the
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
  std::vector<std::vector<bool>> levels_;  // 2^level rows of 2^level cells; empty if all is inside
  // Shares of such cells that are inside, down to a level of their own.
  std::vector<std::vector<float>> shares_;
  // For each row of the finest of these: where its centre line enters or leaves the domain.
  std::vector<std::vector<Crossing>> rows_;
  struct BoundaryPiece {
    Point a, b;
  };
  std::vector<BoundaryPiece> boundary_;  // edges between inside and outside, in units of the finest cells, cell by cell
  std::vector<std::uint32_t> boundary_begin_;  // of each cell, and the end
};

}  // namespace coastmesh
