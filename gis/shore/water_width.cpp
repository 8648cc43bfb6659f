#include "gis/shore/water_width.hpp"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

namespace {

// The mean width is twice the area over the length of the shore: the width of a strip, half that of a circle or square.
constexpr double kNarrow = 0.45;                   // of the size wanted
constexpr double kLeast = 0.7;                     // of the limited size: the least length of segments
constexpr double kDisk = 0.25 * std::numbers::pi;  // area of one of diameter 1

struct Ring {
  VertexId start;
  double area = 0.0;  // negative around land
  double length = 0.0;
  Box box{};
};

// Calls `visit(v)` for the vertices of the ring.
template <typename Visit>
void forVertices(const ShoreChains& c, const Ring& ring, Visit&& visit) {
  VertexId v = ring.start;
  do {
    visit(v);
    v = c.next[v];
  } while (v != ring.start);
}

// Closed chains; what ends at a place where the graph touches itself is none.
std::vector<Ring> ringsOf(const ShoreChains& c) {
  std::vector<Ring> rings;
  std::vector<char> seen(c.at.size(), 0);
  for (VertexId start = 0; start < c.at.size(); ++start) {
    if (!c.alive[start]) continue;
    Ring ring{start};
    VertexId v = start;
    while (v != kNone && seen[v] == 0) {
      seen[v] = 1;
      ring.box.add(c.at[v]);
      const VertexId next = c.next[v];
      if (next != kNone) {
        ring.area += 0.5 * cross(c.at[v] - c.at[start], c.at[next] - c.at[start]);
        ring.length += distance(c.at[v], c.at[next]);
      }
      v = next;
    }
    if (v == start && ring.length > 0.0) rings.push_back(ring);
  }
  return rings;
}

// By the number of segments that a ray to the east crosses.
bool isInside(const ShoreChains& c, const Ring& ring, const Point& x) {
  bool inside = false;
  forVertices(c, ring, [&](VertexId v) {
    const Point &a = c.at[v], &b = c.at[c.next[v]];
    if ((a.y > x.y) != (b.y > x.y) && x.x < a.x + (x.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  });
  return inside;
}

// A water's outer ring, and the rings of land in it.
using Water = std::vector<Ring>;

// Land belongs to the smallest outer ring around it. If its box is in those of several, the largest is not tested: the
// shore of a sea would be walked along for each island.
std::vector<Water> watersOf(const ShoreChains& c) {
  const std::vector<Ring> rings = ringsOf(c);
  std::vector<Water> waters;
  std::vector<Box> boxes;
  for (const Ring& ring : rings) {
    if (ring.area <= 0.0) continue;
    waters.push_back({ring});
    boxes.push_back(ring.box);
  }
  if (waters.empty()) return waters;
  const BoxTree tree(boxes, BoxTree::Order::Hilbert);
  std::vector<std::uint32_t> around;
  for (const Ring& ring : rings) {
    if (ring.area > 0.0) continue;
    around.clear();
    tree.visit(ring.box, [&](std::uint32_t w) {
      if (boxes[w].contains(ring.box)) around.push_back(w);
    });
    if (around.empty()) continue;
    std::ranges::sort(around, {}, [&](std::uint32_t w) { return std::pair(waters[w].front().area, w); });
    const auto found = std::find_if(around.begin(), around.end() - 1,
                                    [&](std::uint32_t w) { return isInside(c, waters[w].front(), c.at[ring.start]); });
    waters[*found].push_back(ring);
  }
  return waters;
}

// Limits sizes where `is_large(size, area, width)`, for the water's area and mean width. Spares regions with a water
// in which no size is large: their other waters are what was cut off from it, and need not be finer than it.
template <typename IsLarge>
void limitWhere(ShoreChains& chains, IsLarge&& is_large) {
  const std::vector<Water> waters = watersOf(chains);
  std::vector<double> areas, widths;
  std::set<RegionId> spared;
  const auto regionOf = [&](const Water& water) { return chains.leaving[water.front().start].left; };
  for (const Water& water : waters) {
    double area = 0.0, length = 0.0;
    for (const Ring& ring : water) area += ring.area, length += ring.length;
    areas.push_back(area);
    widths.push_back(2.0 * area / length);
    bool any_large = false;
    forVertices(chains, water.front(),
                [&](VertexId v) { any_large = any_large || is_large(chains.size[v], area, widths.back()); });
    if (!any_large) spared.insert(regionOf(water));
  }
  for (std::size_t w = 0; w < waters.size(); ++w) {
    const double area = areas[w], width = widths[w];
    if (!(width > 0.0) || spared.contains(regionOf(waters[w]))) continue;
    for (const Ring& ring : waters[w]) {
      forVertices(chains, ring, [&](VertexId v) {
        if (!is_large(chains.size[v], area, width)) return;
        chains.size[v] = std::min(chains.size[v], width);
        if (!chains.least.empty()) chains.least[v] = std::min(chains.least[v], kLeast * width);
      });
    }
  }
}

}  // namespace

void limitToSmallWaters(ShoreChains& chains) {
  limitWhere(chains, [](double size, double area, double) { return area < kDisk * size * size; });
}

void limitToNarrowWaters(ShoreChains& chains) {
  limitWhere(chains, [](double size, double, double width) { return width < kNarrow * size; });
}

}  // namespace coastmesh
