#include "parallel/rounds.hpp"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "core/bulk_list.hpp"
#include "core/refine/split_segments.hpp"
#include "core/run_control.hpp"
#include "parallel/cut.hpp"
#include "parallel/deal.hpp"
#include "parallel/free_memory.hpp"
#include "parallel/near_due.hpp"
#include "parallel/piece_task.hpp"
#include "parallel/recorder.hpp"
#include "parallel/round_keeper.hpp"
#include "parallel/stitch.hpp"

namespace coastmesh {

namespace {

// Tuned on the sea of the README's tables, with and without `--size-max`, at 30°, 33° and 40°. To tune a constant
// again, compare the quantities that its comment mentions: vertices relative to `--no-cut`, the critical path in
// `--report`, processor seconds on one thread. Each of them changes meshes, and `tests/golden` with them.

// Triangles that a piece is expected to become: as many as make `kWantedPieces` pieces, within these limits. Smaller
// pieces balance better and shorten the critical path; larger ones have fewer triangles at cuts, which wait for a later
// round and cost vertices.
constexpr double kLeastGrain = 6000.0, kMostGrain = 40000.0;
constexpr double kWantedPieces = 512.0;
// Factor between the edge lengths of successive steps: a piece begins with a ninth of its triangles. A larger factor
// leaves strips of long triangles along cuts, a smaller one takes more rounds.
constexpr double kSizeStep = 3.0;
// With a size function, the step before the last makes edges this many times as long as requested. Its points stay, and
// rows of equal triangles grow from each: in a mesh of 1.6 million triangles of one size, 84 % of the vertices have six
// neighbours with 3, 92 % with 9, 93 % with 16, 96 % without a step. Pieces with longer edges are few large triangles,
// most of them at a cut: with 16 the critical path is twice as long.
constexpr double kLastStep = 9.0;
// Degrees. Triangles with a smaller angle, which reach from shore to shore, are refined first. A larger value costs
// vertices and time in few pieces; a smaller one leaves triangles that cross several pieces.
constexpr double kFirstAngleDeg = 0.5;
// Rounds of that step: the first cuts the mesh into a few large pieces, as it is little work; the second takes what lay
// across those cuts. What is left then lies in input angles of its own size.
constexpr int kRoundsOfFirstStep = 2;
// Most rounds of a step, not counting the uncut one at the end. A safeguard: most steps end earlier, by `kFewDue`.
constexpr int kMostRounds = 8;
// Bad triangles that a step may leave to the next. A larger number leaves single-threaded work, a smaller one takes
// rounds that do hardly anything.
constexpr double kFewDue = 200.0;
// In a mesh of more triangles, bad ones this close to a core, in edges, wait for its insertion: its frozen edges stay
// in every round, and keep nearly all of them from being mended. With fewer, further rounds take next to no time.
constexpr std::size_t kWorthWaiting = 300'000;
constexpr unsigned kEdgesBesideCores = 3;
// Other bad triangles that then wait too, as a share of all triangles: fewer are not worth a round.
constexpr double kFewWithCores = 1e-4;
// In a mesh of fewer triangles, what pieces of the last rounds could not repair is tried again uncut.
constexpr std::size_t kSmallMesh = 1'000'000;
// Rounds after the first work within this many edges of due triangles and vertices, and leave the rest of the mesh in
// place. A smaller number leaves more work at the border to the next round, a larger one copies triangles for nothing.
constexpr unsigned kEdgesRoundDue = 6;
// The same for repairs without cuts: their patches reach six edges from a triangle.
constexpr unsigned kEdgesOfRepairs = 12;
// If more than this share of the triangles is near due ones, all are cut.
constexpr double kWorthAll = 0.4;
// Work, in triangles, that is not worth a cut: the first step makes about this many. A smaller number takes more steps,
// a larger one is more single-threaded work.
constexpr double kLittleWork = 5000.0;

// In a mesh of fewer triangles, such as a patch beside cores, the pieces' memory is kept for the next round: returning
// it takes longer than the round.
constexpr std::size_t kWorthGivingBack = 1'000'000;

// The constants below estimate work, in triangles, so that pieces have similar weights. To tune them, compare with the
// number of triangles that refinement makes.

// Triangles that refinement makes of an area, relative to the equilateral ones of the longest allowed edge that fill
// it.
constexpr double kExcess = 1.5;
constexpr double kEquilateral = 0.43301270189221932;  // area for edges of length 1
// Triangles that a bad triangle at a coast becomes.
constexpr double kOfABadOne = 3.0;
// Levels by which a triangle is subdivided, into four each, to integrate the requested lengths over it. Bounds the
// time.
constexpr int kMostDepth = 9;
// The work of repairing patches around a triangle.
constexpr double kOfARepair = 500.0;
// The work of copying a triangle, relative to refining one.
constexpr double kOfACopy = 0.1;

// The angle of a round's cuts, radians: far from those of the rounds before it.
double cutAngle(int round) {
  constexpr double kRightAngle = std::numbers::pi / 2.0, kGoldenShare = 0.61803398874989485;
  return kRightAngle * std::fmod(kGoldenShare * round, 1.0);
}

// The number of triangles of the requested lengths that fill a triangle.
double wantedIn(const Point& a, const Point& b, const Point& c, const TriangleBound& bound, int depth) {
  constexpr double kFine = 16.0;
  const double size = bound.longest_share / kLongestShare * bound.size->at(centroid(a, b, c));
  const double count = std::abs(areaOn(bound.surface, a, b, c)) / (kEquilateral * size * size);
  if (count < kFine || depth == 0) return count;
  const Point ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
  return wantedIn(a, ab, ca, bound, depth - 1) + wantedIn(ab, b, bc, bound, depth - 1) +
         wantedIn(ca, bc, c, bound, depth - 1) + wantedIn(ab, bc, ca, bound, depth - 1);
}

double expectedOf(const TriMesh& mesh, TriId t, const TriangleBound& bound) {
  const auto& v = mesh.triangle(t).v;
  const Point &a = mesh.point(v[0]), &b = mesh.point(v[1]), &c = mesh.point(v[2]);
  if (!isBad(a, b, c, bound)) return 1.0;
  if (bound.size != nullptr) return std::max(kOfABadOne, wantedIn(a, b, c, bound, kMostDepth));
  const double area = std::abs(areaOn(bound.surface, a, b, c));
  return std::max(kOfABadOne, kExcess * area / (kEquilateral * bound.squared_size));
}

PieceId piecesFor(double weight) {
  const double grain = std::clamp(weight / kWantedPieces, kLeastGrain, kMostGrain);
  return static_cast<PieceId>(std::max(1.0, std::round(weight / grain)));
}

// The part of the mesh that a round works on.
enum class Extent {
  Uncut,    // the whole mesh, as one piece
  All,      // pieces of the whole mesh
  NearDue,  // pieces of the due triangles and vertices and their surroundings
  Around,   // the same, and all that repairs may change around them, as one piece
};

bool anyOf(const std::vector<std::uint8_t>& flags) { return std::ranges::find(flags, 1) != flags.end(); }

// True if anything in a piece is due: triangles for refinement, vertices for coarsening and optimisation.
bool isDue(const MeshState& state) { return anyOf(state.due_triangles) || anyOf(state.due_vertices); }

// Until all pieces are done, a piece that has grown may hold memory for twice its size.
void dropSpareRoom(MeshState& state) {
  const auto drop = [](auto& items) {
    if (items.capacity() - items.size() > items.size() / 8) items.shrink_to_fit();
  };
  drop(state.mesh.points);
  drop(state.mesh.triangles);
}

// The state of a mesh across rounds.
class Rounds {
 public:
  Rounds(TriMesh&& mesh, const RunControl& control, RoundsWorkspace& workspace)
      : workspace_(workspace), control_(control) {
    whole_.mesh = std::move(mesh);
  }

