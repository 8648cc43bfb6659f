#include "apps/job/vertex_limits.hpp"

#include <algorithm>
#include <cmath>

#include "apps/job/plane_scales.hpp"
#include "gis/clean/geodesic_area.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/places.hpp"

namespace coastmesh {

namespace {

// Estimates may be off by half; meshes that require more than this many times the budget are not begun.
constexpr double kClearlyMore = 2.0;
constexpr double kMostReported = 1e18;

// Bytes of the whole program per vertex. `peak` includes GIS layers; estimates are compared with it. `least` is what
// any run takes: refinement stops at as many vertices as fit in memory at this rate.
struct BytesPerVertex {
  double peak, least;
};

// Measured with three million vertices and more. Where lattices make most of them: 143 to 178 with a maximum edge
// length alone, 234 with graded sizes, 263 on the whole globe. `kRefined`: without lattices.
BytesPerVertex bytesPerVertex(const MeshJob& job, SurfaceKind surface) {
  constexpr BytesPerVertex kOfLattices{320.0, 280.0}, kRefined{600.0, 520.0};
  const bool is_bounded = std::isfinite(job.sizes.most_m) && surface == SurfaceKind::Plane;
  return job.mesh.refine.algorithm == Algorithm::Relocate && (job.sizes.any() || is_bounded) ? kOfLattices : kRefined;
}

// The number of vertices for which there is memory, at most the range of indices in a mesh.
double possibleVertices(const GroupTask& task, SurfaceKind surface) {
  return std::min(task.room.memory / bytesPerVertex(task.job, surface).peak, static_cast<double>(kMostVertices));
}

// The number of vertices that sizes may ask for, and why.
std::string limitText(const GroupTask& task, const GroupResult& result) {
  const std::uint64_t allowed = task.room.vertices;
  if (result.over_budget)
    return "--max-vertices allows " + std::to_string(allowed) +
           (allowed < task.job.mesh.refine.max_vertices ? " here, this feature's share by points" : "");
  const double possible = possibleVertices(task, result.surface);
  return (possible < static_cast<double>(kMostVertices) ? "there is memory for about " : "a mesh may have ") +
         roundAmount(possible, 2);
}

std::string demandText(const VertexDemand& demand, const GroupTask& task, const GroupResult& result) {
  const std::string limit = limitText(task, result), advice = result.over_budget ? " or --max-vertices" : "";
  // No single size is the cause, and the demand is unknown.
  if (demand.map_too_large)
    return "these sizes vary so much that storing them takes more memory than such a mesh may: " + limit +
           "; request sizes that vary less, or give a larger --size-min" + advice;
  std::string text = demand.vertices > kMostReported ? "these sizes ask for more than " : "these sizes ask for about ";
  text += roundAmount(std::min(demand.vertices, kMostReported), 2) + " vertices, most of them near " +
          pointText(demand.place);
  if (std::isfinite(demand.size_m))
    text += ", where " + demand.option + " asks for " + roundAmount(demand.size_m, 3) + " m";
  return text + "; " + limit + ": request larger sizes, or give a larger --size-min" + advice;
}

}  // namespace

double mostVertices(const GroupTask& task, SurfaceKind surface) {
  return std::min(kClearlyMore * static_cast<double>(task.room.vertices), possibleVertices(task, surface));
}

std::uint64_t mostInMemory(const GroupTask& task, SurfaceKind surface) {
  return static_cast<std::uint64_t>(
      std::min(static_cast<double>(kMostVertices), task.room.memory / bytesPerVertex(task.job, surface).least));
}

double areaAsMeasured(const Domain& domain, const GroupResult& result) {
  if (domain.projection.isIdentity() || !result.input_area_m2) return geodesicArea(domain, Crs{});
  return *result.input_area_m2;
}

void requireMemory(const GroupTask& task, const Domain& domain, const GroupResult& result) {
  const MeshJob& job = task.job;
  if (job.sizes.any() || !result.input_area_m2 || !std::isfinite(job.sizes.most_m)) return;
  const double least = 2.0 / std::sqrt(3.0) * areaAsMeasured(domain, result) / job.sizes.most_m / job.sizes.most_m;
  if (std::min(least, static_cast<double>(task.room.vertices)) <= possibleVertices(task, result.surface)) return;
  throw TooManyVertices({least, domain.projection.inverse(centreOf(domain.pslg)), job.sizes.most_m, "--size-max"});
}

void refuse(const TooManyVertices& error, const GroupTask& task, GroupResult& result) {
  result.estimated_vertices = std::min(error.demand.vertices, kMostReported);
  const double possible = possibleVertices(task, result.surface);
  result.over_budget = kClearlyMore * static_cast<double>(task.room.vertices) <= possible;
  result.lacks_memory = !result.over_budget && possible < static_cast<double>(kMostVertices);
  result.refusal_place = error.demand.place;
  result.refusal = featureInWords(task.firstFeature()) + ": " + demandText(error.demand, task, result);
}

}  // namespace coastmesh
