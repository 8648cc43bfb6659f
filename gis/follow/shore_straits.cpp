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
#include "gis/follow/water_basins.hpp"

namespace coastmesh {

namespace {

constexpr double kLeast = 2.0;  // of the size wanted; shorter ones are not reported
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class StraitFinder {
 public:
  StraitFinder(const WaterGaps& gaps, const OpenedShores& opened, KeepWater keep, const ScaleTable& scales)
      : t_(gaps.triangles()), gaps_(gaps), scale_(scales), water_(watersIn(t_, opened)) {
    for (std::uint32_t& water : water_)
      if (water != kNone && !opened.waters[water].kept && keep != KeepWater::All) water = kNone;
  }

  std::vector<ClosedStrait> run() {
    const Patches closed =
        patchesOf(mesh(), [&](TriId t) { return mesh().regions[t] != t_.land && water_[t] == kNone; });
    way_.assign(mesh().triangles.size(), kInfinity);
    from_.assign(mesh().triangles.size(), kNone);
    std::vector<ClosedStrait> straits;
    std::vector<std::vector<EdgeRef>> widest;
    for (const std::vector<TriId>& patch : closed.triangles) {
      std::map<std::uint32_t, std::vector<TriId>> gates;  // of each water: triangles of the patch beside it
      for (const TriId t : patch) {
        for (const EdgeRef e : mesh().triangles[t].adj) {
          if (mesh().regions[triOf(e)] == t_.land || water_[triOf(e)] == kNone) continue;
          std::vector<TriId>& of = gates[water_[triOf(e)]];
          if (of.empty() || of.back() != t) of.push_back(t);
        }
      }
      ClosedStrait longest;
      std::pair<TriId, TriId> ends;
      for (const auto& [water, of] : gates) {
        if (of.size() < 2) continue;
        const TriId one = farthest(patch, closed.of, of, of.front());
        const TriId other = farthest(patch, closed.of, of, one);
        const ClosedStrait strait = along(one, other);
        if (strait.length_m <= longest.length_m) continue;
        longest = strait;
        ends = {one, other};
      }
      if (longest.length_m == 0.0) continue;
      straits.push_back(longest);
      widest.push_back(widestWay(patch, closed.of, ends));
    }
    const std::vector<NarrowPlace> narrowest = gaps_.narrowest(widest);
    for (std::size_t i = 0; i < straits.size(); ++i)
      straits[i].width_m = narrowest[i].gap.width / scale_.at(narrowest[i].gap.middle);
    return straits;
  }

 private:
  const TriMesh& mesh() const { return t_.mesh; }
  Point centreOf(TriId t) const {
    const auto& v = mesh().triangles[t].v;
    return centroid(mesh().point(v[0]), mesh().point(v[1]), mesh().point(v[2]));
  }
  double stepAcross(EdgeRef e) const { return distance(centreOf(triOf(e)), centreOf(triOf(mesh().twin(e)))); }

  // Dijkstra's algorithm in a patch; `cost(e, before)` is that of a way across e. The ways are in `way_` and `from_`.
  template <typename Cost>
  void search(const std::vector<TriId>& patch, const std::vector<std::uint32_t>& number, TriId start, Cost&& cost) {
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
        const double there = cost(edgeRef(t, i), way);
        if (!(there < way_[next])) continue;
        way_[next] = there;
        from_[next] = edgeRef(t, i);
        queue.emplace(there, next);
      }
    }
  }

  // The gate with the longest way from `start`.
  TriId farthest(const std::vector<TriId>& patch, const std::vector<std::uint32_t>& number,
                 const std::vector<TriId>& gates, TriId start) {
    search(patch, number, start, [&](EdgeRef e, double before) { return before + stepAcross(e); });
    return *std::ranges::max_element(gates, {}, [&](TriId t) { return way_[t]; });
  }

  // Along the way found last.
  ClosedStrait along(TriId start, TriId end) const {
    ClosedStrait strait;
    double length = 0.0;
    // Middles of crossed edges: centroids alternate between the two shores.
    std::vector<Point> middles;
    for (TriId t = end; t != start; t = triOf(from_[t])) {
      middles.push_back(midpoint(mesh().point(mesh().origin(from_[t])), mesh().point(mesh().target(from_[t]))));
      if (middles.size() > 1) length += distance(middles[middles.size() - 2], middles.back());
      if (way_[t] >= 0.5 * way_[end]) strait.place = middles.back();
    }
    if (length < kLeast * t_.size[end]) return strait;
    strait.length_m = length / scale_.at(strait.place);
    return strait;
  }

  // The edges that the widest way between two triangles crosses.
  std::vector<EdgeRef> widestWay(const std::vector<TriId>& patch, const std::vector<std::uint32_t>& number,
                                 const std::pair<TriId, TriId>& ends) {
    search(patch, number, ends.first, [&](EdgeRef e, double before) { return std::max(before, 1.0 / gaps_.share(e)); });
    std::vector<EdgeRef> crossed;
    for (TriId t = ends.second; t != ends.first; t = triOf(from_[t])) crossed.push_back(from_[t]);
    return crossed;
  }

  const ShoreTriangles& t_;
  const WaterGaps& gaps_;
  const ScaleTable& scale_;
  std::vector<std::uint32_t> water_;  // that is left: of each triangle
  std::vector<double> way_;
  std::vector<EdgeRef> from_;  // the edge crossed into a triangle
};

}  // namespace

std::vector<ClosedStrait> closedStraits(const WaterGaps& gaps, const OpenedShores& opened, KeepWater keep,
                                        const ScaleTable& scales) {
  return StraitFinder(gaps, opened, keep, scales).run();
}

}  // namespace coastmesh
