#pragma once

namespace coastmesh {

// A place in the parameter plane, or a pair of longitude and latitude where a name says so.
struct Point {
  double x = 0.0;
  double y = 0.0;

  friend bool operator==(const Point&, const Point&) = default;
};

// The order that breaks ties: by x, then y.
inline bool lexLess(const Point& a, const Point& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

}  // namespace coastmesh
