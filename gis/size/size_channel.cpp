#include "gis/size/size_channel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/metric.hpp"
#include "core/triangulate/label_regions.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

namespace {

// The points of contact are further apart than this, seen from the circle's centre.
const double kCosApart = std::cos(toRadians(110.0));
constexpr int kMostSteps = 40;
// Spacing of circles along the shore, relative to their radius.
constexpr double kStep = 0.5;
constexpr double kMostPlaces = 1e6;  // on one segment
// Angle between circles around a cape's point: they are at most 1.5 percent wider than the strait. Capes that turn by
// less than `kLeastFan` need none: the circles of their segments are as narrow.
constexpr double kFanStep = toRadians(20.0);
constexpr double kLeastFan = toRadians(10.0);
// Vertices per unit of area, for equilateral triangles with edges of length 1.
const double kVerticesPerArea = 2.0 / std::sqrt(3.0);

class Shores {
 public:
  Shores(const Pslg& pslg, bool labelled) : pslg_(pslg) {
    std::vector<Box> boxes;
    for (const Segment& s : pslg.segments) {
      if (isOpenTag(s.tag) || (labelled && !isBoundary(s))) continue;
      shores_.push_back(s);
      boxes.push_back(Box::of(pslg.points[s.a], pslg.points[s.b]));
    }
    tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
  }

  const std::vector<Segment>& segments() const { return shores_; }

  // The place on the shore that is nearest to x and within `radius`; nullopt if there is none.
  std::optional<Point> nearest(const Point& x, double radius) const {
    double best = radius * radius;
    std::optional<Point> place;
    tree_.descend(
        [&](const Box& box, std::size_t, std::size_t) {
          const double dx = std::max({box.xmin - x.x, 0.0, x.x - box.xmax});
          const double dy = std::max({box.ymin - x.y, 0.0, x.y - box.ymax});
          return dx * dx + dy * dy < best;
        },
        [&](std::uint32_t s) {
          const Point &a = pslg_.points[shores_[s].a], &b = pslg_.points[shores_[s].b];
          const Point p = nearestOnSegment(x, a, b);
          if (squaredDistance(p, x) >= best) return;
          best = squaredDistance(p, x);
          place = p;
        });
    return place;
  }

 private:
  const Pslg& pslg_;
  std::vector<Segment> shores_;
  BoxTree tree_;
};

struct Circle {
  double radius = 0.0;
  std::optional<Point> other;  // the other point of contact; nullopt if the circle would be larger than allowed
};

// The largest empty circle, at most `radius`, that touches the shore at `at` from the side of `normal`: shrunk until no
// shore is inside.
Circle shrink(const Shores& shores, const Point& at, const Point& normal, double radius) {
  Circle circle{radius, std::nullopt};
  for (int step = 0; step < kMostSteps; ++step) {
    const Point centre = at + circle.radius * normal;
    // Allows for rounding: the first circle is as large as the domain, and the other shore may be near.
    const double rounding =
        16.0 * std::numeric_limits<double>::epsilon() * (circle.radius + std::max(std::abs(at.x), std::abs(at.y)));
    const std::optional<Point> inside = shores.nearest(centre, circle.radius - rounding);
    if (!inside) return circle;
    const Point chord = *inside - at;
    const double along = dot(chord, normal);
    if (!(along > 0.0)) return circle;
    const double smaller = squaredLength(chord) / (2.0 * along);
    circle.other = inside;
    if (!(smaller < circle.radius * (1.0 - 1e-9))) return circle;
    circle.radius = smaller;
  }
  return circle;
}

// One end of a segment, seen from its vertex.
struct End {
  VertexId vertex;
  double angle;  // of the direction to the other end, in radians
  bool water;    // to the left of that direction
  bool shore;
};

// The directions into the water at a cape's point: the normals of the two segments that meet there, and all between.
struct Fan {
  VertexId vertex;
  double from, span;  // radians, counter-clockwise
};

std::vector<Fan> capesOf(const Pslg& pslg, bool labelled) {
  std::vector<End> ends;
  ends.reserve(2 * pslg.segments.size());
  for (const Segment& s : pslg.segments) {
    if (labelled && !isBoundary(s)) continue;
    const Point d = pslg.points[s.b] - pslg.points[s.a];
    const bool shore = !isOpenTag(s.tag);
    ends.push_back({s.a, std::atan2(d.y, d.x), !labelled || s.left >= 0, shore});
    ends.push_back({s.b, std::atan2(-d.y, -d.x), !labelled || s.right >= 0, shore});
  }
  std::ranges::sort(
      ends, [](const End& a, const End& b) { return a.vertex != b.vertex ? a.vertex < b.vertex : a.angle < b.angle; });
  std::vector<Fan> fans;
  for (std::size_t first = 0, end = 0; first < ends.size(); first = end) {
    while (end < ends.size() && ends[end].vertex == ends[first].vertex) ++end;
    for (std::size_t i = first; i < end; ++i) {
      const End &right = ends[i], &left = ends[i + 1 < end ? i + 1 : first];
      const double turn = left.angle - right.angle + (i + 1 < end ? 0.0 : 2.0 * std::numbers::pi);
      const double span = turn - std::numbers::pi;
      if (span < kLeastFan || !right.water || !(right.shore && left.shore)) continue;
      fans.push_back({right.vertex, right.angle + 0.5 * std::numbers::pi, span});
    }
  }
  return fans;
}

// Finds the circles of a domain's shores, up to the limits.
class ChannelSearch {
 public:
  ChannelSearch(const Pslg& pslg, double elements, double rate, double least_m, double most_m,
                const std::function<double(const Point&)>& scale, const ChannelRoom& room, const Surface& surface)
      : pslg_(pslg),
        labelled_(hasRegions(pslg)),
        shores_(pslg, labelled_),
        elements_(elements),
        rate_(rate),
        least_m_(least_m),
        most_m_(most_m),
        scale_(scale),
        room_(room),
        curved_(surface.isCurved()) {
    for (const Point& p : pslg.points) extent_ = std::max(extent_, distance(p, pslg.points.front()));
  }

