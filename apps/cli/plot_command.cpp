#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/cli/commands.hpp"
#include "apps/cli/mesh_file.hpp"
#include "apps/cli/run_outputs.hpp"
#include "apps/plot/plot_globe.hpp"
#include "apps/plot/plot_mesh.hpp"
#include "apps/plot/plot_page.hpp"
#include "apps/process/exit_codes.hpp"

namespace coastmesh {

namespace {

struct PlotUsage {
  MeshFile mesh;
  std::string output;
  std::string color = "none";
  std::string view = "plane";
  PlotOptions plot;
  bool overwrite = false;
};

// If the east is less than the west, the box crosses the antimeridian, as for --bbox of the domain.
std::string storeBox(std::vector<double> sides, PlotOptions& plot) {
  constexpr double kHalfTurn = 180.0;
  plot.bbox.reset();
  if (sides.empty()) return {};
  if (sides[0] > sides[2] && sides[0] <= kHalfTurn && sides[2] >= -kHalfTurn) sides[2] += 2.0 * kHalfTurn;
  const bool finite = std::ranges::all_of(sides, [](double side) { return std::isfinite(side); });
  if (!finite || sides[0] >= sides[2] || sides[1] >= sides[3]) return "is not W,S,E,N with W below E and S below N";
  plot.bbox = {sides[0], sides[1], sides[2], sides[3]};
  return {};
}

// Throws OptionError for options that have no meaning for a page.
void refusePictureOptions(const OptionTable& options) {
  for (const char* name : {"--size", "--bbox", "--degrees"}) {
    if (!options.given(name).empty())
      throw OptionError(std::string(name) +
                        " is for pictures, .svg or .png: a page (.html) shows all of the mesh, and "
                        "is as large as its window");
  }
}

int runPlot(PlotUsage& usage, Run& run) {
  usage.plot.color = plotColorNamed(usage.color);
  const std::optional<GlobeView> globe = globeViewNamed(usage.view);
  const bool page = isPagePath(usage.output);
  if (page)
    refusePictureOptions(run.options);
  else
    requirePlotFormat(usage.output);
  RunOutputs outputs(usage.overwrite, run.inputs, run.interrupt);
  StagedFiles& picture = outputs.addFile(usage.output);
  const Grid grid = readMeshFile(usage.mesh, run);
  run.interrupt.check();
  PageOptions in_page{.name = std::filesystem::path(usage.mesh.path).filename().string(),
                      .edges = usage.plot.edges,
                      .min_angle_deg = usage.plot.min_angle_deg,
                      .view = globe};
  if (!run.options.given("--color").empty()) in_page.color = usage.plot.color;
  picture.make([&](const std::string& path) {
    if (page)
      plotPage(grid, in_page, path);
    else if (globe)
      plotGlobe(grid, usage.plot, *globe, path);
    else if (const std::string note = plotMeshOrGlobe(grid, usage.plot, path); !note.empty())
      run.warn(note);
  });
  outputs.commit();
  return kExitDone;
}

}  // namespace

Command declarePlot(CLI::App& root) {
  auto usage = std::make_shared<PlotUsage>();
  OptionTable table = commandOptions("plot", "Draw a mesh");
  declareMeshFile(table, "MESH", "mesh to draw", usage->mesh);
  table.section(Section::Output);
  table.output({"-o,--output", "Picture"}, usage->output, {.required = true},
               "picture to write: .svg, .png, or an interactive page for a browser, .html");
  table.section(Section::Picture);
  table.integer({"--size", "Size in pixels"}, usage->plot.size_px, "PX", PlotOptions::kLeastSize,
                PlotOptions::kMostSize, "longer side of the map");
  table.numbers(
      {"--bbox", "Bounding box"}, "W,S,E,N", false,
      [&plot = usage->plot](const std::vector<double>& sides) { return storeBox(sides, plot); },
      "part to show, in the mesh's CRS; default: the whole mesh");
  table.text(
      {"--view", "View"}, usage->view, "VIEW",
      "plane: a conformal projection fitted to the mesh; for a mesh of most of the Earth without --bbox the same as "
      "orthographic; orthographic=LON,LAT: a globe seen from above that point "
      "(default: the middle of the mesh); natural-earth=LON: a world map centred on that longitude (default: 0)");
  const auto on_plane = [usage = usage.get()] { return usage->view == "plane"; };
  table.option("--bbox").needs(on_plane, "with a globe as --view");
  table.choice({"--color", "Colour of triangles"}, usage->color, plotColorNames(),
               "what the colour of triangles shows; in a page, the initial choice (default: angle); quality is 4 "
               "sqrt(3) area / sum of squared edges, 1 for equilateral triangles, and of quadrilaterals the smallest "
               "sine of their angles (scaled Jacobian), 1 for rectangles");
  table.flag({"--edges,!--no-edges", "Draw edges"}, usage->plot.edges, "draw edges of the triangles");
  table.flag({"--degrees", "Dots on irregular nodes"}, usage->plot.degrees,
             "draw a dot on each interior node that does not have six neighbours: green for 5, orange for 7, purple "
             "for other numbers");
  table.option("--degrees").needs(on_plane, "with a globe as --view");
  table.number({"--min-angle", "Angle shown in red"}, usage->plot.min_angle_deg, "DEG", {0.0, 60.0},
               "show triangles with a smaller angle in red");
  table.section(Section::Output);
  table.flag({"--overwrite", "Replace files"}, usage->overwrite, "replace a file that exists");
  table.example("coastmesh plot lake.nc -o lake.png --color angle", "a picture coloured by the smallest angle");
  table.example("coastmesh plot lake.nc -o lake.html", "an interactive page that needs no network");
  table.example("coastmesh plot lake.nc -o shapes.png --color quality --degrees", "how regular it is");
  table.example("coastmesh plot lake.nc -o bay.svg --bbox=-90.5,46.5,-90,47", "a part of it, as a vector drawing");
  table.example("coastmesh plot lake.nc -o globe.png --view orthographic=-60,30", "its place on the globe");
  table.example("coastmesh plot globe.nc -o world.png --view natural-earth --color size", "a world map");
  return {{root, std::move(table)}, [usage](Run& run) { return runPlot(*usage, run); }};
}

}  // namespace coastmesh
