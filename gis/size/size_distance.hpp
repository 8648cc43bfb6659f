#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "core/ids.hpp"
#include "core/pslg.hpp"
#include "core/surface.hpp"
#include "gis/size/size_field.hpp"

namespace coastmesh {

// A straight line of the plane (or a point: both ends the same) with the size on it and the rate at which that grows
// with distance.
struct SizedLine {
  Point a, b;
  double size_m = 0.0;  // metres, above 0
  double rate = 0.0;    // 0 or more
};

// The minimum of size + rate * distance over all lines. A packed tree whose nodes have the smallest size and rate below
// them; the search for a place starts with the line nearest to the place before it. On a sphere distances are those of
// arcs, and their chords are compared: a squared chord is the squared length in the plane times the shrink at both
// ends, of which a node has the smallest.
class DistanceField final : public SizeField {
 public:
  // `scale` is plane length over metres at a place; the plane represents `surface`. Larger sizes than `most_m` are
  // given as `most_m`, because finding the nearest line from far away takes most of the time.
  DistanceField(std::vector<SizedLine> lines, std::function<double(const Point&)> scale,
                double most_m = std::numeric_limits<double>::infinity(), const Surface& surface = {});

  void sample(std::span<const Point> places, std::span<double> sizes) const override;
  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override;
  double least() const override { return least_size_m_; }
  void limitRate(double rate) override;
  bool isGraded() const override { return true; }

 private:
  static constexpr std::size_t kFanout = 8;
  // `kFanout` lines: first ends, vectors to the second ends, inverse squared lengths (0 for points). Unused entries
  // have ends infinitely far away.
  struct Lines {
    std::array<double, kFanout> x, y, along_x, along_y, inverse_square, size_m, rate;
  };
  // The boxes of `kFanout` nodes of the level below; unused entries are infinitely far away.
  struct Group {
    std::array<double, kFanout> xmin, ymin, xmax, ymax, size_m, rate;
    std::array<double, kFanout> shrink;  // the smallest in the box
  };
  struct Search;

  // Sizes of `most_m` or more need not be found. `nearest`: before, a line to begin with, or kNone; afterwards, the
  // line found, if any.
  double sizeAt(const Point& x, double scale, double most_m, std::uint32_t& nearest) const;
  template <bool kAlike, bool kCurved>
  void measure(std::uint32_t line, Search& search) const;
  // Keeps the line if it is better than the best so far; `square` is its squared distance.
  template <bool kAlike, bool kCurved>
  void take(std::uint32_t line, double square, Search& search) const;
  template <bool kAlike, bool kCurved>
  void measureAll(std::size_t node, Search& search) const;
  template <bool kAlike, bool kCurved>
  void descend(std::size_t level, std::size_t group, Search& search) const;
  double squaredChordTo(const Lines& lines, std::size_t k, const Search& search) const;

  std::size_t count_ = 0;      // of lines
  std::vector<Lines> lines_;   // along a Hilbert curve
  std::vector<Group> groups_;  // level by level; a node of the first level is `kFanout` consecutive lines
  std::vector<std::size_t> level_begin_;
  bool alike_ = true;  // all lines have the same size and rate: comparing squared distances suffices
  double most_rate_ = 0.0, least_size_m_ = std::numeric_limits<double>::infinity();
  double most_m_;
  std::function<double(const Point&)> scale_;
  Surface surface_;
};

// The maximum of size - rate * distance over all lines, and 0: a lower bound for sizes near lines whose elements stay.
class FallingField final : public SizeField {
 public:
  // As above. REQUIRES: at least one line.
  FallingField(const std::vector<SizedLine>& lines, std::function<double(const Point&)> scale,
               const Surface& surface = {});

  void sample(std::span<const Point> places, std::span<double> sizes) const override;
  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override;
  void limitRate(double rate) override { rising_.limitRate(rate); }
  bool isGraded() const override { return true; }

 private:
  double peak_;           // above all sizes
  DistanceField rising_;  // the same upside down: the minimum of (peak - size) + rate * distance
};

// The shore of a domain: the segments with land on one side that are not open and may be divided; all segments if none
// is labelled.
std::vector<SizedLine> shoreLines(const Pslg& pslg, double size_m, double rate);

}  // namespace coastmesh