  MeshState& whole() { return whole_; }
  Recorder& recorder() { return recorder_; }
  RefineStats& stats() { return tally_.stats; }
  bool hasCores() const { return workspace_.has_cores; }

  // Restores the state that an earlier run saved, and returns its next round; nullopt if there is none.
  std::optional<RoundPlace> goOn() {
    return workspace_.keeper != nullptr ? workspace_.keeper->goOn(whole_, tally_) : std::nullopt;
  }
  // Saves the state, so that another run can resume from it.
  void keep(const RoundPlace& next) const {
    if (workspace_.keeper != nullptr) workspace_.keeper->keep(next, whole_, tally_);
  }

  // To be called before a round, which is this part of the stage. Throws Cancelled.
  void begin(const ProgressPart& part) {
    control_.checkpoint(part.from);
    part_ = part;
  }

  // Cuts, processes the pieces, stitches. `weigh(t)` is a triangle's weight. `taskOf(state, share)` is the task for a
  // piece with this share of the total weight; it is executed if anything in the piece is due.
  template <typename Weigh, typename TaskOf>
  void round(std::string_view name, const Weigh& weigh, Extent extent, const Pslg& pslg, const RefineOptions& options,
             const TaskOf& taskOf) {
    const RunControl inner{control_.cancelled, {}}, pieces_control = stageControl(control_, part_);
    if (extent == Extent::Uncut) {
      recorder_.forEach(name, 1, pieces_control, [&](std::size_t) {
        if (isDue(whole_)) tally_.stats.add(workOn(taskOf(whole_, 1.0), whole_, pslg, options, inner));
      });
      tally_.pieces = std::max<std::uint64_t>(tally_.pieces, 1);
      return;
    }
    const std::size_t count = whole_.mesh.triangles.size();
    const auto nearDue = [&](unsigned edges) {
      BulkList<TriId> near = trianglesNearDue(whole_, edges, recorder_.loop("cut"));
      if (static_cast<double>(near.size()) > kWorthAll * static_cast<double>(count)) near.clear();
      return near;
    };
    const auto weightOf = [&](const BulkList<TriId>& some) {
      return some.empty() ? total(count, weigh) : total(some.size(), [&](TriId i) { return weigh(some[i]); });
    };
    BulkList<TriId> some;
    if (extent == Extent::NearDue) some = nearDue(kEdgesRoundDue);
    double weight = weightOf(some);
    PieceId wanted = piecesFor(weight);
    // Work for one piece is done at once, so that nothing waits for another round.
    if (extent == Extent::Around || (extent == Extent::NearDue && wanted == 1)) {
      some = nearDue(kEdgesOfRepairs);
      weight = weightOf(some);
      wanted = 1;
    }
    Partition& parts = workspace_.parts;
    partition(whole_.mesh, some, wanted, cutAngle(tally_.cut_rounds++), weigh, recorder_, parts);
    if (parts.pieces > tally_.pieces) {
      tally_.pieces = parts.pieces;
      tally_.cuts = parts.tree;
    }
    std::vector<double> weights(parts.pieces, 0.0);
    recorder_.forEach("cut", parts.pieces, {}, [&](std::size_t p) {
      for (const TriId t : parts.of(static_cast<PieceId>(p))) weights[p] += weigh(t);
    });
    std::vector<std::size_t> order(parts.pieces);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](std::size_t p, std::size_t q) { return weights[p] > weights[q]; });

