#include "apps/report/file_info.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "apps/job/grid_pieces.hpp"
#include "core/sphere/close_sphere.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/elements/quads.hpp"
#include "gis/fields/node_fields.hpp"

namespace coastmesh {

namespace {

class ExtentOf {
 public:
  void add(const Point& p) {
    if (!any_) extent_ = {p, p};
    any_ = true;
    extent_.low = {std::min(extent_.low.x, p.x), std::min(extent_.low.y, p.y)};
    extent_.high = {std::max(extent_.high.x, p.x), std::max(extent_.high.y, p.y)};
  }
  const Extent& extent() const { return extent_; }

 private:
  Extent extent_;
  bool any_ = false;
};

// The shortest and the longest of the edges given. Geodesics are slow, so edges are compared by their length on a
// sphere, and only the two found are measured.
class ExtremeEdges {
 public:
  explicit ExtremeEdges(const Crs& crs) : crs_(crs) {}

  void add(const Point& a, const Point& b) {
    if (a == b) {
      ++zero_edges_;
      return;
    }
    const double length = compare(a, b);
    if (length < least_) shortest_ = {a, b};
    if (length > most_) longest_ = {a, b};
    least_ = std::min(least_, length);
    most_ = std::max(most_, length);
  }

  std::uint64_t zeroEdges() const { return zero_edges_; }
  double shortest() const { return measure(shortest_); }
  double longest() const { return measure(longest_); }

 private:
  double compare(const Point& a, const Point& b) const {
    if (!crs_.geographic) return std::hypot(b.x - a.x, b.y - a.y);
    // Half the chord, since longitudes are meaningless at the poles.
    constexpr double kDegree = std::numbers::pi / 180.0;
    const double across = std::sin(std::remainder(b.x - a.x, 360.0) / 2 * kDegree);
    const double along = std::sin((b.y - a.y) / 2 * kDegree);
    return std::sqrt(along * along + std::cos(a.y * kDegree) * std::cos(b.y * kDegree) * across * across);
  }

  double measure(const std::vector<Point>& edge) const { return edge.empty() ? 0.0 : chainLengths({edge}, crs_)[0]; }

