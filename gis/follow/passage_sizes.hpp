#pragma once

#include <vector>

#include "core/size_function.hpp"
#include "gis/follow/shore_guides.hpp"
#include "gis/follow/shore_triangles.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

// Sizes, limited where passages run through land by those at its shores on both ends. Land there becomes water, as wide
// as `elements`, so sizes for places far from any shore do not apply.
class PassageSizes final : public SizeFunction {
 public:
  // `size` has to outlive this.
  PassageSizes(const SizeFunction& size, const std::vector<ShoreLine>& passages, const ShoreTriangles& triangles);

  double at(const Point& x) const override;
  void sample(std::span<const Point> places, std::span<double> sizes) const override;
  double least() const override { return size_.least(); }
  double most() const override { return size_.most(); }

  // Reduces sizes of triangles, and of their points, to those here.
  void measure(ShoreTriangles& triangles) const;

 private:
  struct Piece {
    Point a, b;
    double size_a, size_b, elements;
  };

  // The largest size that pieces allow at x; infinite far from all.
  double mostAt(const Point& x) const;

  const SizeFunction& size_;
  std::vector<Piece> pieces_;
  BoxTree tree_;  // of boxes in which pieces may reduce sizes
};

}  // namespace coastmesh
