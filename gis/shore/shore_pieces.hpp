#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/shore/shore_chains.hpp"

namespace coastmesh {

inline constexpr double kSmallShoreAngle = toRadians(50.0);  // on the water's side; smaller ones make bad triangles

// Finds what lies near a vertex's piece of shore (the vertex and its two neighbours), to judge where the vertex may be
// moved. Copies share the trees, so that each thread can gather with its own copy.
class ShorePieces {
 public:
  explicit ShorePieces(const ShoreChains& chains) : c_(chains) {}

  // Builds the trees of the present shore: again after many vertices have moved.
  void buildTrees(const ItemLoop& loop = inOrder);
  // The same, at less cost. REQUIRES: since `buildTrees`, vertices of boundaries were only moved or taken out.
  void renewTrees(const ItemLoop& loop = inOrder);

  // Collects what may affect v's piece if v moves by at most `reach` times the size; the methods below use it.
  // REQUIRES: v has both neighbours; `buildTrees`, and `reach` includes any movement of vertices since.
  void gather(VertexId v, double reach);
  const std::vector<VertexId>& points() const { return points_; }

  // The quality of v's piece with v at x, or removed if x is nullopt: the worst of its lengths, and of the water's
  // angles and widths, each as a share of what is wanted, at most 1. REQUIRES: `gather`.
  double qualityOf(VertexId v, const std::optional<Point>& x) const;

  // True only if `qualityOf` v's present place is 1; false for a few such vertices. Costs a fraction of `gather` and
  // `qualityOf`. REQUIRES: `buildTrees`, and no moves since.
  bool isFine(VertexId v) const;

  // True if moving v to x makes nothing cross, and nothing lies between the old and the new piece. Ignores `but` and
  // what ends there.
  bool canMove(VertexId v, const Point& x, VertexId but = kNone) const;

  // True if nothing lies between v and the segment that would replace it.
  bool canCut(VertexId v) const;

  // The distance of v's piece, with v at x, from the rest of the shore that was gathered, across land or water, not
  // counting the two segments next to it. Infinite if there is none.
  double apart(VertexId v, const Point& x) const;

 private:
  // The least length of segments at v, and the least width of water.
  double shortestAt(VertexId v) const;
  double narrowestAt(VertexId v) const;
  // The quality of square ends of water: of v's piece as in `qualityOf`, with its next neighbours, up to five points.
  double qualityOfEnds(VertexId v, const std::optional<Point>& x) const;

  struct Trees {
    std::vector<std::pair<VertexId, VertexId>> ends;
    std::vector<VertexId> loose;  // vertices of no segment
    std::size_t at_lines = 0;     // the first of the `ends` that are those of `lines`
    BoxTree points, segments;     // of `loose`, and of the segments between `ends`
  };

  const ShoreChains& c_;
  std::shared_ptr<Trees> trees_;
  std::vector<VertexId> points_;
  std::vector<std::pair<VertexId, VertexId>> segments_;
};

}  // namespace coastmesh
