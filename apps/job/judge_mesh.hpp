#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/job/mesh_job_result.hpp"
#include "core/item_loop.hpp"
#include "core/quality.hpp"
#include "core/refine/refine_options.hpp"
#include "core/space_point.hpp"
#include "core/tri_mesh.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// What a group of features is meshed in.
struct WorkingPlane {
  Projection projection;
  double size_max;  // longest edge, units of its surface; infinite where none is asked
};

struct MeshJudgement {
  MeshQuality quality;
  Shortfall short_of;
};

// A finished mesh and what of it falls short of the bounds of `options` on angles, and of the plane's on lengths.
// `slack_deg` as in `judgeFinished`; `places` are the plane's in space.
MeshJudgement judgeMesh(const TriMesh& mesh, const WorkingPlane& plane, const RefineOptions& options, double slack_deg,
                        std::span<const SpacePoint> places, const ItemLoop& loop = inOrder);

// A group in a grid that has several, one after another: the first of its features there. Its projection is fitted anew
// where it is wanted: most runs never ask for it again, and some have a million groups.
struct MergedGroup {
  std::size_t group;
  double size_max;  // as in WorkingPlane
  std::uint32_t first_feature;
};

// The triangles of each group, ascending; a grid without features is one group. REQUIRES: `groups` ascend by their
// first features.
std::vector<std::vector<std::uint32_t>> trianglesOfGroups(const Grid& grid, const std::vector<MergedGroup>& groups);

}  // namespace coastmesh
