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
  bool is_within = false;
};

class PieceFinder {
 public:
  explicit PieceFinder(std::span<const PlaneRiver> rivers) : rivers_(rivers) {
    std::vector<Box> boxes;
    for (std::uint32_t line = 0; line < rivers.size(); ++line) {
      widest_ = std::max(widest_, rivers[line].width);
      for (std::uint32_t i = 0; i + 1 < rivers[line].points.size(); ++i) {
        edges_.push_back({line, i});
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
  };

  bool isWider(std::uint32_t a, std::uint32_t b) const {
    return rivers_[a].width > rivers_[b].width || (rivers_[a].width == rivers_[b].width && a < b);
  }

  bool isWithinWider(std::uint32_t line, const Point& place) const {
    bool is_within = false;
    tree_.visit(Box::of(place, place).grownBy(0.5 * widest_), [&](std::uint32_t e) {
      const auto& [other, i] = edges_[e];
      if (is_within || other == line || !isWider(other, line)) return;
      const std::vector<Point>& points = rivers_[other].points;
      const Point &a = points[i], &b = points[i + 1];
      if (squaredDistanceToSegment(place, a, b) > 0.25 * rivers_[other].width * rivers_[other].width) return;
      const bool before_start = i == 0 && dot(place - a, b - a) <= 0.0;
      const bool beyond_end = i + 2 == points.size() && dot(place - b, a - b) <= 0.0;
      is_within = !before_start && !beyond_end;
    });
    return is_within;
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
    for (Sample& sample : samples) sample.is_within = isWithinWider(line, sample.place);
    return samples;
  }

  void addPieces(std::uint32_t line, const std::vector<Sample>& samples, std::vector<RiverPiece>& pieces) const {
    for (std::size_t first = 0; first < samples.size(); ++first) {
      if (samples[first].is_within) continue;
      std::size_t last = first;
      while (last + 1 < samples.size() && !samples[last + 1].is_within) ++last;
      const std::size_t from = first > 0 ? first - 1 : first, to = std::min(last + 1, samples.size() - 1);
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
