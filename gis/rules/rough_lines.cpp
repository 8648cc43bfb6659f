#include "gis/rules/rough_lines.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "gis/geometry/box_tree.hpp"
#include "gis/rules/edge_search.hpp"
#include "gis/rules/line_walks.hpp"
#include "gis/rules/rule_chains.hpp"

namespace coastmesh {
namespace {

constexpr double kBeside = 0.5;      // elements: a line as close is beside the boundary
constexpr double kMostOfEdge = 0.6;  // share of an edge that a line has to pass
constexpr double kContinues = 0.5;   // elements: a line that begins as close to another's end continues it
constexpr double kDetour = 2.0;      // edges between two of a line are at most as many times its length
constexpr double kShort = 2.0;       // elements: a shorter line or polygon may be about a single edge
constexpr double kEnd = 1.5;         // elements: the end of a line that stays as close is not one that leads away

class RoughLines {
 public:
  RoughLines(const RuleShapes& shapes, const std::vector<BoundaryRule>& rules, const RulePlane& plane,
             std::vector<NearEdge>& edges, const ItemLoop& loop)
      : shapes_(shapes), rules_(rules), plane_(plane), edges_(edges), search_(edges, plane, loop) {
    std::vector<BoundaryKind> kinds;
    for (const BoundaryRule& rule : rules) {
      const auto at = std::ranges::find(kinds, rule.kind);
      kind_of_.push_back(static_cast<std::size_t>(at - kinds.begin()));
      if (at == kinds.end()) kinds.push_back(rule.kind);
    }
    const auto reach = [this, guess = std::size_t{kNone}](const Point& end) mutable {
      const Closest closest = search_.closestTo(end, false, guess);
      if (!closest.any()) return 0.0;
      guess = closest.edge;
      return kContinues * edges_[closest.edge].edge.element;
    };
    walks_ = walksAlong(chainsOf(shapes, rules, plane, reach), edges_, plane, search_, loop);
  }

  void takePassed() {
    using ByEdgeAndKind = std::map<std::pair<std::size_t, std::size_t>, Passed>;
    ByEdgeAndKind passed;
    auto last = passed.end();  // most samples are beside the same edge as the one before
    for (const Walk& walk : walks_) {
      for (const Sample& sample : walk) {
        if (!isBeside(sample, kBeside) || isSettled(sample)) continue;
        const ByEdgeAndKind::key_type which{sample.closest.edge, kind_of_[sample.rule]};
        if (last == passed.end() || last->first != which) last = passed.try_emplace(which).first;
        Passed& edge = last->second;
        edge.begin = std::min(edge.begin, sample.closest.share);
        edge.end = std::max(edge.end, sample.closest.share);
        edge.rule = std::max(edge.rule, sample.rule);
      }
    }
    for (const auto& [which, edge] : passed)
      if (edge.end - edge.begin >= kMostOfEdge) give(which.first, edge.rule);
  }

  // Takes edges between those where a line leaves the boundary and where it comes back.
  void takeBetween() {
    for (const Walk& walk : walks_) {
      for (const Stretch& stretch : stretchesOf(walk)) {
        const std::optional<Path> path = pathBeside(walk, stretch);
        if (!path || !staysNear(*path, walk, stretch)) continue;
        for (const std::uint32_t edge : *path) give(edge, walk[stretch.first].rule);
      }
    }
  }

  std::vector<MissedPart> missed(const std::vector<bool>& used) {
    std::vector<MissedPart> parts;
    for (const Walk& walk : walks_)
      if (const auto part = missedOf(walk)) parts.push_back(*part);
    for (std::size_t rule = 0; rule < rules_.size(); ++rule) {
      if (rules_[rule].form != RuleForm::Area || !rules_[rule].opens() || used[rule]) continue;
      if (const auto part = missedOfArea(rule)) parts.push_back(*part);
    }
    return parts;
  }

 private:
  using Path = std::vector<std::uint32_t>;  // edges, one after another
  struct Passed {                           // the part of an edge
    double begin = 1.0, end = 0.0;
    std::size_t rule = 0;
  };
  struct Stretch {  // samples [first, last) without an edge, the longest such; none where a line skips edges
    std::size_t first = 0, last = 0;
  };

