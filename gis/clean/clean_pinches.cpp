#include "gis/clean/clean_pinches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <unordered_map>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/for_count.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/geometry/chain_index.hpp"

namespace coastmesh {

namespace {

// By vertex: the number of sectors of the outside, each of which begins, counter-clockwise, with one edge.
std::vector<std::uint32_t> outsideSectors(std::size_t vertices, const std::vector<Segment>& segments) {
  std::vector<std::uint32_t> sectors(vertices, 0);
  for (const Segment& s : segments) {
    if (s.left == kOutside) ++sectors[s.a];
    if (s.right == kOutside) ++sectors[s.b];
  }
  return sectors;
}

std::size_t featureBeside(const Segment& s) { return static_cast<std::size_t>(std::max(s.left, s.right)); }

// The angle from vp counter-clockwise to vq, in (0, 2 pi).
double angleBetween(const Point& v, const Point& p, const Point& q) {
  const double ux = p.x - v.x, uy = p.y - v.y, wx = q.x - v.x, wy = q.y - v.y;
  const int turn = orient2d(v, p, q);
  if (turn == 0) return std::numbers::pi;  // edges of a plane graph do not overlap
  const double angle = std::abs(std::atan2(ux * wy - uy * wx, ux * wx + uy * wy));
  return turn > 0 ? angle : 2 * std::numbers::pi - angle;
}

// An edge as it leaves the pinched vertex.
struct Spoke {
  std::uint32_t segment;
  VertexId end;
  RegionId left, right;
  bool open;
};

// A sector of the outside between two spokes, counter-clockwise from `first` to `last`.
struct Corner {
  std::size_t first, last;  // indices of spokes
  double angle;
  double water_before, water_after;  // angles of the water beside its edges
  bool open;                         // one of its edges is an open boundary
};

// A path along the shore from a pinched vertex.
struct Way {
  enum class End { Beyond, Back, Stuck } end = End::Stuck;
  std::vector<std::uint32_t> segments;  // the last leads to `to`
  std::vector<VertexId> passed;         // vertices between the pinched one and `to`
  VertexId to = kNone;
};

// The replacement of a corner: from a point on its first edge to one on its last, by `tip`, which lies on the bisector,
// a gap away from the pinched vertex v. The shoulder is the distance along an edge at which it begins.
//
//            / last                    / last
//   water   /                 water   o
//          /                         /
//         v    outside        v    tip   outside
//          \ shore                   \ shore
//   water   \                 water   o
//            \ first                   \ first
struct Notch {
  Point first, tip, last;
  bool whole_first, whole_last;  // true for an existing vertex: the edge is taken whole
};

class PinchOpener {
 public:
  PinchOpener(CleanVertices& vertices, std::vector<Segment>& segments, const Coastline& coastline,
              const Projection& projection, const Resolution& resolution, CleanReport& report)
      : vertices_(vertices),
        segments_(segments),
        coastline_(coastline),
        projection_(projection),
        gap_(resolution.gap),
        report_(report),
        originals_(static_cast<std::uint32_t>(segments.size())) {}

  void run() {
    const std::vector<std::uint32_t> sectors = outsideSectors(vertices_.plane.size(), segments_);
    std::vector<VertexId> pinched;
    for (VertexId v = 0; v < sectors.size(); ++v) {
      if (sectors[v] < 2) continue;
      pinched.push_back(v);
      at_[v] = {};
    }
    if (pinched.empty()) return;
    boxes_.reserve(segments_.size());
    for (std::uint32_t s = 0; s < segments_.size(); ++s) {
      const Point &a = at(segments_[s].a), &b = at(segments_[s].b);
      boxes_.push_back(Box::of(a, b).grownBy(distance(a, b) * kReach));
      for (const VertexId v : {segments_[s].a, segments_[s].b}) {
        if (sectors[v] >= 2) at_[v].push_back(s);
      }
    }
    tree_ = BoxTree(boxes_, BoxTree::Order::Hilbert);
    std::size_t left = 0;
    for (const VertexId v : pinched) {
      const Segment& beside = segments_[at_[v].front()];
      const std::size_t feature = featureBeside(beside);
      if (open(v)) {
        report_.add(EditKind::OpenedPinch, vertices_.input[v], coastline_, feature);
      } else {
        report_.add(EditKind::TouchingRing, vertices_.input[v], coastline_, feature);
        ++left;
      }
    }
    if (left > 0) {
      report_.notes.push_back(std::to_string(left) + forCount(left, " place", " places") +
                              " where rings touch could not be opened for want of room");
    }
    std::erase_if(segments_, [](const Segment& s) { return s.a == kNone; });
    std::ranges::sort(segments_, [](const Segment& s, const Segment& t) { return s.a != t.a ? s.a < t.a : s.b < t.b; });
  }

