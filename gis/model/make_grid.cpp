#include "gis/model/make_grid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "core/bulk_list.hpp"
#include "core/quality.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/crs/longitude_range.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/grid/loop_role.hpp"
#include "gis/projection/smooth_table.hpp"

namespace coastmesh {
namespace {

// The index in the grid of each used point of a mesh, kNone for unused ones.
struct NodeIndices {
  BulkList<std::uint32_t> of;
  std::uint32_t end = 0;  // one past the last
};

NodeIndices nodeIndices(const TriMesh& mesh, std::uint32_t next, const ItemLoop& loop) {
  struct Stretch {
    std::size_t first, last;
    std::uint32_t used;  // the number of used points, then the index of the first
  };
  const BulkList<std::uint8_t> used = usedVertices(mesh, loop);
  std::vector<Stretch> stretches = overStretches(loop, used.size(), [&](std::size_t first, std::size_t last) {
    const auto begin = used.begin() + static_cast<std::ptrdiff_t>(first);
    const auto count = std::count(begin, begin + static_cast<std::ptrdiff_t>(last - first), std::uint8_t{1});
    return Stretch{first, last, static_cast<std::uint32_t>(count)};
  });
  for (Stretch& stretch : stretches) next += std::exchange(stretch.used, next);
  NodeIndices indices;
  resizeAnew(loop, indices.of, used.size());
  loop(stretches.size(), [&](std::size_t s) {
    std::uint32_t index = stretches[s].used;
    for (std::size_t v = stretches[s].first; v < stretches[s].last; ++v) indices.of[v] = used[v] ? index++ : kNone;
  });
  indices.end = next;
  return indices;
}

void appendNodes(const MeshedDomain& part, bool geographic, const NodeIndices& indices, const ItemLoop& loop,
                 BulkList<Point>& nodes) {
  const Domain& domain = *part.domain;
  const TriMesh& mesh = *part.mesh;
  const BulkList<std::uint32_t>& index_of = indices.of;
  assert(domain.input_points.size() == mesh.input_vertices);
  // Coordinates meshed without a projection stay unchanged.
  const bool shifts = geographic && !domain.projection.isIdentity();
  const LongitudeRange range = shifts && !domain.input_points.empty() ? rangeOf(domain.input_points) : LongitudeRange{};
  resizeUnset(nodes, indices.end);
  const SmoothTable inverse =
      inverseTable(domain.projection, part.ground != nullptr ? std::span<const Point>() : std::span(mesh.points), loop);
  forEachByStretches(loop, mesh.points.size(), [&](std::size_t v) {
    if (index_of[v] == kNone) return;
    Point& node = nodes[index_of[v]];
    if (v < mesh.input_vertices) {
      node = domain.input_points[v];
    } else {
      node = part.ground != nullptr ? part.ground->input[v] : inverse.at(mesh.points[v]);
      if (shifts) node.x = range.bring(node.x);
    }
  });
}

// Appends triangles, with the mesh's own numbers of corners.
void appendCorners(const TriMesh& mesh, const ItemLoop& loop, Grid& grid) {
  const std::size_t before = grid.triangles.size();
  resizeUnset(grid.triangles, before + mesh.triangles.size());
  forEachByStretches(loop, mesh.triangles.size(),
                     [&](std::size_t t) { grid.triangles[before + t] = mesh.triangles[t].v; });
}

// Renumbers the corners of triangles from `before` on as nodes of the grid, and sets their features and angles. The
// mesh's triangles may be gone. Does `also(i)` for every i below `others` in the same loop, before them: a single long
// one would keep the other threads waiting.
template <typename Also>
void finishTriangles(const TriMesh& mesh, const GroundPlaces* ground, const BulkList<std::uint32_t>& index_of,
                     const std::vector<std::uint32_t>& feature_index, const ItemLoop& loop, std::size_t before,
                     Grid& grid, std::size_t others, const Also& also) {
  const std::size_t after = grid.triangles.size();
  if (!feature_index.empty()) resizeUnset(grid.feature_of, after);
  resizeUnset(grid.min_angle_deg, after);
  const auto finish = [&](std::size_t t) {
    auto& corners = grid.triangles[before + t];
    const auto [a, b, c] = corners;
    corners = {index_of[a], index_of[b], index_of[c]};
    if (!feature_index.empty()) grid.feature_of[before + t] = feature_index[static_cast<std::size_t>(mesh.regions[t])];
    grid.min_angle_deg[before + t] = ground == nullptr
                                         ? leastAngleDeg(mesh.points[a], mesh.points[b], mesh.points[c])
                                         : leastSpaceAngleDeg(ground->space[a], ground->space[b], ground->space[c]);
  };
  constexpr std::size_t kStretch = 8192, kMostStretches = 1024;
  const std::size_t count = after - before, stretches = std::clamp<std::size_t>(count / kStretch, 1, kMostStretches);
  const auto work = [&](std::size_t i) {
    if (i < others) return also(i);
    const std::size_t s = i - others;
    for (std::size_t t = count * s / stretches; t < count * (s + 1) / stretches; ++t) finish(t);
  };
  // Beginning a loop takes longer than the work on a small mesh.
  if (stretches == 1)
    inOrder(others + stretches, work);
  else
    loop(others + stretches, work);
}

// Appends the features that triangles belong to, in the coastline's order. Returns the new index of each feature of the
// coastline; empty if it has none (a .poly).
std::vector<std::uint32_t> appendFeatures(const std::vector<MeshedDomain>& parts, const Coastline& coastline,
                                          const ItemLoop& loop, std::vector<GridFeature>& features) {
  std::vector<std::uint32_t> index_of(coastline.features.size(), kNone);
  if (index_of.empty()) return index_of;
  for (const MeshedDomain& part : parts) {
    const BulkList<RegionId>& regions = part.mesh->regions;
    // Consecutive triangles mostly lie in the same region.
    for (const RegionId region : joined(overStretches(loop, regions.size(), [&](std::size_t first, std::size_t last) {
           std::vector<RegionId> some;
           for (std::size_t t = first; t < last; ++t)
             if (some.empty() || some.back() != regions[t]) some.push_back(regions[t]);
           return some;
         }))) {
      assert(region >= 0 && static_cast<std::size_t>(region) < index_of.size());
      index_of[static_cast<std::size_t>(region)] = 0;
    }
  }
  for (std::size_t i = 0; i < index_of.size(); ++i) {
    if (index_of[i] == kNone) continue;
    index_of[i] = static_cast<std::uint32_t>(features.size());
    const Feature& feature = coastline.features[i];
    features.push_back({feature.fid, feature.source, feature.attributes, feature.region});
  }
  return index_of;
}

LineKind kindOf(FeatureUse use) {
  if (use == FeatureUse::Weir) return LineKind::Weir;
  return use == FeatureUse::Region ? LineKind::RegionBorder : LineKind::Constraint;
}

// Appends the domain's lines along edges of the mesh, in order. A feature's line stays one line where a region's border
// runs along a part of it.
void appendLines(const Domain& domain, const TriMesh& mesh, const BulkList<std::uint32_t>& index_of,
                 std::vector<GridLine>& lines) {
  if (domain.lines.empty()) return;
  std::vector<std::vector<NodePair>> edges_of(domain.lines.size());
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    for (unsigned i = 0; i < 3; ++i) {
      const SegmentId segment = triangle.seg[i];
      if (triangle.adj[i] == kNone || segment >= domain.pslg.segments.size()) continue;
      const std::int32_t tag = domain.pslg.segments[segment].tag;
      if (!isLineTag(tag) || lineOfTag(tag) >= domain.lines.size()) continue;
      if (triOf(triangle.adj[i]) < t) continue;  // each edge once
      edges_of[lineOfTag(tag)].push_back({index_of[triangle.v[next3(i)]], index_of[triangle.v[prev3(i)]]});
    }
  }
  for (std::size_t first = 0, last = 0; first < edges_of.size(); first = last) {
    const DomainLine& line = domain.lines[first];
    std::vector<NodePair> edges;
    for (; last < edges_of.size() && domain.lines[last].feature == line.feature; ++last)
      edges.insert(edges.end(), edges_of[last].begin(), edges_of[last].end());
    std::ranges::move(chainLines(std::move(edges), kindOf(line.use), line.name), std::back_inserter(lines));
  }
}

// Boundary edges on the frame, with the mesh to the left, sorted.
std::vector<NodePair> openEdges(const Domain& domain, const TriMesh& mesh, const ItemLoop& loop) {
  auto open = joined(overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
    std::vector<NodePair> some;
    for (std::size_t t = first; t < last; ++t) {
      const Triangle& triangle = mesh.triangles[t];
      for (unsigned i = 0; i < 3; ++i) {
        const SegmentId segment = triangle.seg[i];
        if (triangle.adj[i] != kNone || segment >= domain.pslg.segments.size()) continue;
        if (isOpenTag(domain.pslg.segments[segment].tag)) some.push_back({triangle.v[next3(i)], triangle.v[prev3(i)]});
      }
    }
    return some;
  }));
  std::ranges::sort(open);
  return open;
}

