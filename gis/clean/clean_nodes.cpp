#include "gis/clean/clean_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <tuple>

#include "core/hilbert.hpp"
#include "core/predicates.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/coast/flood_plains.hpp"
#include "gis/error.hpp"
#include "gis/geometry/crossing.hpp"
#include "gis/geometry/edge_runs.hpp"
#include "gis/geometry/point_grid.hpp"
#include "gis/places.hpp"

namespace coastmesh {

namespace {

// Rounds that use the snap distance (several, since edges led through vertices come nearer to others), and rounds in
// all. Later rounds only resolve effects of rounding: they use the grain of the coordinates, doubled each round, and
// merge vertices closer than that.
constexpr int kSnapRounds = 8, kMostRounds = 24;

// An edge and its uses, [first_use, last_use).
struct Edge {
  VertexId low, high;
  std::uint32_t first_use, last_use;
};

struct Split {
  std::uint32_t edge;
  VertexId vertex;

  friend auto operator<=>(const Split&, const Split&) = default;
};

struct Crossing {
  std::uint32_t e, f;
};

// True iff v lies exactly on the edge ab, or between its ends and nearer to it than `tolerance`.
bool liesOnEdge(const Point& a, const Point& b, const Point& v, double tolerance) {
  const double dx = b.x - a.x, dy = b.y - a.y, wx = v.x - a.x, wy = v.y - a.y;
  if (tolerance > 0) {
    const double along = wx * dx + wy * dy, across = wx * dy - wy * dx, square = dx * dx + dy * dy;
    if (along > 0 && along < square && across * across <= tolerance * tolerance * square) return true;
  }
  return Box::of(a, b).meets({v.x, v.y, v.x, v.y}) && orient2d(a, b, v) == 0;
}

class Noder {
 public:
  Noder(CleanChains& chains, const Coastline& coastline, const Projection& projection, CleanReport& report,
        const ItemLoop& loop)
      : chains_(chains), coastline_(coastline), projection_(projection), report_(report), loop_(loop) {
    crossed_.assign(chains.chains.size(), 0);
    grain_ = chains.resolution.grain;
  }

  NodedEdges run() {
    std::size_t count = 0;
    for (const CleanChain& chain : chains_.chains) count += chain.walk.size();
    uses_.reserve(count);
    for (std::uint32_t c = 0; c < chains_.chains.size(); ++c) addUses(c);
    collapse(true);
    active_.assign(edges_.size(), 1);
    for (int round = 0; round < kMostRounds; ++round) {
      if (!splitOnce(round)) return {std::move(uses_), std::move(crossed_)};
    }
    const Feature& feature = coastline_.features[last_split_.feature];
    throw InputError(featureInWords(feature) + ": the edges near " + std::to_string(last_split_.place.x) + ", " +
                     std::to_string(last_split_.place.y) +
                     " cannot be untangled: simplify the feature there, or give a larger snap distance");
  }

 private:
  const Point& at(VertexId v) const { return chains_.vertices.plane[v]; }
  std::uint32_t featureOf(const EdgeUse& use) const { return chains_.chains[use.chain].feature; }
  bool isLine(const EdgeUse& use) const { return !chains_.chains[use.chain].isRing(); }
  // For sorting: the use of a line; less for rings than for all lines.
  int lineUse(const EdgeUse& use) const {
    return isLine(use) ? static_cast<int>(coastline_.features[featureOf(use)].use) : -1;
  }
  bool isSilent(const EdgeUse& use) const { return !isReported(coastline_.features[featureOf(use)]); }

  void addUses(std::uint32_t c) {
    const CleanChain& chain = chains_.chains[c];
    if (chain.role == CleanChain::Role::Point) return;
    const std::size_t n = chain.walk.size();
    const std::size_t edges = chain.role == CleanChain::Role::Line ? n - 1 : n;
    for (std::size_t i = 0; i < edges; ++i) uses_.push_back({chain.walk[i], chain.walk[(i + 1) % n], c});
  }

