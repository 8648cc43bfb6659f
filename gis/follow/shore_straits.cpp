#include "gis/follow/shore_straits.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <utility>

#include "core/metric.hpp"
#include "gis/follow/shore_patches.hpp"

namespace coastmesh {

namespace {

constexpr double kLeast = 2.0;  // of the size wanted; shorter ones are not reported
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class StraitFinder {
 public:
  StraitFinder(const ShoreTriangles& triangles, const ScaleTable& scales) : t_(triangles), scale_(scales) {}

  std::vector<ClosedStrait> run() {
    const Patches closed =
        patchesOf(mesh(), [&](TriId t) { return t_.region_was[t] != t_.land && mesh().regions[t] == t_.land; });
    const Patches waters = patchesOf(mesh(), [&](TriId t) { return mesh().regions[t] != t_.land; });
    way_.assign(mesh().triangles.size(), kInfinity);
    from_.assign(mesh().triangles.size(), kNone);
    std::vector<ClosedStrait> straits;
    for (const std::vector<TriId>& patch : closed.triangles) {
      std::map<std::uint32_t, std::vector<TriId>> gates;  // of each water: triangles of the patch beside it
      for (const TriId t : patch) {
        for (const EdgeRef e : mesh().triangles[t].adj) {
          const std::uint32_t water = waters.of[triOf(e)];
          if (water == kNone) continue;
          std::vector<TriId>& of = gates[water];
          if (of.empty() || of.back() != t) of.push_back(t);
        }
      }
      ClosedStrait longest;
      for (const auto& [water, of] : gates) {
        if (of.size() < 2) continue;
        const TriId one = farthest(patch, closed.of, of, of.front());
        const TriId other = farthest(patch, closed.of, of, one);
        const ClosedStrait strait = along(one, other);
        if (strait.length_m > longest.length_m) longest = strait;
      }
      if (longest.length_m > 0.0) straits.push_back(longest);
    }
    return straits;
  }

 private:
  const TriMesh& mesh() const { return t_.mesh; }
  Point centreOf(TriId t) const {
    const auto& v = mesh().triangles[t].v;
    return centroid(mesh().point(v[0]), mesh().point(v[1]), mesh().point(v[2]));
  }

  // The gate with the longest way from `start`. The ways are in `way_` and `from_`.
  TriId farthest(const std::vector<TriId>& patch, const std::vector<std::uint32_t>& number,
                 const std::vector<TriId>& gates, TriId start) {
    for (const TriId t : patch) way_[t] = kInfinity;
    std::priority_queue<std::pair<double, TriId>, std::vector<std::pair<double, TriId>>, std::greater<>> queue;
    way_[start] = 0.0;
    from_[start] = kNone;
    queue.emplace(0.0, start);
    while (!queue.empty()) {
      const auto [way, t] = queue.top();
      queue.pop();
      if (way > way_[t]) continue;
      for (unsigned i = 0; i < 3; ++i) {
        const TriId next = triOf(mesh().twin(edgeRef(t, i)));
        if (number[next] != number[start]) continue;
        const double there = way + distance(centreOf(t), centreOf(next));
        if (!(there < way_[next])) continue;
        way_[next] = there;
        from_[next] = edgeRef(t, i);
        queue.emplace(there, next);
      }
    }
    return *std::ranges::max_element(gates, {}, [&](TriId t) { return way_[t]; });
  }

  // Along the way found last.
  ClosedStrait along(TriId start, TriId end) const {
    ClosedStrait strait;
    double narrowest = kInfinity, length = 0.0;
    // Middles of crossed edges: centroids alternate between the two shores.
    std::vector<Point> middles;
    for (TriId t = end; t != start; t = triOf(from_[t])) {
      const Point &a = mesh().point(mesh().origin(from_[t])), &b = mesh().point(mesh().target(from_[t]));
      narrowest = std::min(narrowest, distance(a, b));
      middles.push_back(midpoint(a, b));
      if (middles.size() > 1) length += distance(middles[middles.size() - 2], middles.back());
      if (way_[t] >= 0.5 * way_[end]) strait.place = middles.back();
    }
    if (length < kLeast * t_.size[end]) return strait;
    const double scale = scale_.at(strait.place);
    strait.length_m = length / scale;
    strait.width_m = narrowest / scale;
    return strait;
  }

  const ShoreTriangles& t_;
  const ScaleTable& scale_;
  std::vector<double> way_;
  std::vector<EdgeRef> from_;  // the edge crossed into a triangle
};

}  // namespace

std::vector<ClosedStrait> closedStraits(const ShoreTriangles& triangles, const ScaleTable& scales) {
  return StraitFinder(triangles, scales).run();
}

}  // namespace coastmesh
