#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "apps/cli/cleaned_output.hpp"
#include "apps/cli/commands.hpp"
#include "apps/cli/run_outputs.hpp"
#include "apps/input/job_input.hpp"
#include "apps/job/stopwatch.hpp"
#include "apps/process/exit_codes.hpp"
#include "apps/report/report_sections.hpp"
#include "apps/report/vector_output.hpp"
#include "apps/usage/input_usage.hpp"
#include "core/triangulate/label_regions.hpp"
#include "gis/error.hpp"
#include "gis/for_count.hpp"
#include "gis/format/poly_io.hpp"
#include "gis/model/boundary_rules.hpp"
#include "parallel/workers.hpp"

namespace coastmesh {

namespace {

struct CleanUsage {
  InputOptions input;
  std::string output;
  std::string report;
  bool overwrite = false;
  bool quiet = false;
};

struct Seconds {
  double read = 0.0, clean = 0.0, write = 0.0, total = 0.0;
};

struct CleanedInput {
  std::vector<Domain> domains;
  CleanReport report;
  std::vector<std::string> refused;
  std::string last_unwanted;
};

struct CleanedGroup {
  std::optional<Domain> domain;
  CleanReport report;
  std::string refused, unwanted;
};

void cleanGroup(const JobInput& input, std::size_t group, const ItemLoop& loop, CleanedGroup& cleaned) {
  try {
    cleaned.domain = input.domain(group, cleaned.report, loop);
  } catch (const NothingWanted& nothing) {
    cleaned.unwanted = nothing.what();
  } catch (const InputError& error) {
    cleaned.refused = error.what();
  }
}

// Gives a vertex on the antimeridian the longitude of the side that its edges lead to, or -180 if they lead to both.
// The order of rings has no effect, so that cleaning a cleaned file again gives the same file.
void putOnOneSide(Domain& domain) {
  std::vector<char> west(domain.input_points.size(), 0), east = west;
  for (const Segment& s : domain.pslg.segments) {
    for (const auto& [v, other] : {std::pair(s.a, s.b), std::pair(s.b, s.a)}) {
      const double x = domain.input_points[other].x;
      if (std::abs(x) < 180) (x < 0 ? west : east)[v] = 1;
    }
  }
  for (std::size_t v = 0; v < domain.input_points.size(); ++v) {
    Point& p = domain.input_points[v];
    if (std::abs(p.x) == 180 && (west[v] || east[v])) p.x = west[v] ? -180 : 180;
  }
}

CleanedInput cleanAll(const JobInput& input, Interrupt& interrupt) {
  std::vector<CleanedGroup> groups(input.groups());
  const RunControl control{[&interrupt] { return interrupt.requested(); }, {}};
  const ItemLoop loop = [&control](std::size_t count, const auto& work) { forEachItem(count, control, work); };
  withThreads({}, [&] { loop(groups.size(), [&](std::size_t g) { cleanGroup(input, g, loop, groups[g]); }); });
  CleanedInput cleaned;
  for (CleanedGroup& group : groups) {
    cleaned.report.append(std::move(group.report));
    if (group.domain) {
      if (input.coastline().crs.geographic) putOnOneSide(*group.domain);
      cleaned.domains.push_back(std::move(*group.domain));
    }
    if (!group.unwanted.empty()) cleaned.last_unwanted = group.unwanted;
    if (!group.refused.empty()) cleaned.refused.push_back(group.refused);
  }
  if (cleaned.domains.empty()) {
    throw InputError(cleaned.refused.empty() ? cleaned.last_unwanted : cleaned.refused.front());
  }
  return cleaned;
}

// Labels the sides of a plane graph, all of whose regions are of its one feature.
void labelSides(Pslg& pslg) {
  labelSegments(pslg);
  for (Segment& s : pslg.segments) {
    s.left = std::min(s.left, RegionId{0});
    s.right = std::min(s.right, RegionId{0});
  }
}

// Boundary types that the input gives to segments, by domain; empty if it has no types.
BoundaryTypes boundaryTypes(const CleanUsage& usage, const JobInput& input, const CleanedInput& cleaned) {
  BoundaryTypes types;
  if (usage.input.boundary_column.empty() && input.boundaries().empty()) return types;
  std::vector<Point> places;
  std::vector<NodePair> edges;
  std::vector<BoundaryType*> types_of_edges;
  for (const Domain& domain : cleaned.domains) {
    const auto first = static_cast<std::uint32_t>(places.size());
    places.insert(places.end(), domain.input_points.begin(), domain.input_points.end());
    std::vector<BoundaryType>& of_domain = types.emplace_back(domain.pslg.segments.size());
    for (std::size_t s = 0; s < domain.pslg.segments.size(); ++s) {
      const Segment& segment = domain.pslg.segments[s];
      if ((segment.left < 0) == (segment.right < 0)) continue;
      edges.push_back({first + segment.a, first + segment.b});
      types_of_edges.push_back(&of_domain[s]);
    }
  }
  const auto kinds = input.boundaries().kindsOf(input.coastline().crs, places, edges, std::vector(edges.size(), true));
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (kinds[e]) *types_of_edges[e] = {textOfKind(*kinds[e]), kinds[e]->name};
  return types;
}

// All groups in one graph. A .poly has no projection, so the groups must share a plane.
Pslg joinedPslg(const CleanedInput& cleaned, const CleanUsage& usage, const Crs& crs) {
  const bool one_plane = cleaned.domains.size() == 1 || usage.input.crs != "auto" || crs.isPlane();
  if (!one_plane) {
    throw OutputError("cannot write '" + usage.output + "': the input falls into " +
                      std::to_string(cleaned.domains.size()) +
                      " parts, each in a plane of its own; choose one with --crs, or write a .gpkg");
  }
  Pslg joined;
  for (const Domain& domain : cleaned.domains) {
    const auto shift = static_cast<VertexId>(joined.points.size());
    joined.points.insert(joined.points.end(), domain.pslg.points.begin(), domain.pslg.points.end());
    joined.holes.insert(joined.holes.end(), domain.pslg.holes.begin(), domain.pslg.holes.end());
    for (Segment segment : domain.pslg.segments) {
      segment.a += shift;
      segment.b += shift;
      joined.segments.push_back(segment);
    }
  }
  return joined;
}

std::string reportOf(const CleanUsage& usage, const JobInput& input, const CleanedInput& cleaned,
                     const Seconds& seconds, const std::vector<std::string>& warnings) {
  std::size_t points = 0, segments = 0;
  for (const Domain& domain : cleaned.domains) {
    points += domain.pslg.points.size();
    segments += domain.pslg.segments.size();
  }
  Json read = readSection(usage.input.files, input.report(), input.coastline().crs);
  read["refused"] = cleaned.refused;
  for (const std::string& note : cleaned.report.notes) read["notes"].push_back(note);
  return textOf(
      {{"coastmesh", COASTMESH_VERSION},
       {"warnings", warnings},
       {"input", std::move(read)},
       {"clean", editsSection(cleaned.report.counts)},
       {"graph", {{"points", points}, {"segments", segments}, {"regions", cleaned.domains.size()}}},
       {"time_s",
        {{"read", seconds.read}, {"clean", seconds.clean}, {"write", seconds.write}, {"total", seconds.total}}},
       {"peak_memory_mib", peakMemoryMib()}});
}

void printReport(const CleanUsage& usage, const CleanedInput& cleaned) {
  std::size_t points = 0;
  std::size_t segments = 0;
  for (const Domain& domain : cleaned.domains) {
    points += domain.pslg.points.size();
    segments += domain.pslg.segments.size();
  }
  std::printf("%zu points, %zu segments in %zu %s\n", points, segments, cleaned.domains.size(),
              forCount(cleaned.domains.size(), "region", "regions"));
  for (std::size_t kind = 0; kind < kEditKinds; ++kind) {
    if (cleaned.report.counts[kind] == 0) continue;
    std::printf("%s: %llu\n", std::string(toString(static_cast<EditKind>(kind))).c_str(),
                static_cast<unsigned long long>(cleaned.report.counts[kind]));
  }
  std::printf("wrote %s\n", usage.output.c_str());
  if (!usage.report.empty()) std::printf("wrote %s\n", usage.report.c_str());
}

int runClean(const CleanUsage& usage, Run& run) {
  const bool poly = std::filesystem::path(usage.output).extension() == ".poly";
  if (poly && !usage.input.boundary_column.empty())
    throw OptionError("--boundary-column: '" + usage.output + "' cannot hold types of boundaries; write a .gpkg");
  if (poly && usage.input.frame.side == DomainSide::Globe)
    throw OptionError("--domain globe: '" + usage.output +
                      "' is a graph of the plane, which cannot hold the rest of the globe; write a .gpkg");
  if (!poly) requireVectorFormat(usage.output, 2);
  RunOutputs outputs(usage.overwrite, run.inputs, run.interrupt);
  StagedFiles& output = outputs.addFile(usage.output);
  outputs.addReport(usage.report);
  const Stopwatch watch;
  Seconds seconds;
  const JobInput input(usage.input);
  seconds.read = watch.seconds();
  CleanedInput cleaned = cleanAll(input, run.interrupt);
  seconds.clean = watch.seconds() - seconds.read;
  if (poly) {
    const Pslg pslg = joinedPslg(cleaned, usage, input.coastline().crs);
    output.make([&pslg](const std::string& path) { writePoly(pslg, path); });
  } else {
    if (input.isPoly())
      for (Domain& domain : cleaned.domains) labelSides(domain.pslg);
    output.make([&](const std::string& path) {
      writeVectorLayers(path, input.coastline().crs,
                        cleanedLayers(cleaned.domains, cleaned.report, input.coastline(), input.report(),
                                      boundaryTypes(usage, input, cleaned)));
    });
  }
  seconds.total = watch.seconds();
  seconds.write = seconds.total - seconds.read - seconds.clean;
  for (const std::string& warning : input.report().warnings) run.warn(warning);
  for (const std::string& warning : cleaned.report.warnings) run.warn(warning);
  for (const std::string& reason : cleaned.refused) run.warn("left out: " + reason);
  outputs.writeReport(reportOf(usage, input, cleaned, seconds, run.warnings));
  outputs.commit();
  if (!usage.quiet && usage.report != "-") printReport(usage, cleaned);
  return cleaned.refused.empty() ? kExitDone : kExitShort;
}

}  // namespace

Command declareClean(CLI::App& root) {
  auto usage = std::make_shared<CleanUsage>();
  OptionTable table =
      commandOptions("clean", "Write the plane graph that would be meshed, and the changes made to the input");
  table.arguments("INPUT", usage->input.files, "vector files that GDAL reads ('-': standard input), or one .poly");
  table.section(Section::Output);
  table.output({"-o,--output", "Output"}, usage->output, {.required = true},
               "a .gpkg with the layers pslg and edits, or a .poly in the working plane");
  declareInputOptions(table, usage->input);
  declareSurface(table, usage->input.surface);
  declarePinches(table, usage->input);
  table.section(Section::Boundaries);
  table.text({"--boundary-column", "Column of boundary types"}, usage->input.boundary_column, "NAME",
             "column of INPUT with the boundary types, which the layer pslg keeps for meshing");
  table.section(Section::Output);
  table.output({"--report", "Report"}, usage->report, {.standard_output = true},
               "write what was read and repaired, and the time, as JSON; - prints it instead of the summary");
  table.flag({"--overwrite", "Replace files"}, usage->overwrite, "replace a file that exists");
  table.section(Section::Run);
  table.flag({"--quiet", "No summary"}, usage->quiet, "print no summary");
  table.example("coastmesh clean lakes.shp -o cleaned.gpkg",
                "view in a GIS what would be meshed, and what was repaired");
  return {{root, std::move(table)}, [usage](Run& run) { return runClean(*usage, run); }};
}

}  // namespace coastmesh
