#include "gis/coast/nest_rings.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "gis/coast/turned_rings.hpp"
#include "gis/geometry/chain_index.hpp"
#include "gis/geometry/ring_area.hpp"

namespace coastmesh {

namespace {

constexpr std::size_t kNoRing = static_cast<std::size_t>(-1);

bool liesInside(const Ring& ring, const ChainIndex& other) {
  for (const Point& p : ring) {
    const Location location = other.locate(p);
    if (location != Location::Boundary) return location == Location::Inside;
  }
  return false;
}

Box boundsOf(const std::vector<Ring>& rings) {
  Box box;
  for (const Ring& ring : rings)
    for (const Point& p : ring) box.add(p);
  return box;
}

}  // namespace

std::vector<NestedRing> nestRings(const std::vector<Ring>& rings, bool geographic) {
  std::vector<Box> boxes(rings.size());
  std::vector<double> areas(rings.size());
  const auto jumps = [&](std::size_t i) {
    return geographic && boxes[i].xmax - boxes[i].xmin > 180 && longitudesJump(rings[i]);
  };
  for (std::size_t i = 0; i < rings.size(); ++i) {
    for (const Point& p : rings[i]) boxes[i].add(p);
    areas[i] = std::abs(signedAreaOf(jumps(i) ? turnedRings(rings[i]).front() : rings[i]));
  }
  const BoxTree tree(boxes, BoxTree::Order::Hilbert);

  // For each ring, finds the rings inside it, so that only one index is needed at a time.
  std::vector<std::size_t> parent(rings.size(), kNoRing);
  for (std::size_t around = 0; around < rings.size(); ++around) {
    std::optional<ChainIndex> index;
    // Any point of a ring is also inside one that jumps, at one of that ring's offsets.
    const std::vector<Ring> turned = jumps(around) ? turnedRings(rings[around]) : std::vector<Ring>{};
    const Box box = turned.empty() ? boxes[around] : boundsOf(turned);
    tree.visit(box, [&](std::uint32_t i) {
      const bool smaller = areas[i] < areas[around] || (areas[i] == areas[around] && i > around);
      if (i == around || !smaller || !box.contains(boxes[i])) return;
      if (parent[i] != kNoRing && areas[parent[i]] <= areas[around]) return;
      if (!index) {
        index.emplace(ChainIndex::Kind::Rings);
        if (turned.empty()) index->add(rings[around]);
        for (const Ring& ring : turned) index->add(ring);
        index->build();
      }
      if (liesInside(rings[i], *index)) parent[i] = around;
    });
  }

  std::vector<std::size_t> by_area(rings.size());
  std::iota(by_area.begin(), by_area.end(), std::size_t{0});
  std::stable_sort(by_area.begin(), by_area.end(), [&](std::size_t i, std::size_t j) { return areas[i] > areas[j]; });
  std::vector<char> is_hole(rings.size(), 0);
  for (const std::size_t i : by_area) is_hole[i] = parent[i] != kNoRing && !is_hole[parent[i]];
  std::vector<NestedRing> nested;
  std::vector<std::size_t> place(rings.size(), kNoRing);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (is_hole[i]) continue;
    place[i] = nested.size();
    nested.push_back({i, {}});
  }
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (is_hole[i]) nested[place[parent[i]]].holes.push_back(i);
  }
  return nested;
}

}  // namespace coastmesh
