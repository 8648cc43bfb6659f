#include "apps/edit/merge_job.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <utility>

#include "apps/remesh/triangle_figures.hpp"
#include "apps/report/remesh_texts.hpp"
#include "apps/report/report_sections.hpp"
#include "core/run_control.hpp"
#include "gis/elements/elements.hpp"
#include "gis/error.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/for_count.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/merge/match_crs.hpp"
#include "gis/model/assign_boundaries.hpp"
#include "gis/places.hpp"

namespace coastmesh {

namespace {

// What is known of one mesh that was put in.
struct InsertedMesh {
  std::string name;
  std::string elements;  // how many of which
  std::vector<std::uint32_t> element_numbers;
  MergedMesh result;
};

// Whether a mesh has depths while the other has none.
std::string depthWarning(const Grid& grid, const Grid& inserted, const std::string& name) {
  if (grid.z.empty() == inserted.z.empty()) return {};
  return inserted.z.empty() ? "'" + name + "' has no depths: unknown for its nodes"
                            : "only '" + name + "' has depths: unknown for all other nodes";
}

// Rasters give depths to new nodes only: between two meshes without any they would be the only ones.
void requireAnyDepths(const Grid& grid, const std::string& name, const Grid& inserted, const std::string& inserted_name,
                      const DepthOptions& options) {
  if (!grid.z.empty() || !inserted.z.empty() || options.files.empty()) return;
  throw InputError("'" + name + "' and '" + inserted_name +
                   "' have no depths, and --bathymetry gives them to new nodes only: leave it out, and then give all "
                   "of the mesh depths, with coastmesh convert --bathymetry");
}

// Which nodal attributes only one of the meshes has.
std::vector<std::string> fieldWarnings(const Grid& grid, const std::string& name, const Grid& inserted,
                                       const std::string& inserted_name) {
  std::vector<std::string> all;
  const auto add = [&](const Grid& with, const Grid& without, const std::string& of) {
    for (const NodeField& field : with.node_fields)
      if (findField(without, field.name, field.component) == nullptr)
        all.push_back("'" + of + "' has no " + titleOf(field) + ": its nodes get the default, " +
                      amount("%.6g", defaultOf(field)));
  };
  add(grid, inserted, inserted_name);
  add(inserted, grid, name);
  return all;
}

InsertedMesh putIn(Grid& grid, const std::string& name, const MeshToInsert& mesh, const MergeOptions& options,
                   const Warn& warn, const RunControl& control, const ItemLoop& loop) {
  Grid inserted = mesh.read();
  findMissingBoundaries(inserted);
  matchCrs(inserted, grid, mesh.name);
  requireAnyDepths(grid, name, inserted, mesh.name, options.depth);
  if (const std::string warning = depthWarning(grid, inserted, mesh.name); !warning.empty()) warn(warning);
  for (const std::string& warning : fieldWarnings(grid, name, inserted, mesh.name)) warn(warning);
  InsertedMesh done{mesh.name, elementCount(inserted, grouped), elementNumbers(inserted), {}};
  try {
    done.result = mergeMesh(grid, std::move(inserted), options, control, loop);
  } catch (const InputError& error) {
    throw InputError("'" + mesh.name + "' cannot be put into '" + name + "': " + error.what());
  }
  return done;
}

// Empty if there are none.
std::string weirGapsText(const std::vector<WeirGap>& gaps, const Grid& grid) {
  constexpr std::size_t kMostNamed = 20;
  if (gaps.empty()) return {};
  std::vector<std::string> places;
  for (const WeirGap& gap : gaps) places.push_back(lengthText(gap.length_m, grid) + " at " + pointText(gap.place));
  return std::string(forCount(gaps.size(), "it leaves a gap in a weir", "it leaves gaps in weirs")) +
         " of the other mesh, where water flows through, or a wall has no flow over it: " + listed(places, kMostNamed) +
         "; mesh it with the same --weirs, in a frame that no weir crosses";
}

// Openings of one edge that the inserted mesh has brought, or of which it has left one edge; empty if there are none.
std::string loneOpeningsText(const InsertedMesh& inserted, const Grid& grid) {
  const std::vector<MergeSource>& nodes = inserted.result.nodes;
  const LoneOpenings lone = loneOpenings(grid, [&](const Boundary& boundary) {
    return std::ranges::any_of(boundary.nodes, [&](std::uint32_t node) { return nodes[node].mesh != 0; });
  });
  if (lone.count == 0) return {};
  return grouped(lone.count) +
         forCount(lone.count, " open boundary is a single edge between shores, at ",
                  " open boundaries are single edges between shores, the longest at ") +
         pointText(lone.place) + ": a --min-boundary above " + lengthText(lone.longest_m, grid) +
         " in its own run closes " + forCount(lone.count, "it", "them") +
         ", or convert --boundaries, with the type land there";
}

std::vector<std::string> warningsOf(const InsertedMesh& inserted, const Grid& grid, const DepthOptions& depth) {
  const MergeReport& merged = inserted.result.merged;
  const std::string in = "'" + inserted.name + "': ";
  std::vector<std::string> all;
  if (!merged.has_open) all.push_back(in + "no open boundary, so that it joins the water of the other mesh all around");
  if (merged.walls > 0)
    all.push_back(in + grouped(merged.walls) +
                  forCount(merged.walls, " edge of its open boundaries is land now, as it has",
                           " edges of its open boundaries are land now, as they have") +
                  " no water of the other mesh beside it");
  if (merged.closed.length_m > 0.0)
    all.push_back(in + lengthText(merged.closed.length_m, grid) +
                  " of its land boundary run through triangles of the other mesh, such as at " +
                  pointText(merged.closed.place) +
                  ": they stay closed; if they are sides of its frame, convert --boundaries can make them open");
  if (const std::string gaps = weirGapsText(merged.weir_gaps, grid); !gaps.empty()) all.push_back(in + gaps);
  if (const std::string lone = loneOpeningsText(inserted, grid); !lone.empty()) all.push_back(in + lone);
  if (merged.cut_off > 0)
    all.push_back(in + "it cuts waters off from the rest, which are left out: " + grouped(merged.cut_off) +
                  forCount(merged.cut_off, " triangle", " triangles"));
  if (const std::string lost = lostWaterText(merged); !lost.empty()) all.push_back(in + lost);
  if (merged.partition_dropped)
    all.emplace_back("the assignment to processes is of the meshes before, and left out; partition makes a new one");
  if (inserted.result.band) std::ranges::move(newNodeWarnings(*inserted.result.band, depth), std::back_inserter(all));
  return all;
}

using TextOfFinished = std::function<std::string(const Grid& finished)>;

// `may_change`: repairs or a further mesh may change what lies between both. The loop has to live as long.
TextOfFinished textOf(const InsertedMesh& inserted, const Grid& grid, bool may_change, const ItemLoop& loop) {
  const MergedMesh& result = inserted.result;
  std::string text = "'" + inserted.name + "': " + inserted.elements + " in place of " +
                     grouped(result.merged.covered) + ", joined along " + grouped(result.merged.joined) +
                     forCount(result.merged.joined, " edge", " edges") +
                     (result.merged.joined_land > 0
                          ? ", " + grouped(result.merged.joined_land) + " of them sides of its frame across land"
                          : "") +
                     "\n";
  if (result.merged.united > 0) text += "nodes that both have: " + grouped(result.merged.united) + "\n";
  if (!result.band) return [text](const Grid&) { return text; };
  const LastingFigures between(result.band->inside, may_change, grid, loop,
                               [&](std::size_t t) { return result.triangles[t].mesh == kNone; });
  const std::string place =
      "in place of " + grouped(result.replaced) + " around " + (result.merged.gap > 0 ? "the gap" : "the seam") + "\n";
  return [text, between, place](const Grid& finished) {
    return text + "between both: " + figuresText(between.in(finished), finished) + place;
  };
}

// Sources after one more mesh, number `mesh`, was put in.
std::vector<MergeSource> composed(const std::vector<MergeSource>& before, const std::vector<MergeSource>& last,
                                  std::uint32_t mesh) {
  std::vector<MergeSource> all;
  all.reserve(last.size());
  for (const MergeSource& source : last)
    all.push_back(source.mesh == 0   ? before[source.number]
                  : source.mesh == 1 ? MergeSource{mesh, source.number}
                                     : MergeSource{});
  return all;
}

std::vector<MergeSource> ownSources(std::size_t count) {
  std::vector<MergeSource> sources;
  for (std::uint32_t i = 0; i < count; ++i) sources.push_back({0, i});
  return sources;
}

}  // namespace

EditedMesh runMergeJob(Grid& grid, const std::string& name, const std::vector<MeshToInsert>& inserted,
                       const MergeJob& job, const Warn& warn, const JobControl& control) {
  const RefineOptions& bounds = job.merge.mesh.refine;
  RepairedTriangles repaired;
  const auto merge = [&](const RunControl& of_edit, const ItemLoop& loop) {
    MeshEdit edit;
    auto& nodes = edit.sources.merged_nodes;
    auto& triangles = edit.sources.merged_triangles;
    nodes = ownSources(grid.nodes.size());
    triangles = ownSources(grid.triangles.size());
    std::vector<TextOfFinished> texts;
    const bool may_change = inserted.size() > 1 || job.finish.mayEdit();
    const auto share = [&](std::size_t i) { return static_cast<double>(i) / static_cast<double>(inserted.size()); };
    for (std::uint32_t i = 0; i < inserted.size(); ++i) {
      const RunControl of_one = stageControl(of_edit, {share(i), share(i + 1)});
      InsertedMesh done = putIn(grid, name, inserted[i], job.merge, warn, of_one, loop);
      nodes = composed(nodes, done.result.nodes, i + 1);
      triangles = composed(triangles, done.result.triangles, i + 1);
      std::ranges::move(warningsOf(done, grid, job.merge.depth), std::back_inserter(edit.warnings));
      texts.push_back(textOf(done, grid, may_change, loop));
      edit.sources.elements_before.push_back(std::move(done.element_numbers));
    }
    const BeforeRepairs before(grid, job.finish.mayEdit(), loop);
    edit.text = [texts, before, &bounds, &repaired](const Grid& finished) {
      std::string text;
      for (const TextOfFinished& textOfOne : texts) text += textOfOne(finished);
      repaired = before.repairedIn(finished, bounds.min_angle_deg, bounds.max_angle_deg);
      text += repairedText(repaired, finished);
      return text + grouped(finished.nodes.size()) + " nodes, " + elementCount(finished, grouped) + "\n";
    };
    return edit;
  };
  EditedMesh edited = editMesh("merge", grid, merge, job.finish, control);
  if (repaired.below > 0) edited.warnings.push_back(repairedWarning(repaired));
  return edited;
}

}  // namespace coastmesh