  // Sorts the uses, cancels those of one feature in pairs, and lists the edges.
  void collapse(bool reported) {
    const auto key = [&](const EdgeUse& use) {
      return std::tuple(use.low(), use.high(), lineUse(use), featureOf(use), use.chain, use.a);
    };
    sortByLow();
    const auto before = [&](const EdgeUse& p, const EdgeUse& q) { return key(p) < key(q); };
    for (auto first = uses_.begin(); first != uses_.end();) {
      auto last = first + 1;
      while (last != uses_.end() && last->low() == first->low()) ++last;
      if (last - first > 1) std::sort(first, last, before);
      first = last;
    }
    std::uint32_t kept = 0;
    edges_.clear();
    edges_.reserve(uses_.size());
    for (std::size_t i = 0; i < uses_.size();) {
      const VertexId low = uses_[i].low(), high = uses_[i].high();
      const std::uint32_t first = kept;
      while (i < uses_.size() && uses_[i].low() == low && uses_[i].high() == high) {
        const EdgeUse use = uses_[i];
        std::size_t same = 0;
        for (; i < uses_.size() && uses_[i].low() == low && uses_[i].high() == high &&
               lineUse(uses_[i]) == lineUse(use) && (isLine(use) || featureOf(uses_[i]) == featureOf(use));
             ++i) {
          ++same;
          if (featureOf(uses_[i]) != featureOf(use)) report_.took_part.push_back(featureOf(uses_[i]));
        }
        if (isLine(use) || same % 2 == 1) uses_[kept++] = use;
        if (reported && same > 1 && !onSeam(low, high) && !isSilent(use)) {
          report_.add(EditKind::OverlappingEdge, chains_.vertices.input[low], coastline_, featureOf(use));
        }
      }
      if (kept > first) edges_.push_back({low, high, first, kept});
    }
    uses_.resize(kept);
  }

