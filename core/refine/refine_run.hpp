#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/metric.hpp"
#include "core/pslg.hpp"
#include "core/refine/bad_queue.hpp"
#include "core/refine/refine_options.hpp"
#include "core/refine/steiner.hpp"
#include "core/refine/submesh.hpp"
#include "core/refine/vertex_notes.hpp"
#include "core/refine/vertex_ops.hpp"

namespace coastmesh {

// Parameters in which runs differ. Repair tries several on a patch.
struct RefineVariant {
  double aim_deg = 0.0;      // new points aim at an angle this much above the bound
  bool worst_first = false;  // order by smallest angle, not by shortest edge
  double free_share = 0.0;   // minimum distance to other vertices, as a share of the input's spacing
  // Splits the sides of an input angle too small for the bounds if the triangle that fills it blocks points at its
  // base; otherwise it stays as it is.
  bool opens_corners = false;
  // Skips operations that reach a frozen edge, and defers their triangles. Otherwise a frozen edge is an obstacle like
  // a segment.
  bool clear_of_frozen = false;
};

RefineVariant usualVariant(const RefineOptions& options);

// Blocks of some thousand vertices that are close together. Bad triangles of similar lengths are mended block by block,
// so that the triangles around them stay in a core's cache.
class VertexBlocks {
 public:
  VertexBlocks() = default;  // all vertices are one block
  VertexBlocks(std::span<const Point> points, const Surface& surface);

  std::uint32_t count() const { return count_; }
  std::uint32_t of(VertexId v) const { return block_of_.empty() ? 0 : block_of_[v]; }
  // Puts a vertex into the block of another one. REQUIRES: that is in one.
  void put(VertexId v, VertexId beside) {
    if (block_of_.empty()) return;
    if (v >= block_of_.size()) block_of_.resize(v + 1);
    block_of_[v] = block_of_[beside];
  }

 private:
  std::uint32_t count_ = 1;
  std::vector<std::uint16_t> block_of_;  // empty if there is one block
};

// The state of one refinement run, shared by the functions here, in mend_triangles and in repair.
struct RefineRun {
  // `notes` are those of `noteInput`, or on a part of a larger mesh the known notes on its vertices.
  RefineRun(TriMesh&& unrefined, const Pslg& input, const RefineOptions& wanted, VertexNotes&& known,
            const RefineVariant& how);
  RefineRun(const RefineRun&) = delete;  // its members refer to one another
  RefineRun& operator=(const RefineRun&) = delete;

  const Pslg& pslg;
  const RefineOptions& options;
  RefineVariant variant;
  TriangleBound bound;
  TriangleBound strict;  // the same without requested lengths
  EditMesh mesh;
  RefineStats stats;
  SteinerSearch search;
  VertexOps ops;
  double cos_lens;            // cosine of the angle under which an encroaching vertex sees a subsegment
  double squared_resolution;  // minimum distance of vertices: closer together, angles are decided by rounding

  VertexNotes notes;
  std::vector<std::uint8_t> moves;  // number of relocations of each vertex

  BadQueue queue;
  VertexBlocks blocks;
  std::uint32_t steps_together;  // steps of lengths, sixteen an octave of the square, that a block is mended at once
  std::vector<TriId> touched;    // changed, and not yet examined
  // For each fixed vertex whether it is on a frozen edge that the run must avoid; empty if there are none.
  std::vector<bool> frozen;
  std::unordered_map<TriId, Corners> deferred;
  std::set<std::pair<VertexId, VertexId>> stuck;  // subsegments that cannot be split because of rounding

  // Reused memory: each user fills it first.
  struct Memory {
    Patch patch;
    std::vector<VertexId> polygon;
    std::vector<Corners> fresh;
  } memory;
  PatchNumbers patch_numbers;
};

// True if a triangle misses the bounds without a corner of the input to excuse it.
bool violatesBound(const RefineRun& run, TriId t);

// True if a patch is next to a frozen edge, and must therefore be skipped.
bool isBarred(const RefineRun& run, const Patch& patch);

// Keeps a triangle for later; valid while it has the same corners.
inline void defer(RefineRun& run, TriId t) { run.deferred[t] = run.mesh.triangle(t).v; }
bool isDeferred(const RefineRun& run, TriId t);

// An upper bound of the local feature size of the input: that of a nearby vertex plus the distance to it. It grows with
// the distance from fine input as fast as any good mesh can.
double spacingAt(const RefineRun& run, const Point& x, const Patch& cavity);

// Sets the notes on a new vertex; `beside` is one near it that was there before.
void noteVertex(RefineRun& run, VertexId v, double spacing, VertexId beside);

// Queues a triangle if it is bad; the same for all that were touched.
void enqueueIfBad(RefineRun& run, TriId t);
void enqueueTouched(RefineRun& run);

// Removes a free vertex if its hole can be triangulated; the same for all.
bool removeFreeVertex(RefineRun& run, VertexId v);
void stripFreeVertices(RefineRun& run);

// Moves the mesh out of the run.
TriMesh releaseMesh(RefineRun& run);

}  // namespace coastmesh