 private:
  // Pieces and new edges of a segment are no further from it than this share of its length.
  static constexpr double kReach = 0.25;
  // Distance along the edges at which a notch begins, in gaps.
  static constexpr double kShoulder = 4.0;
  // A notch that would reach further along an edge than this share of it takes the whole edge.
  static constexpr double kMostOfEdge = 0.6;

  const Point& at(VertexId v) const { return vertices_.plane[v]; }

  std::vector<Spoke> spokesOf(VertexId v) const {
    std::vector<Spoke> spokes;
    for (const std::uint32_t number : at_.at(v)) {
      const Segment& s = segments_[number];
      const bool out = s.a == v;
      spokes.push_back({number, out ? s.b : s.a, out ? s.left : s.right, out ? s.right : s.left, s.tag == kOpenTag});
    }
    const Point& centre = at(v);
    const auto below = [&](const Point& p) { return p.y < centre.y || (p.y == centre.y && p.x < centre.x); };
    std::ranges::sort(spokes, [&](const Spoke& g, const Spoke& h) {
      const Point &p = at(g.end), &q = at(h.end);
      if (below(p) != below(q)) return below(q);
      return orient2d(centre, p, q) > 0;
    });
    return spokes;
  }

  // The corners, in the order in which to open them.
  std::vector<Corner> cornersOf(VertexId v, const std::vector<Spoke>& spokes) const {
    const std::size_t n = spokes.size();
    std::vector<Corner> corners;
    for (std::size_t i = 0; i < n; ++i) {
      if (spokes[i].left != kOutside) continue;
      const std::size_t next = (i + 1) % n;
      const Point &p = at(spokes[i].end), &q = at(spokes[next].end);
      Corner corner{i, next, angleBetween(at(v), p, q), 0, 0, spokes[i].open || spokes[next].open};
      std::size_t j = i;
      for (; spokes[j].right != kOutside; j = (j + n - 1) % n) {
        const std::size_t before = (j + n - 1) % n;
        corner.water_before += angleBetween(at(v), at(spokes[before].end), at(spokes[j].end));
        if (before == next) break;
      }
      for (j = next; spokes[j].left != kOutside; j = (j + 1) % n) {
        const std::size_t after = (j + 1) % n;
        corner.water_after += angleBetween(at(v), at(spokes[j].end), at(spokes[after].end));
        if (after == i) break;
      }
      corners.push_back(corner);
    }
    std::ranges::sort(corners, [&](const Corner& c, const Corner& d) {
      if (c.open != d.open) return d.open;
      if (c.angle != d.angle) return c.angle < d.angle;
      return lexLess(at(spokes[c.first].end), at(spokes[d.first].end));
    });
    return corners;
  }

  // Opens corners of v. True iff at most one sector of the outside is left.
  bool open(VertexId v) {
    // Each cut removes a corner.
    for (std::size_t round = at_.at(v).size(); round > 0; --round) {
      const std::vector<Spoke> spokes = spokesOf(v);
      const std::vector<Corner> corners = cornersOf(v, spokes);
      if (corners.size() < 2) return true;
      const double scale = scaleAround(v, spokes);
      if (std::ranges::none_of(corners, [&](const Corner& corner) { return cut(v, spokes, corner, scale); })) break;
    }
    return cornersOf(v, spokesOf(v)).size() < 2;
  }

