#include "gis/rivers/river_room.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

namespace {

// Parts of one course are remote if they are so many widths apart along it.
constexpr double kRemote = 3.0;

struct Piece {  // between two points of a course
  std::uint32_t course = 0;
  std::size_t point = 0;
};

class RoomFinder {
 public:
  RoomFinder(std::span<const RiverCourse> courses, std::span<const double> longest,
             std::vector<std::pair<Point, Point>> shores)
      : courses_(courses), longest_(longest), shores_(std::move(shores)) {
    std::vector<Box> boxes;
    for (const auto& [a, b] : shores_) boxes.push_back(Box::of(a, b));
    shore_tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
    boxes.clear();
    for (std::uint32_t c = 0; c < courses.size(); ++c) {
      widest_ = std::max(widest_, courses[c].maxWidth());
      const std::span<const Point> points = courses[c].points();
      for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        pieces_.push_back({c, i});
        boxes.push_back(Box::of(points[i], points[i + 1]));
      }
    }
    tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
  }

  double roomAt(std::uint32_t of_course, std::size_t i) const {
    const RiverCourse& own = courses_[of_course];
    const Point& place = own.points()[i];
    const double half = 0.5 * own.widthAt(i);
    double room = longest_[of_course];
    tree_.visit(Box::of(place, place).grownBy(room + half + 0.5 * widest_), [&](std::uint32_t p) {
      const auto& [c, k] = pieces_[p];
      const RiverCourse& other = courses_[c];
      if (c == of_course && std::abs(own.alongAt(i) - own.alongAt(k)) < kRemote * own.widthAt(i)) return;
      const double gap = std::sqrt(squaredDistanceToSegment(place, other.points()[k], other.points()[k + 1]));
      room = std::min(room, gap - half - 0.5 * std::max(other.widthAt(k), other.widthAt(k + 1)));
    });
    shore_tree_.visit(Box::of(place, place).grownBy(room + half), [&](std::uint32_t s) {
      const double gap = gapTo(shores_[s], place) - half;
      if (gap > 0.0) room = std::min(room, gap);
    });
    return std::max(0.0, room);
  }

  // At a mouth: the length of the shortest edge of the shore that passes the river there.
  double roomAtShore(std::uint32_t of_course, std::size_t i) const {
    const RiverCourse& own = courses_[of_course];
    const Point& place = own.points()[i];
    const double half = 0.5 * own.widthAt(i);
    double room = std::numeric_limits<double>::infinity();
    shore_tree_.visit(Box::of(place, place).grownBy(half), [&](std::uint32_t s) {
      if (gapTo(shores_[s], place) <= half) room = std::min(room, distance(shores_[s].first, shores_[s].second));
    });
    return room;
  }

 private:
  static double gapTo(const std::pair<Point, Point>& shore, const Point& place) {
    return std::sqrt(squaredDistanceToSegment(place, shore.first, shore.second));
  }

  std::span<const RiverCourse> courses_;
  std::span<const double> longest_;
  double widest_ = 0.0;
  std::vector<Piece> pieces_;
  BoxTree tree_;
  std::vector<std::pair<Point, Point>> shores_;
  BoxTree shore_tree_;
};

}  // namespace

void limitRows(std::span<RiverCourse> courses, std::span<const double> longest, const MeshWater& water, bool in_water) {
  const RoomFinder finder(courses, longest, water.shores());
  for (std::uint32_t c = 0; c < courses.size(); ++c) {
    const std::span<const Point> points = courses[c].points();
    std::vector<double> room;
    for (std::size_t i = 0; i < points.size(); ++i) {
      room.push_back(finder.roomAtShore(c, i));
      if (in_water && water.holds(points[i])) room.back() = std::min(room.back(), finder.roomAt(c, i));
    }
    courses[c].limitRows(std::move(room));
  }
}

}  // namespace coastmesh
