#include "apps/cli/per_feature_run.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <set>
#include <string>
#include <thread>

#include "apps/cli/feature_file_names.hpp"
#include "apps/cli/output_batch.hpp"
#include "apps/cli/partition_outputs.hpp"
#include "apps/cli/run_outputs.hpp"
#include "apps/cli/shard_file.hpp"
#include "apps/input/read_input.hpp"
#include "apps/job/deal_groups.hpp"
#include "apps/job/idle_inputs.hpp"
#include "apps/job/memory_share.hpp"
#include "apps/job/mesh_job.hpp"
#include "apps/job/stopwatch.hpp"
#include "apps/process/exit_codes.hpp"
#include "apps/process/progress.hpp"
#include "apps/report/mesh_warnings.hpp"
#include "apps/report/per_feature_report.hpp"
#include "gis/coast/feature_bounds.hpp"
#include "gis/error.hpp"
#include "gis/for_count.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/geometry/box.hpp"
#include "parallel/available_memory.hpp"
#include "parallel/workers.hpp"

namespace coastmesh {

namespace {

namespace fs = std::filesystem;

constexpr const char* kPlaceOfName = "{}";

std::string named(std::string path, const std::string& name) {
  for (std::size_t at = 0; (at = path.find(kPlaceOfName, at)) != std::string::npos; at += name.size())
    path.replace(at, 2, name);
  return path;
}

// Throws OptionError for options that cannot be combined with --per-feature.
void requirePossible(const MeshRunUsage& usage) {
  const MeshJob& job = usage.mesh.job;
  const FrameOptions& frame = job.input.frame;
  const bool framed = frame.box || frame.water_at || !job.input.clip.empty();
  if (framed || (frame.side != DomainSide::Auto && frame.side != DomainSide::Inside))
    throw OptionError(
        "--per-feature meshes the inside of each feature: leave out --domain, --bbox, --clip and --water-at");
  if (job.input.flood.height_m)
    throw OptionError("--flood-height meshes land between features: leave it out with --per-feature");
  if (job.input.dissolve) throw OptionError("--per-feature and --dissolve: leave out one of them");
  if (!usage.edits.empty()) throw OptionError("--edits applies to a single mesh: leave it out with --per-feature");
  if (!usage.checkpoint.empty())
    throw OptionError("--checkpoint applies to a single mesh: with --per-feature, --skip-existing resumes a run");
  if (usage.report == "-" && usage.progress == "json")
    throw OptionError("--report - and --progress json both write to standard output: give the report a file");
  for (const std::string& file : job.input.files)
    if (fs::path(file).extension() == ".poly")
      throw OptionError("'" + file + "' is a ready plane graph without features: leave out --per-feature");
  for (const std::string& output : usage.outputs) {
    if (isShardFile(output))
      throw OptionError("'" + output + "': --per-feature writes no .shard; gather has nothing to do");
    if (fs::path(output).filename().string().find(kPlaceOfName) == std::string::npos ||
        fs::path(output).parent_path().string().find(kPlaceOfName) != std::string::npos)
      throw OptionError("--output " + output +
                        ": with --per-feature a file name needs {} for the name of each feature, such as lake-{}.nc");
  }
}

// A feature of this run's shard.
struct Planned {
  std::size_t feature = 0;  // in the coastline
  std::size_t points = 0;
  Box box;
  FeatureOutcome outcome;
};

bool isArea(const Feature& feature) { return feature.use == FeatureUse::Area && !feature.polygons.empty(); }

// The features of this run's shard, in the input's order, with names and outputs.
std::vector<Planned> plan(const MeshRunUsage& usage, const Coastline& coastline, const Run& run) {
  std::vector<const Feature*> features;
  std::vector<std::size_t> points, indices;
  for (std::size_t i = 0; i < coastline.features.size(); ++i) {
    const Feature& feature = coastline.features[i];
    if (!isArea(feature)) continue;
    features.push_back(&feature);
    points.push_back(pointsOf(feature));
    indices.push_back(i);
  }
  if (features.empty())
    throw InputError("no feature of the input has an area to mesh: --per-feature takes polygons and closed lines");
  const std::vector<std::string> names = namesOfFeatures(features, usage.name_field);
  const auto [shard, shards] = shardOf(usage.shard);
  const std::vector<std::uint32_t> shard_of = dealGroups(points, shards);
  std::vector<Planned> planned;
  std::vector<OptionTable::NamedOutput> files;
  for (std::size_t f = 0; f < features.size(); ++f) {
    if (shard_of[f] != shard) continue;
    Planned one{indices[f], points[f], boundsOf(*features[f]), {}};
    one.outcome.name = names[f];
    one.outcome.source = features[f]->source;
    one.outcome.fid = features[f]->fid;
    for (const std::string& output : usage.outputs) {
      const std::string path = named(output, names[f]);
      one.outcome.outputs.push_back(path);
      files.push_back({"--output", path, filesOf(gridFormatFor(path, usage.format), path)});
    }
    if (usage.skip_existing && !usage.overwrite && std::ranges::all_of(one.outcome.outputs, isMade))
      one.outcome.state = FeatureState::Skipped;
    planned.push_back(std::move(one));
  }
  std::vector<OptionTable::NamedOutput> all = files;
  if (!usage.report.empty() && usage.report != "-") all.push_back({"--report", usage.report, {{usage.report}, {}, {}}});
  requireOutputsApart(all, run.options.inputs());
  if (!usage.overwrite && !usage.skip_existing)
    for (const OptionTable::NamedOutput& output : files)
      for (const std::string& file : output.files.targets)
        if (std::error_code error; fs::exists(file, error))
          throw OutputError("'" + file + "' exists; give --overwrite, or --skip-existing to go on");
  return planned;
}

// Features that are not meshed themselves: constraints, regions, lines with boundary types.
struct Beside {
  std::vector<std::size_t> indices;
  std::vector<Box> boxes;
};

Beside besideAreas(const Coastline& coastline) {
  Beside beside;
  for (std::size_t i = 0; i < coastline.features.size(); ++i) {
    if (isArea(coastline.features[i])) continue;
    beside.indices.push_back(i);
    beside.boxes.push_back(boundsOf(coastline.features[i]));
  }
  return beside;
}

// The feature alone, with those beside it that may affect it, in the input's order.
std::shared_ptr<const Coastline> alone(const Coastline& all, const Beside& beside, const Planned& one) {
  std::vector<std::size_t> members{one.feature};
  for (std::size_t b = 0; b < beside.indices.size(); ++b)
    if (meetAtAnyTurn(beside.boxes[b], one.box, all.crs)) members.push_back(beside.indices[b]);
  std::ranges::sort(members);
  auto coastline = std::make_shared<Coastline>();
  coastline->crs = all.crs;
  for (const std::size_t member : members) coastline->features.push_back(all.features[member]);
  return coastline;
}

// Combined progress of all features, weighted by their points.
class Shares {
 public:
  Shares(const std::vector<Planned>& planned, ProgressDisplay& display) : shares_(planned.size()), display_(display) {
    for (const Planned& one : planned) weights_.push_back(one.points);
    total_ = std::max(1.0, static_cast<double>(std::accumulate(weights_.begin(), weights_.end(), std::size_t{0})));
  }
  void report(std::size_t i, double share) {
    const std::lock_guard lock(mutex_);
    if (!(share > shares_[i])) return;
    done_ += (share - shares_[i]) * static_cast<double>(weights_[i]);
    shares_[i] = share;
    display_.show("refine", std::min(1.0, done_ / total_));
  }

