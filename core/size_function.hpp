#pragma once

#include <cstddef>
#include <span>

#include "core/point.hpp"

namespace coastmesh {

// How long edges should be, place by place: the sizing interface of the core. Lengths are those on the surface that the
// plane stands for. Implementations hold no
// state that reading changes: any number of threads may ask at the same time.
class SizeFunction {
 public:
  virtual ~SizeFunction() = default;

  // The length wanted at x: finite, above 0, for every finite x.
  virtual double at(const Point& x) const = 0;
  // `sizes[i]` becomes the length at `places[i]`: where places that follow one another are near to one another this may
  // cost less.
  virtual void sample(std::span<const Point> places, std::span<double> sizes) const {
    for (std::size_t i = 0; i < places.size(); ++i) sizes[i] = at(places[i]);
  }
  // Bounds of what `at` returns anywhere.
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
