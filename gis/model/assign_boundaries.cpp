#include "gis/model/assign_boundaries.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "core/metric.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/error.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/loop_role.hpp"
#include "gis/places.hpp"

namespace coastmesh {
namespace {

BoundaryEdges edgesOfLoops(const Grid& grid, const std::vector<std::vector<std::uint32_t>>& loops) {
  BoundaryEdges boundary;
  const EdgeKinds before(grid);
  for (const auto& loop : loops) {
    const bool outer = roleOfLoop(grid.nodes, loop, grid.crs) == BoundaryRole::Land;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const NodePair edge{loop[i], loop[(i + 1) % loop.size()]};
      boundary.edges.push_back(edge);
      boundary.kinds.push_back(before.forCutting(edge[0], edge[1]));
      boundary.outer.push_back(outer);
    }
    boundary.loop_ends.push_back(boundary.edges.size());
  }
  return boundary;
}

std::vector<Boundary> boundariesOf(const Grid& grid, const std::vector<std::vector<std::uint32_t>>& loops,
                                   const BoundaryEdges& boundary) {
  std::vector<std::pair<NodePair, std::size_t>> index;
  for (std::size_t e = 0; e < boundary.edges.size(); ++e) index.emplace_back(boundary.edges[e], e);
  std::ranges::sort(index);
  return cutLoops(grid, loops, [&](std::uint32_t from, std::uint32_t to) {
    const auto at =
        std::ranges::lower_bound(index, NodePair{from, to}, {}, [](const auto& entry) { return entry.first; });
    return boundary.kinds[at->second];
  });
}

// The turn of a boundary at the beginning of an edge, degrees; near enough on the ground.
double turnDeg(const Grid& grid, const NodePair& before, const NodePair& edge) {
  const Point &a = grid.nodes[before[0]], &b = grid.nodes[edge[0]], &c = grid.nodes[edge[1]];
  const double along = grid.crs.geographic ? std::cos(toRadians(b.y)) : 1.0;
  const auto step = [&](const Point& from, const Point& to) {
    const double turned = grid.crs.geographic ? std::remainder(to.x - from.x, 360.0) : to.x - from.x;
    return Point{along * turned, to.y - from.y};
  };
  const Point one = step(a, b), other = step(b, c);
  return toDegrees(std::abs(std::atan2(cross(one, other), dot(one, other))));
}

// Parts of a line that depths have opened.
struct OpenedLine {
  std::size_t edges = 0, parts = 0;
  double length_m = 0.0, longest_m = 0.0;  // of all parts, of the longest part
  Point place;                             // the middle of the longest part
  double turns_deg = 0.0;                  // the sum over its edges
};

// `before`: the kinds of edges before depths opened some.
OpenedLine openedByDepth(const Grid& grid, const std::vector<BoundaryKind>& before, const BoundaryEdges& boundary) {
  OpenedLine opened;
  std::vector<std::vector<Point>> edges;
  for (const auto& [from, to] : boundary.edges) edges.push_back({grid.nodes[from], grid.nodes[to]});
  const std::vector<double> lengths = chainLengths(edges, grid.crs);
  std::size_t begin = 0;
  for (const std::size_t end : boundary.loop_ends) {
    const auto isOpened = [&](std::size_t e) {
      return !isOpening(before[e]) && isOpening(boundary.kinds[e]) && boundary.asked[e] == kNone;
    };
    std::size_t start = begin;  // where no part is cut in two, if there is such an edge
    while (start + 1 < end && isOpened(start)) ++start;
    double part_m = 0.0;
    std::size_t first = start;
    for (std::size_t k = 0; k < end - begin; ++k) {
      const std::size_t e = begin + (start - begin + k) % (end - begin);
      if (!isOpened(e)) {
        part_m = 0.0;
        continue;
      }
      if (part_m == 0.0) {
        ++opened.parts;
        first = k;
      }
      part_m += lengths[e];
      opened.length_m += lengths[e];
      ++opened.edges;
      opened.turns_deg += turnDeg(grid, boundary.edges[e > begin ? e - 1 : end - 1], boundary.edges[e]);
      if (part_m > opened.longest_m) {
        opened.longest_m = part_m;
        opened.place = grid.nodes[boundary.edges[begin + (start - begin + (first + k + 1) / 2) % (end - begin)][0]];
      }
    }
    begin = end;
  }
  return opened;
}

// Empty unless the opened line is winding.
std::string coastWarning(const OpenedLine& opened, double open_deeper_m, const Crs& crs) {
  constexpr double kWindingDeg = 15.0;  // per edge
  constexpr std::size_t kFewestEdges = 5;
  if (opened.edges < kFewestEdges || opened.turns_deg < kWindingDeg * static_cast<double>(opened.edges)) return {};
  const auto inWords = [&](double metres) {
    char text[40];
    std::snprintf(text, sizeof text, crs.isPlane() ? "%.3g" : "%.3g km", crs.isPlane() ? metres : metres / 1000.0);
    return std::string(text);
  };
  char limit[40];
  std::snprintf(limit, sizeof limit, "%.6g", open_deeper_m);
  std::string text = std::string("--open-deeper ") + limit + " opens a winding line, as of a coast that is as deep: ";
  text += inWords(opened.length_m);
  if (opened.parts > 1)
    text += " in " + std::to_string(opened.parts) + " parts, the longest of " + inWords(opened.longest_m);
  return text + ", at (" + roughPlaceInWords(opened.place) +
         "); polygons with the type land in --boundaries keep it closed, as does a larger --open-deeper";
}

}  // namespace

LoneOpenings loneOpenings(const Grid& grid, const std::function<bool(const Boundary&)>& counts) {
  LoneOpenings lone;
  std::vector<std::vector<Point>> edges;
  for (const Boundary& boundary : grid.boundaries)
    if (boundary.role == BoundaryRole::Open && !boundary.closed && boundary.nodes.size() == 2 &&
        (!counts || counts(boundary)))
      edges.push_back({grid.nodes[boundary.nodes[0]], grid.nodes[boundary.nodes[1]]});
  const std::vector<double> lengths = chainLengths(edges, grid.crs);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    ++lone.count;
    if (lengths[e] <= lone.longest_m) continue;
    lone.longest_m = lengths[e];
    lone.place = placeBetween(grid.crs, edges[e][0], edges[e][1], 0.5);
  }
  return lone;
}

BoundaryReport assignBoundaries(Grid& grid, const BoundaryOptions& options, const ItemLoop& loop) {
  if (!options.any()) return {};
  const auto isWeir = [](const Boundary& boundary) { return !boundary.weir.empty(); };
  if (std::ranges::any_of(grid.boundaries, isWeir))
    throw InputError("the mesh has weirs, whose boundaries cannot be set anew; leave the options of boundaries out");
  const std::vector<std::vector<std::uint32_t>> loops = boundaryLoops(grid, loop);
  BoundaryEdges boundary = edgesOfLoops(grid, loops);
  const BoundaryPlaces at{grid.crs, grid.nodes, grid.z};
  const std::vector<BoundaryKind> before = boundary.kinds;
  BoundaryReport report = defineKinds(at, options, boundary, loop);
  if (report.edges_by_depth > 0)
    if (std::string warning = coastWarning(openedByDepth(grid, before, boundary), options.open_deeper_m, grid.crs);
        !warning.empty())
      report.warnings.push_back(std::move(warning));
  report.merged = mergeShort(at, options.least_length_m, boundary);
  grid.boundaries = boundariesOf(grid, loops, boundary);
  return report;
}

}  // namespace coastmesh
