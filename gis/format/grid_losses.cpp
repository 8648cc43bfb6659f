#include "gis/format/grid_losses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <vector>

#include "core/metric.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/elements/quads.hpp"
#include "gis/fields/plain_field.hpp"
#include "gis/file/output_files.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/grid/ibtype.hpp"

namespace coastmesh {
namespace {

std::string counted(std::size_t count, const std::string& one, const std::string& more) {
  return std::to_string(count) + ' ' + (count == 1 ? one : more);
}

std::string joined(const std::vector<std::string>& parts, const char* between) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : between) + part;
  return text;
}

// "1 weir and 2 constraints"
std::string linesOf(const Grid& grid) {
  std::vector<std::string> kinds;
  const auto count = [&](LineKind kind, const std::string& one, const std::string& more) {
    const auto lines = static_cast<std::size_t>(std::ranges::count(grid.lines, kind, &GridLine::kind));
    if (lines > 0) kinds.push_back(counted(lines, one, more));
  };
  count(LineKind::Weir, "weir", "weirs");
  count(LineKind::Constraint, "constraint", "constraints");
  count(LineKind::RegionBorder, "border of a region", "borders of regions");
  return joined(kinds, " and ");
}

template <typename Wanted>
std::size_t countBoundaries(const Grid& grid, Wanted&& wanted) {
  return static_cast<std::size_t>(std::ranges::count_if(grid.boundaries, wanted));
}

std::string firstAt(const Point& place) {
  return "the first at " + std::to_string(place.x) + ", " + std::to_string(place.y);
}

// "(0, 11)": the types of those boundaries.
template <typename Wanted>
std::string typesOf(const Grid& grid, Wanted&& wanted) {
  std::set<int> numbers;
  for (const Boundary& boundary : grid.boundaries)
    if (wanted(boundary)) numbers.insert(boundary.ibtype);
  std::vector<std::string> texts;
  for (const int number : numbers) texts.push_back(std::to_string(number));
  return '(' + joined(texts, ", ") + ')';
}

bool anyName(const Grid& grid) {
  return std::ranges::any_of(
      grid.features, [](const GridFeature& feature) { return !feature.source.empty() || !feature.attributes.empty(); });
}

// "the nodal attributes manning, canopy". The land of a flood plain is none that the user gave.
std::string fieldsOf(const Grid& grid, const GridFormat& format, LossesOf of) {
  std::vector<std::string> names;
  for (const NodeField& field : grid.node_fields) {
    if (of == LossesOf::Input && field.name == kFloodPlain) continue;
    if (format.name == "fvcom" && field.name.starts_with("sponge_")) continue;  // in its _spg.dat
    if (names.empty() || names.back() != field.name) names.push_back(field.name);
  }
  return names.empty() ? "" : "the nodal attribute" + std::string(names.size() == 1 ? " " : "s ") + joined(names, ", ");
}

