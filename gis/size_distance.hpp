#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "core/pslg.hpp"
#include "gis/box.hpp"
#include "gis/size_field.hpp"

namespace coastmesh {

// A straight line of the plane (or a point: both ends the same) with the size wanted on it and how fast that grows with the distance.
struct SizedLine {
  Point a, b;
  double size_m = 0.0;  // metres, above 0
  double rate = 0.0;    // 0 or more
};

// size + rate * distance, the least over all lines. A packed tree whose nodes know the least size and rate below them.
class DistanceField final : public SizeField {
 public:
  // `scale` is plane length over metres at a place. Sizes above `most_m` are not told apart: to find the nearest line from
  // far off is what takes time.
  DistanceField(std::vector<SizedLine> lines, std::function<double(const Point&)> scale,
                double most_m = std::numeric_limits<double>::infinity());

  void sample(std::span<const Point> places, std::span<double> sizes) const override;
  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override;

 private:
  static constexpr std::size_t kFanout = 8;
  struct Node {
    Box box;
    double size_m, rate;
  };

  // `start`: an upper bound; what is no less need not be found.
  double sizeAt(const Point& x, double scale, double start) const;
  // At most so much at `x`, where it is `size` at `from`.
  double startFrom(double size, const Point& from, const Point& x, double scale) const;
  void descend(std::size_t level, std::size_t node, const Point& x, double scale, double& best) const;

  std::vector<SizedLine> lines_;  // along Hilbert's curve
  std::vector<Node> nodes_;       // level after level, the lines' own first
  std::vector<std::size_t> level_begin_;
  double most_rate_ = 0.0;
  double most_m_;
  std::function<double(const Point&)> scale_;
};

// The shore of a domain: the segments with land on one side.
std::vector<SizedLine> shoreLines(const Pslg& pslg, double size_m, double rate);

}  // namespace coastmesh
