#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "apps/job/judge_mesh.hpp"
#include "apps/job/mesh_job_options.hpp"
#include "apps/job/mesh_job_result.hpp"
#include "core/run_control.hpp"

namespace coastmesh {

// The result of meshing a group of features.
struct GroupResult {
  Grid grid;  // without its CRS
  std::array<std::uint64_t, kEditKinds> edits{};
  std::vector<Edit> edit_places;  // if the job keeps them; those of points outside the water in any case
  std::string projection;
  std::string projection_reason;
  SurfaceKind surface = SurfaceKind::Plane;  // on which `quality` and `short_of` are measured
  // Plane length over true length, at vertices of the input and of the mesh.
  double least_scale = std::numeric_limits<double>::infinity(), greatest_scale = 0.0;
  RefineStats refine;
  Shortfall short_of;
  MeshQuality quality;
  std::optional<double> size_max;  // the longest edge of its plane, as in WorkingPlane; nullopt if nothing was meshed
  std::optional<double> input_area_m2;
  std::uint64_t digest = 0;
  double clean_s = 0.0;
  double size_s = 0.0;
  double check_s = 0.0;
  MeshSeconds mesh_s;
  std::size_t pieces = 1;
  WorkLog log;                      // of all stages
  double estimated_vertices = 0.0;  // from the requested sizes; 0 if there are none
  std::string refusal;              // empty if it was meshed, or nothing of it was requested
  bool over_budget = false;         // refused because its sizes require many more vertices than `--max-vertices`
  bool lacks_memory = false;        // refused because it takes more than its room's memory
  std::optional<Point> refusal_place;
  std::string unwanted;            // why nothing of it was requested, if so
  std::vector<std::string> notes;  // decisions of cleaning, and of following sizes
  std::vector<std::string> warnings;
  std::vector<std::string> idle;         // as in CleanReport
  std::vector<std::uint32_t> took_part;  // features of lines and regions that the mesh has
  FollowedWaters waters;
  RaisedShore raised_shore;
  std::vector<Point> asked;  // places of points that --constraints requested, in the grid's CRS
};

// The limits of a group's mesh.
struct GroupRoom {
  std::uint64_t vertices = 0;  // its share of `--max-vertices`
  double memory = 0.0;         // bytes; changes nothing but whether the group is refused
  // Called with the number of vertices that its sizes need, before meshing; may be empty.
  std::function<void(double vertices)> expects{};
};

// A group, and the context in which it is meshed.
struct GroupTask {
  const MeshJob& job;
  const JobInput& input;
  const SizeInputs& sizes;
  std::size_t group;
  const GroupRoom& room;
  const RunControl& control;

  const Feature& firstFeature() const { return input.coastline().features[input.members(group).front()]; }
};

}  // namespace coastmesh
