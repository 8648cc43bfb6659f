#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "apps/plot/plot_globe.hpp"
#include "apps/plot/plot_mesh.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

inline constexpr std::uint64_t kMostPageTriangles = 6'000'000;  // a browser's text and memory end not far above

// True iff `path` ends in .html.
bool isPagePath(const std::string& path);

struct PageOptions {
  std::string name{};                  // of the mesh, where it has no title
  PlotColor color = PlotColor::Angle;  // at first
  bool edges = true;                   // at first
  double min_angle_deg = 0.0;          // triangles with a smaller angle are red
  std::optional<GlobeView> view{};     // none: a conformal plane fitted to the mesh, or a globe where that is too small
};

// Writes one file that shows the mesh in a browser, without a network: to pan, zoom, colour and pick from. Positions
// come as whole numbers, 2^30 - 1 for half the longer side of the plane or the radius of the globe; coordinates and
// depths as they are. Throws OutputError; InputError for a mesh of no or more than kMostPageTriangles triangles,
// without the depths that it is to be coloured by, or in a plane and to be shown on a globe; OptionError as
// `requireColors`, and for a view of all of the Earth.
void plotPage(const Grid& grid, const PageOptions& options, const std::string& path);

}  // namespace coastmesh
