#include "apps/job/mesh_job.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "apps/input/largest_group.hpp"
#include "apps/input/read_input.hpp"
#include "apps/job/deal_groups.hpp"
#include "apps/job/grid_pieces.hpp"
#include "apps/job/group_sizes.hpp"
#include "apps/job/idle_inputs.hpp"
#include "apps/job/mesh_area.hpp"
#include "apps/job/mesh_groups.hpp"
#include "apps/job/raster_helpers.hpp"
#include "apps/job/stopwatch.hpp"
#include "core/quality.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/follow/water_notes.hpp"
#include "gis/for_count.hpp"
#include "gis/grid/frame_box.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "gis/grid/local_plane.hpp"
#include "gis/model/assign_boundaries.hpp"
#include "gis/model/shore_for_sizes.hpp"
#include "gis/places.hpp"
#include "gis/size/size_choice.hpp"
#include "parallel/available_memory.hpp"
#include "parallel/free_memory.hpp"
#include "parallel/recorder.hpp"
#include "parallel/workers.hpp"

namespace coastmesh {

namespace {

// Measures the present grid, each group in the plane that it was made in. Unless the grid is repaired, only nodes at
// the frame have moved, and the digest stays that of the mesh.
void measureAgain(const MeshJob& job, const JobInput& input, const std::vector<MergedGroup>& groups, bool is_repaired,
                  const ItemLoop& loop, MeshJobResult& result) {
  result.quality = {};
  result.short_of = {};
  bool first = true;
  const LineEdges lines(result.grid);
  const std::vector<std::vector<std::uint32_t>> triangles = trianglesOfGroups(result.grid, groups);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (triangles[g].empty()) continue;
    const WorkingPlane plane{input.projectionOf(groups[g].group), groups[g].size_max};
    const ItemLoop& of_piece = loopOfPiece(triangles[g].size(), loop);
    const GridPiece piece = makePiece(result.grid, triangles[g], plane.projection, lines, of_piece);
    MeshJudgement judgement = judgeMesh(piece.mesh, plane, job.mesh.refine, kAngleSlackDeg, piece.places, of_piece);
    result.quality.add(judgement.quality);
    result.short_of.add(std::move(judgement.short_of));
    if (is_repaired) {
      const std::uint64_t digest = digestOf(piece.mesh, 0, of_piece);
      result.digest = first ? digest : combineDigests(result.digest, digest);
    }
    first = false;
    if (piece.places.empty() || result.grid.min_angle_deg.empty()) continue;
    forEachByStretches(of_piece, piece.triangles.size(), [&](std::size_t t) {
      const auto& [a, b, c] = piece.mesh.triangles[t].v;
      result.grid.min_angle_deg[piece.triangles[t]] =
          std::ranges::min(spaceAnglesDeg(piece.places[a], piece.places[b], piece.places[c]));
    });
  }
}

bool isMeasuredOnEarth(const MeshJobResult& result) {
  return std::ranges::any_of(result.surfaces, [](const auto& each) { return each.first != SurfaceKind::Plane; });
}

// Moves nodes onto the box of a frame. The result then describes what is written.
void keepInBox(const MeshJob& job, const JobInput& input, const std::vector<MergedGroup>& groups, const ItemLoop& loop,
               MeshJobResult& result) {
  const AngleBounds bounds{job.mesh.refine.min_angle_deg, job.mesh.refine.max_angle_deg};
  const FrameMoves moves = keepInFrame(result.grid, input.coastline(), bounds, loop);
  if (moves.nodes == 0) return;
  // In the plane, few triangles have changed: measuring all would take as long as making a mesh with large sizes.
  if (isMeasuredOnEarth(result) ||
      !replaceAngles(moves.angles_before, moves.angles_after, kAngleSlackDeg, result.quality))
    measureAgain(job, input, groups, false, loop, result);
}

// True if waters of groups without an open boundary are left out of the finished grid.
bool dropsWatersApart(const MeshJob& job) {
  return job.sizes.coast == CoastDetail::Follow && !job.finish.targets.empty() &&
         (!job.sizes.keep_water_given || job.sizes.follow.keep == KeepWater::Open);
}

// In the units of its coordinates.
double areaInPlane(const Grid& grid) {
  double twice = 0.0;
  for (const auto& [a, b, c] : grid.triangles)
    twice += cross(grid.nodes[b] - grid.nodes[a], grid.nodes[c] - grid.nodes[a]);
  return 0.5 * twice;
}

// For all groups together: shares are of all water that is meshed.
void noteFollowed(const MeshJob& job, MeshJobResult& result) {
  const FollowOptions follow = followOptionsOf(job);
  if (dropsWatersApart(job)) result.waters.too_small = {};  // hardly any of them has an open boundary
  NotesAndWarnings texts = noteWaters(result.waters, follow);
  std::ranges::move(texts.notes, std::back_inserter(result.read.notes));
  std::ranges::move(texts.warnings, std::back_inserter(result.read.warnings));
  std::string of_area =
      warningOfArea(result.waters, follow, result.waters.in_plane ? areaInPlane(result.grid) : result.mesh_area_m2);
  if (!of_area.empty()) result.read.warnings.push_back(std::move(of_area));
}

// Adds a note if sizes are raised along so much of the shore that they may surprise.
void noteRaisedShore(MeshJobResult& result) {
  constexpr double kLittle = 0.1;
  const auto& [length_m, raised_m, most_m] = result.raised_shore;
  if (!(raised_m > kLittle * length_m)) return;
  result.read.notes.push_back("--time-step asks for more than --size-shore along " +
                              amount("%.0f %%", 100.0 * raised_m / length_m) + " of the shore, up to " +
                              (most_m < 1000.0 ? amount("%.0f m", most_m) : amount("%.3g km", most_m / 1000.0)) +
                              "; a shorter step allows smaller elements");
}

// A model's grid whose sizes are bounds only: its coast stays as it is in the data.
void noteKeptCoast(const MeshJob& job, MeshJobResult& result) {
  constexpr double kFarShorter = 0.01;
  const SizeOptions& sizes = job.sizes;
  if (job.finish.targets.empty() || sizes.coast != CoastDetail::Keep || sizes.any()) return;
  if (!std::isfinite(sizes.most_m) || !(result.step.step.shortest_edge_m < kFarShorter * sizes.most_m)) return;
  result.read.notes.push_back("--size-max " + amount("%g", sizes.most_m) +
                              " leaves the coast as it is in the data, with edges far shorter; --size or --size-shore "
                              "with --coast follow make it as coarse as the sizes");
}

// In the coordinates that are written: orientation in the working plane may differ.
void findTurned(MeshJobResult& result, const ItemLoop& loop) {
  for (const std::uint32_t t : turnedTriangles(result.grid, result.grid.area_m2, loop)) {
    ++result.turned;
    if (result.turned_places.size() < kBoundViolationPlaces) result.turned_places.push_back(middleOf(result.grid, t));
  }
}

// A shard may legitimately be far from these inputs. So may one feature of many: the caller compares it with others.
void warnOfIdleInputs(const MeshJob& job, const SizeInputs& sizes, const JobInput& input, MeshJobResult& result) {
  const Coastline& coastline = input.coastline();
  if (!job.input.constraints.empty() && !job.input.ready) addStrayPoints(input, result);
  result.idle_inputs = warningsOfIdleInputs(job, sizes, coastline, result);
  if (job.input.ready) return;
  std::ranges::move(warningsOfLostPoints(job.input, coastline, result), std::back_inserter(result.read.warnings));
  std::ranges::move(notesOfLostWeirs(job.input, coastline, result), std::back_inserter(result.read.notes));
  std::ranges::move(warningsOfPolygons(job.input, coastline), std::back_inserter(result.read.warnings));
  std::ranges::move(result.idle_inputs, std::back_inserter(result.read.warnings));
  for (const auto& [text, regions] : result.idle)
    if (regions == result.regions) result.read.notes.push_back(text);
}

// Sizes chosen for a mesh, and `shoreSpacing` of its input.
struct ChosenSizes {
  SizeOptions sizes;
  double spacing_m = 0.0;
};

// Chooses the sizes of all groups, from the largest of them: all shards have the same.
ChosenSizes chosenSizes(const MeshJob& job, const JobInput& input, const SizeInputs& sizes, const ItemLoop& loop) {
  const std::optional<LargestGroup> largest = largestGroup(input, loop);
  if (!largest) return {job.sizes};
  const double share = dropsWatersApart(job) ? 1.0 : largest->share;
  return {chooseSizes(job.sizes, sizes, largest->domain, loop, share), shoreSpacing(largest->domain)};
}

// What users should know of sizes that are much finer than the shore's data.
std::string spacingText(const ChosenSizes& chosen) {
  constexpr double kMuchFiner = 3.0;
  if (!(chosen.spacing_m > kMuchFiner * chosen.sizes.shore_m)) return {};
  return "; three in four edges of the input's shore are more than " +
         amount("%.0f", std::floor(chosen.spacing_m / chosen.sizes.shore_m)) +
         " times as long as --size-shore, so that larger sizes show as much of it";
}

// The distance by which shores move when they follow the sizes: half an element, as water and land narrower than one
// are closed and removed.
double shoresMove(const SizeOptions& sizes) {
  constexpr double kShareOfElement = 0.5;
  return sizes.coast == CoastDetail::Follow ? kShareOfElement * sizes.mostAtShores() : 0.0;
}

// Does nothing unless sizes are to be chosen.
void settleSizes(JobInput& input, const SizeInputs& sizes, const JobControl& control, MeshJob& job,
                 MeshJobResult& result) {
  if (!job.sizes.choose) return;
  const Stopwatch choosing;
  Recorder recorder;
  const ItemLoop loop = recorder.loop("size", RunControl{control.cancelled, {}});
  const ChosenSizes chosen = chosenSizes(job, input, sizes, loop);
  job.sizes = chosen.sizes;
  input.regroup(shoresMove(job.sizes), loop);
  result.seconds.size += choosing.seconds();
  result.log.append(recorder.finish("size"));
  if (job.sizes.choose) return;  // nothing can be meshed
  result.read.notes.push_back(std::string("sizes were chosen from the extent") +
                              (job.sizes.bathymetry.empty() ? "" : " and the depths") + ", as with " +
                              sizesAsOptions(job.sizes) +
                              ", besides the options given; give --size-shore or any other size to choose them "
                              "yourself" +
                              spacingText(chosen));
}

// The job's options for finished grids, with the boundaries of the input and of files.
FinishOptions finishOptionsOf(const MeshJob& job, const JobInput& input) {
  FinishOptions finish = job.finish;
  if (finish.boundaries.of_input.empty()) finish.boundaries.of_input = input.boundaries();
  if (!finish.boundaries.of_files) finish.boundaries.of_files = readBoundaryFiles(finish.boundaries);
  finish.boundaries.frame = job.input.frame.box;
  if (std::ranges::count(finish.targets, kTargetNames[static_cast<std::size_t>(Target::Adcirc)]) > 0)
    finish.weirs = weirSources(input.coastline(), finish.depth.water_level_m);
  finish.crests.zero_m = finish.depth.water_level_m;
  for (const std::string& file : finish.crests.files) readRasterGeometry(file);  // refused before it takes time
  return finish;
}

// What sizes are made from. The result refers to the arguments.
SizeInputs sizeInputsOf(const MeshJob& job, const JobInput& input, const FinishOptions& finish,
                        const JobControl& control) {
  SizeInputs sizes = readSizeInputs(job.sizes, input.coastline().crs, job.size_layers);
  const auto lengthsOf = [](const SizeOptions& options) {
    return ElementLengths{std::min(options.shore_m, options.size_m), std::min(options.most_m, options.size_m)};
  };
  sizes.shoreOf = [&, lengthsOf](const Domain& domain, const SizeOptions& options, const ItemLoop& loop) {
    return shoreForSizes(domain, input.coastline().crs, finish.boundaries, finish.depth, lengthsOf(options),
                         RunControl{control.cancelled, {}}, loop);
  };
  sizes.opened = [&, lengthsOf](Domain&& domain, const SizeOptions& options, const ItemLoop& loop) {
    return withOpenings(std::move(domain), input.coastline().crs, finish.boundaries, finish.depth, lengthsOf(options),
                        RunControl{control.cancelled, {}}, loop);
  };
  return sizes;
}

// The grid as it was meshed: moves nodes onto the frame, and measures the whole.
void measureMeshed(const MeshJob& job, const JobInput& input, const std::vector<MergedGroup>& merged,
                   const ItemLoop& loop, MeshJobResult& result) {
  result.grid.crs = result.crs;
  if (!input.isPoly()) keepInBox(job, input, merged, loop, result);
  result.mesh_area_m2 = meshArea(result.grid, loop);
  if (job.sizes.coast == CoastDetail::Follow) noteFollowed(job, result);
}

// Adds to `finish` what follows from the meshed grid.
void completeFinish(const MeshJob& job, const JobInput& input, const MeshJobResult& result, FinishOptions& finish) {
  finish.repair = {job.sizes.time_step_s / job.sizes.courant,
                   job.sizes.coast == CoastDetail::Follow,
                   job.mesh.refine.min_angle_deg,
                   job.mesh.refine.max_angle_deg,
                   StepOutcome::kUsualShare * job.sizes.least_m,
                   result.asked};
  finish.repair.on_sphere = result.surfaces.contains(SurfaceKind::Sphere);
  finish.drop_apart = dropsWatersApart(job);
  finish.close_dry = true;
  finish.plain = input.plain();
  finish.grazed = job.sizes.keep_water_given ? GrazedWaters::Keep : GrazedWaters::Drop;
}

// Boundaries, depths and repairs; measures again what repairs have changed.
void finishStage(const MeshJob& job, const JobInput& input, const std::vector<MergedGroup>& merged,
                 const FinishOptions& finish, const JobControl& control, MeshJobResult& result) {
  if (!finish.any()) return;
  const Stopwatch finishing;
  Recorder recorder;
  RunControl inner{control.cancelled, {}};
  if (control.progress) inner.progress = [&control](double share) { control.progress("finish", share); };
  InputVertices vertices = finish.mayEdit() ? InputVertices(result.grid, merged) : InputVertices();
  const ItemLoop loop = recorder.loop("finish", RunControl{control.cancelled, {}});
  result.finish = finishGrid(result.grid, finish, inner, loop);
  std::ranges::move(result.finish.notes(), std::back_inserter(result.read.notes));
  if (!result.finish.repairs.repairs.empty() || result.finish.dropped.waters > 0 || result.finish.weirs.pairs > 0) {
    result.short_before_repairs = result.short_of.count;
    measureAgain(job, input, merged, true, loop, result);
    result.mesh_area_m2 = meshArea(result.grid, loop);
    result.refine.steiner_points = std::move(vertices).othersIn(result.grid);
    if (result.input_area_m2)
      result.input_area_m2 = inputAreaLeft(*result.input_area_m2, result.grid, merged, result.finish.dropped);
  }
  result.seconds.finish = finishing.seconds();
  result.log.append(recorder.finish("finish"));
}

// Openings of one edge, unless the user defines boundaries.
void warnOfLoneOpenings(const FinishOptions& finish, MeshJobResult& result) {
  if (!finish.boundaries.files.empty() || !finish.boundaries.of_input.empty()) return;
  const LoneOpenings lone = loneOpenings(result.grid);
  if (lone.count == 0) return;
  constexpr double kLonger = 1.01;  // than the longest, once rounded
  const double closing = kLonger * lone.longest_m;
  result.read.warnings.push_back(std::to_string(lone.count) +
                                 forCount(lone.count, " open boundary is a single edge between shores, at ",
                                          " open boundaries are single edges between shores, the longest at ") +
                                 pointText(lone.place) +
                                 ": a side of the frame cuts the tip of a water there; --min-boundary " +
                                 (closing < 100.0 ? amount("%.3g", closing) : amount("%.0f", closing)) + " closes " +
                                 forCount(lone.count, "it", "them"));
}

// Looking for free memory takes longer than a small feature, of which another program, or a batch, may mesh many.
void giveBackAfter(std::size_t points_or_triangles) {
  constexpr std::size_t kWorthLooking = 50'000;
  if (points_or_triangles >= kWorthLooking) giveBackFreeMemory();
}

MeshJobResult runOnThreads(const MeshJob& given, const JobControl& control) {
  const Stopwatch whole;
  MeshJob job = given;
  MeshJobResult result;
  if (control.progress) control.progress("read", 0.0);
  Recorder recorder;
  job.input.shores_move_m = shoresMove(job.sizes);
  JobInput input(job.input, recorder.loop("read", RunControl{control.cancelled, {}}));
  if (!job.input.ready) requireUnmirrored(input.coastline(), job.input);
  result.read = input.report();
  result.read.notes.insert(result.read.notes.begin(), job.notes.begin(), job.notes.end());
  result.crs = input.coastline().crs;
  FinishOptions finish = finishOptionsOf(job, input);
  SizeInputs sizes = sizeInputsOf(job, input, finish, control);
  for (const RasterGeometry& raster : sizes.rasters)
    result.read.notes.insert(result.read.notes.end(), raster.notes.begin(), raster.notes.end());
  RasterHelpers rasters(job.mesh.helpers, RunControl{control.cancelled, {}});
  sizes.readers = rasters.readers();
  finish.depth.readers = rasters.pixelReaders();
  giveBackAfter(result.read.points);
  result.seconds.read = whole.seconds();
  result.log.append(recorder.finish("read"));
  if (control.cancelled && control.cancelled()) throw Cancelled();
  if (control.progress) control.progress("read", 1.0);

  settleSizes(input, sizes, control, job, result);
  result.sizes = job.sizes;
  const std::vector<MergedGroup> merged = meshGroups(job, input, sizes, control, result);
  giveBackAfter(result.grid.triangles.size());
  recorder = {};
  const ItemLoop loop = recorder.loop("grid", RunControl{control.cancelled, {}});
  measureMeshed(job, input, merged, loop, result);
  if (!given.sizes.choose) noteRaisedShore(result);
  result.log.append(recorder.finish("grid"));
  completeFinish(job, input, result, finish);
  finishStage(job, input, merged, finish, control, result);
  recorder = {};
  if (job.exchange.shards <= 1) warnOfIdleInputs(job, sizes, input, result);
  findTurned(result, loop);
  warnOfLoneOpenings(finish, result);
  result.step = measureOutcome(result.grid, job.sizes, loop, job.mesh.refine.goal, result.waters.too_small.count,
                               result.finish.repairs.repairs);
  std::ranges::copy(result.step.notes, std::back_inserter(result.read.notes));
  noteKeptCoast(job, result);
  result.rasters_read = rasters.use();
  result.log.append(recorder.finish("grid"));
  result.seconds.total = whole.seconds();
  return result;
}

}  // namespace

MeshJobResult runMeshJobHere(const MeshJob& job, const JobControl& control) { return runOnThreads(job, control); }

MeshJobResult runMeshJob(const MeshJob& job, const JobControl& control) {
  MeshJobResult result;
  withThreads(job.parallel, [&] { result = runOnThreads(job, control); });
  return result;
}

}  // namespace coastmesh
