#include "parallel/round_keeper.hpp"

#include <type_traits>
#include <utility>

#include "parallel/bytes.hpp"

namespace coastmesh {

template <>
struct HasNoGaps<Triangle> : std::true_type {};
static_assert(sizeof(Triangle) == 9 * sizeof(std::uint32_t));

// Found by argument-dependent lookup from `pass`.
auto partsOf(auto& node) requires std::is_same_v<std::remove_cvref_t<decltype(node)>, CutTree::Node> {
  auto& [axis, cut, below, piece, leaf] = node;
  return std::tie(axis, cut, below, piece, leaf);
}
auto partsOf(auto& tree) requires std::is_same_v<std::remove_cvref_t<decltype(tree)>, CutTree> {
  auto& [cosine, sine, nodes] = tree;
  return std::tie(cosine, sine, nodes);
}
auto partsOf(auto& tally) requires std::is_same_v<std::remove_cvref_t<decltype(tally)>, RoundsTally> {
  auto& [stats, pieces, cuts, cut_rounds] = tally;
  return std::tie(stats, pieces, cuts, cut_rounds);
}
auto partsOf(auto& place) requires std::is_same_v<std::remove_cvref_t<decltype(place)>, RoundPlace> {
  auto& [step, round] = place;
  return std::tie(step, round);
}
// All members except the surface and the corners, which are not saved, and flags: see `passFlags`.
auto partsOf(auto& state) requires std::is_same_v<std::remove_cvref_t<decltype(state)>, MeshState> {
  auto& [mesh, notes, due_triangles, due_vertices] = state;
  return std::tie(mesh.input_vertices, mesh.points, mesh.triangles, mesh.regions, notes.spacing, notes.shell_unit,
                  due_triangles, due_vertices);
}

RoundKeeper::RoundKeeper(const RegionCheckpoint& checkpoint, std::uint64_t fingerprint, const VertexNotes& notes)
    : checkpoint_(checkpoint), fingerprint_(fingerprint) {
  checkpoint.restore([&](std::string_view bytes) {
    BasicByteReader<BadCheckpoint> reader(bytes, "what was kept of the rounds");
    std::uint64_t of = 0;
    reader.pass(of);
    if (of != fingerprint) throw BadCheckpoint("what was kept is of another input, or of other options");
    Kept kept;
    bool curved = false, with_corners = false;
    reader.pass(kept.stage);
    reader.pass(kept.next);
    reader.pass(kept.before);
    reader.pass(kept.tally);
    reader.pass(kept.whole);
    reader.passFlags(kept.whole.notes.small_angle);
    reader.pass(curved);
    reader.pass(with_corners);
    if (!reader.atEnd()) throw BadCheckpoint("what was kept of the rounds is longer than it should be");
    if (curved) kept.whole.notes.surface = notes.surface;
    if (with_corners) kept.whole.notes.corners = notes.corners;
    kept_ = std::move(kept);
  });
}

const RoundsTally& RoundKeeper::begin(RoundsStage stage, RoundsTally tally) {
  stage_ = stage;
  before_ = kept_ && kept_->stage == stage ? std::move(kept_->before) : std::move(tally);
  return before_;
}

std::optional<RoundPlace> RoundKeeper::goOn(MeshState& whole, RoundsTally& tally) {
  if (!kept_ || kept_->stage != stage_) return std::nullopt;
  whole = std::move(kept_->whole);
  tally = std::move(kept_->tally);
  const RoundPlace next = kept_->next;
  kept_.reset();
  return next;
}

void RoundKeeper::keep(const RoundPlace& next, const MeshState& whole, const RoundsTally& tally) const {
  checkpoint_.keep([&](const RegionCheckpoint::Put& put) {
    BasicByteWriter<PutSink> writer({&put});
    writer.pass(fingerprint_);
    writer.pass(stage_);
    writer.pass(next);
    writer.pass(before_);
    writer.pass(tally);
    writer.pass(whole);
    writer.passFlags(whole.notes.small_angle);
    writer.pass(whole.notes.surface.isCurved());
    writer.pass(whole.notes.corners != nullptr);
  });
}

}  // namespace coastmesh
