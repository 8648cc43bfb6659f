#include "apps/usage/mesh_usage.hpp"

#include <algorithm>
#include <limits>

#include "apps/report/mesh_report.hpp"
#include "apps/usage/finish_usage.hpp"
#include "apps/usage/grid_usage.hpp"
#include "apps/usage/input_usage.hpp"
#include "gis/format/grid_io.hpp"

namespace coastmesh {

namespace {

// The value of an enumeration by its name, which is one of them.
template <typename Enum, std::size_t kCount>
Enum named(const char* const (&names)[kCount], const std::string& name) {
  std::size_t index = 0;
  while (name != names[index]) ++index;
  return static_cast<Enum>(index);
}

}  // namespace

CommandLine declareMeshUsage(CLI::App& root, MeshUsage& usage) {
  CommandLine line(root, "mesh", "Mesh the polygons and closed lines of vector files, or a .poly");
  RefineOptions& refine = usage.job.mesh.refine;
  line.arguments("INPUT", usage.job.input.files, "vector files that GDAL reads ('-': standard input), or one .poly");
  declareGridOutputs(line, usage.outputs, usage.format);
  line.number("--min-angle", refine.min_angle_deg, "DEG", {0.0, 45.0}, "smallest angle asked for");
  double& max_angle = refine.max_angle_deg;
  line.number("--max-angle", max_angle, "DEG", {60.0, 180.0}, "largest angle asked for; 180 sets no bound");
  line.choice("--algorithm", usage.algorithm, {std::begin(kAlgorithmNames), std::end(kAlgorithmNames)},
              "where the points go that mend bad triangles");
  line.flag("--coarsen,!--no-coarsen", usage.job.mesh.coarsen,
            "take out vertices that the bounds do not need; the algorithms other than relocate do so only when asked",
            &usage.coarsen_given)
      .formerly({"--shrink", "--no-shrink"});
  declareSizing(line, usage.job.sizes, usage.sizing);
  line.flag("--smooth,!--no-smooth", usage.job.mesh.smooth,
            "optimise the shapes of triangles for longer; where no sizes are asked for, at all");
  line.choice(
          "--quality", usage.quality, {std::begin(kGoalNames), std::end(kGoalNames)},
          "what the optimiser holds above equilateral triangles: centred asks for no angle above 90 degrees, so that "
          "circumcentres lie within (C-grids), links for neighbours' circumcentres apart (D-Flow FM)")
      .needs(
          [&usage] {
            const MeshOptions& mesh = usage.job.mesh;
            return usage.quality == "centred" || mesh.smooth || (usage.job.sizes.any() && mesh.coarsen);
          },
          "without sizes or --smooth");
  declareInputOptions(line, usage.job.input);
  declarePinches(line, usage.job.input);
  declareFinishOptions(line, usage.job.finish);
  line.integer(
      "--max-vertices", refine.max_vertices, "N", 3, std::numeric_limits<std::uint64_t>::max(),
      "stop refining at so many vertices, with exit code 1; where sizes ask for clearly more, nothing is made");
  line.flag("--cut,!--no-cut", usage.cut, "cut large seas into pieces, to be refined at the same time");
  line.flag("--mark-pieces", usage.job.mesh.mark_pieces,
            "write which piece each triangle was refined in, to .nc, for plot --color piece")
      .needs(
          [&usage] {
            return std::ranges::any_of(usage.outputs, [&usage](const std::string& path) {
              return gridFormatFor(path, usage.format).name == "ugrid";
            });
          },
          "without an output that is UGRID (.nc)");
  line.integer("--threads", usage.threads, "N", 0, 1024,
               "threads to work on, 0 for all cores; never changes the result");
  line.output("--report", usage.report, {.standard_output = true},
              "write a report as JSON; - prints it in place of the summary");
  line.choice(
      "--progress", usage.progress, {"auto", "bar", "log", "json", "none"},
      "how to show progress on stderr: a bar, or a line every ten seconds (auto: a bar on a terminal, else lines); "
      "or JSON lines on stdout");
  line.flag("--overwrite", usage.overwrite, "replace files that exist");
  line.flag("--quiet", usage.quiet, "print no summary");
  line.example("coastmesh mesh lake.geojson -o lake.gpkg -o lake.nc", "a lake as GIS layers and as a UGRID grid");
  line.example("coastmesh mesh sea.shp -o fort.14 --min-angle 35 --size-max 5000",
               "a sea for ADCIRC: angles of 35 degrees and more, no edge longer than 5 km");
  line.example("coastmesh mesh lakes.gpkg -o lakes.msh --min-island-area 10000 --report lakes.json",
               "many lakes for Gmsh's readers, islands below a hectare filled, with a report for scripts");
  return line;
}

void settle(MeshUsage& usage) {
  const bool framed = usage.job.input.frame.box.has_value() || !usage.job.input.clip.empty();
  settleSizing(usage.sizing, usage.job.finish.depth, framed && !usage.job.finish.targets.empty(), usage.job.sizes);
  usage.job.mesh.refine.algorithm = named<Algorithm>(kAlgorithmNames, usage.algorithm);
  usage.job.mesh.refine.goal = named<QualityGoal>(kGoalNames, usage.quality);
  if (usage.job.mesh.refine.goal == QualityGoal::Centred)
    usage.job.mesh.refine.max_angle_deg = std::min(usage.job.mesh.refine.max_angle_deg, 90.0);
  // The classical algorithms are there to compare with: they insert what their papers say.
  if (!usage.coarsen_given) usage.job.mesh.coarsen = usage.job.mesh.refine.algorithm == Algorithm::Relocate;
  if (!usage.job.finish.boundaries.column.empty()) usage.job.finish.boundaries.inputs = usage.job.input.files;
  usage.job.mesh.one_piece = !usage.cut;
  usage.job.parallel.threads = static_cast<int>(usage.threads);
}

}  // namespace coastmesh
