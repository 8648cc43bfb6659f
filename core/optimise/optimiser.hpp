#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/metric.hpp"
#include "core/optimise/exchange_diagonal.hpp"
#include "core/optimise/triangle_cost.hpp"
#include "core/pslg.hpp"
#include "core/refine/refine_options.hpp"
#include "core/refine/submesh.hpp"
#include "core/refine/vertex_ops.hpp"
#include "core/run_control.hpp"

namespace coastmesh {

// Triangles of a poorer shape than this are repaired one by one.
inline constexpr double kPoorShape = 0.9;

// One run over a mesh. optimiser.cpp has the operations at a vertex, mend_poorest.cpp those on triangles that are still
// poor afterwards, mend_short.cpp those on edges shorter than the least length.
class Optimiser {
  static constexpr double kEnoughCentred = 0.035;  // the cotangent of 88 degrees

 public:
  Optimiser(TriMesh&& mesh, const Pslg& pslg, const RefineOptions& options);
  // For a part of a larger mesh: processes only the due vertices, and none beside frozen edges.
  Optimiser(MeshState&& state, const Pslg& pslg, const RefineOptions& options);
  Optimiser(const Optimiser&) = delete;
  Optimiser& operator=(const Optimiser&) = delete;

  // Processes every due vertex in `sweeps` sweeps, then the poorest triangles.
  void run(int sweeps, const RunControl& control);

  TriMesh release() { return mesh_.release(); }
  MeshState releaseState();
  RefineStats& stats() { return stats_; }

 private:
  // What failed at a vertex. It is tried again once triangles around it change other than by moves: of attempts without
  // that, one in a hundred succeeds.
  static constexpr std::uint8_t kMerging = 1, kBalancing = 2;
  // An attempt to improve a poor triangle, at one of its corners or at the edge opposite.
  enum class Change { None, Remove, Insert, Split, RemoveShort };
  struct Trial {
    Change change = Change::None;
    unsigned corner = 0;
  };
  // Measures of the triangles around a vertex.
  struct StarCost {
    double sum;          // sum of their costs
    double least_shape;  // quality of the poorest
    std::uint64_t poor;  // bit i: triangle i of the ring is poor
  };
  // What a triangle of the ring has in common at all places of the vertex.
  struct Sector {
    Point along;     // the edge opposite the vertex
    double squared;  // its squared length
    double ideal;    // twice the area of an equilateral triangle of the requested length
    double inverse_ideal;
  };
  // A place of the frame to move to, and the quality of the poorest triangle there.
  struct Move {
    Point to;
    double least_shape;
  };
  // By how much edges are shorter than the least length.
  struct Shortness {
    double sum;       // in shares of that length
    double shortest;  // the shortest edge
  };
  struct PoorTriangle {
    double shape;
    TriId triangle;
    Corners corners;
  };

  // A patch of another run's mesh, to try an operation in.
  Optimiser(const Submesh& patch, const Optimiser& parent);

  bool isDue(VertexId v) const { return due_.empty() || due_[v]; }

  void sweep(bool merges, bool balances, const RunControl& control, double from, double to);
  bool gatherRing(VertexId v);
  bool gatherOnSegment(VertexId v);
  bool look(VertexId v);
  SegmentId segmentTo(VertexId v, std::size_t i) const;

  void noteWanted();
  double wantedAt(VertexId v);
  void noteSectors(VertexId v);
  StarCost costRound(const Point& place, double limit) const;
  StarCost costHere(VertexId v, Point& centre, std::size_t& poorest) const;
  double goalAt(VertexId v, const Point& place, std::uint64_t poor) const;
  double linkGoal(const Point& p, const Point& q, const Point& left, const Point& right) const {
    return isLinkClearOf(enoughLink(), p, q, left, right) ? 1.0 : linkShareOf(p, q, left, right) / enoughLink();
  }
  double enoughLink() const { return goal_ == QualityGoal::Links ? 0.22 : 0.12; }
  std::optional<Move> placeForGoal(VertexId v, const StarCost& now) const;
  std::optional<Move> betterPlace(VertexId v);
  std::optional<Move> betterPlaceOnSegment(VertexId v, Point to, const StarCost& now) const;
  bool keepsGoal(VertexId v, const Point& place, const StarCost& then, double held) const;
  bool flipsAt(VertexId v, const Point& place) const;
  bool move(VertexId v);
  bool mergeShort(VertexId v);
  bool mergeInto(VertexId v, VertexId stays);
  int excess(VertexId v);
  void countExcesses();
  void balance(VertexId v);
  void mergeTooFew(VertexId v);
  void exchangeTooMany(VertexId v);
  void wakePoor();
  void wake();
  void clearFutile();

