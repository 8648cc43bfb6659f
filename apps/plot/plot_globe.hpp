#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/plot/plot_mesh.hpp"
#include "gis/crs/lon_lat.hpp"
#include "gis/grid/grid.hpp"
#include "gis/grid/on_sphere.hpp"

namespace coastmesh {

// What is seen of the globe: from far off the half below `above` (none: the middle of the mesh lies there), or all of
// it, about that longitude.
struct GlobeView {
  bool all = false;
  std::optional<LonLat> above{};
};

// Reads "orthographic", "orthographic=LON,LAT", "natural-earth" or "natural-earth=LON"; none for "plane". Throws
// OptionError for all else.
std::optional<GlobeView> globeViewNamed(const std::string& text);

// Above the middle of the triangles; where they go all round, above the prime meridian. `places`: one a node.
LonLat middleOnGlobe(const Grid& grid, const std::vector<SphereVector>& places);

// Draws the grid on a globe, its edges great circles, latitudes taken for those of a sphere; what lies beyond the
// horizon is not seen. Of the options all but the box and the dots on nodes mean the same as for `plotMesh`; angles
// and quality are those of flat triangles through the corners. Throws as that does, and InputError for a mesh in a
// plane.
void plotGlobe(const Grid& grid, const PlotOptions& options, const GlobeView& view, const std::string& path);

}  // namespace coastmesh