  ChannelLines run() {
    // Capes first: the narrowest places are there.
    for (const Fan& fan : capesOf(pslg_, labelled_)) {
      if (isTooMuch()) break;
      roundCape(fan);
    }
    const double at_capes = found_.vertices;
    double whole = 0.0;
    for (const Segment& s : shores_.segments()) {
      const Point &a = pslg_.points[s.a], &b = pslg_.points[s.b];
      whole += distance(a, b) * (labelled_ ? 1 : 2);
      if (isTooMuch()) continue;
      const Point d = (1.0 / distance(a, b)) * (b - a);
      // Water on the left, on the right; without labels, on both sides.
      if (!labelled_ || s.left >= 0) alongSide(a, b, {-d.y, d.x});
      if (!labelled_ || s.right >= 0) alongSide(b, a, {d.y, -d.x});
    }
    found_.complete = !isTooMuch();
    if (!found_.complete && walked_ > 0.0) {
      found_.vertices = at_capes + (found_.vertices - at_capes) * (whole / walked_);
    }
    return std::move(found_);
  }

 private:
  bool isTooMuch() const {
    return found_.vertices > room_.vertices || static_cast<double>(found_.lines.size()) > room_.lines;
  }

  // Wider water is left out. On a sphere twice the radius is allowed, because the scale at the circle's centre decides.
  double largestAt(double local) const {
    return std::min(extent_, (curved_ ? 2.0 : 1.0) * 0.5 * elements_ * most_m_ * local);
  }

  double leastStep(double local) const { return kStep * 0.5 * elements_ * least_m_ * local; }

  // Adds the circle at a place of the shore, towards `normal`, where the scale is `local`; `step(radius)` is the
  // distance to the next one. Returns its radius.
  template <typename Step>
  double across(const Point& at, const Point& normal, double local, Step&& step) {
    const Circle circle = shrink(shores_, at, normal, largestAt(local));
    if (!circle.other) return circle.radius;
    const Point centre = at + circle.radius * normal;
    const Point to_at = at - centre, to_other = *circle.other - centre;
    const double cosine = dot(to_at, to_other) / std::sqrt(squaredLength(to_at) * squaredLength(to_other));
    const double scale_there = curved_ ? scale_(centre) : local;
    const double size = std::max(least_m_, 2.0 * circle.radius / scale_there / elements_);
    if (!(cosine < kCosApart && size < most_m_)) return circle.radius;
    found_.lines.push_back({at, *circle.other, size, rate_});
    // Half of the channel's width along the step to the next place; at least half of the vertices on the shore itself.
    const double edge = size * scale_there, length = step(circle.radius);
    found_.vertices += std::max(kVerticesPerArea * length * circle.radius / edge / edge, 0.5 * length / edge);
    return circle.radius;
  }

  void alongSide(const Point& a, const Point& b, const Point& normal) {
    const double length = distance(a, b), local = scale_(midpoint(a, b));
    const double least_step = std::max(leastStep(local), length / kMostPlaces);
    double along = std::min(0.5 * length, 0.5 * least_step);
    while (along < length && !isTooMuch()) {
      const double radius = across(a + (along / length) * (b - a), normal, local,
                                   [&](double r) { return std::min(length - along, std::max(least_step, kStep * r)); });
      along += std::max(least_step, kStep * radius);
    }
    walked_ += std::min(along, length);
  }

  // Counts the area of sectors: there is no shore between two circles.
  void roundCape(const Fan& fan) {
    const Point& at = pslg_.points[fan.vertex];
    const double local = scale_(at);
    const double count = std::ceil(fan.span / kFanStep), turn = fan.span / count;
    for (int i = 0; i < static_cast<int>(count); ++i) {
      const double angle = fan.from + (i + 0.5) * turn;
      across(at, {std::cos(angle), std::sin(angle)}, local, [&](double radius) { return 0.5 * turn * radius; });
    }
  }

  const Pslg& pslg_;
  bool labelled_;
  Shores shores_;
  double elements_, rate_, least_m_, most_m_;
  const std::function<double(const Point&)>& scale_;
  ChannelRoom room_;
  bool curved_;
  double extent_ = 0.0;
  double walked_ = 0.0;  // of the shores' length
  ChannelLines found_;
};

}  // namespace

ChannelLines channelLines(const Pslg& pslg, double elements, double rate, double least_m, double most_m,
                          const std::function<double(const Point&)>& scale, const ChannelRoom& room,
                          const Surface& surface) {
  return ChannelSearch(pslg, elements, rate, least_m, most_m, scale, room, surface).run();
}

}  // namespace coastmesh