 private:
  std::vector<std::size_t> weights_;
  std::vector<double> shares_;
  ProgressDisplay& display_;
  std::mutex mutex_;
  double total_ = 1.0, done_ = 0.0;
};

// True if the jobs read files: then they cannot run at the same time.
bool readsFiles(const MeshJob& job) {
  return !job.finish.depth.files.empty() || !job.finish.fields.empty() || !job.sizes.rasters.empty() ||
         !job.sizes.bathymetry.empty();
}

// Texts that some features have, each with the number of these.
class CountedTexts {
 public:
  void add(const std::vector<std::string>& texts) {
    for (const std::string& text : std::set<std::string>(texts.begin(), texts.end())) ++counts_[text];
  }
  std::vector<std::string> ofAll(std::size_t features) const {
    std::vector<std::string> texts;
    for (const auto& [text, count] : counts_)
      if (count == features) texts.push_back(text);
    return texts;
  }
  bool isOfAll(const std::string& text, std::size_t features) const {
    const auto found = counts_.find(text);
    return found != counts_.end() && found->second == features;
  }

 private:
  std::map<std::string, std::size_t> counts_;
};

// Meshes and writes features; may be called from several threads, for different features.
class Maker {
 public:
  Maker(const MeshRunUsage& usage, const Coastline& coastline, const MeshJob& job, const PartitionOptions& partition,
        Run& run, Shares& shares, std::function<bool()> cancelled)
      : usage_(usage),
        coastline_(coastline),
        beside_(besideAreas(coastline)),
        job_(job),
        partition_(partition),
        run_(run),
        shares_(shares),
        cancelled_(std::move(cancelled)) {}

