#include "gis/follow/shore_ways.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <utility>

#include "core/metric.hpp"
#include "gis/follow/water_basins.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMostWidened = 0.25;  // of the area of the joined water
constexpr int kRounds = 3;             // waters behind one another are joined in turn
constexpr double kWide = 1e-3;         // cost of a way through wide water, per element of length
constexpr double kThinned = 0.25;      // of the size: thinning makes water seem narrower by less
constexpr int kAttempts = 6;           // to find other ways where the data are narrower than shores as thinned

// Finds ways through the water of the data, between large basins if the waters have any. All that is narrow in the data
// counts, also where land that was removed has made it wider.
class WayFinder {
 public:
  // Ways are at least `least` sizes wide; if 0, each is the widest.
  WayFinder(const WaterGaps& gaps, const OpenedShores& opened, const ShoreSizes& sizes, double least)
      : t_(gaps.triangles()),
        gaps_(gaps),
        scale_(sizes.scale),
        narrowest_(gaps.narrowestOpen()),
        least_(least),
        basins_(basinsOf(gaps, opened)),
        has_large_(opened.waters.size(), 0) {
    for (TriId t = 0; t < basins_.water.size(); ++t)
      if (basins_.is_large[t] != 0) has_large_[basins_.water[t]] = 1;
  }

  // Ways from the sought waters to joined ones.
  std::vector<WaterWay> run(const std::vector<bool>& is_joined, const std::vector<bool>& is_sought) {
    std::vector<WaterWay> ways;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      spread(is_joined, is_sought);
      ways.assign(is_joined.size(), {});
      for (std::size_t i = 0; i < ways.size(); ++i)
        if (end_[i] != kNone) ways[i] = wayFrom(end_[i]);
      if (!barTooNarrow(measured(ways))) break;
    }
    for (WaterWay& way : ways)
      if (way.exists && way.least < least_) way = {};
    return ways;
  }

 private:
  const TriMesh& mesh() const { return t_.mesh; }
  const Point& pointOf(TriId t, unsigned corner) const { return mesh().point(mesh().triangles[t].v[corner]); }
  Point centreOf(TriId t) const { return centroid(pointOf(t, 0), pointOf(t, 1), pointOf(t, 2)); }
  Point middleOf(EdgeRef e) const { return midpoint(mesh().point(mesh().origin(e)), mesh().point(mesh().target(e))); }
  bool isLand(TriId t) const { return mesh().regions[t] == t_.land; }
  // The water whose end of a way the triangle is, or kNone.
  std::uint32_t endIn(TriId t) {
    const std::uint32_t water = basins_.water[t];
    if (isLand(t) || water == kNone) return kNone;
    return has_large_[water] == 0 || basins_.is_large[basins_.sets.find(t)] != 0 ? water : kNone;
  }
  bool isClosed(EdgeRef e) const {
    const std::uint32_t water = basins_.water[triOf(e)];
    return water == kNone || basins_.water[triOf(mesh().twin(e))] != water;
  }

  // Dijkstra's algorithm, until all sought waters are reached. The cost is the length in elements, and more where the
  // water is narrow; of the widest way, its narrowness.
  void spread(const std::vector<bool>& is_joined, const std::vector<bool>& is_sought) {
    start(is_joined);
    end_.assign(is_sought.size(), kNone);
    auto left = std::ranges::count(is_sought, true);
    while (!queue_.empty() && left > 0) {
      const auto [cost, t] = queue_.top();
      queue_.pop();
      if (cost > cost_[t]) continue;
      if (const std::uint32_t water = endIn(t); water != kNone && is_sought[water] && end_[water] == kNone) {
        end_[water] = t;
        --left;
      }
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(t, i);
        const TriId next = triOf(mesh().twin(e));
        if (isLand(next) || cost_[next] == 0.0) continue;
        const double there = costAcross(e, cost);
        if (!(there < cost_[next])) continue;
        cost_[next] = there;
        from_[next] = e;
        queue_.emplace(there, next);
      }
    }
  }

  void start(const std::vector<bool>& is_joined) {
    const std::size_t count = mesh().triangles.size();
    cost_.assign(count, kInfinity);
    from_.assign(count, kNone);
    queue_ = {};
    for (TriId t = 0; t < count; ++t)
      if (const std::uint32_t water = endIn(t); water != kNone && is_joined[water]) cost_[t] = 0.0;
    for (TriId t = 0; t < count; ++t) {
      const auto goesOn = [&](EdgeRef e) { return !isLand(triOf(e)) && cost_[triOf(e)] != 0.0; };
      if (cost_[t] == 0.0 && std::ranges::any_of(mesh().triangles[t].adj, goesOn)) queue_.emplace(0.0, t);
    }
  }

  // Infinite if it may not be crossed.
  double costAcross(EdgeRef e, double before) const {
    const double share = gaps_.isNarrow(e) ? gaps_.share(e) : kInfinity;
    if (share < least_ - kThinned || barred_.contains(std::min(e, mesh().twin(e)))) return kInfinity;
    if (least_ == 0.0) return std::max({before, kWide, narrowest_ / share});
    const TriId t = triOf(e), next = triOf(mesh().twin(e));
    const Point x = middleOf(e);
    const double step = (distance(centreOf(t), x) + distance(x, centreOf(next))) / gaps_.sizeAt(e);
    return before + step * (kWide + std::max(0.0, narrowest_ / share - 1.0));
  }

  WaterWay wayFrom(TriId end) {
    WaterWay way;
    way.exists = true;
    std::vector<Point> line{centreOf(end)};
    bool narrow_before = false, crossed_narrow = false;
    const auto finishLine = [&] {
      if (narrow_before) way.narrow.push_back({line, "", narrowest_});
    };
    for (TriId t = end; from_[t] != kNone; t = triOf(from_[t])) {
      const EdgeRef e = from_[t];
      const Point x = middleOf(e);
      const bool closed = isClosed(e), narrow = closed || gaps_.isNarrow(e);
      if (narrow) way.crossed.push_back(e);
      if (narrow || crossed_narrow) {
        if (!narrow_before) line.assign(1, line.back());
        const double scale = scale_.at(x), length = distance(line.back(), x) / scale;
        way.length_m += length;
        if (closed) way.widening_m2 += length * std::max(0.0, narrowest_ - gaps_.share(e)) * gaps_.sizeAt(e) / scale;
        narrow_before = true;
      } else {
        finishLine();
        narrow_before = false;
      }
      crossed_narrow = narrow;
      line.push_back(x);
    }
    finishLine();
    return way;
  }

  // The ways with the widths of the data.
  std::vector<WaterWay>& measured(std::vector<WaterWay>& ways) const {
    std::vector<std::vector<EdgeRef>> crossed;
    for (const WaterWay& way : ways) crossed.push_back(way.crossed);
    std::vector<NarrowPlace> places = gaps_.narrowest(crossed, least_);
    for (std::size_t i = 0; i < ways.size(); ++i) {
      if (!ways[i].exists) continue;
      auto& [gap, share, too_narrow] = places[i];
      ways[i].least = share;
      ways[i].place = gap.middle;
      ways[i].width_m = gap.width / scale_.at(gap.middle);
      ways[i].too_narrow = std::move(too_narrow);
    }
    return ways;
  }

  // Keeps further ways from passing where these are too narrow. Returns false if none is.
  bool barTooNarrow(const std::vector<WaterWay>& ways) {
    const std::size_t before = barred_.size();
    for (const WaterWay& way : ways)
      for (const EdgeRef e : way.too_narrow) barred_.insert(std::min(e, mesh().twin(e)));
    return barred_.size() > before;
  }

  const ShoreTriangles& t_;
  const WaterGaps& gaps_;
  const ScaleTable& scale_;
  const double narrowest_, least_;
  WaterBasins basins_;
  std::vector<char> has_large_;  // by water: a large basin
  std::set<EdgeRef> barred_;     // as thinned wide enough, but not in the data
  std::vector<double> cost_;
  std::vector<EdgeRef> from_;  // the edge crossed into a triangle
  std::vector<TriId> end_;     // of the way to each sought water
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

