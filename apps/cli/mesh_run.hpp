#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "apps/cli/commands.hpp"
#include "apps/usage/mesh_usage.hpp"

namespace coastmesh {

// The name of the argument for what is meshed.
inline constexpr const char* kInputs = "INPUT";

// A run that ends with a mesh, of all of the input or of a shard of it, made here or gathered.
struct MeshRunUsage {
  MeshUsage mesh;
  std::vector<std::string> outputs;
  std::string format;
  std::string report;
  std::string edits;
  std::uint64_t parts = 0;
  std::string shard;  // "I/N"; empty: all
  bool per_feature = false;
  std::string name_field;  // of --per-feature; empty: numbers
  std::string checkpoint;  // a folder; empty: nothing is kept
  std::string progress = "auto";
  bool overwrite = false;
  bool skip_existing = false;
  bool quiet = false;
};

// The options that say what a mesh is, and its inputs.
OptionTable meshJobOptions(MeshUsage& usage);

// -o and --format; `with_shards`: .shard files too.
void declareMeshes(OptionTable& table, MeshRunUsage& usage, bool with_shards);
// What else such a run writes, and how.
void declareRunOutputs(OptionTable& table, MeshRunUsage& usage);

// "3/7" as the third of seven, counted from 0; the only one of one where `text` is empty. Throws OptionError.
std::pair<std::uint32_t, std::uint32_t> shardOf(const std::string& text);

// Processes that a launcher has started together do not know of one another's shards: where each is to make one of its
// own, rank (I - 1) modulo their number makes shard I, and none is made twice. Throws OptionError for another.
void requireShardOfThisRank(const std::string& text, const Run& run);

// REQUIRES: `usage.mesh` is settled. Gives an exit code; throws what main turns into messages and codes.
int runMesh(const MeshRunUsage& usage, Run& run);

}  // namespace coastmesh
