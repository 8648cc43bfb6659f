#include "apps/mesh_job.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <mutex>
#include <numeric>
#include <sstream>

#include "apps/places.hpp"
#include "core/check.hpp"
#include "core/delaunay.hpp"
#include "gis/error.hpp"
#include "gis/poly_io.hpp"

namespace coastmesh {

namespace {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// All that remains of a group once it is meshed.
struct GroupResult {
  Grid grid;
  std::array<std::uint64_t, kEditKinds> edits{};
  std::string projection;
  RefineStats refine;
  std::uint64_t unresolved = 0;
  std::vector<ShortfallPlace> unresolved_places;
  MeshQuality quality;
  std::optional<double> input_area_m2;
  std::uint64_t digest = 0;
  double clean_s = 0.0;
  double check_s = 0.0;
  MeshSeconds mesh_s;
  std::string refusal;  // empty where it was meshed
};

// The groups' shares of the work put together, weighed by their points.
class GroupProgress {
 public:
  GroupProgress(const std::vector<std::size_t>& weights, const JobControl& control)
      : weights_(weights), shares_(weights.size(), 0.0), control_(control) {
    total_ = std::max(1.0, static_cast<double>(std::accumulate(weights.begin(), weights.end(), std::size_t{0})));
  }

  void report(std::size_t group, double share) {
    if (!control_.progress) return;
    const std::lock_guard lock(mutex_);
    const double gained = share - shares_[group];
    if (!(gained > 0.0)) return;
    shares_[group] = share;
    done_ += gained * static_cast<double>(weights_[group]);
    control_.progress("refine", std::min(1.0, done_ / total_));
  }

