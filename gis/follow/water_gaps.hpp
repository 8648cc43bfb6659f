#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/follow/shore_triangles.hpp"
#include "gis/shore/data_shores.hpp"

namespace coastmesh {

// The data: their shores, and the triangles between what thinning leaves of these, before land is opened.
struct ShoreData {
  const ShoreTriangles& triangles;
  const DataShores& shores;
};

// The narrowest place of a way through the water.
struct NarrowPlace {
  ShoreGap gap{std::numeric_limits<double>::infinity(), {}};  // in the plane
  double share = std::numeric_limits<double>::infinity();     // its width over the size there
  std::vector<EdgeRef> too_narrow;                            // all edges with smaller shares than asked for
};

// The width of the water in the data, across edges between its shores.
class WaterGaps {
 public:
  // `narrowest`: the width of water that stays open, in sizes.
  WaterGaps(const ShoreData& data, double narrowest, const ItemLoop& loop = inOrder);

  const ShoreTriangles& triangles() const { return t_; }
  double narrowestOpen() const { return narrowest_; }

  // The width over the size there, between shores as thinned. Infinite at borders of regions in the water, where the
  // width is unknown.
  double share(EdgeRef e) const;
  // True in water if the share is below the narrowest.
  bool isNarrow(EdgeRef e) const { return narrow_[e] >= 0.0; }
  // The smaller of both triangles' sizes: one may reach far into open water, where sizes are larger.
  double sizeAt(EdgeRef e) const;

  // For each way, the narrowest place that it passes, between shores as in the data: of channels beside islands, the
  // widest counts, unless the islands take hardly any of the width. A way is the edges that it crosses, from its end.
  // `least`: smaller shares are too narrow.
  std::vector<NarrowPlace> narrowest(const std::vector<std::vector<EdgeRef>>& ways, double least = 0.0) const;

 private:
  // Thinned shore between vertices of the data, with the water to its left.
  using Run = std::pair<VertexId, VertexId>;
  using Lines = std::map<Run, std::vector<Point>>;
  using Islands = DataShores::Islands;
  // The least gaps on a way between islands, by their numbers, and between these and the shores on both sides.
  using Channels = std::map<std::pair<std::size_t, std::size_t>, ShoreGap>;
  struct Measured {
    EdgeRef edge;
    std::vector<std::size_t> row;  // islands across it, with both sides
  };

  const TriMesh& mesh() const { return t_.mesh; }
  bool isBelowNarrowest(EdgeRef e) const;
  double measured(EdgeRef e) const;
  bool isShore(EdgeRef e) const;
  template <typename Visit>
  void forShoreAt(VertexId v, Visit&& visit) const;
  VertexId follow(VertexId v, bool ahead) const;
  Run runOf(EdgeRef shore) const;
  std::vector<Run> runsAt(VertexId v) const;
  double leastTo(VertexId v, VertexId from) const;
  std::vector<std::vector<Measured>> measuredOf(const std::vector<std::vector<EdgeRef>>& ways, Islands& islands) const;
  bool isOn(VertexId v, const std::vector<Point>& island) const;
  std::vector<std::size_t> rowAcross(EdgeRef e, const std::vector<std::size_t>& across, const Islands& islands) const;
  Lines linesOf(const std::vector<std::vector<Measured>>& ways) const;
  ShoreGap gapAt(EdgeRef e, const Lines& lines) const;
  void addChannels(const Measured& at, const Lines& lines, const Islands& islands, Channels& channels) const;

  const ShoreTriangles& t_;
  const DataShores& shores_;
  double narrowest_;
  std::vector<double> narrow_;  // by edge: its share if narrow, else negative
};

}  // namespace coastmesh
