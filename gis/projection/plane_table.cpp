#include "gis/projection/plane_table.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "core/metric.hpp"

namespace coastmesh {

PlaneTable::PlaneTable(std::function<Point(const Point&)> map, const Box& box, double tolerance)
    : map_(std::move(map)), box_(box) {
  for (const std::size_t cells : std::initializer_list<std::size_t>{8, 16, 32, 64, 128, 256, 512})
    if (tabulate(cells, tolerance)) return;
  values_ = {};
}

bool PlaneTable::tabulate(std::size_t cells, double tolerance) {
  cells_ = cells;
  const double width = std::max(box_.xmax - box_.xmin, 1e-300), height = std::max(box_.ymax - box_.ymin, 1e-300);
  per_x_ = static_cast<double>(cells) / width;
  per_y_ = static_cast<double>(cells) / height;
  values_.clear();
  const auto placeAt = [&](double i, double j) { return Point{box_.xmin + i / per_x_, box_.ymin + j / per_y_}; };
  for (std::size_t j = 0; j <= cells; ++j) {
    for (std::size_t i = 0; i <= cells; ++i) {
      values_.push_back(map_(placeAt(static_cast<double>(i), static_cast<double>(j))));
      if (!std::isfinite(values_.back().x) || !std::isfinite(values_.back().y)) return false;
    }
  }
  for (std::size_t j = 0; j < cells; ++j) {
    for (std::size_t i = 0; i < cells; ++i) {
      const Point place = placeAt(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5);
      const Point off = at(place) - map_(place);
      if (!(std::abs(off.x) <= tolerance && std::abs(off.y) <= tolerance)) return false;
    }
  }
  return true;
}

Point PlaneTable::at(const Point& x) const {
  if (values_.empty()) return map_(x);
  const double most = static_cast<double>(cells_) - 1.0;
  const double u = (x.x - box_.xmin) * per_x_, v = (x.y - box_.ymin) * per_y_;
  // There is no table outside the box.
  if (!(u >= 0.0 && v >= 0.0 && u <= most + 1.0 && v <= most + 1.0)) return map_(x);
  const double i = std::min(std::floor(u), most), j = std::min(std::floor(v), most);
  const double s = u - i, t = v - j;
  const std::size_t row = cells_ + 1, first = static_cast<std::size_t>(j) * row + static_cast<std::size_t>(i);
  return (1.0 - t) * ((1.0 - s) * values_[first] + s * values_[first + 1]) +
         t * ((1.0 - s) * values_[first + row] + s * values_[first + row + 1]);
}

}  // namespace coastmesh
