#include "gis/coast/group_features.hpp"

#include <algorithm>
#include <memory>
#include <numeric>
#include <tuple>

#include "core/hilbert.hpp"
#include "core/union_find.hpp"
#include "gis/coast/cut_meridians.hpp"
#include "gis/coast/feature_bounds.hpp"
#include "gis/coast/guests.hpp"
#include "gis/coast/snap_reach.hpp"
#include "gis/coast/turned_rings.hpp"
#include "gis/geometry/chain_index.hpp"

namespace coastmesh {

namespace {

// A feature's rings and lines with an index each.
struct FeatureIndex {
  ChainIndex rings{ChainIndex::Kind::Rings};
  ChainIndex lines{ChainIndex::Kind::OpenLines};

  explicit FeatureIndex(const Feature& feature) {
    for (const Ring* ring : ringsOf(feature)) rings.add(*ring);
    for (const auto& line : feature.lines) lines.add(line);
    rings.build();
    lines.build();
  }
  std::size_t edgeCount() const { return rings.edgeCount() + lines.edgeCount(); }

 private:
  // In Hilbert order if there are many: files list the islands of an ocean in an order that makes tree nodes as wide as
  // the world, and a search would enter all of them.
  static std::vector<const Ring*> ringsOf(const Feature& feature) {
    std::vector<const Ring*> all;
    for (const Polygon& polygon : feature.polygons) {
      all.push_back(&polygon.outer);
      for (const Ring& hole : polygon.holes) all.push_back(&hole);
    }
    std::erase_if(all, [](const Ring* ring) { return ring->empty(); });
    constexpr std::size_t kMany = 16;
    if (all.size() < kMany) return all;
    std::vector<Point> places;
    for (const Ring* ring : all) places.push_back(ring->front());
    std::vector<const Ring*> ordered;
    for (const std::uint32_t i : hilbertOrder(places)) ordered.push_back(all[i]);
    return ordered;
  }
};

// True iff an edge of `a` and one of `b` share a point, or are within reach of one another.
bool edgesMeet(const ChainIndex& a, const ChainIndex& b, const SnapReach& reach) {
  bool meet = false;
  const auto meetsOrNear = [&](const Point& p, const Point& q, const Point& r, const Point& s) {
    return segmentsMeet(p, q, r, s) || (!reach.isNothing() && reach.holds(p, q, r, s));
  };
  a.visit(reach.around(b.bounds()), [&](std::uint32_t i) {
    if (meet) return;
    const Point &p = a.start(i), &q = a.end(i);
    b.visit(reach.around(Box::of(p, q)),
            [&](std::uint32_t j) { meet = meet || meetsOrNear(p, q, b.start(j), b.end(j)); });
  });
  return meet;
}

// True iff a chain of `chains` lies inside `rings`. REQUIRES: no edge of the two meets another.
bool liesIn(const ChainIndex& chains, const ChainIndex& rings) {
  if (rings.edgeCount() == 0) return false;
  bool lies = false;
  // Visits only edges near `rings`: an ocean has tens of thousands of rings, and thousands of lakes beside it.
  chains.visit(rings.bounds(), [&](std::uint32_t edge) {
    const Point& start = chains.start(edge);
    const bool is_first = &start == &chains.chainStart(chains.chainOf(edge));
    lies = lies || (is_first && rings.locate(start) == Location::Inside);
  });
  return lies;
}

// True iff `small` and `large` touch, cross, come within reach of one another, or one contains part of the other.
bool belongTogether(const FeatureIndex& small, const FeatureIndex& large, const SnapReach& reach) {
  Box box = small.rings.bounds();
  box.add(small.lines.bounds());
  box = reach.around(box);
  bool near = false;
  const auto found = [&](std::uint32_t) { near = true; };
  large.rings.visit(box, found);
  large.lines.visit(box, found);
  if (!near) {  // `small` lies in one face of `large`: any point of it decides
    if (large.rings.edgeCount() == 0) return false;
    const ChainIndex& any = small.rings.edgeCount() > 0 ? small.rings : small.lines;
    // A ring of one point has no edges, so it belongs to nothing.
    return any.chainCount() > 0 && large.rings.locate(any.chainStart(0)) == Location::Inside;
  }
  return edgesMeet(small.rings, large.rings, reach) || edgesMeet(small.rings, large.lines, reach) ||
         edgesMeet(small.lines, large.rings, reach) || edgesMeet(small.lines, large.lines, reach) ||
         liesIn(small.rings, large.rings) || liesIn(small.lines, large.rings) || liesIn(large.rings, small.rings) ||
         liesIn(large.lines, small.rings);
}

// Features continued past the antimeridian where their longitudes jump, at offsets of full turns.
class TurnedFeatures {
 public:
  TurnedFeatures(const Coastline& coastline, const std::vector<Box>& boxes)
      : given_(coastline.features), turned_(coastline.crs.geographic ? given_.size() : 0) {
    for (std::size_t f = 0; f < turned_.size(); ++f)
      if (boxes[f].xmax - boxes[f].xmin > 180 && jumps(given_[f]))
        turned_[f] = std::make_unique<Feature>(continued(given_[f]));
  }

