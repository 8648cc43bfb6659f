#include "core/size/size_grading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/ids.hpp"
#include "core/large_list.hpp"
#include "core/metric.hpp"
#include "core/size/on_surface.hpp"
#include "core/size/size_queue.hpp"

namespace coastmesh {

namespace {

// Above this multiple of the gradation sizes are graded by distance; below it, flattening triangles is cheaper.
constexpr double kMuchTooSteep = 1.1;
// Sizes stay constant over this share of the way from a place to its neighbours. Grown all the way to two neighbours at
// a right angle they would be too steep between these, and lowering them there would make the next cells too steep,
// without end.
constexpr double kFlatFoot = 0.3;
// Triangles are flattened to slightly less than the allowed slope, so that every step makes progress.
constexpr double kFlattened = 1.0 - 1e-5;
// Mean visits to a cell before `flattenLegs`, which always ends, takes over.
constexpr std::size_t kMostVisits = 64;
// The cells around a vertex that only split cells have.
constexpr std::array<std::uint32_t, 4> kNowhere = {kNone, kNone, kNone, kNone};

// Spare room for new vertices: one for every kSpare present.
constexpr std::size_t kSpare = 32;

// Like `SizeGrading::forEachSlope`, with sizes by slot in a cell. `f` may change these.
template <typename F>
void forEachSlopeOf(const LeafVertices& leaf, const std::array<double, 9>& h, F&& f) {
  constexpr std::array<std::array<std::size_t, 3>, 4> kSides = {{{0, 1, 2}, {2, 5, 8}, {8, 7, 6}, {6, 3, 0}}};
  const auto square = [](double x) { return x * x; };
  for (const auto& [a, m, b] : kSides) {
    if (leaf[m] == kNone) {
      f(std::size_t{4}, a, b, 0.5 * (square(h[a] - h[4]) + square(h[b] - h[4])));
      continue;
    }
    f(std::size_t{4}, a, m, square(h[m] - h[4]) + square(h[a] - h[m]));
    f(std::size_t{4}, m, b, square(h[m] - h[4]) + square(h[b] - h[m]));
  }
}

// Gradient of sizes on a triangle, from the differences between one corner and the two others.
Point gradient(const Point& ab, const Point& ac, double hb, double hc) {
  return (1.0 / cross(ab, ac)) * (hb * Point{ac.y, -ac.x} + hc * Point{-ab.y, ab.x});
}

void sortOnce(std::vector<std::uint32_t>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

// `work(r)` for every r below `ranges`, in at most `items` items: a loop on threads costs as much as some hundred
// vertices.
template <typename Work>
void forRanges(const ItemLoop& loop, std::size_t ranges, std::size_t items, const Work& work) {
  items = std::min(items, ranges);
  if (items < 2) return inOrder(ranges, work);
  loop(items, [&](std::size_t i) {
    for (std::size_t r = ranges * i / items; r < ranges * (i + 1) / items; ++r) work(r);
  });
}

// Sizes are stored in single precision. Rounding before comparing ensures that they are not too steep afterwards.
double roundedDown(double size) {
  const auto rounded = static_cast<float>(size);
  return rounded <= size ? rounded : std::nextafter(rounded, 0.0F);
}

}  // namespace

double SizeGrid::shrinkAt(std::uint32_t v) const {
  return surface.isCurved() ? surface.shrinkAt(origin + placeOf(v)) : 1.0;
}

double SizeGrid::distanceBetween(std::uint32_t v, std::uint32_t w) const {
  const double straight = distance(placeOf(v), placeOf(w));
  return surface.isCurved() ? arcOfChord(surface, straight * std::sqrt(shrinkAt(v) * shrinkAt(w))) : straight;
}

// The scale factor is smallest at one of the corners.
double SizeGrid::slopeIn(const LeafVertices& leaf) const {
  if (!surface.isCurved()) return gradation;
  const Point low = origin + placeOf(leaf[0]), high = origin + placeOf(leaf[8]);
  return gradation * surface.shrinkAt({std::max(-low.x, high.x), std::max(-low.y, high.y)});
}

SizeGrading::SizeGrading(GradedSizes& sizes, const SizeGrid& grid, std::span<const LeafVertices> leaves,
                         const ItemLoop& loop)
    : sizes_(sizes), grid_(grid), leaves_(leaves), loop_(loop) {
  reserveOn(loop_, round_, grid_.places.size(), grid_.places.size() / kSpare);
  round_.assign(grid_.places.size(), kNowhere);
  forEachByStretches(loop_, leaves_.size(), [&](std::size_t l) { takeIn(static_cast<std::uint32_t>(l)); });
  reserveOn(loop_, halves_, grid_.places.size(), grid_.places.size() / kSpare);
  halves_.resize(grid_.places.size());
  forEachByStretches(loop_, halves_.size(),
                     [&](std::size_t v) { halves_[v] = largestRound(static_cast<std::uint32_t>(v)); });
}

void SizeGrading::update(std::span<const LeafVertices> leaves, std::span<const std::uint32_t> changed) {
  leaves_ = leaves;
  round_.resize(grid_.places.size(), kNowhere);
  halves_.resize(grid_.places.size());
  for (const std::uint32_t l : changed) takeIn(l);
  for (const std::uint32_t l : changed)
    for (const std::uint32_t v : leaves_[l])
      if (v != kNone) halves_[v] = largestRound(v);
}

void SizeGrading::takeIn(std::uint32_t leaf) {
  // The quadrants of each vertex that lie in its cell, as bits.
  constexpr std::array<unsigned, 9> kQuadrants = {1, 3, 2, 5, 15, 10, 4, 12, 8};
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t k = 0; k < 4; ++k)
      if (leaves_[leaf][i] != kNone && (kQuadrants[i] >> k & 1) != 0) round_[leaves_[leaf][i]][k] = leaf;
}

// Half a cell's side, in the plane.
double SizeGrading::halfOf(const LeafVertices& leaf) const {
  return grid_.unit * (grid_.places[leaf[4]].x - grid_.places[leaf[0]].x);
}

// Calls `f(a, b, c, square)` for a cell's triangles, with the slots of their vertices and the squared product of the
// gradient and half the cell's side: the sum of squared differences along the legs if these are halves, otherwise half
// of it.
template <typename F>
void SizeGrading::forEachSlope(const LeafVertices& leaf, F&& f) const {
  std::array<double, 9> h;
  for (std::size_t i = 0; i < 9; ++i) h[i] = leaf[i] == kNone ? 0.0 : sizes_.size[leaf[i]];
  forEachSlopeOf(leaf, h, f);
}

bool SizeGrading::isSteep(std::uint32_t leaf) const {
  const double rise = grid_.slopeIn(leaves_[leaf]) * halfOf(leaves_[leaf]);
  bool is = false;
  forEachSlope(leaves_[leaf], [&](auto, auto, auto, double square) { is = is || !(square <= rise * rise); });
  return is;
}

// With the smallest size in each.
std::vector<SizeQueue::Entry> SizeGrading::findSteep() const {
  return joined(overStretches(loop_, leaves_.size(), [&](std::size_t first, std::size_t last) {
    std::vector<SizeQueue::Entry> steep;
    for (auto l = static_cast<std::uint32_t>(first); l < last; ++l)
      if (isSteep(l)) steep.push_back({lowestOf(l), l});
    return steep;
  }));
}

double SizeGrading::lowestOf(std::uint32_t leaf) const {
  double low = sizes_.size[leaves_[leaf][4]];
  for (const std::uint32_t v : leaves_[leaf])
    if (v != kNone) low = std::min(low, sizes_.size[v]);
  return low;
}

void SizeGrading::spread() {
  // First into areas without requested sizes, from their boundaries.
  const auto isFree = [&](std::uint32_t v) { return v != kNone && !std::isfinite(sizes_.size[v]); };
  grow(joined(overStretches(loop_, leaves_.size(),
                            [&](std::size_t first, std::size_t last) {
                              std::vector<std::uint32_t> boundary;
                              for (const LeafVertices& leaf : leaves_.subspan(first, last - first)) {
                                if (std::ranges::none_of(leaf, isFree)) continue;
                                for (const std::uint32_t v : leaf)
                                  if (v != kNone && !isFree(v)) boundary.push_back(v);
                              }
                              sortOnce(boundary);
                              return boundary;
                            })),
       [&](std::uint32_t v) { return !std::isfinite(sizes_.own[v]); });

  // Then to vertices that request more.
  std::vector<std::uint32_t> low =
      joined(overStretches(loop_, leaves_.size(), [&](std::size_t first, std::size_t last) {
        std::vector<std::uint32_t> lowest;
        for (const LeafVertices& leaf : leaves_.subspan(first, last - first)) {
          const double limit = kMuchTooSteep * grid_.slopeIn(leaf) * halfOf(leaf);
          forEachSlope(leaf, [&](std::size_t a, std::size_t b, std::size_t c, double square) {
            if (square > limit * limit)
              lowest.push_back(std::min({leaf[a], leaf[b], leaf[c]},
                                        [&](auto v, auto w) { return sizes_.size[v] < sizes_.size[w]; }));
          });
        }
        sortOnce(lowest);
        return lowest;
      }));
  const std::vector<std::uint32_t> others = besideNew();
  low.insert(low.end(), others.begin(), others.end());
  grow(std::move(low), [](std::uint32_t) { return true; });
  sizes_.is_spread.resize(grid_.places.size(), 0);
  forEachByStretches(loop_, grid_.places.size(),
                     [&](std::size_t v) { sizes_.is_spread[v] |= std::uint8_t{round_[v] != kNowhere}; });
}

// Vertices whose growth may have to continue to new vertices beside them.
std::vector<std::uint32_t> SizeGrading::besideNew() const {
  const auto isNew = [&](std::uint32_t v) {
    return v != kNone && (v >= sizes_.is_spread.size() || sizes_.is_spread[v] == 0);
  };
  return joined(overStretches(loop_, leaves_.size(), [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> here;
    for (const LeafVertices& leaf : leaves_.subspan(first, last - first)) {
      if (std::ranges::none_of(leaf, isNew)) continue;
      for (const std::uint32_t v : leaf)
        if (v != kNone && sizes_.source[v] != kNone && std::isfinite(sizes_.own[v])) here.push_back(v);
    }
    sortOnce(here);
    return here;
  }));
}

// Half the side of the largest cell around a vertex, in units.
std::uint32_t SizeGrading::largestRound(std::uint32_t v) const {
  std::uint32_t half = 0;
  for (const std::uint32_t l : round_[v])
    if (l != kNone) half = std::max(half, grid_.places[leaves_[l][4]].x - grid_.places[leaves_[l][0]].x);
  return half;
}

// The longest leg of the triangles around a vertex, on the surface.
double SizeGrading::legAt(std::uint32_t v) const {
  return std::numbers::sqrt2 * grid_.unit * halves_[v] * grid_.shrinkAt(v);
}

// Prefetches the data of the entries that follow: in order of size they are scattered over memory. Inline, since a call
// without other effects is optimised away.
[[gnu::always_inline]] inline void SizeGrading::fetchAhead(std::span<const SizeQueue::Entry> batch) const {
  constexpr std::size_t kSteps = 8;
  if (batch.size() > 3 * kSteps) {
    const std::uint32_t v = batch[3 * kSteps].number;
    __builtin_prefetch(&sizes_.size[v]);
    __builtin_prefetch(&sizes_.source[v]);
    __builtin_prefetch(&round_[v]);
  }
  if (batch.size() > 2 * kSteps) {
    const std::uint32_t v = batch[2 * kSteps].number;
    const std::uint32_t origin = sizes_.source[v] == kNone ? v : sizes_.source[v];
    __builtin_prefetch(&sizes_.own[origin]);
    __builtin_prefetch(&grid_.places[origin]);
    __builtin_prefetch(&halves_[origin]);
    for (const std::uint32_t l : round_[v])
      if (l != kNone) __builtin_prefetch(&leaves_[l]);
  }
  if (batch.size() > kSteps) {
    forLeavesRound(batch[kSteps].number, [&](std::uint32_t l) {
      for (const std::size_t i : {0, 2, 4, 6, 8}) {
        __builtin_prefetch(&sizes_.size[leaves_[l][i]]);
        __builtin_prefetch(&grid_.places[leaves_[l][i]]);
      }
    });
  }
}

[[gnu::always_inline]] inline void SizeGrading::fetchLeaf(std::span<const std::uint32_t> leaves) const {
  constexpr std::size_t kSteps = 6;
  if (leaves.size() > 2 * kSteps) __builtin_prefetch(&leaves_[leaves[2 * kSteps]]);
  if (leaves.size() <= kSteps) return;
  const LeafVertices& leaf = leaves_[leaves[kSteps]];
  __builtin_prefetch(&grid_.places[leaf[0]]);
  __builtin_prefetch(&grid_.places[leaf[4]]);
  for (const std::uint32_t v : leaf)
    if (v != kNone) __builtin_prefetch(&sizes_.size[v]);
}

// Sizes grow with the distance on the surface from their source, not along edges: every vertex stores its source.
// Growth is found for a whole batch at once, and then applied in the order of its vertices' numbers, each range of
// vertices by itself. What it does to a vertex depends on neither the ranges nor the threads.
template <typename F>
void SizeGrading::grow(const std::vector<std::uint32_t>& from, const F& mayLower) {
  SizeQueues queues(grid_.places.size());
  struct alignas(64) Found {
    std::vector<std::uint32_t> start;
    std::vector<Growth> within, beyond;  // found in this range, to vertices of it and of others
    std::vector<Growth> before, after;   // to vertices of this range, found in ranges before and after it
  };
  std::vector<Found> found(queues.count());
  for (const std::uint32_t v : from) found[queues.rangeOf(v)].start.push_back(v);
  loop_(queues.count(), [&](std::size_t r) {
    sortOnce(found[r].start);
    for (const std::uint32_t v : found[r].start)
      if (std::isfinite(sizes_.size[v])) queues.push({sizes_.size[v], v});
  });
  const auto find = [&](std::size_t r) {
    std::vector<SizeQueue::Entry>& batch = queues[r].batch;
    std::ranges::sort(batch, {}, [](const SizeQueue::Entry& e) { return e.number; });
    for (std::size_t i = 0; i < batch.size(); ++i) {
      fetchAhead(std::span(batch).subspan(i));
      if (batch[i].size != sizes_.size[batch[i].number]) continue;
      findGrowth(batch[i].number, mayLower, [&](const Growth& growth) {
        (queues.rangeOf(growth.to) == r ? found[r].within : found[r].beyond).push_back(growth);
      });
    }
  };
  const auto pass = [&](std::size_t r) {
    for (const Growth& growth : found[r].beyond) {
      const std::size_t to = queues.rangeOf(growth.to);
      (r < to ? found[to].before : found[to].after).push_back(growth);
    }
    found[r].beyond.clear();
  };
  const auto apply = [&](std::size_t r) {
    for (std::vector<Growth>* some : {&found[r].before, &found[r].within, &found[r].after}) {
      for (const auto& [allowed, to, origin] : *some) {
        if (!(allowed < sizes_.size[to] * (1.0 - 1e-9))) continue;
        sizes_.size[to] = allowed;
        sizes_.source[to] = origin;
        queues.push({allowed, to});
      }
      some->clear();
    }
  };
  while (const std::size_t waiting = queues.take()) {
    constexpr std::size_t kWorthAnItem = 200;
    forRanges(loop_, queues.count(), waiting / kWorthAnItem, find);
    inOrder(queues.count(), pass);
    forRanges(loop_, queues.count(), waiting / kWorthAnItem, apply);
  }
}

// Finds what growth at a vertex lowers around it.
template <typename F, typename G>
void SizeGrading::findGrowth(std::uint32_t v, const F& mayLower, G&& found) const {
  const std::uint32_t origin = sizes_.source[v] == kNone ? v : sizes_.source[v];
  const double own = sizes_.own[origin], flat = kFlatFoot * legAt(origin), rate = kSizeGrowth * grid_.gradation;
  const Point from = placeOf(origin);
  const bool curved = grid_.surface.isCurved();
  constexpr double kSurely = 1.0 + 1e-12;
  forLeavesRound(v, [&](std::uint32_t l) {
    for (const std::uint32_t w : leaves_[l]) {
      if (w == kNone || !mayLower(w)) continue;
      const double limit = sizes_.size[w] * (1.0 - 1e-9), reach = (limit - own) / rate + flat;
      // Shows for most vertices, without a root, that they are not lowered.
      if (!curved && !(reach > 0.0 && squaredDistance(from, placeOf(w)) < kSurely * reach * reach)) continue;
      const double way = std::max(grid_.distanceBetween(origin, w) - flat, 0.0);
      const double allowed = own + rate * way;
      if (allowed < limit) found(Growth{allowed, w, origin});
    }
  });
}

// Leaves of a batch are flattened at once, each from the present sizes; the lowest counts if several lower a vertex.
// What happens depends on the leaves of a batch, not on their order.
void SizeGrading::flatten() {
  forEachByStretches(loop_, sizes_.size.size(), [&](std::size_t v) { sizes_.size[v] = roundedDown(sizes_.size[v]); });
  // Smallest sizes first, since they determine larger ones.
  SizeQueues queues(leaves_.size());
  for (const SizeQueue::Entry& steep : findSteep()) queues.push(steep);
  struct alignas(64) Work {
    std::vector<std::uint32_t> leaves;
    std::vector<Lowered> lowered;
    std::vector<SizeQueue::Entry> beyond;  // steep leaves of other ranges
  };
  std::vector<Work> work(queues.count());
  const auto flattenRange = [&](std::size_t r) {
    std::vector<std::uint32_t>& leaves = work[r].leaves;
    leaves.clear();
    for (const SizeQueue::Entry& e : queues[r].batch) leaves.push_back(e.number);
    sortOnce(leaves);
    for (std::size_t k = 0; k < leaves.size(); ++k) {
      fetchLeaf(std::span(leaves).subspan(k));
      flattenLeaf(leaves[k], work[r].lowered);
    }
  };
  const auto lower = [&](std::size_t r) {
    work[r].leaves.clear();
    for (const auto& [v, size] : work[r].lowered) {
      if (!lowerTo(sizes_.size[v], size)) continue;
      for (const std::uint32_t l : round_[v])
        if (l != kNone && isFirstToSee(l)) work[r].leaves.push_back(l);
    }
    work[r].lowered.clear();
  };
  const auto enqueueSteep = [&](std::size_t r) {
    const std::vector<std::uint32_t>& leaves = work[r].leaves;
    for (std::size_t k = 0; k < leaves.size(); ++k) {
      fetchLeaf(std::span(leaves).subspan(k));
      if (!isSteep(leaves[k])) continue;
      const SizeQueue::Entry steep{lowestOf(leaves[k]), leaves[k]};
      if (queues.rangeOf(leaves[k]) == r)
        queues.push(steep);
      else
        work[r].beyond.push_back(steep);
    }
  };
  seen_.assign(leaves_.size(), 0);
  seen_last_ = 0;
  std::size_t visits = kMostVisits * leaves_.size();
  while (const std::size_t waiting = queues.take()) {
    constexpr std::size_t kWorthAnItem = 64;
    const std::size_t items = waiting / kWorthAnItem;
    ++seen_last_;
    forRanges(loop_, queues.count(), items, flattenRange);
    std::size_t flattened = 0;
    for (const Work& range : work) flattened += range.leaves.size();
    if (visits < flattened) return flattenLegs();
    visits -= flattened;
    forRanges(loop_, queues.count(), items, lower);
    forRanges(loop_, queues.count(), items, enqueueSteep);
    for (Work& range : work) {
      for (const SizeQueue::Entry& steep : range.beyond) queues.push(steep);
      range.beyond.clear();
    }
  }
}

// True for one of the threads that ask for a leaf in a batch.
bool SizeGrading::isFirstToSee(std::uint32_t leaf) {
  return __atomic_load_n(&seen_[leaf], __ATOMIC_RELAXED) != seen_last_ &&
         __atomic_exchange_n(&seen_[leaf], seen_last_, __ATOMIC_RELAXED) != seen_last_;
}

// Sets the nearest sizes, by least squares, that make each triangle as steep as allowed: corners on its upper side go
// down. Tilting it about its lowest corner would lower more and make its neighbours steep in turn, without end.
void SizeGrading::flattenLeaf(std::uint32_t leaf, std::vector<Lowered>& lowered) const {
  const LeafVertices& vertices = leaves_[leaf];
  const double steepest = grid_.slopeIn(vertices);
  std::array<double, 9> size{};
  for (std::size_t i = 0; i < size.size(); ++i)
    if (vertices[i] != kNone) size[i] = sizes_.size[vertices[i]];
  const double rise = steepest * halfOf(vertices);
  forEachSlopeOf(vertices, size, [&](std::size_t a, std::size_t b, std::size_t c, double square) {
    if (square <= rise * rise) return;
    const std::array<std::size_t, 3> slots = {a, b, c};
    const std::array<Point, 3> places = {placeOf(vertices[a]), placeOf(vertices[b]), placeOf(vertices[c])};
    const Point slope = gradient(places[1] - places[0], places[2] - places[0], size[b] - size[a], size[c] - size[a]);
    // Change of the gradient if each corner is lowered at the rate at which that reduces the squared slope.
    std::array<double, 3> down;
    Point change;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point p = places[i], q = places[(i + 1) % 3], r = places[(i + 2) % 3];
      const Point normal{q.y - r.y, r.x - q.x};
      const Point with = (1.0 / dot(normal, p - q)) * normal;  // gradient of 1 here and 0 at the others
      down[i] = std::max(0.0, dot(with, slope));
      change = change + down[i] * with;
    }
    // Until |slope - way * change| is the allowed slope, or as close to it as this direction gets.
    const double allowed = kFlattened * steepest;
    const double aa = squaredLength(change), ab = dot(slope, change);
    const double inside = ab * ab - aa * (squaredLength(slope) - allowed * allowed);
    const double way = (ab - std::sqrt(std::max(inside, 0.0))) / aa;
    for (std::size_t i = 0; i < 3; ++i)
      if (down[i] > 0.0) size[slots[i]] = roundedDown(size[slots[i]] - way * down[i]);
  });
  for (std::size_t i = 0; i < size.size(); ++i)
    if (vertices[i] != kNone && size[i] < sizes_.size[vertices[i]]) lowered.push_back({vertices[i], size[i]});
}

