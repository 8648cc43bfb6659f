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
  RefineOptions refine;
  bool coarsen = true;
  bool smooth = false;       // optimises for longer; where no lengths are wanted, at all
  bool one_piece = false;    // never cuts a region, however large
  bool mark_pieces = false;  // fill `MeshedRegion::piece_of`
  // Fills `stats.unresolved` for regions that are cut or closed; who judges the finished mesh himself does without.
  bool list_violations = true;
  // Who may take pieces off this process's hands; outlives the run. The mesh is the same. Null: nobody.
  const Helpers* helpers = nullptr;
  // Where the mesh of a region that is cut is kept after each round, and what an earlier run kept there, of which this
  // one goes on; outlives the run. The mesh is the same. Null: nowhere.
  const RegionCheckpoint* checkpoint = nullptr;
  // Of a mesh that is all of a sphere, as `refine.surface` says; where it is not empty, the region is what lies within
  // its ring, nothing of the input may lie beyond that, and the mesh is closed.
  SphereCap cap;
  RegionId cap_region = 0;   // that the cap lies in
  std::vector<Point> seeds;  // vertices to begin with, clear of the input and within the ring
  // In place of seeds, where there is no input: a closed mesh that keeps the lengths wanted, and is the result where it
  // keeps the bounds on angles. The ring's corners are its first vertices, the apex is the last.
  TriMesh lattice;
};

// Seconds by the clock of each stage, one after another; several threads may share in a stage.
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
  std::size_t pieces = 1;  // that it was cut into
  std::vector<std::uint32_t>
      piece_of;                    // one a triangle where asked for: its piece in the round that was cut into the most
  std::optional<PslgCover> cover;  // of the PSLG, where its labels do not tell all
  WorkLog log;
};

// Triangulates, refines and coarsens one region; a large one is cut into pieces for that. A closed mesh has the
// vertices of the PSLG first, as any other, and no edge with one triangle alone. Throws BadPslg, Cancelled,
// BadCheckpoint where what was kept is of something else, and std::invalid_argument for options beyond their ranges.
MeshedRegion meshRegion(const Pslg& pslg, MeshOptions options, const RunControl& control = {});

}  // namespace coastmesh
