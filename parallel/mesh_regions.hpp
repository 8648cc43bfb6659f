#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/point.hpp"
#include "core/pslg.hpp"
#include "core/refine/refine.hpp"
#include "core/run_control.hpp"
#include "core/sphere/close_sphere.hpp"
#include "core/tri_mesh.hpp"
#include "parallel/work_log.hpp"

namespace coastmesh {

struct Helpers;
struct RegionCheckpoint;

struct MeshOptions {
  RefineOptions refine{};
  bool coarsen = true;
  bool smooth = false;       // optimise longer; required to optimise without requested lengths
  bool one_piece = false;    // never cut a region, however large
  bool mark_pieces = false;  // set `MeshedRegion::piece_of`
  // Set `stats.unresolved` for regions that are cut or closed; not needed by callers that judge the finished mesh.
  bool list_violations = true;
  // Helpers that process pieces; must outlive the run. The mesh does not depend on it. Null: none.
  const Helpers* helpers = nullptr;
  // Where the mesh of a cut region is saved after each round, and from where this run resumes an earlier one; must
  // outlive the run. The mesh does not depend on it. Null: nowhere.
  const RegionCheckpoint* checkpoint = nullptr;
  // For a mesh of a whole sphere (`refine.surface`): if not empty, the region is the inside of this ring, no input may
  // lie outside, and the mesh is closed at the end.
  SphereCap cap{};
  RegionId cap_region = 0;     // region of the triangles of the cap
  std::vector<Point> seeds{};  // initial vertices, clear of the input and within the ring
  // Instead of seeds, if there is no input: a closed mesh with the requested lengths, which is the result if it meets
  // the bounds on angles. The ring's corners are its first vertices, the apex is the last.
  TriMesh lattice{};
};

// Wall-clock seconds of each stage, one after another; several threads may share in a stage.
struct MeshSeconds {
  double triangulate = 0.0;
  double refine = 0.0;
  double coarsen = 0.0;
  double optimise = 0.0;
  double stitch = 0.0;
};

struct MeshedRegion {
  TriMesh mesh;
  RefineStats stats;
  MeshSeconds seconds;
  std::size_t pieces = 1;  // number of pieces
  std::vector<std::uint32_t>
      piece_of;                    // if requested: one for each triangle, its piece in the round with the most pieces
  std::optional<PslgCover> cover;  // of the PSLG, if its labels do not define everything
  WorkLog log;
};

// Triangulates, refines and coarsens one region, cut into pieces if it is large. The vertices of the PSLG come first,
// also in a closed mesh, which has no boundary. Throws BadPslg, Cancelled, OutOfRoom, HelperFailed and
// HelperOutOfMemory, BadCheckpoint if the saved state belongs to another input or other options, and
// std::invalid_argument for options out of range.
MeshedRegion meshRegion(const Pslg& pslg, MeshOptions options, const RunControl& control = {});

}  // namespace coastmesh