  void mendPoorest(const RunControl& control, double share);
  // Returns the best result for a patch, and the change that it begins with; nullopt if nothing improves it.
  using BestOfPatch = std::optional<TriMesh> (Optimiser::*)(const Submesh&, Change&) const;
  bool mendPlace(TriId t, unsigned rings, BestOfPatch best_of);
  void mendShortEdges(const RunControl& control, double share);
  bool mendShort(const RunControl& control, double share, unsigned rings);
  std::optional<TriMesh> bestWithoutShort(const Submesh& patch, Change& by) const;
  double lengthOf(EdgeRef e) const;
  bool isShort(EdgeRef e) const;
  Shortness shortness() const;
  bool takeOutShort();
  void settle();
  bool divideWorst();
  std::optional<TriMesh> bestOf(const Submesh& patch, Change& by) const;
  void takePatch(const Submesh& patch, const TriMesh& solved);
  bool isWorthTrying(const Trial& trial);
  bool change(const Trial& trial);
  bool halveSegment(EdgeRef e);
  // Without a vertex limit: pieces of a mesh cannot see how much of a shared one is left.
  bool isFreeToGrow() const { return options_.max_vertices > std::numeric_limits<std::uint64_t>::max() / 2; }
  void noteAdded(VertexId v);
  double costOfAll() const;
  double goalOfAll() const;
  double shortestShare() const;
  double longestEdge() const;
  double shapeOfTriangle(TriId t) const;
  bool isPoor(TriId t) const;
  bool isHeldByFrozen(const Submesh& patch) const;
  bool wouldFlip(const Submesh& patch, const TriMesh& solved) const;

  // True if a triangle with this doubled area and this sum of squared edges in the frame is certainly counter-clockwise
  // and within the bounds on angles.
  bool isClear(double doubled, double squares) const {
    constexpr double kSmall = 1e-4;  // of the frame: beyond it shapes differ from those on the sphere
    return 2.0 * kRootOfThree * doubled > clear_shape_ * squares && bound_.surface.curvature * squares < kSmall;
  }
  const Point& corner(std::size_t i) const {
    return mesh_.point(ring_.corners[i < ring_.corners.size() ? i : i - ring_.corners.size()]);
  }
  double squaredLengthOf(VertexId v, VertexId w) const {
    return bound_.surface.squaredChord(mesh_.point(v), mesh_.point(w));
  }
  double wantedOf(std::size_t i) const {
    return wanted_[ring_.corners[i < ring_.corners.size() ? i : i - ring_.corners.size()]];
  }

  const Pslg& pslg_;
  const RefineOptions& options_;
  const SizeFunction* size_;  // may be null
  QualityGoal goal_;
  TriangleBound bound_;
  EditMesh mesh_;
  VertexOps ops_;
  DiagonalExchange exchange_;
  double clear_shape_;   // triangles of a better shape meet the bound
  bool flips_may_harm_;  // flips preserve the smallest angle, but not the largest, nor the longest edge
  bool is_submesh_ = false;
  bool any_bad_ = false;  // whether there is a triangle excused by the input, which must not change
  bool mends_poor_ = false;
  bool goes_far_ = false;  // whether over-relaxation is tried
  RefineStats stats_;
  std::vector<double> wanted_;        // the requested length at each vertex
  std::vector<std::uint8_t> active_;  // for each vertex: whether its surroundings changed since its last turn
  std::vector<std::uint8_t> futile_;  // for each vertex: kMerging, kBalancing, or both
  std::vector<std::uint8_t> due_;     // one for each vertex; empty if all are
  std::vector<VertexId> waiting_;     // corners of poor triangles, for the next round

  // Scratch.
  Ring ring_;  // of the current vertex; on the boundary it has one corner more than triangles
  // Position of that vertex when the ring was gathered: the frame in which positions and costs are computed.
  Frame frame_{{}, {}};
  std::vector<Point> seen_;             // the ring's corners in the frame; of a closed ring the first two follow again
  std::vector<Sector> sectors_;         // for each triangle of the ring
  bool is_open_ = false;                // whether that vertex is on the boundary
  SegmentId segment_ = kNone;           // its segment; kNone if it is free
  std::array<std::size_t, 2> along_{};  // the ends of its two subsegments, as indices in the ring
  std::vector<EdgeRef> star_;
  std::vector<int> excesses_;  // of the ring's corners
  std::vector<TriId> touched_;
  PatchNumbers patch_numbers_;
};

}  // namespace coastmesh
