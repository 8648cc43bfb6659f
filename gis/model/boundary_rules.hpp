#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

struct EdgesToType;
struct RawLayer;

// The meaning of a column's text: land (shore, coast, wall, closed, solid, mainland, island), open (ocean, sea, tidal,
// level) and river (inflow, discharge, flow), case-insensitive, or a number: ADCIRC's IBTYPE, -1 for open. Throws
// InputError that starts with `what`.
BoundaryKind kindOfText(const std::string& text, const std::string& what);
// A text that `kindOfText` maps to this kind.
std::string textOfKind(const BoundaryKind& kind);

// An opening or river that a polygon or line defines, and that the mesh does not have.
struct MissedRule {
  std::uint32_t rule = 0;  // its number, the same for every mesh
  std::int64_t fid = 0;    // of the feature
  std::string name;        // of the feature; empty if it has none
  bool whole = false;      // no part of it is on the mesh's boundary
  bool inside = false;     // within the bounds of the mesh, or its frame
  Point place;             // the middle of what is missed, in the mesh's CRS
  std::size_t parts = 1;   // parts of a line, of which this is the longest
  // The corners of a polygon's box, in the mesh's CRS; none for a line.
  std::vector<Point> corners{};
};

// What rules say of the boundary's edges.
struct RuledEdges {
  std::vector<std::optional<BoundaryKind>> kinds;  // nullopt: no rule applies
  std::vector<std::uint32_t> rules;                // number of the rule that applies; kNone if none
  std::vector<MissedRule> missed;
};

class BoundaryLayer;

// Boundary types defined by polygons and lines: an edge whose midpoint is in a polygon, or that runs along a line
// (entirely within a fifth of its length), gets the type of the feature. If there are several, the last applies; lines
// of one type may continue each other within an edge. Polygons and lines of longitudes and latitudes continue past the
// antimeridian where an edge of more than 180 degrees jumps. The rules are read once, since a stream can be read only
// once; then they are searched by place, for any number of grids, from several threads. Cheap to copy.
class BoundaryRules {
 public:
  // The rules of a file, all of whose features have a type in `column` (empty: the first named type, role, boundary,
  // ibtype or kind). Throws InputError, listing the columns if none has that name.
  static BoundaryRules ofFile(const std::string& path, const std::string& column);

  // Adds the rules of one input, as it was read: features with a type in `column`; the type of a polygon is that of its
  // own shore. In a file that `coastmesh clean` wrote with boundary types only these count, for any column, even
  // without one. Throws InputError.
  void addInput(const std::vector<RawLayer>& layers, const std::string& column);

  // Call after all inputs are added. Throws InputError, listing the columns, if no input has `column` or boundary types
  // of its own.
  void requireInputColumn(const std::string& column) const;

  bool empty() const { return layers_.empty(); }

  // The kinds of `edges`, which are pairs of `places` in `crs`; nullopt for those without a rule. `outer` is true for
  // edges whose loop surrounds the mesh: polygons open no others, since they often contain islands by accident; lines
  // along islands are intended. `share` is the fraction that each is of an edge of the mesh, a fifth of which is the
  // distance allowed from lines; empty: all are whole edges.
  std::vector<std::optional<BoundaryKind>> kindsOf(const Crs& crs, std::span<const Point> places,
                                                   const std::vector<NodePair>& edges, const std::vector<bool>& outer,
                                                   const std::vector<double>& share = {}) const;

  // The same for a mesh that follows its shore only roughly, and lines drawn by hand. Lines also get edges that they
  // pass within half an element, if no other edge is closer. A polygon or line shorter than two elements that would get
  // none gets the one closest to its middle, if that is within an element. `missed` are openings and rivers without any
  // edge, and where lines leave walls in what they open. `before`: the types of edges without these rules, which may
  // be openings too; empty: unknown.
  RuledEdges roughKindsOf(const Crs& crs, std::span<const Point> places, const std::vector<NodePair>& edges,
                          const std::vector<bool>& outer, const std::vector<double>& share = {},
                          const std::vector<BoundaryKind>& before = {}, const ItemLoop& loop = inOrder) const;
  // The number of rules.
  std::size_t size() const;

 private:
  RuledEdges ruledEdges(const EdgesToType& edges, bool roughly, const ItemLoop& loop) const;
  void add(const std::vector<RawLayer>& layers, const std::string& column, bool all_have_it);

  std::vector<std::shared_ptr<const BoundaryLayer>> layers_;  // in their order; a later one takes precedence
  std::set<std::string> columns_of_input_;
  bool input_is_typed_ = false;  // a cleaned file defines its own boundary
};

}  // namespace coastmesh
