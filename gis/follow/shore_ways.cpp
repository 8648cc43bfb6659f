#include "gis/follow/shore_ways.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <tuple>
#include <utility>

#include "core/metric.hpp"
#include "gis/follow/shore_settle.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMostWidened = 0.25;  // of the area of the joined water
constexpr int kRounds = 3;             // waters behind one another are joined in turn
constexpr double kWide = 1e-3;         // cost of a way through wide water, per element of length

class WayFinder {
 public:
  // Ways are at least `least` sizes wide.
  WayFinder(const OpenedShores& opened, const ShoreSizes& sizes, double narrowest, double least)
      : t_(opened.before),
        scale_(sizes.scale),
        narrowest_(narrowest),
        least_(least),
        places_(locate(opened.waters)),
        cost_(mesh().triangles.size(), kInfinity),
        from_(mesh().triangles.size(), kNone) {}

  // Ways from the sought waters to joined ones. REQUIRES: waters joined before are still joined.
  std::vector<WaterWay> run(const std::vector<bool>& is_joined, const std::vector<bool>& is_sought) {
    for (std::size_t i = 0; i < is_joined.size(); ++i)
      if (is_joined[i]) start(places_[i]);
    spread(is_sought);
    std::vector<WaterWay> ways(is_joined.size());
    for (std::size_t i = 0; i < is_joined.size(); ++i) {
      if (!is_sought[i] || places_[i].empty()) continue;
      const TriId end = *std::ranges::min_element(places_[i], {}, [&](TriId t) { return cost_[t]; });
      if (cost_[end] < kInfinity) ways[i] = wayFrom(end);
    }
    return ways;
  }

 private:
  const TriMesh& mesh() const { return t_.mesh; }
  const Point& pointOf(TriId t, unsigned corner) const { return mesh().point(mesh().triangles[t].v[corner]); }
  Point centreOf(TriId t) const { return centroid(pointOf(t, 0), pointOf(t, 1), pointOf(t, 2)); }
  Point middleOf(EdgeRef e) const { return midpoint(mesh().point(mesh().origin(e)), mesh().point(mesh().target(e))); }
  double lengthOf(EdgeRef e) const { return distance(mesh().point(mesh().origin(e)), mesh().point(mesh().target(e))); }
  // The smaller of both triangles' sizes: one may reach far into open water, where sizes are larger.
  double sizeAt(EdgeRef e) const { return std::min(t_.size[triOf(e)], t_.size[triOf(mesh().twin(e))]); }
  bool isLand(TriId t) const { return mesh().regions[t] == t_.land; }
  bool isNarrow(TriId t) const { return t_.width[t] < narrowest_ && !hasOffShore(t_, t); }
  // The width of the water as a share of the size: edges reach from shore to shore, except those to a border of regions
  // in the water, whose width is unknown.
  double shareOf(EdgeRef e) const {
    if (isOffShore(t_, mesh().origin(e)) || isOffShore(t_, mesh().target(e))) return kInfinity;
    return lengthOf(e) / sizeAt(e);
  }

  // For each water, the triangles that contain its places.
  std::vector<std::vector<TriId>> locate(const std::vector<WaterPart>& waters) const {
    std::vector<std::vector<TriId>> found(waters.size());
    TriId last = 0;
    for (std::size_t i = 0; i < waters.size(); ++i) {
      for (const Point& x : waters[i].inside) {
        const TriId t = locateIn(t_, x, last);
        if (t == kNone) continue;
        last = t;
        if (!isLand(t)) found[i].push_back(t);
      }
    }
    return found;
  }

  // Starts, at cost 0, from these and from all that wide enough water connects to them.
  void start(const std::vector<TriId>& places) {
    std::vector<TriId> reached;  // a stack: the last is mostly the nearest in memory
    const auto reach = [&](TriId t) {
      if (cost_[t] == 0.0) return;
      cost_[t] = 0.0;
      from_[t] = kNone;
      reached.push_back(t);
    };
    for (const TriId t : places) reach(t);
    while (!reached.empty()) {
      const TriId t = reached.back();
      reached.pop_back();
      bool goes_on = false;
      for (const EdgeRef e : mesh().triangles[t].adj) {
        if (isLand(triOf(e))) continue;
        if (!isNarrow(triOf(e)))
          reach(triOf(e));
        else
          goes_on = goes_on || cost_[triOf(e)] > 0.0;
      }
      if (goes_on) queue_.emplace(0.0, t);
    }
  }

