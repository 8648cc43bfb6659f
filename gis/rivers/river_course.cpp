#include "gis/rivers/river_course.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/metric.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Points are this share of the width apart.
constexpr double kStep = 0.25;
// Bends are measured over this many points before and after.
constexpr std::size_t kArm = 2;
// The least radius of the centre line in a bend, as a share of the width: the inner bank turns at half the width less.
constexpr double kLeastBend = 0.8;
constexpr int kMostSweeps = 4000;
// How fast the longest row grows along the river.
constexpr double kRowGrowth = 0.5;
constexpr std::size_t kMostPoints = 4'000'000;

double radiusThrough(const Point& a, const Point& b, const Point& c) {
  const double twice_area = std::abs(cross(b - a, c - a));
  if (dot(b - a, c - b) < 0.0) return 0.0;  // it turns back
  const double sides = distance(a, b) * distance(b, c) * distance(c, a);
  return twice_area > 0.0 ? sides / (2.0 * twice_area) : kInfinity;
}

}  // namespace

RiverCourse::RiverCourse(const RiverReach& reach, const RiverWidths& widths) {
  sample(reach, widths);
  smooth();
  measure();
}

void RiverCourse::sample(const RiverReach& reach, const RiverWidths& widths) {
  double length = 0.0, least = kInfinity;
  for (std::size_t i = 0; i + 1 < reach.points.size(); ++i) {
    length += distance(reach.points[i], reach.points[i + 1]);
    least = std::min(least, widths.usualOf(reach.line_of[i]));
  }
  const double wanted = std::ceil(length / (kStep * least));
  const auto count = static_cast<std::size_t>(std::clamp(wanted, 4.0, static_cast<double>(kMostPoints)));
  const double step = length / static_cast<double>(count);
  std::size_t edge = 0;
  double before = 0.0;  // length of the edges before it
  for (std::size_t i = 0; i <= count; ++i) {
    const double along = i == count ? length : static_cast<double>(i) * step;
    double edge_length = distance(reach.points[edge], reach.points[edge + 1]);
    while (before + edge_length < along && edge + 2 < reach.points.size()) {
      before += edge_length;
      ++edge;
      edge_length = distance(reach.points[edge], reach.points[edge + 1]);
    }
    const double share = std::clamp((along - before) / edge_length, 0.0, 1.0);
    points_.push_back(reach.points[edge] + share * (reach.points[edge + 1] - reach.points[edge]));
    line_.push_back(reach.line_of[edge]);
    width_.push_back(widths.at(line_.back(), points_.back()));
    slope_.push_back(widths.slopeOf(line_.back()));
  }
  points_.front() = reach.points.front();
  points_.back() = reach.points.back();
}

double RiverCourse::radiusAt(std::size_t i) const {
  const std::size_t arm = std::min({kArm, i, points_.size() - 1 - i});
  return arm == 0 ? kInfinity : radiusThrough(points_[i - arm], points_[i], points_[i + arm]);
}

// Points near turns that are too sharp move towards the middle of their neighbours. The ends stay.
void RiverCourse::smooth() {
  const std::vector<Point> given = points_;
  const std::size_t n = points_.size();
  std::vector<std::uint8_t> moves(n);
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    std::ranges::fill(moves, 0);
    bool any = false;
    for (std::size_t i = 1; i + 1 < n; ++i) {
      if (radiusAt(i) >= kLeastBend * width_[i]) continue;
      any = true;
      for (std::size_t k = std::max<std::size_t>(i, 2 * kArm + 1) - 2 * kArm; k < std::min(n - 1, i + 2 * kArm + 1);
           ++k)
        moves[k] = 1;
    }
    if (!any) break;
    Point before = points_[0];
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const Point here = points_[i];
      if (moves[i] != 0) points_[i] = here + 0.5 * (midpoint(before, points_[i + 1]) - here);
      before = here;
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double moved = distance(points_[i], given[i]);
    if (moved <= moved_) continue;
    moved_ = moved;
    moved_place_ = given[i];
  }
}

void RiverCourse::measure() {
  along_.assign(1, 0.0);
  for (std::size_t i = 0; i + 1 < points_.size(); ++i)
    along_.push_back(along_.back() + distance(points_[i], points_[i + 1]));
  limitWidening();
}

void RiverCourse::narrow(double from, double to, double factor) {
  for (std::size_t i = indexAt(from); i < points_.size() && along_[i] <= to; ++i) width_[i] *= factor;
  limitWidening();
}

void RiverCourse::limitRows(std::vector<double> room) {
  room_ = std::move(room);
  const auto growth = [&](std::size_t i) { return kRowGrowth * (along_[i + 1] - along_[i]); };
  for (std::size_t i = 0; i + 1 < room_.size(); ++i) room_[i + 1] = std::min(room_[i + 1], room_[i] + growth(i));
  for (std::size_t i = room_.size() - 1; i-- > 0;) room_[i] = std::min(room_[i], room_[i + 1] + growth(i));
}

void RiverCourse::limitWidening() {
  const auto room = [&](std::size_t i) { return slope_[i] * (along_[i + 1] - along_[i]); };
  for (std::size_t i = 0; i + 1 < width_.size(); ++i) width_[i + 1] = std::min(width_[i + 1], width_[i] + room(i));
  for (std::size_t i = width_.size() - 1; i-- > 0;) width_[i] = std::min(width_[i], width_[i + 1] + room(i));
  double sum = 0.0;
  for (const double width : width_) sum += width;
  mean_width_ = sum / static_cast<double>(width_.size());
  max_width_ = std::ranges::max(width_);
}

std::size_t RiverCourse::indexAt(double along) const {
  const auto after = std::ranges::upper_bound(along_, along);
  const auto i = static_cast<std::size_t>(after - along_.begin());
  return std::clamp<std::size_t>(i, 1, points_.size() - 1) - 1;
}

Point RiverCourse::placeAt(double along) const {
  const std::size_t i = indexAt(along);
  const double edge = along_[i + 1] - along_[i];
  const double share = edge > 0.0 ? std::clamp((along - along_[i]) / edge, 0.0, 1.0) : 0.0;
  return points_[i] + share * (points_[i + 1] - points_[i]);
}

RiverSection RiverCourse::sectionAt(double along) const {
  const std::size_t i = indexAt(along);
  const double edge = along_[i + 1] - along_[i];
  const double share = edge > 0.0 ? std::clamp((along - along_[i]) / edge, 0.0, 1.0) : 0.0;
  RiverSection section;
  section.along = along;
  section.place = placeAt(along);
  section.width = width_[i] + share * (width_[i + 1] - width_[i]);
  section.room = room_.empty() ? kInfinity : std::min(room_[i], room_[i + 1]);
  section.line = line_[share < 0.5 ? i : i + 1];
  section.bend = std::min(radiusAt(i), radiusAt(i + 1));
  const double arm = 0.5 * section.width;
  const Point forward = placeAt(std::min(along + arm, length())) - placeAt(std::max(along - arm, 0.0));
  const double norm = std::sqrt(squaredLength(forward));
  if (norm > 0.0) section.left = {-forward.y / norm, forward.x / norm};
  return section;
}

}  // namespace coastmesh
