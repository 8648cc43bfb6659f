#pragma once

#include <span>

#include "core/point.hpp"
#include "core/size/size_tree.hpp"

namespace coastmesh {

// One reason for a size: metres on the ground, above 0, infinite where it asks for nothing; places are those of the
// working plane, distances those on the surface that it stands for. Fields hold no state that reading changes: any
// number of threads may ask at the same time. What is asked for in all is the least of several fields: see
// `composeSizes`.
class SizeField {
 public:
  virtual ~SizeField() = default;

  // `sizes[i]` becomes the size at `places[i]`; places that follow one another are near to one another, as a rule.
  virtual void sample(std::span<const Point> places, std::span<double> sizes) const = 0;
  // Bounds of the sizes within each box, from outside.
  virtual void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const = 0;
  // No size is less anywhere: where another field asks for less, this one is not asked.
  virtual double least() const { return 0.0; }
  // What grows with a distance grows no faster: so it is graded before it is interpolated.
  virtual void limitRate(double) {}
  // Whether all of it does.
  virtual bool isGraded() const { return false; }
};

}  // namespace coastmesh
