#include "gis/size/size_distance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/hilbert.hpp"
#include "core/metric.hpp"
#include "core/size/on_surface.hpp"
#include "core/triangulate/label_regions.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Two numbers processed at once: compilers turn plain loops into scalar code with branches.
using Pair = double __attribute__((vector_size(16)));
constexpr Pair kNoPair = {0.0, 0.0}, kOnePair = {1.0, 1.0};

Pair pairOf(double number) { return Pair{number, number}; }
template <std::size_t kCount>
Pair pairAt(const std::array<double, kCount>& numbers, std::size_t k) {
  return Pair{numbers[k], numbers[k + 1]};
}
Pair greaterOf(const Pair& a, const Pair& b) { return a > b ? a : b; }
Pair lessOf(const Pair& a, const Pair& b) { return a < b ? a : b; }

}  // namespace

// Lengths are those of the plane; on a sphere, of chords.
struct DistanceField::Search {
  Point x;
  double shrink;     // at x
  double per_metre;  // metres per length on the surface at x
  double best;       // a size; if all lines are alike, a squared length
  std::uint32_t nearest = kNone;
};

DistanceField::DistanceField(std::vector<SizedLine> lines, std::function<double(const Point&)> scale, double most_m,
                             const Surface& surface)
    : most_m_(most_m), scale_(std::move(scale)), surface_(surface) {
  if (lines.empty()) return;
  std::vector<Point> middles;
  for (const SizedLine& line : lines) {
    middles.push_back(midpoint(line.a, line.b));
    most_rate_ = std::max(most_rate_, line.rate);
    least_size_m_ = std::min(least_size_m_, line.size_m);
    alike_ = alike_ && line.rate == lines.front().rate && line.size_m == lines.front().size_m;
  }
  struct Node {
    Box box;
    double size_m = kInfinity, rate = kInfinity;
  };
  std::vector<Node> nodes;
  const auto add = [&](std::size_t i, const Node& node) {
    if (i % kFanout == 0) nodes.emplace_back();
    nodes.back().box.add(node.box);
    nodes.back().size_m = std::min(nodes.back().size_m, node.size_m);
    nodes.back().rate = std::min(nodes.back().rate, node.rate);
  };
  for (const std::uint32_t i : hilbertOrder(middles)) {
    const SizedLine& line = lines[i];
    const Point along = line.b - line.a;
    const double square = squaredLength(along);
    add(count_, {Box::of(line.a, line.b), line.size_m, line.rate});
    const std::size_t k = count_++ % kFanout;
    if (k == 0) {
      Lines& none = lines_.emplace_back();
      for (auto* of : {&none.x, &none.y, &none.size_m}) of->fill(kInfinity);
    }
    Lines& all = lines_.back();
    all.x[k] = line.a.x, all.y[k] = line.a.y;
    all.along_x[k] = along.x, all.along_y[k] = along.y;
    all.inverse_square[k] = square > 0.0 ? 1.0 / square : 0.0;
    all.size_m[k] = line.size_m, all.rate[k] = line.rate;
  }
  do {
    level_begin_.push_back(groups_.size());
    const std::vector<Node> below = std::exchange(nodes, {});
    for (std::size_t i = 0; i < below.size(); ++i) {
      const std::size_t k = i % kFanout;
      if (k == 0) {
        Group& group = groups_.emplace_back();
        for (auto* of : {&group.xmin, &group.ymin, &group.size_m, &group.rate}) of->fill(kInfinity);
        for (auto* of : {&group.xmax, &group.ymax}) of->fill(-kInfinity);
        group.shrink.fill(1.0);
      }
      Group& group = groups_.back();
      group.xmin[k] = below[i].box.xmin, group.ymin[k] = below[i].box.ymin;
      group.xmax[k] = below[i].box.xmax, group.ymax[k] = below[i].box.ymax;
      group.size_m[k] = below[i].size_m, group.rate[k] = below[i].rate;
      const Box& box = below[i].box;
      group.shrink[k] = surface_.shrinkAt({std::max(-box.xmin, box.xmax), std::max(-box.ymin, box.ymax)});
      add(i, below[i]);
    }
  } while (nodes.size() > 1);
}

void DistanceField::limitRate(double rate) {
  most_rate_ = std::min(most_rate_, rate);
  for (Lines& lines : lines_)
    for (double& each : lines.rate) each = std::min(each, rate);
  for (Group& group : groups_)
    for (double& least : group.rate) least = std::min(least, rate);
}

