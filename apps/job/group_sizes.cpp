#include "apps/job/group_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "apps/job/step_outcome.hpp"
#include "apps/job/stopwatch.hpp"
#include "apps/job/vertex_limits.hpp"
#include "core/size/estimate_vertices.hpp"
#include "core/triangulate/label_regions.hpp"
#include "gis/clean/frame_sides.hpp"
#include "gis/clean/geodesic_area.hpp"
#include "gis/flood_plain/take_out_coast.hpp"
#include "gis/follow/coast_follow.hpp"
#include "gis/follow/follow_notes.hpp"
#include "gis/follow/least_edges.hpp"
#include "gis/follow/water_notes.hpp"
#include "gis/places.hpp"
#include "gis/size/globe_start.hpp"
#include "gis/size/guide_lines.hpp"
#include "parallel/recorder.hpp"

namespace coastmesh {

namespace {

// Makes the coast follow the sizes. Sizes also depend on shores that are dropped or closed by this, so they are
// computed again from what is left. If they are larger at shores then, the coast follows them again; if only at open
// boundaries, these are coarsened. Replaces `sized`.
template <typename MakeSizes>
Domain followShore(Domain&& domain, DomainSizes& sized, MakeSizes&& makeSizes, const FollowOptions& options,
                   const EdgeWishes& wishes, const ShoreGuides& guides, const Coastline& coastline, CleanReport& report,
                   FollowStart start, const ItemLoop& loop) {
  constexpr double kSame = 1.05, kSameAtShores = 1.15;  // tolerances, since sizes are interpolated
  const auto lengthen = [&](Domain&& followed, const SizeFunction& size) {
    if (wishes.least_m <= 0.0) return std::move(followed);
    return lengthenShores(std::move(followed), wishes, size, coastline, report, loop);
  };
  start.rate = sized.rate, start.shore_m = sized.shore_m;
  Domain followed = followSizes(Domain(domain), *sized.function, options, coastline, report, guides, loop, start);
  followed = lengthen(std::move(followed), *sized.function);
  DomainSizes again = makeSizes(followed, SizeAccuracy::Fine);
  const SizeGrowth growth = growthOf(followed.pslg, *sized.function, *again.function, loop);
  if (growth.shore > kSameAtShores) {
    report = {};
    start.rate = again.rate, start.shore_m = again.shore_m;
    followed = followSizes(std::move(domain), *again.function, options, coastline, report, guides, loop, start);
    followed = lengthen(std::move(followed), *again.function);
  } else if (growth.elsewhere > kSame) {
    followed = coarsenFurther(std::move(followed), *again.function, coastline, report, loop);
    followed = lengthen(std::move(followed), *again.function);
  }
  sized = std::move(again);
  warnOfShortSegments(followed, *sized.function, report, loop);
  return followed;
}

// The sizes of a whole globe. A single length everywhere needs no map.
DomainSizes globeSizes(const GroupTask& task, const Domain& domain, double most_vertices, const ItemLoop& loop) {
  const SizeOptions& wanted = task.job.sizes;
  if (!isUniform(wanted)) return makeSizeFunction(wanted, task.sizes, withRing(domain, wanted), most_vertices, loop);
  const double length = std::min(std::max(wanted.size_m, wanted.least_m), wanted.most_m);
  const double area = geodesicArea(domain, task.input.coastline().crs);
  DomainSizes sized;
  sized.function = std::make_unique<ConstantSize>(length);
  sized.demand = {2.0 / std::sqrt(3.0) * area / length / length, domain.projection.inverse({}), length, "--size"};
  return sized;
}

// Adds a note if so much of the water has no depth that the sizes there may surprise.
void noteFilledWater(const FilledWater& filled, const SizeOptions& wanted, const Domain& domain, GroupResult& result) {
  constexpr double kLittle = 0.01;
  if (filled.area_m2 == 0.0 || !(filled.area_m2 > kLittle * areaAsMeasured(domain, result))) return;
  result.notes.push_back(
      "no raster has a depth for about " + areaInWords(filled.area_m2, domain.projection.isIdentity()) +
      " of the water, most of it near " + pointText(filled.place) + ": sizes there follow from " +
      (wanted.gaps == GapFill::Nearest ? "the nearest depths" : "depths interpolated across it") + ", as nodes do");
}

// The sizes of a domain whose coast follows them. Replaces the domain.
template <typename MakeSizes>
DomainSizes followedSizes(const GroupTask& task, Domain& domain, MakeSizes&& makeSizes, const ItemLoop& loop,
                          GroupResult& result) {
  constexpr double kShoreMargin = 1.02;  // lengths in the plane are not quite those on the ground
  constexpr double kNotObtuseDeg = 90.0;
  const auto& [job, input, sizes, group, room, control] = task;
  const FollowOptions follow = followOptionsOf(job);
  labelSegments(domain.pslg);  // plane graphs have no labels, which areas and openings need
  takeOutCoast(domain);
  const double area_m2 = areaAsMeasured(domain, result);
  const EdgeWishes wishes{kShoreMargin * StepOutcome::kUsualShare * job.sizes.least_m,
                          job.mesh.refine.max_angle_deg <= kNotObtuseDeg};
  const ShoreGuides guides{projected(sizes.layers->passages, domain.projection),
                           projected(sizes.layers->barriers, domain.projection)};
  const std::vector<IslandRing> islands = follow.of_land ? std::vector<IslandRing>() : islandRings(domain.pslg);
  CleanReport coarser, followed;
  const DataShores data(domain.pslg);
  FollowStart start{.data = &data};
  if (const double least = leastWanted(job.sizes, sizes); least > 0.0)
    domain = thinToLeast(std::move(domain), least, follow, input.coastline(), guides, coarser, start, loop);
  if (sizes.opened) domain = sizes.opened(std::move(domain), job.sizes, loop);
  domain.frame = frameSidesNear(input.coastline(), input.frames(), domain);
  DomainSizes sized = makeSizes(domain, SizeAccuracy::Rough);
  domain = followShore(std::move(domain), sized, makeSizes, follow, wishes, guides, input.coastline(), followed,
                       std::move(start), loop);
  coarser.append(std::move(followed));
  std::ranges::move(coarser.notes, std::back_inserter(result.notes));
  std::ranges::move(coarser.warnings, std::back_inserter(result.warnings));
  result.idle = std::move(coarser.idle);
  result.waters = std::move(coarser.waters);
  noteLostIslands(islands, domain, *sized.function, result.waters, loop);
  result.waters.area_m2 = area_m2;
  for (std::size_t kind = 0; kind < kEditKinds; ++kind) result.edits[kind] += coarser.counts[kind];
  if (job.keep_edits) std::ranges::move(coarser.edits, std::back_inserter(result.edit_places));
  return sized;
}

// The sizes of a domain in a plane; with --coast follow, replaces it.
DomainSizes planeSizes(const GroupTask& task, Domain& domain, double most_vertices, const ItemLoop& loop,
                       GroupResult& result) {
  const SizeOptions& wanted = task.job.sizes;
  const auto makeSizes = [&](const Domain& of, SizeAccuracy accuracy) {
    return makeSizeFunction(wanted, task.sizes, of, most_vertices, loop, accuracy);
  };
  DomainSizes sized = wanted.coast == CoastDetail::Follow ? followedSizes(task, domain, makeSizes, loop, result)
                                                          : makeSizes(domain, SizeAccuracy::Fine);
  noteFilledWater(sized.filled, wanted, domain, result);
  result.raised_shore = sized.raised;
  double& vertices = sized.demand.vertices;
  vertices += verticesOfSegments(domain.pslg, *sized.function, std::max(0.0, 2.0 * most_vertices - vertices),
                                 domain.projection.surface(), loop);
  return sized;
}

}  // namespace

std::unique_ptr<SizeFunction> sizeStage(const GroupTask& task, Domain& domain, GroupResult& result) {
  if (!task.job.sizes.any()) return nullptr;
  const double most = mostVertices(task, result.surface);
  Recorder recorder;
  const Stopwatch sizing;
  const ItemLoop loop = recorder.loop("size", task.control);
  DomainSizes sized =
      domain.closed() ? globeSizes(task, domain, most, loop) : planeSizes(task, domain, most, loop, result);
  result.estimated_vertices = sized.demand.vertices;
  if (sized.demand.vertices > most) throw TooManyVertices(sized.demand);
  if (task.room.expects) task.room.expects(sized.demand.vertices);
  result.size_s = sizing.seconds();
  result.log.append(recorder.finish());
  return std::move(sized.function);
}

FollowOptions followOptionsOf(const MeshJob& job) {
  FollowOptions follow = job.sizes.follow;
  follow.of_land = job.input.frame.side == DomainSide::Land;
  if (!job.sizes.keep_water_given && !job.finish.targets.empty()) follow.keep = KeepWater::Modelled;
  return follow;
}

}  // namespace coastmesh
