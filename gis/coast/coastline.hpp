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
  std::vector<bool> cut = {};  // the outer ring, then the holes: parts of it were cut off; empty if of none

  bool isOuterCut() const { return !cut.empty() && cut.front(); }
  bool isHoleCut(std::size_t hole) const { return !cut.empty() && cut[hole + 1]; }
};

// The purpose of a feature.
enum class FeatureUse {
  Area,        // its inside is meshed; its open lines are constraints
  Land,        // its inside is excluded from the frame's water
  Coast,       // its rings and lines separate water from land within the frame
  Frame,       // nothing outside it is meshed; where it crosses water, the boundary is open
  Constraint,  // lines and points that become edges and vertices where they are in water
  Weir,        // the same for lines that are weirs
  Region,      // polygons that assign a region to the triangles inside
  Open,        // lines: where they run along the boundary, it is open
  Boundary,    // lines along the boundary that only define the types of its parts
};

// One feature of a vector layer.
struct Feature {
  std::int64_t fid = 0;
  std::string source;  // "file" or "file|layer", as errors name it
  std::vector<Polygon> polygons;
  std::vector<std::vector<Point>> lines;                        // open chains: lines that close no ring
  std::vector<std::pair<std::string, std::string>> attributes;  // name, value as text; nulls are omitted
  FeatureUse use = FeatureUse::Area;
  bool from_lines = false;          // its rings were made of lines
  bool clipped = false;             // distant parts were cut off, or longitudes jump: area and nesting of rings unknown
  std::string region;               // of a meshed part: name of its region
  std::vector<Point> points;        // of a constraint: points that become vertices
  std::vector<Point> vertex_order;  // of a cleaned file: vertices by number, including those of other features
};

// The input as read, in its own CRS and coordinates, not repaired yet.
struct Coastline {
  std::vector<Feature> features;
  Crs crs;
  std::optional<Point> water_at;  // a point in the water: its side of the coasts is meshed
  bool framed_by_box = false;     // its Frame was given as a box
  // If the whole globe is meshed: a feature without a shape, for everything outside the others.
  std::optional<std::size_t> rest{};
};

}  // namespace coastmesh
