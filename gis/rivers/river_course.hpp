#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/point.hpp"
#include "gis/rivers/river_network.hpp"
#include "gis/rivers/river_widths.hpp"

namespace coastmesh {

// A place along a river, with what crosses it there.
struct RiverSection {
  Point place;
  Point left;          // unit vector across the river, to the left of its direction
  double width = 0.0;  // plane units
  std::uint32_t line = 0;
  double bend = 0.0;   // radius of the bend, infinite if it is straight
  double along = 0.0;  // distance from the start of the reach
  double room = 0.0;   // the longest row beside other water

  // A place across the river: 0 at the right bank, 1 at the left one.
  Point at(double share) const {
    const double offset = (share - 0.5) * width;
    return {place.x + offset * left.x, place.y + offset * left.y};
  }
  // The same as seen against the direction.
  RiverSection turned() const {
    RiverSection section = *this;
    section.left = {-left.x, -left.y};
    return section;
  }
};

// The course of a reach: its centre line without turns that are too sharp for its width, and widths without jumps.
class RiverCourse {
 public:
  RiverCourse(const RiverReach& reach, const RiverWidths& widths);

  double length() const { return along_.back(); }
  double meanWidth() const { return mean_width_; }
  double maxWidth() const { return max_width_; }
  // How far the centre line was moved at most, where it turned too sharply.
  double moved() const { return moved_; }
  const Point& movedPlace() const { return moved_place_; }
  // The section at a distance from the start, from 0 to `length()`.
  RiverSection sectionAt(double along) const;
  // Points along it, about a quarter of the width apart.
  std::span<const Point> points() const { return points_; }
  double widthAt(std::size_t point) const { return width_[point]; }
  double alongAt(std::size_t point) const { return along_[point]; }
  // Sets the longest row at each of these points; it grows by at most half the distance from one to another.
  void limitRows(std::vector<double> room);
  // Multiplies widths between two places by `factor`, below 1, and more gradually those around.
  void narrow(double from, double to, double factor);

 private:
  void limitWidening();
  void sample(const RiverReach& reach, const RiverWidths& widths);
  void smooth();
  void measure();
  double radiusAt(std::size_t i) const;
  Point placeAt(double along) const;
  std::size_t indexAt(double along) const;

  std::vector<Point> points_;
  std::vector<double> along_;  // distance from the start, for each point
  std::vector<double> width_;
  std::vector<double> slope_;  // how fast the width may change from each point to the next
  std::vector<double> room_;   // empty: no limit
  std::vector<std::uint32_t> line_;
  double mean_width_ = 0.0, max_width_ = 0.0, moved_ = 0.0;
  Point moved_place_;
};

}  // namespace coastmesh