// The squared chord from x to the place at parameter t of a line is n(t) / q(t) times the shrink at x. n is the squared
// length in the plane, q the inverse of the shrink at t; both are quadratic in t. The minimum on the whole line is at
// one of the two roots of the derivative; if that is beyond the ends, the minimum is at one of them.
double DistanceField::squaredChordTo(const Lines& lines, std::size_t i, const Search& search) const {
  const double k = surface_.curvature;
  const Point start{lines.x[i], lines.y[i]}, along{lines.along_x[i], lines.along_y[i]};
  const Point off = start - search.x;
  const double n0 = squaredLength(off), n1 = dot(off, along), n2 = squaredLength(along);
  const double q0 = 1.0 + k * squaredLength(start), q1 = k * dot(start, along), q2 = k * n2;
  const double a = n2 * q1 - n1 * q2, b = n2 * q0 - n0 * q2, c = n1 * q0 - n0 * q1;
  const double root = std::sqrt(std::max(b * b - 4.0 * a * c, 0.0));
  // The root where the derivative, a t² + b t + c, changes from negative to positive.
  const double share = b > 0.0 ? -2.0 * c / (b + root) : (root - b) / (2.0 * a);
  const auto at = [&](double t) { return squaredLength(off + t * along) / (q0 + t * (2.0 * q1 + t * q2)); };
  double least = std::min(at(0.0), at(1.0));
  if (share > 0.0 && share < 1.0) least = std::min(least, at(share));
  return least * search.shrink;
}

template <bool kAlike, bool kCurved>
void DistanceField::measure(std::uint32_t i, Search& search) const {
  const Lines& lines = lines_[i / kFanout];
  const std::size_t k = i % kFanout;
  double square;
  if constexpr (kCurved) {
    square = squaredChordTo(lines, k, search);
  } else {
    const Point to = search.x - Point{lines.x[k], lines.y[k]}, along{lines.along_x[k], lines.along_y[k]};
    const double share = std::min(std::max(dot(to, along) * lines.inverse_square[k], 0.0), 1.0);
    square = squaredLength(to - share * along);
  }
  take<kAlike, kCurved>(i, square, search);
}

template <bool kAlike, bool kCurved>
void DistanceField::take(std::uint32_t i, double square, Search& search) const {
  const Lines& lines = lines_[i / kFanout];
  const std::size_t k = i % kFanout;
  const auto metres = [&] {
    const double length = std::sqrt(square);
    return (kCurved ? arcOfChord(surface_, length) : length) * search.per_metre;
  };
  const double value = kAlike ? square : lines.size_m[k] + lines.rate[k] * metres();
  if (value < search.best) {
    search.best = value;
    search.nearest = i;
  }
}

// Measures the lines of a node of the lowest level.
template <bool kAlike, bool kCurved>
void DistanceField::measureAll(std::size_t node, Search& search) const {
  const std::size_t first = node * kFanout, count = std::min(count_ - first, kFanout);
  if constexpr (kCurved) {
    for (std::size_t k = 0; k < count; ++k) measure<kAlike, kCurved>(static_cast<std::uint32_t>(first + k), search);
    return;
  }
  // The same computation as in `measure`.
  const Lines& lines = lines_[node];
  const Pair x = pairOf(search.x.x), y = pairOf(search.x.y);
  std::array<double, kFanout> square;
  for (std::size_t k = 0; k < kFanout; k += 2) {
    const Pair to_x = x - pairAt(lines.x, k), to_y = y - pairAt(lines.y, k);
    const Pair along_x = pairAt(lines.along_x, k), along_y = pairAt(lines.along_y, k);
    const Pair way = (to_x * along_x + to_y * along_y) * pairAt(lines.inverse_square, k);
    const Pair share = lessOf(greaterOf(way, kNoPair), kOnePair);
    const Pair off_x = to_x - share * along_x, off_y = to_y - share * along_y;
    const Pair squares = off_x * off_x + off_y * off_y;
    square[k] = squares[0], square[k + 1] = squares[1];
  }
  for (std::size_t k = 0; k < count; ++k)
    take<kAlike, kCurved>(static_cast<std::uint32_t>(first + k), square[k], search);
}

template <bool kAlike, bool kCurved>
void DistanceField::descend(std::size_t level, std::size_t number, Search& search) const {
  const Group& group = groups_[level_begin_[level] + number];
  std::array<double, kFanout> off;
  const Pair x = pairOf(search.x.x), y = pairOf(search.x.y);
  for (std::size_t k = 0; k < kFanout; k += 2) {
    const Pair dx = greaterOf(greaterOf(pairAt(group.xmin, k) - x, x - pairAt(group.xmax, k)), kNoPair);
    const Pair dy = greaterOf(greaterOf(pairAt(group.ymin, k) - y, y - pairAt(group.ymax, k)), kNoPair);
    Pair squares = dx * dx + dy * dy;
    if constexpr (kCurved) squares *= pairOf(search.shrink) * pairAt(group.shrink, k);
    off[k] = squares[0], off[k + 1] = squares[1];
  }
  if constexpr (!kAlike)
    for (std::size_t k = 0; k < kFanout; ++k)
      off[k] = group.size_m[k] + group.rate[k] * std::sqrt(off[k]) * search.per_metre;
  // The most promising first; usually few are left.
  std::array<std::uint8_t, kFanout> order;
  std::size_t count = 0;
  for (std::size_t k = 0; k < kFanout; ++k) {
    if (!(off[k] < search.best)) continue;
    std::size_t at = count++;
    for (; at > 0 && off[k] < off[order[at - 1]]; --at) order[at] = order[at - 1];
    order[at] = static_cast<std::uint8_t>(k);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!(off[order[i]] < search.best)) return;
    const std::size_t node = number * kFanout + order[i];
    if (level > 0) {
      descend<kAlike, kCurved>(level - 1, node, search);
    } else {
      measureAll<kAlike, kCurved>(node, search);
    }
  }
}

