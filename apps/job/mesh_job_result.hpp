#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/input/job_input.hpp"
#include "apps/job/finish_grid.hpp"
#include "apps/job/step_outcome.hpp"
#include "core/quality.hpp"
#include "core/refine/refine_options.hpp"
#include "gis/clean/clean_report.hpp"
#include "gis/grid/grid.hpp"
#include "gis/raster/raster_band.hpp"
#include "gis/read/read_report.hpp"
#include "gis/size/size_source.hpp"
#include "gis/solver/partition_grid.hpp"
#include "parallel/work_log.hpp"

namespace coastmesh {

// A group of features that could not be meshed; the others were.
struct Refusal {
  std::string source;
  std::vector<std::int64_t> fids;
  std::string reason;
  std::optional<Point> place;  // in the input's CRS, if known
  bool over_budget = false;    // its sizes require many more vertices than `max_vertices`
  bool lacks_memory = false;   // it may be meshed where there is more memory
};

// A triangle that misses the bounds and that no input angle explains.
struct BoundViolationPlace {
  Point place;  // in the input's CRS
  double min_angle_deg = 0.0;
  double max_angle_deg = 0.0;
};
inline constexpr std::size_t kBoundViolationPlaces = 1000;  // further ones are counted, not listed

// All triangles that miss the bounds on angles and, if `--size-max` is a bound, on lengths.
struct Shortfall {
  std::uint64_t count = 0;
  std::vector<BoundViolationPlace> places;  // the first kBoundViolationPlaces of them

  void add(Shortfall&& other);
};

// Wall-clock seconds; all except read, finish, write and total are summed over groups, several of which may be meshed
// at once.
struct PhaseSeconds {
  double read = 0.0;
  double clean = 0.0;
  double size = 0.0;
  double triangulate = 0.0;
  double refine = 0.0;
  double coarsen = 0.0;
  double optimise = 0.0;
  double stitch = 0.0;
  double check = 0.0;
  double finish = 0.0;
  double write = 0.0;
  double total = 0.0;
};

// What a run saved for another to resume from, and resumed from itself.
struct CheckpointUse {
  std::uint64_t groups_taken = 0;     // groups of features completed by an earlier run
  std::uint64_t regions_gone_on = 0;  // groups for which an earlier run had done some rounds
  std::uint64_t rounds_kept = 0;
  std::uint64_t bytes_kept = 0;  // bytes written in all
};

struct MeshJobResult {
  Grid grid;  // without triangles if every feature was refused
  ReadReport read;
  SizeOptions sizes;  // as asked for, or as chosen
  Crs crs;
  std::array<std::uint64_t, kEditKinds> edits{};
  // By cleaning, and by following sizes: if the job keeps them; those of points outside the water in any case.
  std::vector<Edit> edit_places;
  std::map<std::uint32_t, std::string> edited;       // the features of these edits, and their sources
  std::map<std::string, std::uint64_t> projections;  // kind, and how many regions used it
  std::string first_projection;                      // of the first region, with its parameters
  std::string first_projection_reason;
  std::map<SurfaceKind, std::uint64_t> surfaces;  // number of regions measured on each
  double least_scale = std::numeric_limits<double>::infinity(), greatest_scale = 0.0;  // plane over true length
  std::uint64_t regions = 0;        // groups of features that were meshed
  std::uint64_t pieces = 0;         // regions are refined in one or more pieces
  std::uint32_t next_piece = 0;     // the least number above those in grid.piece_of
  WorkLog log;                      // groups that were cut, one after another, then the others
  double estimated_vertices = 0.0;  // from the requested sizes, including refused groups; 0 if there are none
  RefineStats refine;               // `unresolved` is empty: see below
  Shortfall short_of;               // of the mesh as it is written
  std::uint64_t short_before_repairs = 0;
  std::uint64_t turned = 0;          // triangles that are not counter-clockwise on the ground: see `turnedTriangles`
  std::vector<Point> turned_places;  // the first kBoundViolationPlaces of them, in the input's CRS
  std::vector<Refusal> refusals;
  std::vector<std::string> idle_inputs;     // warnings of inputs without effect, for features that are some of many
  std::map<std::string, std::size_t> idle;  // notes on inputs without effect, with the number of such regions
  std::set<std::uint32_t> took_part;        // features of lines and regions that the mesh had before it was finished
  FollowedWaters waters;                    // of meshed groups, if coasts follow sizes
  RaisedShore raised_shore;
  std::vector<Point> asked;   // places of points that --constraints requested; most are nodes
  std::string last_unwanted;  // why a group outside the requested area was skipped
  MeshQuality quality;
  std::optional<double> input_area_m2;  // of what was meshed; nullopt for a .poly
  double mesh_area_m2 = 0.0;
  std::uint64_t digest = 0;
  PhaseSeconds seconds;
  FinishReport finish;        // depths, boundaries and repairs
  StepOutcome step;           // of the finished grid
  PartitionReport partition;  // for a solver, if requested
  CheckpointUse checkpoint;
  std::vector<RasterUse> rasters_read;       // by each rank, if there are several
  std::vector<std::string> output_warnings;  // what files cannot hold of the mesh

  bool complete() const {
    return short_of.count == 0 && turned == 0 && !refine.budget_reached && refusals.empty() &&
           finish.repairs.left.empty() && step.held();
  }
};

// A mesh failed its own check: a bug in coastmesh.
struct BadMesh : std::logic_error {
  using std::logic_error::logic_error;
};

}  // namespace coastmesh