  // `memory`: bytes that it may take. Returns false if it lacks memory, unless `in_the_end`: then the feature is
  // refused.
  bool make(std::size_t i, Planned& one, double memory, bool in_the_end) {
    FeatureOutcome& outcome = one.outcome;
    MeshJob job = job_;
    job.memory = memory;
    job.input.ready = alone(coastline_, beside_, one);
    const JobControl control{cancelled_, [this, i](std::string_view phase, double share) {
                               if (phase == "refine") shares_.report(i, share);
                             }};
    try {
      MeshJobResult result = runMeshJobHere(job, control);
      if (!in_the_end && std::ranges::any_of(result.refusals, &Refusal::lacks_memory)) return false;
      takeRefusalsOfOthers(*job.input.ready, outcome, result);
      if (result.regions == 0) {
        outcome.state = FeatureState::Refused;
        outcome.reason = result.refusals.empty() ? result.last_unwanted : result.refusals.front().reason;
        outcome.over_budget = !result.refusals.empty() && result.refusals.front().over_budget;
      } else {
        noteIdle(result);
        outcome.notes = std::move(result.read.notes);
        std::ranges::move(result.finish.depth.notes, std::back_inserter(outcome.notes));
        outcome.warnings = warningsOf(result);
        write(outcome, result);
        outcome.state = result.complete() ? FeatureState::Made : FeatureState::Short;
        outcome.quality = result.quality;
        outcome.digest = result.digest;
      }
    } catch (const InputError& error) {
      outcome.state = FeatureState::Refused;
      outcome.reason = error.what();
    }
    shares_.report(i, 1.0);
    return true;
  }

  // Moves into place what still waits for that. To be called after the last `make`.
  void finish() {
    const std::lock_guard lock(mutex_);
    batch_.commit();
  }

  // Warnings for inputs that have no effect on any feature that was meshed, and for openings and rivers that none has.
  std::vector<std::string> idleInputs() const {
    std::vector<std::string> warnings = idle_inputs_.ofAll(meshed_);
    for (const auto& [line, reason] : refused_lines_)
      if (!used_lines_.contains(line)) warnings.push_back("left out: " + reason);
    std::set<std::string> idle_files;
    for (const auto& [file, idle] : idle_boundaries_) {
      if (idle.features != meshed_) continue;
      warnings.push_back(idle.warning);
      idle_files.insert(job_.finish.boundaries.files[file]);
    }
    for (const auto& [file, of_file] : missed_) {
      MissedOfFile missed{file, idle_files.contains(file), {}};
      for (const auto& [rule, each] : of_file)
        if (each.features == meshed_) missed.missed.push_back(each.missed);
      std::ranges::move(missedWarnings(missed), std::back_inserter(warnings));
    }
    return warnings;
  }
  // Notes on such inputs.
  std::vector<std::string> idleNotes() const { return idle_notes_.ofAll(meshed_); }

