#include "gis/size/depth_gaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>
#include <tuple>
#include <utility>

#include "core/metric.hpp"
#include "gis/geometry/membrane.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kMostNodes = 1'000'000;  // beyond this squares are not divided
constexpr double kFineShare = 0.5;             // largest side of squares at an edge, relative to the size there
// Squares crossed by a shore are divided to this share of the root, so that waters on both sides of land stay separate.
// A shore crosses a square if less than `kAllWater` of it is water.
constexpr double kFinestShore = 1.0 / 512.0, kAllWater = 0.97;
constexpr int kMoreLevels = 2;  // further divisions of squares without a depth
constexpr int kProbes = 4;      // along each side of a square with partly known depths

SizeBox childOf(const SizeBox& box, unsigned i) {
  const double half = 0.5 * box.half;
  return {box.centre + Point{(i & 1U) != 0U ? half : -half, (i & 2U) != 0U ? half : -half}, half};
}

}  // namespace

double DepthGaps::Leaf::at(const Point& place) const {
  if (std::isnan(depth_m)) return depth_m;
  return std::clamp(depth_m + dot(gradient, place - box.centre), least_m, most_m);
}

// What a gap's square meets across one of its sides: another square, or a known depth.
struct DepthGaps::Side {
  std::uint32_t leaf = kNone, other = kNone;  // `other`: kNone if a depth is known
  double weight = 0.0;                        // length of contact over the distance of the centres
  Point step;                                 // from the leaf's centre to the other's, or to the depth
  Point place;                                // of the depth
  double depth_m = std::numeric_limits<double>::quiet_NaN();
};

DepthGaps::DepthGaps(const SizeField& known, const DomainMask& mask, const SizeBox& root, double least_m,
                     std::function<double(const Point&)> scale, const ItemLoop& loop)
    : root_(root), scale_(std::move(scale)), least_half_(root.half) {
  build(known, mask, least_m, loop);
}

void DepthGaps::build(const SizeField& known, const DomainMask& mask, double least_m, const ItemLoop& loop) {
  struct Work {
    std::uint32_t node;
    SizeBox box;
    int gap_levels;  // divisions of a square without a depth; 0: it may have one
  };
  nodes_.assign(1, {});
  std::vector<Work> level{{0, root_, 0}};
  while (!level.empty()) {
    std::vector<SizeBox> boxes;
    for (const Work& work : level) boxes.push_back(work.box);
    std::vector<SizeRange> ranges(boxes.size(), {kInfinity, kInfinity});
    std::vector<char> wet(boxes.size());
    forStretches(loop, boxes.size(), [&](std::size_t first, std::size_t last) {
      std::vector<SizeBox> asked;
      for (std::size_t i = first; i < last; ++i) {
        wet[i] = mask.meets(boxes[i]) ? 1 : 0;
        if (wet[i] != 0 && level[i].gap_levels == 0) asked.push_back(boxes[i]);
      }
      std::vector<SizeRange> found(asked.size());
      known.bound(asked, found);
      for (std::size_t i = first, k = 0; i < last; ++i)
        if (wet[i] != 0 && level[i].gap_levels == 0) ranges[i] = found[k++];
    });
    std::vector<Work> next;
    for (std::size_t i = 0; i < level.size(); ++i) {
      const auto& [number, box, gap_levels] = level[i];
      const SizeRange& range = ranges[i];
      least_half_ = std::min(least_half_, box.half);
      if (wet[i] == 0) continue;
      const bool is_gap = range.low == kInfinity;
      if (!is_gap && range.high < kInfinity) {
        nodes_[number].kind = Kind::Known;
        continue;
      }
      const double scale = scale_(box.centre);
      const double finest = scale * kFineShare * std::max(is_gap ? 0.0 : range.low, least_m);
      // The mask's cells may be much wider than the land; shares are exact.
      const double share = is_gap ? mask.share(box) : 1.0;
      const bool on_shore = share < kAllWater && box.half > kFinestShore * root_.half;
      const bool divide = 2.0 * box.half > finest && (!is_gap || gap_levels < kMoreLevels || on_shore);
      if (divide && nodes_.size() + 4 <= kMostNodes) {
        nodes_[number] = {static_cast<std::uint32_t>(nodes_.size()), Kind::Below};
        for (unsigned c = 0; c < 4; ++c) {
          next.push_back({static_cast<std::uint32_t>(nodes_.size()), childOf(box, c), is_gap ? gap_levels + 1 : 0});
          nodes_.emplace_back();
        }
        continue;
      }
      nodes_[number] = {static_cast<std::uint32_t>(leaves_.size()), is_gap ? Kind::Gap : Kind::Part};
      Leaf& leaf = leaves_.emplace_back();
      leaf.box = box;
      leaf.gap = is_gap;
      leaf.dry = share < 1.0 - kAllWater;
      leaf.scale = scale;
      leaf.water = is_gap ? share : 0.0;
      leaf.middle = box.centre;
      gap_leaves_ += is_gap && !leaf.dry ? 1 : 0;
    }
    level = std::move(next);
  }
}

