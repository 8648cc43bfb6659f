#include <algorithm>
#include <deque>
#include <utility>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/label_regions.hpp"
#include "core/metric.hpp"
#include "core/refine.hpp"
#include "core/shortfalls.hpp"
#include "core/vertex_ops.hpp"

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

}  // namespace

RefineStats shrink(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, const RunControl& control) {
  const TriangleBound bound(options.min_angle_deg, options.max_angle_deg, options.size_max);
  EditMesh edit(std::move(mesh));
  VertexOps ops(edit, pslg, bound);
  RefineStats stats;

  Waiting waiting(edit.vertexSlots());
  for (VertexId v = edit.inputVertices(); v < edit.vertexSlots(); ++v) waiting.push(v);
  const double first = static_cast<double>(std::max<std::size_t>(1, waiting.size()));
  std::vector<TriId> touched;
  // Only a success lets vertices wait again, and takes one out for good.
  for (std::uint64_t steps = 1; waiting.size() > 0; ++steps) {
    if (steps % 1024 == 0) control.checkpoint(std::max(0.0, 1.0 - static_cast<double>(waiting.size()) / first));
    const VertexId v = waiting.pop();
    if (!edit.isLiveVertex(v)) continue;
    if (ops.remove(v, touched)) {
      ++stats.removals;
    } else if (ops.mergeWithNeighbour(v, touched)) {
      ++stats.merges;
    }
    for (const TriId t : touched) {
      if (!edit.isLive(t)) continue;
      for (const VertexId w : edit.triangle(t).v)
        if (w >= edit.inputVertices()) waiting.push(w);
    }
    touched.clear();
  }

  mesh = edit.release();
  labelRegions(mesh, pslg);
  stats.unresolved = findShortfalls(mesh, options);
  return stats;
}

}  // namespace coastmesh
