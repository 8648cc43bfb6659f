#include "gis/size/size_channel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/metric.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

namespace {

// Seen from the circle's centre the two touching places lie further apart than this.
const double kCosApart = std::cos(toRadians(110.0));
constexpr int kMostSteps = 40;
// From one place to the next along the shore, in radii of the circle there.
constexpr double kStep = 0.5;
constexpr double kMostPlaces = 1e6;  // on one segment
// Vertices of equilateral triangles with edges of length 1, on an area of 1.
const double kVerticesPerArea = 2.0 / std::sqrt(3.0);

class Shores {
 public:
  explicit Shores(const Pslg& pslg) : pslg_(pslg) {
    std::vector<Box> boxes;
    for (const Segment& s : pslg.segments) {
      if (s.tag == kOpenTag) continue;
      shores_.push_back(s);
      boxes.push_back(Box::of(pslg.points[s.a], pslg.points[s.b]));
    }
    tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
  }

  // The place on any segment nearest to x, less far away than `radius`.
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
          const double share = std::clamp(dot(x - a, b - a) / squaredDistance(a, b), 0.0, 1.0);
          const Point p = a + share * (b - a);
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
  std::optional<Point> other;  // where it touches besides; none where it would be larger than asked
};

// The largest circle that touches the shore at `at` from the side of `normal` and holds nothing: shrunk until it does.
Circle shrink(const Shores& shores, const Point& at, const Point& normal, double radius) {
  Circle circle{radius, std::nullopt};
  for (int step = 0; step < kMostSteps; ++step) {
    const Point centre = at + circle.radius * normal;
    // Less than rounding: the first circle is as large as the domain, and the other shore may be near.
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

}  // namespace

ChannelLines channelLines(const Pslg& pslg, double elements, double rate, double least_m, double most_m,
                          const std::function<double(const Point&)>& scale, const ChannelRoom& room,
                          const Surface& surface) {
  const Shores shores(pslg);
  const bool labelled =
      std::ranges::any_of(pslg.segments, [](const Segment& s) { return s.left >= 0 || s.right >= 0; });
  double extent = 0.0;
  for (const Point& p : pslg.points) extent = std::max(extent, distance(p, pslg.points.front()));
  ChannelLines found;
  double walked = 0.0;  // of the shores' length
  const auto isTooMuch = [&] {
    return found.vertices > room.vertices || static_cast<double>(found.lines.size()) > room.lines;
  };
  const auto alongSide = [&](const Point& a, const Point& b, const Point& normal) {
    const double length = distance(a, b), local = scale(midpoint(a, b));
    const double least_step = std::max(kStep * 0.5 * elements * least_m * local, length / kMostPlaces);
    // What is wider is left out; where the scale changes over a circle only its own says how wide it is.
    const double with_room = surface.isCurved() ? 2.0 : 1.0;
    const double largest = std::min(extent, with_room * 0.5 * elements * most_m * local);
    double along = std::min(0.5 * length, 0.5 * least_step);
    while (along < length && !isTooMuch()) {
      const Point at = a + (along / length) * (b - a);
      const Circle circle = shrink(shores, at, normal, largest);
      if (circle.other) {
        const Point centre = at + circle.radius * normal;
        const Point to_at = at - centre, to_other = *circle.other - centre;
        const double cosine = dot(to_at, to_other) / std::sqrt(squaredLength(to_at) * squaredLength(to_other));
        const double scale_there = surface.isCurved() ? scale(centre) : local;
        const double size = std::max(least_m, 2.0 * circle.radius / scale_there / elements);
        if (cosine < kCosApart && size < most_m) {
          found.lines.push_back({at, *circle.other, size, rate});
          // Half of the channel's width along the step to the next place; where that is less, the shore itself.
          const double step = std::min(length - along, std::max(least_step, kStep * circle.radius));
          const double edge = size * scale_there;
          found.vertices += std::max(kVerticesPerArea * step * circle.radius / edge / edge, 0.5 * step / edge);
        }
      }
      along += std::max(least_step, kStep * circle.radius);
    }
    walked += std::min(along, length);
  };
  double whole = 0.0;
  for (const Segment& s : pslg.segments) {
    if (s.tag == kOpenTag) continue;
    const Point &a = pslg.points[s.a], &b = pslg.points[s.b];
    whole += distance(a, b) * (labelled ? (s.left >= 0) + (s.right >= 0) : 2);
    if (isTooMuch()) continue;
    const Point d = (1.0 / distance(a, b)) * (b - a);
    // Water on the left, on the right; where nothing says, on both.
    if (!labelled || s.left >= 0) alongSide(a, b, {-d.y, d.x});
    if (!labelled || s.right >= 0) alongSide(b, a, {d.y, -d.x});
  }
  found.complete = !isTooMuch();
  if (!found.complete) found.vertices *= whole / walked;
  return found;
}

}  // namespace coastmesh
