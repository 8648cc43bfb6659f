#include "apps/job/mesh_group.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <optional>
#include <span>
#include <sstream>

#include "apps/job/places.hpp"
#include "apps/job/step_outcome.hpp"
#include "apps/job/stopwatch.hpp"
#include "core/bulk_list.hpp"
#include "core/refine/check.hpp"
#include "core/run_control.hpp"
#include "core/size/estimate_vertices.hpp"
#include "core/size/narrow_strips.hpp"
#include "core/sphere/close_sphere.hpp"
#include "core/triangulate/delaunay.hpp"
#include "core/triangulate/label_regions.hpp"
#include "gis/clean/frame_sides.hpp"
#include "gis/clean/geodesic_area.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/error.hpp"
#include "gis/flood_plain/take_out_coast.hpp"
#include "gis/follow/coast_follow.hpp"
#include "gis/follow/follow_notes.hpp"
#include "gis/follow/least_edges.hpp"
#include "gis/follow/water_notes.hpp"
#include "gis/format/poly_io.hpp"
#include "gis/model/make_grid.hpp"
#include "gis/model/mark_regions.hpp"
#include "gis/projection/smooth_table.hpp"
#include "gis/size/globe_start.hpp"
#include "gis/size/guide_lines.hpp"
#include "gis/size/node_sizes.hpp"
#include "parallel/recorder.hpp"
#include "parallel/region_checkpoint.hpp"

