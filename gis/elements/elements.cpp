#include "gis/elements/elements.hpp"

#include <utility>

#include "gis/crs/geodesy.hpp"
#include "gis/elements/quads.hpp"
#include "gis/for_count.hpp"

namespace coastmesh {

Elements::Elements(const Grid& grid) : grid_(grid) {
  const std::vector<Quad> quads = quadsOf(grid);
  if (quads.empty()) return;
  std::vector<bool> is_second(grid.triangles.size(), false);
  for (const Quad& quad : quads) {
    is_second[quad.halves[1]] = true;
    nodes_.push_back(quad.nodes);
    second_.push_back(quad.halves[1]);
  }
  of_triangle_.resize(grid.triangles.size());
  std::uint32_t next = 0;
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) {
    if (is_second[t]) continue;
    const bool whole = next == quads.size() || quads[next].halves[0] != t;
    of_triangle_[t] = static_cast<std::uint32_t>(triangle_.size());
    triangle_.push_back(t);
    across_.push_back(whole ? kNone : next++);
  }
  for (const Quad& quad : quads) of_triangle_[quad.halves[1]] = of_triangle_[quad.halves[0]];
}

Elements::Nodes Elements::nodesOf(std::size_t element) const {
  if (isQuad(element)) return {nodes_[across_[element]], 4};
  const auto& [a, b, c] = grid_.triangles[triangleOf(element)];
  return {{a, b, c, kNone}, 3};
}

std::vector<std::uint32_t> elementNumbers(const Grid& grid) {
  const Elements elements(grid);
  std::vector<std::uint32_t> numbers;
  if (elements.quads() > 0)
    for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) numbers.push_back(elements.elementOf(t));
  return numbers;
}

std::string elementCount(const Grid& grid, std::string (*number)(std::uint64_t)) {
  const std::size_t quads = quadsOf(grid).size(), triangles = grid.triangles.size() - 2 * quads;
  std::string text = number(triangles) + forCount(triangles, " triangle", " triangles");
  if (quads > 0) text += ", " + number(quads) + forCount(quads, " quadrilateral", " quadrilaterals");
  return text;
}

void giveToHalves(const Elements& elements, Grid& grid) {
  if (elements.quads() == 0) return;
  const auto repeat = [&](auto& values) {
    if (values.empty()) return;
    auto all = values;
    all.resize(grid.triangles.size());
    for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = values[elements.elementOf(t)];
    values = std::move(all);
  };
  repeat(grid.feature_of);
  repeat(grid.piece_of);
  repeat(grid.part_of);
  repeat(grid.min_angle_deg);
  if (!grid.area_m2.empty()) grid.area_m2 = triangleAreas(grid.nodes, grid.triangles, grid.crs);
}

}  // namespace coastmesh
