#pragma once

#include <string>
#include <vector>

#include "gis/grid/grid.hpp"
#include "gis/merge/merge_grids.hpp"
#include "gis/rivers/lay_rivers.hpp"
#include "gis/rivers/measure_rivers.hpp"

namespace coastmesh {

// A sentence for each reason for which rivers are lost, with their names.
std::vector<std::string> lostRiverTexts(const RiverReport& report, const Grid& mesh);

// The summary: lines that end with a line break.
std::string riversText(const RiverReport& report, const Grid& mesh);

// A line on widths that were measured between banks.
std::string measuredRiversText(const MeasuredRivers& measured, const Grid& mesh);

// The river boundaries of a mesh, a line each, by their numbers in files; empty if there are none.
std::string riverBoundariesText(const Grid& grid);

// Warnings, empty if there is nothing to warn of: of ends within the mesh's land, of reaches that are narrower than
// asked for, of triangles at junctions that miss the bound on angles, and of rivers that ended up without a connection
// to what is left of the mesh, as beyond a sliver of water too narrow for them. `triangles`: where those of the merged
// mesh come from.
std::string landEndsText(const RiverReport& report);
std::string narrowedRiversText(const RiverReport& report);
std::string junctionTrianglesText(const RiverReport& report);
std::string unconnectedRiversText(const Grid& merged, const std::vector<MergeSource>& triangles);

}  // namespace coastmesh
