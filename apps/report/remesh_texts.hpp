#pragma once

#include <string>
#include <vector>

#include "apps/remesh/remesh_grid.hpp"
#include "apps/remesh/triangle_figures.hpp"
#include "gis/grid/grid.hpp"
#include "gis/merge/merge_grids.hpp"
#include "gis/model/depth.hpp"

namespace coastmesh {

// "1,234 m"; without a unit in a plane.
std::string lengthText(double length, const Grid& grid);

// "120 triangles, edges from 90 m to 1 200 m, angles from 31.2 degrees\n"
std::string figuresText(const TriangleFigures& figures, const Grid& grid);

// Warnings of new triangles that miss the bounds on angles, and of new nodes' depths.
std::vector<std::string> newNodeWarnings(const RemeshReport& report, const DepthOptions& depth);

// "changed by repairs: " and their figures; empty if there are none.
std::string repairedText(const RepairedTriangles& repaired, const Grid& grid);

// A warning of those that miss the bounds on angles; empty if there are none.
std::string repairedWarning(const RepairedTriangles& repaired);

// A warning of water that is lost between two meshes; empty if it is next to nothing of what was replaced.
std::string lostWaterText(const MergeReport& merged);

}  // namespace coastmesh
