#include "gis/rules/rule_chains.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace coastmesh {
namespace {

// An end of a line that a chain may go on with.
struct Meeting {
  std::size_t line = 0;
  bool at_back = false;
  double turn = 0.0;  // to add to its longitudes
};

class Chaining {
 public:
  Chaining(std::vector<RuleLine> lines, const std::vector<BoundaryRule>& rules, const RulePlane& plane,
           const std::function<double(const Point&)>& reach)
      : lines_(std::move(lines)), rules_(rules), plane_(plane), reach_(reach), taken_(lines_.size(), false) {
    std::vector<Box> ends;
    for (const RuleLine& line : lines_)
      for (const Point& end : {line.points.front(), line.points.back()}) ends.push_back(Box::of(end, end));
    ends_ = BoxTree(ends, BoxTree::Order::Hilbert);
  }

  std::vector<RuleChain> chains() {
    std::vector<RuleChain> chains;
    for (std::size_t line = 0; line < lines_.size(); ++line) {
      if (taken_[line]) continue;
      taken_[line] = true;
      RuleChain chain{lines_[line]};
      extend(chain);
      turnRound(chain);
      extend(chain);
      chains.push_back(std::move(chain));
    }
    return chains;
  }

 private:
  void extend(RuleChain& chain) {
    while (const auto meeting = nextOf(chain.back())) {
      taken_[meeting->line] = true;
      RuleLine next = lines_[meeting->line];
      if (meeting->at_back) std::ranges::reverse(next.points);
      for (Point& p : next.points) p.x += meeting->turn;
      chain.push_back(std::move(next));
    }
  }

  static void turnRound(RuleChain& chain) {
    std::ranges::reverse(chain);
    for (RuleLine& line : chain) std::ranges::reverse(line.points);
  }

  // The closest end of a line of the same type; nullopt if there is none within reach. Where many lines end within
  // reach, most chains go on much closer: there it is searched for first.
  std::optional<Meeting> nextOf(const RuleLine& line) const {
    if (rules_[line.rule].form != RuleForm::Line) return std::nullopt;
    const double reach = reach_(line.points.back());
    for (const double share : {1.0 / 1024.0, 1.0 / 32.0})
      // Half of it: degrees of longitude are shorter halfway to an end nearer the pole.
      if (const auto [meeting, distance] = closestWithin(share * reach, line);
          meeting && distance <= 0.5 * share * reach)
        return meeting;
    return closestWithin(reach, line).first;
  }

  // With its distance.
  std::pair<std::optional<Meeting>, double> closestWithin(double reach, const RuleLine& line) const {
    const Point& end = line.points.back();
    double closest = reach;
    std::optional<Meeting> best;
    for (const double turn : plane_.turns()) {
      const Point place{end.x + turn, end.y};
      ends_.visit(plane_.around(Box::of(place, place), closest), [&](std::uint32_t i) {
        const std::size_t other = i / 2;
        const BoundaryRule& rule = rules_[lines_[other].rule];
        if (taken_[other] || rule.form != RuleForm::Line || rule.kind != rules_[line.rule].kind) return;
        const std::vector<Point>& points = lines_[other].points;
        const bool at_back = i % 2 == 1;
        const double distance = plane_.distance(place, at_back ? points.back() : points.front());
        if (best ? distance >= closest : distance > closest) return;
        closest = distance;
        best = {other, at_back, -turn};
      });
    }
    return {best, closest};
  }

  std::vector<RuleLine> lines_;
  const std::vector<BoundaryRule>& rules_;
  const RulePlane& plane_;
  const std::function<double(const Point&)>& reach_;
  std::vector<bool> taken_;
  BoxTree ends_;  // first and last of each line
};

}  // namespace

std::vector<RuleChain> chainsOf(const RuleShapes& shapes, const std::vector<BoundaryRule>& rules,
                                const RulePlane& plane, const std::function<double(const Point&)>& reach) {
  std::vector<RuleLine> lines;
  for (std::size_t rule = 0; rule < rules.size(); ++rule) {
    std::vector<Point> points = shapes.lineOf(rule);
    if (!points.empty()) lines.push_back({rule, std::move(points)});
  }
  return Chaining(std::move(lines), rules, plane, reach).chains();
}

}  // namespace coastmesh
