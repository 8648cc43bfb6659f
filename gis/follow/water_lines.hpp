#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "gis/follow/shore_sizes.hpp"
#include "gis/shore/shore_graph.hpp"

namespace coastmesh {

// Lines and points of a graph that lie in its water, set aside: how wide water is does not depend on them.
struct WaterLines {
  std::vector<Point> at;
  std::vector<VertexId> source;   // of each point, as in a graph
  std::vector<char> stays;        // of each point: it is asked for, and not only as part of a line
  std::vector<Segment> segments;  // between these points
  std::vector<VertexId> loose;    // points that are on none
  std::vector<VertexId> shore;    // of each point: the vertex of the graph that it is too, or kNone
  std::size_t bridges = 0;        // so many of the segments, the last, lie on land
};

// Takes out of the graph segments that have the same water on both sides, and points on no other. `asked`: the sources
// of those that are asked for as vertices.
WaterLines takeLines(ShoreGraph& graph, const std::vector<VertexId>& asked = {});

// Joins ends of a line on both sides of land narrower than an element, in case that this goes: bridges. `shores`: as
// `takeLines` left it. Other vertices of the shore where lines end are returned: land has to stay there.
std::vector<VertexId> bridgeLand(const ShoreGraph& shores, WaterLines& lines, const SizeFunction& size);

// What is left out of lines and points.
struct LostLines {
  struct Part {
    double length_m = 0.0;  // on the ground
    double elements = 0.0;  // the same as a multiple of the sizes there
    Point first;            // a place of it
  };
  std::map<std::int32_t, Part> lines;  // by their tag
  std::vector<Point> points;
};

// Puts them into a graph whose shores may have changed, as elements of these sizes can follow them. Lines end where
// they meet a shore now, in a vertex that is made for them where none is near. What does not lie in water is left out,
// and what is not off its shores by 0.4 of the size anywhere, or of `channel_min` times that. Where a line nears the
// shore slowly it turns to it that far off. Pieces get about as long as the size (`coarsenLines`). What is left out is
// added to `lost`.
void returnLines(ShoreGraph& graph, WaterLines&& lines, const ShoreSizes& sizes, double channel_min, LostLines& lost);

}  // namespace coastmesh
