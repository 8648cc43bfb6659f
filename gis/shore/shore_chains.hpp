#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "core/item_loop.hpp"
#include "core/size_function.hpp"
#include "gis/shore/even_sizes.hpp"
#include "gis/shore/shore_frame.hpp"
#include "gis/shore/shore_graph.hpp"

namespace coastmesh {

// The boundaries of a graph as chains with the water to their left, for removing and moving vertices. Private to gis.
struct ShoreChains {
  std::vector<Point> at;
  std::vector<VertexId> source;      // index of the domain's point, or kNone
  std::vector<VertexId> next, prev;  // kNone: on no boundary, or removed from it
  std::vector<Segment> leaving;      // segment to the next vertex: its tag and labels
  // Neither removed nor moved: ends, corners of open boundaries, ends of lines, requested vertices.
  std::vector<char> stays;
  std::vector<char> open;      // between two segments of an open boundary
  std::vector<char> alive;     // not removed
  std::vector<double> size;    // wanted there
  std::vector<Segment> lines;  // all other segments, such as boundaries where the graph touches itself
  // Their ends, the lower first, sorted.
  std::vector<std::pair<VertexId, VertexId>> line_ends{};
  // At each vertex, the least length of segments if more than half the size; water is kept wider than it by some.
  // Empty: only sizes count.
  std::vector<double> least{};
  ShoreFrame frame{};           // vertices do not move across its sides
  bool no_square_ends = false;  // makes ends of water about as wide as the size pointed or round
};

// Called before a vertex is removed, and before it is moved to a point.
using ShoreLoss = std::function<void(VertexId)>;
using ShoreMove = std::function<void(VertexId, const Point&)>;

// `even`: the same sizes if they grow evenly, else null.
ShoreChains chainsOf(ShoreGraph&& graph, const SizeFunction& size, const ItemLoop& loop = inOrder,
                     const EvenSizes* even = nullptr);
ShoreGraph graphOf(ShoreChains&& chains);

// Sets `stays` of vertices that the user requested. `asked`: their sources.
void keepAsked(ShoreChains& chains, const std::vector<VertexId>& asked);

// The angle on the water's side at b, with the water to the left of the way a, b, c: 0 to 2 pi.
double waterAngle(const Point& a, const Point& b, const Point& c);

// True if moving v to x would take it out of the frame. REQUIRES: v has both neighbours.
bool leavesFrame(const ShoreChains& chains, VertexId v, const Point& x);

// True if v may be removed and its neighbours joined: not if they are joined already, by a boundary or a line.
bool canTakeOut(const ShoreChains& chains, VertexId v);

// Removes vertices that are not the domain's and lie on the straight line between their neighbours: temporary cuts of
// shores.
void dropSamples(ShoreChains& chains);

// Removes v without joining its neighbours. REQUIRES: they are dropped too, or joined.
void drop(ShoreChains& chains, VertexId v);

// Adds a vertex of this size at x between v and the next one. REQUIRES: no open boundary leaves v.
VertexId cutAfter(ShoreChains& chains, VertexId v, const Point& x, double size);

// Removes v and joins its neighbours. REQUIRES: these are not joined yet.
void takeOut(ShoreChains& chains, VertexId v);

}  // namespace coastmesh
