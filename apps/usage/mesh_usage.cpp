#include "apps/usage/mesh_usage.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "apps/report/mesh_report.hpp"
#include "apps/usage/finish_usage.hpp"
#include "apps/usage/input_usage.hpp"
#include "gis/model/target.hpp"
#include "gis/places.hpp"

namespace coastmesh {

namespace {

// The value of an enumeration by its name, which is one of them.
template <typename Enum, std::size_t kCount>
Enum named(const char* const (&names)[kCount], const std::string& name) {
  return static_cast<Enum>(std::ranges::find(names, name) - std::begin(names));
}

// Sizes are chosen for a model's sea without any. To be called before `settle`.
SizeChoice sizeChoice(const MeshJob& job) {
  const bool is_framed = job.input.frame.box.has_value() || !job.input.clip.empty();
  const bool is_sized = job.sizes.any() || job.sizes.most_m < SizeOptions::kNone;
  if (!is_framed || is_sized || job.finish.targets.empty()) return SizeChoice::None;
  return job.finish.depth.files.empty() ? SizeChoice::FromExtent : SizeChoice::FromExtentAndDepths;
}

// MPAS requires circumcentres inside their triangles.
void chooseLargestAngle(MeshUsage& usage) {
  constexpr double kWellCentredDeg = 89.0;
  const std::vector<Target> targets = targetsNamed(usage.job.finish.targets);
  if (std::ranges::find(targets, Target::Mpas) == targets.end()) return;
  if (usage.max_angle_given || usage.job.mesh.refine.goal == QualityGoal::Centred) return;
  usage.job.mesh.refine.max_angle_deg = kWellCentredDeg;
  usage.job.notes.push_back("no angle above 89 degrees is asked for, as MPAS needs it; give --max-angle to say else");
}

void declareCrests(OptionTable& table, FinishOptions& finish) {
  constexpr double kFarthest = 1000.0;  // metres: beyond it there are other levees and hills
  const auto isForAdcirc = [&finish] {
    const std::vector<Target> targets = targetsNamed(finish.targets);
    return targets.size() == 1 && targets.front() == Target::Adcirc;
  };
  table
      .texts({"--weir-heights", "Heights of weirs"}, finish.crests.files, kRasterFile, false,
             "raster of heights, positive up, with the crests of weirs that have no attribute height: at each pair of "
             "nodes the lowest crest up to half-way to the next; can be repeated, the first with a value at a place is "
             "used")
      .needs({"--weirs"})
      .needs(isForAdcirc, "without --target adcirc alone");
  table
      .number({"--weir-search", "Search for crests"}, finish.crests.search_m, "M", {0.0, kFarthest},
              "distance from the lines within which the highest terrain is the crest")
      .needs({"--weir-heights"});
}

}  // namespace

void declareMeshOptions(OptionTable& table, MeshUsage& usage) {
  RefineOptions& refine = usage.job.mesh.refine;
  table.section(Section::Triangles);
  table.number({"--min-angle", "Minimum angle"}, refine.min_angle_deg, "DEG", {0.0, 45.0},
               "minimum angle of the triangles");
  double& max_angle = refine.max_angle_deg;
  table.number({"--max-angle", "Maximum angle"}, max_angle, "DEG", {60.0, 180.0},
               "maximum angle of the triangles; 180: no limit; with --target mpas the default is 89",
               &usage.max_angle_given);
  table.choice({"--algorithm", "Placement of points"}, usage.algorithm,
               {std::begin(kAlgorithmNames), std::end(kAlgorithmNames)},
               "where points are inserted to remove bad triangles");
  table
      .flag({"--coarsen,!--no-coarsen", "Remove unneeded vertices"}, usage.job.mesh.coarsen,
            "remove unneeded vertices, which the bounds do not require; by default only with --algorithm relocate",
            &usage.coarsen_given)
      .formerly({"--shrink", "--no-shrink"});
  declareSizing(table, usage.job.sizes, usage.sizing, [&usage] { return sizeChoice(usage.job); });
  table.section(Section::Triangles);
  table.flag({"--smooth,!--no-smooth", "Optimise longer"}, usage.job.mesh.smooth,
             "optimise longer; without sizes, shapes are optimised only with this option");
  table
      .choice({"--quality", "Goal of the optimiser"}, usage.quality, {std::begin(kGoalNames), std::end(kGoalNames)},
              "what the optimiser enforces besides regular triangles: shape: circumcentres of neighbours as far apart "
              "as D-Flow FM requires; links: twice as far; centred: no angle above 90 degrees, so that circumcentres "
              "are inside their triangles (C-grids)")
      .needs(
          [&usage] {
            const MeshOptions& mesh = usage.job.mesh;
            const bool is_sized = usage.job.sizes.any() || sizeChoice(usage.job) != SizeChoice::None;
            return usage.quality == "centred" || mesh.smooth || (is_sized && mesh.coarsen);
          },
          "without sizes or --smooth")
      .needs(
          [&usage] {
            const MeshOptions& mesh = usage.job.mesh;
            const bool coarsens = usage.coarsen_given ? mesh.coarsen : usage.algorithm == "relocate";
            return usage.quality == "centred" || mesh.smooth || coarsens;
          },
          "without --coarsen or --smooth if --algorithm is not relocate");
  declareInputOptions(table, usage.job.input);
  declareSurface(table, usage.job.input.surface);
  declarePinches(table, usage.job.input);
  declareFinishOptions(table, usage.job.finish);
  table.section(Section::Domain);
  declareCrests(table, usage.job.finish);
  table.number(
      {"--flood-height", "Height of the flood plain"}, usage.flood_height_m, "M",
      {0.0, std::numeric_limits<double>::infinity(), true},
      "mesh also the land that --bathymetry has lower than this above the still water and that is connected with "
      "the water through such land");
  table.section(Section::Triangles);
  table.integer(
      {"--max-vertices", "Maximum number of vertices"}, refine.max_vertices, "N", 3,
      std::numeric_limits<std::uint64_t>::max(),
      "stop refining at this number of vertices, with exit code 1; if sizes require many more, no mesh is made");
  table.section(Section::Run);
  table.flag({"--cut,!--no-cut", "Cut large seas into pieces"}, usage.cut, "refine large seas in pieces, in parallel");
  table.section(Section::Output);
  table.flag({"--mark-pieces", "Mark the pieces"}, usage.job.mesh.mark_pieces,
             "write the piece in which each triangle was refined to .nc, for plot --color piece");
  table.section(Section::Run);
  table.integer({"--threads", "Threads"}, usage.threads, "N", 0, 1024,
                "threads to use, 0 for all cores; does not change the result");
}

namespace {

// Throws OptionError if a whole globe has neither input nor sizes, or if its coasts are to follow sizes.
void requireGlobe(const InputOptions& input, const SizeOptions& sizes) {
  if (input.frame.side != DomainSide::Globe) return;
  const bool empty = input.files.empty() && input.constraints.empty() && input.weirs.empty() && input.regions.empty();
  if (empty && !sizes.any() && !std::isfinite(sizes.most_m))
    throw OptionError("--domain globe: without INPUT and --constraints a size has to be asked for, such as --size");
  if (sizes.coast == CoastDetail::Follow)
    throw OptionError("--domain globe keeps coasts as they are: leave out --coast follow");
}

// Throws OptionError if a raster of depths, positive down, is to have crests.
void requireHeights(const FinishOptions& finish) {
  for (const std::string& file : finish.crests.files)
    if (finish.depth.positive_down && std::ranges::find(finish.depth.files, file) != finish.depth.files.end())
      throw OptionError("--weir-heights " + file +
                        " holds depths, as --depth-sign down says of it: give a raster of heights, positive up");
}

// To be called after sizes are settled.
void settleFlood(const MeshUsage& usage, MeshJob& job) {
  if (!std::isfinite(usage.flood_height_m)) return;
  if (job.finish.depth.files.empty())
    throw OptionError("--flood-height needs the heights of the land: give a raster with --bathymetry");
  job.input.flood = {usage.flood_height_m, job.finish.depth, std::min(job.sizes.shore_m, job.sizes.size_m)};
  job.finish.depth.has_land = true;
}

}  // namespace

void settle(MeshUsage& usage) {
  settleSizing(usage.sizing, usage.job.finish.depth, sizeChoice(usage.job), usage.job.sizes);
  std::ranges::move(notesOnOverriddenSizes(usage.sizing, usage.job.sizes), std::back_inserter(usage.job.notes));
  requireGlobe(usage.job.input, usage.job.sizes);
  requireHeights(usage.job.finish);
  settleFlood(usage, usage.job);
  usage.job.mesh.refine.algorithm = named<Algorithm>(kAlgorithmNames, usage.algorithm);
  usage.job.mesh.refine.goal = named<QualityGoal>(kGoalNames, usage.quality);
  if (usage.job.mesh.refine.goal == QualityGoal::Centred)
    usage.job.mesh.refine.max_angle_deg = std::min(usage.job.mesh.refine.max_angle_deg, 90.0);
  chooseSurface(usage.job.finish.targets, usage.job.input.surface);
  chooseLargestAngle(usage);
  // The classical algorithms serve for comparison: by default they insert points as published, without coarsening.
  if (!usage.coarsen_given) usage.job.mesh.coarsen = usage.job.mesh.refine.algorithm == Algorithm::Relocate;
  constexpr double kNotObtuseDeg = 90.0;
  if (usage.job.mesh.refine.algorithm != Algorithm::Relocate && usage.job.mesh.refine.max_angle_deg <= kNotObtuseDeg)
    usage.job.notes.push_back("--algorithm " + usage.algorithm + " was not made for a largest angle of " +
                              amount("%g", usage.job.mesh.refine.max_angle_deg) +
                              " degrees, and may take many times the vertices: relocate holds it");
  const BoundaryOptions& boundaries = usage.job.finish.boundaries;
  // A plane graph has no columns: beside one, the column is only that of the files.
  if (boundaries.files.empty() || !isPlaneGraph(usage.job.input)) usage.job.input.boundary_column = boundaries.column;
  usage.job.input.may_lack_column = !boundaries.files.empty();
  usage.job.mesh.one_piece = !usage.cut;
  usage.job.parallel.threads = static_cast<int>(usage.threads);
}

}  // namespace coastmesh
