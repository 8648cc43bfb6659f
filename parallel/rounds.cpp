#include "parallel/rounds.hpp"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "parallel/cut.hpp"
#include "parallel/workers.hpp"

namespace coastmesh {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// A piece is worth so many triangles of the end: many pieces share out well, large ones leave little to the next round.
constexpr double kLeastGrain = 6000.0, kMostGrain = 40000.0;
constexpr double kWantedPieces = 512.0;
// Edges come to the length asked by steps of this factor: a piece begins with a ninth of its triangles.
constexpr double kSizeStep = 3.0;
// Degrees.
constexpr double kFirstAngleDeg = 10.0;
// Rounds of a step.
constexpr int kMostRounds = 8;
// Work, in triangles, that is not worth a cut.
constexpr double kLittleWork = 30000.0;
// From an equilateral triangle's area to the number of triangles that refinement makes of it.
constexpr double kExcess = 1.5;
// Triangles that come of a bad one on a coast.
constexpr double kOfABadOne = 3.0;

// A triangle that is only copied.
constexpr double kOfACopy = 0.1;

// The angle that round r cuts under: far from those of the rounds before it.
double cutAngle(int round) {
  constexpr double kRightAngle = std::numbers::pi / 2.0, kGoldenShare = 0.61803398874989485;
  return kRightAngle * std::fmod(kGoldenShare * round, 1.0);
}

double expectedOf(const TriMesh& mesh, TriId t, const TriangleBound& bound) {
  const auto& v = mesh.triangle(t).v;
  const Point &a = mesh.point(v[0]), &b = mesh.point(v[1]), &c = mesh.point(v[2]);
  if (!isBad(a, b, c, bound)) return 1.0;
  const double area = 0.5 * std::abs(cross(b - a, c - a));
  constexpr double kEquilateral = 0.43301270189221932;
  return std::max(kOfABadOne, kExcess * area / (kEquilateral * bound.squared_size));
}

PieceId piecesFor(double weight) {
  const double grain = std::clamp(weight / kWantedPieces, kLeastGrain, kMostGrain);
  return static_cast<PieceId>(std::max(1.0, std::round(weight / grain)));
}

// One round: cuts, works, stitches. `work(piece, weight)` answers what it did, and whether there was anything to do.
class Rounds {
 public:
  Rounds(TriMesh&& mesh, const RunControl& control) : control_(control) { sheet_.mesh = std::move(mesh); }

  Sheet& sheet() { return sheet_; }
  const Sheet& sheet() const { return sheet_; }
  RoundsReport& report() { return report_; }

  template <typename Weigh, typename Work>
  void round(const Weigh& weigh, bool whole, const Work& work) {
    const Clock::time_point start = Clock::now();
    const double weight = total(weigh);
    const Partition parts = partition(sheet_.mesh, whole ? 1 : piecesFor(weight), cutAngle(count_++), weigh);
    report_.pieces = std::max<std::size_t>(report_.pieces, parts.pieces);
    std::vector<double> weights(parts.pieces, 0.0);
    forEachItem(parts.pieces, {}, [&](std::size_t p) {
      for (const TriId t : parts.of(static_cast<PieceId>(p))) weights[p] += weigh(t);
    });
    std::vector<std::size_t> order(parts.pieces);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](std::size_t p, std::size_t q) { return weights[p] > weights[q]; });
    Stage stage;
    stage.alone = secondsSince(start);

    std::vector<CutPiece> pieces(parts.pieces);
    std::vector<RefineStats> stats(parts.pieces);
    stage.items.assign(parts.pieces, 0.0);
    tbb::enumerable_thread_specific<VertexMarks> marks;
    const RunControl inner{control_.cancelled, {}};
    forEachItem(parts.pieces, inner, [&](std::size_t i) {
      const Clock::time_point item_start = Clock::now();
      const std::size_t p = order[i];
      pieces[p] = cutOut(sheet_, parts, static_cast<PieceId>(p), marks.local());
      stats[p] = work(pieces[p].piece, weights[p] / weight, inner);
      stage.items[i] = secondsSince(item_start);
    });
    report_.log.stages.push_back(std::move(stage));

    const Clock::time_point stitching = Clock::now();
    sheet_.mesh.triangles = {};
    sheet_ = stitch(std::move(pieces), sheet_);
    for (const RefineStats& some : stats) report_.stats.add(some);
    report_.log.addAlone(secondsSince(stitching));
  }

  // The triangles' weights, summed in a fixed order.
  template <typename Weigh>
  double total(const Weigh& weigh) const {
    constexpr std::size_t kStretches = 256;
    const std::size_t count = sheet_.mesh.triangles.size();
    std::vector<double> sums(kStretches, 0.0);
    forEachItem(kStretches, {}, [&](std::size_t s) {
      for (std::size_t t = count * s / kStretches; t < count * (s + 1) / kStretches; ++t)
        sums[s] += weigh(static_cast<TriId>(t));
    });
    return std::accumulate(sums.begin(), sums.end(), 0.0);
  }

 private:
  Sheet sheet_;
  const RunControl& control_;
  RoundsReport report_;
  int count_ = 0;
};

bool anyOf(const std::vector<std::uint8_t>& flags) { return std::ranges::find(flags, 1) != flags.end(); }

double longestEdge(const TriMesh& mesh) {
  double squared = 0.0;
  for (const Triangle& t : mesh.triangles)
    for (unsigned i = 0; i < 3; ++i)
      squared = std::max(squared, squaredDistance(mesh.point(t.v[next3(i)]), mesh.point(t.v[prev3(i)])));
  return std::sqrt(squared);
}

