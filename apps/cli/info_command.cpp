#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

#include "apps/cli/commands.hpp"
#include "apps/cli/mesh_file.hpp"
#include "apps/job/check_grid.hpp"
#include "apps/process/exit_codes.hpp"
#include "apps/report/file_info.hpp"
#include "apps/usage/input_usage.hpp"
#include "gis/error.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/format/poly_io.hpp"
#include "gis/lower_case.hpp"

namespace coastmesh {

namespace {

struct InfoUsage {
  MeshFile file;
  bool json = false;
  SurfaceChoice surface;
};

// False for endings of mesh formats, except GIS layers, which may hold either: their content decides.
bool mayHoldCoastline(const std::string& path) {
  constexpr std::array<std::string_view, 5> kLayers{".gpkg", ".geojson", ".json", ".shp", ".fgb"};
  const std::string name = lowerCase(path);
  const auto isEnding = [&name](std::string_view ending) { return name.ends_with(ending); };
  if (std::ranges::any_of(kLayers, isEnding)) return true;
  return std::ranges::none_of(gridFormats(),
                              [&](const GridFormat& format) { return std::ranges::any_of(format.endings, isEnding); });
}

std::optional<Grid> tryMesh(const MeshFile& file, Run& run) {
  if (!mayHoldCoastline(file.path)) return readMeshFile(file, run);
  try {
    return readMeshFile(file, run);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

template <typename Info>
std::string inForm(const Info& info, bool json) {
  return json ? toJson(info) : toText(info);
}

std::string describe(const InfoUsage& usage, Run& run) {
  const std::string& path = usage.file.path;
  if (std::filesystem::path(path).extension() == ".poly") {
    warnOfCrs(usage.file, "a .poly lies in a plane", run);
    return inForm(describePoly(readPoly(path)), usage.json);
  }
  if (const std::optional<Grid> grid = tryMesh(usage.file, run))
    return inForm(describeMesh(*grid, surfaceFor(*grid, usage.surface)), usage.json);
  warnOfCrs(usage.file, "'" + path + "' holds no mesh", run);
  InputOptions options;
  options.files = {path};
  return inForm(describeCoastline(JobInput(options)), usage.json);
}

}  // namespace

Command declareInfo(CLI::App& root) {
  auto usage = std::make_shared<InfoUsage>();
  OptionTable table = commandOptions("info", "Describe a mesh, a vector file or a .poly");
  declareMeshFile(table, "FILE", "mesh, vector file or .poly", usage->file);
  declareSurface(table, usage->surface);
  table.section(Section::Output);
  table.flag({"--json", "As JSON"}, usage->json, "print the description as JSON");
  table.example("coastmesh info lake.nc", "counts, extent, quality and a histogram of angles");
  table.example("coastmesh info lakes.shp", "the features of a vector file");
  return {{root, std::move(table)}, [usage](Run& run) {
            std::fputs(describe(*usage, run).c_str(), stdout);
            return static_cast<int>(kExitDone);
          }};
}

}  // namespace coastmesh
