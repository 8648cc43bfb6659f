#include "gis/merge/cut_weirs.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "core/metric.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/local_plane.hpp"

namespace coastmesh {

namespace {

class WeirCutter {
 public:
  WeirCutter(const Grid& merged, std::span<const WeirPairs> inserted) : grid_(merged), inserted_(inserted) {
    for (const WeirPairs& weir : weirsOf(merged))
      for (std::size_t i = 0; i + 1 < weir.size(); ++i) left_.insert(edgeKey(weir[i][0], weir[i + 1][0]));
    for (const WeirPairs& weir : inserted)
      for (const auto& [front, back] : weir) of_inserted_.insert(edgeKey(front, back));
  }

  void add(const WeirPairs& weir) {
    for (std::size_t i = 0; i + 1 < weir.size();) {
      const std::size_t first = i;
      double length = 0.0;
      while (i + 1 < weir.size() && !left_.contains(edgeKey(weir[i][0], weir[i + 1][0]))) {
        length += distanceOf(weir[i][0], weir[i + 1][0]);
        ++i;
      }
      if (i == first) {
        ++i;
        continue;
      }
      if (inserted_.empty()) {
        if (found_.lost_m == 0.0) found_.lost_at = placeOf(weir[(first + i) / 2]);
        found_.lost_m += length;
        continue;
      }
      for (const std::size_t end : {first, i})
        if (end != 0 && end + 1 != weir.size() && !of_inserted_.contains(edgeKey(weir[end][0], weir[end][1])))
          found_.gaps.push_back({std::min(length, distanceToInserted(weir[end][0])), placeOf(weir[end])});
    }
  }

  CutWeirs run() {
    std::ranges::stable_sort(found_.gaps, std::ranges::greater{}, &WeirGap::length_m);
    return std::move(found_);
  }

 private:
  double distanceOf(std::uint32_t a, std::uint32_t b) const {
    const std::array<Point, 2> ends = localPlane(grid_, std::array{a, b});
    return distance(ends[0], ends[1]);
  }

  double distanceToInserted(std::uint32_t node) const {
    double least = std::numeric_limits<double>::infinity();
    for (const WeirPairs& weir : inserted_)
      for (const NodePair& end : {weir.front(), weir.back()})
        for (const std::uint32_t v : end) least = std::min(least, distanceOf(node, v));
    return least;
  }

  Point placeOf(const NodePair& pair) const {
    return meanPlace(grid_.crs, std::array{grid_.nodes[pair[0]], grid_.nodes[pair[1]]});
  }

  const Grid& grid_;
  std::span<const WeirPairs> inserted_;
  std::set<NodePair> left_;         // edges of the merged grid's weirs
  std::set<NodePair> of_inserted_;  // pairs
  CutWeirs found_;
};

}  // namespace

std::vector<WeirPairs> weirsOf(const Grid& grid) {
  std::vector<WeirPairs> all;
  for (const Boundary& boundary : grid.boundaries) {
    if (boundary.back_nodes.empty()) continue;
    WeirPairs& weir = all.emplace_back();
    for (std::size_t i = 0; i < boundary.nodes.size(); ++i) weir.push_back({boundary.nodes[i], boundary.back_nodes[i]});
    if (boundary.closed) weir.push_back(weir.front());
  }
  return all;
}

CutWeirs cutWeirs(const Grid& merged, std::span<const WeirPairs> before, std::span<const WeirPairs> inserted) {
  WeirCutter cutter(merged, inserted);
  for (const WeirPairs& weir : before) cutter.add(weir);
  return cutter.run();
}

}  // namespace coastmesh