double DistanceField::sizeAt(const Point& x, double scale, double most_m, std::uint32_t& nearest) const {
  if (lines_.empty()) return kInfinity;
  const bool curved = surface_.isCurved();
  const double shrink = surface_.shrinkAt(x), measure_here = scale * shrink;
  Search search{x, shrink, 1.0 / measure_here, most_m};
  const auto runOn = [&]<bool kAlike, bool kCurved>() {
    if (nearest != kNone) measure<kAlike, kCurved>(nearest, search);
    descend<kAlike, kCurved>(level_begin_.size() - 1, 0, search);
    if (search.nearest != kNone) nearest = search.nearest;
  };
  const auto run = [&]<bool kAlike>() {
    curved ? runOn.template operator()<kAlike, true>() : runOn.template operator()<kAlike, false>();
  };
  if (!alike_) {
    run.operator()<false>();
    return search.best;
  }
  const double size_m = lines_.front().size_m[0], rate = lines_.front().rate[0];
  if (!(most_m > size_m) || rate == 0.0) return std::min(most_m, size_m);
  const double reach = (most_m - size_m) / rate * measure_here;
  const double straight = chordOfArc(surface_, reach);
  const bool all_round = curved && reach >= std::numbers::pi * surface_.radius();
  search.best = all_round ? kInfinity : straight * straight;
  run.operator()<true>();
  return search.nearest == kNone ? most_m
                                 : size_m + rate * arcOfChord(surface_, std::sqrt(search.best)) * search.per_metre;
}

void DistanceField::sample(std::span<const Point> places, std::span<double> sizes) const {
  std::uint32_t nearest = kNone;
  for (std::size_t i = 0; i < places.size(); ++i) sizes[i] = sizeAt(places[i], scale_(places[i]), most_m_, nearest);
}

void DistanceField::bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const {
  std::uint32_t nearest = kNone;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const double scale = scale_(boxes[i].centre);
    // The largest change of the size within the box: its reach in metres times the rate.
    const double shrinks = shrinkIn(surface_, boxes[i]).high / surface_.shrinkAt(boxes[i].centre);
    const double reach = most_rate_ * std::sqrt(2.0) * boxes[i].half / scale * shrinks * 1.01;
    const double size = sizeAt(boxes[i].centre, scale, most_m_ + reach, nearest);
    ranges[i] = {std::max(least_size_m_, size - reach), size + reach, std::min(size, most_m_)};
  }
}

namespace {

// Twice the largest size.
double peakOf(const std::vector<SizedLine>& lines) {
  double most = 0.0;
  for (const SizedLine& line : lines) most = std::max(most, line.size_m);
  return 2.0 * most;
}

std::vector<SizedLine> upsideDown(std::vector<SizedLine> lines, double peak) {
  for (SizedLine& line : lines) line.size_m = peak - line.size_m;
  return lines;
}

}  // namespace

FallingField::FallingField(const std::vector<SizedLine>& lines, std::function<double(const Point&)> scale,
                           const Surface& surface)
    : peak_(peakOf(lines)), rising_(upsideDown(lines, peak_), std::move(scale), peak_, surface) {}

void FallingField::sample(std::span<const Point> places, std::span<double> sizes) const {
  rising_.sample(places, sizes);
  for (double& size : sizes) size = std::max(0.0, peak_ - size);
}

void FallingField::bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const {
  rising_.bound(boxes, ranges);
  for (SizeRange& range : ranges)
    range = {std::max(0.0, peak_ - range.high), std::max(0.0, peak_ - range.low),
             std::max(0.0, peak_ - range.at_centre), true};
}

std::vector<SizedLine> shoreLines(const Pslg& pslg, double size_m, double rate) {
  const bool labelled = hasRegions(pslg);
  std::vector<SizedLine> lines;
  for (const Segment& s : pslg.segments)
    if (!labelled || (!isOpenTag(s.tag) && isBoundary(s) && s.divide == Divide::Freely))
      lines.push_back({pslg.points[s.a], pslg.points[s.b], size_m, rate});
  return lines;
}

}  // namespace coastmesh
