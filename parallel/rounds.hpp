#pragma once

#include "core/item_loop.hpp"
#include "core/pslg.hpp"
#include "core/refine/refine.hpp"
#include "core/run_control.hpp"
#include "core/tri_mesh.hpp"
#include "parallel/cut.hpp"
#include "parallel/deal.hpp"
#include "parallel/partition.hpp"
#include "parallel/work_log.hpp"

namespace coastmesh {

class RoundKeeper;

// The approximate number of triangles that refinement will make of a mesh.
double expectedTriangles(const TriMesh& mesh, const RefineOptions& options, const ItemLoop& loop = inOrder);

// State shared by rounds, and by refinement, coarsening and optimisation.
struct RoundsWorkspace {
  Partition parts;                        // reused for its memory: fresh memory costs more than writing to it
  const HelpedRegion* helpers = nullptr;  // helpers that process pieces
  // Cores are kept out of the mesh, and what refinement leaves bad beside them is repaired after their insertion.
  bool has_cores = false;
  bool are_segments_split = false;  // already, as `splitSegments` would
  // Where the mesh is saved after each round, and resumed from; null: nowhere. Repairs are not saved.
  RoundKeeper* keeper = nullptr;
};

// Results of rounds besides the mesh.
struct RoundsReport {
  RefineStats stats;       // without `steiner_points` and `unresolved`
  std::size_t pieces = 0;  // of the round with the most pieces
  CutTree cuts;            // of that round
  WorkLog log;
};

// Refines a mesh made by `constrainedDelaunay(pslg)` in rounds: the mesh is cut into pieces along straight lines, the
// pieces are refined in parallel, each away from its cuts, and stitched; the next round cuts at another angle, so that
// the remaining work is inside its pieces. If an edge length is requested, rounds approach it in steps, so that pieces
// never consist of few large triangles. The result does not depend on the number of threads. `notes` are those on the
// mesh, including its free vertices. Throws Cancelled, OutOfRoom.
RoundsReport refineInRounds(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, VertexNotes notes,
                            const RunControl& control, RoundsWorkspace& workspace);

// How to mend triangles that miss the bounds, in a mesh that meets them almost everywhere.
enum class Mending {
  RepairInPieces,  // repairs that change only patches around them, in up to four rounds
  RepairUncut,     // the same in the whole mesh
  Refine,          // refines them in rounds
};
RoundsReport mendInRounds(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, VertexNotes notes, Mending how,
                          const RunControl& control, RoundsWorkspace& workspace);

// Coarsens in rounds of the same kind.
RoundsReport coarsenInRounds(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, const RunControl& control,
                             RoundsWorkspace& workspace);

// Optimises in rounds of the same kind: see `optimise`.
RoundsReport optimiseInRounds(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, int sweeps,
                              const RunControl& control, RoundsWorkspace& workspace);

}  // namespace coastmesh