template <typename Visit>
void DepthGaps::forEachLeaf(const Point& low, const Point& high, const Visit& visit) const {
  std::vector<std::pair<std::uint32_t, SizeBox>> stack{{0, root_}};
  while (!stack.empty()) {
    const auto [number, box] = stack.back();
    stack.pop_back();
    if (low.x > box.centre.x + box.half || high.x < box.centre.x - box.half || low.y > box.centre.y + box.half ||
        high.y < box.centre.y - box.half)
      continue;
    const Node& node = nodes_[number];
    if (node.kind != Kind::Below) {
      visit(node, box);
      continue;
    }
    for (unsigned c = 0; c < 4; ++c) stack.emplace_back(node.next + c, childOf(box, c));
  }
}

void DepthGaps::fillParts(const SizeField& known, const DomainMask& mask, const std::function<double(double)>& depth_of,
                          const ItemLoop& loop) {
  forStretches(loop, leaves_.size(), [&](std::size_t first, std::size_t last) {
    std::vector<Point> places;
    std::vector<double> sizes;
    for (std::size_t l = first; l < last; ++l) {
      Leaf& leaf = leaves_[l];
      if (leaf.gap) continue;
      places.clear();
      const double step = 2.0 * leaf.box.half / kProbes;
      for (int k = 0; k < kProbes * kProbes; ++k)
        places.push_back(leaf.box.centre +
                         Point{(k % kProbes + 0.5) * step - leaf.box.half, (k / kProbes + 0.5) * step - leaf.box.half});
      sizes.resize(places.size());
      known.sample(places, sizes);
      double sum = 0.0, wettest = 0.0;
      int count = 0;
      for (std::size_t k = 0; k < sizes.size(); ++k) {
        if (std::isfinite(sizes[k])) {
          sum += depth_of(sizes[k]);
          ++count;
          continue;
        }
        const double share = mask.share({places[k], leaf.box.half / kProbes});
        leaf.water += share / (kProbes * kProbes);
        if (share <= wettest) continue;
        wettest = share;
        leaf.middle = places[k];
      }
      if (count > 0) leaf.depth_m = leaf.least_m = leaf.most_m = sum / count;
    }
  });
}

void DepthGaps::measureWater(const DomainMask& mask) {
  const Leaf* wettest = nullptr;
  double most_m2 = 0.0;
  for (const Leaf& leaf : leaves_) {
    const double side_m = 2.0 * leaf.box.half / leaf.scale, water_m2 = side_m * side_m * leaf.water;
    area_m2_ += water_m2;
    if (water_m2 <= most_m2) continue;
    most_m2 = water_m2;
    wettest = &leaf;
  }
  if (wettest == nullptr) return;
  place_ = wettest->middle;
  // The centre of a square that a shore crosses may be land: its wettest quarter, and the wettest quarter of that.
  SizeBox box = wettest->box;
  for (int level = 0; level < 2 && wettest->gap && mask.share(box) < kAllWater; ++level) {
    std::array<SizeBox, 4> quarters;
    for (unsigned c = 0; c < 4; ++c) quarters[c] = childOf(box, c);
    box = *std::ranges::max_element(quarters, {}, [&mask](const SizeBox& quarter) { return mask.share(quarter); });
    place_ = box.centre;
  }
}

