#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/metric.hpp"
#include "core/optimise/triangle_cost.hpp"
#include "core/refine/vertex_ops.hpp"

namespace coastmesh {

// Exchanges the diagonal of two triangles although the present one is Delaunay: also moves the four corners so that the
// new one is. This removes two pairs of vertices with five and seven neighbours at once.
class DiagonalExchange {
 public:
  // `wanted`: the requested length at each vertex. All arguments must outlive this.
  DiagonalExchange(EditMesh& mesh, const VertexOps& ops, const TriangleBound& bound, const std::vector<double>& wanted)
      : mesh_(mesh), ops_(ops), bound_(bound), wanted_(wanted) {}

  // Replaces the edge from v to w by the edge from c, on its left, to d, on its right. REQUIRES: all four are free.
  // Does nothing and returns false unless all triangles around the four are then Delaunay and within the bounds, and
  // cost at most slightly more. Appends the triangles that changed to `touched`.
  bool tryExchange(VertexId v, VertexId w, VertexId c, VertexId d, std::vector<TriId>& touched);

 private:
  static constexpr std::uint32_t kMoved = 4;

  void number();
  std::uint32_t numberOf(VertexId v);
  double wantedIn(const Corners& t) const { return meanOf(wanted_[t[0]], wanted_[t[1]], wanted_[t[2]]); }
  double costBefore() const;
  double costAfter() const;
  void relax();
  bool isDelaunay() const;

  EditMesh& mesh_;
  const VertexOps& ops_;
  const TriangleBound& bound_;
  const std::vector<double>& wanted_;
  Patch patch_;                 // the triangles around the four
  std::vector<Corners> fresh_;  // their replacement
  Frame frame_{{}, {}};         // on a sphere, at the first of the four

  // The vertices of `fresh_`, numbered locally with the four first; their new positions, in the frame and in the plane;
  // the triangles with these numbers; and those around each of the four.
  std::vector<VertexId> vertices_;
  std::vector<Point> seen_, in_plane_;
  std::vector<Corners> numbered_;
  std::array<std::vector<std::uint32_t>, kMoved> around_;
};

}  // namespace coastmesh
