#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/point.hpp"
#include "gis/crs/crs.hpp"

namespace coastmesh {

// A closed chain of points; the first is not repeated at the end. Either orientation.
using Ring = std::vector<Point>;

struct Polygon {
  Ring outer;
  std::vector<Ring> holes;
};

// What a feature is for.
enum class FeatureUse {
  Area,        // its inside is meshed; its open lines are constraints
  Land,        // its inside is left out of the frame's water
  Coast,       // its rings and lines part water from land within the frame
  Frame,       // nothing outside of it is meshed; where it runs through water, the boundary is open
  Constraint,  // lines and points that become edges and vertices where they lie in water
  Weir,        // the same for lines that are weirs
  Region,      // polygons that give the triangles in them a region
  Open,        // lines: where they run along the boundary, open water goes on beyond
  Boundary,    // lines along the boundary that say the types of its parts, and nothing else
};

// One feature of a vector layer.
struct Feature {
  std::int64_t fid = 0;
  std::string source;  // "file" or "file|layer", as errors name it
  std::vector<Polygon> polygons;
  std::vector<std::vector<Point>> lines;                        // open chains, of line features that closed no ring
  std::vector<std::pair<std::string, std::string>> attributes;  // name, value as text; nulls are left out
  FeatureUse use = FeatureUse::Area;
  bool from_lines = false;    // its rings were made of lines
  bool clipped = false;       // far-off parts of it were cut off, or longitudes jump: its rings' sides say nothing
  std::string region;         // of a meshed part: the region it lies in
  std::vector<Point> points;  // of a constraint: vertices to be
  std::vector<Point> vertex_order;  // of a cleaned part: vertices as they were numbered, those of other features too
};

// What was read, in the input's own CRS and with its own coordinates, nothing mended yet.
struct Coastline {
  std::vector<Feature> features;
  Crs crs;
  std::optional<Point> water_at;  // a place in the water: what crosses no shore from there is meshed, and nothing else
  bool framed_by_box = false;     // its Frame was given as a box
  // All of the globe is meshed: the feature, without any shape, that holds what no other holds.
  std::optional<std::size_t> rest;
};

}  // namespace coastmesh