std::vector<DepthGaps::Side> DepthGaps::sides() const {
  std::vector<Side> found;
  const double hair = 0.25 * least_half_;
  for (std::uint32_t l = 0; l < leaves_.size(); ++l) {
    const Leaf& leaf = leaves_[l];
    if (!leaf.gap) continue;
    const Point& c = leaf.box.centre;
    const double half = leaf.box.half;
    for (int side = 0; side < 4; ++side) {
      const bool upright = side < 2;  // the side runs along y
      const double sign = side % 2 == 0 ? -1.0 : 1.0;
      const Point out = upright ? Point{sign, 0.0} : Point{0.0, sign};
      const double span = half - hair;
      const Point middle = c + (half + hair) * out, along = upright ? Point{0.0, span} : Point{span, 0.0};
      forEachLeaf(middle - along, middle + along, [&](const Node& node, const SizeBox& box) {
        if (node.kind == Kind::Outside) return;
        const auto axis = [&](const Point& p) { return upright ? p.y : p.x; };
        const double begin = std::max(axis(c) - half, axis(box.centre) - box.half);
        const double end = std::min(axis(c) + half, axis(box.centre) + box.half);
        Side met;
        met.leaf = l;
        if (node.kind == Kind::Gap) {
          met.other = node.next;
          met.weight = (end - begin) / (half + box.half);
          met.step = box.centre - c;
        } else {
          const double beyond = std::min(half, box.half), across = 0.5 * (begin + end) - axis(c);
          met.weight = (end - begin) / (half + beyond);
          met.step = (half + beyond) * out + (upright ? Point{0.0, across} : Point{across, 0.0});
          met.place = c + met.step;
          // The mean of a partly known square, unless `fixSides` finds a depth.
          if (node.kind == Kind::Part) met.depth_m = leaves_[node.next].depth_m;
        }
        found.push_back(met);
      });
    }
  }
  return found;
}

void DepthGaps::fixSides(const SizeField& known, const std::function<double(double)>& depth_of,
                         std::vector<Side>& sides, const ItemLoop& loop) const {
  forStretches(loop, sides.size(), [&](std::size_t first, std::size_t last) {
    std::vector<Point> places;
    std::vector<std::size_t> which;
    for (std::size_t i = first; i < last; ++i) {
      if (sides[i].other != kNone) continue;
      places.push_back(sides[i].place);
      which.push_back(i);
    }
    std::vector<double> sizes(places.size());
    known.sample(places, sizes);
    for (std::size_t k = 0; k < which.size(); ++k)
      if (std::isfinite(sizes[k])) sides[which[k]].depth_m = depth_of(sizes[k]);
  });
  std::erase_if(sides, [](const Side& side) { return side.other == kNone && std::isnan(side.depth_m); });
}

// The first side of each leaf, and the end.
std::vector<std::size_t> DepthGaps::beginsOf(const std::vector<Side>& sides) const {
  std::vector<std::size_t> begin(leaves_.size() + 1, 0);
  for (const Side& side : sides) ++begin[side.leaf + 1];
  for (std::size_t l = 0; l < leaves_.size(); ++l) begin[l + 1] += begin[l];
  return begin;
}

// The weighted mean of the depths across these sides; NaN if none is known.
double DepthGaps::meanAcross(std::span<const Side> sides) const {
  double sum = 0.0, weights = 0.0;
  for (const Side& side : sides) {
    const double depth = side.other == kNone ? side.depth_m : leaves_[side.other].depth_m;
    if (std::isnan(depth)) continue;
    sum += side.weight * depth;
    weights += side.weight;
  }
  return sum / weights;
}

