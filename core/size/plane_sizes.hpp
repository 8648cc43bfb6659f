#pragma once

#include <algorithm>
#include <cmath>

#include "core/size_function.hpp"
#include "core/surface.hpp"

namespace coastmesh {

// Sizes on a surface as lengths in its plane, for code that measures there. Assumes straight lines so short that the
// scale factor hardly changes along them.
class PlaneSizes final : public SizeFunction {
 public:
  // For the box from `low` to `high`; outside it the scale factor falls no further. `size` must outlive this.
  PlaneSizes(const SizeFunction& size, const Surface& surface, const Point& low, const Point& high)
      : size_(size),
        surface_(surface),
        least_shrink_(surface.shrinkAt(
            {std::max(std::abs(low.x), std::abs(high.x)), std::max(std::abs(low.y), std::abs(high.y))})) {}

  double at(const Point& x) const override { return size_.at(x) / std::max(surface_.shrinkAt(x), least_shrink_); }
  double least() const override { return size_.least(); }
  double most() const override { return size_.most() / least_shrink_; }

 private:
  const SizeFunction& size_;
  Surface surface_;
  double least_shrink_;
};

}  // namespace coastmesh
