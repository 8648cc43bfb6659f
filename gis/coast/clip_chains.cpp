#include "gis/coast/clip_chains.hpp"

#include <cmath>

namespace coastmesh {

namespace {

// The inside of one side of the box: sign · coordinate <= sign · limit.
struct Side {
  double Point::*coordinate;
  double limit;
  double sign;
  double shift;  // of the coordinate

  double beyond(const Point& p) const { return sign * (p.*coordinate + shift - limit); }
  bool holds(const Point& p) const { return beyond(p) <= 0; }
  // Where ab crosses the side. REQUIRES: it holds one of them.
  Point cut(const Point& a, const Point& b) const {
    const double da = beyond(a), db = beyond(b), t = da / (da - db);
    Point p{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
    p.*coordinate = limit - shift;
    return p;
  }
};

// The finite sides.
std::vector<Side> sidesOf(const ClipBox& clip) {
  const Side all[] = {{&Point::x, clip.box.xmin, -1, clip.shift},
                      {&Point::x, clip.box.xmax, 1, clip.shift},
                      {&Point::y, clip.box.ymin, -1, 0},
                      {&Point::y, clip.box.ymax, 1, 0}};
  std::vector<Side> sides;
  for (const Side& side : all) {
    if (std::isfinite(side.limit)) sides.push_back(side);
  }
  return sides;
}

}  // namespace

Ring clipRing(const Ring& ring, const ClipBox& clip) {
  Ring kept = ring;
  for (const Side& side : sidesOf(clip)) {
    Ring next;
    next.reserve(kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const Point &a = kept[i], &b = kept[(i + 1) % kept.size()];
      if (side.holds(a)) next.push_back(a);
      if (side.holds(a) != side.holds(b)) next.push_back(side.cut(a, b));
    }
    kept = std::move(next);
  }
  return kept.size() < 3 ? Ring{} : kept;
}

std::vector<std::vector<Point>> clipLine(const std::vector<Point>& line, const ClipBox& clip) {
  std::vector<std::vector<Point>> kept{line};
  for (const Side& side : sidesOf(clip)) {
    std::vector<std::vector<Point>> next;
    for (const std::vector<Point>& piece : kept) {
      bool open = false;
      for (std::size_t i = 0; i < piece.size(); ++i) {
        const bool in = side.holds(piece[i]);
        if (in != open && i > 0) {
          const Point cut = side.cut(piece[i - 1], piece[i]);
          if (in) next.push_back({cut});
          if (!in) next.back().push_back(cut);
        } else if (in && !open) {
          next.emplace_back();
        }
        if (in) next.back().push_back(piece[i]);
        open = in;
      }
    }
    std::erase_if(next, [](const std::vector<Point>& piece) { return piece.size() < 2; });
    kept = std::move(next);
  }
  return kept;
}

}  // namespace coastmesh