  // Shore nearer to the vertex than this is too small to keep.
  double leastScale() const { return kLeastScale * gap_; }

  // Distance of the nearest vertex along any of the spokes.
  double scaleAround(VertexId v, const std::vector<Spoke>& spokes) const {
    double scale = std::numeric_limits<double>::infinity();
    for (const Spoke& spoke : spokes) {
      const Way way = follow(v, spoke, leastScale());
      if (way.end == Way::End::Back) continue;
      scale = std::min(scale, distance(at(v), at(way.end == Way::End::Beyond ? way.to : spoke.end)));
    }
    return std::isfinite(scale) ? scale : leastScale();
  }

  // Follows the shore from v to a vertex at a distance of at least `reach`, or back to v.
  Way follow(VertexId v, const Spoke& spoke, double reach) const {
    constexpr std::size_t kFarthest = 64;  // edges
    Way way;
    way.segments.push_back(spoke.segment);
    way.to = spoke.end;
    while (way.segments.size() <= kFarthest) {
      if (way.to == v) way.end = Way::End::Back;
      if (way.to != v && distance(at(v), at(way.to)) >= reach) way.end = Way::End::Beyond;
      if (way.end != Way::End::Stuck) return way;
      const std::optional<std::uint32_t> next = nextAlong(way.segments.back(), way.to);
      if (!next) return way;
      way.passed.push_back(way.to);
      way.segments.push_back(*next);
      way.to = otherEnd(*next, way.to);
    }
    return way;
  }

  VertexId otherEnd(std::uint32_t segment, VertexId v) const {
    return segments_[segment].a == v ? segments_[segment].b : segments_[segment].a;
  }

  // The shore's other segment at u, if there is exactly one, of the same tag and labels; else nullopt.
  std::optional<std::uint32_t> nextAlong(std::uint32_t segment, VertexId u) const {
    std::optional<std::uint32_t> next;
    for (const std::uint32_t other : segmentsNear(Box::of(at(u), at(u)))) {
      if (other == segment || (segments_[other].a != u && segments_[other].b != u)) continue;
      if (next && *next != other) return std::nullopt;
      next = other;
    }
    if (!next || segments_[*next].tag != segments_[segment].tag) return std::nullopt;
    const auto leftOf = [&](const Segment& s) { return s.a == u ? s.left : s.right; };  // when leaving u
    const auto rightOf = [&](const Segment& s) { return s.a == u ? s.right : s.left; };
    const Segment &s = segments_[segment], &t = segments_[*next];
    return leftOf(s) == rightOf(t) && rightOf(s) == leftOf(t) ? next : std::nullopt;
  }

  bool cut(VertexId v, const std::vector<Spoke>& spokes, const Corner& corner, double scale) {
    const Point& centre = at(v);
    const Spoke &first = spokes[corner.first], &last = spokes[corner.last];
    for (const Spoke& spoke : {first, last}) {
      if (dropLobe(follow(v, spoke, leastScale()), v)) return true;
    }
    const double grain = std::ldexp(std::max(std::abs(centre.x), std::abs(centre.y)), -40);
    const double least = std::max(kGapMargin * gap_, grain);
    double gap = std::clamp(kPinchGap * scale, std::min(least, kReach * scale), kReach * scale);
    constexpr int kMostHalvings = 40;
    for (int halving = 0; halving < kMostHalvings && gap >= least; ++halving, gap /= 2) {
      const double to_first = shoulder(gap, corner.water_before), to_last = shoulder(gap, corner.water_after);
      const Way along_first = follow(v, first, kShoulder * gap), along_last = follow(v, last, kShoulder * gap);
      if (along_first.end != Way::End::Beyond || along_last.end != Way::End::Beyond) continue;
      const Notch notch = notchFor(centre, along_first, to_first, along_last, to_last, gap);
      if (!fits(v, along_first, along_last, notch, gap)) continue;
      apply(v, first, along_first, last, along_last, notch);
      return true;
    }
    return false;
  }