bool isWorthWidening(const WaterWay& way, double area) { return way.widening_m2 <= kMostWidened * area; }

std::vector<WaterWay> waysToWaters(const WaterGaps& gaps, const OpenedShores& opened, const ShoreSizes& sizes) {
  const std::vector<bool> main = areMain(opened.waters), kept = areKept(opened.waters);
  const std::vector<bool> apart = butNot(kept, main), cut_off = butNot(std::vector<bool>(kept.size(), true), kept);
  std::vector<WaterWay> ways(kept.size());
  if (!hasAny(apart) && !hasAny(cut_off)) return ways;
  WayFinder finder(gaps, opened, sizes, 0.0);
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

std::vector<JoinedWater> waysToJoin(const WaterGaps& gaps, const OpenedShores& opened, const ShoreSizes& sizes,
                                    const FollowOptions& options) {
  const std::vector<bool> kept = areKept(opened.waters);
  const std::vector<bool> every(kept.size(), true);
  std::vector<bool> joined = areMain(opened.waters);
  std::vector<JoinedWater> found;
  if (!hasAny(butNot(every, joined))) return found;
  WayFinder finder(gaps, opened, sizes, options.strait_min);
  // Joins those of `candidates` that are not joined yet.
  const auto join = [&](const std::vector<bool>& candidates) {
    for (int round = 0; round < kRounds; ++round) {
      const std::vector<bool> sought = butNot(candidates, joined);
      if (!hasAny(sought)) return;
      const std::size_t before = found.size();
      std::vector<WaterWay> ways = finder.run(joined, sought);
      for (std::size_t i = 0; i < ways.size(); ++i) {
        const double area = opened.waters[i].area;
        if (ways[i].narrow.empty() || !isWorthWidening(ways[i], area)) continue;
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