 private:
  const std::vector<std::size_t>& weights_;
  std::vector<double> shares_;
  const JobControl& control_;
  std::mutex mutex_;
  double total_ = 1.0;
  double done_ = 0.0;
};

Point centreOf(const Pslg& pslg) {
  Point low = pslg.points.front();
  Point high = low;
  for (const Point& p : pslg.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return {low.x + (high.x - low.x) / 2, low.y + (high.y - low.y) / 2};
}

// What the whole may hold, shared out by the groups' points, so that no group waits for what another leaves over.
std::uint64_t vertexBudget(std::uint64_t whole, std::size_t points, std::size_t all_points) {
  if (points == all_points || whole == std::numeric_limits<std::uint64_t>::max()) return whole;
  return static_cast<std::uint64_t>(static_cast<double>(whole) * static_cast<double>(points) /
                                    static_cast<double>(all_points));
}

MeshOptions optionsFor(const MeshJob& job, const Domain& domain, std::uint64_t budget) {
  MeshOptions options = job.mesh;
  options.refine.max_vertices = budget;
  options.refine.size_max = job.size_max_m;
  if (std::isfinite(job.size_max_m)) {
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

void requireSound(const TriMesh& mesh, const Domain& domain, const Feature& first) {
  const std::vector<MeshDefect> defects = checkMesh(mesh, &domain.pslg, CheckOptions{});
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
Grid groupGrid(const JobInput& input, std::size_t group, const Domain& domain, TriMesh& mesh) {
  Coastline names;
  names.crs = input.coastline().crs;
  if (!input.isPoly()) {
    const std::vector<std::size_t>& members = input.members(group);
    for (std::size_t member : members) {
      const Feature& feature = input.coastline().features[member];
      names.features.push_back({feature.fid, feature.source, {}, {}, feature.attributes});
    }
    for (RegionId& region : mesh.regions) {
      region =
          static_cast<RegionId>(std::ranges::lower_bound(members, static_cast<std::size_t>(region)) - members.begin());
    }
  }
  Grid grid = makeGrid({{&domain, &mesh}}, names);
  grid.crs = {};  // the whole has it; a copy a lake would weigh more than the lake
  return grid;
}

void meshGroup(const MeshJob& job, const JobInput& input, std::size_t group, std::uint64_t budget,
               const RunControl& control, GroupResult& result) {
  const Stopwatch cleaning;
  CleanReport clean;
  const Domain domain = input.domain(group, clean);
  result.edits = clean.counts;
  clean = {};
  result.projection = domain.projection.description();
  result.input_area_m2 = input.area(group);
  result.clean_s = cleaning.seconds();

  const MeshOptions options = optionsFor(job, domain, budget);
  MeshedRegion region = meshRegion(domain.pslg, options, control);
  result.mesh_s = region.seconds;
  result.refine = std::move(region.stats);
  placeShortfalls(result.refine, domain.projection, result);
  result.refine.unresolved = {};

  const Stopwatch checking;
  requireSound(region.mesh, domain, input.coastline().features[input.members(group).front()]);
  result.quality = measureQuality(region.mesh, options.refine.min_angle_deg, options.refine.max_angle_deg);
  result.digest = digestOf(region.mesh);
  result.check_s = checking.seconds();
  result.grid = groupGrid(input, group, domain, region.mesh);
}

std::string refusalText(const BadPslg& error, const JobInput& input, std::size_t group) {
  const Feature& first = input.coastline().features[input.members(group).front()];
  CleanReport ignored;
  const Projection projection = input.domain(group, ignored).projection;
  return featureText(first) + ": " + error.what() + " at " + pointText(projection.inverse(error.defect.place));
}

std::uint64_t combineDigests(std::uint64_t digest, std::uint64_t next) {
  return std::rotl((digest ^ next) * 0x9E3779B97F4A7C15ull, 31);
}

void addRefusal(const JobInput& input, std::size_t group, std::string reason, MeshJobResult& result) {
  Refusal refusal;
  for (std::size_t member : input.members(group)) {
    refusal.fids.push_back(input.coastline().features[member].fid);
  }
  refusal.source = input.coastline().features[input.members(group).front()].source;
  refusal.reason = std::move(reason);
  result.refusals.push_back(std::move(refusal));
}

// Appends `part` to `whole`, its indices shifted.
void appendGrid(Grid& whole, Grid&& part) {
  if (whole.triangles.empty()) {
    whole = std::move(part);
    return;
  }
  const auto node_shift = static_cast<std::uint32_t>(whole.nodes.size());
  const auto feature_shift = static_cast<std::uint32_t>(whole.features.size());
  for (auto& corners : part.triangles) {
    for (std::uint32_t& node : corners) node += node_shift;
  }
  for (std::uint32_t& feature : part.feature_of) feature += feature_shift;
  for (Boundary& boundary : part.boundaries) {
    for (std::uint32_t& node : boundary.nodes) node += node_shift;
  }
  const auto append = [](auto& to, auto& from) { std::move(from.begin(), from.end(), std::back_inserter(to)); };
  append(whole.nodes, part.nodes);
  append(whole.z, part.z);
  append(whole.triangles, part.triangles);
  append(whole.feature_of, part.feature_of);
  append(whole.min_angle_deg, part.min_angle_deg);
  append(whole.area_m2, part.area_m2);
  append(whole.features, part.features);
  append(whole.boundaries, part.boundaries);
}

void addGroup(const JobInput& input, std::size_t group, GroupResult&& part, MeshJobResult& result) {
  for (std::size_t kind = 0; kind < kEditKinds; ++kind) result.edits[kind] += part.edits[kind];
  result.seconds.clean += part.clean_s;
  if (!part.refusal.empty()) {
    addRefusal(input, group, std::move(part.refusal), result);
    return;
  }
  ++result.regions;
  ++result.projections[part.projection.substr(0, part.projection.find(','))];
  if (result.regions == 1) result.first_projection = part.projection;
  result.refine.add(part.refine);
  result.unresolved += part.unresolved;
  for (const ShortfallPlace& place : part.unresolved_places) {
    if (result.unresolved_places.size() < kShortfallPlaces) result.unresolved_places.push_back(place);
  }
  result.quality.add(part.quality);
  if (part.input_area_m2) result.input_area_m2 = result.input_area_m2.value_or(0.0) + *part.input_area_m2;
  for (double area : part.grid.area_m2) result.mesh_area_m2 += area;
  result.digest = result.regions == 1 ? part.digest : combineDigests(result.digest, part.digest);
  result.seconds.triangulate += part.mesh_s.triangulate;
  result.seconds.refine += part.mesh_s.refine;
  result.seconds.shrink += part.mesh_s.shrink;
  result.seconds.check += part.check_s;
  appendGrid(result.grid, std::move(part.grid));
}

}  // namespace

MeshJobResult runMeshJob(const MeshJob& job, const JobControl& control) {
  const Stopwatch whole;
  MeshJobResult result;
  if (control.progress) control.progress("read", 0.0);
  const JobInput input(job.input);
  result.read = input.report();
  result.crs = input.coastline().crs;
  result.seconds.read = whole.seconds();
  if (control.cancelled && control.cancelled()) throw Cancelled();
  if (control.progress) control.progress("read", 1.0);

  std::vector<std::size_t> weights(input.groups());
  for (std::size_t g = 0; g < weights.size(); ++g) weights[g] = input.pointsOf(g);
  const std::size_t all_points = std::accumulate(weights.begin(), weights.end(), std::size_t{0});
  std::vector<std::size_t> order(weights.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return weights[a] > weights[b]; });

  std::vector<std::unique_ptr<GroupResult>> groups(weights.size());
  GroupProgress progress(weights, control);
  forEachRegion(order.size(), job.parallel, RunControl{control.cancelled, {}}, [&](std::size_t i) {
    const std::size_t g = order[i];
    groups[g] = std::make_unique<GroupResult>();
    const RunControl inner{control.cancelled, [&progress, g](double share) { progress.report(g, share); }};
    try {
      meshGroup(job, input, g, vertexBudget(job.mesh.refine.max_vertices, weights[g], all_points), inner, *groups[g]);
    } catch (const InputError& error) {
      groups[g]->refusal = error.what();
    } catch (const BadPslg& error) {
      groups[g]->refusal = refusalText(error, input, g);
    }
    progress.report(g, 1.0);
  });

  const Stopwatch stitching;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    addGroup(input, g, std::move(*groups[g]), result);
    groups[g].reset();
  }
  result.grid.crs = result.crs;
  result.seconds.stitch = stitching.seconds();
  result.seconds.total = whole.seconds();
  return result;
}

}  // namespace coastmesh
