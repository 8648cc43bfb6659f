#include "tests/support/pslg_check.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <numeric>
#include <sstream>
#include <vector>

namespace coastmesh {

namespace {

using Rational = boost::multiprecision::cpp_rational;

int exactTurn(const Point& a, const Point& b, const Point& c) {
  const Rational ax(a.x), ay(a.y);
  const Rational det = (Rational(b.x) - ax) * (Rational(c.y) - ay) - (Rational(b.y) - ay) * (Rational(c.x) - ax);
  return det.sign();
}

bool between(double v, double p, double q) { return std::min(p, q) <= v && v <= std::max(p, q); }

// True if v is on the closed segment ab.
bool onSegment(const Point& a, const Point& b, const Point& v) {
  return between(v.x, a.x, b.x) && between(v.y, a.y, b.y) && exactTurn(a, b, v) == 0;
}

std::string say(const std::string& what, const Point& place) {
  std::ostringstream text;
  text.precision(17);
  text << what << " at " << place.x << ", " << place.y;
  return text.str();
}

std::string pairDefect(const Pslg& pslg, const Segment& s, const Segment& t) {
  const Point &a = pslg.points[s.a], &b = pslg.points[s.b], &c = pslg.points[t.a], &d = pslg.points[t.b];
  if (std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y)) return {};
  for (const VertexId v : {t.a, t.b}) {
    if (v != s.a && v != s.b && onSegment(a, b, pslg.points[v])) return say("vertex on segment", pslg.points[v]);
  }
  for (const VertexId v : {s.a, s.b}) {
    if (v != t.a && v != t.b && onSegment(c, d, pslg.points[v])) return say("vertex on segment", pslg.points[v]);
  }
  const bool same = (s.a == t.a && s.b == t.b) || (s.a == t.b && s.b == t.a);
  if (same) return say("segment twice", a);
  if (s.a == t.a || s.a == t.b || s.b == t.a || s.b == t.b) return {};
  if (exactTurn(a, b, c) * exactTurn(a, b, d) < 0 && exactTurn(c, d, a) * exactTurn(c, d, b) < 0) {
    return say("segments cross", a);
  }
  return {};
}

std::string meetingDefect(const Pslg& pslg) {
  std::vector<std::size_t> order(pslg.segments.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto left = [&](std::size_t i) {
    return std::min(pslg.points[pslg.segments[i].a].x, pslg.points[pslg.segments[i].b].x);
  };
  const auto right = [&](std::size_t i) {
    return std::max(pslg.points[pslg.segments[i].a].x, pslg.points[pslg.segments[i].b].x);
  };
  std::sort(order.begin(), order.end(), [&](auto i, auto j) { return left(i) < left(j); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size() && left(order[j]) <= right(order[i]); ++j) {
      std::string defect = pairDefect(pslg, pslg.segments[order[i]], pslg.segments[order[j]]);
      if (!defect.empty()) return defect;
    }
  }
  return {};
}

// An end of a segment seen from a vertex: the labels counter-clockwise and clockwise of the segment.
struct Spoke {
  Point to;
  RegionId after, before;
};

std::string labelDefect(const Pslg& pslg) {
  std::vector<std::vector<Spoke>> spokes(pslg.points.size());
  for (const Segment& s : pslg.segments) {
    spokes[s.a].push_back({pslg.points[s.b], s.left, s.right});
    spokes[s.b].push_back({pslg.points[s.a], s.right, s.left});
  }
  for (VertexId v = 0; v < spokes.size(); ++v) {
    const Point& centre = pslg.points[v];
    auto& around = spokes[v];
    if (around.empty()) return say("vertex in no segment", centre);
    const auto upper = [&](const Point& p) { return p.y > centre.y || (p.y == centre.y && p.x > centre.x); };
    std::sort(around.begin(), around.end(), [&](const Spoke& p, const Spoke& q) {
      if (upper(p.to) != upper(q.to)) return upper(p.to);
      return exactTurn(centre, p.to, q.to) > 0;
    });
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (around[i].after != around[(i + 1) % around.size()].before) return say("labels disagree", centre);
    }
  }
  return {};
}

}  // namespace

std::string defectOfLabelled(const Pslg& pslg) {
  std::vector<Point> sorted = pslg.points;
  for (const Point& p : sorted) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return "a point is not finite";
  }
  std::sort(sorted.begin(), sorted.end(), lexLess);
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) return say("two equal points", *twice);
  for (const Segment& s : pslg.segments) {
    if (s.a >= pslg.points.size() || s.b >= pslg.points.size()) return "a segment ends at no vertex";
    if (s.a == s.b) return say("segment of no length", pslg.points[s.a]);
    if (s.left == kUnlabelled || s.right == kUnlabelled) return say("segment without labels", pslg.points[s.a]);
    if (s.left == kOutside && s.right == kOutside) return say("segment outside", pslg.points[s.a]);
  }
  std::string defect = meetingDefect(pslg);
  return defect.empty() ? labelDefect(pslg) : defect;
}

double labelledArea(const Pslg& pslg, RegionId region) {
  long double twice = 0;
  const Point origin = pslg.points.empty() ? Point{} : pslg.points.front();
  for (const Segment& s : pslg.segments) {
    const int sign = (s.left == region) - (s.right == region);
    const Point &a = pslg.points[s.a], &b = pslg.points[s.b];
    const long double ax = static_cast<long double>(a.x) - origin.x, ay = static_cast<long double>(a.y) - origin.y;
    const long double bx = static_cast<long double>(b.x) - origin.x, by = static_cast<long double>(b.y) - origin.y;
    twice += sign * (ax * by - ay * bx);
  }
  return static_cast<double>(twice / 2);
}

}  // namespace coastmesh