  // Removes a ring that leads back to v within the reach of the way and contains nothing, island or lake. Returns true
  // if it did.
  bool dropLobe(const Way& way, VertexId v) {
    if (way.end != Way::End::Back) return false;
    Ring ring{at(v)};
    Box box = Box::of(at(v), at(v));
    for (const VertexId u : way.passed) {
      ring.push_back(at(u));
      box.add(at(u));
    }
    ChainIndex index(ChainIndex::Kind::Rings);
    index.add(ring);
    index.build();
    for (const std::uint32_t number : segmentsNear(box)) {
      if (std::ranges::find(way.segments, number) != way.segments.end()) continue;
      const Segment& s = segments_[number];
      for (const VertexId u : {s.a, s.b}) {
        if (u != v && index.locate(at(u)) != Location::Outside) return false;
      }
    }
    for (const std::uint32_t number : way.segments) drop(v, number);
    return true;
  }

  void drop(VertexId v, std::uint32_t segment) {
    segments_[segment].a = segments_[segment].b = kNone;
    std::erase(at_[v], segment);
  }

  // Distance from the vertex at which a notch begins: there the water beside the edge is as wide as the gap.
  static double shoulder(double gap, double water) {
    return std::max(kShoulder * gap, gap / (2 * std::sin(std::min(water, std::numbers::pi) / 2)));
  }

  Notch notchFor(const Point& centre, const Way& along_first, double to_first, const Way& along_last, double to_last,
                 double gap) const {
    const auto beginOn = [&](const Way& way, double reach, bool& whole) {
      const Point &near = way.passed.empty() ? centre : at(way.passed.back()), &far = at(way.to);
      const double begin = distance(centre, near), end = distance(centre, far);
      const double share = (reach - begin) / (end - begin);
      whole = !(share < kMostOfEdge);
      return whole ? far : Point{near.x + share * (far.x - near.x), near.y + share * (far.y - near.y)};
    };
    Notch notch{};
    notch.first = beginOn(along_first, to_first, notch.whole_first);
    notch.last = beginOn(along_last, to_last, notch.whole_last);
    const double angle = angleBetween(centre, notch.first, notch.last), length = distance(centre, notch.first);
    const double x = (notch.first.x - centre.x) / length * gap, y = (notch.first.y - centre.y) / length * gap;
    const double cosine = std::cos(angle / 2), sine = std::sin(angle / 2);
    notch.tip = {centre.x + cosine * x - sine * y, centre.y + sine * x + cosine * y};
    return notch;
  }

  std::vector<std::uint32_t> segmentsNear(const Box& box) const {
    std::vector<std::uint32_t> near;
    tree_.visit(box, [&](std::uint32_t s) {
      near.push_back(s);
      const auto more = added_.find(s);
      if (more != added_.end()) near.insert(near.end(), more->second.begin(), more->second.end());
    });
    near.insert(near.end(), strayed_.begin(), strayed_.end());
    std::erase_if(near, [&](std::uint32_t s) { return segments_[s].a == kNone; });
    return near;
  }

  // True if two edges with the given ends meet other than in a common end.
  static bool clash(const Point& a, const Point& b, const Point& c, const Point& d) {
    const auto overlap = [](const Point& shared, const Point& p, const Point& q) {
      return orient2d(shared, p, q) == 0 &&
             (p.x - shared.x) * (q.x - shared.x) + (p.y - shared.y) * (q.y - shared.y) > 0;
    };
    if (a == c) return b == d || overlap(a, b, d);
    if (a == d) return b == c || overlap(a, b, c);
    if (b == c) return overlap(b, a, d);
    if (b == d) return overlap(b, a, c);
    return segmentsMeet(a, b, c, d);
  }

