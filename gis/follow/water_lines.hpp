#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "gis/follow/shore_sizes.hpp"
#include "gis/shore/asked_points.hpp"
#include "gis/shore/shore_graph.hpp"

namespace coastmesh {

// Lines and points in the water of a graph, set aside because the width of water does not depend on them.
struct WaterLines {
  std::vector<Point> at;
  std::vector<VertexId> source;   // of each point, as in a graph
  std::vector<char> stays;        // of each point: requested by the user, not only as part of a line
  std::vector<Segment> segments;  // between these points
  std::vector<VertexId> loose;    // points on no segment
  std::vector<VertexId> shore;    // of each point: its vertex of the graph, or kNone
  std::size_t bridges = 0;        // number of segments on land, the last ones
};

// Moves segments with the same water on both sides, and points on no other segment, out of the graph. `asked`: sources
// of points requested as vertices.
WaterLines takeLines(ShoreGraph& graph, const std::vector<VertexId>& asked = {});

// Adds requested points that are on no segment.
void addLoose(WaterLines& lines, const std::vector<AskedPoint>& points);

// Joins ends of a line across land narrower than an element by bridges, in case that land is removed. `shores`: as left
// by `takeLines`. Returns the other vertices of the shore where lines end: land must stay there.
std::vector<VertexId> bridgeLand(const ShoreGraph& shores, WaterLines& lines, const SizeFunction& size);

// Lines and points that are left out.
struct LostLines {
  struct Part {
    double length_m = 0.0;  // on the ground
    double elements = 0.0;  // the same as a multiple of the sizes there
    Point first;            // middle of the first lost piece
  };
  std::map<std::int32_t, Part> lines;  // by their tag
  std::vector<Point> points;
};

// Adds the requested points that are not in it.
void addLost(LostLines& lost, const std::vector<AskedPoint>& points);

// Puts lines and points back into a graph whose shores may have changed, as elements of these sizes can follow them.
// Lines end where they now meet a shore, in a new vertex unless one is near. Leaves out what is not in water, and lines
// that are nowhere farther from shores than 0.4 of the size (times `channel_min` if below 1); adds it to `lost`. A line
// that nears the shore slowly is led straight to it from that distance. Pieces become about as long as the size
// (`coarsenLines`).
void returnLines(ShoreGraph& graph, WaterLines&& lines, const ShoreSizes& sizes, double channel_min, LostLines& lost);

}  // namespace coastmesh