// Describes what the grid has of a part; empty if nothing.
std::string wordsFor(GridPart part, const Grid& grid, const GridFormat& format, LossesOf of) {
  switch (part) {
    case GridPart::Title:
      return grid.title.empty() ? "" : "the title";
    case GridPart::Quads: {
      const std::size_t quads = grid.quad_of.empty() ? 0 : quadsOf(grid).size();
      return quads == 0 ? ""
                        : counted(quads, "quadrilateral, which becomes", "quadrilaterals, which become") +
                              " two triangles" + (quads == 1 ? "" : " each");
    }
    case GridPart::Sizes:
      return grid.size_m.empty() ? "" : "the lengths that edges were to have";
    case GridPart::Features:
      return grid.feature_of.empty() ? "" : "the features that triangles come from";
    case GridPart::FeatureNames:
      return anyName(grid) ? "names and sources of features" : "";
    case GridPart::Regions: {
      std::set<std::string> names;
      for (const GridFeature& feature : grid.features)
        if (!feature.region.empty()) names.insert(feature.region);
      return names.empty() ? "" : "the names of " + counted(names.size(), "region", "regions");
    }
    case GridPart::Pieces:
      return grid.piece_of.empty() ? "" : "the pieces that triangles were refined in";
    case GridPart::Partition:
      return grid.part_of.empty() ? "" : "the parts that triangles belong to";
    case GridPart::NodePartition:
      return grid.node_part_of.empty() ? "" : "the parts that nodes belong to";
    case GridPart::Lines: {
      if (grid.lines.empty()) return "";
      std::string text = linesOf(grid) + ", whose edges stay in the mesh";
      const bool weirs = std::ranges::count(grid.lines, LineKind::Weir, &GridLine::kind) > 0;
      if (weirs && format.holds.has(GridPart::Weirs))
        text +=
            " (a weir of its own takes nodes across and heights: mesh --target adcirc makes it of --weirs with a "
            "height)";
      return text;
    }
    case GridPart::LineNames: {
      const bool named = std::ranges::any_of(grid.lines, [](const GridLine& line) { return !line.name.empty(); });
      return named && format.holds.has(GridPart::Lines) ? "the names of lines" : "";
    }
    case GridPart::Rivers: {
      const std::size_t rivers =
          countBoundaries(grid, [](const Boundary& boundary) { return boundary.role == BoundaryRole::River; });
      return rivers == 0 ? "" : "that " + counted(rivers, "boundary is a river", "boundaries are rivers");
    }
    case GridPart::BoundaryNames: {
      const std::size_t named = countBoundaries(grid, [](const Boundary& boundary) { return !boundary.name.empty(); });
      return named == 0 || !format.holds.has(GridPart::Rivers) ? ""
                                                               : "the " + std::string(named == 1 ? "name" : "names") +
                                                                     " of " + counted(named, "boundary", "boundaries");
    }
    case GridPart::Ibtypes: {
      const auto hasIbtype = [](const Boundary& boundary) { return boundary.ibtype >= 0; };
      const std::size_t types = countBoundaries(grid, hasIbtype);
      if (types == 0) return "";
      return "ADCIRC's types of " + counted(types, "boundary", "boundaries") + ' ' + typesOf(grid, hasIbtype);
    }
    case GridPart::Weirs: {
      const std::size_t weirs = countBoundaries(grid, [](const Boundary& boundary) { return !boundary.weir.empty(); });
      return weirs == 0 ? ""
                        : "heights and nodes across of " + counted(weirs, "weir", "weirs") +
                              " between shores, which a .14 holds";
    }
    case GridPart::BareWeirs: {
      const std::size_t bare = countBoundaries(grid, isBareWeir);
      if (bare == 0 || !format.holds.has(GridPart::Ibtypes)) return "";
      return "that " + counted(bare, "boundary is a weir", "boundaries are weirs") + ' ' + typesOf(grid, isBareWeir) +
             ", whose heights are not known";
    }
    case GridPart::PartIslands: {
      const std::size_t parts = countBoundaries(grid, isPartOfIsland);
      if (parts == 0 || !format.holds.has(GridPart::Ibtypes)) return "";
      const Point& first = grid.nodes[std::ranges::find_if(grid.boundaries, isPartOfIsland)->nodes.front()];
      return "that " + counted(parts, "boundary is an island", "boundaries are islands") + ' ' +
             typesOf(grid, isPartOfIsland) + ": a part of a shore gets the mainland's type, " + firstAt(first);
    }
    case GridPart::NodeFields:
      return fieldsOf(grid, format, of);
  }
  return "";
}

// "that 2 edges between open nodes are shore: …"; empty if there are none.
std::string loneShoresOf(const Grid& grid, const GridFormat& format) {
  const auto opens = [&](BoundaryRole role) {
    return role == BoundaryRole::Open || (role == BoundaryRole::River && format.marked == MarkedNodes::OfOpenAndRivers);
  };
  std::vector<bool> marked(grid.nodes.size(), false);
  for (const Boundary& boundary : grid.boundaries)
    if (opens(boundary.role))
      for (const std::uint32_t node : boundary.nodes) marked[node] = true;
  std::vector<NodePair> lone;
  for (const Boundary& boundary : grid.boundaries)
    if (!opens(boundary.role))
      for (const NodePair& edge : edgesOf(boundary))
        if (marked[edge[0]] && marked[edge[1]]) lone.push_back(edge);
  if (lone.empty()) return "";
  return "that " + counted(lone.size(), "edge between open nodes is", "edges between open nodes are") +
         " shore: such edges become open, " + firstAt(grid.nodes[lone.front()[0]]);
}

