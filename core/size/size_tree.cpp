#include "core/size/size_tree.hpp"

#include <algorithm>
#include <cmath>

#include "core/metric.hpp"

namespace coastmesh {

double SizeTree::at(const Point& x) const {
  // Position within the root, 0 to 1, kept inside it.
  constexpr double kBelowOne = 1.0 - 1e-12;
  double u = std::clamp((x.x - origin_.x) / side_, 0.0, kBelowOne);
  double v = std::clamp((x.y - origin_.y) / side_, 0.0, kBelowOne);
  const double starts = static_cast<double>(1u << start_levels_);
  const auto i = static_cast<std::size_t>(u * starts), j = static_cast<std::size_t>(v * starts);
  const std::size_t start = (j << start_levels_) + i;
  const double scale = static_cast<double>(1u << start_level_[start]);
  u = u * scale - std::floor(u * scale);
  v = v * scale - std::floor(v * scale);
  const Cell* cell = &cells_[start_[start]];
  while (!cell->is_leaf) {
    u *= 2.0;
    v *= 2.0;
    const unsigned right = u >= 1.0, up = v >= 1.0;
    u -= right;
    v -= up;
    cell = &cells_[cell->below + right + 2 * up];
  }
  const Leaf& leaf = leaves_[cell->below];
  // Position relative to the centre, -1 to 1, in the triangle of the centre, the middle of the nearest side and the
  // nearest corner.
  const double s = 2.0 * u - 1.0, t = 2.0 * v - 1.0;
  const double centre = leaf[4];
  const int dx = s < 0.0 ? -1 : 1, dy = t < 0.0 ? -3 : 3;
  const double as = std::abs(s), at = std::abs(t);
  const bool beside = as >= at;
  const double corner = leaf[static_cast<std::size_t>(4 + dx + dy)];
  double middle = leaf[static_cast<std::size_t>(4 + (beside ? dx : dy))];
  if (std::isnan(middle)) middle = 0.5 * (corner + leaf[static_cast<std::size_t>(beside ? 4 + dx - dy : 4 - dx + dy)]);
  const double far = std::max(as, at), near = std::min(as, at);
  return centre + far * (middle - centre) + near * (corner - middle);
}

std::size_t SizeTree::bytes() const {
  return cells_.size() * sizeof(Cell) + leaves_.size() * sizeof(Leaf) + start_.size() * sizeof(start_[0]) +
         start_level_.size();
}

}  // namespace coastmesh
