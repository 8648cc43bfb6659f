#pragma once

#include <limits>
#include <span>

#include "core/point.hpp"
#include "core/size/size_tree.hpp"

namespace coastmesh {

// One source of sizes: metres on the ground, above 0, infinite where it requests nothing; places are those of the
// working plane, distances those on the surface that it represents. Fields have no state that reading changes: any
// number of threads may read at the same time. The requested size is the minimum of several fields: see
// `composeSizes`.
class SizeField {
 public:
  virtual ~SizeField() = default;

  // Sets `sizes[i]` to the size at `places[i]`; consecutive places are usually close to each other.
  virtual void sample(std::span<const Point> places, std::span<double> sizes) const = 0;
  // Outer bounds of the sizes within each box.
  virtual void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const = 0;
  // A lower bound of all sizes: if another field requests less, this one is not evaluated.
  virtual double least() const { return 0.0; }
  // An upper bound of the finite sizes within a box; infinite if none is known.
  virtual double mostIn(const SizeBox&) const { return std::numeric_limits<double>::infinity(); }
  // Limits the rate at which sizes grow with distance, so that they are graded before they are interpolated.
  virtual void limitRate(double) {}
  // True if all sizes of the field grow in this way.
  virtual bool isGraded() const { return false; }
};

}  // namespace coastmesh