 private:
  struct IdleFile {
    std::size_t features = 0;  // in which it sets none
    std::string warning;
  };

  struct Missed {
    std::size_t features = 0;  // that do not have it
    MissedRule missed;
  };

  // Open lines beside a feature are refused where it does not hold them; another may.
  void takeRefusalsOfOthers(const Coastline& coastline, const FeatureOutcome& own, MeshJobResult& result) {
    const auto isOfOthers = [&](const Refusal& refusal) {
      return refusal.source != own.source || std::ranges::find(refusal.fids, own.fid) == refusal.fids.end();
    };
    const std::lock_guard lock(mutex_);
    for (const Refusal& refusal : result.refusals)
      if (isOfOthers(refusal))
        for (const std::int64_t fid : refusal.fids) refused_lines_.try_emplace({refusal.source, fid}, refusal.reason);
    for (const std::uint32_t f : result.took_part)
      used_lines_.emplace(coastline.features[f].source, coastline.features[f].fid);
    std::erase_if(result.refusals, isOfOthers);
  }

  // An input, or an opening in it, that has no effect on this feature may have one on another.
  void noteIdle(MeshJobResult& result) {
    std::vector<std::string> notes;
    for (const auto& [text, regions] : result.idle) notes.push_back(text);
    BoundaryReport& boundaries = result.finish.boundaries;
    const std::lock_guard lock(mutex_);
    ++meshed_;
    idle_inputs_.add(result.idle_inputs);
    idle_notes_.add(notes);
    for (std::size_t i = 0; i < boundaries.idle_files.size(); ++i) {
      IdleFile& idle = idle_boundaries_[boundaries.idle_files[i]];
      ++idle.features;
      idle.warning = boundaries.warnings[i];
    }
    boundaries.warnings.erase(boundaries.warnings.begin(),
                              boundaries.warnings.begin() + static_cast<std::ptrdiff_t>(boundaries.idle_files.size()));
    for (MissedOfFile& file : boundaries.missed) {
      for (const MissedRule& missed : file.missed) {
        if (!missed.whole) continue;
        Missed& noted = missed_[file.file][missed.rule];
        if (noted.features++ == 0 || (missed.inside && !noted.missed.inside)) noted.missed = missed;
      }
      std::erase_if(file.missed, &MissedRule::whole);
    }
  }

  // One feature at a time: format libraries and the partitioner are not thread-safe. Nothing in here may run in
  // parallel, or this thread might begin another feature while it holds the lock.
  void write(FeatureOutcome& outcome, MeshJobResult& result) {
    const std::lock_guard lock(mutex_);
    run_.interrupt.check();
    if (cancelled_()) throw Cancelled();
    result.partition = partitionGrid(result.grid, partition_, inOrder);
    auto outputs = std::make_unique<RunOutputs>(usage_.overwrite || usage_.skip_existing, run_.inputs, run_.interrupt);
    outputs->addGrids(outcome.outputs, usage_.format);
    const std::vector<std::string> losses = outputs->lossWarnings(result.grid, LossesOf::Input);
    outcome.warnings.insert(outcome.warnings.end(), losses.begin(), losses.end());
    const std::vector<std::string> numbers = outputs->numberWarnings(result.grid);
    outcome.warnings.insert(outcome.warnings.end(), numbers.begin(), numbers.end());
    for (std::size_t g = 0; g < outputs->grids(); ++g) outputs->writeGrid(g, result.grid, inOrder);
    batch_.add(std::move(outputs));
  }

