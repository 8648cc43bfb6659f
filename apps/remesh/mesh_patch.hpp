#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "apps/job/mesh_job_result.hpp"
#include "apps/remesh/remesh_options.hpp"
#include "core/item_loop.hpp"
#include "core/run_control.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"
#include "gis/remesh/remesh_patch.hpp"
#include "gis/remesh/replace_patches.hpp"
#include "gis/remesh/rim_shortfall.hpp"
#include "gis/size/size_source.hpp"

namespace coastmesh {

// The new mesh of a patch, and what is known of it.
struct MeshedPatch {
  PatchMesh made;
  RimReach rim;
  bool has_shore = true;
  Shortfall short_of;
  RimShortfall at_rim;
};

// Meshes patches of a grid, whose links are given; all but these must outlive it.
class PatchMesher {
 public:
  PatchMesher(const Grid& grid, const TriMesh& links, const RemeshOptions& options, const SizeInputs& inputs,
              const ItemLoop& loop);

  // Sets the coast of a patch with a flood plain, or near one, to which sizes at the shore apply too.
  void setCoast(Domain& domain) const;
  // `control`: of this patch. Throws InputError: a patch that cannot be meshed, too many vertices; Cancelled.
  MeshedPatch mesh(const RemeshPatch& patch, const RunControl& control) const;

 private:
  std::unique_ptr<SizeFunction> sizesOf(const RemeshPatch& patch, MeshedPatch& result) const;

  const Grid& grid_;
  std::vector<NodePair> shore_, coast_;
  const RemeshOptions& options_;
  const SizeInputs& inputs_;
  const ItemLoop& loop_;
};

}  // namespace coastmesh
