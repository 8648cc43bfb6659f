#pragma once

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

// About how many triangles refinement will make of a mesh.
double expectedTriangles(const TriMesh& mesh, const RefineOptions& options);

// What rounds lend to one another, and refining to coarsening.
struct RoundsWorkspace {
  Partition parts;                        // for its memory alone: fresh memory costs more than what is written to it
  const HelpedRegion* helpers = nullptr;  // who may take pieces off this process's hands
  // Where the mesh is kept after each round, and is gone on from; null: nowhere. Mending is not kept.
  RoundKeeper* keeper = nullptr;
};

// What rounds did, besides the mesh.
struct RoundsReport {
  RefineStats stats;       // without `steiner_points` and `unresolved`
  std::size_t pieces = 0;  // of the round that was cut into the most
  CutTree cuts;            // of that round
  WorkLog log;
};

// Refines a mesh made by `constrainedDelaunay(pslg)` in rounds: the mesh is cut into pieces along straight lines, the
// pieces are refined at the same time, each clear of the cuts, and put together again; the next round cuts under
// another angle, so that what was left lies inside its pieces. Where an edge length is asked, rounds come to it by
// steps, so that pieces never consist of few large triangles. The result does not depend on the number of threads.
// `notes` are those on the mesh, with the free vertices that it has already. Throws Cancelled.
RoundsReport refineInRounds(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, VertexNotes notes,
                            const RunControl& control, RoundsWorkspace& workspace);

// Refines what falls short in a mesh that holds the bounds nearly everywhere, in rounds of the same kind; or repairs it
// alone, in one round, which spreads no further than patches reach.
RoundsReport mendInRounds(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, VertexNotes notes,
                          bool repairs_alone, const RunControl& control, RoundsWorkspace& workspace);

// Coarsens in rounds of the same kind.
RoundsReport coarsenInRounds(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, const RunControl& control,
                             RoundsWorkspace& workspace);

// Optimises, in rounds of the same kind: see `optimise`.
RoundsReport optimiseInRounds(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, int sweeps,
                              const RunControl& control, RoundsWorkspace& workspace);

}  // namespace coastmesh
