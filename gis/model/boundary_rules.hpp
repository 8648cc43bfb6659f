#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

struct RawLayer;

// The meaning of a column's text: land (shore, coast, wall, closed, solid, mainland, island), open (ocean, sea, tidal,
// level) and river (inflow, discharge, flow), case-insensitive, or a number: ADCIRC's IBTYPE, -1 for open. Throws
// InputError that starts with `what`.
BoundaryKind kindOfText(const std::string& text, const std::string& what);
// A text that means this kind.
std::string textOfKind(const BoundaryKind& kind);

// What polygons and lines define about boundaries: an edge whose midpoint is in a polygon, or that runs along a line
// (entirely within a fifth of its length), gets the type of the feature. If there are several, the last applies. Read
// once, since a stream can be read only once; then searched by place, for any number of grids, from several threads.
// Cheap to copy.
class BoundaryRules {
 public:
  // Those of a file, all of whose features have a type in `column` (empty: the first named type, role, boundary, ibtype
  // or kind). Throws InputError, with the columns that there are if it has none of that name.
  static BoundaryRules ofFile(const std::string& path, const std::string& column);

  // Adds those of one input, as it was read: features with a type in `column`, whose polygons define their own shore.
  // Of a file that `coastmesh clean` wrote with boundary types these alone count, for any column, even without one.
  // Throws InputError.
  void addInput(const std::vector<RawLayer>& layers, const std::string& column);

  // To be called after all inputs were added. Throws InputError, with the columns that there are, if none of them has
  // `column` or boundary types of its own.
  void requireInputColumn(const std::string& column) const;

  bool empty() const { return layers_.empty(); }

  // What they define about each of `edges`, which are pairs of `places` in `crs`; none where they define nothing.
  // `outer` says of each edge whether its loop goes round the mesh: polygons open no others, since they often happen to
  // contain islands; lines along islands are meant. `share`: which part each is of an edge, whose fifth is the distance
  // from lines; empty: all are whole edges.
  std::vector<std::optional<BoundaryKind>> kindsOf(const Crs& crs, const std::vector<Point>& places,
                                                   const std::vector<NodePair>& edges, const std::vector<bool>& outer,
                                                   const std::vector<double>& share = {}) const;

 private:
  class Layer;

  void add(const std::vector<RawLayer>& layers, const std::string& column, bool all_have_it);

  std::vector<std::shared_ptr<const Layer>> layers_;  // in their order; a later one takes precedence
  std::set<std::string> columns_of_input_;
  bool input_is_typed_ = false;  // a cleaned file defines its own boundary
};

}  // namespace coastmesh
