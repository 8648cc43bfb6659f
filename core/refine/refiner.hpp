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
#include "core/refine/vertex_notes.hpp"
#include "core/refine/vertex_ops.hpp"
#include "core/run_control.hpp"

namespace coastmesh {

// The ends of a subsegment come no nearer to one another than this share of the input's spacing.
inline constexpr double kSegmentShare = 0.02;

// What runs differ in. Repair tries several on a patch.
struct RefineVariant {
  double aim_deg = 0.0;      // new points aim at an angle this much above the bound
  bool worst_first = false;  // smallest angle first, not shortest edge
  double free_share = 0.0;   // least distance to other vertices, as a share of the input's spacing
  // Leaves alone what reaches a frozen edge, and keeps it for later. Else a frozen edge is a wall like a segment.
  bool clear_of_frozen = false;
};

RefineVariant usualVariant(const RefineOptions& options);

// The state of one refinement run.
class Refiner {
 public:
  // The notes are those of `noteInput`, or on a part of a larger mesh what is known of its vertices.
  Refiner(TriMesh&& mesh, const Pslg& pslg, const RefineOptions& options, VertexNotes&& notes,
          const RefineVariant& variant);

  // Handles bad triangles until none is left that a point could mend.
  void run(const RunControl& control);
  TriMesh release();
  // The same, and what else a run on a part of a larger mesh has to give back: notes on its vertices, and one flag a
  // triangle for those that it kept for later.
  TriMesh release(VertexNotes& notes, std::vector<std::uint8_t>& due);
  RefineStats& stats() { return stats_; }

  EditMesh& mesh() { return mesh_; }
  const EditMesh& mesh() const { return mesh_; }
  const VertexNotes& notes() const { return notes_; }
  // Whether a triangle breaks the bounds and no corner of the input excuses it.
  bool violatesBound(TriId t) const;
  void noteVertex(VertexId v, double spacing);
  // Keeps a triangle for later.
  void defer(TriId t) { deferred_[t] = mesh_.triangle(t).v; }
  bool isDeferred(TriId t) const;
  bool isClearOfFrozen() const { return variant_.clear_of_frozen; }
  // Takes out every free vertex that can go.
  void stripFreeVertices();
  // What becomes of the other sides of the segments at an input angle when its fan grows.
  enum class Beyond { StaysGood, GetsMended };
  // At input angles too small for the bounds: takes split points out until the triangle that fills the angle reaches to
  // where good ones begin. What lies between is too thin to be meshed well, and that one triangle does for all of it.
  void growFans(Beyond beyond, const RunControl& control);
  // The triangle that fills an input angle too small for the bounds, and those beyond it up to the last one that falls
  // short: they form a strip as long as each has all its corners on the two sides of the angle. Empty where t fills no
  // such angle, or none falls short.
  std::vector<TriId> shortStrip(TriId t) const;
  // Handles the bad ones among these triangles, and what follows from that.
  void resume(std::vector<TriId>& touched, const RunControl& control);

 private:
  double squaredResolution() const;
  void enqueueIfBad(TriId t);
  void enqueueTouched();
  void findFrozenVertices();
  bool isBarred(const Patch& patch) const;
  void mend(TriId t);
  bool isLeftAlone(TriId t, const TriangleShape& shape) const;
  bool isOutOfReach(TriId t, const TriangleShape& shape) const;
  bool isFan(TriId t, VertexId apex) const;
  VertexId fanApexOf(TriId t) const;
  void growFan(TriId fan, VertexId apex, Beyond beyond);
  void growAllFans(Beyond beyond);
  bool mendWithoutInsertion(TriId t);
  bool mayMerge() const;
  bool insertPoint(TriId t, unsigned apex);
  bool splitFor(EdgeRef edge, TriId t, unsigned apex);
  double spacingAt(const Point& x, const Patch& cavity) const;
  double spacingOnSegment(const Point& x, EdgeRef edge, const Patch& cavity) const;
  bool removeFreeVertex(VertexId v);
  void drainQueue(const RunControl& control);
  Point splitPlace(VertexId a, VertexId b, SegmentId seg) const;
  bool isEncroached(const Point& x, const Point& a, const Point& b) const;
  EdgeRef clearDiametralCircle(EdgeRef edge);
  VertexId fanApexBehind(TriId t, unsigned apex) const;

  const Pslg& pslg_;
  const RefineOptions& options_;
  RefineVariant variant_;
  TriangleBound bound_;
  TriangleBound strict_;  // the same without wanted lengths
  EditMesh mesh_;
  RefineStats stats_;
  SteinerSearch search_;
  VertexOps ops_;
  double cos_lens_;
  double squared_resolution_;  // no vertex is put nearer to another: there rounding decides what an angle is

  VertexNotes notes_;
  std::vector<std::uint8_t> moves_;  // one a vertex: relocations so far

  BadQueue queue_;
  std::vector<bool>
      frozen_;  // one a fixed vertex: on a frozen edge that the run is to keep clear of; empty where there is none
  std::unordered_map<TriId, Corners> deferred_;
  std::set<std::pair<VertexId, VertexId>> stuck_;  // subsegments that rounding lets no one split

  // Scratch.
  std::vector<TriId> touched_;
  std::vector<VertexId> polygon_;
  std::vector<Corners> fresh_;
  Patch patch_;
};

}  // namespace coastmesh
