#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "apps/commands.hpp"
#include "apps/exit_codes.hpp"
#include "apps/grid_outputs.hpp"
#include "apps/input_usage.hpp"
#include "apps/mesh_job.hpp"
#include "apps/mesh_report.hpp"
#include "apps/progress.hpp"
#include "apps/staged_file.hpp"
#include "core/run_control.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

constexpr std::size_t kWarningsShown = 20;

struct MeshUsage {
  MeshJob job;
  std::vector<std::string> outputs;
  std::string format;
  std::string algorithm = "relocate";
  bool shrink_given = false;
  bool cut = true;
  std::uint64_t threads = 0;
  std::string report;
  std::string progress = "auto";
  bool overwrite = false;
  bool quiet = false;
};

Algorithm algorithmNamed(const std::string& name) {
  std::size_t index = 0;
  while (name != kAlgorithmNames[index]) ++index;
  return static_cast<Algorithm>(index);
}

int threadsAsked(const ParallelOptions& options) {
  return options.threads > 0 ? options.threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

void showWarnings(const MeshJobResult& result) {
  for (const std::string& warning : result.read.warnings) {
    std::fprintf(stderr, "coastmesh: warning: %s\n", warning.c_str());
  }
  if (result.regions == 0 && result.refusals.size() == 1) return;  // the error to come says it
  const std::size_t shown = std::min(kWarningsShown, result.refusals.size());
  for (std::size_t i = 0; i < shown; ++i) {
    std::fprintf(stderr, "coastmesh: warning: left out: %s\n", result.refusals[i].reason.c_str());
  }
  if (result.refusals.size() > shown) {
    std::fprintf(stderr, "coastmesh: warning: left out: %zu more, which --report lists\n",
                 result.refusals.size() - shown);
  }
}

// The outputs that a run leaves behind when it ends well.
class MeshOutputs {
 public:
  MeshOutputs(const MeshUsage& usage, Interrupt& interrupt)
      : grids_(usage.outputs, usage.format, usage.overwrite, usage.job.input.files, interrupt), interrupt_(interrupt) {
    if (!usage.report.empty()) report_.emplace(usage.report, usage.overwrite, interrupt);
  }

  void writeGrids(const Grid& grid, ProgressDisplay& display) {
    for (std::size_t i = 0; i < grids_.size(); ++i) {
      display.show("write", static_cast<double>(i) / static_cast<double>(grids_.size()));
      grids_.write(i, grid);
      interrupt_.check();
      if (display.abandoned()) throw Cancelled();
    }
    display.show("write", 1.0);
    grids_written_ = true;
  }

  void writeReport(const std::string& text) {
    if (report_) report_->write(text);
  }

  void commit() {
    interrupt_.close();
    if (grids_written_) grids_.commit();
    if (report_) report_->commit();
  }

 private:
  GridOutputs grids_;
  std::optional<StagedFile> report_;
  Interrupt& interrupt_;
  bool grids_written_ = false;
};

int runMesh(const MeshUsage& usage, Interrupt& interrupt) {
  const auto start = std::chrono::steady_clock::now();
  const auto secondsSince = [](std::chrono::steady_clock::time_point since) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
  };
  MeshOutputs outputs(usage, interrupt);
  ProgressDisplay display(ProgressDisplay::styleFor(usage.progress, usage.quiet));
  const JobControl control{[&interrupt, &display] { return interrupt.requested() || display.abandoned(); },
                           [&display](std::string_view phase, double share) { display.show(phase, share); }};
  MeshJobResult result = runMeshJob(usage.job, control);
  display.clear();
  showWarnings(result);

  const auto write_start = std::chrono::steady_clock::now();
  const bool any = result.regions > 0;
  if (any) outputs.writeGrids(result.grid, display);
  result.seconds.write = secondsSince(write_start);
  result.log.addAlone("write", result.seconds.write);
  result.seconds.total = secondsSince(start);
  if (!usage.report.empty()) outputs.writeReport(meshReport(usage.job, result, threadsAsked(usage.job.parallel)));
  outputs.commit();
  if (!any) {
    throw InputError(result.refusals.size() == 1 ? result.refusals.front().reason
                                                 : "none of the " + std::to_string(result.refusals.size()) +
                                                       " parts of the input can be meshed");
  }

  display.show("done", 1.0);
  display.clear();
  if (!usage.quiet && usage.progress != "json") {
    std::string text = meshSummary(usage.job, result);
    for (const std::string& path : usage.outputs) text += "wrote " + path + "\n";
    if (!usage.report.empty()) text += "wrote " + usage.report + "\n";
    std::fputs(text.c_str(), stdout);
  }
  return result.complete() ? kExitDone : kExitShort;
}

}  // namespace

Command declareMesh(CLI::App& root) {
  auto usage = std::make_shared<MeshUsage>();
  CommandLine line(root, "mesh", "Mesh the polygons and closed lines of vector files, or a .poly");
  RefineOptions& refine = usage->job.mesh.refine;
  line.arguments("INPUT", usage->job.input.files, "vector files that GDAL reads ('-': standard input), or one .poly");
  line.texts("-o,--output", usage->outputs, kOutputFile, true, "mesh to write; repeat it for several");
  line.text("--format", usage->format, "NAME", "format of the output, where its ending does not tell");
  line.number("--min-angle", refine.min_angle_deg, "DEG", {0.0, 45.0}, "smallest angle asked for");
  double& max_angle = refine.max_angle_deg;
  line.number("--max-angle", max_angle, "DEG", {60.0, 180.0}, "largest angle asked for; 180 sets no bound");
  line.choice("--algorithm", usage->algorithm, {std::begin(kAlgorithmNames), std::end(kAlgorithmNames)},
              "where the points go that mend bad triangles");
  line.flag("--shrink,!--no-shrink", usage->job.mesh.shrink,
            "take out vertices that the bounds do not need; the algorithms other than relocate do so only when asked",
            &usage->shrink_given);
  line.number("--size-max", usage->job.size_max_m, "M", {0.0, std::numeric_limits<double>::infinity(), true},
              "longest edge");
  declareInputOptions(line, usage->job.input);
  line.integer("--max-vertices", refine.max_vertices, "N", 3, std::numeric_limits<std::uint64_t>::max(),
               "stop refining at so many vertices, with exit code 1");
  line.flag("--cut,!--no-cut", usage->cut, "cut large seas into pieces, to be refined at the same time");
  line.integer("--threads", usage->threads, "N", 0, 1024,
               "threads to work on, 0 for all cores; never changes the result");
  line.text("--report", usage->report, kOutputFile, "write a report as JSON");
  line.choice("--progress", usage->progress, {"auto", "bar", "json", "none"},
              "how to show progress: a bar on stderr, or JSON lines on stdout");
  line.flag("--overwrite", usage->overwrite, "replace files that exist");
  line.flag("--quiet", usage->quiet, "print no summary");

  Command command{std::move(line), {}};
  command.run = [usage](Interrupt& interrupt) {
    usage->job.mesh.refine.algorithm = algorithmNamed(usage->algorithm);
    // The classical algorithms are there to compare with: they insert what their papers say.
    if (!usage->shrink_given) usage->job.mesh.shrink = usage->job.mesh.refine.algorithm == Algorithm::Relocate;
    usage->job.mesh.one_piece = !usage->cut;
    usage->job.parallel.threads = static_cast<int>(usage->threads);
    return runMesh(*usage, interrupt);
  };
  return command;
}

}  // namespace coastmesh
