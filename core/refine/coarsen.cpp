#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <utility>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/label_regions.hpp"
#include "core/metric.hpp"
#include "core/refine/bound_violations.hpp"
#include "core/refine/refine.hpp"
#include "core/refine/submesh_runs.hpp"
#include "core/refine/vertex_ops.hpp"

namespace coastmesh {

namespace {

// Vertices that may be superfluous, each waiting once.
class Waiting {
 public:
  explicit Waiting(std::size_t vertices) : waits_(vertices, false) {}

  void push(VertexId v) {
    if (waits_[v]) return;
    waits_[v] = true;
    queue_.push_back(v);
  }
  VertexId pop() {
    const VertexId v = queue_.front();
    queue_.pop_front();
    waits_[v] = false;
    return v;
  }
  std::size_t size() const { return queue_.size(); }

 private:
  std::deque<VertexId> queue_;
  std::vector<bool> waits_;
};

// What is tried with a vertex when it gets its turn.
using Sweep = VertexOps::Tries;
using Sweeps = std::vector<Sweep>;

constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();
constexpr Sweep kMerge{.merges = true}, kMove{.moves = true};
constexpr Sweep kMergeOrMove{.merges = true, .moves = true}, kRemoveOrMerge{.removes_up_to = kAny, .merges = true};
constexpr Sweep kAll{.removes_up_to = kAny, .merges = true, .moves = true};

// So many sweeps with all that there is. The last only merges: it removes next to nothing, and moving pays while more
// sweeps follow.
Sweeps thorough(int sweeps) {
  Sweeps all(static_cast<std::size_t>(sweeps), kAll);
  all.back() = kMerge;
  return all;
}

// What takes most out of large meshes of large angles for the time. Vertices with more than three triangles hardly ever
// go: of 6,100 that did at 40°, 150 had more than five, and 4,900 were on segments.
Sweeps frugal(int sweeps) {
  Sweeps all(static_cast<std::size_t>(sweeps), Sweep{.removes_up_to = 3, .merges = true, .moves = true});
  all.back() = {.removes_up_to = 5, .merges = true};
  return all;
}

// A sweep shakes the mesh, so that the next finds more; where angles are large, dense places are many, and sweeps pay
// for longer. Large meshes of smaller angles alone get what takes most out for the time: merging first, while nothing
// moves, and removing what is left at the end. Small meshes can afford more, up to as many visits of vertices as
// `work`.
Sweeps sweepsFor(const RefineOptions& options, std::size_t vertices) {
  const double min_angle_deg = options.min_angle_deg;
  const bool angles_alone = options.size == nullptr && std::isinf(options.size_max) && options.max_angle_deg >= 180.0;
  const auto affordable = [&](double fewest, double most, double work) {
    return static_cast<int>(std::clamp(work / static_cast<double>(std::max<std::size_t>(1, vertices)), fewest, most));
  };
  if (min_angle_deg < 32.0) {
    const int sweeps = affordable(2.0, 5.0, 30000.0);
    return sweeps > 2 || !angles_alone ? thorough(sweeps) : Sweeps{kMerge, kMove, kRemoveOrMerge};
  }
  if (min_angle_deg < 37.0) {
    const int sweeps = affordable(3.0, 6.0, 40000.0);
    if (sweeps > 3 || !angles_alone) return thorough(sweeps);
    if (min_angle_deg < 35.0) return {kMerge, kMergeOrMove, kRemoveOrMerge};
    return {kMerge, kMergeOrMove, kMergeOrMove, kRemoveOrMerge};
  }
  if (min_angle_deg <= 43.0) {
    const double fewest = min_angle_deg <= 41.0 ? 9.0 : 12.0;
    const int sweeps = affordable(fewest, 64.0, 800000.0);
    if (sweeps > static_cast<int>(fewest) || !angles_alone || min_angle_deg > 42.0) return thorough(sweeps);
    // The further above the bound refinement aims the less it leaves to take out.
    if (min_angle_deg > 41.5) return frugal(7);
    return frugal(min_angle_deg > 40.5 || (min_angle_deg >= 38.0 && min_angle_deg < 39.0) ? 8 : 9);
  }
  return thorough(affordable(3.0, 16.0, 20000.0));
}

// Round a vertex that coarsening looks at all edges are shorter than this share of the length wanted: merging two makes
// the edges there longer by a half at most.
constexpr double kFineShare = 0.75;

class Coarsener {
 public:
  Coarsener(TriMesh&& mesh, const Pslg& pslg, const RefineOptions& options)
      : size_(options.size),
        bound_(strictBoundOf(options)),
        mesh_(std::move(mesh)),
        ops_(mesh_, pslg, bound_),
        waiting_(mesh_.vertexSlots()) {
    ops_.keepBadInPlace();
  }