// Cuts a loop where open water and land meet, so that each piece is one or the other; they share their end nodes. Only
// a whole loop is an island.
std::vector<Boundary> splitLoop(Boundary&& loop, const std::vector<NodePair>& open) {
  const std::size_t n = loop.nodes.size();
  std::vector<char> is_open(n);
  for (std::size_t i = 0; i < n; ++i) {
    is_open[i] = std::ranges::binary_search(open, NodePair{loop.nodes[i], loop.nodes[(i + 1) % n]});
  }
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < n; ++i) {
    if (is_open[i] != is_open[(i + n - 1) % n]) starts.push_back(i);
  }
  std::vector<Boundary> pieces;
  if (starts.empty()) {
    if (is_open[0]) loop.role = BoundaryRole::Open;
    pieces.push_back(std::move(loop));
    return pieces;
  }
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const std::size_t first = starts[s], last = starts[(s + 1) % starts.size()];
    const BoundaryRole role = is_open[first] ? BoundaryRole::Open : BoundaryRole::Land;
    Boundary& piece = pieces.emplace_back(Boundary{role, false, {}});
    for (std::size_t i = first; i != last; i = (i + 1) % n) piece.nodes.push_back(loop.nodes[i]);
    piece.nodes.push_back(loop.nodes[last]);
  }
  return pieces;
}

}  // namespace

