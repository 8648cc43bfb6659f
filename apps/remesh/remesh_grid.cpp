#include "apps/remesh/remesh_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "apps/remesh/mesh_patch.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/fields/plain_field.hpp"
#include "gis/geometry/box.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "gis/grid/linked_grid.hpp"
#include "gis/places.hpp"
#include "gis/remesh/grow_part.hpp"
#include "gis/remesh/remesh_patch.hpp"
#include "gis/rivers/mesh_triangles.hpp"

namespace coastmesh {

namespace {

// Throws InputError if more than two triangles, or two of opposite orientation, share an edge of a taken one.
void requireLinks(const Grid& grid, const std::vector<EdgeConflict>& conflicts,
                  const std::vector<std::uint8_t>& taken) {
  if (conflicts.empty()) return;
  std::vector<std::uint8_t> in_part(grid.nodes.size(), 0);
  for (std::size_t t = 0; t < taken.size(); ++t)
    if (taken[t] != 0)
      for (const std::uint32_t node : grid.triangles[t]) in_part[node] = 1;
  for (const EdgeConflict& edge : conflicts)
    if (in_part[edge.a] != 0 && in_part[edge.b] != 0)
      throw InputError("the edge between nodes " + std::to_string(edge.a + 1) + " and " + std::to_string(edge.b + 1) +
                       " at " + pointText(grid.nodes[edge.a]) +
                       ", in the part to be meshed anew, is not that of one or two triangles of one orientation: "
                       "check finds such edges");
}

// A part with its new meshes.
struct MeshedPart {
  std::vector<RemeshPatch> patches;
  std::vector<std::shared_ptr<MeshedPatch>> meshed;  // one for each patch
  std::size_t taken_in = 0;

  double missed() const {
    double sum = 0.0;
    for (const auto& patch : meshed) sum += patch->at_rim.squared_deg;
    return sum;
  }
};

// Combined progress of patches, weighted by their triangles.
class PatchProgress {
 public:
  PatchProgress(const std::vector<RemeshPatch>& patches, const RunControl& control)
      : patches_(patches), control_(control), shares_(patches.size(), 0.0) {
    for (const RemeshPatch& patch : patches) total_ += static_cast<double>(patch.triangles.size());
  }

  RunControl of(std::size_t p) {
    if (!control_.progress) return control_;
    return {control_.cancelled, [this, p](double share) { report(p, share); }};
  }

 private:
  void report(std::size_t p, double share) {
    const std::lock_guard lock(mutex_);
    const double gained = share - shares_[p];
    if (!(gained > 0.0)) return;
    shares_[p] = share;
    done_ += gained * static_cast<double>(patches_[p].triangles.size());
    control_.progress(std::min(1.0, done_ / total_));
  }