  // The largest cost of a way to one of the sought waters.
  double farthest(const std::vector<bool>& is_sought) const {
    double most = 0.0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      double least = kInfinity;
      for (const TriId t : places_[i]) least = std::min(least, cost_[t]);
      if (is_sought[i] && !places_[i].empty()) most = std::max(most, least);
    }
    return most;
  }

  // Dijkstra's algorithm, until all sought waters are reached. The cost is the length in elements, and more where the
  // water is narrow.
  void spread(const std::vector<bool>& is_sought) {
    std::vector<char> is_place(mesh().triangles.size(), 0);
    for (const std::vector<TriId>& places : places_)
      for (const TriId t : places) is_place[t] = 1;
    double most = farthest(is_sought);
    while (!queue_.empty() && queue_.top().first <= most) {
      const auto [cost, t] = queue_.top();
      queue_.pop();
      if (cost > cost_[t]) continue;
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(t, i);
        const TriId next = triOf(mesh().twin(e));
        if (isLand(next)) continue;
        const double share = shareOf(e);
        if (share < least_) continue;
        const double step = (distance(centreOf(t), middleOf(e)) + distance(middleOf(e), centreOf(next))) / sizeAt(e);
        const double there = cost + step * (kWide + std::max(0.0, narrowest_ / share - 1.0));
        if (!(there < cost_[next])) continue;
        cost_[next] = there;
        from_[next] = e;
        queue_.emplace(there, next);
        if (is_place[next] != 0) most = farthest(is_sought);
      }
    }
  }

  WaterWay wayFrom(TriId end) const {
    WaterWay way;
    way.exists = true;
    way.least = kInfinity;
    std::vector<Point> line{centreOf(end)};
    bool narrow_before = false;
    const auto finishLine = [&] {
      if (narrow_before) way.narrow.push_back({line, "", narrowest_});
    };
    for (TriId t = end; from_[t] != kNone; t = triOf(from_[t])) {
      const EdgeRef e = from_[t];
      const Point x = middleOf(e);
      if (shareOf(e) < way.least) {
        way.least = shareOf(e);
        way.place = x;
        way.width_m = lengthOf(e) / scale_.at(x);
      }
      if (isNarrow(t)) {
        if (!narrow_before) line.assign(1, line.back());
        const double scale = scale_.at(x), length = distance(line.back(), x) / scale;
        way.length_m += length;
        way.widening_m2 += length * std::max(0.0, narrowest_ * sizeAt(e) - lengthOf(e)) / scale;
        narrow_before = true;
      } else {
        finishLine();
        narrow_before = false;
      }
      line.push_back(x);
    }
    finishLine();
    return way;
  }

  const ShoreTriangles& t_;
  const ScaleTable& scale_;
  const double narrowest_, least_;
  const std::vector<std::vector<TriId>> places_;  // triangles in each of the waters
  std::vector<double> cost_;
  std::vector<EdgeRef> from_;  // the edge crossed into a triangle
  std::priority_queue<std::pair<double, TriId>, std::vector<std::pair<double, TriId>>, std::greater<>> queue_;
};

std::vector<bool> areKept(const std::vector<WaterPart>& waters) {
  std::vector<bool> kept;
  for (const WaterPart& water : waters) kept.push_back(water.kept);
  return kept;
}

std::vector<bool> butNot(std::vector<bool> these, const std::vector<bool>& others) {
  for (std::size_t i = 0; i < these.size(); ++i)
    if (others[i]) these[i] = false;
  return these;
}

bool hasAny(const std::vector<bool>& these) { return std::ranges::find(these, true) != these.end(); }

}  // namespace

std::vector<bool> areMain(const std::vector<WaterPart>& waters) {
  std::map<RegionId, std::size_t> largest;
  for (std::size_t i = 0; i < waters.size(); ++i) {
    if (!waters[i].kept) continue;
    const auto [at, is_first] = largest.emplace(waters[i].whole, i);
    if (!is_first && waters[i].area > waters[at->second].area) at->second = i;
  }
  std::vector<bool> main(waters.size(), false);
  for (const auto& [whole, i] : largest) main[i] = true;
  return main;
}

std::vector<WaterWay> waysToWaters(const OpenedShores& opened, const ShoreSizes& sizes, const FollowOptions& options) {
  const std::vector<bool> main = areMain(opened.waters), kept = areKept(opened.waters);
  const std::vector<bool> apart = butNot(kept, main), cut_off = butNot(std::vector<bool>(kept.size(), true), kept);
  std::vector<WaterWay> ways(kept.size());
  if (!hasAny(apart) && !hasAny(cut_off)) return ways;
  WayFinder finder(opened, sizes, options.channel_min, 0.0);
  const auto find = [&](const std::vector<bool>& joined, const std::vector<bool>& sought) {
    if (!hasAny(sought)) return;
    std::vector<WaterWay> found = finder.run(joined, sought);
    for (std::size_t i = 0; i < ways.size(); ++i)
      if (sought[i]) ways[i] = std::move(found[i]);
  };
  find(main, apart);
  find(kept, cut_off);
  return ways;
}

std::vector<JoinedWater> waysToJoin(const OpenedShores& opened, const ShoreSizes& sizes, const FollowOptions& options) {
  const std::vector<bool> kept = areKept(opened.waters);
  const std::vector<bool> every(kept.size(), true);
  std::vector<bool> joined = areMain(opened.waters);
  std::vector<JoinedWater> found;
  if (!hasAny(butNot(every, joined))) return found;
  WayFinder finder(opened, sizes, options.channel_min, options.strait_min);
  // Joins those of `candidates` that are not joined yet.
  const auto join = [&](const std::vector<bool>& candidates) {
    for (int round = 0; round < kRounds; ++round) {
      const std::vector<bool> sought = butNot(candidates, joined);
      if (!hasAny(sought)) return;
      const std::size_t before = found.size();
      std::vector<WaterWay> ways = finder.run(joined, sought);
      for (std::size_t i = 0; i < ways.size(); ++i) {
        const double area = opened.waters[i].area;
        if (ways[i].narrow.empty() || ways[i].widening_m2 > kMostWidened * area) continue;
        found.push_back({std::move(ways[i]), area, opened.waters[i].inside, kept[i]});
        joined[i] = true;
      }
      if (found.size() == before) return;
    }
  };
  // First joins kept waters to the largest; the others may then be joined to any of them.
  join(kept);
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i]) joined[i] = true;
  join(every);
  return found;
}

}  // namespace coastmesh
