#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/job/job_input.hpp"
#include "core/refine/check.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// A defect of a grid that was read from a file.
struct GridDefect {
  DefectKind kind;
  Point place;                 // in the grid's CRS
  std::int64_t triangle = -1;  // the grid's, -1 where it has none
  double value = 0.0;          // as in MeshDefect
};

struct GridCheckOptions {
  double min_angle_deg = 0.0;    // degrees; 0 asks nothing
  double max_angle_deg = 180.0;  // degrees; 180 asks nothing
  SurfaceChoice surface;         // without an input; else the input's counts
  bool delaunay = false;
  bool pinches = false;
};

// What a grid that was read from a file is measured on. Throws OptionError where it has no place on such a surface.
SurfaceKind surfaceFor(const Grid& grid, const SurfaceChoice& choice);

struct GridCheck {
  std::vector<GridDefect> defects;
  // Triangles that break the bounds on angles, those too that are no defects: input angles excuse them.
  BoundCounts bounds;
};

// Every defect of the grid, each of its connected pieces in a plane of its own; a border between features counts as a
// constraint.
GridCheck checkGrid(const Grid& grid, const GridCheckOptions& options);

// The same against the input that the grid was made from, with the input's own planes: vertices and segments have to be
// there, and small angles of the input excuse those of the mesh. Nodes are matched with vertices bit for bit.
GridCheck checkGridAgainst(const Grid& grid, const JobInput& input, const GridCheckOptions& options);

}  // namespace coastmesh