  bool isTurned(std::size_t f) const { return f < turned_.size() && turned_[f] != nullptr; }
  const Feature& operator[](std::size_t f) const { return isTurned(f) ? *turned_[f] : given_[f]; }
  std::size_t size() const { return given_.size(); }

 private:
  static bool jumps(const Feature& feature) {
    const auto polygonJumps = [](const Polygon& polygon) {
      return longitudesJump(polygon.outer) || std::ranges::any_of(polygon.holes, longitudesJump);
    };
    const auto lineJumps = [](const std::vector<Point>& line) { return turnsOf(line, false).any; };
    return std::ranges::any_of(feature.polygons, polygonJumps) || std::ranges::any_of(feature.lines, lineJumps);
  }

  static void addTurnedLine(const std::vector<Point>& line, Feature& feature) {
    const Turns turns = turnsOf(line, false);
    for (const double shift : {-360.0, 0.0, 360.0}) {
      if (!turns.any && shift != 0) continue;
      std::vector<Point>& copy = feature.lines.emplace_back(line);
      for (std::size_t i = 0; i < copy.size(); ++i) copy[i].x += 360.0 * turns.of[i] + shift;
    }
  }

  // Inside is even-odd over all rings, so each becomes a polygon of its own.
  static Feature continued(const Feature& feature) {
    Feature result;
    const auto add = [&](const Ring& ring) {
      for (Ring& turned : turnedRings(ring)) result.polygons.push_back({std::move(turned), {}});
    };
    for (const Polygon& polygon : feature.polygons) {
      add(polygon.outer);
      std::ranges::for_each(polygon.holes, add);
    }
    for (const auto& line : feature.lines) addTurnedLine(line, result);
    return result;
  }

  const std::vector<Feature>& given_;
  std::vector<std::unique_ptr<Feature>> turned_;  // null where nothing jumps
};

// Unites features that meet at a meridian from either side (usually the antimeridian) where data are cut along it.
class CutFeatures {
 public:
  CutFeatures(const Coastline& coastline, const std::vector<Box>& boxes) {
    for (std::uint32_t f = 0; f < boxes.size(); ++f)
      if (!isGuest(coastline.features[f].use)) extent_.add(boxes[f]);
    if (!coastline.crs.geographic || !(extent_.xmax - extent_.xmin >= kTurn)) return;
    for (std::uint32_t f = 0; f < boxes.size(); ++f) {
      if (isGuest(coastline.features[f].use) || !(repeats(boxes[f].xmin) || repeats(boxes[f].xmax))) continue;
      for (const Polygon& polygon : coastline.features[f].polygons) {
        collect(polygon.outer, true, f);
        for (const Ring& hole : polygon.holes) collect(hole, true, f);
      }
      for (const auto& line : coastline.features[f].lines) collect(line, false, f);
    }
  }

  void unite(UnionFind& sets) {
    const CutMeridians cuts = meridians();
    for (Piece& piece : pieces_) piece.cut = *cuts.at(piece.longitude);
    std::ranges::sort(pieces_, {}, [](const Piece& p) { return std::tuple(p.cut, p.south, p.feature); });
    for (std::size_t i = 0, reaching = 0; i < pieces_.size(); ++i) {
      const Piece &piece = pieces_[i], &before = pieces_[reaching];
      const bool same_cut = piece.cut == before.cut;
      if (same_cut && piece.south <= before.north) sets.unite(before.feature, piece.feature);
      if (!same_cut || piece.north > before.north) reaching = i;
    }
  }

 private:
  static constexpr double kTurn = 360;  // degrees

  // A point, or an edge along a meridian, that other data may meet a turn away.
  struct Piece {
    double longitude, south, north;
    std::uint32_t feature;
    std::size_t cut = 0;
  };

  bool repeats(double x) const { return x - extent_.xmin >= kTurn || extent_.xmax - x >= kTurn; }

