#pragma once

#include <cstdint>
#include <set>
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

// What runs differ in. Repair tries several on a patch.
struct RefineVariant {
  double aim_deg = 0.0;      // new points aim at an angle this much above the bound
  bool worst_first = false;  // smallest angle first, not shortest edge
  double free_share = 0.0;   // least distance to other vertices, as a share of the input's spacing
  // Splits the sides of an input angle too small for the bounds where the triangle that fills it keeps points away from
  // its base; else it stays as it is.
  bool opens_corners = false;
  // Leaves alone what reaches a frozen edge, and keeps it for later. Else a frozen edge is a wall like a segment.
  bool clear_of_frozen = false;
};

RefineVariant usualVariant(const RefineOptions& options);

// The state of one run of refinement, which the functions here, in mend_triangles and in repair work on.
struct RefineRun {
  // The notes are those of `noteInput`, or on a part of a larger mesh what is known of its vertices.
  RefineRun(TriMesh&& unrefined, const Pslg& input, const RefineOptions& wanted, VertexNotes&& known,
            const RefineVariant& how);
  RefineRun(const RefineRun&) = delete;  // its parts hold references to one another
  RefineRun& operator=(const RefineRun&) = delete;

  const Pslg& pslg;
  const RefineOptions& options;
  RefineVariant variant;
  TriangleBound bound;
  TriangleBound strict;  // the same without wanted lengths
  EditMesh mesh;
  RefineStats stats;
  SteinerSearch search;
  VertexOps ops;
  double cos_lens;            // cosine of the angle under which a vertex that encroaches sees a subsegment
  double squared_resolution;  // no vertex is put nearer to another: there rounding decides what an angle is

  VertexNotes notes;
  std::vector<std::uint8_t> moves;  // one a vertex: relocations so far

  BadQueue queue;
  std::vector<TriId> touched;  // changed, and not yet looked at
  // One a fixed vertex: on a frozen edge that the run is to keep clear of; empty where there is none.
  std::vector<bool> frozen;
  std::unordered_map<TriId, Corners> deferred;
  std::set<std::pair<VertexId, VertexId>> stuck;  // subsegments that rounding lets no one split

  // Memory that is used again and again: who takes one of these fills it first.
  struct Memory {
    Patch patch;
    std::vector<VertexId> polygon;
    std::vector<Corners> fresh;
  } memory;
  PatchNumbers patch_numbers;
};

// Whether a triangle breaks the bounds and no corner of the input excuses it.
bool violatesBound(const RefineRun& run, TriId t);

// Whether a patch is next to a frozen edge, and is to be left alone for that.
bool isBarred(const RefineRun& run, const Patch& patch);

// Keeps a triangle for later, as long as it has the same corners.
inline void defer(RefineRun& run, TriId t) { run.deferred[t] = run.mesh.triangle(t).v; }
bool isDeferred(const RefineRun& run, TriId t);

// The local feature size of the input, from above: that of a vertex nearby and the distance to it. It grows with the
// distance from what is fine in the input as fast as any good mesh can.
double spacingAt(const RefineRun& run, const Point& x, const Patch& cavity);

// Of a new vertex.
void noteVertex(RefineRun& run, VertexId v, double spacing);

// Puts a triangle into the queue where it is bad; the same of all that were touched.
void enqueueIfBad(RefineRun& run, TriId t);
void enqueueTouched(RefineRun& run);

// Takes a free vertex out, and each that can go.
bool removeFreeVertex(RefineRun& run, VertexId v);
void stripFreeVertices(RefineRun& run);

// The mesh, which the run is then without.
TriMesh releaseMesh(RefineRun& run);

}  // namespace coastmesh
