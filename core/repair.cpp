#include "core/repair.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/local_patch.hpp"

namespace coastmesh {

namespace {

struct Attempt {
  bool strip;  // start without the patch's free vertices
  RefineVariant variant;
};

// What differs is where points aim and which triangle comes first: small changes lead a spiral elsewhere.
constexpr std::array kAttempts = {
    Attempt{false, {0.5, false, 0.0}}, Attempt{true, {0.0, false, 0.0}}, Attempt{true, {0.5, false, 0.0}},
    Attempt{true, {1.0, false, 0.0}},  Attempt{true, {2.0, false, 0.0}}, Attempt{true, {4.0, false, 0.0}},
    Attempt{true, {0.0, true, 0.0}},   Attempt{true, {1.0, true, 0.0}},  Attempt{true, {3.0, true, 0.0}},
    Attempt{true, {6.0, false, 0.0}},  Attempt{true, {1.5, false, 0.0}}, Attempt{true, {3.0, false, 0.0}},
    Attempt{true, {8.0, false, 0.0}},  Attempt{true, {2.0, true, 0.0}},  Attempt{true, {4.5, true, 0.0}},
};
// As many compete; the rest is for where they fail.
constexpr std::size_t kUsualAttempts = 10;
constexpr std::array kRings = {2u, 3u, 4u, 6u};
// A patch may grow to this many times its vertices, and some.
constexpr std::uint64_t kGrowth = 2;
constexpr std::uint64_t kGrowthRoom = 12;

// Vertices that local runs may handle in vain: a share of the mesh, and some for small ones; at angles that no input has
// reached, a third.
std::uint64_t mostWork(double min_angle_deg, std::uint64_t vertices) {
  return (6000 + 3 * vertices) / (min_angle_deg > 43.0 ? 3 : 1);
}
// Vertices that local runs may handle with success, as a multiple of those in vain: each time fewer triangles fall short.
std::uint64_t timesAsMuch(double min_angle_deg) { return min_angle_deg > 43.0 ? 2 : 10; }
// Past so many failures, and twice the successes, the bound is out of reach; at angles that no input has reached, sooner.
std::uint64_t hopeless(double min_angle_deg) { return min_angle_deg > 43.0 ? 4 : 24; }

std::size_t countShort(const Refiner& refiner) {
  std::size_t count = 0;
  for (TriId t = 0; t < refiner.mesh().triangleSlots(); ++t) count += refiner.mesh().isLive(t) && refiner.isShort(t);
  return count;
}

struct Solution {
  std::size_t short_triangles = 0;
  TriMesh mesh;