    std::vector<CutSubmesh> pieces(parts.pieces);
    std::vector<RefineStats> stats(parts.pieces);
    tbb::enumerable_thread_specific<VertexNumbers> numbers;
    const auto cutAt = [&](std::size_t i) {
      pieces[order[i]] = cutOut(whole_, parts, static_cast<PieceId>(order[i]), numbers.local());
      return isDue(pieces[order[i]].state);
    };
    const auto taskAt = [&](std::size_t i) { return taskOf(pieces[order[i]].state, weights[order[i]] / weight); };
    const auto workAt = [&](std::size_t i) {
      const PieceTask task = taskAt(i);
      stats[order[i]] = workOn(task, pieces[order[i]].state, pslg, options, inner);
      dropSpareRoom(pieces[order[i]].state);
    };
    if (workspace_.helpers == nullptr || parts.pieces == 1) {
      recorder_.forEach(name, parts.pieces, pieces_control, [&](std::size_t i) {
        if (cutAt(i)) workAt(i);
      });
    } else {
      std::vector<std::uint8_t> due(parts.pieces, 0);
      DealtWork work;
      work.may_go = [&](std::size_t i) { return (due[i] = cutAt(i)) != 0; };
      work.here = [&](std::size_t i) {
        if (due[i]) workAt(i);
      };
      work.request = [&](std::size_t i) {
        MeshState& state = pieces[order[i]].state;
        std::string request = requestFor(taskAt(i), state);
        freeMemoryOf(state.mesh.triangles);
        return request;
      };
      work.take = [&](std::size_t i, Reply&& reply) {
        stats[order[i]] = takePiece(std::move(reply), pieces[order[i]].state);
      };
      dealItems(*workspace_.helpers, parts.pieces, inner, recorder_, name, work);
    }
    if (some.empty()) {
      stitch(std::move(pieces), recorder_, whole_);
      // The pieces' memory is not needed before the whole mesh is cut again; cores, inserted later, need more.
      if (parts.pieces > 1 && count >= kWorthGivingBack && !hasCores()) giveBackFreeMemory();
    } else {
      stitchInPlace(std::move(pieces), parts, recorder_, whole_);
    }
    for (const RefineStats& of_piece : stats) tally_.stats.add(of_piece);
  }

