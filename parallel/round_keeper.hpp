#pragma once

#include <cstdint>
#include <optional>

#include "core/refine/refine_options.hpp"
#include "core/refine/submesh.hpp"
#include "parallel/partition.hpp"
#include "parallel/region_checkpoint.hpp"

namespace coastmesh {

// Stages of rounds, one after another.
enum class RoundsStage : std::uint8_t { Refine, Coarsen, Optimise };

// Results of rounds besides the mesh.
struct RoundsTally {
  RefineStats stats;            // without `steiner_points` and `unresolved`
  std::uint64_t pieces = 0;     // of the round with the most pieces
  CutTree cuts;                 // of that round
  std::int32_t cut_rounds = 0;  // of this stage; determines the angle of the next cuts
};

// The next round.
struct RoundPlace {
  std::uint32_t step = 0, round = 0;
};

// Saves the mesh of a region after each round, and provides what an earlier run saved, so that its rounds are not
// repeated. The resulting mesh is the same.
class RoundKeeper {
 public:
  // `fingerprint` represents everything that the mesh depends on; `notes` has the surface and the corners, which are
  // not saved. Throws BadCheckpoint if the saved state is damaged or has another fingerprint.
  RoundKeeper(const RegionCheckpoint& checkpoint, std::uint64_t fingerprint, const VertexNotes& notes);

  // True if an earlier run has completed that stage.
  bool isPast(RoundsStage stage) const { return kept_ && kept_->stage > stage; }
  // Begins a stage. Returns the results of the stages before it: `tally`, which is this run's, or those of an earlier
  // run that has reached this stage.
  const RoundsTally& begin(RoundsStage stage, RoundsTally tally);
  // Restores the mesh and the tally that an earlier run saved in this stage, and returns its next round; nullopt if it
  // did not reach the stage. Must be called once for each stage, after `begin`.
  std::optional<RoundPlace> goOn(MeshState& whole, RoundsTally& tally);
  // Saves the state of this stage, with the next round. Throws what the checkpoint throws.
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
  RoundsTally before_;  // before `stage_`
};

}  // namespace coastmesh
