#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <utility>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/metric.hpp"
#include "core/refine/bound_violations.hpp"
#include "core/refine/refine.hpp"
#include "core/refine/submesh_runs.hpp"
#include "core/refine/vertex_ops.hpp"
#include "core/triangulate/label_regions.hpp"

namespace coastmesh {

namespace {

// Vertices that may be superfluous, each queued at most once.
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

// The operations tried on each vertex.
using Sweep = VertexOps::Tries;
using Sweeps = std::vector<Sweep>;

constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();
constexpr Sweep kMerge{.merges = true}, kMove{.moves = true};
constexpr Sweep kMergeOrMove{.merges = true, .moves = true}, kRemoveOrMerge{.removes_up_to = kAny, .merges = true};
constexpr Sweep kAll{.removes_up_to = kAny, .merges = true, .moves = true};

// Sweeps with all operations. The last only merges: removals achieve next to nothing there, and moves pay off only if
// more sweeps follow.
Sweeps thorough(int sweeps) {
  Sweeps all(static_cast<std::size_t>(sweeps), kAll);
  all.back() = kMerge;
  return all;
}

// Removes the most from large meshes with large angles for the time. Vertices with more than three triangles are hardly
// ever removed: of 6,100 that were at 40°, 150 had more than five, and 4,900 were on segments.
Sweeps frugal(int sweeps) {
  Sweeps all(static_cast<std::size_t>(sweeps), Sweep{.removes_up_to = 3, .merges = true, .moves = true});
  all.back() = {.removes_up_to = 5, .merges = true};
  return all;
}

// A sweep moves vertices, so that the next finds more; at large angles there are many dense places, and more sweeps pay
// off. Large meshes bounded by smaller angles alone get what removes the most for the time: merging first, while
// nothing moves, and removing at the end. Small meshes can afford more, up to `work` visits of vertices.
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
    // The further above the bound refinement aims, the less it leaves to remove.
    if (min_angle_deg > 41.5) return frugal(7);
    return frugal(min_angle_deg > 40.5 || (min_angle_deg >= 38.0 && min_angle_deg < 39.0) ? 8 : 9);
  }
  return thorough(affordable(3.0, 16.0, 20000.0));
}

// Vertices are coarsened only if all edges around them are shorter than this share of the requested length: merging two
// lengthens the edges there by at most a half.
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

  // For a part of a larger mesh: only the due vertices, and clear of frozen edges.
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
      // The loop ends: only a success queues vertices again, and it removes one for good.
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
        // The move leaves room to remove its neighbours.
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
  std::vector<std::uint8_t> due_;  // one for each vertex; empty if all are
};

// Nothing is removed where edges are about as long as requested.
bool Coarsener::isFinerThanWanted(VertexId v) {
  const Point here = mesh_.point(v);
  const double longest = kFineShare * size_->at(here), most = longest * longest;
  const auto isShort = [&](VertexId w) { return bound_.surface.squaredChord(here, mesh_.point(w)) < most; };
  // Mostly any triangle shows it.
  const Triangle& home = mesh_.triangle(mesh_.triangleOf(v));
  if (std::ranges::any_of(home.v, [&](VertexId w) { return w != v && !isShort(w); })) return false;
  mesh_.star(v, star_);
  return std::ranges::all_of(star_, [&](EdgeRef e) { return isShort(mesh_.origin(e)) && isShort(mesh_.target(e)); });
}

}  // namespace

RefineStats coarsenSubmesh(MeshState& state, const Pslg& pslg, const RefineOptions& options,
                           const RunControl& control) {
  Coarsener coarsener(std::move(state), pslg, options);
  // As many sweeps as for the large mesh that it is a part of.
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
