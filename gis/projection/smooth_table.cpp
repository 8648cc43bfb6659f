#include "gis/projection/smooth_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/metric.hpp"

namespace coastmesh {

namespace {

constexpr std::size_t kTerms = SmoothTable::kTerms;
// Relative to the map's change over a square, and, for rounding, to the values themselves.
constexpr double kTolerance = 1e-12, kRounding = 4e-15;

// Row i of `factors` makes the factor of x^i from values at the zeros of Chebyshev's polynomial of degree six.
struct Chebyshev {
  std::array<double, kTerms> zeros;
  std::array<std::array<double, kTerms>, kTerms> factors{};

  Chebyshev() {
    // The factors of x^i in the polynomials of degree n: T(n + 1) = 2 x T(n) - T(n - 1).
    std::array<std::array<double, kTerms>, kTerms> powers{};
    powers[0][0] = powers[1][1] = 1.0;
    for (std::size_t n = 2; n < kTerms; ++n)
      for (std::size_t i = 0; i < kTerms; ++i)
        powers[n][i] = (i > 0 ? 2.0 * powers[n - 1][i - 1] : 0.0) - powers[n - 2][i];
    for (std::size_t k = 0; k < kTerms; ++k) {
      const double angle = (static_cast<double>(k) + 0.5) * std::numbers::pi / kTerms;
      zeros[k] = std::cos(angle);
      for (std::size_t n = 0; n < kTerms; ++n)
        for (std::size_t i = 0; i < kTerms; ++i)
          factors[i][k] += (n == 0 ? 1.0 : 2.0) / kTerms * std::cos(static_cast<double>(n) * angle) * powers[n][i];
    }
  }
};

bool isFinite(const Point& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

}  // namespace

SmoothTable::SmoothTable(std::function<Point(const Point&)> map, const Box& box, double side, const ItemLoop& loop)
    : map_(std::move(map)), box_(box) {
  if (!(side > 0.0) || box.empty()) return;
  const auto countOf = [&](double length) { return std::max<std::size_t>(1, static_cast<std::size_t>(length / side)); };
  columns_ = countOf(box.xmax - box.xmin);
  rows_ = countOf(box.ymax - box.ymin);
  half_x_ = (box.xmax - box.xmin) / (2.0 * static_cast<double>(columns_));
  half_y_ = (box.ymax - box.ymin) / (2.0 * static_cast<double>(rows_));
  if (!(half_x_ > 0.0 && half_y_ > 0.0)) return;
  squares_.resize(columns_ * rows_);
  loop(rows_, [&](std::size_t row) {
    for (std::size_t column = 0; column < columns_; ++column) squares_[row * columns_ + column] = squareAt(column, row);
  });
}

Point SmoothTable::middleOf(std::size_t column, std::size_t row) const {
  return {box_.xmin + (2.0 * static_cast<double>(column) + 1.0) * half_x_,
          box_.ymin + (2.0 * static_cast<double>(row) + 1.0) * half_y_};
}

SmoothTable::Square SmoothTable::squareAt(std::size_t column, std::size_t row) const {
  static const Chebyshev chebyshev;
  const Point middle = middleOf(column, row), centre = map_(middle);
  const auto mapAt = [&](double x, double y) { return map_({middle.x + x * half_x_, middle.y + y * half_y_}); };
  // Values at the zeros [j][k] minus that in the middle, so that rounding is in proportion to the map's change.
  std::array<std::array<Point, kTerms>, kTerms> values, along{};
  Point most{};
  Square square{isFinite(centre), {}};
  for (std::size_t j = 0; j < kTerms; ++j) {
    for (std::size_t k = 0; k < kTerms; ++k) {
      values[j][k] = mapAt(chebyshev.zeros[k], chebyshev.zeros[j]) - centre;
      square.is_tabulated = square.is_tabulated && isFinite(values[j][k]);
      most = {std::max(most.x, std::abs(values[j][k].x)), std::max(most.y, std::abs(values[j][k].y))};
    }
  }
  if (!square.is_tabulated) return square;
  for (std::size_t j = 0; j < kTerms; ++j)
    for (std::size_t i = 0; i < kTerms; ++i)
      for (std::size_t k = 0; k < kTerms; ++k) along[j][i] = along[j][i] + chebyshev.factors[i][k] * values[j][k];
  for (std::size_t j = 0; j < kTerms; ++j)
    for (std::size_t i = 0; i < kTerms; ++i)
      for (std::size_t k = 0; k < kTerms; ++k)
        square.factors[j][i] = square.factors[j][i] + chebyshev.factors[j][k] * along[k][i];
  square.factors[0][0] = square.factors[0][0] + centre;
  // Checks the corners too, which are farthest from the zeros.
  for (const double y : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    for (const double x : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
      const Point value = mapAt(x, y), off = valueOf(square, x, y) - value;
      const auto isNear = [](double far, double change, double size) {
        return std::abs(far) <= kTolerance * change + kRounding * std::abs(size);
      };
      square.is_tabulated = square.is_tabulated && isNear(off.x, most.x, value.x) && isNear(off.y, most.y, value.y);
    }
  }
  return square;
}

Point SmoothTable::valueOf(const Square& square, double x, double y) {
  Point value{};
  for (std::size_t j = kTerms; j-- > 0;) {
    Point row = square.factors[j][kTerms - 1];
    for (std::size_t i = kTerms - 1; i-- > 0;) row = x * row + square.factors[j][i];
    value = y * value + row;
  }
  return value;
}

Point SmoothTable::at(const Point& x) const {
  if (squares_.empty()) return map_(x);
  const double u = (x.x - box_.xmin) / (2.0 * half_x_), v = (x.y - box_.ymin) / (2.0 * half_y_);
  if (!(u >= 0.0 && v >= 0.0 && u <= static_cast<double>(columns_) && v <= static_cast<double>(rows_))) return map_(x);
  const std::size_t column = std::min(static_cast<std::size_t>(u), columns_ - 1),
                    row = std::min(static_cast<std::size_t>(v), rows_ - 1);
  const Square& square = squares_[row * columns_ + column];
  if (!square.is_tabulated) return map_(x);
  return valueOf(square, 2.0 * (u - static_cast<double>(column)) - 1.0, 2.0 * (v - static_cast<double>(row)) - 1.0);
}

std::size_t SmoothTable::tabulated() const {
  return static_cast<std::size_t>(std::ranges::count_if(squares_, &Square::is_tabulated));
}

namespace {

SmoothTable tableFor(std::function<Point(const Point&)> map, double side, std::span<const Point> points,
                     const ItemLoop& loop) {
  // Evaluations of the map per square, and the factor by which points must outnumber these to be worth a table.
  constexpr double kOfASquare = 61.0, kWorth = 2.0;
  const Box box = boxAround(points, loop);
  const double squares = std::max(1.0, (box.xmax - box.xmin) / side) * std::max(1.0, (box.ymax - box.ymin) / side);
  const bool pays = side > 0.0 && kWorth * kOfASquare * squares < static_cast<double>(points.size());
  return {std::move(map), box, pays ? side : 0.0, loop};
}

}  // namespace

SmoothTable inverseTable(const Projection& projection, std::span<const Point> points, const ItemLoop& loop) {
  return tableFor([projection](const Point& x) { return projection.inverse(x); }, projection.smoothOver(), points,
                  loop);
}

SmoothTable measureTable(const Projection& projection, std::span<const Point> points, const ItemLoop& loop) {
  return tableFor(
      [projection](const Point& x) {
        return Point{projection.measureAt(x), 0.0};
      },
      projection.smoothOver(), points, loop);
}

}  // namespace coastmesh
