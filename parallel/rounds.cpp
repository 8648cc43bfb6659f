#include "parallel/rounds.hpp"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "core/refine/split_segments.hpp"
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

// Numbers found by trial on the sea of the README's tables, with and without `--size-max`, at 30°, 33° and 40°. To find
// them anew change one, and compare what it is said to trade with what it was: vertices beside those of `--no-cut`, the
// critical path in `--report`, the processor's seconds on one thread. All change meshes, so `tests/golden` changes with
// them.

// A piece is worth so many triangles of the end, as many as make so many pieces within these limits. Smaller ones share
// out better and shorten the critical path; larger ones have fewer triangles beside a cut, which wait for a later round
// and cost vertices.
constexpr double kLeastGrain = 6000.0, kMostGrain = 40000.0;
constexpr double kWantedPieces = 512.0;
// Edges come to the length asked by steps of this factor: a piece begins with a ninth of its triangles. Larger steps
// leave strips of long triangles along cuts, smaller ones are more rounds.
constexpr double kSizeStep = 3.0;
// Where lengths are wanted, the last step before they are asked for has edges so many times as long. Its points stay
// where they are, and rows of equal triangles grow from each: of 1.6 million triangles of one size 84 % of the vertices
// have six neighbours with 3, 92 % with 9, 93 % with 16, 96 % without a step. Pieces of longer edges are few large
// triangles, most of them beside a cut: with 16 the critical path is twice as long.
constexpr double kLastStep = 9.0;
// Triangles with a smaller angle than this, in degrees, are refined before anything is cut: those that reach from shore
// to shore. Larger values cost vertices and time on one thread; smaller ones leave triangles that lie across several
// pieces.
constexpr double kFirstAngleDeg = 0.5;
// Rounds of a step, the uncut one at the end not counted. A bound on the run: most steps end sooner, by the next
// number.
constexpr int kMostRounds = 8;
// Bad triangles that a step may leave to the next. More are work for one thread, fewer are rounds for next to nothing.
constexpr double kFewDue = 200.0;
// In a mesh of so few triangles what the pieces of the last rounds could not mend is tried again uncut.
constexpr std::size_t kSmallMesh = 1'000'000;
// A round after the first works on what lies so many edges round what is due: fewer leave more at the edge of that to
// the next round, more are copied for nothing. The rest of the mesh stays where it is.
constexpr unsigned kEdgesRoundDue = 6;
// Where more than this share of the triangles is near what is due, all are cut.
constexpr double kWorthAll = 0.4;
// Work, in triangles, that is not worth a cut: the first step makes about so many. Fewer are more steps, more are work
// for one thread.
constexpr double kLittleWork = 5000.0;

// Of a mesh of fewer triangles than this, such as a patch beside cores, the memory that pieces took is kept for the
// next round: to give it back takes longer than the round.
constexpr std::size_t kWorthGivingBack = 1'000'000;

// The others estimate work, in triangles, so that pieces are of like weight: compare with counts of what refinement
// made.

// Triangles that refinement makes of an area, over the equilateral ones with the longest edge asked that would fill it.
constexpr double kExcess = 1.5;
constexpr double kEquilateral = 0.43301270189221932;  // area for edges of length 1
// What comes of a bad triangle on a coast.
constexpr double kOfABadOne = 3.0;
// Halvings of a triangle's sides in adding up what wanted lengths make of it: four to this power of places. A bound on
// the time.
constexpr int kMostDepth = 9;
// The work of solving patches round a triangle anew.
constexpr double kOfARepair = 500.0;
// The work of copying a triangle, beside refining one.
constexpr double kOfACopy = 0.1;

// The angle that round r cuts under: far from those of the rounds before it.
double cutAngle(int round) {
  constexpr double kRightAngle = std::numbers::pi / 2.0, kGoldenShare = 0.61803398874989485;
  return kRightAngle * std::fmod(kGoldenShare * round, 1.0);
}

// How many triangles of the lengths wanted a triangle is worth.
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

// What a round works on.
enum class Extent {
  Uncut,    // all, as one
  All,      // pieces of all
  NearDue,  // pieces of what is due and lies round it
};

bool anyOf(const std::vector<std::uint8_t>& flags) { return std::ranges::find(flags, 1) != flags.end(); }

// Whether anything of a piece is to be worked on: triangles for refinement, vertices for what comes after.
bool isDue(const MeshState& state) { return anyOf(state.due_triangles) || anyOf(state.due_vertices); }

