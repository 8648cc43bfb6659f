#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/piece.hpp"
#include "parallel/partition.hpp"

namespace coastmesh {

// A mesh between rounds, with what its pieces need.
struct Sheet {
  TriMesh mesh;  // no regions
  VertexNotes notes;
  std::vector<std::uint8_t> due_triangles;  // one a triangle, or empty
  std::vector<std::uint8_t> due_vertices;   // one a vertex, or empty
};

// An edge along which the mesh was cut.
struct CutEdge {
  VertexId a = kNone, b = kNone;  // in the piece's numbers, the piece to the left of a -> b
  EdgeRef name = kNone;           // the same on both sides
  SegmentId seg = kNone;          // what kFrozen stands for
};

// A piece and how it hangs together with the others.
struct CutPiece {
  Piece piece;
  std::vector<VertexId> fixed;  // the number in the sheet of each of the piece's first `input_vertices` vertices
  std::vector<CutEdge> edges;   // by a, then b
};

// Scratch of one thread: the local number of each vertex of the sheet, kNone between calls.
using VertexMarks = std::vector<VertexId>;

CutPiece cutOut(const Sheet& sheet, const Partition& partition, PieceId piece, VertexMarks& marks);

// Puts pieces together again: all of one partition, in order, each worked on or not. Restores the Delaunay property across the
// cuts and marks the triangles that this changes as due. Vertices are numbered anew: input vertices as before, then those on cuts, then
// each piece's own. `reused` lends its memory: fresh memory costs more than what is written to it.
Sheet stitch(std::vector<CutPiece>&& pieces, const Sheet& before, Recorder& recorder, Sheet&& reused = {});

}  // namespace coastmesh
