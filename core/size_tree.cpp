#include "core/size_tree.hpp"

#include <algorithm>
#include <cmath>

#include "core/metric.hpp"

namespace coastmesh {

double SizeTree::at(const Point& x) const {
  // Share of the way across the root, kept inside it.
  constexpr double kBelowOne = 1.0 - 1e-12;
  double u = std::clamp((x.x - origin_.x) / side_, 0.0, kBelowOne);
  double v = std::clamp((x.y - origin_.y) / side_, 0.0, kBelowOne);
  constexpr double kStarts = 1 << kStartLevels;
  const auto i = static_cast<std::size_t>(u * kStarts), j = static_cast<std::size_t>(v * kStarts);
  const std::size_t start = (j << kStartLevels) + i;
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
  const std::uint32_t number = cell->below;
  const Leaf& leaf = leaves_[number];
  // From the centre, -1 to 1; the triangle between the centre, the middle of the nearest side and the nearest corner.
  const double s = 2.0 * u - 1.0, t = 2.0 * v - 1.0;
  const double centre = leaf[4];
  const int dx = s < 0.0 ? -1 : 1, dy = t < 0.0 ? -1 : 1;
  const double as = std::abs(s), at = std::abs(t);
  const double corner = leaf[4 + dx + 3 * dy];
  const double middle = as >= at ? leaf[4 + dx] : leaf[4 + 3 * dy];
  const double far = std::max(as, at), near = std::min(as, at);
  double size = centre + far * (middle - centre) + near * (corner - middle);
  if (first_cap_.empty()) return size;
  for (std::uint32_t k = first_cap_[number]; k < first_cap_[number + 1]; ++k)
    size = std::min(size, caps_[k].size + slope_ * distance(caps_[k].place, x));
  return size;
}

std::size_t SizeTree::bytes() const {
  return cells_.size() * sizeof(Cell) + leaves_.size() * sizeof(Leaf) + start_.size() * sizeof(start_[0]) +
         start_level_.size() + caps_.size() * sizeof(Cap) + first_cap_.size() * sizeof(first_cap_[0]);
}

}  // namespace coastmesh
