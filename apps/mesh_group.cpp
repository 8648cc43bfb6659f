#include "apps/mesh_group.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "apps/places.hpp"
#include "apps/stopwatch.hpp"
#include "core/check.hpp"
#include "core/delaunay.hpp"
#include "gis/error.hpp"
#include "gis/poly_io.hpp"
#include "parallel/recorder.hpp"

namespace coastmesh {

namespace {

Point centreOf(const Pslg& pslg) {
  Point low = pslg.points.front();
  Point high = low;
  for (const Point& p : pslg.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return {low.x + (high.x - low.x) / 2, low.y + (high.y - low.y) / 2};
}

MeshOptions optionsFor(const MeshJob& job, const Domain& domain, std::uint64_t budget) {
  MeshOptions options = job.mesh;
  options.refine.max_vertices = budget;
  if (std::isfinite(job.sizes.most_m) && !job.sizes.any()) {
    options.refine.size_max = job.sizes.most_m;
    options.refine.size_max *= domain.projection.scaleAt(centreOf(domain.pslg));
  }
  return options;
}

// Leaves the failing region where its finder can send it from.
std::string dumpRegion(const Pslg& pslg, std::uint64_t digest) {
  std::ostringstream name;
  name << "coastmesh-bug-" << std::hex << digest << ".poly";
  const std::filesystem::path path = std::filesystem::temp_directory_path() / name.str();
  writePoly(pslg, path.string());
  return path.string();
}

void requireSound(const TriMesh& mesh, const Domain& domain, const Feature& first, const ItemLoop& loop) {
  const std::vector<MeshDefect> defects = checkMesh(mesh, &domain.pslg, CheckOptions{}, loop);
  if (defects.empty()) return;
  const MeshDefect& defect = defects.front();
  throw BadMesh("the mesh of " + featureText(first) + " has " + std::to_string(defects.size()) +
                " defects, the first one " + std::string(toString(defect.kind)) + " at " +
                pointText(domain.projection.inverse(defect.place)) + "; the region was kept in '" +
                dumpRegion(domain.pslg, digestOf(mesh)) + "'");
}

void placeShortfalls(const RefineStats& stats, const Projection& projection, GroupResult& result) {
  result.unresolved = stats.unresolved.size();
  const std::size_t listed = std::min(stats.unresolved.size(), kShortfallPlaces);
  for (std::size_t i = 0; i < listed; ++i) {
    const Shortfall& shortfall = stats.unresolved[i];
    result.unresolved_places.push_back(
        {projection.inverse(shortfall.place), shortfall.min_angle_deg, shortfall.max_angle_deg});
  }
}

// The group's part of the grid. It is given its own features alone, so that the work does not grow with the square of
// their number.
Grid groupGrid(const JobInput& input, std::size_t group, const Domain& domain, TriMesh& mesh, const ItemLoop& loop) {
  Coastline names;
  names.crs = input.coastline().crs;
  if (!input.isPoly()) {
    const std::vector<std::size_t>& members = input.members(group);
    for (std::size_t member : members) {
      const Feature& feature = input.coastline().features[member];
      Feature& name = names.features.emplace_back();
      name.fid = feature.fid;
      name.source = feature.source;
      name.attributes = feature.attributes;
    }
    for (RegionId& region : mesh.regions) {
      region =
          static_cast<RegionId>(std::ranges::lower_bound(members, static_cast<std::size_t>(region)) - members.begin());
    }
  }
  Grid grid = makeGrid({{&domain, &mesh}}, names, loop);
  grid.crs = {};  // the whole has it; a copy a lake would weigh more than the lake
  return grid;
}

void fillGroup(const MeshJob& job, const JobInput& input, const SizeInputs& sizes, std::size_t group,
               std::uint64_t budget, const RunControl& control, GroupResult& result) {
  const Stopwatch cleaning;
  Recorder clean_recorder;
  CleanReport clean;
  const Domain domain = input.domain(group, clean);
  result.edits = clean.counts;
  result.notes = std::move(clean.notes);
  clean = {};
  result.projection = domain.projection.description();
  result.input_area_m2 = input.area(group, domain);
  result.clean_s = cleaning.seconds();
  result.log.append(clean_recorder.finish("clean"));

  MeshOptions options = optionsFor(job, domain, budget);
  std::unique_ptr<SizeFunction> size;
  if (job.sizes.any()) {
    Recorder recorder;
    const Stopwatch sizing;
    size = makeSizeFunction(job.sizes, sizes, domain, recorder.loop("size", control));
    options.refine.size = size.get();
    result.size_s = sizing.seconds();
    result.log.append(recorder.finish());
  }
  MeshedRegion region = meshRegion(domain.pslg, options, control);
  result.mesh_s = region.seconds;
  result.refine = std::move(region.stats);
  placeShortfalls(result.refine, domain.projection, result);
  result.refine.unresolved = {};

  result.pieces = region.pieces;
  result.log.append(std::move(region.log));

  // Small regions go without the clock, which would cost them more than the work.
  Recorder recorder;
  const bool large = region.pieces > 1;
  const auto loop = [&](std::string_view stage) { return large ? recorder.loop(stage, control) : ItemLoop(inOrder); };
  const Stopwatch checking;
  requireSound(region.mesh, domain, input.coastline().features[input.members(group).front()], loop("check"));
  result.quality =
      measureQuality(region.mesh, options.refine.min_angle_deg, options.refine.max_angle_deg, loop("check"));
  result.digest = digestOf(region.mesh, 0, loop("check"));
  result.check_s = checking.seconds();
  result.grid = groupGrid(input, group, domain, region.mesh, loop("grid"));
  result.grid.piece_of = std::move(region.piece_of);
  result.log.append(recorder.finish());
}

void refuse(const BadPslg& error, const JobInput& input, std::size_t group, GroupResult& result) {
  const Feature& first = input.coastline().features[input.members(group).front()];
  CleanReport ignored;
  const Projection projection = input.domain(group, ignored).projection;
  result.refusal_place = projection.inverse(error.defect.place);
  result.refusal = featureText(first) + ": " + error.what() + " at " + pointText(*result.refusal_place);
}

}  // namespace

GroupResult meshGroup(const MeshJob& job, const JobInput& input, const SizeInputs& sizes, std::size_t group,
                      std::uint64_t budget, const RunControl& control) {
  GroupResult result;
  try {
    fillGroup(job, input, sizes, group, budget, control, result);
  } catch (const NothingWanted& nothing) {
    result.unwanted = nothing.what();
  } catch (const InputError& error) {
    result.refusal = error.what();
  } catch (const BadPslg& error) {
    refuse(error, input, group, result);
  }
  return result;
}

}  // namespace coastmesh