  // The sum of the weights of `count` triangles, in a fixed order.
  template <typename Weigh>
  double total(std::size_t count, const Weigh& weigh) {
    constexpr std::size_t kStretches = 256;
    std::vector<double> sums(kStretches, 0.0);
    recorder_.forEach("cut", kStretches, {}, [&](std::size_t s) {
      for (std::size_t t = count * s / kStretches; t < count * (s + 1) / kStretches; ++t)
        sums[s] += weigh(static_cast<TriId>(t));
    });
    return std::accumulate(sums.begin(), sums.end(), 0.0);
  }

  RoundsReport finish(TriMesh& mesh) {
    mesh = std::move(whole_.mesh);
    return {std::move(tally_.stats), tally_.pieces, std::move(tally_.cuts), recorder_.finish()};
  }

 private:
  MeshState whole_;
  RoundsWorkspace& workspace_;
  const RunControl& control_;
  Recorder recorder_;
  RoundsTally tally_;
  ProgressPart part_;  // of the next round
};

// The longest edges that a first step may leave: those of the mesh, and those with which it makes little work.
double longestFirst(const TriMesh& mesh, const Surface& surface, const ItemLoop& loop) {
  struct Sum {
    double area = 0.0, longest = 0.0;
  };
  const std::vector<Sum> sums = overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
    Sum sum;
    for (std::size_t t = first; t < last; ++t) {
      const auto& v = mesh.triangles[t].v;
      const Point &a = mesh.point(v[0]), &b = mesh.point(v[1]), &c = mesh.point(v[2]);
      const TriangleShape shape(a, b, c, surface);
      sum.area += areaOn(surface, a, b, c);
      sum.longest = std::max(sum.longest, shape.squared[shape.longest]);
    }
    return sum;
  });
  Sum all;
  for (const Sum& sum : sums) all = {all.area + sum.area, std::max(all.longest, sum.longest)};
  return std::min(std::sqrt(all.longest), std::sqrt(kExcess * all.area / (kEquilateral * kLittleWork)));
}

