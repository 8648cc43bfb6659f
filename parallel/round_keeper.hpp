#pragma once

#include <cstdint>
#include <optional>

#include "core/refine/refine_options.hpp"
#include "core/refine/submesh.hpp"
#include "parallel/partition.hpp"
#include "parallel/region_checkpoint.hpp"

namespace coastmesh {

// Runs of rounds, one after another.
enum class RoundsStage : std::uint8_t { Refine, Coarsen, Optimise };

// What rounds have done, besides the mesh.
struct RoundsTally {
  RefineStats stats;            // without `steiner_points` and `unresolved`
  std::uint64_t pieces = 0;     // of the round that was cut into the most
  CutTree cuts;                 // of that round
  std::int32_t cut_rounds = 0;  // of this run; the angle of the next cuts hangs on it
};

// The round that comes next.
struct RoundPlace {
  std::uint32_t step = 0, round = 0;
};

// Keeps the mesh of a region after each round; and knows what an earlier run kept, so that its rounds are not done
// again. The mesh that comes of it is the same.
class RoundKeeper {
 public:
  // `fingerprint` stands for all that the mesh depends on; `notes` has the surface and the corners, which are not kept.
  // Throws BadCheckpoint where what was kept is of another fingerprint.
  RoundKeeper(const RegionCheckpoint& checkpoint, std::uint64_t fingerprint, const VertexNotes& notes);

  // Whether an earlier run has done all of that stage.
  bool isPast(RoundsStage stage) const { return kept_ && kept_->stage > stage; }
  // What the stages before that one did, of which `tally` is known here; more is where an earlier run did them.
  const RoundsTally& begin(RoundsStage stage, RoundsTally tally);
  // Where an earlier run was in this stage, with the mesh and the tally as they were then; none where it did not come
  // to the stage. To be called once a stage, after `begin`.
  std::optional<RoundPlace> goOn(MeshState& whole, RoundsTally& tally);
  // Keeps what this stage has come to, with the round that comes next. Throws what the checkpoint throws.
  void keep(const RoundPlace& next, const MeshState& whole, const RoundsTally& tally) const;

 private:
  struct Kept {
    RoundsStage stage = RoundsStage::Refine;
    RoundPlace next;
    RoundsTally before, tally;
    MeshState whole;
  };

  const RegionCheckpoint& checkpoint_;
  std::uint64_t fingerprint_;
  std::optional<Kept> kept_;
  RoundsStage stage_ = RoundsStage::Refine;
  RoundsTally before_;  // this stage
};

}  // namespace coastmesh
