#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "core/metric.hpp"
#include "core/point.hpp"
#include "core/size_function.hpp"

namespace coastmesh {

// Where a point is inserted to remove a bad triangle.
enum class Algorithm {
  Circumcenter,  // Ruppert 1993: the triangle's circumcentre
  Offcenter,     // Üngör 2004: the circumcentre, or nearer to the shortest edge
  Optimal,       // Erten & Üngör 2007, Algorithm 1: the place in the petal furthest from every vertex
  Relocate,      // Erten & Üngör 2007, Algorithm 2: move a vertex if that suffices, otherwise as Optimal
};

// What the optimiser enforces besides the mean of the shapes.
enum class QualityGoal {
  Shape,    // neighbours' circumcentres at least as far apart as D-Flow FM's limit for small flow links
  Centred,  // no obtuse angles: circumcentres inside. `max_angle_deg` 90 makes refinement enforce it too
  Links,    // twice as far apart
};

// Every function that takes these options throws std::invalid_argument for values out of range.
struct RefineOptions {
  double min_angle_deg = 33.0;                                // degrees, 0 to 45
  double max_angle_deg = 180.0;                               // degrees, 60 to 180; 180: no bound
  double size_max = std::numeric_limits<double>::infinity();  // longest edge, plane units, above 0
  Algorithm algorithm = Algorithm::Relocate;
  std::uint64_t max_vertices = std::numeric_limits<std::uint64_t>::max();  // total number of vertices, input included
  // More vertices throw OutOfRoom. Each piece of a mesh may have this many, so the limit never changes the result.
  std::uint64_t most_in_memory = std::numeric_limits<std::uint64_t>::max();
  const SizeFunction* size = nullptr;  // requested edge lengths; must outlive the run; null if there are none
  // Plane units, 0 or more: no vertex is inserted closer to another. For coordinates that will be written with a
  // coarser resolution than the plane's, where rounding requires such a distance.
  double resolution = 0.0;
  QualityGoal goal = QualityGoal::Shape;
  Surface surface = {};     // represented by the plane: all lengths and angles are measured on it
  double least_edge = 0.0;  // 0 or more: the optimiser avoids shorter edges; used with `size`
  double size_scale = 1.0;  // above 0; factor on the requested lengths, for intermediate steps
};

// Throws std::invalid_argument, which names the option, for a value that is out of range or not a number.
void requireInRange(const RefineOptions& options);

// A triangle with an edge longer than this share of the requested length is refined: edges then have about that length.
inline constexpr double kLongestShare = 1.5;

// Thrown if a mesh grows beyond `most_in_memory` vertices; `place` is where it grew.
struct OutOfRoom : std::runtime_error {
  explicit OutOfRoom(const Point& where)
      : std::runtime_error("refinement takes more vertices than there is room for"), place(where) {}
  Point place;
};

// The bounds on a triangle that these options set; and those that a mesh must meet, which do not include requested
// lengths.
TriangleBound boundOf(const RefineOptions& options);
TriangleBound strictBoundOf(const RefineOptions& options);

// A triangle that misses the bounds without a corner of the input to excuse it.
struct BoundViolation {
  Point place;           // the triangle's centroid
  double min_angle_deg;  // its smallest angle
  double max_angle_deg;
};

struct RefineStats {
  std::uint64_t steiner_points = 0;        // output vertices minus input vertices
  std::array<std::uint64_t, 4> by_type{};  // points inserted as types I to IV of the paper, Section 3
  std::uint64_t segment_splits = 0;
  std::uint64_t relocations = 0;
  std::uint64_t removals = 0;  // vertices removed again, by coarsening or during a split
  std::uint64_t merges = 0;    // two vertices replaced by one
  std::uint64_t unmended = 0;  // places that repair could not improve
  bool budget_reached = false;
  std::vector<BoundViolation> unresolved;

  void add(const RefineStats& other);
};

}  // namespace coastmesh