  void collect(const std::vector<Point>& chain, bool closed, std::uint32_t feature) {
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const Point& p = chain[i];
      if (!repeats(p.x)) continue;
      const bool last = i + 1 == chain.size();
      const Point& q = last && !closed ? p : chain[last ? 0 : i + 1];
      const double other = q.x == p.x ? q.y : p.y;
      pieces_.push_back({p.x, std::min(p.y, other), std::max(p.y, other), feature});
    }
  }

  CutMeridians meridians() const {
    std::vector<double> longitudes;
    for (const Piece& piece : pieces_) longitudes.push_back(piece.longitude);
    return CutMeridians(std::move(longitudes));
  }

  Box extent_;
  std::vector<Piece> pieces_;
};

// True iff land or coasts lie in a frame: the water between them is one group, whatever lies in it.
bool isFramedWater(const Coastline& coastline) {
  bool framed = false, shores = false;
  for (const Feature& feature : coastline.features) {
    framed = framed || feature.use == FeatureUse::Frame;
    shores = shores || feature.use == FeatureUse::Land || feature.use == FeatureUse::Coast;
  }
  return framed && shores;
}

// True iff a polygon of the frame is a box in the input's coordinates, and `box` lies strictly inside it.
bool framedWhole(const Feature& frame, const Box& box) {
  for (const Polygon& polygon : frame.polygons) {
    Box bounds;
    for (const Point& p : polygon.outer) bounds.add(p);
    const bool on_bounds = std::ranges::all_of(polygon.outer, [&](const Point& p) {
      return p.x == bounds.xmin || p.x == bounds.xmax || p.y == bounds.ymin || p.y == bounds.ymax;
    });
    int corners = 0;
    for (const Point& p : polygon.outer) {
      corners += (p.x == bounds.xmin || p.x == bounds.xmax) && (p.y == bounds.ymin || p.y == bounds.ymax);
    }
    const bool inside =
        bounds.xmin < box.xmin && box.xmax < bounds.xmax && bounds.ymin < box.ymin && box.ymax < bounds.ymax;
    if (on_bounds && corners == 4 && polygon.holes.empty() && inside) return true;
  }
  return false;
}

// Frames join every group that is not strictly inside a box of theirs. Constraints, weirs and regions join each group
// that their extent meets, at any full turn of longitudes.
void addGuests(const Coastline& coastline, const std::vector<Box>& boxes, const SnapReach& reach,
               std::vector<std::vector<std::size_t>>& groups) {
  if (std::ranges::none_of(coastline.features, isGuest, &Feature::use)) return;
  std::vector<Box> extents(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const std::size_t member : groups[g]) extents[g].add(boxes[member]);
  }
  const BoxTree tree(extents, BoxTree::Order::Hilbert);
  for (std::size_t f = 0; f < boxes.size(); ++f) {
    const Feature& feature = coastline.features[f];
    if (!isGuest(feature.use)) continue;
    const bool frame = feature.use == FeatureUse::Frame;
    const auto join = [&](std::uint32_t g) {
      if (groups[g].back() != f && !(frame && framedWhole(feature, extents[g]))) groups[g].push_back(f);
    };
    if (frame) {
      for (std::uint32_t g = 0; g < groups.size(); ++g) join(g);
      continue;
    }
    for (const double turn : {0.0, -360.0, 360.0}) {
      if (turn != 0 && !coastline.crs.geographic) continue;
      Box box = reach.around(boxes[f]);
      box.xmin += turn;
      box.xmax += turn;
      tree.visit(box, join);
    }
  }
  for (auto& group : groups) std::ranges::sort(group);
}

std::vector<std::vector<std::size_t>> setsOf(UnionFind& sets, const Coastline& coastline) {
  const std::size_t n = coastline.features.size();
  std::vector<std::vector<std::size_t>> groups;
  std::vector<std::uint32_t> group_of(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    if (isGuest(coastline.features[i].use)) continue;
    const std::uint32_t root = sets.find(i);  // never above i, so its group exists
    if (root == i) {
      group_of[i] = static_cast<std::uint32_t>(groups.size());
      groups.emplace_back();
    }
    groups[group_of[root]].push_back(i);
  }
  return groups;
}

// Two features whose boxes meet.
struct Pair {
  std::uint32_t a, b;
};

