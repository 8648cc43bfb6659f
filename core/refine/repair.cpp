#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/refine/mend_triangles.hpp"
#include "core/refine/submesh.hpp"

namespace coastmesh {

namespace {

struct Attempt {
  bool strip = true;  // start without the patch's free vertices
  RefineVariant variant;
};

// Attempts differ in the aim of points and the order of triangles: a small change leads to other insertions. All of
// these are tried, and the smallest mesh without a bad triangle is used; with many places, the first such mesh.
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
// If all of those fail, these are tried until one leaves no bad triangle.
constexpr std::array kLastResorts = {
    Attempt{.variant = {.aim_deg = 1.5}},
    Attempt{.variant = {.aim_deg = 3.0}},
    Attempt{.variant = {.aim_deg = 8.0}},
    Attempt{.variant = {.aim_deg = 2.0, .worst_first = true}},
    Attempt{.variant = {.aim_deg = 4.5, .worst_first = true}},
};
// If those fail in the largest patch too, these are tried: beyond the base of a triangle that fills a small input
// angle, the best point is often closer than that triangle allows.
constexpr std::array kOpeningCorners = {
    Attempt{.variant = {.aim_deg = 0.0, .opens_corners = true}},
    Attempt{.variant = {.aim_deg = 1.0, .opens_corners = true}},
    Attempt{.variant = {.aim_deg = 3.0, .opens_corners = true}},
    Attempt{.variant = {.aim_deg = 1.0, .worst_first = true, .opens_corners = true}},
};
constexpr std::array kRings = {2u, 3u, 4u, 6u};
// From this minimum angle on a large mesh has many places: two thousand at 42° beside a coast of 150,000 points, where
// choosing among meshes took a fifth of the time and saved one vertex in three hundred, which coarsening finds too.
constexpr double kManyPlacesFromDeg = 38.0;
// A patch may grow to kGrowth times its vertices, plus kGrowthRoom.
constexpr std::uint64_t kGrowth = 2;
constexpr std::uint64_t kGrowthRoom = 12;

// Most vertices that failed local runs may handle: in proportion to the mesh, with a minimum for small ones; a third at
// angles that no input has reached.
std::uint64_t mostWork(double min_angle_deg, std::uint64_t vertices) {
  return (6000 + 3 * vertices) / (min_angle_deg > 43.0 ? 3 : 1);
}
// The same for successful local runs, as a multiple: each of them leaves fewer violations.
std::uint64_t timesAsMuch(double min_angle_deg) { return min_angle_deg > 43.0 ? 2 : 10; }
// If failures exceed this plus twice the successes, the bound is out of reach; fewer at angles that no input has
// reached.
std::uint64_t hopeless(double min_angle_deg) { return min_angle_deg > 43.0 ? 4 : 24; }

std::size_t countViolations(const RefineRun& run) {
  std::size_t count = 0;
  for (TriId t = 0; t < run.mesh.triangleSlots(); ++t) count += run.mesh.isLive(t) && violatesBound(run, t);
  return count;
}

struct Solution {
  std::size_t short_triangles = 0;
  TriMesh mesh;