  // Counting sort: there are as many vertices as edges, and few edges at each.
  void sortByLow() {
    std::vector<std::uint32_t> next(chains_.vertices.plane.size() + 1, 0);
    for (const EdgeUse& use : uses_) ++next[use.low() + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<EdgeUse> sorted(uses_.size());
    for (const EdgeUse& use : uses_) sorted[next[use.low()]++] = use;
    uses_ = std::move(sorted);
  }

  bool onSeam(VertexId u, VertexId v) const {
    const CleanVertices& vertices = chains_.vertices;
    return chains_.seam && chains_.seam->holds(vertices.input[u]) && chains_.seam->holds(vertices.input[v]);
  }

  // Returns false if nothing is left to do.
  bool splitOnce(int round) {
    const double grain = grain_ * std::ldexp(1.0, std::max(0, round - kSnapRounds));
    const double tolerance = round < kSnapRounds ? std::max(chains_.snap, grain) : grain;
    if (round >= kSnapRounds) mergeVertices(grain);
    // The first round uses only the requested snap distance; the grain is for effects of rounding in later rounds.
    find(round == 0 ? chains_.snap : tolerance);
    if (splits_.empty() && crossings_.empty()) return false;
    if (round == 0) reportSplits();
    if (!crossings_.empty()) putCrossings(tolerance, round == 0);
    if (!splits_.empty()) {
      const Edge& first = edges_[splits_.front().edge];
      last_split_ = {featureOf(uses_[first.first_use]), chains_.vertices.input[first.low]};
    }
    apply();
    return true;
  }

  struct Found {
    std::vector<Split> splits;
    std::vector<Crossing> crossings;
  };

  void find(double tolerance) {
    splits_.clear();
    crossings_.clear();
    const auto box_of = [&](std::size_t e) { return Box::of(at(edges_[e].low), at(edges_[e].high)); };
    const auto active = [&](std::uint32_t e) { return active_[e] != 0; };
    const EdgeRuns runs(edges_.size(), box_of);
    const auto findIn = [&](std::size_t first, std::size_t last) {
      Found found;
      runs.visitPairs(first, last, tolerance, box_of, active, [&](std::uint32_t e, std::uint32_t f) {
        if (active_[e]) {
          testPair(e, f, tolerance, found);
        } else {
          testPair(f, e, tolerance, found);
        }
      });
      return found;
    };
    for (const Found& found : overStretches(loop_, runs.blockCount(), findIn, EdgeRuns::kWorthAStretch)) {
      splits_.insert(splits_.end(), found.splits.begin(), found.splits.end());
      crossings_.insert(crossings_.end(), found.crossings.begin(), found.crossings.end());
    }
    sortCrossings();
    for (const CleanChain& chain : chains_.chains) {
      if (chain.role != CleanChain::Role::Point) continue;
      const VertexId v = chain.walk.front();
      runs.visit(Box::of(at(v), at(v)).grownBy(tolerance), box_of, [&](std::uint32_t f) {
        const auto [low, high] = std::pair(edges_[f].low, edges_[f].high);
        if (v != low && v != high && liesOnEdge(at(low), at(high), at(v), tolerance)) splits_.push_back({f, v});
      });
    }
    std::sort(splits_.begin(), splits_.end());
    splits_.erase(std::unique(splits_.begin(), splits_.end()), splits_.end());
  }

  void testPair(std::uint32_t e, std::uint32_t f, double tolerance, Found& found) const {
    const auto [a, b] = std::pair(edges_[e].low, edges_[e].high);
    const auto [c, d] = std::pair(edges_[f].low, edges_[f].high);
    const std::size_t before = found.splits.size();
    for (const VertexId v : {c, d}) {
      if (v != a && v != b && liesOnEdge(at(a), at(b), at(v), tolerance)) found.splits.push_back({e, v});
    }
    for (const VertexId v : {a, b}) {
      if (v != c && v != d && liesOnEdge(at(c), at(d), at(v), tolerance)) found.splits.push_back({f, v});
    }
    if (found.splits.size() > before || a == c || a == d || b == c || b == d) return;
    if (orient2d(at(a), at(b), at(c)) * orient2d(at(a), at(b), at(d)) < 0 &&
        orient2d(at(c), at(d), at(a)) * orient2d(at(c), at(d), at(b)) < 0) {
      found.crossings.push_back({e, f});
    }
  }

  // Sorts by edge, and crossings of one edge along the Hilbert curve, so that new vertices are numbered in that order.
  void sortCrossings() {
    if (crossings_.empty()) return;
    std::vector<Point> centres;
    centres.reserve(edges_.size());
    for (const Edge& edge : edges_) {
      const Box box = Box::of(at(edge.low), at(edge.high));
      centres.push_back({box.xmin / 2 + box.xmax / 2, box.ymin / 2 + box.ymax / 2});
    }
    const std::vector<std::uint32_t> along = hilbertIndices(centres);
    std::ranges::sort(crossings_, {}, [&](const Crossing& c) { return std::tuple(c.e, along[c.f], c.f); });
  }

  void reportSplits() {
    for (const Split& split : splits_) {
      if (isSilent(uses_[edges_[split.edge].first_use])) continue;
      report_.add(EditKind::OverlappingEdge, chains_.vertices.input[split.vertex], coastline_,
                  featureOf(uses_[edges_[split.edge].first_use]));
    }
  }

  void putCrossings(double tolerance, bool reported) {
    CleanVertices& vertices = chains_.vertices;
    PointGrid grid(vertices.plane, tolerance, vertices.plane.size() + crossings_.size());
    for (VertexId v = 0; v < vertices.plane.size(); ++v) grid.add(v);
    for (const Crossing& crossing : crossings_) {
      const Edge &e = edges_[crossing.e], &f = edges_[crossing.f];
      const Point place = crossingPoint(at(e.low), at(e.high), at(f.low), at(f.high));
      VertexId v = grid.find(place);
      if (v == kNone) {
        v = static_cast<VertexId>(vertices.plane.size());
        vertices.plane.push_back(place);
        vertices.input.push_back(projection_.inverse(place));
        vertices.is_new.push_back(1);
        grid.add(v);
      }
      if (v != e.low && v != e.high) splits_.push_back({crossing.e, v});
      if (v != f.low && v != f.high) splits_.push_back({crossing.f, v});
      markCrossed(e, f, vertices.input[v], reported);
    }
    std::sort(splits_.begin(), splits_.end());
    splits_.erase(std::unique(splits_.begin(), splits_.end()), splits_.end());
  }

  void markCrossed(const Edge& e, const Edge& f, const Point& place, bool reported) {
    for (const Edge& edge : {e, f}) {
      for (std::size_t u = edge.first_use; u < edge.last_use; ++u) crossed_[uses_[u].chain] = 1;
    }
    if (!reported || isSilent(uses_[e.first_use]) || isSilent(uses_[f.first_use])) return;
    const std::uint32_t first = featureOf(uses_[e.first_use]), second = featureOf(uses_[f.first_use]);
    report_.add(first == second ? EditKind::SelfCrossing : EditKind::FeaturesCross, place, coastline_,
                std::max(first, second));
    if (first == second) warnOfOverlap(uses_[e.first_use].chain, uses_[f.first_use].chain, place);
  }

  // Rings nest by even-odd, which misplaced rings need: what two parts or two islands share is outside of both.
  void warnOfOverlap(std::uint32_t a, std::uint32_t b, const Point& place) {
    using Role = CleanChain::Role;
    const Role role = chains_.chains[a].role;
    if (a == b || role != chains_.chains[b].role || !chains_.chains[a].isRing()) return;
    const std::uint32_t feature = chains_.chains[a].feature;
    if (!overlapping_.insert(feature).second) return;
    report_.warnings.push_back(featureInWords(coastline_.features[feature]) +
                               (role == Role::Hole ? ": holes overlap near (" : ": parts overlap near (") +
                               roughPlaceInWords(place) + "), and what they share is " +
                               (role == Role::Hole ? "no hole" : "left out") +
                               ": unite them first, as Fix geometries or Dissolve does in QGIS");
  }

  // Makes every split edge a chain through the vertices found on it. New edges are active in the next round.
  void apply() {
    std::vector<EdgeUse> uses;
    uses.reserve(uses_.size() + 2 * splits_.size());
    std::vector<std::pair<VertexId, VertexId>> fresh;
    auto split = splits_.begin();
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      const Edge& edge = edges_[e];
      const auto first = split;
      while (split != splits_.end() && split->edge == e) ++split;
      if (first == split) {
        uses.insert(uses.end(), uses_.begin() + static_cast<std::ptrdiff_t>(edge.first_use),
                    uses_.begin() + static_cast<std::ptrdiff_t>(edge.last_use));
        continue;
      }
      const std::vector<VertexId> path = pathThrough(edge, first, split);
      for (std::size_t i = 1; i < path.size(); ++i) {
        fresh.emplace_back(std::minmax(path[i - 1], path[i]));
        for (std::size_t u = edge.first_use; u < edge.last_use; ++u) {
          const bool upward = uses_[u].a == edge.low;
          uses.push_back({upward ? path[i - 1] : path[i], upward ? path[i] : path[i - 1], uses_[u].chain});
        }
      }
    }
    uses_ = std::move(uses);
    collapse(false);
    activate(std::move(fresh));
  }

