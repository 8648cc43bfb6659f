#include "core/refine/repair.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/refine/submesh.hpp"

namespace coastmesh {

namespace {

struct Attempt {
  bool strip = true;  // start without the patch's free vertices
  RefineVariant variant;
};

// What differs is where points aim and which triangle comes first: a small change leads the order of insertions
// elsewhere. The first are all tried, and the smallest mesh without a bad triangle wins.
constexpr std::array kCompeting = {
    Attempt{.strip = false, .variant = {.aim_deg = 0.5}},
    Attempt{.variant = {.aim_deg = 0.0}},
    Attempt{.variant = {.aim_deg = 0.5}},
    Attempt{.variant = {.aim_deg = 1.0}},
    Attempt{.variant = {.aim_deg = 2.0}},
    Attempt{.variant = {.aim_deg = 4.0}},
    Attempt{.variant = {.aim_deg = 0.0, .worst_first = true}},
    Attempt{.variant = {.aim_deg = 1.0, .worst_first = true}},
    Attempt{.variant = {.aim_deg = 3.0, .worst_first = true}},
    Attempt{.variant = {.aim_deg = 6.0}},
};
// Where all of those fail, these in turn until one leaves no bad triangle.
constexpr std::array kLastResorts = {
    Attempt{.variant = {.aim_deg = 1.5}},
    Attempt{.variant = {.aim_deg = 3.0}},
    Attempt{.variant = {.aim_deg = 8.0}},
    Attempt{.variant = {.aim_deg = 2.0, .worst_first = true}},
    Attempt{.variant = {.aim_deg = 4.5, .worst_first = true}},
};
constexpr std::array kRings = {2u, 3u, 4u, 6u};
// A patch may grow to this many times its vertices, and some.
constexpr std::uint64_t kGrowth = 2;
constexpr std::uint64_t kGrowthRoom = 12;

// Vertices that failed local runs may handle: a share of the mesh, and some for small ones; at angles that no input has
// reached, a third.
std::uint64_t mostWork(double min_angle_deg, std::uint64_t vertices) {
  return (6000 + 3 * vertices) / (min_angle_deg > 43.0 ? 3 : 1);
}
// Vertices that local runs may handle with success, as a multiple of those of failed ones: each time fewer triangles
// fall short.
std::uint64_t timesAsMuch(double min_angle_deg) { return min_angle_deg > 43.0 ? 2 : 10; }
// Past so many failures, and twice the successes, the bound is out of reach; at angles that no input has reached,
// sooner.
std::uint64_t hopeless(double min_angle_deg) { return min_angle_deg > 43.0 ? 4 : 24; }

std::size_t countViolations(const Refiner& refiner) {
  std::size_t count = 0;
  for (TriId t = 0; t < refiner.mesh().triangleSlots(); ++t)
    count += refiner.mesh().isLive(t) && refiner.violatesBound(t);
  return count;
}

struct Solution {
  std::size_t short_triangles = 0;
  TriMesh mesh;