  // True if an end of one edge, other than a common end, comes nearer to the other edge than the gap.
  bool tooNear(const Point& a, const Point& b, const Point& c, const Point& d) const {
    const auto near = [&](const Point& p, const Point& from, const Point& to) {
      return !(p == from) && !(p == to) && squaredDistanceToSegment(p, from, to) < gap_ * gap_;
    };
    return near(a, c, d) || near(b, c, d) || near(c, a, b) || near(d, a, b);
  }

  // True if the corner from v to the notch contains nothing, and the edges of the notch meet nothing.
  bool fits(VertexId v, const Way& along_first, const Way& along_last, const Notch& notch, double gap) const {
    const Point& centre = at(v);
    if (orient2d(centre, notch.first, notch.tip) <= 0 || orient2d(centre, notch.tip, notch.last) <= 0) return false;
    if (tooNear(notch.first, notch.tip, notch.tip, notch.last) ||
        tooNear(notch.first, at(along_first.to), notch.last, at(along_last.to)))
      return false;
    Ring corner{centre};
    for (const VertexId u : along_first.passed) corner.push_back(at(u));
    corner.insert(corner.end(), {notch.first, notch.tip, notch.last});
    for (auto u = along_last.passed.rbegin(); u != along_last.passed.rend(); ++u) corner.push_back(at(*u));
    ChainIndex index(ChainIndex::Kind::Rings);
    index.add(corner);
    index.build();
    std::vector<std::pair<Point, Point>> edges{{notch.first, notch.tip}, {notch.tip, notch.last}, {centre, notch.tip}};
    if (!notch.whole_first) edges.emplace_back(notch.first, at(along_first.to));
    if (!notch.whole_last) edges.emplace_back(notch.last, at(along_last.to));
    const auto holds = [&](const Point& p) {
      if (p == centre || (notch.whole_first && p == notch.first) || (notch.whole_last && p == notch.last)) return false;
      return index.locate(p) != Location::Outside;
    };
    const auto isOn = [](const Way& way, std::uint32_t number) {
      return std::ranges::find(way.segments, number) != way.segments.end();
    };
    const auto clashes = [&](const Point& a, const Point& b) {
      return std::ranges::any_of(edges, [&](const auto& edge) { return clash(edge.first, edge.second, a, b); });
    };
    // Passed vertices will be removed, but must not lie between the vertex and the notch.
    for (const Way* way : {&along_first, &along_last}) {
      for (std::size_t i = 0; i + 1 < way->segments.size(); ++i) {
        const Segment& s = segments_[way->segments[i]];
        if (clashes(at(s.a), at(s.b))) return false;
      }
    }
    Box box = Box::of(at(along_first.to), at(along_last.to));
    for (const Point& p : corner) box.add(p);
    for (const std::uint32_t number : segmentsNear(box.grownBy(gap))) {
      if (isOn(along_first, number) || isOn(along_last, number)) continue;
      const Segment& s = segments_[number];
      const Point &a = at(s.a), &b = at(s.b);
      if (holds(a) || holds(b) || clashes(a, b)) return false;
      if (tooNear(notch.first, notch.tip, a, b) || tooNear(notch.tip, notch.last, a, b)) return false;
      if (s.a != v && s.b != v && squaredDistanceToSegment(notch.tip, a, b) < gap * gap / 4) return false;
    }
    return true;
  }

  VertexId addVertex(const Point& place) {
    vertices_.plane.push_back(place);
    vertices_.input.push_back(projection_.inverse(place));
    vertices_.is_new.push_back(1);
    return static_cast<VertexId>(vertices_.plane.size() - 1);
  }

  // Adds an edge, which queries find through the original segment of `beside`.
  void addSegment(VertexId a, VertexId b, std::int32_t tag, RegionId left, RegionId right, std::uint32_t beside) {
    if (a > b) std::swap(a, b), std::swap(left, right);
    const auto number = static_cast<std::uint32_t>(segments_.size());
    segments_.push_back({a, b, tag, left, right});
    const std::uint32_t original = originalOf(beside);
    added_[original].push_back(number);
    original_of_added_.push_back(original);
    noteStrayed(number);
  }