  const std::vector<RemeshPatch>& patches_;
  const RunControl& control_;
  std::vector<double> shares_;
  std::mutex mutex_;
  double total_ = 0.0;
  double done_ = 0.0;
};

// Patches that `before` has too keep their meshes.
MeshedPart meshPart(const Grid& grid, const LinkedGrid& linked, const std::vector<std::uint8_t>& taken,
                    const PatchMesher& mesher, const MeshedPart& before, const RunControl& control,
                    const ItemLoop& loop) {
  requireLinks(grid, linked.conflicts, taken);
  MeshedPart part;
  part.patches = patchesOf(grid, linked.mesh, taken, loop);
  for (RemeshPatch& patch : part.patches) mesher.setCoast(patch.domain);
  part.meshed.resize(part.patches.size());
  PatchProgress progress(part.patches, control);
  forItems(loop, part.patches.size(), [&](std::size_t p) {
    const RemeshPatch& patch = part.patches[p];
    // Patches are in the order of their first triangles.
    const auto like = std::ranges::lower_bound(before.patches, patch.triangles.front(), {},
                                               [](const RemeshPatch& other) { return other.triangles.front(); });
    part.meshed[p] = like != before.patches.end() && like->triangles == patch.triangles
                         ? before.meshed[static_cast<std::size_t>(like - before.patches.begin())]
                         : std::make_shared<MeshedPatch>(mesher.mesh(patch, progress.of(p)));
  });
  return part;
}

// Flags of the nodes around which triangles that stay cost new ones the bounds on angles, in patches that may still be
// meshed again: the triangles of these are taken from `most_again`.
std::vector<std::uint8_t> costlyNodes(const MeshedPart& part, std::size_t nodes, std::size_t& most_again) {
  std::vector<std::uint8_t> at_nodes(nodes, 0);
  for (const auto& patch : part.meshed) {
    const std::size_t triangles = patch->made.mesh.triangles.size();
    if (patch->at_rim.nodes.empty() || triangles > most_again) continue;
    most_again -= triangles;
    for (const std::uint32_t node : patch->at_rim.nodes) at_nodes[node] = 1;
  }
  return at_nodes;
}

// Takes in the triangles around places where those that stay cost the bounds on angles, a few times. Returns the part
// that misses them least.
MeshedPart meshGrowing(const Grid& grid, const LinkedGrid& linked, std::vector<std::uint8_t> taken,
                       const std::vector<std::uint8_t>& reach, const PatchMesher& mesher, std::size_t most_again,
                       const RunControl& control, const ItemLoop& loop) {
  constexpr int kMostTimes = 4;
  constexpr double kFirst = 0.8, kEach = (1.0 - kFirst) / kMostTimes;  // shares of the progress
  MeshedPart last = meshPart(grid, linked, taken, mesher, {}, stageControl(control, {0.0, kFirst}), loop);
  std::optional<MeshedPart> best;  // if better than the last
  for (int times = 0; times < kMostTimes; ++times) {
    const std::vector<std::uint8_t> at_nodes = costlyNodes(last, grid.nodes.size(), most_again);
    std::size_t taken_in = takeInAt(linked.mesh, at_nodes, reach, taken, loop);
    taken_in += takeInSingle(linked.mesh, reach, taken, loop);
    if (taken_in == 0) break;
    try {
      const double from = kFirst + kEach * times;
      MeshedPart larger =
          meshPart(grid, linked, taken, mesher, last, stageControl(control, {from, from + kEach}), loop);
      larger.taken_in = last.taken_in + taken_in;
      if (larger.missed() >= last.missed() && !best) best = std::move(last);
      last = std::move(larger);
      if (best && last.missed() < best->missed()) best.reset();
    } catch (const InputError&) {
      break;  // of triangles that were not asked for
    }
  }
  return best ? std::move(*best) : std::move(last);
}

// Taken triangles above the water, if sizes at the shore are asked for and the mesh has no attribute of flood plains.
std::size_t unknownLand(const Grid& grid, const std::vector<std::uint8_t>& taken, const SizeOptions& sizes) {
  if (!std::isfinite(sizes.shore_m) || hasPlain(grid) || grid.z.empty()) return 0;
  std::size_t count = 0;
  for (std::size_t t = 0; t < taken.size(); ++t)
    if (taken[t] != 0 && std::ranges::all_of(grid.triangles[t], [&](std::uint32_t node) { return grid.z[node] > 0.0; }))
      ++count;
  return count;
}

// New nodes in triangles on the land of a flood plain are on land, also beside the coast.
void keepPlain(Grid& grid, const ReplaceReport& replaced, const Grid* before, const ItemLoop& loop) {
  NodeField* const plain = findField(grid, std::string(kFloodPlain));
  if (plain == nullptr) return;
  const NodeField* const known = before != nullptr ? findField(*before, plain->name) : nullptr;
  std::optional<MeshTriangles> triangles;
  if (known != nullptr) triangles.emplace(*before, boxAround(before->nodes, loop), loop);
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
    if (replaced.nodes[i] != kNone) continue;
    const double there = triangles ? triangles->valueAt(known->values, grid.nodes[i]) : plain->values[i];
    plain->values[i] = (std::isnan(there) ? plain->values[i] : there) > 0.0 ? 1.0 : 0.0;
  }
}

// Sets the depths of new nodes from rasters.
DepthReport setNewDepths(Grid& grid, const ReplaceReport& replaced, const DepthOptions& options,
                         const RunControl& control, const ItemLoop& loop) {
  Grid part;
  part.crs = grid.crs;
  if (grid.z.empty()) grid.z.assign(grid.nodes.size(), std::numeric_limits<double>::quiet_NaN());
  const std::vector<std::uint8_t> land = landNodes(grid);
  std::vector<std::uint8_t> part_land;
  std::vector<std::uint32_t> number(grid.nodes.size(), kNone), nodes;
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    if (replaced.triangles[t] != kNone) continue;
    auto& corners = part.triangles.emplace_back(grid.triangles[t]);
    for (std::uint32_t& node : corners) {
      if (number[node] == kNone) {
        number[node] = static_cast<std::uint32_t>(nodes.size());
        nodes.push_back(node);
        part.nodes.push_back(grid.nodes[node]);
        part.z.push_back(grid.z[node]);
        if (!land.empty()) part_land.push_back(land[node]);
      }
      node = number[node];
    }
  }
  DepthOptions own = options;
  own.keep_known = true;
  own.keep_land = true;
  own.landOf = [&part_land](const Grid&) { return part_land; };
  DepthReport report = setDepths(part, own, control, loop);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (replaced.nodes[nodes[i]] == kNone) grid.z[nodes[i]] = part.z[i];
  return report;
}

}  // namespace

