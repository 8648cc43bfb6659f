#include "gis/remesh/new_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>

#include "core/metric.hpp"
#include "gis/crs/longitude_range.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// A place within three nodes, or between two: values there are their means with these weights.
struct Within {
  std::array<std::uint32_t, 3> nodes;
  std::array<double, 3> weights;

  double of(const std::vector<double>& values) const {
    return weights[0] * values[nodes[0]] + weights[1] * values[nodes[1]] + weights[2] * values[nodes[2]];
  }
};

// The triangles that a patch replaces, in its plane.
class OldTriangles {
 public:
  OldTriangles(const Grid& grid, const RemeshPatch& patch, const ItemLoop& loop) : grid_(grid), patch_(patch) {
    std::vector<std::uint32_t> nodes;
    for (const std::uint32_t t : patch.triangles)
      nodes.insert(nodes.end(), grid.triangles[t].begin(), grid.triangles[t].end());
    std::ranges::sort(nodes);
    const auto repeated = std::ranges::unique(nodes);
    nodes.erase(repeated.begin(), repeated.end());
    std::vector<Point> plane(nodes.size());
    forEachByStretches(loop, nodes.size(),
                       [&](std::size_t i) { plane[i] = patch.domain.projection.forward(grid.nodes[nodes[i]]); });
    const auto placeOf = [&](std::uint32_t node) {
      return plane[static_cast<std::size_t>(std::ranges::lower_bound(nodes, node) - nodes.begin())];
    };
    corners_.resize(patch.triangles.size());
    std::vector<Box> boxes(corners_.size());
    forEachByStretches(loop, corners_.size(), [&](std::size_t i) {
      const auto& v = grid.triangles[patch.triangles[i]];
      corners_[i] = {placeOf(v[0]), placeOf(v[1]), placeOf(v[2])};
      for (const Point& p : corners_[i]) boxes[i].add(p);
    });
    tree_ = BoxTree(boxes, BoxTree::Order::Hilbert, loop);
  }

  // In the triangle at the place; rounding may have put it just outside of all.
  std::optional<Within> at(const Point& place) const {
    double best = -std::numeric_limits<double>::infinity();
    std::optional<Within> found;
    const double slack =
        kSlack * std::max(tree_.bounds().xmax - tree_.bounds().xmin, tree_.bounds().ymax - tree_.bounds().ymin);
    tree_.visit(Box::of(place, place).grownBy(slack), [&](std::uint32_t i) {
      const auto& [a, b, c] = corners_[i];
      const double area = cross(b - a, c - a);
      if (!(area > 0.0)) return;
      const double at_a = cross(b - place, c - place) / area, at_b = cross(c - place, a - place) / area;
      const double least = std::min({at_a, at_b, 1.0 - at_a - at_b});
      if (!(least > best)) return;
      best = least;
      found = {grid_.triangles[patch_.triangles[i]], {at_a, at_b, 1.0 - at_a - at_b}};
    });
    return found;
  }

 private:
  static constexpr double kSlack = 1e-6;  // of the extent

  const Grid& grid_;
  const RemeshPatch& patch_;
  std::vector<std::array<Point, 3>> corners_;
  BoxTree tree_;
};

// The segments that new vertices divide.
std::vector<DividedEdge> dividedEdges(const RemeshPatch& patch, const TriMesh& mesh) {
  const Pslg& pslg = patch.domain.pslg;
  const auto first = static_cast<VertexId>(pslg.points.size());
  std::map<SegmentId, std::vector<VertexId>> added;
  for (const Triangle& t : mesh.triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      if (!mayDivide(pslg, t.seg[i])) continue;
      for (const VertexId v : {t.v[next3(i)], t.v[prev3(i)]})
        if (v >= first) added[t.seg[i]].push_back(v);
    }
  }
  std::vector<DividedEdge> divided;
  for (auto& [s, vertices] : added) {
    const Segment& segment = pslg.segments[s];
    const Point &a = pslg.points[segment.a], &b = pslg.points[segment.b];
    std::ranges::sort(vertices, {}, [&](VertexId v) { return std::pair(dot(mesh.points[v] - a, b - a), v); });
    const auto repeated = std::ranges::unique(vertices);
    vertices.erase(repeated.begin(), repeated.end());
    divided.push_back({{patch.nodes[segment.a], patch.nodes[segment.b]}, std::move(vertices)});
  }
  return divided;
}

}  // namespace

NewNodes newNodesOf(const Grid& grid, const RemeshPatch& patch, const TriMesh& mesh, const ItemLoop& loop) {
  const Pslg& pslg = patch.domain.pslg;
  const std::size_t first = pslg.points.size(), count = mesh.points.size() - first;
  NewNodes nodes;
  nodes.divided = dividedEdges(patch, mesh);
  nodes.places.resize(count);
  const LongitudeRange range = grid.crs.geographic ? rangeOf(grid.nodes) : LongitudeRange{};
  forEachByStretches(loop, count, [&](std::size_t i) {
    Point& place = nodes.places[i];
    place = patch.domain.projection.inverse(mesh.points[first + i]);
    if (grid.crs.geographic) place.x = range.bring(place.x);
  });
  if (grid.z.empty() && grid.node_fields.empty()) return nodes;
  const OldTriangles old(grid, patch, loop);
  std::vector<std::optional<Within>> within(count);
  forEachByStretches(loop, count, [&](std::size_t i) { within[i] = old.at(mesh.points[first + i]); });
  const auto valuesOf = [&](const std::vector<double>& of_grid) {
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = within[i] ? within[i]->of(of_grid) : kUnknown;
    return values;
  };
  if (!grid.z.empty()) nodes.z = valuesOf(grid.z);
  for (const NodeField& field : grid.node_fields) {
    nodes.fields.push_back(valuesOf(field.values));
    for (double& value : nodes.fields.back()) value = roundedValue(value);
  }
  // Vertices on segments are between two nodes.
  const auto placeOf = [&](std::uint32_t node) {
    return pslg.points[static_cast<std::size_t>(std::ranges::lower_bound(patch.nodes, node) - patch.nodes.begin())];
  };
  for (const auto& [ends, added] : nodes.divided) {
    const Point a = placeOf(ends[0]), b = placeOf(ends[1]);
    for (const VertexId v : added) {
      const double share = distance(a, mesh.points[v]) / distance(a, b);
      const auto between = [&](const std::vector<double>& of_grid) {
        return (1.0 - share) * of_grid[ends[0]] + share * of_grid[ends[1]];
      };
      if (!grid.z.empty()) nodes.z[v - first] = between(grid.z);
      for (std::size_t k = 0; k < nodes.fields.size(); ++k)
        nodes.fields[k][v - first] = roundedValue(between(grid.node_fields[k].values));
    }
  }
  return nodes;
}

}  // namespace coastmesh
