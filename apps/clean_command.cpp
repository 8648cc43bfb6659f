#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

#include "apps/commands.hpp"
#include "apps/exit_codes.hpp"
#include "apps/input_usage.hpp"
#include "apps/job_input.hpp"
#include "apps/staged_file.hpp"
#include "apps/vector_output.hpp"
#include "gis/error.hpp"
#include "gis/poly_io.hpp"

namespace coastmesh {

namespace {

struct CleanUsage {
  InputOptions input;
  std::string output;
  bool overwrite = false;
  bool quiet = false;
};

struct CleanedInput {
  std::vector<Domain> domains;
  CleanReport report;
  std::vector<std::string> refused;
  std::string last_unwanted;
};

CleanedInput cleanAll(const JobInput& input, Interrupt& interrupt) {
  CleanedInput cleaned;
  for (std::size_t g = 0; g < input.groups(); ++g) {
    interrupt.check();
    try {
      cleaned.domains.push_back(input.domain(g, cleaned.report));
    } catch (const NothingWanted& nothing) {
      cleaned.last_unwanted = nothing.what();
    } catch (const InputError& error) {
      cleaned.refused.emplace_back(error.what());
    }
  }
  if (cleaned.domains.empty()) {
    throw InputError(cleaned.refused.empty() ? cleaned.last_unwanted : cleaned.refused.front());
  }
  return cleaned;
}

// The fid of the feature on one side of a segment, -1 outside and where nothing is said.
std::int64_t fidOf(RegionId region, const Coastline& coastline) {
  return region < 0 ? -1 : coastline.features[static_cast<std::size_t>(region)].fid;
}

VectorLayer pslgLayer(const CleanedInput& cleaned, const Coastline& coastline) {
  VectorLayer layer;
  layer.name = "pslg";
  layer.kind = VectorLayer::Kind::Lines;
  layer.fields = {{"region", std::int64_t{}}, {"left_fid", std::int64_t{}}, {"right_fid", std::int64_t{}}};
  for (std::size_t d = 0; d < cleaned.domains.size(); ++d) {
    const Domain& domain = cleaned.domains[d];
    for (const Segment& s : domain.pslg.segments) {
      layer.shapes.push_back({{domain.input_points[s.a], domain.input_points[s.b]},
                              {static_cast<std::int64_t>(d), fidOf(s.left, coastline), fidOf(s.right, coastline)}});
    }
  }
  return layer;
}

VectorLayer editLayer(const CleanReport& report) {
  VectorLayer layer;
  layer.name = "edits";
  layer.fields = {{"kind", std::string()}, {"fid_of_feature", std::int64_t{}}};
  for (const Edit& edit : report.edits) {
    layer.shapes.push_back({{edit.place}, {std::string(toString(edit.kind)), edit.fid}});
  }
  return layer;
}

// All groups in one graph. A .poly knows no projection, so they have to share a plane.
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

void printReport(const CleanUsage& usage, const CleanedInput& cleaned) {
  std::size_t points = 0;
  std::size_t segments = 0;
  for (const Domain& domain : cleaned.domains) {
    points += domain.pslg.points.size();
    segments += domain.pslg.segments.size();
  }
  std::printf("%zu points, %zu segments in %zu regions\n", points, segments, cleaned.domains.size());
  for (std::size_t kind = 0; kind < kEditKinds; ++kind) {
    if (cleaned.report.counts[kind] == 0) continue;
    std::printf("%s: %llu\n", std::string(toString(static_cast<EditKind>(kind))).c_str(),
                static_cast<unsigned long long>(cleaned.report.counts[kind]));
  }
  std::printf("wrote %s\n", usage.output.c_str());
}

int runClean(const CleanUsage& usage, Interrupt& interrupt) {
  const bool poly = std::filesystem::path(usage.output).extension() == ".poly";
  if (!poly) requireVectorFormat(usage.output, 2);
  StagedFile output(usage.output, usage.overwrite, interrupt);
  const JobInput input(usage.input);
  const CleanedInput cleaned = cleanAll(input, interrupt);
  if (poly) {
    const Pslg pslg = joinedPslg(cleaned, usage, input.coastline().crs);
    output.make([&pslg](const std::string& path) { writePoly(pslg, path); });
  } else {
    output.make([&](const std::string& path) {
      writeVectorLayers(path, input.coastline().crs,
                        {pslgLayer(cleaned, input.coastline()), editLayer(cleaned.report)});
    });
  }
  interrupt.close();
  output.commit();
  for (const std::string& reason : cleaned.refused) {
    std::fprintf(stderr, "coastmesh: warning: left out: %s\n", reason.c_str());
  }
  if (!usage.quiet) printReport(usage, cleaned);
  return cleaned.refused.empty() ? kExitDone : kExitShort;
}

}  // namespace

Command declareClean(CLI::App& root) {
  auto usage = std::make_shared<CleanUsage>();
  CommandLine line(root, "clean", "Write the plane graph that would be meshed, and what was changed for it");
  line.arguments("INPUT", usage->input.files, "vector files that GDAL reads ('-': standard input), or one .poly");
  line.requiredText("-o,--output", usage->output, kOutputFile,
                    "a .gpkg with the layers pslg and edits, or a .poly in the working plane");
  declareInputOptions(line, usage->input);
  line.flag("--overwrite", usage->overwrite, "replace a file that exists");
  line.flag("--quiet", usage->quiet, "print no summary");
  line.example("coastmesh clean lakes.shp -o cleaned.gpkg", "see in a GIS what would be meshed, and what was mended");
  return {std::move(line), [usage](Interrupt& interrupt) { return runClean(*usage, interrupt); }};
}

}  // namespace coastmesh