  // Of a part of a larger mesh: only the due vertices, and clear of frozen edges.
  Coarsener(MeshState&& state, const Pslg& pslg, const RefineOptions& options)
      : Coarsener(std::move(state.mesh), pslg, options) {
    ops_.keepClearOfFrozen();
    due_ = std::move(state.due_vertices);
  }

  void run(const Sweeps& sweeps, const RunControl& control) {
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
      for (VertexId v = mesh_.inputVertices(); v < mesh_.vertexSlots(); ++v)
        if (mesh_.isLiveVertex(v) && isDue(v)) waiting_.push(v);
      const double first = static_cast<double>(std::max<std::size_t>(1, waiting_.size()));
      // Only a success lets vertices wait again, and takes one out for good.
      for (std::uint64_t steps = 1; waiting_.size() > 0; ++steps) {
        if (steps % 1024 == 0) {
          const double left = std::min(1.0, static_cast<double>(waiting_.size()) / first);
          control.checkpoint((static_cast<double>(i) + 1.0 - left) / static_cast<double>(sweeps.size()));
        }
        const VertexId v = waiting_.pop();
        if (mesh_.isLiveVertex(v) && (size_ == nullptr || isFinerThanWanted(v))) handle(v, sweeps[i]);
      }
    }
  }

  std::size_t vertices() const { return mesh_.vertexCount(); }
  TriMesh release() { return mesh_.release(); }
  MeshState releaseState() { return releaseDue(mesh_, std::move(due_)); }
  RefineStats& stats() { return stats_; }

 private:
  bool isDue(VertexId v) const { return due_.empty() || due_[v]; }
  bool isFinerThanWanted(VertexId v);
  void handle(VertexId v, const Sweep& sweep) {
    touched_.clear();
    switch (ops_.tryInTurn(v, sweep, touched_)) {
      case VertexOps::Change::None:
        return;
      case VertexOps::Change::Moved:
        // To the middle of where it may be: that leaves room for its neighbours to go.
        ++stats_.relocations;
        return;
      case VertexOps::Change::Removed:
        ++stats_.removals;
        break;
      case VertexOps::Change::Merged:
        ++stats_.merges;
        break;
    }
    for (const TriId t : touched_) {
      if (!mesh_.isLive(t)) continue;
      for (const VertexId w : mesh_.triangle(t).v)
        if (w >= mesh_.inputVertices()) waiting_.push(w);
    }
  }

  const SizeFunction* size_;  // may be null
  TriangleBound bound_;
  EditMesh mesh_;
  VertexOps ops_;
  Waiting waiting_;
  RefineStats stats_;
  std::vector<TriId> touched_;
  std::vector<EdgeRef> star_;
  std::vector<std::uint8_t> due_;  // one a vertex; empty where all are
};

// Where edges are about as long as wanted nothing is to be taken out.
bool Coarsener::isFinerThanWanted(VertexId v) {
  const Point here = mesh_.point(v);
  mesh_.star(v, star_);
  double longest = 0.0;
  for (const EdgeRef e : star_)
    longest = std::max({longest, bound_.surface.squaredChord(here, mesh_.point(mesh_.origin(e))),
                        bound_.surface.squaredChord(here, mesh_.point(mesh_.target(e)))});
  const double most = kFineShare * size_->at(here);
  return longest < most * most;
}

}  // namespace

RefineStats coarsenSubmesh(MeshState& state, const Pslg& pslg, const RefineOptions& options,
                           const RunControl& control) {
  Coarsener coarsener(std::move(state), pslg, options);
  // As many as of the large mesh that it is a part of.
  coarsener.run(sweepsFor(options, std::numeric_limits<std::size_t>::max()), control);
  state = coarsener.releaseState();
  return std::move(coarsener.stats());
}

std::size_t coarsenedSize(TriMesh mesh, const Pslg& pslg, const RefineOptions& options, const RunControl& control) {
  const Sweeps sweeps = sweepsFor(options, mesh.points.size());
  Coarsener coarsener(std::move(mesh), pslg, options);
  coarsener.run(sweeps, control);
  return coarsener.vertices();
}

RefineStats coarsen(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, const RunControl& control) {
  requireInRange(options);
  const std::size_t vertices = mesh.points.size();
  Coarsener coarsener(std::move(mesh), pslg, options);
  coarsener.run(sweepsFor(options, vertices), control);
  mesh = coarsener.release();
  labelRegions(mesh, pslg);
  RefineStats stats = std::move(coarsener.stats());
  stats.unresolved = findBoundViolations(mesh, options);
  return stats;
}

}  // namespace coastmesh
