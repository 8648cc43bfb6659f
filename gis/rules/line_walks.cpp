#include "gis/rules/line_walks.hpp"

#include <algorithm>
#include <iterator>

namespace coastmesh {
namespace {

constexpr double kStep = 0.125;     // of an edge, between samples of a line
constexpr double kMostSteps = 1e6;  // of a chain

// Some pieces of a line, for one thread.
struct Leg {
  const RuleLine* line = nullptr;
  std::size_t chain = 0;
  std::size_t first = 0, last = 0;  // piece i is from point i to the next
};

std::vector<Leg> legsOf(const std::vector<RuleChain>& chains) {
  constexpr std::size_t kPieces = 256;  // of a leg
  std::vector<Leg> legs;
  for (std::size_t chain = 0; chain < chains.size(); ++chain)
    for (const RuleLine& line : chains[chain])
      for (std::size_t first = 0; first + 1 < line.points.size(); first += kPieces)
        legs.push_back({&line, chain, first, std::min(first + kPieces, line.points.size() - 1)});
  return legs;
}

Point along(const Point& a, const Point& b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

class Walking {
 public:
  Walking(const std::vector<NearEdge>& edges, const RulePlane& plane, const EdgeSearch& search)
      : edges_(edges), plane_(plane), search_(search) {}

  double lengthOf(const RuleChain& chain) const {
    double length = 0.0;
    for (const RuleLine& line : chain)
      for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
        length += plane_.distance(line.points[i], line.points[i + 1]);
    return length;
  }

  // `whole`: the length of the chain. `guess`: an edge that may be close; becomes the last one that was.
  Walk samplesOf(const Leg& leg, double whole, std::size_t& guess) const {
    const std::vector<Point>& points = leg.line->points;
    Walk walk;
    Closest closest;
    const auto find = [&](const Point& p) {
      closest = search_.closestTo(p, false, guess);
      guess = closest.any() ? closest.edge : kNone;
    };
    find(beginOf(leg));
    if (leg.first == 0) walk.push_back({points.front(), 0.0, leg.line->rule, closest});
    for (std::size_t i = leg.first; i < leg.last; ++i) {
      const double length = plane_.distance(points[i], points[i + 1]);
      for (double at = 0.0; at < length;) {
        const double step = std::min(stepAfter(closest, whole), length - at);
        at = length - at - step < 1e-9 * length ? length : at + step;
        const Point place = along(points[i], points[i + 1], at / length);
        find(place);
        walk.push_back({place, step, leg.line->rule, closest});
      }
    }
    return walk;
  }

 private:
  // The last sample before the leg, bit for bit; the line's first point if there is none.
  Point beginOf(const Leg& leg) const {
    const std::vector<Point>& points = leg.line->points;
    for (std::size_t i = leg.first; i > 0; --i)
      if (plane_.distance(points[i - 1], points[i]) > 0.0) return along(points[i - 1], points[i], 1.0);
    return points.front();
  }
  double stepAfter(const Closest& closest, double whole) const {
    if (!closest.any()) return whole;
    const PlacedEdge& edge = edges_[closest.edge].edge;
    const double away = 0.5 * (closest.distance - kWall * edge.element);
    return std::max({kStep * edge.length, away, whole / kMostSteps});
  }

  const std::vector<NearEdge>& edges_;
  const RulePlane& plane_;
  const EdgeSearch& search_;
};

}  // namespace

std::vector<Walk> walksAlong(const std::vector<RuleChain>& chains, const std::vector<NearEdge>& edges,
                             const RulePlane& plane, const EdgeSearch& search, const ItemLoop& loop) {
  constexpr std::size_t kLeast = 4;  // legs
  const Walking walking(edges, plane, search);
  std::vector<double> lengths;
  for (const RuleChain& chain : chains) lengths.push_back(walking.lengthOf(chain));
  const std::vector<Leg> legs = legsOf(chains);
  std::vector<Walk> of_legs(legs.size());
  const auto walkSome = [&](std::size_t first, std::size_t last) {
    std::size_t guess = kNone;
    for (std::size_t l = first; l < last; ++l) of_legs[l] = walking.samplesOf(legs[l], lengths[legs[l].chain], guess);
  };
  forStretches(loop, legs.size(), walkSome, kLeast);
  std::vector<Walk> walks(chains.size());
  for (std::size_t l = 0; l < legs.size(); ++l) {
    Walk& walk = walks[legs[l].chain];
    if (walk.empty()) {
      walk = std::move(of_legs[l]);
    } else {
      walk.insert(walk.end(), of_legs[l].begin(), of_legs[l].end());
      freeMemoryOf(of_legs[l]);
    }
  }
  return walks;
}

}  // namespace coastmesh