RemeshReport remeshGrid(Grid& grid, std::vector<std::uint8_t> taken, const RemeshOptions& options,
                        const RunControl& control, const ItemLoop& loop) {
  constexpr double kMeshing = 0.9;  // share of the progress
  RemeshReport report;
  report.quads_before = quadsOf(grid).size();
  MeshedPart part;
  {
    const LinkedGrid linked = linkGrid(grid, loop);
    includeOtherHalves(grid, taken);
    std::vector<std::uint8_t> reach = reachOf(linked.mesh, taken, loop);
    const std::vector<std::uint32_t> other_half = otherHalves(grid);
    for (std::size_t t = 0; t < other_half.size(); ++t)
      if (other_half[t] != kNone) reach[t] = 0;
    for (std::size_t t = 0; t < options.stay.size(); ++t)
      if (options.stay[t] != 0) reach[t] = 0;
    const std::size_t single = takeInSingle(linked.mesh, reach, taken, loop);
    if (options.stay.empty()) report.tidied = tidyCut(linked.mesh, other_half, taken, loop);
    report.land_unknown = unknownLand(grid, taken, options.sizes);
    const SizeInputs inputs = readSizeInputs(options.sizes, grid.crs);
    const PatchMesher mesher(grid, linked.mesh, options, inputs, loop);
    part = meshGrowing(grid, linked, std::move(taken), reach, mesher, options.most_again,
                       stageControl(control, {0.0, kMeshing}), loop);
    report.taken_in = single + part.taken_in;
  }
  const std::vector<RemeshPatch>& patches = part.patches;
  report.patches = patches.size();
  std::vector<PatchMesh> made;
  double triangles = 0.0, changed = 0.0;
  report.has_shore = false;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    MeshedPatch& meshed = *part.meshed[p];
    report.whole_edges += patches[p].rim.size() - patches[p].shared.size();
    report.rim.width_m = std::max(report.rim.width_m, meshed.rim.width_m);
    const auto count = static_cast<double>(meshed.made.mesh.triangles.size());
    triangles += count;
    changed += meshed.rim.share * count;
    report.has_shore = report.has_shore || meshed.has_shore;
    report.below_bounds += meshed.short_of.count;
    for (const BoundViolationPlace& below : meshed.short_of.places)
      if (!report.worst_below || below.min_angle_deg < report.worst_below->min_angle_deg) report.worst_below = below;
    made.push_back(std::move(meshed.made));
  }
  report.rim.share = changed / triangles;
  report.replaced = replacePatches(grid, patches, std::move(made), loop);
  keepPlain(grid, report.replaced, options.before, loop);
  if (!options.depth.files.empty())
    report.depth = setNewDepths(grid, report.replaced, options.depth, stageControl(control, {kMeshing, 1.0}), loop);
  const std::vector<std::uint32_t>& sources = report.replaced.triangles;
  report.quads = quadsOf(grid).size();
  const std::vector<std::uint32_t> other_half = otherHalves(grid);
  report.inside = figuresOf(grid, loop, [&](std::size_t t) { return sources[t] == kNone; });
  report.outside = figuresOf(
      grid, loop, [&](std::size_t t) { return sources[t] != kNone && (other_half.empty() || other_half[t] == kNone); });
  return report;
}

}  // namespace coastmesh
