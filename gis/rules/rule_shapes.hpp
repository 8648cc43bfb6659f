#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/crs/crs.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/rules/area_search.hpp"
#include "gis/rules/rule_plane.hpp"

namespace coastmesh {

enum class RuleForm {
  Area,  // a polygon: edges whose middle is in it
  Line,  // edges along it
  Shore  // edges along a polygon's own shore
};

// What one polygon or line says of the boundary.
struct BoundaryRule {
  BoundaryKind kind;
  RuleForm form = RuleForm::Area;
  std::int64_t fid = 0;
  std::string name{};  // of the feature; empty if it has none

  // True for types that are nowhere unless they are asked for.
  bool opens() const { return isOpening(kind); }
};

// An edge of the boundary in a layer's CRS.
struct PlacedEdge {
  Point a, b;
  double length = 0.0;   // in the layer's units, as `RulePlane` measures
  double element = 0.0;  // length of the mesh edge that it is a piece of
  bool outer = false;    // its loop surrounds the mesh

  Point middle() const { return at(0.5); }
  Point at(double share) const { return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)}; }
};

// The shapes of a layer's rules, searchable.
class RuleShapes {
 public:
  struct Near {  // a rule with a line near a place
    std::size_t rule = 0;
    BoundaryKind kind;
  };

  void addArea(std::size_t rule, Polygon polygon);
  void addLine(std::size_t rule, const std::vector<Point>& line, bool closed);
  // Call after the last is added.
  void build();

  // The last rule whose lines run along the edge; nullopt if none does.
  std::optional<std::size_t> lastAlong(const PlacedEdge& edge, const std::vector<BoundaryRule>& rules,
                                       const RulePlane& plane) const;
  // The last rule with an area around `edge`'s middle. `used` gets those that have one.
  std::optional<std::size_t> lastAround(const PlacedEdge& edge, const std::vector<BoundaryRule>& rules,
                                        const RulePlane& plane, std::vector<bool>& used) const;
  // True if a line, or an area smaller than `most` across, may come within `reach` of the edge.
  bool anyNear(const PlacedEdge& edge, double reach, double most, const RulePlane& plane) const;

  // The points of a rule's line; a ring repeats its first. Empty for an area.
  std::vector<Point> lineOf(std::size_t rule) const;
  // The box of an area's rule.
  Box boxOf(std::size_t rule) const;

 private:
  struct Area {
    std::size_t rule = 0;
    AreaSearch area;
  };
  struct Piece {  // of a line
    std::size_t rule = 0;
    Point a, b;
  };

  std::vector<std::size_t> rulesNear(const Point& p, double far, const RulePlane& plane) const;

  std::vector<Area> areas_;
  std::vector<Piece> pieces_;  // by rule
  BoxTree area_tree_, piece_tree_;
};

}  // namespace coastmesh
