#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "core/bad_queue.hpp"
#include "core/edit_mesh.hpp"
#include "core/metric.hpp"
#include "core/pslg.hpp"
#include "core/refine.hpp"
#include "core/steiner.hpp"
#include "core/vertex_ops.hpp"

namespace coastmesh {

// What a run knows of vertices besides their places.
struct VertexNotes {
  std::vector<double> spacing;     // one a vertex: the local feature size of the input there, from above
  std::vector<double> shell_unit;  // one an input vertex: radius of a shell round it; 0 where no small angle is there
  std::vector<bool> small_angle;   // one an input vertex: some sector of it is too small for the bounds
};

// How a run on a patch differs from the usual one: repair tries several.
struct RefineVariant {
  double aim_deg = 0.0;      // new points aim at an angle this much above the bound
  bool worst_first = false;  // smallest angle first, not shortest edge
  double free_share = 0.0;   // least distance to other vertices, as a share of the input's spacing
};

// The state of one refinement run.
class Refiner {
 public:
  Refiner(TriMesh&& mesh, const Pslg& pslg, const RefineOptions& options);
  // On a patch of a larger mesh: what is known of its vertices comes along.
  Refiner(TriMesh&& mesh, const Pslg& pslg, const RefineOptions& options, VertexNotes&& notes,
          const RefineVariant& variant);

  // Handles bad triangles until none is left that a point could mend.
  void run(const RunControl& control);
  TriMesh release();
  RefineStats& stats() { return stats_; }

  EditMesh& mesh() { return mesh_; }
  const VertexNotes& notes() const { return notes_; }
  const TriangleBound& bound() const { return bound_; }
  // Whether a triangle breaks the bounds and no input angle explains it.
  bool isShort(TriId t) const;
  void noteVertex(VertexId v, double spacing);
  // Takes out every free vertex that can go.
  void stripFreeVertices();
  // Handles the bad ones among these triangles, and what follows from that.
  void resume(std::vector<TriId>& touched, const RunControl& control);

 private:
  void findInputAngles();
  bool mayBeSmall(TriId t, unsigned i) const;
  void findSpacing();
  double squaredGrain() const;
  void enqueueIfBad(TriId t);
  void enqueueTouched();
  void mend(TriId t);
  bool isLeftAlone(TriId t, const TriangleShape& shape) const;
  bool isFan(TriId t, VertexId apex) const;
  bool mendWithoutInsertion(TriId t);
  bool mayMerge() const;
  bool insertPoint(TriId t, unsigned apex);
  bool splitFor(EdgeRef edge, TriId t, unsigned apex);
  double spacingAt(const Point& x, const Patch& cavity) const;
  double spacingOnSegment(const Point& x, EdgeRef edge, const Patch& cavity) const;
  bool isExplained(TriId t) const;
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
  EditMesh mesh_;
  RefineStats stats_;
  SteinerSearch search_;
  VertexOps ops_;
  double cos_lens_;
  double free_share_;
  double squared_grain_;  // no vertex is put nearer to another: there rounding decides what an angle is

  VertexNotes notes_;
  std::vector<std::uint8_t> moves_;  // one a vertex: relocations so far

  BadQueue queue_;
  std::set<std::pair<VertexId, VertexId>> stuck_;  // subsegments that rounding lets no one split

  // Scratch.
  std::vector<TriId> touched_;
  std::vector<VertexId> polygon_;
  std::vector<Corners> fresh_;
  Patch patch_;
};

}  // namespace coastmesh