void DepthGaps::fillByMean(const std::vector<Side>& sides, const ItemLoop& loop) {
  const std::vector<std::size_t> begin = beginsOf(sides);
  // From the edges of a gap inwards: an initial guess, and the leaves that can be reached.
  std::vector<std::uint32_t> ring, all;
  std::vector<bool> waiting(leaves_.size(), false);
  for (const Side& side : sides) {
    if (side.other != kNone || waiting[side.leaf]) continue;
    waiting[side.leaf] = true;
    ring.push_back(side.leaf);
  }
  while (!ring.empty()) {  // a leaf enters once
    std::vector<double> values;
    for (const std::uint32_t l : ring)
      values.push_back(meanAcross(std::span(sides).subspan(begin[l], begin[l + 1] - begin[l])));
    for (std::size_t k = 0; k < ring.size(); ++k) leaves_[ring[k]].depth_m = values[k];
    std::vector<std::uint32_t> next;
    for (const std::uint32_t l : ring) {
      for (std::size_t i = begin[l]; i < begin[l + 1]; ++i) {
        const std::uint32_t other = sides[i].other;
        if (other == kNone || waiting[other]) continue;
        waiting[other] = true;
        next.push_back(other);
      }
    }
    all.insert(all.end(), ring.begin(), ring.end());
    ring = std::move(next);
  }
  if (all.empty()) return;
  std::ranges::sort(all);
  std::vector<std::uint32_t> number(leaves_.size(), kNone);
  for (std::size_t i = 0; i < all.size(); ++i) number[all[i]] = static_cast<std::uint32_t>(i);
  Membrane membrane;
  std::vector<double> values;
  for (const std::uint32_t l : all) {
    double fixed = 0.0, degree = 0.0;
    for (std::size_t i = begin[l]; i < begin[l + 1]; ++i) {
      const Side& side = sides[i];
      degree += side.weight;
      if (side.other != kNone) {
        membrane.neighbour.push_back(number[side.other]);
        membrane.weight.push_back(side.weight);
        continue;
      }
      fixed += side.weight * side.depth_m;
      membrane.low = std::min(membrane.low, side.depth_m);
      membrane.high = std::max(membrane.high, side.depth_m);
    }
    membrane.fixed.push_back(fixed);
    membrane.degree.push_back(degree);
    membrane.begin.push_back(membrane.neighbour.size());
    values.push_back(leaves_[l].depth_m);
  }
  settle(membrane, values, loop);
  for (std::size_t i = 0; i < all.size(); ++i) leaves_[all[i]].depth_m = values[i];
}

void DepthGaps::fillFromNearest(const std::vector<Side>& sides) {
  const std::vector<std::size_t> begin = beginsOf(sides);
  using Entry = std::tuple<double, std::uint32_t, double>;  // distance, leaf, depth
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto length = [](const Side& side) { return std::sqrt(squaredLength(side.step)); };
  for (const Side& side : sides)
    if (side.other == kNone) queue.emplace(length(side), side.leaf, side.depth_m);
  while (!queue.empty()) {  // a side enters once
    const auto [far, l, depth] = queue.top();
    queue.pop();
    if (!std::isnan(leaves_[l].depth_m)) continue;
    leaves_[l].depth_m = depth;
    for (std::size_t i = begin[l]; i < begin[l + 1]; ++i)
      if (sides[i].other != kNone && std::isnan(leaves_[sides[i].other].depth_m))
        queue.emplace(far + length(sides[i]), sides[i].other, depth);
  }
}

// The plane through a square's own depth that best fits the depths across its sides.
void DepthGaps::setGradients(const std::vector<Side>& sides) {
  for (std::size_t first = 0; first < sides.size();) {
    Leaf& leaf = leaves_[sides[first].leaf];
    double xx = 0.0, xy = 0.0, yy = 0.0, xd = 0.0, yd = 0.0;
    leaf.least_m = leaf.most_m = leaf.depth_m;
    std::size_t i = first;
    for (; i < sides.size() && sides[i].leaf == sides[first].leaf; ++i) {
      const double other = sides[i].other == kNone ? sides[i].depth_m : leaves_[sides[i].other].depth_m;
      const auto& [x, y] = sides[i].step;
      const double change = other - leaf.depth_m, weight = sides[i].weight / (x * x + y * y);
      if (std::isnan(change)) continue;
      leaf.least_m = std::min(leaf.least_m, other);
      leaf.most_m = std::max(leaf.most_m, other);
      xx += weight * x * x;
      xy += weight * x * y;
      yy += weight * y * y;
      xd += weight * x * change;
      yd += weight * y * change;
    }
    // Nothing is known across land: if all steps are in one direction, depths are constant across it.
    const double trace = xx + yy, determinant = xx * yy - xy * xy;
    if (trace > 0.0 && determinant > 1e-3 * trace * trace)
      leaf.gradient = {(yy * xd - xy * yd) / determinant, (xx * yd - xy * xd) / determinant};
    else if (trace > 0.0)
      leaf.gradient = {xd / trace, yd / trace};
    first = i;
  }
}