  const Crs& crs_;
  std::vector<Point> shortest_;
  std::vector<Point> longest_;
  double least_ = std::numeric_limits<double>::infinity();
  double most_ = -1.0;
  std::uint64_t zero_edges_ = 0;
};

void addChain(std::span<const Point> chain, bool closed, ExtentOf& extent, ExtremeEdges& edges) {
  for (std::size_t i = 0; i < chain.size(); ++i) {
    extent.add(chain[i]);
    if (i + 1 < chain.size()) edges.add(chain[i], chain[i + 1]);
  }
  if (closed && chain.size() > 1) edges.add(chain.back(), chain.front());
}

QuadFigures quadFigures(const Grid& grid) {
  QuadFigures figures;
  for (const Quad& quad : quadsOf(grid)) {
    ++figures.count;
    const std::array<double, 4> angles = anglesOf(grid, quad);
    figures.min_angle_deg = std::min(figures.min_angle_deg, std::ranges::min(angles));
    figures.max_angle_deg = std::max(figures.max_angle_deg, std::ranges::max(angles));
    if (std::ranges::max(angles) >= 180.0) ++figures.reflex;
  }
  return figures;
}

}  // namespace

MeshInfo describeMesh(const Grid& grid, SurfaceKind surface) {
  MeshInfo info;
  info.crs = nameOf(grid.crs);
  info.nodes = grid.nodes.size();
  info.quads = quadFigures(grid);
  info.triangles = grid.triangles.size() - 2 * info.quads.count;
  info.features = grid.features.size();
  for (const Boundary& boundary : grid.boundaries) ++info.boundaries[std::string(toString(boundary.role))];
  ExtentOf extent;
  for (const Point& node : grid.nodes) extent.add(node);
  info.extent = extent.extent();
  for (const double z : grid.z) {
    if (std::isnan(z)) {
      ++info.nodes_without_z;
      continue;
    }
    info.lowest_z = info.has_z ? std::min(info.lowest_z, z) : z;
    info.highest_z = info.has_z ? std::max(info.highest_z, z) : z;
    info.has_z = true;
  }
  for (const NodeField& field : grid.node_fields) {
    const FieldRange range = rangeOf(field);
    info.fields.push_back({titleOf(field), range.least, range.greatest, range.unknown});
  }
  for (const GridPiece& piece : splitGrid(grid, surface)) {
    ++info.pieces;
    if (info.quads.count == 0) info.quality.add(measureQuality(piece.mesh, 0.0, 180.0, inOrder, piece.places));
    info.closed = info.closed && isClosed(piece.mesh);
    info.euler += eulerNumber(piece.mesh);
    const SurfaceKind curved = surface == SurfaceKind::Sphere ? surface : SurfaceKind::Ellipsoid;
    const SurfaceKind measured = piece.places.empty() ? SurfaceKind::Plane : curved;
    const std::string name = kSurfaceNames[static_cast<std::size_t>(measured)];
    info.surface = info.surface.empty() || info.surface == name ? name : "mixed";
  }
  if (info.quads.count > 0 && info.triangles > 0)
    for (const GridPiece& piece : splitGrid(trianglesOnly(grid), surface))
      info.quality.add(measureQuality(piece.mesh, 0.0, 180.0, inOrder, piece.places));
  ExtremeEdges edges(grid.crs);
  const std::vector<std::uint8_t> diagonals = diagonalsOf(grid);
  for (std::size_t t = 0; t < grid.triangles.size(); ++t)
    for (unsigned i = 0; i < 3; ++i)
      if (diagonals.empty() || diagonals[t] != i)
        edges.add(grid.nodes[grid.triangles[t][next3(i)]], grid.nodes[grid.triangles[t][prev3(i)]]);
  info.step = measureStep(grid);
  info.plane = grid.crs.isPlane();
  info.longest_edge_m = edges.longest();
  // Those of clockwise triangles are negative.
  for (double area : triangleAreas(grid.nodes, grid.triangles, grid.crs)) info.area_m2 += std::abs(area);
  return info;
}

CoastlineInfo describeCoastline(const JobInput& input) {
  const Coastline& coastline = input.coastline();
  CoastlineInfo info;
  info.crs = nameOf(coastline.crs);
  info.features = input.report().features;
  info.groups = input.groups();
  info.points = input.report().points;
  info.skipped_empty = input.report().skipped_empty;
  info.skipped_points = input.report().skipped_points;
  info.warnings = input.report().warnings;
  ExtentOf extent;
  ExtremeEdges edges(coastline.crs);
  for (const Feature& feature : coastline.features) {
    ++info.sources[feature.source];
    for (const Polygon& polygon : feature.polygons) {
      info.rings += 1 + polygon.holes.size();
      info.holes += polygon.holes.size();
      addChain(polygon.outer, true, extent, edges);
      for (const Ring& hole : polygon.holes) addChain(hole, true, extent, edges);
    }
    info.lines += feature.lines.size();
    for (const auto& line : feature.lines) addChain(line, false, extent, edges);
  }
  for (std::size_t g = 0; g < input.groups(); ++g) info.area_m2 += input.area(g).value_or(0.0);
  info.extent = extent.extent();
  info.zero_edges = edges.zeroEdges();
  info.shortest_edge_m = edges.shortest();
  info.longest_edge_m = edges.longest();
  return info;
}

PolyInfo describePoly(const Pslg& pslg) {
  PolyInfo info;
  info.points = pslg.points.size();
  info.segments = pslg.segments.size();
  info.holes = pslg.holes.size();
  ExtentOf extent;
  for (const Point& p : pslg.points) extent.add(p);
  info.extent = extent.extent();
  const Crs plane;
  ExtremeEdges edges(plane);
  for (const Segment& s : pslg.segments) edges.add(pslg.points[s.a], pslg.points[s.b]);
  info.shortest_edge = edges.shortest();
  info.longest_edge = edges.longest();
  return info;
}

}  // namespace coastmesh
