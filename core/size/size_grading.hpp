#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/ids.hpp"
#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "core/size/size_places.hpp"
#include "core/size/size_queue.hpp"
#include "core/surface.hpp"

namespace coastmesh {

// The vertices of a square cell, in rows from below: corners, middles of sides, centre. The middle of a side is kNone
// where sizes are linear along it. The cell's triangles lie between its centre and the edges of its boundary: all are
// right-angled, with legs of the same length. Cells meet in whole edges.
//
//   6 --- 7 --- 8     6 ----------- 8
//   | \   |   / |     |  \       /   |
//   |   \ | /   |     |    \   /     |
//   3 --- 4 --- 5     |      4 ---- 5    without 1, 3 and 7
//   |   / | \   |     |    /   \     |
//   | /   |   \ |     |  /       \   |
//   0 --- 1 --- 2     0 ----------- 2
using LeafVertices = std::array<std::uint32_t, 9>;

// `spread` lets sizes grow by this share of the gradation, since a cone interpolated between vertices is steeper.
inline constexpr double kSizeGrowth = 0.94;

// For each vertex: the requested size (infinite: none), the allowed size, the vertex from which that grows (kNone if
// nothing smaller is near), and whether it has spread to its neighbours.
struct GradedSizes {
  std::vector<double> own, size;
  std::vector<std::uint32_t> source;
  std::vector<std::uint8_t> is_spread;  // has no entries for new vertices
};

// The positions of such cells' vertices, and how fast sizes may grow there.
struct SizeGrid {
  const SizePlaces& places;  // in multiples of `unit`, from `origin`
  double unit = 1.0;
  Point origin;
  Surface surface;  // represented by the plane
  double gradation = 0.3;

  // Relative to `origin`.
  Point placeOf(std::uint32_t v) const { return {unit * places[v].x, unit * places[v].y}; }
  double shrinkAt(std::uint32_t v) const;                          // length on the surface over length in the plane
  double distanceBetween(std::uint32_t v, std::uint32_t w) const;  // on the surface
  // The steepest gradient, in the plane, that is within the gradation on the surface anywhere in a cell.
  double slopeIn(const LeafVertices& leaf) const;
};

// Lowers sizes at the vertices of such cells until they grow no faster than the gradation anywhere, in two steps.
class SizeGrading {
 public:
  SizeGrading(GradedSizes& sizes, const SizeGrid& grid, std::span<const LeafVertices> leaves, const ItemLoop& loop);

  // Updates after cells were split: `changed` are those of `leaves` that are new or have new vertices; the others keep
  // their place.
  void update(std::span<const LeafVertices> leaves, std::span<const std::uint32_t> changed);

  // Lets sizes grow with the distance on the surface, from the lowest vertices of triangles that are much too steep,
  // and from earlier growth next to new vertices. Where none are requested, they grow from their surroundings.
  void spread();
  // Lowers sizes that are steeper than the gradation as little as each triangle needs, and rounds to single precision.
  // Afterwards no triangle is too steep.
  void flatten();

 private:
  struct Growth {
    double allowed;
    std::uint32_t to, origin;
  };

  struct Lowered {
    std::uint32_t vertex;
    double size;
  };

  Point placeOf(std::uint32_t v) const { return grid_.placeOf(v); }
  void takeIn(std::uint32_t leaf);
  double halfOf(const LeafVertices& leaf) const;
  template <typename F>
  void forEachSlope(const LeafVertices& leaf, F&& f) const;
  bool isSteep(std::uint32_t leaf) const;
  std::vector<SizeQueue::Entry> findSteep() const;
  double lowestOf(std::uint32_t leaf) const;
  std::uint32_t largestRound(std::uint32_t v) const;
  double legAt(std::uint32_t v) const;
  void fetchAhead(std::span<const SizeQueue::Entry> batch) const;
  void fetchLeaf(std::span<const std::uint32_t> leaves) const;
  template <typename F>
  void grow(const std::vector<std::uint32_t>& from, const F& mayLower);
  template <typename F, typename G>
  void findGrowth(std::uint32_t v, const F& mayLower, G&& found) const;
  std::vector<std::uint32_t> besideNew() const;
  bool isFirstToSee(std::uint32_t leaf);
  void flattenLeaf(std::uint32_t leaf, std::vector<Lowered>& lowered) const;
  void flattenLegs();
  template <typename F>
  void forLeavesRound(std::uint32_t v, F&& f) const {
    const std::array<std::uint32_t, 4>& round = round_[v];
    for (std::size_t k = 0; k < 4; ++k)
      if (round[k] != kNone && std::find(round.begin(), round.begin() + k, round[k]) == round.begin() + k) f(round[k]);
  }

  GradedSizes& sizes_;
  SizeGrid grid_;
  std::span<const LeafVertices> leaves_;
  // The cells around a vertex, one for each quadrant from the upper right one; a cell with it in the middle of a side
  // appears twice.
  std::vector<std::array<std::uint32_t, 4>> round_;
  std::vector<std::uint32_t> halves_;  // half the side of the largest cell around each vertex, in units
  std::vector<std::uint32_t> seen_;    // while sizes are flattened: the last batch that listed a cell
  std::uint32_t seen_last_ = 0;
  const ItemLoop& loop_;
};

// The boundary of a cell counter-clockwise.
inline constexpr std::array<unsigned, 8> kLeafBoundary = {0, 1, 2, 5, 8, 7, 6, 3};

// Visits the triangles of a cell: its centre, and an edge of the boundary.
template <typename F>
void forEachTriangle(const LeafVertices& leaf, F&& triangle) {
  std::uint32_t last = leaf[0];
  for (std::size_t k = 1; k <= kLeafBoundary.size(); ++k) {
    const std::uint32_t next = leaf[kLeafBoundary[k % kLeafBoundary.size()]];
    if (next == kNone) continue;
    triangle(leaf[4], last, next);
    last = next;
  }
}

}  // namespace coastmesh