// A piece that has grown waits for the others with room for as much again.
void dropSpareRoom(MeshState& state) {
  const auto drop = [](auto& items) {
    if (items.capacity() - items.size() > items.size() / 8) items.shrink_to_fit();
  };
  drop(state.mesh.points);
  drop(state.mesh.triangles);
}

// The mesh from round to round.
class Rounds {
 public:
  Rounds(TriMesh&& mesh, const RunControl& control, RoundsWorkspace& workspace)
      : workspace_(workspace), control_(control) {
    whole_.mesh = std::move(mesh);
  }

  MeshState& whole() { return whole_; }
  Recorder& recorder() { return recorder_; }
  RefineStats& stats() { return tally_.stats; }

  // Where an earlier run was, with all as it was then.
  std::optional<RoundPlace> goOn() {
    return workspace_.keeper != nullptr ? workspace_.keeper->goOn(whole_, tally_) : std::nullopt;
  }
  // Keeps all as it is, for another run to go on from.
  void keep(const RoundPlace& next) const {
    if (workspace_.keeper != nullptr) workspace_.keeper->keep(next, whole_, tally_);
  }

  // Cuts, works, stitches. `weigh(t)` is what a triangle counts, `taskOf(state, share)` what is done to a piece with
  // that share of the whole weight where any of it is due.
  template <typename Weigh, typename TaskOf>
  void round(std::string_view name, const Weigh& weigh, Extent extent, const Pslg& pslg, const RefineOptions& options,
             const TaskOf& taskOf) {
    const RunControl inner{control_.cancelled, {}};
    if (extent == Extent::Uncut) {
      recorder_.forEach(name, 1, inner, [&](std::size_t) {
        if (isDue(whole_)) tally_.stats.add(workOn(taskOf(whole_, 1.0), whole_, pslg, options, inner));
      });
      tally_.pieces = std::max<std::uint64_t>(tally_.pieces, 1);
      return;
    }
    const std::size_t count = whole_.mesh.triangles.size();
    std::vector<TriId> some;
    if (extent == Extent::NearDue) {
      some = trianglesNearDue(whole_, kEdgesRoundDue, recorder_.loop("cut"));
      if (static_cast<double>(some.size()) > kWorthAll * static_cast<double>(count)) some.clear();
    }
    const double weight =
        some.empty() ? total(count, weigh) : total(some.size(), [&](TriId i) { return weigh(some[i]); });
    Partition& parts = workspace_.parts;
    partition(whole_.mesh, some, piecesFor(weight), cutAngle(tally_.cut_rounds++), weigh, recorder_, parts);
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
      recorder_.forEach(name, parts.pieces, inner, [&](std::size_t i) {
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
      // What the pieces took is not wanted again before all is cut once more.
      if (parts.pieces > 1 && count >= kWorthGivingBack) giveBackFreeMemory();
    } else {
      stitchInPlace(std::move(pieces), parts, recorder_, whole_);
    }
    for (const RefineStats& of_piece : stats) tally_.stats.add(of_piece);
  }

  // The weights of so many triangles, summed in a fixed order.
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
};

// What is asked, step after step. At first small angles, of the whole: long thin triangles from shore to shore, as a
// triangulation without Steiner points has them, leave no way to cut it. And edges as short as little work makes them:
// then each step asks for shorter ones, so that pieces never consist of few large triangles. Where lengths are wanted
// and few triangles come of them, the first step makes them all: coarser steps would spoil the rows.
std::vector<RefineOptions> stepsTo(const RefineOptions& options, const TriMesh& mesh) {
  std::vector<RefineOptions> steps{options};
  double area = 0.0, longest = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Point &a = mesh.point(t.v[0]), &b = mesh.point(t.v[1]), &c = mesh.point(t.v[2]);
    const TriangleShape shape(a, b, c, options.surface);
    area += areaOn(options.surface, a, b, c);
    longest = std::max(longest, shape.squared[shape.longest]);
  }
  if (options.size != nullptr) {
    const double all = expectedTriangles(mesh, options);
    for (double scale = kLastStep; all > kLittleWork * scale * scale; scale *= kSizeStep) {
      steps.push_back(options);
      steps.back().size_scale = scale;
    }
  }
  const double large_enough = std::min(std::sqrt(longest), std::sqrt(kExcess * area / (kEquilateral * kLittleWork)));
  for (double size = options.size_max; options.size == nullptr && size * kSizeStep < large_enough;) {
    size *= kSizeStep;
    steps.push_back(options);
    steps.back().size_max = size;
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

// What the whole may still hold is shared out to its pieces by the work expected.
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

double expectedTriangles(const TriMesh& mesh, const RefineOptions& options) {
  const TriangleBound bound = boundOf(options);
  double sum = 0.0;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) sum += expectedOf(mesh, t, bound);
  return sum;
}

namespace {

// Rounds of one step from `first` on, of which the last is not cut. `mends` where nothing may be left;
// `checkpoint(share)` reports how far it is, `keep(round)` keeps what there is before that round.
template <typename Checkpoint, typename Keep>
void refineStep(Rounds& run, const Pslg& pslg, const RefineOptions& options, int first, bool whole_first, bool mends,
                const Checkpoint& checkpoint, const Keep& keep) {
  MeshState& whole = run.whole();
  const TriangleBound bound = boundOf(options);
  // Later rounds are left what is due by those before them.
  if (first == 0) markBad(run, bound);
  for (int round = first; round <= kMostRounds; ++round) {
    const double left =
        run.total(whole.mesh.triangles.size(), [&](TriId t) { return static_cast<double>(whole.due_triangles[t]); });
    // Only the last step has to leave nothing: its last round is not cut. The first step is not cut at all.
    if (left == 0.0 || (whole_first && round > 0)) break;
    if (!mends && (left < kFewDue || round == kMostRounds)) break;
    checkpoint(static_cast<double>(round) / (kMostRounds + 1));
    const bool soon_done = mends && round > 0 && left < kFewDue && whole.mesh.triangles.size() < kSmallMesh;
    const bool uncut = whole_first || round == kMostRounds;
    const Extent extent = uncut ? Extent::Uncut : round == 0 ? Extent::All : Extent::NearDue;
    const std::uint64_t unmended = run.stats().unmended;
    refineRound(run, pslg, options, bound, extent, mends);
    // What a piece could not mend the whole may.
    if (soon_done && !uncut && run.stats().unmended != unmended) {
      markBad(run, bound);
      refineRound(run, pslg, options, bound, Extent::Uncut, mends);
    }
    keep(round + 1);
  }
}

}  // namespace

RoundsReport refineInRounds(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, VertexNotes notes,
                            const RunControl& control, RoundsWorkspace& workspace) {
  const std::vector<RefineOptions> steps = stepsTo(options, mesh);
  Rounds run(std::move(mesh), control, workspace);
  MeshState& whole = run.whole();
  whole.notes = std::move(notes);
  const std::optional<RoundPlace> before = run.goOn();
  if (!before && wantsSplitSegments(whole.mesh, options)) splitSegments(whole.mesh, pslg, whole.notes, options);
  const RoundPlace from = before.value_or(RoundPlace{});
  for (std::uint32_t step = from.step; step < steps.size() && !run.stats().budget_reached; ++step) {
    refineStep(
        run, pslg, steps[step], step == from.step ? static_cast<int>(from.round) : 0, step == 0,
        step + 1 == steps.size(),
        [&](double share) {
          control.checkpoint((static_cast<double>(step) + share) / static_cast<double>(steps.size()));
        },
        [&](int round) {
          run.keep({step, static_cast<std::uint32_t>(round)});
        });
  }
  return run.finish(mesh);
}

RoundsReport mendInRounds(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, VertexNotes notes,
                          bool repairs_alone, const RunControl& control, RoundsWorkspace& workspace) {
  Rounds run(std::move(mesh), control, workspace);
  MeshState& whole = run.whole();
  whole.notes = std::move(notes);
  if (repairs_alone) {
    // What lies at a cut waits for the next round, which cuts elsewhere.
    constexpr int kRepairRounds = 5;
    for (int round = 0; round < kRepairRounds; ++round) {
      markBad(run, strictBoundOf(options));
      if (!anyOf(whole.due_triangles)) break;
      control.checkpoint(static_cast<double>(round) / kRepairRounds);
      const auto weigh = [&](TriId t) { return whole.due_triangles[t] ? kOfARepair : kOfACopy; };
      const std::uint64_t vertices = whole.mesh.points.size();
      const Extent extent = round + 1 == kRepairRounds ? Extent::Uncut : Extent::All;
      run.round("refine", weigh, extent, pslg, options, [&](const MeshState& state, double share) {
        return PieceTask::of(PieceWork::Repair, optionsOfPiece(options, vertices, state, share));
      });
    }
  } else {
    refineStep(
        run, pslg, options, 0, false, true, [&](double share) { control.checkpoint(share); }, [](int) {});
  }
  return run.finish(mesh);
}

namespace {

// Gives every Steiner point its turn in some round.
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
    control.checkpoint(static_cast<double>(r) / kRounds);
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
