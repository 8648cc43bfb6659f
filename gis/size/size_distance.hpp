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

// A straight line of the plane (or a point: both ends the same) with the size wanted on it and how fast that grows with
// the distance.
struct SizedLine {
  Point a, b;
  double size_m = 0.0;  // metres, above 0
  double rate = 0.0;    // 0 or more
};

// size + rate * distance, the least over all lines. A packed tree whose nodes know the least size and rate below them;
// what was nearest to one place is where the search for the next one starts. On a sphere distances are those of arcs,
// and chords are compared: the square of one is that of the plane's length times the shrink at both ends, of which a
// node knows the least.
class DistanceField final : public SizeField {
 public:
  // `scale` is plane length over metres at a place; `surface` is what the plane stands for. Sizes above `most_m` are
  // not told apart: to find the nearest line from far off is what takes time.
  DistanceField(std::vector<SizedLine> lines, std::function<double(const Point&)> scale,
                double most_m = std::numeric_limits<double>::infinity(), const Surface& surface = {});

  void sample(std::span<const Point> places, std::span<double> sizes) const override;
  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override;
  double least() const override { return least_size_m_; }
  void limitRate(double rate) override;
  bool isGraded() const override { return true; }

 private:
  static constexpr std::size_t kFanout = 8;
  // So many lines: their first ends, what leads on to the others, the inverse squares of their lengths (0 for points).
  // Those that are not there have ends infinitely far away.
  struct Lines {
    std::array<double, kFanout> x, y, along_x, along_y, inverse_square, size_m, rate;
  };
  // The boxes of so many nodes of the level below; those that are not there lie infinitely far away.
  struct Group {
    std::array<double, kFanout> xmin, ymin, xmax, ymax, size_m, rate;
    std::array<double, kFanout> shrink;  // the least
  };
  struct Search;

  // `most_m`: what is no less need not be found. `nearest`: the line found, where there is one; before, one to begin
  // with.
  double sizeAt(const Point& x, double scale, double most_m, std::uint32_t& nearest) const;
  template <bool kAlike, bool kCurved>
  void measure(std::uint32_t line, Search& search) const;
  // With the square of its distance.
  template <bool kAlike, bool kCurved>
  void take(std::uint32_t line, double square, Search& search) const;
  template <bool kAlike, bool kCurved>
  void measureAll(std::size_t node, Search& search) const;
  template <bool kAlike, bool kCurved>
  void descend(std::size_t level, std::size_t group, Search& search) const;
  double squaredChordTo(const Lines& lines, std::size_t k, const Search& search) const;

  std::size_t count_ = 0;      // of lines
  std::vector<Lines> lines_;   // along Hilbert's curve
  std::vector<Group> groups_;  // level after level; of the first level's the nodes are `kFanout` lines in a row
  std::vector<std::size_t> level_begin_;
  bool alike_ = true;  // all lines have the same size and rate: squares of distances do
  double most_rate_ = 0.0, least_size_m_ = std::numeric_limits<double>::infinity();
  double most_m_;
  std::function<double(const Point&)> scale_;
  Surface surface_;
};

// The shore of a domain: the segments with land on one side.
std::vector<SizedLine> shoreLines(const Pslg& pslg, double size_m, double rate);

}  // namespace coastmesh
