#include <cstdio>
#include <memory>

#include "apps/cli/commands.hpp"
#include "apps/cli/exit_codes.hpp"
#include "apps/cli/mesh_file.hpp"
#include "apps/cli/run_outputs.hpp"
#include "apps/plot/plot_mesh.hpp"
#include "core/computable.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

struct PlotUsage {
  MeshFile mesh;
  std::string output;
  std::string bbox;
  std::string color = "none";
  PlotOptions plot;
  bool overwrite = false;
};

std::array<double, 4> parseBox(const std::string& text) {
  std::array<double, 4> box{};
  int length = 0;
  const int read = std::sscanf(text.c_str(), "%lf,%lf,%lf,%lf%n", &box[0], &box[1], &box[2], &box[3], &length);
  const bool whole = read == 4 && static_cast<std::size_t>(length) == text.size();
  bool finite = true;
  for (double side : box) finite = finite && isComputable(side);
  if (!whole || !finite || box[0] >= box[2] || box[1] >= box[3]) {
    throw OptionError("--bbox: '" + text + "' is not W,S,E,N with W below E and S below N");
  }
  return box;
}

int runPlot(PlotUsage& usage, Run& run) {
  if (!usage.bbox.empty()) usage.plot.bbox = parseBox(usage.bbox);
  usage.plot.color = plotColorNamed(usage.color);
  requirePlotFormat(usage.output);
  RunOutputs outputs(usage.overwrite, run.inputs, run.interrupt);
  StagedFiles& picture = outputs.addFile(usage.output);
  const Grid grid = readMeshFile(usage.mesh, run);
  run.interrupt.check();
  picture.make([&](const std::string& path) { plotMesh(grid, usage.plot, path); });
  outputs.commit();
  return kExitDone;
}

}  // namespace

Command declarePlot(CLI::App& root) {
  auto usage = std::make_shared<PlotUsage>();
  CommandLine line(root, "plot", "Draw a mesh");
  declareMeshFile(line, "MESH", "mesh to draw", usage->mesh);
  line.output("-o,--output", usage->output, {.required = true}, "picture to write: .svg or .png");
  line.integer("--size", usage->plot.size_px, "PX", PlotOptions::kLeastSize, PlotOptions::kMostSize,
               "longer side of the map");
  line.text("--bbox", usage->bbox, "W,S,E,N", "what to show, in the mesh's CRS; all of it by default");
  line.choice("--color", usage->color, plotColorNames(), "what the triangles' colour shows");
  line.flag("--edges,!--no-edges", usage->plot.edges, "draw the triangles' edges");
  line.number("--min-angle", usage->plot.min_angle_deg, "DEG", {0.0, 60.0},
              "show triangles with a smaller angle in red");
  line.flag("--overwrite", usage->overwrite, "replace a file that exists");
  line.example("coastmesh plot lake.nc -o lake.png --color angle", "a picture coloured by the smallest angle");
  line.example("coastmesh plot lake.nc -o bay.svg --bbox=-90.5,46.5,-90,47", "a part of it, as a vector drawing");
  return {std::move(line), [usage](Run& run) { return runPlot(*usage, run); }};
}

}  // namespace coastmesh