  std::uint32_t originalOf(std::uint32_t segment) const {
    return segment < originals_ ? segment : original_of_added_[segment - originals_];
  }

  void moveEnd(std::uint32_t segment, VertexId from, VertexId to) {
    Segment& s = segments_[segment];
    VertexId& end = s.a == from ? s.a : s.b;
    end = to;
    if (s.a > s.b) {
      std::swap(s.a, s.b);
      std::swap(s.left, s.right);
    }
    noteStrayed(segment);
  }

  // Segments outside the box through which queries find them are included in every query.
  void noteStrayed(std::uint32_t segment) {
    const Segment& s = segments_[segment];
    if (!boxes_[originalOf(segment)].contains(Box::of(at(s.a), at(s.b)))) strayed_.push_back(segment);
  }

  // An edge taken whole now runs from its far end to the tip; of another the part near v becomes water.
  void apply(VertexId v, const Spoke& first, const Way& along_first, const Spoke& last, const Way& along_last,
             const Notch& notch) {
    const std::int32_t first_tag = segments_[first.segment].tag, last_tag = segments_[last.segment].tag;
    const VertexId tip = addVertex(notch.tip);
    const VertexId on_first = notch.whole_first ? tip : addVertex(notch.first);
    const VertexId on_last = notch.whole_last ? tip : addVertex(notch.last);
    const auto take = [&](const Way& way, VertexId from) {
      for (std::size_t i = 0; i + 1 < way.segments.size(); ++i) drop(v, way.segments[i]);
      std::erase(at_[v], way.segments.back());
      moveEnd(way.segments.back(), way.passed.empty() ? v : way.passed.back(), from);
    };
    take(along_first, on_first);
    take(along_last, on_last);
    const std::uint32_t beside_first = along_first.segments.back(), beside_last = along_last.segments.back();
    if (on_first != tip) addSegment(on_first, tip, first_tag, first.right, kOutside, beside_first);
    if (on_last != tip) addSegment(tip, on_last, last_tag, last.left, kOutside, beside_last);
    if (first.right != last.left) {
      addSegment(v, tip, 0, last.left, first.right, beside_first);
      at_[v].push_back(static_cast<std::uint32_t>(segments_.size() - 1));
    }
  }

  // In gaps: above 1, so that shores that were separated are not joined again.
  static constexpr double kGapMargin = 1.5;
  // In gaps: the scale at which the least opening is the widest allowed.
  static constexpr double kLeastScale = kGapMargin / kReach;

  CleanVertices& vertices_;
  std::vector<Segment>& segments_;
  const Coastline& coastline_;
  const Projection& projection_;
  double gap_;  // least distance of new edges from others
  CleanReport& report_;
  std::uint32_t originals_;
  std::vector<Box> boxes_;  // of the first `originals_` segments, with their surroundings
  BoxTree tree_;            // over the first `originals_` segments
  std::unordered_map<VertexId, std::vector<std::uint32_t>> at_;          // segments at pinched vertices
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> added_;  // by original segment
  std::vector<std::uint32_t> original_of_added_;
  std::vector<std::uint32_t> strayed_;
};

}  // namespace

void reportPinches(const CleanVertices& vertices, const std::vector<Segment>& segments, const Coastline& coastline,
                   CleanReport& report) {
  std::vector<std::uint32_t> sectors = outsideSectors(vertices.plane.size(), segments);
  for (const Segment& s : segments) {
    for (const VertexId v : {s.a, s.b}) {
      if (sectors[v] < 2 || vertices.is_new[v]) continue;
      sectors[v] = 0;
      report.add(EditKind::TouchingRing, vertices.input[v], coastline, featureBeside(s));
    }
  }
}

std::vector<Segment> openPinches(CleanVertices& vertices, std::vector<Segment> segments, const Coastline& coastline,
                                 const Projection& projection, const Resolution& resolution, CleanReport& report) {
  PinchOpener(vertices, segments, coastline, projection, resolution, report).run();
  return segments;
}

}  // namespace coastmesh