  const PlacedEdge& edgeAt(const Sample& sample) const { return edges_[sample.closest.edge].edge; }
  bool isBeside(const Sample& sample, double elements) const {
    return sample.closest.any() && sample.closest.distance <= elements * edgeAt(sample).element;
  }
  // True if the edge has the rule's type, or a later rule's.
  bool isSettled(std::size_t edge, std::size_t rule) const {
    const std::optional<std::size_t> has = edges_[edge].rule;
    return has && (*has >= rule || rules_[*has].kind == rules_[rule].kind);
  }
  bool isSettled(const Sample& sample) const { return isSettled(sample.closest.edge, sample.rule); }
  bool hasEdge(const Sample& sample) const { return isBeside(sample, kBeside) && isSettled(sample); }
  void give(std::size_t edge, std::size_t rule) {
    edges_[edge].rule = std::max(edges_[edge].rule, std::optional(rule));
  }

  std::vector<Stretch> stretchesOf(const Walk& walk) const {
    std::vector<Stretch> stretches;
    for (std::size_t i = 0; i < walk.size(); ++i) {
      if (hasEdge(walk[i])) {
        if (i > 0 && skipsEdges(walk[i - 1], walk[i])) stretches.push_back({i, i});
        continue;
      }
      Stretch stretch{i, i + 1};
      while (stretch.last < walk.size() && !hasEdge(walk[stretch.last])) ++stretch.last;
      stretches.push_back(stretch);
      i = stretch.last;
    }
    return stretches;
  }
  // True if other edges lie between those of two samples.
  bool skipsEdges(const Sample& a, const Sample& b) const {
    const std::size_t from = a.closest.edge, to = b.closest.edge;
    return hasEdge(a) && from != to && edges_[from].next != to && edges_[to].next != from;
  }
  static bool isEnd(const Walk& walk, const Stretch& stretch) {
    return stretch.first == 0 || stretch.last == walk.size();
  }

  // The edges from the one that the line leaves to the one that it comes back to, along the boundary; nullopt for an
  // end, and if they are much longer than the line.
  std::optional<Path> pathBeside(const Walk& walk, const Stretch& stretch) const {
    if (isEnd(walk, stretch)) return std::nullopt;
    const Sample &before = walk[stretch.first - 1], &after = walk[stretch.last];
    const double most = kDetour * (lengthOf(walk, stretch) + edgeAt(before).element + edgeAt(after).element);
    const auto there = pathFrom(before.closest.edge, after.closest.edge, most);
    return there ? there : pathFrom(after.closest.edge, before.closest.edge, most);
  }
  std::optional<Path> pathFrom(std::size_t first, std::size_t last, double most) const {
    Path path;
    double length = 0.0;
    for (std::size_t edge = first; edge != last;) {
      edge = edges_[edge].next;
      if (edge == kNone) return std::nullopt;
      if (edge == last) break;
      length += edges_[edge].edge.length;
      if (length > most || path.size() == edges_.size()) return std::nullopt;
      path.push_back(static_cast<std::uint32_t>(edge));
    }
    return path;
  }
  bool staysNear(const Path& path, const Walk& walk, const Stretch& stretch) const {
    const std::size_t first = stretch.first - 1;
    std::vector<Box> samples;
    for (std::size_t i = first; i <= stretch.last; ++i) samples.push_back(Box::of(walk[i].place, walk[i].place));
    const BoxTree tree(samples, BoxTree::Order::Given);
    return std::ranges::all_of(path, [&](std::uint32_t e) {
      const Point middle = edges_[e].edge.middle();
      const double reach = kEnd * edges_[e].edge.element;
      return std::ranges::any_of(plane_.turns(), [&](double turn) {
        const Point place{middle.x + turn, middle.y};
        // Twice the reach: degrees of longitude are shorter halfway to a sample nearer the pole.
        const Box box = plane_.around({place.x, place.y - reach, place.x, place.y + reach}, 2.0 * reach);
        bool near = false;
        tree.descend([&](const Box& of, std::size_t, std::size_t) { return !near && of.meets(box); },
                     [&](std::uint32_t i) { near = plane_.distance(place, walk[first + i].place) <= reach; });
        return near;
      });
    });
  }

  std::optional<MissedPart> missedOfArea(std::size_t rule) {
    const Box box = shapes_.boxOf(rule);
    const Point middle{(box.xmin + box.xmax) / 2.0, (box.ymin + box.ymax) / 2.0};
    const double size = plane_.distance({box.xmin, box.ymin}, {box.xmax, box.ymax});
    if (takesSingleEdge(rule, size, search_.closestTo(middle, true))) return std::nullopt;
    return MissedPart{rule, true, middle};
  }

  std::optional<MissedPart> missedOf(const Walk& walk) {
    const BoundaryRule& rule = rules_[walk.front().rule];
    if (!rule.opens() || rule.form == RuleForm::Shore) return std::nullopt;
    const Stretch all{0, walk.size()};
    if (std::ranges::any_of(walk, [&](const Sample& sample) { return hasEdge(sample); })) return longestMissed(walk);
    const auto [middle, of] = middleOf(walk, all);
    if (takesSingleEdge(of, lengthOf(walk, all), search_.closestTo(middle, false))) return std::nullopt;
    return MissedPart{of, true, middle};
  }

