#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/pslg.hpp"
#include "core/refine.hpp"
#include "core/run_control.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

struct ParallelOptions {
  int threads = 0;  // 0 takes all cores; never changes a result
};

struct MeshOptions {
  RefineOptions refine;
  bool shrink = true;
};

// Seconds of work, summed over threads.
struct MeshSeconds {
  double triangulate = 0.0;
  double refine = 0.0;
  double shrink = 0.0;
};

struct MeshedRegion {
  TriMesh mesh;
  RefineStats stats;
  MeshSeconds seconds;
};

// Runs `work(i)` for every i below `count` on the asked number of threads; large items should come first. Every call
// gets done unless `control.cancelled` answers true (then throws Cancelled) or a call throws (then the one with the
// least i is rethrown once all running ones have ended). `control.progress` is called from one thread at a time.
void forEachRegion(std::size_t count, const ParallelOptions& options, const RunControl& control,
                   const std::function<void(std::size_t)>& work);

// Triangulates, refines and shrinks one region. Throws BadPslg, Cancelled.
MeshedRegion meshRegion(const Pslg& pslg, const MeshOptions& options, const RunControl& control = {});

}  // namespace coastmesh
