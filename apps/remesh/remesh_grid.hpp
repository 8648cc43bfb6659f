#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "apps/job/mesh_job_result.hpp"
#include "apps/remesh/remesh_options.hpp"
#include "apps/remesh/triangle_figures.hpp"
#include "core/item_loop.hpp"
#include "core/run_control.hpp"
#include "gis/cut/tidy_cut.hpp"
#include "gis/grid/grid.hpp"
#include "gis/model/depth.hpp"
#include "gis/remesh/replace_patches.hpp"

namespace coastmesh {

struct RemeshReport {
  ReplaceReport replaced;
  TidiedCut tidied;
  std::size_t taken_in = 0;  // triangles replaced although they had no flag, or were left out by `tidyCut`
  std::size_t quads_before = 0, quads = 0;  // quadrilaterals, of which those in the part are replaced too
  std::size_t patches = 0;
  std::size_t whole_edges = 0;   // of weirs, and of boundaries within the mesh: kept as they are
  RimReach rim;                  // the widest, and the mean share by triangles
  std::size_t land_unknown = 0;  // replaced triangles above the water of a mesh that does not tell land from water
  bool has_shore = true;         // false: sizes at the shore are requested, but no patch has one near
  // New triangles that miss the bounds on angles, beside edges that stay: no corner of the outline excuses them.
  std::size_t below_bounds = 0;
  std::optional<BoundViolationPlace> worst_below{};  // that with the smallest angle, in the grid's CRS
  TriangleFigures inside, outside;                   // of triangles that are no halves
  DepthReport depth;
};

// Replaces the triangles with a flag in `taken`, one for each, by triangles of the requested sizes: without those that
// models would reject at the edge of the part (`tidyCut`, unless it is said which triangles stay), but with single ones
// that would stay within it, and with those that would cost new triangles the bounds on angles, as far as they have a
// node of one with a flag. All others stay bit for bit: see `replacePatches`. Sizes join those of the triangles around
// by the gradation. Throws InputError: edges of more than two triangles in the part, a part that cannot be meshed, too
// many vertices; Cancelled. REQUIRES: at least one flag is set.
RemeshReport remeshGrid(Grid& grid, std::vector<std::uint8_t> taken, const RemeshOptions& options,
                        const RunControl& control = {}, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