  bool isBetterThan(const Solution& other) const {
    return std::pair(short_triangles, mesh.points.size()) < std::pair(other.short_triangles, other.mesh.points.size());
  }
};

// Returns nullopt if the patch gets too large, or more than `most` violations remain, or no fewer than before.
std::optional<Solution> solve(const Submesh& patch, const Attempt& attempt, std::size_t most, const RefineRun& whole,
                              std::uint64_t& work) {
  RefineOptions local = whole.options;
  local.max_vertices = patch.parent.size() * kGrowth + kGrowthRoom;
  RefineRun run(TriMesh(patch.mesh), whole.pslg, local, VertexNotes(patch.notes), attempt.variant);
  const std::size_t before = countViolations(run);
  if (attempt.strip) stripFreeVertices(run);
  refineAll(run, {});
  growCornerTriangles(run, Beyond::GetsMended, {});
  work += run.mesh.vertexSlots();
  if (run.stats.budget_reached) return std::nullopt;
  const std::size_t left = countViolations(run);
  if (left >= before || left > most) return std::nullopt;
  return Solution{left, releaseMesh(run)};
}

std::optional<Solution> solveBest(const Submesh& patch, unsigned rings, std::size_t most, const RefineRun& whole,
                                  std::uint64_t& work) {
  const bool many_places = whole.variant.clear_of_frozen && whole.options.min_angle_deg >= kManyPlacesFromDeg;
  std::optional<Solution> best;
  const auto attempt = [&](const Attempt& how) {
    std::optional<Solution> solved = solve(patch, how, most, whole, work);
    if (solved && (!best || solved->isBetterThan(*best))) best = std::move(solved);
  };
  const auto isMended = [&] { return best && best->short_triangles == 0; };
  for (const Attempt& how : kCompeting) {
    if (many_places && isMended()) break;
    attempt(how);
  }
  // With many places, larger patches come first.
  if (many_places && rings != kRings.back()) return best;
  for (const Attempt& how : kLastResorts) {
    if (isMended()) break;
    attempt(how);
  }
  if (rings != kRings.back()) return best;
  for (const Attempt& how : kOpeningCorners) {
    if (isMended()) break;
    attempt(how);
  }
  return best;
}

enum class Outcome { Mended, Failed, Deferred };

// True if the mesh is a part of a larger one and the patch lies at its frozen boundary.
bool isAtFrozenBoundary(const EditMesh& mesh, const Submesh& patch) {
  return std::ranges::any_of(patch.triangles, [&](TriId t) {
    return std::ranges::find(mesh.triangle(t).seg, kFrozen) != mesh.triangle(t).seg.end();
  });
}

// Puts a solution into the mesh. If it has no violations, triangles that become bad beyond its patch are refined at
// once.
void take(RefineRun& run, const Submesh& patch, const Solution& solution, const RunControl& control) {
  std::vector<VertexId> added;
  std::vector<TriId> touched;
  putBack(run.mesh, patch, solution.mesh, added, touched);
  for (const VertexId v : added) {
    double spacing = std::numeric_limits<double>::infinity();
    for (VertexId f = 0; f < patch.parent.size(); ++f)
      spacing =
          std::min(spacing, patch.notes.spacing[f] + run.bound.surface.chord(patch.mesh.points[f], run.mesh.point(v)));
    noteVertex(run, v, spacing, patch.parent.front());
  }
  run.mesh.restoreDelaunay(touched);
  if (solution.short_triangles > 0) return;
  std::erase_if(touched, [&](TriId t) { return !run.mesh.isLive(t) || !violatesBound(run, t); });
  resume(run, touched, control);
}

// Uses the first patch that can be repaired completely, or else the one with the fewest violations.
Outcome mendPlace(RefineRun& run, std::span<const TriId> centre, const RunControl& control, std::uint64_t& work) {
  std::optional<Solution> best;
  Submesh best_patch;
  for (const unsigned rings : kRings) {
    Submesh patch = extractAround(run.mesh, run.notes, centre, rings, run.patch_numbers);
    if (run.variant.clear_of_frozen && isAtFrozenBoundary(run.mesh, patch)) {
      if (best) break;
      defer(run, centre.back());
      return Outcome::Deferred;
    }
    // In a piece, another round may repair completely what this one cannot; not so at an input angle.
    const bool all_or_none = run.variant.clear_of_frozen &&
                             std::ranges::find(patch.notes.small_angle, true) == patch.notes.small_angle.end();
    const std::size_t most = all_or_none ? 0 : std::numeric_limits<std::size_t>::max();
    std::optional<Solution> solved = solveBest(patch, rings, most, run, work);
    if (!solved || (best && solved->short_triangles >= best->short_triangles)) continue;
    best = std::move(solved);
    best_patch = std::move(patch);
    if (best->short_triangles == 0) break;
  }
  if (!best) return Outcome::Failed;
  if (run.mesh.vertexCount() + best->mesh.points.size() - best_patch.parent.size() > run.options.max_vertices) {
    run.stats.budget_reached = true;
    return Outcome::Failed;
  }
  take(run, best_patch, *best, control);
  return Outcome::Mended;
}

// First repairs runs of bad triangles along a small input angle that has domain on both sides: each run is re-meshed as
// one patch, because fixing one side spoils the other.
void repairStrips(RefineRun& run, const RunControl& control, const auto& isGivenUp) {
  constexpr std::size_t kLongestStrip = 500;
  const std::uint64_t most_work = mostWork(run.options.min_angle_deg, run.mesh.vertexCount());
  std::uint64_t work = 0;
  const TriId slots = run.mesh.triangleSlots();
  for (TriId t = 0; t < slots && work <= most_work && !run.stats.budget_reached; ++t) {
    const std::vector<TriId> strip = shortCornerStrip(run, t);
    if (strip.empty() || strip.size() > kLongestStrip || isGivenUp(strip.back())) continue;
    control.checkpoint(1.0);
    mendPlace(run, strip, control, work);
  }
}

// The surroundings of places where repair has failed: they wait for the next round.
class Surroundings {
 public:
  explicit Surroundings(const EditMesh& mesh) : mesh_(mesh) {}

