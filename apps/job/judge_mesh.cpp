#include "apps/job/judge_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/refine/bound_violations.hpp"

namespace coastmesh {

void Shortfall::add(Shortfall&& other) {
  count += other.count;
  for (const BoundViolationPlace& place : other.places)
    if (places.size() < kBoundViolationPlaces) places.push_back(place);
}

MeshJudgement judgeMesh(const TriMesh& mesh, const WorkingPlane& plane, const RefineOptions& options, double slack_deg,
                        std::span<const SpacePoint> places, const ItemLoop& loop) {
  MeshJudgement result{measureQuality(mesh, 0.0, 180.0, loop, places), {}};
  const BoundJudgement judgement = judgeFinished(mesh, options.min_angle_deg, options.max_angle_deg, plane.size_max,
                                                 slack_deg, loop, plane.projection.surface(), places);
  result.quality.bounds = judgement.counts;
  result.short_of.count = judgement.unresolved.size();
  const std::size_t listed = std::min(judgement.unresolved.size(), kBoundViolationPlaces);
  for (std::size_t i = 0; i < listed; ++i) {
    const BoundViolation& violation = judgement.unresolved[i];
    result.short_of.places.push_back(
        {plane.projection.inverse(violation.place), violation.min_angle_deg, violation.max_angle_deg});
  }
  return result;
}

std::vector<std::vector<std::uint32_t>> trianglesOfGroups(const Grid& grid, const std::vector<MergedGroup>& groups) {
  std::vector<std::vector<std::uint32_t>> triangles(groups.size());
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) {
    const std::uint32_t feature = grid.feature_of.empty() ? 0 : grid.feature_of[t];
    const auto after = std::ranges::upper_bound(groups, feature, {}, &MergedGroup::first_feature);
    triangles[static_cast<std::size_t>(after - groups.begin()) - 1].push_back(t);
  }
  return triangles;
}

}  // namespace coastmesh
