#include "apps/cli/mesh_run.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <system_error>
#include <thread>
#include <tuple>
#include <utility>

#include "apps/cli/checkpoint_folder.hpp"
#include "apps/cli/cleaned_output.hpp"
#include "apps/cli/partition_outputs.hpp"
#include "apps/cli/run_outputs.hpp"
#include "apps/cli/shard_file.hpp"
#include "apps/job/mesh_job.hpp"
#include "apps/job/stopwatch.hpp"
#include "apps/process/exit_codes.hpp"
#include "apps/process/progress.hpp"
#include "apps/report/mesh_report.hpp"
#include "apps/report/mesh_warnings.hpp"
#include "apps/report/report_sections.hpp"
#include "apps/usage/grid_usage.hpp"
#include "apps/usage/mesh_usage.hpp"
#include "cluster/cluster.hpp"
#include "cluster/ranks_started.hpp"
#include "core/run_control.hpp"
#include "gis/error.hpp"
#include "gis/for_count.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/places.hpp"
#include "gis/read/open_source.hpp"
#include "parallel/recorder.hpp"
#include "parallel/workers.hpp"

namespace coastmesh {

namespace {

int threadsAsked(const ParallelOptions& options) {
  return options.threads > 0 ? options.threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

// Throws OptionError if a vector file of the job can be read only once; `purpose`: what reads it again.
void requireNoStream(const MeshJob& job, const std::string& purpose) {
  const InputOptions& input = job.input;
  const SizeOptions& sizes = job.sizes;
  for (const std::vector<std::string>& paths : {input.files,
                                                {input.clip},
                                                input.constraints,
                                                input.weirs,
                                                input.regions,
                                                sizes.features,
                                                sizes.passages,
                                                sizes.barriers,
                                                job.finish.boundaries.files}) {
    const auto stream = std::ranges::find_if(paths, isStream);
    if (stream == paths.end()) continue;
    throw OptionError(purpose + ", which standard input and other pipes do not allow (" + *stream + "): give a file");
  }
}

// Why there is no mesh.
std::string reasonOf(const std::vector<Refusal>& refusals) {
  if (refusals.size() == 1) return refusals.front().reason;
  return "none of the " + std::to_string(refusals.size()) + " parts of the input can be meshed";
}

std::string summaryOf(const MeshRunUsage& usage, const MeshJob& job, const MeshJobResult& result) {
  std::string text = meshSummary(job, result) + shownNotes(result.read.notes);
  for (const std::string& path : usage.outputs) text += "wrote " + path + "\n";
  if (!usage.edits.empty()) text += "wrote " + usage.edits + "\n";
  if (!usage.report.empty()) text += "wrote " + usage.report + "\n";
  return text;
}

// The requirements that the mesh misses, in one line: all that a quiet run prints about them.
std::string shortfallOf(const MeshJobResult& result) {
  std::string text;
  const auto add = [&text](const std::string& reason) { text += (text.empty() ? "" : "; ") + reason; };
  const auto counted = [](std::uint64_t count, const char* one, const char* many) {
    return std::to_string(count) + forCount(count, one, many);
  };
  if (result.short_of.count > 0)
    add(counted(result.short_of.count, " triangle misses", " triangles miss") + " the bounds on angles or lengths" +
        (result.short_of.places.empty() ? "" : ", the first at " + pointText(result.short_of.places.front().place)));
  if (result.turned > 0) add(counted(result.turned, " triangle is", " triangles are") + " not counter-clockwise");
  if (result.refine.budget_reached) add("the budget of points is used up");
  if (!result.refusals.empty()) add(counted(result.refusals.size(), " group", " groups") + " of features left out");
  const std::size_t left = result.finish.repairs.left.size();
  if (left > 0) add(counted(left, " defect", " defects") + " for models could not be repaired");
  if (!result.step.below_step.empty()) add("the time step is not held");
  if (result.step.least_missed) add("edges are far shorter than --size-min");
  return text;
}

// Writes all mesh files. Warns of what they cannot hold of the mesh, or hold although the mesh lacks it; returns the
// warnings.
std::vector<std::string> writeGrids(RunOutputs& outputs, const Grid& grid, ProgressDisplay& display, Run& run,
                                    const ItemLoop& loop) {
  std::vector<std::string> warnings = outputs.lossWarnings(grid, LossesOf::Input);
  std::ranges::move(outputs.numberWarnings(grid), std::back_inserter(warnings));
  if (!warnings.empty()) display.clear();
  for (const std::string& warning : warnings) run.warn(warning);
  for (std::size_t i = 0; i < outputs.grids(); ++i) {
    display.show("write", static_cast<double>(i) / static_cast<double>(outputs.grids()));
    outputs.writeGrid(i, grid, loop);
    run.interrupt.check();
    if (display.abandoned()) throw Cancelled();
  }
  display.show("write", 1.0);
  return warnings;
}

// The exit code of the run that made the existing outputs; nullopt unless all exist and are complete.
std::optional<int> doneBefore(const MeshRunUsage& usage, Run& run, const GivenOptions& given) {
  int code = kExitDone;
  for (const OptionTable::NamedOutput& output : run.options.outputs()) {
    if (!isMade(output.path)) return std::nullopt;
    if (!isShardFile(output.path)) continue;
    const std::optional<ShardHeader> header = headerOfWholeShard(output.path);
    if (!header) {
      run.warn("'" + output.path + "' is damaged, or not whole: it is made again");
      return std::nullopt;
    }
    const auto [shard, shards] = shardOf(usage.shard);
    if (header->options != given || header->shard != shard || header->shards != shards)
      throw OptionError("'" + output.path + "' exists, but belongs to another run: give another name, or --overwrite");
    if (header->left > 0) return std::nullopt;  // there may be more memory now
    code = header->exit_code;
  }
  return code;
}

// Ends the output of a run that made no mesh: a line for people, on standard error if standard output is for programs.
void endWithoutMesh(const MeshRunUsage& usage, const std::string& line) {
  ProgressDisplay display(ProgressDisplay::styleFor(usage.progress, usage.quiet));
  display.show("done", 1.0);
  display.clear();
  if (usage.quiet) return;
  if (usage.progress == "json" || usage.report == "-") {
    std::fprintf(stderr, "coastmesh: %s\n", line.c_str());
  } else {
    std::printf("%s\n", line.c_str());
  }
}

// Throws OptionError if the folder of --checkpoint is an input or output of the run.
void requireCheckpointApart(const std::string& folder, const OptionTable& options) {
  std::vector<OptionTable::NamedOutput> written = options.outputs();
  const std::string name = (std::filesystem::path(folder) / "").parent_path();  // without a trailing slash
  written.push_back({"--checkpoint", folder, {{name}, {}, {}}});
  requireOutputsApart(written, options.inputs());
}

// What a run keeps of each group of features for later runs.
struct KeptGroups {
  ShardWriter shard;
  std::optional<CheckpointFolder> checkpoint;
  bool to_shard = false;
};

CheckpointHeader checkpointHeader(const Run& run, const GivenOptions& given, const GroupExchange& exchange) {
  CheckpointHeader header{COASTMESH_VERSION, given, exchange.shard, exchange.shards, {}, 0, 0};
  // Of a file of options only the options matter, which are compared themselves.
  for (const auto& [option, input] : run.options.inputs())
    for (const std::string& path : option == "--config" ? std::vector<std::string>() : filesReadBy(input))
      header.files.push_back(stampOf(path));
  return header;
}

// Has groups kept, and taken from the checkpoint if they are in it. `kept` must outlive the exchange.
void exchangeWith(KeptGroups& kept, GroupExchange& exchange) {
  if (kept.checkpoint) {
    CheckpointFolder& folder = *kept.checkpoint;
    exchange.has = [&folder](std::size_t group) { return folder.has(group); };
    exchange.take = [&folder](std::size_t group) { return folder.take(group); };
    exchange.checkpoint = [&folder](std::size_t group) { return folder.rounds(group); };
  }
  if (!kept.to_shard && !kept.checkpoint) return;
  exchange.begin = [&kept](std::uint64_t digest, std::size_t groups) {
    if (kept.to_shard) kept.shard.begin(digest, groups);
    if (kept.checkpoint) kept.checkpoint->begin(digest, groups);
  };
  exchange.keep = [&kept](std::size_t group, const GroupResult& result) {
    if (kept.to_shard) kept.shard.keep(group, result);
    if (kept.checkpoint) kept.checkpoint->keep(group, result);
  };
}

MeshJobResult runKeeping(const KeptGroups& kept, const MeshJob& job, const JobControl& control) {
  try {
    MeshJobResult result = runMeshJob(job, control);
    if (kept.checkpoint) result.checkpoint = kept.checkpoint->use();
    return result;
  } catch (const BadCheckpoint& error) {
    throw InputError(error.what() + kept.checkpoint->remedy());
  }
}

// Cuts the mesh into parts, if these are requested.
void cutMesh(const PartitionOptions& partition, const MeshJob& job, const std::function<bool()>& cancelled,
             MeshJobResult& result) {
  const Stopwatch time;
  withThreads(job.parallel, [&] {
    Recorder recorder;
    result.partition = partitionGrid(result.grid, partition, recorder.loop("partition", {cancelled, {}}));
    result.log.append(recorder.finish("partition"));
  });
  result.seconds.finish += time.seconds();
}

// Writes the mesh, and `edits` unless null.
void writeMesh(RunOutputs& outputs, StagedFiles* edits, const MeshJob& job, const std::function<bool()>& cancelled,
               ProgressDisplay& display, Run& run, MeshJobResult& result) {
  withThreads(job.parallel, [&] {
    Recorder recorder;
    result.output_warnings = writeGrids(outputs, result.grid, display, run, recorder.loop("write", {cancelled, {}}));
    result.log.append(recorder.finish("write"));
  });
  if (edits == nullptr) return;
  const auto source_of = [&result](std::uint32_t feature) { return result.edited.at(feature); };
  edits->make([&](const std::string& path) {
    writeVectorLayers(path, result.crs, {editLayer(result.edit_places, source_of, result.read)});
  });
}

// The end of a run without a mesh: throws InputError, or returns the exit code.
int refuseRun(const MeshRunUsage& usage, const MeshJob& job, const MeshJobResult& result) {
  const bool none_refused = result.refusals.empty();
  if (none_refused && job.exchange.shards > 1 && result.last_unwanted.empty())
    throw InputError("there are fewer groups of features than shards: none of them is shard " + usage.shard + "'s");
  if (none_refused)
    throw InputError(result.last_unwanted.empty() ? "the input has nothing to mesh" : result.last_unwanted);
  if (!std::ranges::all_of(result.refusals, &Refusal::over_budget)) throw InputError(reasonOf(result.refusals));
  std::fprintf(stderr, "coastmesh: error: %s\n", reasonOf(result.refusals).c_str());
  return kExitShort;
}

}  // namespace

std::pair<std::uint32_t, std::uint32_t> shardOf(const std::string& text) {
  if (text.empty()) return {0, 1};
  constexpr std::uint32_t kMostShards = 1'000'000;
  std::uint32_t shard = 0, shards = 0;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard);
  const bool divided = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
  const auto second = divided ? std::from_chars(first.ptr + 1, end, shards) : first;
  if (!divided || second.ec != std::errc() || second.ptr != end || shards > kMostShards || shard < 1 || shard > shards)
    throw OptionError("--shard " + text + ": is not I/N, such as 3/7 for the third of seven, up to a million");
  return {shard - 1, shards};
}

void requireShardOfThisRank(const std::string& text, const Run& run) {
  const int ranks = ranksStarted();
  if (text.empty() || ranks <= 1 || run.cluster != nullptr) return;
  const auto made_by = static_cast<int>(shardOf(text).first % static_cast<std::uint32_t>(ranks));
  if (made_by == rankStarted()) return;
  throw OptionError("--shard " + text + ": of " + std::to_string(ranks) + " ranks it is rank " +
                    std::to_string(made_by) + " that makes it, this is rank " + std::to_string(rankStarted()) +
                    "; give each rank a share of its own, or start one process");
}

OptionTable meshJobOptions(MeshUsage& usage) {
  OptionTable table("mesh", "");
  table.arguments(kInputs, usage.job.input.files, "",
                  [&usage] { return usage.job.input.frame.side == DomainSide::Globe; });
  declareMeshOptions(table, usage);
  return table;
}

void declareMeshes(OptionTable& table, MeshRunUsage& usage, bool with_shards) {
  const auto files = [&usage, with_shards](const std::string& path) -> OutputFiles {
    if (with_shards && isShardFile(path)) return {{path}, {}, {}};
    return filesOf(gridFormatFor(path, usage.format), path);
  };
  table.section(Section::Output);
  table.outputs(
      {"-o,--output", "Outputs"}, usage.outputs, {.required = true, .files = files},
      with_shards ? "mesh to write, or a .shard for gather; can be repeated" : "mesh to write; can be repeated");
  table.text({"--format", "Format"}, usage.format, "NAME", "format of the output, if its ending does not determine it");
}

void declareRunOutputs(OptionTable& table, MeshRunUsage& usage) {
  table.section(Section::Output);
  declareParts(table, usage.parts, usage.outputs, usage.format);
  table.output({"--report", "Report"}, usage.report, {.standard_output = true},
               "write a report as JSON; - prints it instead of the summary");
  table.output({"--edits", "Changes to the input"}, usage.edits, {},
               "write the changes made by cleaning and --coast follow, as points with kind, feature and source: a "
               ".gpkg, .geojson or .fgb");
  table.section(Section::Run);
  table.choice({"--progress", "Progress display"}, usage.progress, {"auto", "bar", "log", "json", "none"},
               "progress on stderr: a bar, or a line every ten seconds (auto: a bar on a terminal, otherwise lines); "
               "or JSON lines on stdout");
  table.section(Section::Output);
  table.flag({"--overwrite", "Replace files"}, usage.overwrite, "replace files that exist");
  table
      .flag({"--skip-existing", "Skip existing outputs"}, usage.skip_existing,
            "do nothing if all outputs exist; if any is missing, make and replace all")
      .ignoredWith({"--overwrite"});
  table.section(Section::Run);
  table.flag({"--quiet", "No summary"}, usage.quiet, "print no summary");
}

int runMesh(const MeshRunUsage& usage, Run& run) {
  if (usage.report == "-" && usage.progress == "json")
    throw OptionError("--report - and --progress json both write to standard output: give the report a file");
  MeshJob job = usage.mesh.job;
  const std::vector<std::string> grids = withoutShardFiles(usage.outputs);
  const PartitionOptions partition = partitionFor(usage.parts, grids, usage.format);
  std::tie(job.exchange.shard, job.exchange.shards) = shardOf(usage.shard);
  const bool to_shard = grids.size() < usage.outputs.size(), to_checkpoint = !usage.checkpoint.empty();
  if (to_shard) requireNoStream(job, "gather reads the input of a .shard again");
  if (to_checkpoint) requireNoStream(job, "--checkpoint reads the input again to resume");
  if (to_checkpoint) requireCheckpointApart(usage.checkpoint, run.options);
  MeshUsage of_job;
  const GivenOptions given =
      to_shard || to_checkpoint ? givenOptions(run.options, meshJobOptions(of_job)) : GivenOptions();
  const bool skips = usage.skip_existing && !usage.overwrite;
  if (skips) {
    if (const std::optional<int> code = doneBefore(usage, run, given)) {
      endWithoutMesh(usage, "all outputs exist already");
      return *code;
    }
  }
  const Stopwatch whole;
  RunOutputs outputs(usage.overwrite || skips, run.inputs, run.interrupt);
  outputs.addGrids(grids, usage.format);
  if (const std::string warning = outputs.unknownDepthWarning(job.finish.depth); !warning.empty()) run.warn(warning);
  if (!usage.edits.empty()) requireVectorFormat(usage.edits, 1);
  StagedFiles* const edits = !usage.edits.empty() ? &outputs.addFile(usage.edits) : nullptr;
  std::vector<StagedFiles*> shard_files;
  for (const std::string& path : usage.outputs)
    if (isShardFile(path)) shard_files.push_back(&outputs.addFile(path));
  outputs.addReport(usage.report);
  KeptGroups kept{ShardWriter(given, job.exchange.shard, job.exchange.shards), std::nullopt, to_shard};
  if (to_checkpoint) {
    kept.checkpoint.emplace(usage.checkpoint, checkpointHeader(run, given, job.exchange));
    kept.checkpoint->replaceUnfinished(outputs.unfinished());
  }
  exchangeWith(kept, job.exchange);
  job.keep_edits = edits != nullptr || to_shard || to_checkpoint;  // a later run may write them
  if (run.cluster != nullptr) {
    run.cluster->start(job.parallel.threads);
    job.mesh.helpers = &run.cluster->helpers();
  }
  ProgressDisplay display(ProgressDisplay::styleFor(usage.progress, usage.quiet));
  const JobControl control{
      [&interrupt = run.interrupt, &display] { return interrupt.requested() || display.abandoned(); },
      [&display](std::string_view phase, double share) { display.show(phase, share); },
      [&display](double vertices) {
        display.note("about " + grouped(static_cast<std::uint64_t>(std::min(vertices, 1e18))) +
                     " vertices are expected from these sizes");
      }};
  MeshJobResult result = runKeeping(kept, job, control);
  display.clear();
  for (const std::string& warning : warningsOf(result)) run.warn(warning);
  const bool lacks_memory = std::ranges::any_of(result.refusals, &Refusal::lacks_memory);
  if (lacks_memory && to_checkpoint)
    run.warn("--checkpoint " + usage.checkpoint +
             " is kept: where there is more memory, the same command with --overwrite resumes from it");

  const bool any = result.regions > 0;
  if (any) cutMesh(partition, job, control.cancelled, result);
  const Stopwatch writing;
  if (any) writeMesh(outputs, edits, job, control.cancelled, display, run, result);
  const int code = (any ? result.complete() : result.refusals.empty()) ? kExitDone : kExitShort;
  for (StagedFiles* const file : shard_files) file->write(kept.shard.file(code));
  result.seconds.write = writing.seconds();
  result.seconds.total = whole.seconds();
  outputs.writeReport(meshReport(job, result, threadsAsked(job.parallel), run.warnings));
  // Made before the outputs are in place: nothing that may fail comes after.
  const bool silent = usage.quiet || usage.progress == "json" || usage.report == "-";
  const std::string summary = any && !silent ? summaryOf(usage, job, result) + outputs.openingsText(result.grid) : "";
  outputs.commit();
  if (kept.checkpoint && !lacks_memory) kept.checkpoint->finish();
  // Other shards may have meshes.
  if (!any && to_shard) {
    display.clear();
    endWithoutMesh(usage, "nothing of this shard was meshed");
    return code;
  }
  if (!any) return refuseRun(usage, job, result);

  display.show("done", 1.0);
  display.clear();
  std::fputs(summary.c_str(), stdout);
  if (code == kExitShort && usage.quiet)
    std::fprintf(stderr, "coastmesh: short of what was asked: %s\n", shortfallOf(result).c_str());
  return code;
}

}  // namespace coastmesh
