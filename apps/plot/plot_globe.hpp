#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/plot/plot_mesh.hpp"
#include "gis/crs/lon_lat.hpp"
#include "gis/grid/grid.hpp"
#include "gis/grid/on_sphere.hpp"

namespace coastmesh {

// The view of the globe: the half below `above`, from far away, or all of it, centred on that longitude. Without
// `above`, the middle of the mesh.
struct GlobeView {
  bool all = false;
  std::optional<LonLat> above{};
};

// Reads "orthographic", "orthographic=LON,LAT", "natural-earth" or "natural-earth=LON"; nullopt for "plane". Throws
// OptionError for anything else.
std::optional<GlobeView> globeViewNamed(const std::string& text);

// The middle of the triangles, in whole degrees; (0, 20) if they go all around. `places`: per node.
LonLat middleOnGlobe(const Grid& grid, const std::vector<SphereVector>& places);

// Draws the grid on a globe. Edges are great circles, latitudes are taken for those of a sphere; what is beyond the
// horizon is hidden. Options mean the same as for `plotMesh`, except for the box and the dots on nodes, which do not
// apply; angles and quality are those of flat triangles through the corners. Throws like `plotMesh`, and InputError for
// a mesh in a plane.
void plotGlobe(const Grid& grid, const PlotOptions& options, const GlobeView& view, const std::string& path);

// Draws the grid in a plane like `plotMesh`. If it is too large for one, draws it on a globe from far above its middle,
// and returns a note on that; otherwise returns nothing.
std::string plotMeshOrGlobe(const Grid& grid, const PlotOptions& options, const std::string& path);

}  // namespace coastmesh