  // Activates the edges whose ends are listed, lower end first, and no others.
  void activate(std::vector<std::pair<VertexId, VertexId>> fresh) {
    std::sort(fresh.begin(), fresh.end());
    active_.assign(edges_.size(), 0);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      active_[e] = std::binary_search(fresh.begin(), fresh.end(), std::pair(edges_[e].low, edges_[e].high));
    }
  }

  // Merges vertices nearer than `tolerance` into the first of them. Between vertices as close as rounding moves edges,
  // splitting would never end.
  void mergeVertices(double tolerance) {
    std::vector<VertexId> target(chains_.vertices.plane.size(), kNone), kept;
    for (const EdgeUse& use : uses_) target[use.a] = target[use.b] = 0;
    for (const CleanChain& chain : chains_.chains) {
      if (chain.role == CleanChain::Role::Point) target[chain.walk.front()] = 0;
    }
    std::vector<Point> kept_places;
    PointGrid grid(kept_places, tolerance, target.size());
    for (VertexId v = 0; v < target.size(); ++v) {
      if (target[v] == kNone) continue;
      const VertexId near = grid.find(at(v));
      target[v] = near == kNone ? v : kept[near];
      if (near != kNone) continue;
      kept.push_back(v);
      kept_places.push_back(at(v));
      grid.add(static_cast<VertexId>(kept.size()) - 1);
    }
    std::vector<std::pair<VertexId, VertexId>> fresh;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const VertexId low = target[edges_[e].low], high = target[edges_[e].high];
      if (active_[e] || low != edges_[e].low || high != edges_[e].high) fresh.emplace_back(std::minmax(low, high));
    }
    for (EdgeUse& use : uses_) use.a = target[use.a], use.b = target[use.b];
    for (CleanChain& chain : chains_.chains) {
      if (chain.role == CleanChain::Role::Point) chain.walk.front() = target[chain.walk.front()];
    }
    std::erase_if(uses_, [](const EdgeUse& use) { return use.a == use.b; });
    collapse(false);
    activate(std::move(fresh));
  }

  std::vector<VertexId> pathThrough(const Edge& edge, std::vector<Split>::const_iterator first,
                                    std::vector<Split>::const_iterator last) const {
    const Point &a = at(edge.low), &b = at(edge.high);
    std::vector<std::pair<double, VertexId>> between;
    for (auto split = first; split != last; ++split) {
      const Point& v = at(split->vertex);
      between.emplace_back((v.x - a.x) * (b.x - a.x) + (v.y - a.y) * (b.y - a.y), split->vertex);
    }
    std::sort(between.begin(), between.end());
    std::vector<VertexId> path{edge.low};
    for (const auto& [along, v] : between) path.push_back(v);
    path.push_back(edge.high);
    return path;
  }

  CleanChains& chains_;
  const Coastline& coastline_;
  const Projection& projection_;
  CleanReport& report_;
  const ItemLoop& loop_;
  double grain_ = 0;  // distance below which rounding decides where points lie
  std::vector<EdgeUse> uses_;
  std::vector<Edge> edges_;
  std::vector<char> active_;  // by edge: not yet tested against all others
  std::vector<Split> splits_;
  std::vector<Crossing> crossings_;
  std::vector<char> crossed_;
  std::set<std::uint32_t> overlapping_;  // features that were warned of
  struct {
    std::uint32_t feature = 0;
    Point place;
  } last_split_;  // for the error if rounds do not terminate
};

}  // namespace

NodedEdges nodeChains(CleanChains& chains, const Coastline& coastline, const Projection& projection,
                      CleanReport& report, const ItemLoop& loop) {
  return Noder(chains, coastline, projection, report, loop).run();
}

}  // namespace coastmesh
