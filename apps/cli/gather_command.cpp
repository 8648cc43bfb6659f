#include <memory>

#include "apps/cli/commands.hpp"
#include "apps/cli/mesh_run.hpp"
#include "apps/cli/run_outputs.hpp"
#include "apps/cli/shard_file.hpp"

namespace coastmesh {

namespace {

struct GatherUsage {
  std::vector<std::string> shards;
  MeshRunUsage whole;
};

// Runs the job of the shards, taking their meshes instead of meshing. Later stages run here; so does the meshing of
// groups for which a shard lacked memory.
int runGather(GatherUsage& usage, Run& run) {
  const GatheredShards gathered(usage.shards);
  OptionTable job = meshJobOptions(usage.whole.mesh);
  for (const auto& [name, value] : gathered.options()) job.set(name, value, name);
  settle(usage.whole.mesh);
  requireOutputsApart(run.options, job.inputs());
  for (const auto& [option, path] : job.inputs()) run.inputs.push_back(path);
  GroupExchange& exchange = usage.whole.mesh.job.exchange;
  exchange.begin = [&gathered](std::uint64_t digest, std::size_t groups) { gathered.begin(digest, groups); };
  exchange.has = [&gathered](std::size_t group) { return gathered.has(group); };
  exchange.take = [&gathered](std::size_t group) { return gathered.take(group); };
  return runMesh(usage.whole, run);
}

}  // namespace

Command declareGather(CLI::App& root) {
  auto usage = std::make_shared<GatherUsage>();
  OptionTable table = commandOptions("gather", "Combine the shards of a mesh into the result of a single run");
  table.arguments("SHARD", usage->shards, "all .shard files of a run, in any order; its inputs are read again");
  declareMeshes(table, usage->whole, false);
  declareRunOutputs(table, usage->whole);
  table.section(Section::Run);
  table.integer({"--threads", "Threads"}, usage->whole.mesh.threads, "N", 0, 1024,
                "threads to use, 0 for all cores; does not change the result");
  table.example("coastmesh gather lakes-*.shard -o lakes.nc --report lakes.json", "all lakes, from their shards");
  return {{root, std::move(table)}, [usage](Run& run) { return runGather(*usage, run); }};
}

}  // namespace coastmesh
