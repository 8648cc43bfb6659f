#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gis/coastline.hpp"

namespace coastmesh {

// An edit that a file says was made when it was cleaned.
struct EarlierEdit {
  std::string kind;
  Point place;
  std::int64_t fid = 0;
};

struct ReadReport {
  std::uint64_t features = 0;        // in the coastline
  std::uint64_t points = 0;          // coordinates, as the files count them
  std::uint64_t rings = 0;           // of polygons, those made of lines included
  std::uint64_t skipped_empty = 0;   // features without a geometry, or with an empty one
  std::uint64_t skipped_points = 0;  // point geometries: nothing to mesh in them
  std::uint64_t filtered = 0;        // features that a filter of the user's left out
  std::uint64_t beyond_frame = 0;    // features that lie wholly outside of the frame
  std::uint64_t unclosed_rings = 0;  // rings of polygons whose last point is not the first: closed
  bool cleaned = false;              // a source was written by `coastmesh clean`
  bool boundary_types = false;       // and tells types of boundaries: see FeatureUse::Boundary
  std::vector<EarlierEdit> edits;
  std::vector<std::string> warnings;
  std::vector<std::string> notes;  // what was decided where the input left a choice
};

// A source, and what its features are for.
struct Source {
  // What OGR opens: a file, "file|layer", a folder, a URL, "/vsizip/…"; a .zip, .gz or .tar is looked into, and "-" is
  // standard input.
  std::string path;
  FeatureUse use = FeatureUse::Area;
};

// Which features of the sources with FeatureUse::Area are read.
struct ReadFilter {
  std::vector<std::string> layers;  // only layers of these names; empty: all
  std::string where;                // only features for which this SQL condition holds; empty: all
};

// Reads every vector layer of every source that OGR opens, in their order. Z and M are dropped, curves become straight
// pieces. A file that is one bare geometry (a GeoJSON GeometryCollection, say) is taken apart into a feature a polygon,
// numbered from 0.
// Lines are joined end to end over all sources (see `joinLines`): closed ones become polygons by even-odd nesting, each
// a feature with the name and attributes of the first line in it, open ones become features with a line; they come
// after all polygons.
// Sources in another CRS than the first are brought to its CRS; where all are in one CRS, coordinates stay bit for bit.
// A source without a CRS is taken to be in that of the first; a first one without a CRS is taken for WGS 84 where all
// its coordinates lie within ±180, ±90, else for a plane. Either is warned of.
// Throws InputError: no such file, empty file, no vector file, no polygon or line in it, a coordinate that is not
// finite (with feature and vertex), CRS that do not go together, a layer or field that is not there.
// Sources of another use than Area give their polygons (Frame, Region), lines (Weir) or lines and points (Constraint);
// closed lines are polygons of a frame.
Coastline readCoastline(const std::vector<Source>& sources, const ReadFilter& filter, ReadReport& report);
Coastline readCoastline(const std::vector<std::string>& sources, ReadReport& report);

// Features that touch, cross or contain one another have to be meshed as one; one that lies in a hole of another does
// not. Water between land and a frame is one whatever lies in it; frames, constraints and regions belong to each group
// that their extent meets. Every feature is in one group; members ascend, groups are ordered by their first member. Longitudes are taken as
// given, but where they span exactly 360 degrees, the first and the last meridian are one. Cost O(n log n) for features that lie apart.
std::vector<std::vector<std::size_t>> groupFeatures(const Coastline& coastline);

}  // namespace coastmesh
