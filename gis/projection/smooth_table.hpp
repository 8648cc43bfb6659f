#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "gis/geometry/box.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// A smooth map of the plane for many points: polynomials of degree five in either coordinate, over squares, replace a
// projection that takes 0.3 µs per point. Usable from several threads.
class SmoothTable {
 public:
  // Factors in either coordinate.
  static constexpr std::size_t kTerms = 6;

  // Squares with sides of about `side` cover the box; there are none if `side` is 0. A square is tabulated if, at test
  // points between those that define its polynomials, values differ from the map by at most 1e-12 of the map's change
  // over the square, plus rounding.
  SmoothTable(std::function<Point(const Point&)> map, const Box& box, double side, const ItemLoop& loop);

  // Evaluates the map itself where nothing is tabulated.
  Point at(const Point& x) const;
  std::size_t squares() const { return squares_.size(); }  // tabulated or not
  std::size_t tabulated() const;

 private:
  struct Square {
    bool is_tabulated = false;
    std::array<std::array<Point, kTerms>, kTerms> factors;  // [j][i] of x^i y^j, both from -1 to 1
  };

  Square squareAt(std::size_t column, std::size_t row) const;
  Point middleOf(std::size_t column, std::size_t row) const;
  static Point valueOf(const Square& square, double x, double y);

  std::function<Point(const Point&)> map_;
  Box box_;
  double half_x_ = 0.0, half_y_ = 0.0;  // half the sides of a square
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<Square> squares_;
};

// `Projection::inverse` and, as x, `Projection::measureAt` for these points, tabulated if there are enough of them,
// where the projection is smooth.
SmoothTable inverseTable(const Projection& projection, std::span<const Point> points, const ItemLoop& loop);
SmoothTable measureTable(const Projection& projection, std::span<const Point> points, const ItemLoop& loop);

}  // namespace coastmesh
