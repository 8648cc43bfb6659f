#pragma once

#include <cstdint>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/metric.hpp"
#include "core/refine/vertex_ops.hpp"

namespace coastmesh {

// Exchanges the diagonal of two triangles where a Delaunay triangulation of the points as they lie has the other one:
// moves the four corners as well, to where it is Delaunay. That takes away two pairs of vertices with five and seven
// neighbours at once.
class DiagonalExchange {
 public:
  // `wanted`, one a vertex: the length wanted there. All outlive this.
  DiagonalExchange(EditMesh& mesh, const VertexOps& ops, const TriangleBound& bound, const std::vector<double>& wanted)
      : mesh_(mesh), ops_(ops), bound_(bound), wanted_(wanted) {}

  // Replaces the edge from v to w by that from c, which is to its left, to d, to its right. REQUIRES: all four are
  // free. Does nothing and returns false unless all triangles round the four are Delaunay and within the bound then,
  // and cost no more than a little more. Appends the triangles that changed to `touched`.
  bool tryExchange(VertexId v, VertexId w, VertexId c, VertexId d, std::vector<TriId>& touched);

 private:
  void number();
  std::uint32_t numberOf(VertexId v);
  double wantedIn(const Corners& t) const { return (wanted_[t[0]] + wanted_[t[1]] + wanted_[t[2]]) / 3.0; }
  double costBefore() const;
  double costAfter() const;
  void relax();
  bool isDelaunay() const;

  EditMesh& mesh_;
  const VertexOps& ops_;
  const TriangleBound& bound_;
  const std::vector<double>& wanted_;
  Patch patch_;                 // the triangles round the four
  std::vector<Corners> fresh_;  // what they become
  Frame frame_{{}, {}};         // on a sphere, about the first of the four

  // The vertices of `fresh_`, which have numbers of their own here, those of the four first; where they are to be, in
  // the frame and in the plane; and the triangles by these numbers.
  std::vector<VertexId> vertices_;
  std::vector<Point> seen_, in_plane_;
  std::vector<Corners> numbered_;
};

}  // namespace coastmesh
