#pragma once

#include <string>
#include <vector>

#include "apps/input/job_input.hpp"
#include "apps/job/mesh_job_options.hpp"
#include "apps/job/mesh_job_result.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/size/size_source.hpp"

namespace coastmesh {

// A warning for each file of constraints or weirs that has polygons, which are left out.
std::vector<std::string> warningsOfPolygons(const InputOptions& input, const Coastline& coastline);
// Removes the files of constraints and weirs that have nothing but polygons.
void leaveOutPolygonFiles(InputOptions& input, const Coastline& coastline);

// Records the points of --constraints that lie so far from all areas that they are in no group.
void addStrayPoints(const JobInput& input, MeshJobResult& result);

// A warning for each file of --constraints of which some points, but not all of it, lie outside the water.
std::vector<std::string> warningsOfLostPoints(const InputOptions& input, const Coastline& coastline,
                                              const MeshJobResult& result);

// A note for each file of --weirs of which some, but not all, within the frame lie outside of the mesh.
std::vector<std::string> notesOfLostWeirs(const InputOptions& input, const Coastline& coastline,
                                          const MeshJobResult& result);

// A warning for each file given for sizes, passages, barriers, constraints, weirs or regions that has nothing near the
// mesh (mostly its CRS is wrong, or it is of another place), and for each band that contains no depth of the mesh.
std::vector<std::string> warningsOfIdleInputs(const MeshJob& job, const SizeInputs& sizes, const Coastline& coastline,
                                              const MeshJobResult& result);

}  // namespace coastmesh