// Squares at a shore with little water take the mean of their neighbours.
void DepthGaps::fillDry(const std::vector<Side>& sides) {
  constexpr int kRounds = 2;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::pair<std::uint32_t, double>> found;
    for (std::size_t first = 0, i = 0; first < sides.size(); first = i) {
      const std::uint32_t leaf = sides[first].leaf;
      while (i < sides.size() && sides[i].leaf == leaf) ++i;
      if (!leaves_[leaf].dry || !std::isnan(leaves_[leaf].depth_m)) continue;
      const double mean = meanAcross(std::span(sides).subspan(first, i - first));
      if (!std::isnan(mean)) found.emplace_back(leaf, mean);
    }
    for (const auto& [leaf, depth] : found)
      leaves_[leaf].depth_m = leaves_[leaf].least_m = leaves_[leaf].most_m = depth;
  }
}

void DepthGaps::fill(const SizeField& known, const DomainMask& mask, const std::function<double(double)>& depth_of,
                     GapFill fill, const ItemLoop& loop) {
  fillParts(known, mask, depth_of, loop);
  measureWater(mask);
  std::vector<Side> all = sides(), met;
  fixSides(known, depth_of, all, loop);
  for (const Side& side : all)
    if (!leaves_[side.leaf].dry && (side.other == kNone || !leaves_[side.other].dry)) met.push_back(side);
  if (fill == GapFill::Nearest) {
    fillFromNearest(met);
    for (Leaf& leaf : leaves_) leaf.least_m = leaf.most_m = leaf.depth_m;
  } else {
    fillByMean(met, loop);
    setGradients(met);
  }
  fillDry(all);
  for (const Leaf& leaf : leaves_)
    if (!std::isnan(leaf.depth_m)) least_m_ = std::min(least_m_, leaf.least_m);
}

double DepthGaps::at(const Point& place) const {
  std::uint32_t number = 0;
  SizeBox box = root_;
  while (nodes_[number].kind == Kind::Below) {
    const unsigned c = (place.x >= box.centre.x ? 1U : 0U) + (place.y >= box.centre.y ? 2U : 0U);
    number = nodes_[number].next + c;
    box = childOf(box, c);
  }
  const Node& node = nodes_[number];
  if (node.kind != Kind::Part && node.kind != Kind::Gap) return std::numeric_limits<double>::quiet_NaN();
  return leaves_[node.next].at(place);
}

DepthGaps::Range DepthGaps::within(const SizeBox& box) const {
  Range range;
  const Point corner{box.half, box.half};
  forEachLeaf(box.centre - corner, box.centre + corner, [&](const Node& node, const SizeBox& of) {
    if (node.kind == Kind::Outside) return;
    range.all = range.all && node.kind == Kind::Gap;
    if (node.kind == Kind::Known) return;
    const Leaf& leaf = leaves_[node.next];
    if (std::isnan(leaf.depth_m)) {
      range.all = false;
      return;
    }
    // Depths are linear: the corners of the intersection bound them.
    const auto overlap = [](double a, double a_half, double b, double b_half) {
      return std::pair{std::max(a - a_half, b - b_half), std::min(a + a_half, b + b_half)};
    };
    const auto [x0, x1] = overlap(box.centre.x, box.half, of.centre.x, of.half);
    const auto [y0, y1] = overlap(box.centre.y, box.half, of.centre.y, of.half);
    for (const Point& p : {Point{x0, y0}, {x1, y0}, {x0, y1}, {x1, y1}}) {
      const double depth = leaf.at(p);
      range.least_m = std::min(range.least_m, depth);
      range.most_m = std::max(range.most_m, depth);
    }
  });
  return range;
}

}  // namespace coastmesh