  bool takesSingleEdge(std::size_t rule, double size, const Closest& closest) {
    if (!closest.any()) return false;
    const double element = edges_[closest.edge].edge.element;
    if (size > kShort * element || closest.distance > element) return false;
    give(closest.edge, rule);
    return true;
  }

  // The longest part of a line that should have edges.
  std::optional<MissedPart> longestMissed(const Walk& walk) const {
    std::optional<MissedPart> missed;
    double longest = 0.0;
    std::size_t parts = 0;
    for (const Stretch& stretch : stretchesOf(walk)) {
      if (!isMissed(walk, stretch)) continue;
      ++parts;
      const double length = lengthOf(walk, stretch);
      if (missed && length <= longest) continue;
      longest = length;
      const auto [middle, rule] = middleOf(walk, stretch);
      missed = MissedPart{rule, false, middle};
    }
    if (missed) missed->parts = parts;
    return missed;
  }

  bool isMissed(const Walk& walk, const Stretch& stretch) const {
    const bool is_end = isEnd(walk, stretch);
    double element = 0.0, farthest = 0.0;
    for (std::size_t i = stretch.first - (is_end ? 0 : 1); i < stretch.last + (is_end ? 0 : 1); ++i) {
      if (!walk[i].closest.any()) return false;
      element = std::max(element, edgeAt(walk[i]).element);
      farthest = std::max(farthest, walk[i].closest.distance);
    }
    if (farthest > (is_end ? kEnd : kWall) * element) return false;
    if (is_end) return lengthOf(walk, stretch) >= kShort * element;
    const std::size_t before = walk[stretch.first - 1].closest.edge, after = walk[stretch.last].closest.edge;
    const std::size_t rule = walk[stretch.first].rule;
    if (stretch.first == stretch.last && !pathBeside(walk, stretch)) return false;  // of another loop
    return !areJoined(before, after, rule);
  }
  // True if all edges from one to the other, along the boundary in either direction, have the rule's type, perhaps
  // without it. Goes both ways at once: one is often far longer.
  bool areJoined(std::size_t a, std::size_t b, std::size_t rule) const {
    std::optional<std::size_t> from_a = a, from_b = b;  // nullopt after another type, or the end
    const auto next = [&](std::size_t edge) -> std::optional<std::size_t> {
      const bool is_so = !edges_[edge].rule && edges_[edge].before == rules_[rule].kind;
      if (!(is_so || isSettled(edge, rule)) || edges_[edge].next == kNone) return std::nullopt;
      return edges_[edge].next;
    };
    for (std::size_t steps = 0; steps <= edges_.size() && (from_a || from_b); ++steps) {
      if (from_a == b || from_b == a) return true;
      if (from_a) from_a = next(*from_a);
      if (from_b) from_b = next(*from_b);
    }
    return false;
  }

  static double lengthOf(const Walk& walk, const Stretch& stretch) {
    double length = 0.0;
    for (std::size_t i = stretch.first; i < stretch.last; ++i) length += walk[i].length;
    return length;
  }
  // With the rule there.
  static std::pair<Point, std::size_t> middleOf(const Walk& walk, const Stretch& stretch) {
    double left = lengthOf(walk, stretch) / 2.0;
    std::size_t i = stretch.first;
    while (i + 1 < stretch.last && walk[i].length < left) left -= walk[i++].length;
    const Sample& sample = walk[i];
    if (i == 0 || !(sample.length > 0.0)) return {sample.place, sample.rule};
    const Point& before = walk[i - 1].place;
    const double share = left / sample.length;
    return {{before.x + share * (sample.place.x - before.x), before.y + share * (sample.place.y - before.y)},
            sample.rule};
  }

  const RuleShapes& shapes_;
  const std::vector<BoundaryRule>& rules_;
  const RulePlane& plane_;
  std::vector<std::size_t> kind_of_;  // by rule, numbered
  std::vector<NearEdge>& edges_;
  EdgeSearch search_;
  std::vector<Walk> walks_;
};

}  // namespace

std::vector<MissedPart> takeRoughly(const RuleShapes& shapes, const std::vector<BoundaryRule>& rules,
                                    const RulePlane& plane, const std::vector<bool>& used, std::vector<NearEdge>& edges,
                                    const ItemLoop& loop) {
  RoughLines lines(shapes, rules, plane, edges, loop);
  lines.takePassed();
  lines.takeBetween();
  return lines.missed(used);
}

}  // namespace coastmesh
