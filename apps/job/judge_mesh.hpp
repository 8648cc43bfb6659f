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

// The plane in which a group of features is meshed.
struct WorkingPlane {
  Projection projection;
  double size_max;  // longest edge, units of its surface; infinite if there is no bound
};

struct MeshJudgement {
  MeshQuality quality;
  Shortfall short_of;
};

// Finds the triangles of a finished mesh that miss the bounds of `options` on angles, and of the plane on lengths.
// `slack_deg` as in `judgeFinished`; `places`: the mesh's points in space, empty if the plane is the surface.
MeshJudgement judgeMesh(const TriMesh& mesh, const WorkingPlane& plane, const RefineOptions& options, double slack_deg,
                        std::span<const SpacePoint> places, const ItemLoop& loop = inOrder);

// A group in a grid of several groups, one after another, with its first feature there. Its projection is fitted again
// when needed: most runs never need it, and some have a million groups.
struct MergedGroup {
  std::size_t group;
  double size_max;  // as in WorkingPlane
  std::uint32_t first_feature;
};

// The triangles of each group, ascending; a grid without features is one group. REQUIRES: `groups` ascend by their
// first features.
std::vector<std::vector<std::uint32_t>> trianglesOfGroups(const Grid& grid, const std::vector<MergedGroup>& groups);

}  // namespace coastmesh
