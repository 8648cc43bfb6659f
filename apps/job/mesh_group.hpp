#pragma once

#include "apps/job/judge_mesh.hpp"
#include "apps/job/mesh_job_options.hpp"
#include "apps/job/mesh_job_result.hpp"

namespace coastmesh {

// All that remains of a group of features once it is meshed.
struct GroupResult {
  Grid grid;  // its CRS is left out
  std::array<std::uint64_t, kEditKinds> edits{};
  std::vector<Edit> edit_places;  // where the job keeps them
  std::string projection;
  std::string projection_reason;
  SurfaceKind surface = SurfaceKind::Plane;        // that `quality` and `short_of` are measured on
  double least_scale = 1.0, greatest_scale = 1.0;  // plane length over true length, at the vertices
  RefineStats refine;
  Shortfall short_of;
  MeshQuality quality;
  std::optional<double> size_max;  // the longest edge of its plane, as in WorkingPlane; none where nothing was meshed
  std::optional<double> input_area_m2;
  std::uint64_t digest = 0;
  double clean_s = 0.0;
  double size_s = 0.0;
  double check_s = 0.0;
  MeshSeconds mesh_s;
  std::size_t pieces = 1;
  WorkLog log;                      // of all that was done
  double estimated_vertices = 0.0;  // from the sizes asked for; 0 where there are none
  std::string refusal;              // empty where it was meshed, or nothing of it was wanted
  bool over_budget = false;         // refused because its sizes ask for clearly more than `--max-vertices`
  std::optional<Point> refusal_place;
  std::string unwanted;            // why nothing of it was wanted, where that is so
  std::vector<std::string> notes;  // what cleaning, and following sizes, decided
  std::vector<std::string> warnings;
};

// What a group's mesh may take.
struct GroupRoom {
  std::uint64_t vertices = 0;  // its share of `--max-vertices`
  double memory = 0.0;         // bytes
};

// Projects, cleans, meshes and checks a group. What cannot be meshed is reported in `refusal`: so is that its sizes ask
// for clearly more than there is room for, before that is taken. Throws Cancelled, BadMesh,
// BadCheckpoint, and what the job's exchange throws.
GroupResult meshGroup(const MeshJob& job, const JobInput& input, const SizeInputs& sizes, std::size_t group,
                      const GroupRoom& room, const RunControl& control);

}  // namespace coastmesh
