#include "gis/merge/lost_weirs.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>

#include "core/metric.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/local_plane.hpp"

namespace coastmesh {

namespace {

class GapFinder {
 public:
  GapFinder(const Grid& merged, std::span<const WeirPairs> inserted)
      : grid_(merged), weirs_(weirsOf(merged)), inserted_(inserted) {
    for (const WeirPairs& weir : weirs_)
      for (std::size_t i = 0; i + 1 < weir.size(); ++i) {
        left_.insert(edgeKey(weir[i][0], weir[i + 1][0]));
        for (const auto& [front, back] : {weir[i], weir[i + 1]}) ++ways_[edgeKey(front, back)];
      }
  }

  void add(const WeirPairs& weir) {
    for (std::size_t first = 0; first + 1 < weir.size();) {
      std::size_t last = first;
      while (last + 1 < weir.size() && !isLeft(weir, last)) ++last;
      if (last > first) addLost(weir, first, last);
      first = std::max(last, first + 1);
    }
  }

  std::vector<WeirGap> run() {
    std::ranges::stable_sort(gaps_, std::ranges::greater{}, &WeirGap::length_m);
    return std::move(gaps_);
  }

 private:
  bool isLeft(const WeirPairs& weir, std::size_t i) const {
    return left_.contains(edgeKey(weir[i][0], weir[i + 1][0]));
  }

  // What is lost of a weir from one pair to another: stretches that no weir is beside. At an end of what is
  // left, the way from there to the inserted weirs is known better.
  void addLost(const WeirPairs& weir, std::size_t first, std::size_t last) {
    const bool is_cut_before = first > 0, is_cut_after = last + 1 < weir.size();
    const auto addCut = [&](std::size_t end, double most) {
      const auto ways = ways_.find(edgeKey(weir[end][0], weir[end][1]));
      if (ways == ways_.end() || ways->second < 2)
        gaps_.push_back({std::min(most, distanceToEnds(weir[end][0])), placeOf(weir[end])});
    };
    std::vector<bool> is_replaced;  // of each edge
    for (std::size_t i = first; i < last; ++i) is_replaced.push_back(isReplaced(weir, i));
    if (std::ranges::find(is_replaced, true) == is_replaced.end()) {
      const std::size_t at = is_cut_before ? first : is_cut_after ? last : (first + last) / 2;
      gaps_.push_back({lengthOf(weir, first, last), placeOf(weir[at])});
      return;
    }
    if (is_cut_before) addCut(first, lengthOf(weir, first, last));
    if (is_cut_after) addCut(last, lengthOf(weir, first, last));
    for (std::size_t i = first; i < last;) {
      std::size_t end = i;
      while (end < last && !is_replaced[end - first]) ++end;
      if (end > i && !(i == first && is_cut_before) && !(end == last && is_cut_after))
        gaps_.push_back({lengthOf(weir, i, end), placeOf(weir[(i + end) / 2])});
      i = std::max(end, i + 1);
    }
  }

  // True if a weir of the merged mesh is beside the edge from a pair to the next, nearer than half of its length.
  bool isReplaced(const WeirPairs& weir, std::size_t i) const {
    constexpr double kBeside = 0.45;  // less than up to the next edge of the same weir
    for (const WeirPairs& other : weirs_)
      for (std::size_t k = 0; k + 1 < other.size(); ++k) {
        const auto [a, b, c, d] =
            localPlane(grid_, std::array{weir[i][0], weir[i + 1][0], other[k][0], other[k + 1][0]});
        const Point middle = midpoint(a, b);
        if (distance(middle, nearestOnSegment(middle, c, d)) <= kBeside * distance(a, b)) return true;
      }
    return false;
  }

  double lengthOf(const WeirPairs& weir, std::size_t first, std::size_t last) const {
    double length = 0.0;
    for (std::size_t i = first; i < last; ++i) length += distanceOf(weir[i][0], weir[i + 1][0]);
    return length;
  }

  double distanceOf(std::uint32_t a, std::uint32_t b) const {
    const auto [from, to] = localPlane(grid_, std::array{a, b});
    return distance(from, to);
  }

  double distanceToEnds(std::uint32_t node) const {
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
  const std::vector<WeirPairs> weirs_;  // of the merged mesh
  std::span<const WeirPairs> inserted_;
  std::set<NodePair> left_;       // their edges
  std::map<NodePair, int> ways_;  // how many of these begin at a pair
  std::vector<WeirGap> gaps_;
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

std::vector<WeirGap> weirGaps(const Grid& merged, std::span<const WeirPairs> before,
                              std::span<const WeirPairs> inserted) {
  GapFinder finder(merged, inserted);
  for (const WeirPairs& weir : before) finder.add(weir);
  return finder.run();
}

}  // namespace coastmesh