// "the heights of 2 nodes above the water"; empty if there are none.
std::string heightsOf(const Grid& grid) {
  const auto heights = static_cast<std::size_t>(std::ranges::count_if(grid.z, [](double z) { return z > 0.0; }));
  return heights == 0 ? "" : "the heights of " + counted(heights, "node", "nodes") + " above the water, which become 0";
}

// "the datum shift of the CRS, …", if the CRS is written as ESRI's WKT; otherwise empty.
std::string datumShiftOf(const Grid& grid, const GridFormat& format) {
  if (format.endings.empty() || !prjLosesDatumShift(grid.crs)) return "";
  const OutputFiles files = filesOf(format, "mesh" + std::string(format.endings.front()));
  const bool has_prj =
      !files.prj.empty() || std::ranges::any_of(files.targets, [](const auto& path) { return path.ends_with(".prj"); });
  if (!has_prj && !format.holds_esri_wkt) return "";
  return "the datum shift of the CRS: readers of the " + std::string(has_prj ? ".prj" : "file") +
         " may place the mesh some 100 m away";
}

constexpr std::array kGivenParts{GridPart::Regions,       GridPart::Pieces,    GridPart::Lines,
                                 GridPart::LineNames,     GridPart::Rivers,    GridPart::Ibtypes,
                                 GridPart::Weirs,         GridPart::BareWeirs, GridPart::PartIslands,
                                 GridPart::BoundaryNames, GridPart::NodeFields};
constexpr std::array kAllParts{
    GridPart::Title,     GridPart::Quads,         GridPart::Sizes,     GridPart::Features,    GridPart::FeatureNames,
    GridPart::Regions,   GridPart::Pieces,        GridPart::Lines,     GridPart::LineNames,   GridPart::Rivers,
    GridPart::Ibtypes,   GridPart::Weirs,         GridPart::BareWeirs, GridPart::PartIslands, GridPart::BoundaryNames,
    GridPart::Partition, GridPart::NodePartition, GridPart::NodeFields};

// Lengths in the grid's CRS over lengths on the ground.
struct Scales {
  double mean = 1.0, least = 1.0, most = 1.0;  // the last two over all places and directions
  double angle_deg = 0.0;                      // by which angles differ at most
};

// The least and the largest scale, over all directions, of the linear map that gives a triangle these sides, from one
// with sides of those lengths on the ground: singular values, from the traces and determinants of both Gram matrices.
std::array<double, 2> scalesOf(const Point& a, const Point& b, const std::array<double, 3>& on_ground) {
  const auto& [u, v, w] = on_ground;
  const double uv = 0.5 * (u * u + v * v - w * w);
  const double ground = u * u * v * v - uv * uv, plane = cross(a, b) * cross(a, b);
  const double sum = (squaredLength(a) * v * v - 2.0 * dot(a, b) * uv + squaredLength(b) * u * u) / ground;
  const double root = std::sqrt(std::max(0.0, 0.25 * sum * sum - plane / ground));
  return {std::sqrt(std::max(0.0, 0.5 * sum - root)), std::sqrt(0.5 * sum + root)};
}

