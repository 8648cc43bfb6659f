#include "gis/rivers/river_pieces.hpp"

#include <algorithm>
#include <cmath>

#include "core/metric.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

namespace {

constexpr double kStep = 0.25;  // of a width, between places that are looked at
constexpr double kMostSteps = 1e6;

struct Sample {
  Point place;
  bool is_vertex = false;
  // In a wider river: the distance to its line, and half its width there.
  bool is_within = false;
  double gap = 0.0, half_width = 0.0;
};

// A line that comes this close to that of a wider river, as a share of half its width, meets it.
constexpr double kMeets = 0.1;
// It goes on to the place where it meets it, unless that is this far from the bank, in half widths.
constexpr double kFarthest = 2.0;

class PieceFinder {
 public:
  explicit PieceFinder(std::span<const PlaneRiver> rivers) : rivers_(rivers) {
    std::vector<Box> boxes;
    for (std::uint32_t line = 0; line < rivers.size(); ++line) {
      for (std::uint32_t i = 0; i + 1 < rivers[line].points.size(); ++i) {
        edges_.push_back({line, i, halfWidthOf(rivers[line], i)});
        widest_ = std::max(widest_, 2.0 * edges_.back().half_width);
        boxes.push_back(Box::of(rivers[line].points[i], rivers[line].points[i + 1]));
      }
    }
    tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
  }

  std::vector<RiverPiece> find() const {
    std::vector<RiverPiece> pieces;
    for (std::uint32_t line = 0; line < rivers_.size(); ++line) addPieces(line, samplesOf(line), pieces);
    return pieces;
  }

 private:
  struct Edge {
    std::uint32_t line = 0, number = 0;
    double half_width = 0.0;
  };

  static double halfWidthOf(const PlaneRiver& river, std::size_t edge) {
    return 0.5 * (river.widths.empty() ? river.width : 0.5 * (river.widths[edge] + river.widths[edge + 1]));
  }

  bool isWider(std::uint32_t a, std::uint32_t b) const {
    return rivers_[a].width > rivers_[b].width || (rivers_[a].width == rivers_[b].width && a < b);
  }

  // Looks for the wider river that has the sample closest to its line.
  void findWider(std::uint32_t line, Sample& sample) const {
    const Point& place = sample.place;
    tree_.visit(Box::of(place, place).grownBy(0.5 * widest_), [&](std::uint32_t e) {
      const auto& [other, i, half_width] = edges_[e];
      if (other == line || !isWider(other, line)) return;
      const std::vector<Point>& points = rivers_[other].points;
      const Point &a = points[i], &b = points[i + 1];
      const double gap = std::sqrt(squaredDistanceToSegment(place, a, b));
      if (gap > half_width || (sample.is_within && gap >= sample.gap)) return;
      const bool before_start = i == 0 && dot(place - a, b - a) <= 0.0;
      const bool beyond_end = i + 2 == points.size() && dot(place - b, a - b) <= 0.0;
      if (before_start || beyond_end) return;
      sample.is_within = true;
      sample.gap = gap, sample.half_width = half_width;
    });
  }

  std::vector<Sample> samplesOf(std::uint32_t line) const {
    const std::vector<Point>& points = rivers_[line].points;
    double length = 0.0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) length += distance(points[i], points[i + 1]);
    const double step = std::max(kStep * rivers_[line].width, length / kMostSteps);
    std::vector<Sample> samples;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const double count = std::max(1.0, std::ceil(distance(points[i], points[i + 1]) / step));
      for (double k = 0.0; k < count; ++k)
        samples.push_back({points[i] + (k / count) * (points[i + 1] - points[i]), k == 0.0});
    }
    samples.push_back({points.back(), true});
    for (Sample& sample : samples) findWider(line, sample);
    return samples;
  }

  // The sample at which a piece ends, of those from the first one within a wider river on: where the line meets that of
  // the wider one, else the first.
  static std::size_t endOf(const std::vector<Sample>& samples, std::size_t first, std::ptrdiff_t step) {
    double walked = 0.0;
    for (std::size_t i = first;;) {
      const Sample& here = samples[i];
      if (here.gap <= kMeets * here.half_width) return i;
      const bool is_last = step > 0 ? i + 1 == samples.size() : i == 0;
      if (is_last) return first;
      i += static_cast<std::size_t>(step);
      walked += distance(here.place, samples[i].place);
      if (!samples[i].is_within || samples[i].gap > here.gap || walked > kFarthest * samples[first].half_width)
        return first;
    }
  }

  void addPieces(std::uint32_t line, const std::vector<Sample>& samples, std::vector<RiverPiece>& pieces) const {
    for (std::size_t first = 0; first < samples.size(); ++first) {
      if (samples[first].is_within) continue;
      std::size_t last = first;
      while (last + 1 < samples.size() && !samples[last + 1].is_within) ++last;
      const std::size_t from = first > 0 ? endOf(samples, first - 1, -1) : first;
      const std::size_t to = last + 1 < samples.size() ? endOf(samples, last + 1, 1) : last;
      RiverPiece piece{{{}, rivers_[line].width}, line};
      for (std::size_t i = from; i <= to; ++i)
        if (const Sample& sample = samples[i];
            (sample.is_vertex || i == from || i == to) &&
            (piece.river.points.empty() || !(piece.river.points.back() == sample.place)))
          piece.river.points.push_back(sample.place);
      // A single place is where two lines meet.
      if (last > first && piece.river.points.size() > 1) pieces.push_back(std::move(piece));
      first = last;
    }
  }

  std::span<const PlaneRiver> rivers_;
  double widest_ = 0.0;
  std::vector<Edge> edges_;
  BoxTree tree_;
};

}  // namespace

std::vector<RiverPiece> piecesOf(std::span<const PlaneRiver> rivers) { return PieceFinder(rivers).find(); }

}  // namespace coastmesh