  void clear() { near_.clear(); }
  void add(TriId t) {
    near_.resize(mesh_.vertexSlots(), false);
    for (const TriId around : trianglesAround(mesh_, {&t, 1}, 1, scratch_))
      for (const VertexId v : mesh_.triangle(around).v) near_[v] = true;
  }
  bool hold(TriId t) const {
    return std::ranges::all_of(mesh_.triangle(t).v, [&](VertexId v) { return v < near_.size() && near_[v]; });
  }

 private:
  const EditMesh& mesh_;
  std::vector<bool> near_;  // one for each vertex
  PatchNumbers scratch_;
};

void repairPlaces(RefineRun& run, const RunControl& control, const auto& isGivenUp) {
  const std::uint64_t most_work = mostWork(run.options.min_angle_deg, run.mesh.vertexCount());
  struct Tally {
    std::uint64_t places = 0;
    std::uint64_t work = 0;  // vertices handled
  };
  Tally successes, failures;
  Surroundings failed(run.mesh);
  // Triangles that a repair makes bad beyond its patch are repaired in the next round.
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    bool again = false;
    failed.clear();
    const TriId slots = run.mesh.triangleSlots();
    for (TriId k = 0; k < slots; ++k) {
      // Alternates the direction: another of several adjacent triangles then comes first, with another patch.
      const TriId t = round % 2 == 0 ? k : slots - 1 - k;
      if (!run.mesh.isLive(t) || !violatesBound(run, t) || isGivenUp(t)) continue;
      if (isDeferred(run, t)) continue;
      if (failed.hold(t)) {
        again = true;
        continue;
      }
      if (failures.work > most_work || successes.work > timesAsMuch(run.options.min_angle_deg) * most_work ||
          run.stats.budget_reached)
        return;
      control.checkpoint(1.0);
      std::uint64_t work = 0;
      const Outcome outcome = mendPlace(run, {&t, 1}, control, work);
      Tally& tally = outcome == Outcome::Mended ? successes : failures;
      tally.work += work;
      if (outcome == Outcome::Deferred) continue;
      ++tally.places;
      if (outcome == Outcome::Failed) {
        failed.add(t);
        ++run.stats.unmended;
      }
      if (outcome == Outcome::Mended) again = true;
      if (failures.places > hopeless(run.options.min_angle_deg) + 2 * successes.places) return;
    }
    if (!again) return;
  }
}

}  // namespace

void repair(RefineRun& run, const RunControl& control, std::span<const BadTriangle> given_up) {
  const auto isGivenUp = [&](TriId t) {
    const auto known = std::ranges::lower_bound(given_up, t, {}, &BadTriangle::triangle);
    return known != given_up.end() && known->triangle == t && known->corners == run.mesh.triangle(t).v;
  };
  repairStrips(run, control, isGivenUp);
  repairPlaces(run, control, isGivenUp);
  if (!run.stats.budget_reached || !run.variant.clear_of_frozen) return;
  // Other pieces may leave vertices for what this one's share did not allow.
  for (TriId t = 0; t < run.mesh.triangleSlots(); ++t)
    if (run.mesh.isLive(t) && violatesBound(run, t) && !isGivenUp(t)) defer(run, t);
}

}  // namespace coastmesh
