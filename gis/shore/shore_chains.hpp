#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "core/item_loop.hpp"
#include "core/size_function.hpp"
#include "gis/shore/even_sizes.hpp"
#include "gis/shore/shore_graph.hpp"

namespace coastmesh {

// The boundaries of a graph as chains with the water to their left, to take vertices out of and to move them. Private
// to gis.
struct ShoreChains {
  std::vector<Point> at;
  std::vector<VertexId> source;      // the domain's point that it is, or kNone
  std::vector<VertexId> next, prev;  // kNone: on no boundary (any more)
  std::vector<Segment> leaving;      // the boundary to the next vertex: its tag and labels
  std::vector<char> stays;           // ends, corners of open boundaries, ends of lines: neither taken out nor moved
  std::vector<char> open;            // between two segments of an open boundary
  std::vector<char> alive;           // a vertex of the graph still
  std::vector<double> size;          // wanted there
  std::vector<Segment> lines;        // what is no boundary
  // Ends of these, the lower first, in order.
  std::vector<std::pair<VertexId, VertexId>> line_ends{};
  // At each vertex, where that is more than half of the size: no segment is to be shorter, and water wider by some.
  // Empty: the size alone says it.
  std::vector<double> least{};
  bool no_square_ends = false;  // ends of water about as wide as the size are to be pointed or round
};

// Called before a vertex is taken out, and before it is moved to a place.
using ShoreLoss = std::function<void(VertexId)>;
using ShoreMove = std::function<void(VertexId, const Point&)>;

// `even`: the same sizes, where they are such.
ShoreChains chainsOf(ShoreGraph&& graph, const SizeFunction& size, const ItemLoop& loop = inOrder,
                     const EvenSizes* even = nullptr);
ShoreGraph graphOf(ShoreChains&& chains);

// The angle on the water's side on the way a, b, c with the water to the left: 0 to two pi.
double waterAngle(const Point& a, const Point& b, const Point& c);

// Whether v may go and its neighbours be joined: a boundary or a line that joins them already would run twice.
bool canTakeOut(const ShoreChains& chains, VertexId v);

// Takes out vertices that are none of the domain's and lie on the straight way between their neighbours: those that
// shores were cut at for a while.
void dropSamples(ShoreChains& chains);

// REQUIRES: its neighbours are dropped too, or joined.
void drop(ShoreChains& chains, VertexId v);

// A new vertex at x between v and the next, where that size is wanted. REQUIRES: no open boundary leaves v.
VertexId cutAfter(ShoreChains& chains, VertexId v, const Point& x, double size);

// Joins the neighbours of v. REQUIRES: they are not joined.
void takeOut(ShoreChains& chains, VertexId v);

}  // namespace coastmesh
