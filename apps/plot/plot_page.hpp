#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "apps/plot/plot_globe.hpp"
#include "apps/plot/plot_mesh.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

inline constexpr std::uint64_t kMostPageTriangles = 6'000'000;  // near browsers' limits on text and memory

// True iff `path` ends in .html.
bool isPagePath(const std::string& path);

struct PageOptions {
  std::string name{};                  // of the mesh's file; the title if the mesh has none
  PlotColor color = PlotColor::Angle;  // initially
  bool edges = true;                   // initially
  double min_angle_deg = 0.0;          // triangles with a smaller angle are red
  std::optional<GlobeView> view{};     // nullopt: a fitted conformal plane, or a globe if the mesh is too large for one
};

// Writes one file that shows the mesh in a browser, without a network, to pan, zoom, colour and pick. Positions are
// integers, 2^30 - 1 for half the longer side of the plane or the radius of the globe; coordinates and depths are
// exact. Throws OutputError; InputError for a mesh without triangles or with more than kMostPageTriangles, without the
// features or depths that it is to be coloured by, or in a plane and to be shown on a globe; OptionError like
// `requireColors`, and for a view of the whole Earth.
void plotPage(const Grid& grid, const PageOptions& options, const std::string& path);

}  // namespace coastmesh
