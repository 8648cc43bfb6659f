#include "gis/clean/domain_of_edges.hpp"

#include <utility>
#include <vector>

namespace coastmesh {

Domain domainOf(const CleanVertices& vertices, LabelledEdges&& edges, const Projection& projection,
                const Resolution& resolution) {
  std::vector<Segment>& segments = edges.segments;
  Domain domain;
  domain.projection = projection;
  domain.resolution = resolution;
  std::vector<VertexId> renumbered(vertices.plane.size(), kNone);
  for (const Segment& s : segments) renumbered[s.a] = renumbered[s.b] = 0;
  for (const VertexId v : edges.points) renumbered[v] = 0;
  for (VertexId v = 0; v < renumbered.size(); ++v) {
    if (renumbered[v] == kNone) continue;
    renumbered[v] = static_cast<VertexId>(domain.pslg.points.size());
    domain.pslg.points.push_back(vertices.plane[v]);
    domain.input_points.push_back(vertices.input[v]);
  }
  for (Segment& s : segments) s.a = renumbered[s.a], s.b = renumbered[s.b];
  for (const VertexId v : edges.asked)
    if (renumbered[v] != kNone) domain.asked.push_back(renumbered[v]);
  domain.pslg.segments = std::move(segments);
  domain.lines = std::move(edges.lines);
  return domain;
}

}  // namespace coastmesh
