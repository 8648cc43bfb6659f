#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "apps/job/mesh_job_result.hpp"
#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "core/quality.hpp"
#include "core/refine/refine_options.hpp"
#include "core/space_point.hpp"
#include "core/tri_mesh.hpp"
#include "gis/model/apart_waters.hpp"
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

// Replaces the angles of some triangles, which may be measured a little differently, by up to `slack_deg`. Returns
// false, and changes nothing, if the smallest or the largest angle of all may be one of them: all have to be measured
// then.
bool replaceAngles(std::span<const std::array<double, 3>> before, std::span<const std::array<double, 3>> after,
                   double slack_deg, MeshQuality& quality);

// A group in a grid of several groups, one after another, with its first feature there. Its projection is fitted again
// when needed: most runs never need it, and some have a million groups.
struct MergedGroup {
  std::size_t group;
  double size_max;  // as in WorkingPlane
  std::uint32_t first_feature;
  std::uint32_t first_node, input_nodes;  // vertices of the input come first
  std::optional<double> input_area_m2;
};

// The triangles of each group, ascending; a grid without features is one group. REQUIRES: `groups` ascend by their
// first features.
std::vector<std::vector<std::uint32_t>> trianglesOfGroups(const Grid& grid, const std::vector<MergedGroup>& groups);

// The vertices of the input in a grid that repairs may change.
class InputVertices {
 public:
  InputVertices() = default;
  // Of the grid as the groups made it.
  InputVertices(const Grid& grid, const std::vector<MergedGroup>& groups);

  // The nodes of the grid that are not vertices of the input: those that were added or moved.
  std::uint64_t othersIn(const Grid& grid) &&;

 private:
  std::vector<Point> places_;
};

// The area of the input without the waters that were dropped: the whole area of groups of which nothing is left, and
// what the mesh had of the others. `area_m2`: before; `grid`: after.
double inputAreaLeft(double area_m2, const Grid& grid, const std::vector<MergedGroup>& groups,
                     const DroppedWaters& dropped);

}  // namespace coastmesh