  const MeshRunUsage& usage_;
  const Coastline& coastline_;
  Beside beside_;
  const MeshJob& job_;
  const PartitionOptions& partition_;
  Run& run_;
  Shares& shares_;
  std::function<bool()> cancelled_;
  std::mutex mutex_;
  OutputBatch batch_;
  std::size_t meshed_ = 0;
  CountedTexts idle_inputs_, idle_notes_;
  std::map<std::pair<std::string, std::int64_t>, std::string> refused_lines_;  // by source and number
  std::set<std::pair<std::string, std::int64_t>> used_lines_;
  std::map<std::size_t, IdleFile> idle_boundaries_;
  std::map<std::string, std::map<std::uint32_t, Missed>> missed_;  // by file and rule
};

// Returns the number of threads.
int makeAll(const MeshJob& job, std::vector<Planned>& planned, Maker& maker, const std::function<bool()>& cancelled) {
  std::vector<std::size_t> order;  // largest first
  for (std::size_t i = 0; i < planned.size(); ++i)
    if (planned[i].outcome.state != FeatureState::Skipped) order.push_back(i);
  std::ranges::stable_sort(order, std::greater(), [&planned](std::size_t i) { return planned[i].points; });
  int threads = 1;
  const double memory = availableMemory();
  const auto makeEach = [&] {
    threads = threadCount();
    if (readsFiles(job)) {
      for (const std::size_t i : order) maker.make(i, planned[i], memory, true);
      return;
    }
    Together together{order.size(), 0, static_cast<std::size_t>(threads)};
    for (const std::size_t i : order) together.points += planned[i].points;
    // Features that need more than their share of the memory are meshed afterwards, one by one.
    std::vector<char> done(order.size(), false);
    forEachItem(order.size(), RunControl{cancelled, {}}, [&](std::size_t at) {
      Planned& one = planned[order[at]];
      done[at] = maker.make(order[at], one, memoryShare(memory, one.points, together), order.size() == 1);
    });
    for (std::size_t at = 0; at < order.size(); ++at)
      if (!done[at]) maker.make(order[at], planned[order[at]], memory, true);
  };
  try {
    withThreads(job.parallel, makeEach);
  } catch (const OutputError&) {
    try {
      maker.finish();
    } catch (const OutputError&) {
      // The first error is the one to report.
    }
    throw;
  }
  maker.finish();
  return threads;
}

void warnOf(const std::vector<FeatureOutcome>& features, Run& run) {
  constexpr std::size_t kShown = 20;
  std::size_t left = 0, shown = 0;
  const auto warn = [&](const std::string& text) {
    if (shown < kShown) run.warn(text);
    left += shown >= kShown;
    ++shown;
  };
  for (const FeatureOutcome& feature : features) {
    if (feature.state == FeatureState::Refused) warn("left out: " + feature.reason);
    for (const std::string& text : feature.warnings) warn(feature.name + ": " + text);
  }
  if (left > 0)
    run.warn(std::to_string(left) + forCount(left, " more warning of a feature is", " more warnings of features are") +
             " not shown");
}

// Notes that all features have, once, then the others with their feature.
std::vector<std::string> notesOf(const std::vector<FeatureOutcome>& features, const MeshJob& job) {
  CountedTexts counted;
  std::vector<const FeatureOutcome*> meshed;
  for (const FeatureOutcome& feature : features) {
    if (!isMeshed(feature)) continue;
    meshed.push_back(&feature);
    counted.add(feature.notes);
  }
  if (meshed.empty()) return job.notes;
  std::vector<std::string> shared, own;
  for (const FeatureOutcome* feature : meshed) {
    for (const std::string& note : feature->notes) {
      const bool is_shared = counted.isOfAll(note, meshed.size());
      if (!is_shared) own.push_back(feature->name + ": " + note);
      if (is_shared && feature == meshed.front()) shared.push_back(note);
    }
  }
  std::ranges::move(own, std::back_inserter(shared));
  return shared;
}

int exitCodeOf(const FeatureSums& sums) {
  if (sums.refused > sums.over_budget && sums.meshed() + sums.skipped == 0) return kExitInput;
  return sums.refused + sums.short_of > 0 ? kExitShort : kExitDone;
}

}  // namespace

void declarePerFeature(OptionTable& table, MeshRunUsage& usage) {
  table.section(Section::Output);
  table.flag({"--per-feature", "One mesh per feature"}, usage.per_feature,
             "mesh each feature on its own, into its own files: {} in output names, such as lake-{}.nc, is replaced by "
             "the feature's number or its --name-field. A feature that cannot be meshed is left out, with exit code 1; "
             "with --skip-existing existing files are kept, with --shard only a share of them is made");
  table
      .text({"--name-field", "Attribute with names"}, usage.name_field, "NAME",
            "attribute that replaces {}, made safe for file names; a feature without a value uses its number")
      .needs({"--per-feature"});
}

int runPerFeature(const MeshRunUsage& usage, Run& run) {
  requirePossible(usage);
  const PartitionOptions partition = partitionFor(usage.parts, usage.outputs, usage.format);
  const Stopwatch whole;
  ProgressDisplay display(ProgressDisplay::styleFor(usage.progress, usage.quiet));
  const Interrupt& interrupt = run.interrupt;
  const auto cancelled = [&interrupt, &display] { return interrupt.requested() || display.abandoned(); };
  // First of all: nothing is meshed if the report cannot be written.
  RunOutputs report(usage.overwrite || usage.skip_existing, run.inputs, run.interrupt);
  report.addReport(usage.report);
  ReadReport read;
  PerFeatureTimes seconds;
  display.show("read", 0.0);
  MeshJob job = usage.mesh.job;
  BoundaryOptions& boundaries = job.finish.boundaries;
  const Coastline coastline = readInput(job.input, read, boundaries.of_input);
  requireUnmirrored(coastline, job.input);
  std::vector<Planned> planned = plan(usage, coastline, run);
  boundaries.of_files = readBoundaryFiles(boundaries);
  job.size_layers = std::make_shared<const SizeLayers>(readSizeLayers(job.sizes, coastline.crs));
  std::ranges::move(warningsOfPolygons(job.input, coastline), std::back_inserter(read.warnings));
  leaveOutPolygonFiles(job.input, coastline);
  seconds.read = whole.seconds();
  run.interrupt.check();
  display.show("read", 1.0);

  Shares shares(planned, display);
  Maker maker(usage, coastline, job, partition, run, shares, cancelled);
  const int threads = makeAll(job, planned, maker, cancelled);
  display.clear();

  std::vector<FeatureOutcome> features;
  for (Planned& one : planned) features.push_back(std::move(one.outcome));
  for (const std::string& warning : read.warnings) run.warn(warning);
  // Only for a run of all features: a file may have an effect on others.
  const bool skips =
      std::ranges::any_of(features, [](const FeatureOutcome& f) { return f.state == FeatureState::Skipped; });
  const bool all = shardOf(usage.shard).second == 1 && !skips;
  for (const std::string& warning : all ? maker.idleInputs() : std::vector<std::string>{}) run.warn(warning);
  warnOf(features, run);
  std::ranges::move(notesOf(features, job), std::back_inserter(read.notes));
  if (all) std::ranges::move(maker.idleNotes(), std::back_inserter(read.notes));
  seconds.total = whole.seconds();
  report.writeReport(perFeatureReport(job.input.files, read, coastline.crs, features, run.warnings, seconds, threads));
  const FeatureSums sums = sumsOf(features);
  report.commit();
  const int code = exitCodeOf(sums);
  if (code == kExitInput) {
    throw InputError(features.size() == 1
                         ? features.front().reason
                         : "none of the " + std::to_string(features.size()) + " features can be meshed");
  }
  display.show("done", 1.0);
  display.clear();
  if (!usage.quiet && usage.progress != "json" && usage.report != "-")
    std::fputs((perFeatureSummary(features, seconds.total) + shownNotes(read.notes) +
                (usage.report.empty() ? "" : "wrote " + usage.report + "\n"))
                   .c_str(),
               stdout);
  return code;
}

}  // namespace coastmesh
