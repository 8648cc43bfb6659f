#include "apps/input/read_input.hpp"

#include <algorithm>

#include "apps/input/working_plane.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/crs/handedness.hpp"
#include "gis/error.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/read/open_source.hpp"
#include "gis/read/raw_layer.hpp"

namespace coastmesh {

namespace {

// GeoJSON always declares longitudes and latitudes. If coordinates to be taken as a plane are out of their range, drops
// the CRS, with a warning: neither the input nor the mesh has a place on Earth.
void forgetImpossibleCrs(Coastline& coastline, ReadReport& report) {
  if (!coastline.crs.geographic) return;
  const Feature* odd = nullptr;
  const auto look = [&](const Feature& feature, const std::vector<Point>& chain) {
    const auto isOdd = [](const Point& p) { return !isOnEarth(asLonLat(p)); };
    if (odd == nullptr && std::ranges::any_of(chain, isOdd)) odd = &feature;
  };
  for (const Feature& feature : coastline.features) {
    for (const Polygon& polygon : feature.polygons) {
      look(feature, polygon.outer);
      for (const Ring& hole : polygon.holes) look(feature, hole);
    }
    for (const auto& line : feature.lines) look(feature, line);
  }
  if (odd == nullptr) return;
  report.warnings.push_back(featureInWords(*odd) + ": has coordinates that are not longitudes and latitudes of " +
                            nameOf(coastline.crs) + ": all are taken as metres in a plane");
  coastline.crs = {};
}

bool isMesh(const std::string& path) {
  try {
    return !readGrid(path).triangles.empty();
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

Coastline readInput(const InputOptions& options, ReadReport& report, BoundaryRules& boundaries, bool by_frame) {
  Coastline coastline;
  ReadFilter filter = options.filter;
  // A box is in the CRS of the first file. With `plane`, whether that is right shows in all coordinates.
  if (by_frame && options.files.size() == 1 && options.boundary_column.empty() && options.crs != "plane")
    filter.near = options.frame.box;
  filter.unsaid_in_plane = options.crs == "plane";
  try {
    coastline = readCoastline(
        sourcesOf(options), filter, report,
        [&](const std::vector<RawLayer>& layers) { boundaries.addInput(layers, options.boundary_column); },
        [&](const Crs& crs) { return snapDistanceOf(options, crs); });
  } catch (const NotVectorError& error) {
    if (!isMesh(error.file)) throw;
    throw InputError(sourceInWords(error.file) +
                     ": a mesh, not a coastline; convert, check, info and plot read meshes");
  }
  if (!options.boundary_column.empty() && !options.may_lack_column)
    boundaries.requireInputColumn(options.boundary_column);
  if (options.crs == "plane") forgetImpossibleCrs(coastline, report);
  return coastline;
}

void requireUnmirrored(const Coastline& coastline, const InputOptions& options) {
  if (coastline.crs.isPlane() || options.crs == "plane" || coastline.features.empty()) return;
  const Feature& first = coastline.features.front();
  const std::vector<Point>& points = !first.polygons.empty() ? first.polygons.front().outer
                                     : !first.lines.empty()  ? first.lines.front()
                                                             : first.points;
  if (points.empty()) return;
  const bool mirrored = mirrorsGround(coastline.crs, points.front());
  bool working_mirrored = false;
  if (options.crs != "auto") {
    const Crs working = parseWorkingCrs(options.crs);
    working_mirrored = mirrorsGround(working, Projection::to(coastline.crs, working).forward(points.front()));
  }
  if (mirrored == working_mirrored) return;
  if (working_mirrored)
    throw OptionError("--crs: " + options.crs + " mirrors the ground, and the mesh would be clockwise in the input's " +
                      nameOf(coastline.crs) + ": give " + unmirrored(parseWorkingCrs(options.crs)));
  throw InputError("the input's CRS " + nameOf(coastline.crs) +
                   " mirrors the ground: a mesh that is counter-clockwise on the ground would be clockwise in its "
                   "coordinates, which programs reject; bring the data to " +
                   unmirrored(coastline.crs) + " (ogr2ogr -t_srs)");
}

}  // namespace coastmesh
