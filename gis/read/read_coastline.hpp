#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/coast/snap_distance.hpp"
#include "gis/read/read_report.hpp"
#include "gis/read/source.hpp"

namespace coastmesh {

struct RawLayer;

// Gets the layers of a source as they are in the file, in their own CRS, including those of FeatureUse::Boundary.
using SeeLayers = std::function<void(const std::vector<RawLayer>& layers)>;

// The distance within which ends of lines are joined, for an input in this CRS.
using SnapIn = std::function<SnapDistance(const Crs& crs)>;

// Reads every vector layer of every source that OGR opens, in their order. Z and M are dropped, curves become straight
// pieces. A file that is one bare geometry (such as a GeoJSON GeometryCollection) becomes one feature per polygon,
// numbered from 0. Lines are joined end to end over all sources, across gaps too if `snap_in` is
// given (see `joinAcrossGaps`), with a note: closed ones become polygons by
// even-odd nesting, each a feature with the name and attributes of the first line in it, open ones become features with
// a line; they come after all polygons. Sources in another CRS than the first are transformed to its CRS; if all are in
// one CRS, coordinates stay bit for bit. A source without a CRS is assumed to be in that of the first; a first one
// without a CRS is assumed to be WGS 84 if all its coordinates are within ±180, ±90, otherwise a plane. Both cause a
// warning. Throws InputError: no such file, empty file, not a vector file, no polygon or line in it, a coordinate that
// is not finite or out of range (with feature and vertex), incompatible CRS, a layer or field that does not exist.
// Sources of another use than Area provide their polygons (Frame, Region), lines (Weir) or lines and points
// (Constraint); closed lines are polygons of a frame. `see_areas` is called with the layers of each source with
// FeatureUse::Area, which may define boundary types too: a stream cannot be read a second time.
Coastline readCoastline(const std::vector<Source>& sources, const ReadFilter& filter, ReadReport& report,
                        const SeeLayers& see_areas = {}, const SnapIn& snap_in = {});
Coastline readCoastline(const std::vector<std::string>& sources, ReadReport& report);

}  // namespace coastmesh