// What is asked, step after step. At first small angles and no size, of the whole: long thin triangles from shore to shore, as a
// triangulation without Steiner points has them, leave no way to cut it.
std::vector<RefineOptions> stepsTo(const RefineOptions& options, const TriMesh& mesh) {
  std::vector<RefineOptions> steps{options};
  if (std::isfinite(options.size_max)) {
    for (const double longest = longestEdge(mesh); steps.back().size_max * kSizeStep < longest;) {
      steps.push_back(options);
      steps.back().size_max = (steps.end() - 2)->size_max * kSizeStep;
    }
    steps.push_back(options);
    steps.back().size_max = std::numeric_limits<double>::infinity();
  }
  steps.push_back(options);
  steps.back().size_max = std::numeric_limits<double>::infinity();
  steps.back().max_angle_deg = 180.0;
  steps.back().min_angle_deg = std::min(options.min_angle_deg, kFirstAngleDeg);
  std::ranges::reverse(steps);
  return steps;
}

void markBad(Sheet& sheet, const TriangleBound& bound) {
  sheet.due_triangles.resize(sheet.mesh.triangles.size());
  forEachStretch(sheet.mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      const auto& v = sheet.mesh.triangles[t].v;
      sheet.due_triangles[t] = isBad(sheet.mesh.point(v[0]), sheet.mesh.point(v[1]), sheet.mesh.point(v[2]), bound);
    }
  });
}

double dueWeight(const Rounds& run, const TriangleBound& bound) {
  return run.total(
      [&](TriId t) { return run.sheet().due_triangles[t] ? expectedOf(run.sheet().mesh, t, bound) : 0.0; });
}

void refineRound(Rounds& run, const Pslg& pslg, const RefineOptions& options, const TriangleBound& bound, bool whole,
                 bool mends) {
  Sheet& sheet = run.sheet();
  const std::uint64_t vertices = sheet.mesh.points.size();
  const std::uint64_t room = options.max_vertices - std::min(options.max_vertices, vertices);
  const auto weigh = [&](TriId t) { return sheet.due_triangles[t] ? expectedOf(sheet.mesh, t, bound) : kOfACopy; };
  run.report().stats.budget_reached = false;
  run.round(weigh, whole, [&](Piece& piece, double share, const RunControl& inner) {
    if (!anyOf(piece.due_triangles)) return RefineStats{};
    // What the whole may still hold is shared out by the work expected.
    RefineOptions own = options;
    const double most = static_cast<double>(room) * share;
    if (most < 4e9) own.max_vertices = piece.mesh.points.size() + static_cast<std::uint64_t>(most);
    return refinePiece(piece, pslg, own, mends, inner);
  });
}

}  // namespace

double expectedTriangles(const TriMesh& mesh, const RefineOptions& options) {
  const TriangleBound bound(options.min_angle_deg, options.max_angle_deg, options.size_max);
  double sum = 0.0;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) sum += expectedOf(mesh, t, bound);
  return sum;
}

RoundsReport refineInRounds(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, const RunControl& control) {
  const std::vector<RefineOptions> steps = stepsTo(options, mesh);
  Rounds run(std::move(mesh), control);
  Sheet& sheet = run.sheet();
  const Clock::time_point start = Clock::now();
  sheet.notes = noteInput(sheet.mesh, TriangleBound(options.min_angle_deg, options.max_angle_deg, options.size_max));
  run.report().log.addAlone(secondsSince(start));
  for (std::size_t step = 0; step < steps.size() && !run.report().stats.budget_reached; ++step) {
    const bool last_step = step + 1 == steps.size();
    const TriangleBound bound(steps[step].min_angle_deg, steps[step].max_angle_deg, steps[step].size_max);
    markBad(sheet, bound);
    // The last round of a step is not cut, and leaves nothing. The first step has no other: its triangles are too long to be cut apart;
    // nor have those that ask for little.
    const bool whole = step == 0 || (!last_step && dueWeight(run, bound) < kLittleWork);
    for (int round = whole ? kMostRounds : 0; round <= kMostRounds && anyOf(sheet.due_triangles); ++round) {
      control.checkpoint((static_cast<double>(step) + static_cast<double>(round) / (kMostRounds + 1)) /
                         static_cast<double>(steps.size()));
      refineRound(run, pslg, steps[step], bound, round == kMostRounds, last_step);
    }
  }
  mesh = std::move(sheet.mesh);
  return std::move(run.report());
}

RoundsReport shrinkInRounds(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, const RunControl& control) {
  constexpr int kRounds = 3;
  Rounds run(std::move(mesh), control);
  Sheet& sheet = run.sheet();
  sheet.notes.shell_unit.assign(sheet.mesh.input_vertices, 0.0);
  sheet.notes.small_angle.assign(sheet.mesh.input_vertices, false);
  sheet.due_vertices.assign(sheet.mesh.points.size(), 1);
  std::fill_n(sheet.due_vertices.begin(), sheet.mesh.input_vertices, std::uint8_t{0});
  for (int r = 0; r < kRounds && anyOf(sheet.due_vertices); ++r) {
    control.checkpoint(static_cast<double>(r) / kRounds);
    const auto weigh = [&](TriId t) {
      const auto& v = sheet.mesh.triangle(t).v;
      return kOfACopy + sheet.due_vertices[v[0]] + sheet.due_vertices[v[1]] + sheet.due_vertices[v[2]];
    };
    run.round(weigh, false, [&](Piece& piece, double, const RunControl& inner) {
      return anyOf(piece.due_vertices) ? shrinkPiece(piece, pslg, options, inner) : RefineStats{};
    });
  }
  mesh = std::move(sheet.mesh);
  return std::move(run.report());
}

}  // namespace coastmesh
