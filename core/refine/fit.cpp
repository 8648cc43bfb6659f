#include "core/refine/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/label_regions.hpp"
#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "core/refine/shortfalls.hpp"
#include "core/refine/vertex_ops.hpp"

namespace coastmesh {

namespace {

// Edges shorter than this share of what is wanted have their ends merged.
constexpr double kShortest = 0.7;
// A move that breaks the bounds is tried at half the way, and at a quarter.
constexpr int kAttempts = 3;

class Fitter {
 public:
  Fitter(TriMesh&& mesh, const Pslg& pslg, const RefineOptions& options)
      : size_(options.size),
        bound_(strictBoundOf(options)),
        mesh_(std::move(mesh)),
        ops_(mesh_, pslg, bound_),
        wanted_(options.size == nullptr ? 0 : mesh_.vertexSlots(), 0.0) {
    ops_.keepBadInPlace();
    if (size_ == nullptr) return;
    for (VertexId v = 0; v < mesh_.vertexSlots(); ++v)
      if (mesh_.isLiveVertex(v)) wanted_[v] = size_->at(mesh_.point(v));
  }

  Fitter(MeshState&& state, const Pslg& pslg, const RefineOptions& options)
      : Fitter(std::move(state.mesh), pslg, options) {
    ops_.keepClearOfFrozen();
    is_submesh_ = true;
    due_ = std::move(state.due_vertices);
  }

  void run(int sweeps, const RunControl& control) {
    std::uint64_t steps = 0;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      const bool is_last = sweep + 1 == sweeps;  // after a merge the vertices round it have to move
      for (VertexId v = mesh_.inputVertices(); v < mesh_.vertexSlots(); ++v) {
        if (++steps % 1024 == 0) control.checkpoint((sweep + static_cast<double>(v) / mesh_.vertexSlots()) / sweeps);
        if (!mesh_.isLiveVertex(v) || !isDue(v) || mesh_.kind(v) != VertexKind::Free) continue;
        if (!gatherRing(v)) continue;
        if (size_ != nullptr && !is_last && mergeShort(v)) continue;
        move(v);
      }
    }
  }

  TriMesh release() { return mesh_.release(); }
  MeshState releaseState() { return releaseDue(mesh_, std::move(due_)); }
  RefineStats& stats() { return stats_; }

 private:
  bool isDue(VertexId v) const { return due_.empty() || due_[v]; }

  // The triangles round a free vertex; false where a frozen edge is opposite, or there are too many.
  bool gatherRing(VertexId v) {
    constexpr std::size_t kMost = 64;
    if (mesh_.ring(v, mesh_.triangleOf(v), kMost, ring_) != StarKind::Closed) return false;
    const auto isFrozen = [&](TriId t) { return mesh_.segment(edgeRef(t, mesh_.cornerOf(t, v))) == kFrozen; };
    return !is_submesh_ || std::ranges::none_of(ring_.triangles, isFrozen);
  }

  bool mergeShort(VertexId v) {
    const Point here = mesh_.point(v);
    for (const VertexId w : ring_.corners) {
      const double shortest = kShortest * 0.5 * (wanted_[v] + wanted_[w]);
      if (squaredDistance(here, mesh_.point(w)) > shortest * shortest || mesh_.kind(w) == VertexKind::Input) continue;
      touched_.clear();
      if (!ops_.merge(v, w, touched_)) continue;
      wanted_[w] = size_->at(mesh_.point(w));
      ++stats_.merges;
      return true;
    }
    return false;
  }

  // Where the edges to the neighbours would be as long as wanted, in the mean; where nothing is wanted, the neighbours' mean.
  Point wantedPlace(VertexId v) const {
    const Point here = mesh_.point(v);
    Point sum;
    for (const VertexId w : ring_.corners) {
      const Point from = mesh_.point(w);
      sum = sum + from;
      if (size_ == nullptr) continue;
      const double wanted = 0.5 * (wanted_[v] + wanted_[w]);
      sum = sum + (wanted / distance(from, here)) * (here - from);
    }
    return (1.0 / static_cast<double>(ring_.corners.size())) * sum;
  }

  bool fits(const Point& place) const {
    for (std::size_t i = 0; i < ring_.corners.size(); ++i) {
      const Point &a = mesh_.point(ring_.corners[i]),
                  &b = mesh_.point(ring_.corners[i + 1 == ring_.corners.size() ? 0 : i + 1]);
      if (orient2d(a, b, place) <= 0 || isBad(a, b, place, bound_)) return false;
    }
    return true;
  }

  void move(VertexId v) {
    const Point here = mesh_.point(v);
    Point to = wantedPlace(v);
    if (!std::isfinite(to.x) || !std::isfinite(to.y)) return;
    const auto isBesideBad = [&](TriId t) { return ops_.isBadBeyond(mesh_.twin(edgeRef(t, mesh_.cornerOf(t, v)))); };
    if (std::ranges::any_of(ring_.triangles, isBesideBad)) return;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      if (fits(to)) {
        mesh_.setPoint(v, to);
        if (size_ != nullptr) wanted_[v] = size_->at(to);
        touched_.assign(ring_.triangles.begin(), ring_.triangles.end());
        mesh_.restoreDelaunayRound(v, touched_);
        ++stats_.relocations;
        return;
      }
      to = midpoint(here, to);
    }
  }

  const SizeFunction* size_;  // may be null
  TriangleBound bound_;
  EditMesh mesh_;
  VertexOps ops_;
  bool is_submesh_ = false;
  RefineStats stats_;
  std::vector<double> wanted_;  // one a vertex: the length wanted there
  Ring ring_;                   // of the vertex whose turn it is
  std::vector<TriId> touched_;
  std::vector<std::uint8_t> due_;  // one a vertex; empty where all are
};

}  // namespace

RefineStats fitSubmesh(MeshState& state, const Pslg& pslg, const RefineOptions& options, int sweeps,
                       const RunControl& control) {
  Fitter fitter(std::move(state), pslg, options);
  fitter.run(sweeps, control);
  state = fitter.releaseState();
  return std::move(fitter.stats());
}

RefineStats fit(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, int sweeps, const RunControl& control) {
  requireInRange(options);
  Fitter fitter(std::move(mesh), pslg, options);
  fitter.run(sweeps, control);
  mesh = fitter.release();
  labelRegions(mesh, pslg);
  RefineStats stats = std::move(fitter.stats());
  stats.unresolved = findShortfalls(mesh, options);
  return stats;
}

}  // namespace coastmesh