  bool isBetterThan(const Solution& other) const {
    return std::pair(short_triangles, mesh.points.size()) < std::pair(other.short_triangles, other.mesh.points.size());
  }
};

// Answers nothing where more than `most` triangles fall short, or no fewer than before.
std::optional<Solution> solve(const LocalPatch& patch, const Attempt& attempt, std::size_t most, const Pslg& pslg,
                              const RefineOptions& options, std::uint64_t& work) {
  RefineOptions local = options;
  local.max_vertices = patch.parent.size() * kGrowth + kGrowthRoom;
  Refiner refiner(TriMesh(patch.mesh), pslg, local, VertexNotes(patch.notes), attempt.variant);
  const std::size_t before = countShort(refiner);
  if (attempt.strip) refiner.stripFreeVertices();
  refiner.run({});
  refiner.growFans(Refiner::Beyond::GetsMended, {});
  work += refiner.mesh().vertexSlots();
  if (refiner.stats().budget_reached) return std::nullopt;
  const std::size_t left = countShort(refiner);
  if (left >= before || left > most) return std::nullopt;
  return Solution{left, refiner.release()};
}

std::optional<Solution> solveBest(const LocalPatch& patch, std::size_t most, const Pslg& pslg,
                                  const RefineOptions& options, std::uint64_t& work) {
  std::optional<Solution> best;
  const auto isMended = [&] { return best && best->short_triangles == 0; };
  for (std::size_t i = 0; i < kAttempts.size() && !(isMended() && i >= kUsualAttempts); ++i) {
    std::optional<Solution> solved = solve(patch, kAttempts[i], most, pslg, options, work);
    if (solved && (!best || solved->isBetterThan(*best))) best = std::move(solved);
  }
  return best;
}

enum class Outcome { Mended, Failed, Deferred };

// Whether the mesh is a part of a larger one and the patch lies at its frozen rim.
bool isAtFrozenRim(const EditMesh& mesh, const LocalPatch& patch) {
  return std::ranges::any_of(patch.triangles, [&](TriId t) {
    return std::ranges::find(mesh.triangle(t).seg, kFrozen) != mesh.triangle(t).seg.end();
  });
}

// Puts a solution in; what it pushes beyond its patch is handled at once where nothing in it falls short.
void take(Refiner& refiner, const LocalPatch& patch, const Solution& solution, const RunControl& control) {
  std::vector<VertexId> added;
  std::vector<TriId> touched;
  putBack(refiner.mesh(), patch, solution.mesh, added, touched);
  for (const VertexId v : added) {
    double spacing = std::numeric_limits<double>::infinity();
    for (VertexId f = 0; f < patch.parent.size(); ++f)
      spacing = std::min(spacing, patch.notes.spacing[f] + distance(patch.mesh.points[f], refiner.mesh().point(v)));
    refiner.noteVertex(v, spacing);
  }
  refiner.mesh().restoreDelaunay(touched);
  if (solution.short_triangles > 0) return;
  std::erase_if(touched, [&](TriId t) { return !refiner.mesh().isLive(t) || !refiner.isShort(t); });
  refiner.resume(touched, control);
}

// Takes the first patch that can be mended wholly, or else the one in which the fewest triangles fall short.
Outcome mendPlace(Refiner& refiner, std::span<const TriId> centre, const Pslg& pslg, const RefineOptions& options,
                  const RunControl& control, std::uint64_t& work) {
  std::optional<Solution> best;
  LocalPatch best_patch;
  for (const unsigned rings : kRings) {
    LocalPatch patch = extractPatch(refiner.mesh(), refiner.notes(), centre, rings);
    if (refiner.isClearOfFrozen() && isAtFrozenRim(refiner.mesh(), patch)) {
      if (best) break;
      refiner.defer(centre.back());
      return Outcome::Deferred;
    }
    // In a piece another round may mend wholly what this one cannot; not so at an input angle.
    const bool all_or_none =
        refiner.isClearOfFrozen() && std::ranges::find(patch.notes.small_angle, true) == patch.notes.small_angle.end();
    const std::size_t most = all_or_none ? 0 : std::numeric_limits<std::size_t>::max();
    std::optional<Solution> solved = solveBest(patch, most, pslg, options, work);
    if (!solved || (best && solved->short_triangles >= best->short_triangles)) continue;
    best = std::move(solved);
    best_patch = std::move(patch);
    if (best->short_triangles == 0) break;
  }
  if (!best) return Outcome::Failed;
  if (refiner.mesh().vertexCount() + best->mesh.points.size() - best_patch.parent.size() > options.max_vertices) {
    refiner.stats().budget_reached = true;
    return Outcome::Failed;
  }
  take(refiner, best_patch, *best, control);
  return Outcome::Mended;
}

// Strips at input angles that fall short, with water beyond their sides: as wholes, since what mends one side breaks the other.
void repairStrips(Refiner& refiner, const Pslg& pslg, const RefineOptions& options, const RunControl& control,
                  const auto& isGivenUp) {
  constexpr std::size_t kLongestStrip = 500;
  const std::uint64_t most_work = mostWork(options.min_angle_deg, refiner.mesh().vertexCount());
  std::uint64_t work = 0;
  const TriId slots = refiner.mesh().triangleSlots();
  for (TriId t = 0; t < slots && work <= most_work && !refiner.stats().budget_reached; ++t) {
    const std::vector<TriId> strip = refiner.shortStrip(t);
    if (strip.empty() || strip.size() > kLongestStrip || isGivenUp(strip.back())) continue;
    control.checkpoint(1.0);
    mendPlace(refiner, strip, pslg, options, control, work);
  }
}

}  // namespace

void repair(Refiner& refiner, const Pslg& pslg, const RefineOptions& options, const RunControl& control,
            std::span<const BadTriangle> given_up) {
  const auto isGivenUp = [&](TriId t) {
    const auto known = std::ranges::lower_bound(given_up, t, {}, &BadTriangle::triangle);
    return known != given_up.end() && known->triangle == t && known->corners == refiner.mesh().triangle(t).v;
  };
  repairStrips(refiner, pslg, options, control, isGivenUp);
  const std::uint64_t most_work = mostWork(options.min_angle_deg, refiner.mesh().vertexCount());
  std::uint64_t well_spent = 0, wasted = 0, successes = 0, failures = 0;
  // Where mending has failed the triangles beside wait for the next round.
  std::vector<bool> in_vain;
  const auto isInVain = [&](TriId t) {
    return std::ranges::all_of(refiner.mesh().triangle(t).v,
                               [&](VertexId v) { return v < in_vain.size() && in_vain[v]; });
  };
  const auto giveUp = [&](TriId t) {
    in_vain.resize(refiner.mesh().vertexSlots(), false);
    for (const TriId near : trianglesAround(refiner.mesh(), {&t, 1}, 1))
      for (const VertexId v : refiner.mesh().triangle(near).v) in_vain[v] = true;
  };
  // What a repair pushes beyond its patch is met on the next round.
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    bool again = false;
    in_vain.clear();
    const TriId slots = refiner.mesh().triangleSlots();
    for (TriId k = 0; k < slots; ++k) {
      // There and back: of a few beside one another another comes first, which makes another patch.
      const TriId t = round % 2 == 0 ? k : slots - 1 - k;
      if (!refiner.mesh().isLive(t) || !refiner.isShort(t) || isGivenUp(t)) continue;
      if (refiner.isDeferred(t)) continue;
      if (isInVain(t)) {
        again = true;
        continue;
      }
      if (wasted > most_work || well_spent > timesAsMuch(options.min_angle_deg) * most_work ||
          refiner.stats().budget_reached)
        return;
      control.checkpoint(1.0);
      std::uint64_t work = 0;
      const Outcome outcome = mendPlace(refiner, {&t, 1}, pslg, options, control, work);
      (outcome == Outcome::Mended ? well_spent : wasted) += work;
      if (outcome == Outcome::Deferred) continue;
      if (outcome == Outcome::Failed) giveUp(t);
      again |= outcome == Outcome::Mended;
      ++(outcome == Outcome::Mended ? successes : failures);
      if (failures > hopeless(options.min_angle_deg) + 2 * successes) return;
    }
    if (!again) return;
  }
}

}  // namespace coastmesh
