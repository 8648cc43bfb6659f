#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "apps/job/mesh_job_result.hpp"
#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Angles and edges of some triangles of a grid.
struct TriangleFigures {
  std::size_t triangles = 0;
  double min_angle_deg = 180.0;
  double shortest_m = std::numeric_limits<double>::infinity();  // in a plane: in its units
  double longest_m = 0.0;

  void add(const TriangleFigures& other);
};

using IsWanted = std::function<bool(std::size_t triangle)>;

// Figures of the triangles for which `isWanted(t)`.
TriangleFigures figuresOf(const Grid& grid, const ItemLoop& loop, const IsWanted& isWanted);

// Triangles of a grid by the places of their corners, which find them again after repairs have renumbered it.
class PlacedTriangles {
 public:
  // Those for which `isWanted(t)`.
  PlacedTriangles(const Grid& grid, const ItemLoop& loop, const IsWanted& isWanted);

  bool has(const Grid& grid, std::size_t triangle) const;

 private:
  std::vector<std::uint64_t> keys_;  // ascending
};

// Figures of triangles that are asked for later, when some of them may have been changed: of those that are left.
class LastingFigures {
 public:
  // `now`: those of the triangles for which `isWanted(t)`. The loop has to live as long.
  LastingFigures(const TriangleFigures& now, bool may_change, const Grid& grid, const ItemLoop& loop,
                 const IsWanted& isWanted);

  TriangleFigures in(const Grid& grid) const;

 private:
  TriangleFigures now_;
  std::reference_wrapper<const ItemLoop> loop_;
  std::shared_ptr<const PlacedTriangles> placed_;  // null if none may change
};

// Triangles that repairs have changed or added, without halves of quadrilaterals.
struct RepairedTriangles {
  TriangleFigures figures;
  std::size_t below = 0;        // that miss the bounds on angles
  BoundViolationPlace worst{};  // of them, that with the smallest angle
};

// Finds the triangles that repairs change.
class BeforeRepairs {
 public:
  // The grid that is to be repaired. Without `may_change` nothing is kept, and no triangle counts as repaired. The loop
  // has to live as long.
  BeforeRepairs(const Grid& grid, bool may_change, const ItemLoop& loop);

  // Those of the repaired grid. Bounds are in degrees; 0 and 180 are none.
  RepairedTriangles repairedIn(const Grid& grid, double min_angle_deg, double max_angle_deg) const;

 private:
  std::reference_wrapper<const ItemLoop> loop_;
  std::shared_ptr<const PlacedTriangles> placed_;
};

}  // namespace coastmesh