// The options of each step; those of the last are `options`. The first step removes very small angles, because the long
// thin triangles of a triangulation without Steiner points, from shore to shore, leave no place for many cuts; it makes
// edges as short as little work allows. Each further step requests shorter edges, so that pieces never consist of few
// large triangles. If requested lengths need few triangles, the first step makes them all: coarser steps would disturb
// the rows.
std::vector<RefineOptions> stepsTo(const RefineOptions& options, const TriMesh& mesh, const ItemLoop& loop) {
  std::vector<RefineOptions> steps{options};
  if (options.size != nullptr) {
    const double all = expectedTriangles(mesh, options, loop);
    for (double scale = kLastStep; all > kLittleWork * scale * scale; scale *= kSizeStep) {
      steps.push_back(options);
      steps.back().size_scale = scale;
    }
  } else {
    const double large_enough = longestFirst(mesh, options.surface, loop);
    for (double size = options.size_max; size * kSizeStep < large_enough;) {
      size *= kSizeStep;
      steps.push_back(options);
      steps.back().size_max = size;
    }
  }
  steps.push_back(steps.back());
  steps.back().max_angle_deg = 180.0;
  steps.back().min_angle_deg = std::min(options.min_angle_deg, kFirstAngleDeg);
  std::ranges::reverse(steps);
  return steps;
}

void markBad(Rounds& run, const TriangleBound& bound) {
  MeshState& whole = run.whole();
  resizeAnew(run.recorder().loop("cut"), whole.due_triangles, whole.mesh.triangles.size());
  forEachByStretches(run.recorder().loop("cut"), whole.mesh.triangles.size(), [&](std::size_t t) {
    const auto& v = whole.mesh.triangles[t].v;
    whole.due_triangles[t] = isBad(whole.mesh.point(v[0]), whole.mesh.point(v[1]), whole.mesh.point(v[2]), bound);
  });
}

// Distributes the vertices that the whole mesh may still take to its pieces, by expected work.
RefineOptions optionsOfPiece(const RefineOptions& options, std::uint64_t vertices, const MeshState& state,
                             double share) {
  RefineOptions own = options;
  const double room = static_cast<double>(options.max_vertices - std::min(options.max_vertices, vertices)) * share;
  if (room < 4e9) own.max_vertices = state.mesh.points.size() + static_cast<std::uint64_t>(room);
  return own;
}

void refineRound(Rounds& run, const Pslg& pslg, const RefineOptions& options, const TriangleBound& bound, Extent extent,
                 bool mends) {
  MeshState& whole = run.whole();
  const std::uint64_t vertices = whole.mesh.points.size();
  if (vertices > options.most_in_memory) throw OutOfRoom(whole.mesh.points.back());
  const auto weigh = [&](TriId t) { return whole.due_triangles[t] ? expectedOf(whole.mesh, t, bound) : kOfACopy; };
  run.stats().budget_reached = false;
  run.round("refine", weigh, extent, pslg, options, [&](const MeshState& state, double share) {
    return PieceTask::of(mends ? PieceWork::RefineAndMend : PieceWork::Refine,
                         optionsOfPiece(options, vertices, state, share));
  });
}

}  // namespace

