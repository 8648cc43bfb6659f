#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/input/job_input.hpp"
#include "core/refine/check.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// A defect of a grid from a file.
struct GridDefect {
  DefectKind kind;
  Point place;                 // in the grid's CRS
  std::int64_t triangle = -1;  // the grid's, -1 if none
  double value = 0.0;          // as in MeshDefect
};

struct GridCheckOptions {
  double min_angle_deg = 0.0;    // degrees; 0: no bound
  double max_angle_deg = 180.0;  // degrees; 180: no bound
  SurfaceChoice surface{};       // used without an input; otherwise the input's applies
  bool delaunay = false;
  bool pinches = false;
};

// The surface on which a grid from a file is measured. Throws OptionError if the grid has no place on it.
SurfaceKind surfaceFor(const Grid& grid, const SurfaceChoice& choice);

struct GridCheck {
  std::vector<GridDefect> defects;
  // Triangles that miss the bounds on angles, including those excused by input angles, which are not defects.
  BoundCounts bounds;
};

// Every defect of the grid, each connected piece in its own plane; a border between features counts as a constraint.
GridCheck checkGrid(const Grid& grid, const GridCheckOptions& options, const ItemLoop& loop = inOrder);

// The same against the grid's input, in the input's own planes: vertices and segments must exist, and small angles of
// the input excuse those of the mesh. Nodes are matched with vertices bit for bit.
GridCheck checkGridAgainst(const Grid& grid, const JobInput& input, const GridCheckOptions& options,
                           const ItemLoop& loop = inOrder);

}  // namespace coastmesh
