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

// Where the point goes that mends a bad triangle.
enum class Algorithm {
  Circumcenter,  // Ruppert 1993: the triangle's circumcentre
  Offcenter,     // Üngör 2004: the circumcentre, or nearer to the shortest edge
  Optimal,       // Erten & Üngör 2007, Algorithm 1: the place in the petal furthest from every vertex
  Relocate,      // Erten & Üngör 2007, Algorithm 2: move a vertex where that is enough, else as Optimal
};

// What the optimiser holds above the mean of the shapes.
enum class QualityGoal {
  Shape,    // neighbours' circumcentres no nearer than D-Flow FM's small flow links are
  Centred,  // no obtuse angles: circumcentres lie within. `max_angle_deg` 90 besides makes refinement hold that
  Links,    // twice as far apart
};

// Ranges hold in every function that takes these options; what lies beyond them throws std::invalid_argument.
struct RefineOptions {
  double min_angle_deg = 33.0;                                // degrees, 0 to 45
  double max_angle_deg = 180.0;                               // degrees, 60 to 180; 180 sets no bound
  double size_max = std::numeric_limits<double>::infinity();  // longest edge, plane units, above 0
  Algorithm algorithm = Algorithm::Relocate;
  std::uint64_t max_vertices = std::numeric_limits<std::uint64_t>::max();  // vertices in all, input included
  // What takes more vertices throws OutOfRoom. Each piece of a mesh may have so many: it never changes what is made.
  std::uint64_t most_in_memory = std::numeric_limits<std::uint64_t>::max();
  const SizeFunction* size = nullptr;  // lengths that edges should have; outlives the run; null where none are wanted
  // Plane units, 0 or more: no vertex is put nearer to another. For coordinates that will be written coarser than the
  // plane's own, whose rounding sets such a distance in any case.
  double resolution = 0.0;
  QualityGoal goal = QualityGoal::Shape;
  Surface surface = {};     // that the plane stands for: all lengths and angles are on it
  double size_scale = 1.0;  // above 0; wanted are these times so much: a step on the way
};

// Throws std::invalid_argument, which names the option, where one is beyond its range or no number.
void requireInRange(const RefineOptions& options);

// A triangle with an edge longer than this share of the length wanted there is refined: edges then come out about as
// wanted.
inline constexpr double kLongestShare = 1.5;

// A mesh that grows beyond `most_in_memory` vertices, and where it grew.
struct OutOfRoom : std::runtime_error {
  explicit OutOfRoom(const Point& where)
      : std::runtime_error("refinement takes more vertices than there is room for"), place(where) {}
  Point place;
};

// What these options ask of a triangle; and what of that a mesh may not fall short of, which wanted lengths are no part
// of.
TriangleBound boundOf(const RefineOptions& options);
TriangleBound strictBoundOf(const RefineOptions& options);

// A triangle that falls short of what was asked, with no corner of the input to excuse it.
struct BoundViolation {
  Point place;           // the triangle's centroid
  double min_angle_deg;  // its smallest angle
  double max_angle_deg;
};

struct RefineStats {
  std::uint64_t steiner_points = 0;        // vertices out minus vertices in
  std::array<std::uint64_t, 4> by_type{};  // points inserted as types I to IV of the paper, Section 3
  std::uint64_t segment_splits = 0;
  std::uint64_t relocations = 0;
  std::uint64_t removals = 0;  // vertices taken out again, by coarsening or on the way of a split
  std::uint64_t merges = 0;    // two vertices replaced by one
  std::uint64_t unmended = 0;  // places that repair found no way to mend
  bool budget_reached = false;
  std::vector<BoundViolation> unresolved;

  void add(const RefineStats& other);
};

}  // namespace coastmesh
