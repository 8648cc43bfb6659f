#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/ids.hpp"
#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"
#include "parallel/recorder.hpp"

namespace coastmesh {

using PieceId = std::uint32_t;

// A tree of cuts along straight lines, by repeated halving. Without nodes there is one piece.
struct CutTree {
  struct Node {
    unsigned axis = 0;
    double cut = 0.0;
    std::array<std::uint32_t, 2> below{};  // its children, below the cut and above it
    PieceId piece = 0;                     // of a leaf
    bool leaf = true;
  };
  double cosine = 1.0, sine = 0.0;  // of the angle by which the cuts are turned
  std::vector<Node> nodes;

  std::array<double, 2> turn(const Point& p) const;
  PieceId pieceAt(const std::array<double, 2>& turned) const;
};

// The piece of each triangle.
struct Partition {
  PieceId pieces = 0;
  BulkList<PieceId> piece_of;  // one for each triangle; kNone if it is in no piece
  // The triangles of piece p, in the order of their numbers: triangles[first[p]] to triangles[first[p + 1]].
  BulkList<TriId> triangles;
  std::vector<std::size_t> first;
  BulkList<TriId> slot_of;  // for each triangle: its index within its piece
  CutTree tree;

  std::span<const TriId> of(PieceId p) const { return std::span(triangles).subspan(first[p], first[p + 1] - first[p]); }
};

// Cuts a mesh into pieces of similar weight by straight lines along two perpendicular directions: halves, halves of
// these, and so on (Bentley's k-d tree). Depends only on its arguments.
//   some       the triangles to partition, ascending; the others are in no piece. Empty: all triangles
//   weight(t)  the weight of a triangle, above 0
//   angle      radians, by which the directions are turned; cuts at other angles meet these only in single points
//   parts      the result; its previous contents are lost, but their memory is reused
void partition(const TriMesh& mesh, std::span<const TriId> some, PieceId pieces, double angle,
               const std::function<double(TriId)>& weight, Recorder& recorder, Partition& parts);

// The piece that contains each triangle's centroid.
std::vector<PieceId> piecesOf(const TriMesh& mesh, const CutTree& tree, const ItemLoop& loop);

}  // namespace coastmesh
