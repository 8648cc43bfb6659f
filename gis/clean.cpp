#include "gis/clean.hpp"

#include <cassert>

#include "gis/clean_faces.hpp"
#include "gis/clean_simplify.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

std::string namesOf(const Coastline& coastline, const std::vector<std::size_t>& members) {
  if (members.empty()) return "no feature";
  const Feature& first = coastline.features[members.front()];
  std::string names = first.source + ", feature " + std::to_string(first.fid);
  if (members.size() > 1) names += " and " + std::to_string(members.size() - 1) + " that touch it";
  return names;
}

void refuseEmpty(const Coastline& coastline, const std::vector<std::size_t>& members,
                 const std::vector<Segment>& segments) {
  for (const Segment& segment : segments) {
    if (segment.left >= 0 || segment.right >= 0) return;
  }
  bool has_polygon = false;
  for (const std::size_t member : members) has_polygon |= !coastline.features[member].polygons.empty();
  throw InputError(namesOf(coastline, members) + ": " +
                   (has_polygon ? "the polygons enclose no area"
                                : "the lines close no ring, so there is nothing to mesh: join their ends bit for bit"));
}

// Only the vertices that segments use, in their order.
Domain compact(const CleanVertices& vertices, std::vector<Segment> segments, const Projection& projection) {
  Domain domain;
  domain.projection = projection;
  std::vector<VertexId> renumbered(vertices.plane.size(), kNone);
  for (const Segment& s : segments) renumbered[s.a] = renumbered[s.b] = 0;
  for (VertexId v = 0; v < renumbered.size(); ++v) {
    if (renumbered[v] == kNone) continue;
    renumbered[v] = static_cast<VertexId>(domain.pslg.points.size());
    domain.pslg.points.push_back(vertices.plane[v]);
    domain.input_points.push_back(vertices.input[v]);
  }
  for (Segment& s : segments) s.a = renumbered[s.a], s.b = renumbered[s.b];
  domain.pslg.segments = std::move(segments);
  return domain;
}

}  // namespace

std::string_view toString(EditKind kind) {
  switch (kind) {
    case EditKind::RepeatedPoint:
      return "repeated point";
    case EditKind::Spike:
      return "spike";
    case EditKind::SelfCrossing:
      return "self-crossing";
    case EditKind::FeaturesCross:
      return "features cross";
    case EditKind::TouchingRing:
      return "touching ring";
    case EditKind::OverlappingEdge:
      return "overlapping edge";
    case EditKind::DegenerateRing:
      return "degenerate ring";
    case EditKind::SmallIsland:
      return "small island";
    case EditKind::SimplifiedPoint:
      return "simplified point";
    case EditKind::FeaturesOverlap:
      return "features overlap";
    case EditKind::MisplacedRing:
      return "misplaced ring";
  }
  assert(false);
  return "";
}

Domain cleanFeatures(const Coastline& coastline, const std::vector<std::size_t>& members, const Projection& projection,
                     const CleanOptions& options, CleanReport& report) {
  CleanChains chains = makeChains(coastline, members, projection, options, report);
  const NodedEdges edges = nodeChains(chains, coastline, projection, report);
  std::vector<Segment> segments = labelFaces(chains, edges, coastline, report);
  refuseEmpty(coastline, members, segments);
  if (options.simplify_m > 0) {
    segments = simplifyEdges(chains.vertices, segments, coastline, projection, options.simplify_m, report);
  }
  return compact(chains.vertices, std::move(segments), projection);
}

}  // namespace coastmesh