// If flattening takes too long: in every cell that has a lowered vertex, sizes along both legs of a right angle differ
// by at most the gradation over the square root of 2. This always ends: each cell is added once, and in the added cells
// sizes are lengths of shortest paths.
void SizeGrading::flattenLegs() {
  std::vector<bool> is_strict(leaves_.size(), false);
  SizeQueue queue;
  const auto takeIn = [&](std::uint32_t l) {
    if (is_strict[l]) return;
    is_strict[l] = true;
    for (const std::uint32_t v : leaves_[l])
      if (v != kNone) queue.push({sizes_.size[v], v});
  };
  for (const SizeQueue::Entry& steep : findSteep()) takeIn(steep.number);
  const auto growLegs = [&](double size, std::uint32_t v) {
    forLeavesRound(v, [&](std::uint32_t l) {
      if (!is_strict[l]) return;
      const double slope = grid_.slopeIn(leaves_[l]);
      forEachTriangle(leaves_[l], [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (v != a && v != b && v != c) return;
        for (const std::uint32_t w : {a, b, c}) {
          const double growth = kFlattened * std::sqrt(0.5) * slope * distance(placeOf(v), placeOf(w));
          const double allowed = std::max(size, roundedDown(size + growth));
          if (!(allowed < sizes_.size[w])) continue;
          sizes_.size[w] = allowed;
          queue.push({allowed, w});
          forLeavesRound(w, takeIn);
        }
      });
    });
  };
  std::vector<SizeQueue::Entry> batch;
  while (queue.take(batch))
    for (const SizeQueue::Entry& e : batch)
      if (e.size == sizes_.size[e.number]) growLegs(e.size, e.number);
}

}  // namespace coastmesh
