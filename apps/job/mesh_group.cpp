#include "apps/job/mesh_group.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <optional>
#include <span>
#include <sstream>

#include "apps/job/group_sizes.hpp"
#include "apps/job/group_task.hpp"
#include "apps/job/plane_scales.hpp"
#include "apps/job/step_outcome.hpp"
#include "apps/job/stopwatch.hpp"
#include "apps/job/vertex_limits.hpp"
#include "core/bulk_list.hpp"
#include "core/refine/check.hpp"
#include "core/run_control.hpp"
#include "core/size/narrow_strips.hpp"
#include "core/sphere/close_sphere.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/error.hpp"
#include "gis/format/poly_io.hpp"
#include "gis/model/make_grid.hpp"
#include "gis/model/mark_regions.hpp"
#include "gis/places.hpp"
#include "gis/projection/smooth_table.hpp"
#include "gis/size/globe_start.hpp"
#include "gis/size/node_sizes.hpp"
#include "parallel/recorder.hpp"
#include "parallel/region_checkpoint.hpp"

namespace coastmesh {

namespace {

// The part of a group's progress that is meshing, after cleaning and sizes and before the check.
constexpr ProgressPart kMeshing{0.1, 0.95};
constexpr double kCleaned = 0.03;  // after cleaning

// Extends the reported range of scales by those at the points.
void addScales(std::span<const Point> points, const Projection& projection, GroupResult& result) {
  const auto [least, greatest] = scaleRange(points, projection);
  result.least_scale = std::min(result.least_scale, least);
  result.greatest_scale = std::max(result.greatest_scale, greatest);
}

MeshOptions optionsFor(const GroupTask& task, const Domain& domain, SurfaceKind surface) {
  const auto& [job, input, sizes, group, room, control] = task;
  MeshOptions options = job.mesh;
  options.list_violations = false;
  options.refine.surface = domain.projection.surface();
  options.refine.max_vertices = room.vertices;
  options.refine.most_in_memory = mostInMemory(task, surface);
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
  if (!task.job.keep_edits)
    std::erase_if(clean.edits, [](const Edit& edit) { return edit.kind != EditKind::OutsideWater; });
  result.edit_places = std::move(clean.edits);
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

}  // namespace

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