// For a sample of triangles. REQUIRES: a projected CRS in metres.
Scales scalesIn(const Grid& grid) {
  constexpr std::size_t kTriangles = 1000;
  std::vector<std::vector<Point>> sides;
  const std::size_t step = std::max<std::size_t>(1, grid.triangles.size() / kTriangles);
  for (std::size_t t = 0; t < grid.triangles.size(); t += step) {
    const auto& [a, b, c] = grid.triangles[t];
    for (const auto& [from, to] : {NodePair{a, b}, NodePair{a, c}, NodePair{b, c}})
      sides.push_back({grid.nodes[from], grid.nodes[to]});
  }
  const std::vector<double> lengths = chainLengths(sides, grid.crs);
  double in_plane = 0.0, on_ground = 0.0;
  Scales scales;
  for (std::size_t i = 0; i < sides.size(); i += 3) {
    const Point a = sides[i][1] - sides[i][0], b = sides[i + 1][1] - sides[i + 1][0];
    in_plane += std::sqrt(squaredLength(a));
    on_ground += lengths[i];
    const auto [least, most] = scalesOf(a, b, {lengths[i], lengths[i + 1], lengths[i + 2]});
    if (!std::isfinite(least + most) || !(least > 0.0)) continue;  // a flat triangle has no shape
    scales.least = i == 0 ? least : std::min(scales.least, least);
    scales.most = i == 0 ? most : std::max(scales.most, most);
    scales.angle_deg = std::max(scales.angle_deg, toDegrees(2.0 * std::asin((most - least) / (most + least))));
  }
  if (on_ground > 0.0) scales.mean = in_plane / on_ground;
  return scales;
}

}  // namespace

std::string lossesIn(const Grid& grid, const GridFormat& format, LossesOf of) {
  if (format.beside_grid) return {};
  std::vector<std::string> losses;
  for (const GridPart part : kAllParts) {
    if (of == LossesOf::Input && std::ranges::find(kGivenParts, part) == kGivenParts.end()) continue;
    if (format.holds.has(part)) continue;
    losses.push_back(wordsFor(part, grid, format, of));
  }
  if (format.marked != MarkedNodes::None) losses.push_back(loneShoresOf(grid, format));
  if (format.of_water) losses.push_back(heightsOf(grid));
  losses.push_back(datumShiftOf(grid, format));
  std::erase(losses, std::string());
  return joined(losses, "; ");
}

std::string depthWarning(const Grid& grid, const std::string& path) {
  return grid.z.empty()
             ? "the mesh has no depths: '" + path + "' says 0 everywhere; give --bathymetry to mesh or convert"
             : "";
}

std::string metreWarning(const Grid& grid, const std::string& path) {
  const Crs& crs = grid.crs;
  if (crs.isPlane() || crs.geographic) return {};
  // SCHISM's two files are written together; the .ll has longitudes and latitudes.
  if (path.ends_with(".ll")) return metreWarning(grid, path.substr(0, path.size() - 3) + ".gr3");
  if (metresPerUnit(crs) != 1.0)
    return "'" + path + "' has x and y in the unit of " + nameOf(crs) + ", " + unitOf(crs) +
           ", as the input has them, and depths in metres, but models read all of them as metres: reproject the input "
           "to a CRS in metres (ogr2ogr -t_srs), and mesh that";
  constexpr double kTrue = 0.02;  // UTM and national grids are true to a few thousandths
  constexpr double kWorthAWordDeg = 3.0;
  const Scales scales = scalesIn(grid);
  if (std::abs(scales.mean - 1.0) <= kTrue && scales.most <= 1.0 + kTrue && scales.least >= 1.0 - kTrue) return {};
  char text[96];
  if (scales.most <= (1.0 + kTrue) * scales.least)
    std::snprintf(text, sizeof text, "%.3g times those on the ground", scales.mean);
  else
    std::snprintf(text, sizeof text, "%.3g to %.3g times those on the ground, by place and direction", scales.least,
                  scales.most);
  std::string angles;
  if (scales.angle_deg > kWorthAWordDeg) {
    char degrees[64];
    std::snprintf(degrees, sizeof degrees, ", and angles differ by up to %.2g degrees", scales.angle_deg);
    angles = degrees;
  }
  return "lengths in '" + path + "' are " + text + angles + ", since " + nameOf(crs) +
         ", as the input has it, is not true to scale here, but models take them for metres: reproject the input to a "
         "CRS of the region, such as UTM (ogr2ogr -t_srs), and mesh that";
}

}  // namespace coastmesh