double expectedTriangles(const TriMesh& mesh, const RefineOptions& options, const ItemLoop& loop) {
  constexpr std::size_t kLeastTriangles = 512;  // few of a coarse mesh are most of the work
  const TriangleBound bound = boundOf(options);
  const std::vector<double> sums = overStretches(
      loop, mesh.triangles.size(),
      [&](std::size_t first, std::size_t last) {
        double sum = 0.0;
        for (std::size_t t = first; t < last; ++t) sum += expectedOf(mesh, static_cast<TriId>(t), bound);
        return sum;
      },
      kLeastTriangles);
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

namespace {

// The part of a step that a round is: rounds leave less and less due.
ProgressPart partOfRound(int round) { return {1.0 - std::exp2(-round), 1.0 - std::exp2(-round - 1)}; }

// The part of refinement that a step is: each step makes about nine times as many triangles as the one before.
ProgressPart partOfStep(std::size_t step, std::size_t steps) {
  const auto before = [&](std::size_t s) {
    return s == 0 ? 0.0 : std::pow(kSizeStep * kSizeStep, static_cast<double>(s) - static_cast<double>(steps));
  };
  return {before(step), before(step + 1)};
}

// True if the mesh has as many vertices as it may have and would take more.
bool isFull(Rounds& run, const RefineOptions& options) {
  return run.stats().budget_reached && run.whole().mesh.points.size() >= options.max_vertices;
}

// True if so few vertices are left that their shares would be of no use to pieces.
bool isNearlyFull(Rounds& run, const RefineOptions& options) {
  constexpr std::uint64_t kFewVertices = 1000;
  const std::uint64_t vertices = run.whole().mesh.points.size();
  return run.stats().budget_reached && options.max_vertices - std::min(options.max_vertices, vertices) < kFewVertices;
}

// True if there is a frozen edge within this many edges of a triangle.
bool isBesideFrozen(const TriMesh& mesh, TriId t, unsigned edges) {
  const Triangle& tri = mesh.triangle(t);
  return std::ranges::find(tri.seg, kFrozen) != tri.seg.end() ||
         (edges > 0 && std::ranges::any_of(tri.adj, [&](EdgeRef twin) {
            return twin != kNone && isBesideFrozen(mesh, triOf(twin), edges - 1);
          }));
}

// The rounds of one step, from round `first` on. `first_step`: it is the first of several. `mends`: the step must leave
// nothing due but what waits for cores, and its last round is uncut. The step is this part of the stage; `keep(round)`
// saves the state before that round. What ends the step depends on that state alone, so that a resumed run makes the
// same mesh.
template <typename Keep>
void refineStep(Rounds& run, const Pslg& pslg, const RefineOptions& options, int first, bool first_step, bool mends,
                const ProgressPart& part, const Keep& keep) {
  MeshState& whole = run.whole();
  const TriangleBound bound = boundOf(options);
  // Later rounds continue with the triangles that earlier ones left due.
  if (first == 0) markBad(run, bound);
  for (int round = first; round <= kMostRounds; ++round) {
    const bool awaits_cores = mends && round > 0 && run.hasCores() && whole.mesh.triangles.size() > kWorthWaiting;
    const double left = run.total(whole.mesh.triangles.size(), [&](TriId t) {
      const bool waits = awaits_cores && whole.due_triangles[t] && isBesideFrozen(whole.mesh, t, kEdgesBesideCores);
      return waits ? 0.0 : static_cast<double>(whole.due_triangles[t]);
    });
    // Steps other than the last may leave some triangles due.
    if (left == 0.0 || (first_step && round == kRoundsOfFirstStep)) break;
    if (!mends && !first_step && (left < kFewDue || round == kMostRounds)) break;
    if (awaits_cores && left < kFewWithCores * static_cast<double>(whole.mesh.triangles.size())) break;
    if (round > 0 && isFull(run, options)) break;
    const ProgressPart of_round = partOfRound(round);
    run.begin(part.part(of_round.from, of_round.to));
    const bool soon_done = mends && round > 0 && left < kFewDue && whole.mesh.triangles.size() < kSmallMesh;
    const bool uncut = round == kMostRounds || (round > 0 && isNearlyFull(run, options));
    const Extent extent = uncut ? Extent::Uncut : round == 0 ? Extent::All : Extent::NearDue;
    const std::uint64_t unmended = run.stats().unmended;
    refineRound(run, pslg, options, bound, extent, mends);
    // Without cuts there may be repairs that a piece did not allow.
    if (soon_done && !uncut && run.stats().unmended != unmended) {
      markBad(run, bound);
      refineRound(run, pslg, options, bound, Extent::Around, mends);
    }
    // Another round could not do more.
    if (uncut && run.stats().budget_reached) round = kMostRounds;
    keep(round + 1);
  }
}

}  // namespace

RoundsReport refineInRounds(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, VertexNotes notes,
                            const RunControl& control, RoundsWorkspace& workspace) {
  Rounds run(std::move(mesh), control, workspace);
  MeshState& whole = run.whole();
  const std::vector<RefineOptions> steps = stepsTo(options, whole.mesh, run.recorder().loop("cut"));
  whole.notes = std::move(notes);
  const std::optional<RoundPlace> before = run.goOn();
  if (!before && !workspace.are_segments_split && wantsSplitSegments(whole.mesh, options))
    run.stats().segment_splits += splitSegments(whole.mesh, pslg, whole.notes, options, run.recorder().loop("cut"));
  const RoundPlace from = before.value_or(RoundPlace{});
  for (std::uint32_t step = from.step; step < steps.size(); ++step) {
    refineStep(run, pslg, steps[step], step == from.step ? static_cast<int>(from.round) : 0, step == 0,
               step + 1 == steps.size(), partOfStep(step, steps.size()), [&](int round) {
                 run.keep({step, static_cast<std::uint32_t>(round)});
               });
    if (isFull(run, options)) break;
  }
  return run.finish(mesh);
}

RoundsReport mendInRounds(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, VertexNotes notes, Mending how,
                          const RunControl& control, RoundsWorkspace& workspace) {
  Rounds run(std::move(mesh), control, workspace);
  MeshState& whole = run.whole();
  whole.notes = std::move(notes);
  if (how == Mending::Refine) {
    refineStep(run, pslg, options, 0, false, true, {}, [](int) {});
    return run.finish(mesh);
  }
  // Triangles at a cut wait for the next round, which cuts elsewhere.
  const int rounds = how == Mending::RepairUncut ? 1 : 4;
  for (int round = 0; round < rounds; ++round) {
    markBad(run, strictBoundOf(options));
    if (!anyOf(whole.due_triangles)) break;
    run.begin({static_cast<double>(round) / rounds, static_cast<double>(round + 1) / rounds});
    run.stats().budget_reached = false;
    const auto weigh = [&](TriId t) { return whole.due_triangles[t] ? kOfARepair : kOfACopy; };
    const std::uint64_t vertices = whole.mesh.points.size();
    const Extent extent = how == Mending::RepairUncut ? Extent::Uncut : Extent::All;
    run.round("refine", weigh, extent, pslg, options, [&](const MeshState& state, double share) {
      return PieceTask::of(PieceWork::Repair, optionsOfPiece(options, vertices, state, share));
    });
  }
  return run.finish(mesh);
}

namespace {

// Processes Steiner points in up to three rounds: those at a cut wait for the next one.
RoundsReport sweepInRounds(std::string_view name, const PieceTask& task, TriMesh& mesh, const Pslg& pslg,
                           const RefineOptions& options, const RunControl& control, RoundsWorkspace& workspace) {
  constexpr int kRounds = 3;
  Rounds run(std::move(mesh), control, workspace);
  MeshState& whole = run.whole();
  const std::optional<RoundPlace> before = run.goOn();
  if (!before) {
    whole.due_vertices.assign(whole.mesh.points.size(), 1);
    std::fill_n(whole.due_vertices.begin(), whole.mesh.input_vertices, std::uint8_t{0});
  }
  for (int r = before ? static_cast<int>(before->round) : 0; r < kRounds && anyOf(whole.due_vertices); ++r) {
    run.begin(partOfRound(r));
    const auto weigh = [&](TriId t) {
      const auto& v = whole.mesh.triangle(t).v;
      return kOfACopy + whole.due_vertices[v[0]] + whole.due_vertices[v[1]] + whole.due_vertices[v[2]];
    };
    run.round(name, weigh, r == 0 ? Extent::All : Extent::NearDue, pslg, options,
              [&](const MeshState&, double) { return task; });
    run.keep({0, static_cast<std::uint32_t>(r + 1)});
  }
  return run.finish(mesh);
}

}  // namespace

RoundsReport coarsenInRounds(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, const RunControl& control,
                             RoundsWorkspace& workspace) {
  return sweepInRounds("coarsen", PieceTask::of(PieceWork::Coarsen, options), mesh, pslg, options, control, workspace);
}

RoundsReport optimiseInRounds(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, int sweeps,
                              const RunControl& control, RoundsWorkspace& workspace) {
  return sweepInRounds("optimise", PieceTask::of(PieceWork::Optimise, options, sweeps), mesh, pslg, options, control,
                       workspace);
}

}  // namespace coastmesh
