#pragma once

#include <vector>

#include "core/size_function.hpp"
#include "gis/follow/shore_guides.hpp"
#include "gis/follow/shore_triangles.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

// Sizes, but no larger at land that passages run through than what its shores at both ends want: water will be there,
// as wide as so many elements, and sizes of places far from a shore, as the inside of land is one, do not matter.
class PassageSizes final : public SizeFunction {
 public:
  // `size` has to outlive this.
  PassageSizes(const SizeFunction& size, const std::vector<ShoreLine>& passages, const ShoreTriangles& triangles);

  double at(const Point& x) const override;
  void sample(std::span<const Point> places, std::span<double> sizes) const override;
  double least() const override { return size_.least(); }
  double most() const override { return size_.most(); }

  // Gives triangles the sizes that are smaller here than those they were made with.
  void measure(ShoreTriangles& triangles) const;

 private:
  struct Piece {
    Point a, b;
    double size_a, size_b, elements;
  };

  // What pieces allow at x; infinite far from all.
  double mostAt(const Point& x) const;

  const SizeFunction& size_;
  std::vector<Piece> pieces_;
  BoxTree tree_;  // of all that may be smaller for a piece
};

}  // namespace coastmesh