Grid makeGrid(const std::vector<MeshedDomain>& parts, const Coastline& coastline, const ItemLoop& loop) {
  Grid grid = makeGridWithoutAreas(parts, coastline, loop);
  grid.area_m2 = triangleAreas(grid.nodes, grid.triangles, grid.crs, loop);
  return grid;
}

Grid makeGridWithoutAreas(const std::vector<MeshedDomain>& parts, const Coastline& coastline, const ItemLoop& loop) {
  Grid grid;
  grid.crs = coastline.crs;
  std::size_t triangle_count = 0, point_count = 0;
  for (const MeshedDomain& part : parts) {
    triangle_count += part.mesh->triangles.size();
    point_count += part.mesh->points.size();
  }
  const std::vector<std::uint32_t> feature_index = appendFeatures(parts, coastline, loop, grid.features);
  grid.triangles.reserve(triangle_count);
  for (const MeshedDomain& part : parts) {
    const NodeIndices indices = nodeIndices(*part.mesh, static_cast<std::uint32_t>(grid.nodes.size()), loop);
    const BulkList<std::uint32_t>& index_of = indices.of;
    const std::size_t before = grid.triangles.size();
    appendCorners(*part.mesh, loop, grid);
    appendLines(*part.domain, *part.mesh, index_of, grid.lines);
    std::vector<Boundary> boundaries;
    const std::vector<NodePair> open = openEdges(*part.domain, *part.mesh, loop);
    std::vector<Boundary> loops = findBoundaries(*part.mesh, loop);
    constexpr std::size_t kWorthAStretch = 16;
    const auto splitLoops = [&](std::size_t first, std::size_t last) {
      std::vector<Boundary> pieces;
      for (Boundary& whole : std::span(loops).subspan(first, last - first))
        std::ranges::move(splitLoop(std::move(whole), open), std::back_inserter(pieces));
      return pieces;
    };
    for (std::vector<Boundary>& pieces : overStretches(loop, loops.size(), splitLoops, kWorthAStretch))
      std::ranges::move(pieces, std::back_inserter(boundaries));
    if (part.triangles_done) part.triangles_done();
    grid.nodes.reserve(point_count);
    grid.min_angle_deg.reserve(triangle_count);
    if (!feature_index.empty()) grid.feature_of.reserve(triangle_count);
    appendNodes(part, grid.crs.geographic, indices, loop, grid.nodes);
    if (part.size_m != nullptr) {
      grid.size_m.resize(grid.nodes.size());
      forEachByStretches(loop, index_of.size(), [&](std::size_t v) {
        if (index_of[v] != kNone) grid.size_m[index_of[v]] = (*part.size_m)[v];
      });
    }
    const auto finish = [&](std::size_t some) {
      const std::size_t first = some * kWorthAStretch, count = std::min(kWorthAStretch, boundaries.size() - first);
      for (Boundary& boundary : std::span(boundaries).subspan(first, count)) {
        for (std::uint32_t& node : boundary.nodes) node = index_of[node];
        if (boundary.closed && boundary.role != BoundaryRole::Open)
          boundary.role = roleByArea(grid.nodes, boundary.nodes, grid.crs).value_or(boundary.role);
      }
    };
    finishTriangles(*part.mesh, part.ground, index_of, feature_index, loop, before, grid,
                    (boundaries.size() + kWorthAStretch - 1) / kWorthAStretch, finish);
    std::ranges::move(boundaries, std::back_inserter(grid.boundaries));
  }
  return grid;
}

}  // namespace coastmesh
