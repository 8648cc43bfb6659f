#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/shore/shore_chains.hpp"

namespace coastmesh {

inline constexpr double kSmallShoreAngle = toRadians(50.0);  // on the water's side: smaller ones make bad triangles

// What lies near a vertex's piece of shore (the vertex and its two neighbours), to judge a place that it may be moved
// to.
// Copies share what was built, so that each thread may gather on its own.
class ShorePieces {
 public:
  explicit ShorePieces(const ShoreChains& chains) : c_(chains) {}

  // After many vertices were moved.
  void buildTrees();

  // Finds what is near enough to v's piece to matter, if v goes no further than `reach` times the size. What follows
  // looks at that. REQUIRES: v has both neighbours; `buildTrees`, since when no vertex has moved further than what
  // `reach` leaves.
  void gather(VertexId v, double reach);
  const std::vector<VertexId>& points() const { return points_; }

  // The worst of what v's piece takes part in, 1 where all is as wanted, with v at x or taken out: lengths, angles of
  // the water, widths of the water.
  double qualityOf(VertexId v, const std::optional<Point>& x) const;

  // True only where `qualityOf` v's place is 1: found for most such vertices without `gather`, at a share of its cost.
  // REQUIRES: `buildTrees`, since when nothing was moved.
  bool isFine(VertexId v) const;

  // Whether nothing crosses then, nor lies between the piece as it is and as it would be; `but` and what ends there do
  // not matter.
  bool canMove(VertexId v, const Point& x, VertexId but = kNone) const;

  // Whether nothing lies between v and the segment that would replace it.
  bool canCut(VertexId v) const;

  // How near the rest of the shore then is, by land or by water: what is gathered of it, save the two pieces beside v's
  // own. Infinite where there is none.
  double apart(VertexId v, const Point& x) const;

 private:
  // What a segment at v is to be no shorter than, and water no narrower.
  double shortestAt(VertexId v) const;
  double narrowestAt(VertexId v) const;
  // v's piece with v at x or taken out, and its neighbours beyond: up to five places in a row.
  double qualityOfEnds(VertexId v, const std::optional<Point>& x) const;

  struct Trees {
    std::vector<std::pair<VertexId, VertexId>> ends;
    std::vector<VertexId> loose;  // ends of nothing
    BoxTree points, segments;     // of `loose` and of what leads from end to end
  };

  const ShoreChains& c_;
  std::shared_ptr<const Trees> trees_;
  std::vector<VertexId> points_;
  std::vector<std::pair<VertexId, VertexId>> segments_;
};

}  // namespace coastmesh