  bool isBetterThan(const Solution& other) const {
    return std::pair(short_triangles, mesh.points.size()) < std::pair(other.short_triangles, other.mesh.points.size());
  }
};

// Returns nothing where more than `most` triangles fall short, or no fewer than before.
std::optional<Solution> solve(const Submesh& patch, const Attempt& attempt, std::size_t most, const Pslg& pslg,
                              const RefineOptions& options, std::uint64_t& work) {
  RefineOptions local = options;
  local.max_vertices = patch.parent.size() * kGrowth + kGrowthRoom;
  Refiner refiner(TriMesh(patch.mesh), pslg, local, VertexNotes(patch.notes), attempt.variant);
  const std::size_t before = countViolations(refiner);
  if (attempt.strip) refiner.stripFreeVertices();
  refiner.run({});
  refiner.growFans(Refiner::Beyond::GetsMended, {});
  work += refiner.mesh().vertexSlots();
  if (refiner.stats().budget_reached) return std::nullopt;
  const std::size_t left = countViolations(refiner);
  if (left >= before || left > most) return std::nullopt;
  return Solution{left, refiner.release()};
}

std::optional<Solution> solveBest(const Submesh& patch, std::size_t most, const Pslg& pslg,
                                  const RefineOptions& options, std::uint64_t& work) {
  std::optional<Solution> best;
  const auto attempt = [&](const Attempt& how) {
    std::optional<Solution> solved = solve(patch, how, most, pslg, options, work);
    if (solved && (!best || solved->isBetterThan(*best))) best = std::move(solved);
  };
  for (const Attempt& how : kCompeting) attempt(how);
  for (const Attempt& how : kLastResorts) {
    if (best && best->short_triangles == 0) break;
    attempt(how);
  }
  return best;
}

enum class Outcome { Mended, Failed, Deferred };

// Whether the mesh is a part of a larger one and the patch lies at its frozen boundary.
bool isAtFrozenBoundary(const EditMesh& mesh, const Submesh& patch) {
  return std::ranges::any_of(patch.triangles, [&](TriId t) {
    return std::ranges::find(mesh.triangle(t).seg, kFrozen) != mesh.triangle(t).seg.end();
  });
}

// Puts a solution in; what it pushes beyond its patch is handled at once where nothing in it falls short.
void take(Refiner& refiner, const Submesh& patch, const Solution& solution, const RunControl& control) {
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
  std::erase_if(touched, [&](TriId t) { return !refiner.mesh().isLive(t) || !refiner.violatesBound(t); });
  refiner.resume(touched, control);
}

// Takes the first patch that can be mended wholly, or else the one in which the fewest triangles fall short.
Outcome mendPlace(Refiner& refiner, std::span<const TriId> centre, const Pslg& pslg, const RefineOptions& options,
                  const RunControl& control, std::uint64_t& work) {
  std::optional<Solution> best;
  Submesh best_patch;
  for (const unsigned rings : kRings) {
    Submesh patch = extractAround(refiner.mesh(), refiner.notes(), centre, rings);
    if (refiner.isClearOfFrozen() && isAtFrozenBoundary(refiner.mesh(), patch)) {
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

// First the runs of bad triangles along a small input angle that has domain on both sides: each run is re-meshed as one
// patch, because fixing one side spoils the other.
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
  struct Tally {
    std::uint64_t places = 0;
    std::uint64_t work = 0;  // vertices handled
  };
  Tally successes, failures;
  // Where mending has failed the triangles beside wait for the next round.
  std::vector<bool> near_failure;  // one a vertex
  const auto isNearFailure = [&](TriId t) {
    return std::ranges::all_of(refiner.mesh().triangle(t).v,
                               [&](VertexId v) { return v < near_failure.size() && near_failure[v]; });
  };
  const auto giveUp = [&](TriId t) {
    near_failure.resize(refiner.mesh().vertexSlots(), false);
    for (const TriId near : trianglesAround(refiner.mesh(), {&t, 1}, 1))
      for (const VertexId v : refiner.mesh().triangle(near).v) near_failure[v] = true;
  };
  // What a repair pushes beyond its patch is met on the next round.
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    bool again = false;
    near_failure.clear();
    const TriId slots = refiner.mesh().triangleSlots();
    for (TriId k = 0; k < slots; ++k) {
      // There and back: of a few beside one another another comes first, which makes another patch.
      const TriId t = round % 2 == 0 ? k : slots - 1 - k;
      if (!refiner.mesh().isLive(t) || !refiner.violatesBound(t) || isGivenUp(t)) continue;
      if (refiner.isDeferred(t)) continue;
      if (isNearFailure(t)) {
        again = true;
        continue;
      }
      if (failures.work > most_work || successes.work > timesAsMuch(options.min_angle_deg) * most_work ||
          refiner.stats().budget_reached)
        return;
      control.checkpoint(1.0);
      std::uint64_t work = 0;
      const Outcome outcome = mendPlace(refiner, {&t, 1}, pslg, options, control, work);
      Tally& tally = outcome == Outcome::Mended ? successes : failures;
      tally.work += work;
      if (outcome == Outcome::Deferred) continue;
      ++tally.places;
      if (outcome == Outcome::Failed) giveUp(t);
      if (outcome == Outcome::Mended) again = true;
      if (failures.places > hopeless(options.min_angle_deg) + 2 * successes.places) return;
    }
    if (!again) return;
  }
}

}  // namespace coastmesh
