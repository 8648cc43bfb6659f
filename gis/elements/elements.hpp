#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// The triangles and quadrilaterals of a grid as files number them: a quadrilateral stands where its first half does.
class Elements {
 public:
  // The nodes around an element, three or four.
  struct Nodes {
    std::array<std::uint32_t, 4> v{};
    std::size_t count = 3;

    const std::uint32_t* begin() const { return v.data(); }
    const std::uint32_t* end() const { return v.data() + count; }
  };

  // REQUIRES: `grid` outlives it, and keeps its triangles.
  explicit Elements(const Grid& grid);

  std::size_t size() const { return triangle_.empty() ? grid_.triangles.size() : triangle_.size(); }
  std::size_t quads() const { return grid_.triangles.size() - size(); }
  bool isQuad(std::size_t element) const { return !triangle_.empty() && across_[element] != kNone; }
  // The triangle, or the first half, and the second half.
  std::uint32_t triangleOf(std::size_t element) const {
    return triangle_.empty() ? static_cast<std::uint32_t>(element) : triangle_[element];
  }
  std::uint32_t secondHalfOf(std::size_t element) const { return second_[across_[element]]; }
  // The value of the element: the sum of those of its triangles.
  double sumOver(std::size_t element, std::span<const double> of_triangles) const {
    return of_triangles[triangleOf(element)] + (isQuad(element) ? of_triangles[secondHalfOf(element)] : 0.0);
  }
  Nodes nodesOf(std::size_t element) const;
  const char* nameOf(std::size_t element) const { return isQuad(element) ? "quadrilateral" : "triangle"; }
  std::uint32_t elementOf(std::uint32_t triangle) const {
    return of_triangle_.empty() ? triangle : of_triangle_[triangle];
  }

 private:
  const Grid& grid_;
  // All empty if there are only triangles. By element: its triangle or first half, and its number among quadrilaterals.
  std::vector<std::uint32_t> triangle_, across_;
  std::vector<std::array<std::uint32_t, 4>> nodes_;  // by number among quadrilaterals
  std::vector<std::uint32_t> second_;                // likewise
  std::vector<std::uint32_t> of_triangle_;           // the element of each triangle
};

inline std::string digitsOf(std::uint64_t number) { return std::to_string(number); }

// For each triangle the number of its element, from 0; empty if the grid has triangles only.
std::vector<std::uint32_t> elementNumbers(const Grid& grid);

// "120 triangles", or "80 triangles, 20 quadrilaterals", with `number` as the text of a number.
std::string elementCount(const Grid& grid, std::string (*number)(std::uint64_t) = digitsOf);

// Arrays of a grid that were read with one value for each element get one for each triangle; the areas of halves are
// measured.
void giveToHalves(const Elements& elements, Grid& grid);

}  // namespace coastmesh
