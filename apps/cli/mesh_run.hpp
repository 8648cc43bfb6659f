#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "apps/cli/commands.hpp"
#include "apps/cli/partition_outputs.hpp"
#include "apps/usage/mesh_usage.hpp"

namespace coastmesh {

// The name of the argument for the input.
inline constexpr const char* kInputs = "INPUT";

// A run that ends with a mesh, of all of the input or of a shard of it, made here or gathered.
struct MeshRunUsage {
  MeshUsage mesh;
  std::vector<std::string> outputs;
  std::string format;
  std::string report;
  std::string edits;
  PartsUsage parts;
  std::string shard;  // "I/N"; empty: all
  bool per_feature = false;
  std::string name_field;  // of --per-feature; empty: numbers
  std::string checkpoint;  // a folder; empty: nothing is kept
  std::string progress = "auto";
  bool overwrite = false;
  bool skip_existing = false;
  bool quiet = false;
};

// The options that determine a mesh, and its inputs.
OptionTable meshJobOptions(MeshUsage& usage);

// -o and --format; `with_shards`: .shard files too.
void declareMeshes(OptionTable& table, MeshRunUsage& usage, bool with_shards);
// Other outputs of such a run, and how it is run.
void declareRunOutputs(OptionTable& table, MeshRunUsage& usage);

// "3/7" as (2, 7), counted from 0; (0, 1) if `text` is empty. Throws OptionError.
std::pair<std::uint32_t, std::uint32_t> shardOf(const std::string& text);

// If one launcher has started several processes, each for a shard of its own, rank (I - 1) modulo their number makes
// shard I, so that none is made twice. Throws OptionError on any other rank.
void requireShardOfThisRank(const std::string& text, const Run& run);

// REQUIRES: `usage.mesh` is settled. Returns an exit code; main turns its exceptions into messages and codes.
int runMesh(const MeshRunUsage& usage, Run& run);

}  // namespace coastmesh