namespace coastmesh {

namespace {

Point centreOf(const Pslg& pslg) {
  if (pslg.points.empty()) return {};  // a whole globe
  Point low = pslg.points.front();
  Point high = low;
  for (const Point& p : pslg.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return {low.x + (high.x - low.x) / 2, low.y + (high.y - low.y) / 2};
}

using ScaleAt = double (Projection::*)(const Point&) const;

// Smallest and largest value of a scale, `Projection::scaleAt` or `measureAt`, at a sample of the points.
std::pair<double, double> scaleRange(std::span<const Point> points, const Projection& projection, ScaleAt scale_at) {
  constexpr std::size_t kLeastSample = 16, kMostSample = 1024, kPointsForOne = 16;
  double least = std::numeric_limits<double>::infinity(), greatest = 0.0;
  const std::size_t count = points.size();
  const std::size_t step =
      std::max<std::size_t>(1, count / std::clamp(count / kPointsForOne, kLeastSample, kMostSample));
  for (std::size_t i = 0; i < count; i += step) {
    const double scale = (projection.*scale_at)(points[i]);
    least = std::min(least, scale);
    greatest = std::max(greatest, scale);
  }
  return {least, greatest};
}

// Extends the reported range of scales by those at the points.
void addScales(std::span<const Point> points, const Projection& projection, GroupResult& result) {
  const auto [least, greatest] = scaleRange(points, projection, &Projection::scaleAt);
  result.least_scale = std::min(result.least_scale, least);
  result.greatest_scale = std::max(result.greatest_scale, greatest);
}

// Smallest and largest measure in the domain, its centre included: in a conformal plane that is fitted to it, the
// measure is smallest there.
std::pair<double, double> measureRange(const Domain& domain) {
  const double centre = domain.projection.measureAt(centreOf(domain.pslg));
  const auto [least, greatest] = scaleRange(domain.pslg.points, domain.projection, &Projection::measureAt);
  return {std::min(centre, least), std::max(centre, greatest)};
}

// Estimates may be off by half; meshes that require more than this many times the budget are not begun.
constexpr double kClearlyMore = 2.0;
constexpr double kMostReported = 1e18;

// The part of a group's progress that is meshing, after cleaning and sizes and before the check.
constexpr ProgressPart kMeshing{0.1, 0.95};
constexpr double kCleaned = 0.03;  // after cleaning

// A group, and the context in which it is meshed.
struct GroupTask {
  const MeshJob& job;
  const JobInput& input;
  const SizeInputs& sizes;
  std::size_t group;
  const GroupRoom& room;
  const RunControl& control;

  const Feature& firstFeature() const { return input.coastline().features[input.members(group).front()]; }
};

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

double mostVertices(const GroupTask& task, SurfaceKind surface) {
  return std::min(kClearlyMore * static_cast<double>(task.room.vertices), possibleVertices(task, surface));
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

MeshOptions optionsFor(const GroupTask& task, const Domain& domain, SurfaceKind surface) {
  const auto& [job, input, sizes, group, room, control] = task;
  MeshOptions options = job.mesh;
  options.list_violations = false;
  options.refine.surface = domain.projection.surface();
  options.refine.max_vertices = room.vertices;
  options.refine.most_in_memory = static_cast<std::uint64_t>(
      std::min(static_cast<double>(kMostVertices), room.memory / bytesPerVertex(job, surface).least));
  // Coordinates that are NaN have no resolution; triangulation reports them.
  if (std::isfinite(domain.resolution.grain)) options.refine.resolution = domain.resolution.grain;
  // With --coast keep, the data determine the lengths of edges.
  if (job.sizes.least_m > 0.0 && job.sizes.any() && job.sizes.coast == CoastDetail::Follow)
    options.refine.least_edge = StepOutcome::kUsualShare * job.sizes.least_m * measureRange(domain).second;
  // Where the plane is less enlarged than elsewhere, edges are longest on the ground.
  if (std::isfinite(job.sizes.most_m) && !job.sizes.any())
    options.refine.size_max = job.sizes.most_m * measureRange(domain).first;
  return options;
}

// The area in the units in which lengths are measured: with coordinates used as they are, these are theirs, even if a
// CRS gives an area in square metres.
double areaAsMeasured(const Domain& domain, const GroupResult& result) {
  if (domain.projection.isIdentity() || !result.input_area_m2) return geodesicArea(domain, Crs{});
  return *result.input_area_m2;
}

// If `--size-max` is only a bound, there is no map of sizes. The lower bound on vertices is then the number for
// equilateral triangles of that size. Throws TooManyVertices if these exceed the memory.
void requireMemory(const GroupTask& task, const Domain& domain, const GroupResult& result) {
  const MeshJob& job = task.job;
  if (job.sizes.any() || !result.input_area_m2 || !std::isfinite(job.sizes.most_m)) return;
  const double least = 2.0 / std::sqrt(3.0) * areaAsMeasured(domain, result) / job.sizes.most_m / job.sizes.most_m;
  if (std::min(least, static_cast<double>(task.room.vertices)) <= possibleVertices(task, result.surface)) return;
  throw TooManyVertices({least, domain.projection.inverse(centreOf(domain.pslg)), job.sizes.most_m, "--size-max"});
}

// Saves the failing region, for a bug report; returns where, or why not.
std::string dumpRegion(const Pslg& pslg, std::uint64_t digest) {
  std::ostringstream name;
  name << "coastmesh-bug-" << std::hex << digest << ".poly";
  try {
    const std::filesystem::path path = std::filesystem::temp_directory_path() / name.str();
    writePoly(pslg, path.string());
    return "the region was kept in '" + path.string() + "'";
  } catch (const std::exception& error) {
    return std::string("the region could not be kept: ") + error.what();
  }
}

void requireSound(const MeshedRegion& region, const Domain& domain, std::span<const SpacePoint> places,
                  const Feature& first, const ItemLoop& loop) {
  const TriMesh& mesh = region.mesh;
  CheckOptions options;
  if (region.cover) options.cover = &*region.cover;
  if (domain.closed()) options.places = places, options.closed = true;
  std::vector<MeshDefect> defects = checkMesh(mesh, &domain.pslg, options, loop);
  if (domain.closed() && !isClosed(mesh)) defects.push_back({DefectKind::BrokenTopology, {}});
  if (defects.empty()) return;
  const MeshDefect& defect = defects.front();
  throw BadMesh("the mesh of " + featureInWords(first) + " has " + std::to_string(defects.size()) +
                " defects, the first one " + std::string(toString(defect.kind)) + " at " +
                pointText(domain.projection.inverse(defect.place)) + "; " + dumpRegion(domain.pslg, digestOf(mesh)));
}

// The group's part of the grid. Frees the mesh on the way, since memory is at its peak while both exist. Uses only the
// group's own features, or the work would grow with the square of their number. Adds regions to `took_part`.
Grid groupGrid(const GroupTask& task, const Domain& domain, TriMesh mesh, std::vector<double> size_m,
               GroundPlaces ground, const ItemLoop& loop, std::vector<std::uint32_t>& took_part) {
  const JobInput& input = task.input;
  Coastline names;
  names.crs = input.coastline().crs;
  if (!input.isPoly()) {
    const std::vector<std::size_t>& members = input.members(task.group);
    for (std::size_t member : members) {
      const Feature& feature = input.coastline().features[member];
      Feature& name = names.features.emplace_back();
      name.fid = feature.fid;
      name.source = feature.source;
      name.attributes = feature.attributes;
    }
    forStretches(loop, mesh.regions.size(), [&](std::size_t first, std::size_t last) {
      // Consecutive triangles are mostly of one region.
      std::optional<RegionId> feature;
      RegionId member = 0;
      for (std::size_t t = first; t < last; ++t) {
        if (mesh.regions[t] != feature) {
          feature = mesh.regions[t];
          member = static_cast<RegionId>(std::ranges::lower_bound(members, static_cast<std::size_t>(*feature)) -
                                         members.begin());
        }
        mesh.regions[t] = member;
      }
    });
    const std::vector<std::uint32_t> regions =
        markRegions(input.coastline(), members, domain.projection, mesh, names, loop);
    took_part.insert(took_part.end(), regions.begin(), regions.end());
  }
  const MeshedDomain part{&domain, &mesh, size_m.empty() ? nullptr : &size_m, ground.empty() ? nullptr : &ground,
                          [&mesh] { freeMemoryOf(mesh.triangles); }};
  Grid grid = makeGridWithoutAreas({part}, names, loop);
  mesh = {};
  freeMemoryOf(size_m);
  ground = {};
  grid.area_m2 = triangleAreas(grid.nodes, grid.triangles, grid.crs, loop);
  grid.crs = {};  // the combined grid has it; a copy per lake would take more than the lake
  return grid;
}

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

Domain cleanStage(const GroupTask& task, GroupResult& result) {
  const Stopwatch stopwatch;
  Recorder recorder;
  CleanReport clean;
  // Small regions run without threads and clock, which would cost more than the work.
  constexpr std::size_t kWorthThreads = 10000;
  const bool many_points = task.input.pointsOf(task.group) >= kWorthThreads;
  const ItemLoop loop = many_points ? recorder.loop("clean", task.control) : ItemLoop(inOrder);
  Domain domain = task.input.domain(task.group, clean, loop);
  result.edits = clean.counts;
  if (task.job.keep_edits) result.edit_places = std::move(clean.edits);
  result.notes = std::move(clean.notes);
  result.warnings = std::move(clean.warnings);
  result.took_part = std::move(clean.took_part);
  result.projection = domain.projection.description();
  result.projection_reason = domain.projection.reason();
  result.surface = task.input.surfaceOf(domain.projection);
  constexpr Point kMiddle{};
  addScales(domain.pslg.points.empty() ? std::span(&kMiddle, 1) : std::span(domain.pslg.points), domain.projection,
            result);
  result.input_area_m2 = task.input.area(domain, loop);
  result.clean_s = stopwatch.seconds();
  result.log.append(recorder.finish("clean"));
  return domain;
}

// The sizes of a whole globe. A single length everywhere needs no map.
std::unique_ptr<SizeFunction> globeSizes(const GroupTask& task, const Domain& domain, const ItemLoop& loop,
                                         VertexDemand& demand) {
  const SizeOptions& wanted = task.job.sizes;
  if (!isUniform(wanted)) {
    const double most = mostVertices(task, task.input.surfaceOf(domain.projection));
    DomainSizes sized = makeSizeFunction(wanted, task.sizes, withRing(domain, wanted), most, loop);
    demand = std::move(sized.demand);
    return std::move(sized.function);
  }
  const double length = std::min(std::max(wanted.size_m, wanted.least_m), wanted.most_m);
  const double area = geodesicArea(domain, task.input.coastline().crs);
  demand = {2.0 / std::sqrt(3.0) * area / length / length, domain.projection.inverse({}), length, "--size"};
  return std::make_unique<ConstantSize>(length);
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

// The sizes of a domain; with --coast follow, also coarsens the domain accordingly. Null if no sizes are requested.
std::unique_ptr<SizeFunction> sizeStage(const GroupTask& task, Domain& domain, GroupResult& result) {
  const auto& [job, input, sizes, group, room, control] = task;
  if (!job.sizes.any()) return nullptr;
  const double most = mostVertices(task, result.surface);
  Recorder recorder;
  const Stopwatch sizing;
  const ItemLoop loop = recorder.loop("size", control);
  if (domain.closed()) {
    VertexDemand demand;
    std::unique_ptr<SizeFunction> made = globeSizes(task, domain, loop, demand);
    result.estimated_vertices = demand.vertices;
    if (demand.vertices > most) throw TooManyVertices(demand);
    if (room.expects) room.expects(demand.vertices);
    result.size_s = sizing.seconds();
    result.log.append(recorder.finish());
    return made;
  }
  const SizeOptions& wanted = job.sizes;
  const auto makeSizes = [&](const Domain& of, SizeAccuracy accuracy) {
    return makeSizeFunction(wanted, sizes, of, most, loop, accuracy);
  };
  const bool follows = job.sizes.coast == CoastDetail::Follow;
  constexpr double kShoreMargin = 1.02;  // lengths in the plane are not quite those on the ground
  constexpr double kNotObtuseDeg = 90.0;
  DomainSizes sized;
  if (!follows) {
    sized = makeSizes(domain, SizeAccuracy::Fine);
  } else {
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
    FollowStart start;
    if (const double least = leastWanted(wanted, sizes); least > 0.0)
      domain = thinToLeast(std::move(domain), least, follow, input.coastline(), guides, coarser, start, loop);
    if (sizes.opened) domain = sizes.opened(std::move(domain), wanted, loop);
    domain.frame = frameSidesNear(input.coastline(), input.frames(), domain);
    sized = makeSizes(domain, SizeAccuracy::Rough);
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
  }
  noteFilledWater(sized.filled, wanted, domain, result);
  result.raised_shore = sized.raised;
  VertexDemand& demand = sized.demand;
  demand.vertices += verticesOfSegments(domain.pslg, *sized.function, std::max(0.0, 2.0 * most - demand.vertices),
                                        domain.projection.surface(), loop);
  result.estimated_vertices = demand.vertices;
  if (demand.vertices > most) throw TooManyVertices(demand);
  if (room.expects) room.expects(demand.vertices);
  result.size_s = sizing.seconds();
  result.log.append(recorder.finish());
  return std::move(sized.function);
}

std::string stripsText(const GroupTask& task, const Domain& domain, const NarrowStrips& strips) {
  const double scale = domain.projection.scaleAt(strips.place);
  const auto inWords = [&](double length) {
    const double metres = length / scale;
    if (domain.projection.isIdentity()) return roundAmount(metres, 2);
    return metres < 1000.0 ? roundAmount(metres, 2) + " m" : roundAmount(metres / 1000.0, 2) + " km";
  };
  const Feature* feature = &task.firstFeature();
  if (const Coastline& coastline = task.input.coastline(); !task.input.isPoly() && strips.region >= 0)
    if (const Feature& of_region = coastline.features[static_cast<std::size_t>(strips.region)];
        of_region.use == FeatureUse::Area)  // not a frame
      feature = &of_region;
  return featureInWords(*feature) + ": bounds on angles take about " + roundAmount(strips.vertices, 1) +
         " vertices between shores, or lines, that almost coincide: along about " + inWords(strips.length) +
         " in all, most of them near " + pointText(domain.projection.inverse(strips.place)) + ", where these are " +
         inWords(strips.width) + " apart; a larger --snap joins them, --simplify and --coast follow leave them out";
}

// Slivers make many more vertices than anybody wants there: named if they are most of the mesh, or use up the budget.
// Few meshes have so many vertices that it is worth looking.
void warnOfStrips(const GroupTask& task, const Domain& domain, std::size_t vertices, GroupResult& result) {
  constexpr double kWorthTelling = 1e5;  // vertices
  constexpr double kUsual = 4.0;         // for one of the input
  constexpr double kClearly = 2.0;
  const bool cut_short = result.refine.budget_reached;
  const double made = static_cast<double>(vertices), given = static_cast<double>(domain.pslg.points.size());
  const double worth =
      std::max({kWorthTelling, kClearly * result.estimated_vertices, cut_short ? 0.0 : made / kClearly});
  if (domain.closed() || (made < std::max(worth, kUsual * given) && !cut_short)) return;
  const NarrowStrips strips = narrowStrips(constrainedDelaunay(domain.pslg), worth);
  if (strips.vertices > 0.0) result.warnings.push_back(stripsText(task, domain, strips));
}

MeshedRegion meshStage(const GroupTask& task, const Domain& domain, MeshOptions&& options, GroupResult& result) {
  MeshedRegion region;
  const std::uint64_t most = options.refine.most_in_memory;
  std::optional<RegionCheckpoint> checkpoint;
  if (task.job.exchange.checkpoint) {
    checkpoint = task.job.exchange.checkpoint(task.group);
    options.checkpoint = &*checkpoint;
  }
  try {
    region = meshRegion(domain.pslg, std::move(options), stageControl(task.control, kMeshing));
  } catch (const OutOfRoom& error) {
    result.refusal_place = domain.projection.inverse(error.place);
    result.lacks_memory = most < kMostVertices;
    throw InputError(featureInWords(task.firstFeature()) + ": the bounds on angles and lengths take more than " +
                     roundAmount(static_cast<double>(most), 2) +
                     " vertices, the most that fit in memory, the last of them near " +
                     pointText(*result.refusal_place) +
                     ": repair shores that almost coincide there (--snap, --simplify), relax the bounds, or give "
                     "--max-vertices to stop at that number");
  }
  result.mesh_s = region.seconds;
  result.refine = std::move(region.stats);
  freeMemoryOf(result.refine.unresolved);
  result.pieces = region.pieces;
  result.log.append(std::move(region.log));
  return region;
}

// The loops of stages after meshing; small regions run without threads. A large region need not have been cut: the
// lattice of a whole globe is made in one piece.
class LoopsAfterMeshing {
 public:
  LoopsAfterMeshing(const MeshedRegion& region, const RunControl& control)
      : large_(region.pieces > 1 || region.mesh.triangles.size() >= kLarge), control_(control) {}

  ItemLoop of(std::string_view stage) { return large_ ? recorder_.loop(stage, control_) : ItemLoop(inOrder); }
  WorkLog finish() { return recorder_.finish(); }

 private:
  static constexpr std::size_t kLarge = 60000;

  bool large_;
  const RunControl& control_;
  Recorder recorder_;
};

void checkStage(const GroupTask& task, const Domain& domain, const RefineOptions& options, const MeshedRegion& region,
                std::span<const SpacePoint> places, const ItemLoop& loop, GroupResult& result) {
  const Stopwatch checking;
  const TriMesh& mesh = region.mesh;
  requireSound(region, domain, places, task.firstFeature(), loop);
  result.size_max = options.size_max;
  const WorkingPlane plane{domain.projection, options.size_max};
  MeshJudgement judgement = judgeMesh(mesh, plane, options, 0.0, places, loop);
  result.quality = judgement.quality;
  result.short_of = std::move(judgement.short_of);
  result.digest = digestOf(mesh, 0, loop);
  result.check_s = checking.seconds();
}

// Consumes the rest of the region.
void gridStage(const GroupTask& task, const Domain& domain, const SizeFunction* size, MeshedRegion& region,
               GroundPlaces ground, const ItemLoop& loop, GroupResult& result) {
  std::vector<double> size_m;
  if (size != nullptr) {
    const BulkList<Point>& points = region.mesh.points;
    const SmoothTable table =
        measureTable(domain.projection, ground.empty() ? std::span(points) : std::span<const Point>(), loop);
    const auto measure = [&](VertexId v) { return ground.empty() ? table.at(points[v]).x : ground.measure[v]; };
    size_m = nodeSizes(region.mesh, *size, task.job.sizes.gradation, measure, domain.projection.surface(), loop);
  }
  result.grid =
      groupGrid(task, domain, std::move(region.mesh), std::move(size_m), std::move(ground), loop, result.took_part);
  result.grid.piece_of = std::move(region.piece_of);
}

// Sets the cap, seeds and lattice that a mesh of the whole globe starts with.
void startGlobe(const GroupTask& task, const Domain& domain, const SizeFunction* size, MeshOptions& options) {
  Recorder recorder;
  GlobeStart start = globeStart(domain, task.job.sizes, size, recorder.loop("lattice", task.control));
  options.cap = std::move(start.cap);
  options.cap_region = domain.beyond;
  options.seeds = std::move(start.seeds);
  options.lattice = std::move(start.lattice);
}

void fillGroup(const GroupTask& task, GroupResult& result) {
  Domain domain = cleanStage(task, result);
  task.control.checkpoint(kCleaned);
  requireMemory(task, domain, result);
  MeshOptions options = optionsFor(task, domain, result.surface);
  const std::unique_ptr<SizeFunction> size = sizeStage(task, domain, result);
  options.refine.size = size.get();
  for (const VertexId v : domain.asked) result.asked.push_back(domain.input_points[v]);
  if (domain.closed()) startGlobe(task, domain, size.get(), options);
  const RefineOptions asked = options.refine;
  task.control.checkpoint(kMeshing.from);
  MeshedRegion region = meshStage(task, domain, std::move(options), result);
  warnOfStrips(task, domain, region.mesh.points.size(), result);
  // Away from the shore, a scale may be smaller than anywhere on it. Of a globe, the plane has no bounded part.
  if (!domain.closed()) addScales(region.mesh.points, domain.projection, result);
  LoopsAfterMeshing loops(region, task.control);
  GroundPlaces ground = domain.projection.groundPlaces(region.mesh.points, loops.of("check"));
  checkStage(task, domain, asked, region, ground.space, loops.of("check"), result);
  gridStage(task, domain, size.get(), region, std::move(ground), loops.of("grid"), result);
  result.log.append(loops.finish());
}

// The segments of a plane graph, by their order in the input.
std::string segmentsOf(const PslgDefect& defect) {
  if (defect.segment == kNone) return "";
  const std::string first = std::to_string(std::uint64_t{defect.segment} + 1);
  if (defect.other == kNone) return " (segment " + first + ", counted from 1)";
  return " (segments " + first + " and " + std::to_string(std::uint64_t{defect.other} + 1) + ", counted from 1)";
}

void refuse(const BadPslg& error, const GroupTask& task, GroupResult& result) {
  CleanReport ignored;
  const Projection projection = task.input.domain(task.group, ignored).projection;
  result.refusal_place = projection.inverse(error.defect.place);
  result.refusal =
      featureInWords(task.firstFeature()) + ": " + error.what() + " at " + pointText(*result.refusal_place);
  if (task.input.isPoly()) result.refusal += segmentsOf(error.defect);
}

void refuse(const TooManyVertices& error, const GroupTask& task, GroupResult& result) {
  result.estimated_vertices = std::min(error.demand.vertices, kMostReported);
  const double possible = possibleVertices(task, result.surface);
  result.over_budget = kClearlyMore * static_cast<double>(task.room.vertices) <= possible;
  result.lacks_memory = !result.over_budget && possible < static_cast<double>(kMostVertices);
  result.refusal_place = error.demand.place;
  result.refusal = featureInWords(task.firstFeature()) + ": " + demandText(error.demand, task, result);
}

}  // namespace

FollowOptions followOptionsOf(const MeshJob& job) {
  FollowOptions follow = job.sizes.follow;
  follow.of_land = job.input.frame.side == DomainSide::Land;
  if (!job.sizes.keep_water_given && !job.finish.targets.empty()) follow.keep = KeepWater::Modelled;
  return follow;
}

GroupResult meshGroup(const MeshJob& job, const JobInput& input, const SizeInputs& sizes, std::size_t group,
                      const GroupRoom& room, const RunControl& control) {
  const GroupTask task{job, input, sizes, group, room, control};
  GroupResult result;
  try {
    fillGroup(task, result);
  } catch (const TooManyVertices& error) {
    refuse(error, task, result);
  } catch (const NothingWanted& nothing) {
    result.unwanted = nothing.what();
  } catch (const InputError& error) {
    result.refusal = error.what();
  } catch (const BadPslg& error) {
    refuse(error, task, result);
  }
  return result;
}

}  // namespace coastmesh
