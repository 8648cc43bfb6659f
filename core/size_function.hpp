#pragma once

#include <cstddef>
#include <span>

#include "core/point.hpp"

namespace coastmesh {

// The requested edge length at each place: the sizing interface of the core. Lengths are on the surface that the plane
// represents. Reading changes no state, so any number of threads may read concurrently.
class SizeFunction {
 public:
  virtual ~SizeFunction() = default;

  // The requested length at x: finite, above 0, for every finite x.
  virtual double at(const Point& x) const = 0;
  // Sets `sizes[i]` to the length at `places[i]`; may be faster if consecutive places are close to each other.
  virtual void sample(std::span<const Point> places, std::span<double> sizes) const {
    for (std::size_t i = 0; i < places.size(); ++i) sizes[i] = at(places[i]);
  }
  // Bounds of the values of `at`.
  virtual double least() const = 0;
  virtual double most() const = 0;
};

class ConstantSize final : public SizeFunction {
 public:
  explicit ConstantSize(double size) : size_(size) {}

  double at(const Point&) const override { return size_; }
  double least() const override { return size_; }
  double most() const override { return size_; }

 private:
  double size_;
};

}  // namespace coastmesh
