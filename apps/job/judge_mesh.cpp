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

bool replaceAngles(std::span<const std::array<double, 3>> before, std::span<const std::array<double, 3>> after,
                   double slack_deg, MeshQuality& quality) {
  for (const auto& angles : before)
    for (const double angle : angles)
      if (angle <= quality.min_angle_deg + slack_deg || angle >= quality.max_angle_deg - slack_deg) return false;
  const auto countOf = [&](double angle_deg) -> std::uint64_t& {
    auto& counts = quality.angle_histogram;
    const auto at = static_cast<std::size_t>(angle_deg / 180.0 * static_cast<double>(counts.size()));
    return counts[std::min(at, counts.size() - 1)];
  };
  for (const auto& angles : before)
    for (const double angle : angles)
      if (std::uint64_t& count = countOf(angle); count > 0) --count;
  for (const auto& angles : after) {
    for (const double angle : angles) {
      ++countOf(angle);
      quality.min_angle_deg = std::min(quality.min_angle_deg, angle);
      quality.max_angle_deg = std::max(quality.max_angle_deg, angle);
    }
  }
  return true;
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

InputVertices::InputVertices(const Grid& grid, const std::vector<MergedGroup>& groups) {
  for (const MergedGroup& group : groups) {
    const auto first = grid.nodes.begin() + group.first_node;
    places_.insert(places_.end(), first, first + group.input_nodes);
  }
}

std::uint64_t InputVertices::othersIn(const Grid& grid) && {
  std::ranges::sort(places_, lexLess);
  return static_cast<std::uint64_t>(std::ranges::count_if(
      grid.nodes, [this](const Point& node) { return !std::ranges::binary_search(places_, node, lexLess); }));
}

double inputAreaLeft(double area_m2, const Grid& grid, const std::vector<MergedGroup>& groups,
                     const DroppedWaters& dropped) {
  const auto groupOf = [&groups](std::uint32_t feature) {
    return std::ranges::upper_bound(groups, feature, {}, &MergedGroup::first_feature) - groups.begin() - 1;
  };
  std::vector<double> lost(groups.size(), 0.0);
  for (const auto& [feature, area] : dropped.area_of) lost[static_cast<std::size_t>(groupOf(feature))] += area;
  std::vector<bool> is_left(groups.size(), false);
  for (const std::uint32_t feature : grid.feature_of) is_left[static_cast<std::size_t>(groupOf(feature))] = true;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const double whole = groups[g].input_area_m2.value_or(0.0);
    if (lost[g] > 0.0) area_m2 -= is_left[g] ? std::min(lost[g], whole) : whole;
  }
  return area_m2;
}

}  // namespace coastmesh
