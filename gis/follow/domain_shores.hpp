#pragma once

#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/size/plane_sizes.hpp"
#include "gis/clean/clean_report.hpp"
#include "gis/clean/domain.hpp"
#include "gis/geometry/box.hpp"
#include "gis/shore/shore_chains.hpp"
#include "gis/shore/shore_graph.hpp"

namespace coastmesh {

// Conversion of a domain to its shores, and back. Private to gis/follow.

// Sizes as lengths in a domain's plane, where shores are measured.
class SizesInPlane {
 public:
  SizesInPlane(const SizeFunction& size, const Domain& domain) : wanted_(&size) {
    const Surface surface = domain.projection.surface();
    if (!surface.isCurved()) return;
    Box box;
    for (const Point& p : domain.pslg.points) box.add(p);
    in_plane_.emplace(size, surface, Point{box.xmin, box.ymin}, Point{box.xmax, box.ymax});
  }

  const SizeFunction& get() const { return in_plane_ ? *in_plane_ : *wanted_; }

 private:
  const SizeFunction* wanted_;
  std::optional<PlaneSizes> in_plane_;
};

// Moves the graph out of the domain.
inline ShoreGraph takeGraph(Domain& domain) {
  ShoreGraph graph{std::move(domain.pslg), std::vector<VertexId>(domain.input_points.size())};
  std::iota(graph.source.begin(), graph.source.end(), VertexId{0});
  return graph;
}

// The domain of a changed graph. `before`: what `takeGraph` left of the original domain.
inline Domain domainOf(ShoreGraph&& graph, Domain&& before) {
  Domain made;
  made.projection = before.projection;
  made.coast = std::move(before.coast);
  made.frame = std::move(before.frame);
  made.resolution = before.resolution;
  made.lines = std::move(before.lines);
  std::vector<char> is_asked(before.input_points.size(), 0);
  for (const VertexId v : before.asked) is_asked[v] = 1;
  for (VertexId v = 0; v < graph.source.size(); ++v) {
    const VertexId source = graph.source[v];
    if (source != kNone && is_asked[source] != 0) made.asked.push_back(v);
    made.input_points.push_back(source != kNone ? before.input_points[source]
                                                : before.projection.inverse(graph.pslg.points[v]));
  }
  made.pslg = std::move(graph.pslg);
  return made;
}

// Adds changes to the report.
struct EditLog {
  const Domain& domain;
  const Coastline& coastline;
  CleanReport& report;

  void add(EditKind kind, const Point& place, RegionId water) const {
    addInput(kind, domain.projection.inverse(place), water);
  }
  // Skips vertices that following has made.
  void add(EditKind kind, const ShoreChains& chains, VertexId v) const {
    if (chains.source[v] != kNone) addInput(kind, domain.input_points[chains.source[v]], chains.leaving[v].left);
  }
  void addInput(EditKind kind, const Point& input, RegionId water) const {
    report.add(kind, input, coastline, static_cast<std::size_t>(water));
  }
};

}  // namespace coastmesh