// Unites features that belong together. All threads test pairs, one batch at a time: pairs that earlier batches united
// are skipped.
class Uniting {
 public:
  Uniting(const TurnedFeatures& features, const SnapReach& reach, const ItemLoop& loop, UnionFind& sets)
      : features_(features), reach_(reach), loop_(loop), sets_(sets), kept_(features.size()) {}

  void unite(const std::vector<Pair>& pairs) {
    keepLarge(pairs);
    constexpr std::size_t kAtOnce = 65536, kWorthAStretch = 64;
    for (std::size_t at = 0; at < pairs.size(); at += kAtOnce) {
      std::vector<Pair> open;
      for (std::size_t i = at; i < std::min(pairs.size(), at + kAtOnce); ++i)
        if (sets_.find(pairs[i].a) != sets_.find(pairs[i].b)) open.push_back(pairs[i]);
      const auto look = [&](std::size_t first, std::size_t last) {
        std::vector<Pair> together;
        for (std::size_t i = first; i < last; ++i)
          if (belongTogether(open[i])) together.push_back(open[i]);
        return together;
      };
      for (const Pair& pair : joined(overStretches(loop_, open.size(), look, kWorthAStretch)))
        sets_.unite(pair.a, pair.b);
    }
  }

 private:
  // Features with at least this many edges keep their index; those of smaller ones are made when needed.
  static constexpr std::size_t kLarge = 64;

  void keepLarge(const std::vector<Pair>& pairs) {
    std::vector<std::uint32_t> large;
    std::vector<bool> seen(features_.size(), false);
    for (const Pair& pair : pairs)
      for (const std::uint32_t f : {pair.a, pair.b}) {
        if (seen[f]) continue;
        seen[f] = true;
        if (pointsOf(features_[f]) >= kLarge) large.push_back(f);
      }
    loop_(large.size(), [&](std::size_t i) { kept_[large[i]] = std::make_unique<FeatureIndex>(features_[large[i]]); });
  }

  bool belongTogether(const Pair& pair) const {
    std::unique_ptr<FeatureIndex> made_a, made_b;
    const auto indexOf = [&](std::uint32_t f, std::unique_ptr<FeatureIndex>& made) -> const FeatureIndex& {
      if (kept_[f]) return *kept_[f];
      made = std::make_unique<FeatureIndex>(features_[f]);
      return *made;
    };
    const FeatureIndex& a = indexOf(pair.a, made_a);
    const FeatureIndex& b = indexOf(pair.b, made_b);
    const bool a_smaller = a.edgeCount() <= b.edgeCount();
    return coastmesh::belongTogether(a_smaller ? a : b, a_smaller ? b : a, reach_);
  }

  const TurnedFeatures& features_;
  const SnapReach& reach_;
  const ItemLoop& loop_;
  UnionFind& sets_;
  std::vector<std::unique_ptr<FeatureIndex>> kept_;
};

}  // namespace

std::vector<std::vector<std::size_t>> groupFeatures(const Coastline& coastline, const SnapDistance& snap,
                                                    const ItemLoop& loop) {
  const auto& features = coastline.features;
  std::vector<Box> boxes(features.size());
  forEachByStretches(loop, features.size(), [&](std::size_t i) { boxes[i] = boundsOf(features[i]); });
  if (isFramedWater(coastline) || coastline.rest) {
    std::vector<std::size_t> all(features.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return {all};
  }
  const TurnedFeatures turned(coastline, boxes);
  std::vector<Box> turned_boxes = boxes;
  for (std::size_t f = 0; f < features.size(); ++f)
    if (turned.isTurned(f)) turned_boxes[f] = boundsOf(turned[f]);
  const BoxTree tree(turned_boxes, BoxTree::Order::Hilbert);
  const SnapReach reach(features.size() > 1 ? snap : SnapDistance{}, coastline.crs, tree.bounds());
  UnionFind sets(features.size());
  Uniting(turned, reach, loop, sets)
      .unite(joined(overStretches(loop, features.size(), [&](std::size_t first, std::size_t last) {
        std::vector<Pair> pairs;
        for (auto i = static_cast<std::uint32_t>(first); i < last; ++i) {
          if (isGuest(features[i].use)) continue;
          tree.visit(reach.around(turned_boxes[i]), [&](std::uint32_t j) {
            if (j > i && !isGuest(features[j].use)) pairs.push_back({i, j});
          });
        }
        return pairs;
      })));
  CutFeatures(coastline, boxes).unite(sets);
  std::vector<std::vector<std::size_t>> groups = setsOf(sets, coastline);
  addGuests(coastline, boxes, reach, groups);
  return groups;
}

}  // namespace coastmesh
