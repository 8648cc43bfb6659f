#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <span>
#include <string_view>
#include <type_traits>

#include "core/bulk_list.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/elements/elements.hpp"
#include "gis/elements/quads.hpp"
#include "gis/fields/field_names.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/file/cf_grid_mapping.hpp"
#include "gis/file/netcdf_file.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/format/grid_names.hpp"
#include "gis/format/read_ugrid.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/grid/mesh_edges.hpp"

namespace coastmesh {
namespace {

constexpr int kStartIndex = 1;
constexpr int kFillNode = -999;
constexpr double kFillZ = -999.0;
constexpr int kNoIbtype = -1;

std::string crsVariableName(const Crs& crs) { return crs.geographic ? "wgs84" : "projected_coordinate_system"; }

// The number of an EPSG code, 0 for another authority or none.
int epsgOf(const Crs& crs) {
  constexpr std::string_view kEpsg = "EPSG:";
  if (!crs.authority.starts_with(kEpsg)) return 0;
  int code = 0;
  for (const char c : crs.authority.substr(kEpsg.size())) code = c >= '0' && c <= '9' ? 10 * code + (c - '0') : code;
  return code;
}

// The names that MDAL (wkt, EPSG_code), D-FlowFM (epsg), CF (crs_wkt) and GDAL (spatial_ref) look for.
int defineCrs(NetcdfWriter& file, const Crs& crs) {
  const int variable = file.variable(crsVariableName(crs), NC_INT, {});
  const CfGridMapping mapping = cfGridMapping(crs);
  file.attribute(variable, "name", nameOf(crs));
  file.attribute(variable, "grid_mapping_name", mapping.name);
  for (const auto& [name, value] : mapping.parameters) file.attribute(variable, name, value);
  if (const int epsg = epsgOf(crs); epsg != 0) {
    file.attribute(variable, "epsg", epsg);
    file.attribute(variable, "EPSG_code", crs.authority);
  }
  for (const char* name : {"wkt", "crs_wkt", "spatial_ref"}) file.attribute(variable, name, crs.wkt);
  return variable;
}

// The unit as UDUNITS, which CF requires, reads it: names of other standards mean something else there, or nothing.
std::string lengthUnit(const Crs& crs) {
  const double metres = metresPerUnit(crs);
  if (metres == 1.0) return "m";
  if (metres == 0.3048) return "foot";
  if (std::abs(metres * 3937.0 / 1200.0 - 1.0) < 1e-12) return "US_survey_foot";
  char text[40];
  std::snprintf(text, sizeof text, "%.17g m", metres);
  return text;
}

// Keeps the values of each variable from its definition until all are defined, since NetCDF accepts values only then.
class UgridFile {
 public:
  UgridFile(const Grid& grid, const std::string& path, bool large)
      : file_(path, large), crs_name_(grid.crs.isPlane() ? "" : crsVariableName(grid.crs)) {}

  NetcdfWriter& file() { return file_; }
  int dimension(const std::string& name, std::size_t length) { return file_.dimension(name, length); }

  // For short arrays and text: `close` calls `values`.
  template <typename Values>
  void put(int variable, Values&& values) {
    puts_.push_back([this, variable, values = std::forward<Values>(values)] {
      const auto made = values();
      file_.put(variable, made.data());
    });
  }
  // For arrays as long as the mesh: values are made one by one, never as an array of their own.
  template <typename ValueOf>
  void putEach(int variable, std::size_t count, ValueOf&& valueOf) {
    file_.putLater(variable, count, std::forward<ValueOf>(valueOf));
  }

  // Defines a variable of the mesh and its values.
  template <typename Values>
  int data(const std::string& name, int type, int dimension, const std::string& location, const std::string& long_name,
           const std::string& units, Values&& values) {
    const int variable = define(name, type, dimension, location, long_name, units);
    put(variable, std::forward<Values>(values));
    return variable;
  }
  template <typename ValueOf>
  int dataOfEach(const std::string& name, int dimension, const std::string& location, const std::string& long_name,
                 const std::string& units, std::size_t count, ValueOf&& valueOf) {
    const int type = std::is_same_v<decltype(valueOf(count)), double> ? NC_DOUBLE : NC_INT;
    const int variable = define(name, type, dimension, location, long_name, units);
    putEach(variable, count, std::forward<ValueOf>(valueOf));
    return variable;
  }

  int define(const std::string& name, int type, int dimension, const std::string& location,
             const std::string& long_name, const std::string& units) {
    const int variable = file_.variable("mesh2d_" + name, type, {dimension});
    file_.attribute(variable, "mesh", "mesh2d");
    file_.attribute(variable, "location", location);
    file_.attribute(variable, "long_name", long_name);
    if (!units.empty()) file_.attribute(variable, "units", units);
    if (!crs_name_.empty() && (location == "node" || location == "face" || location == "edge"))
      file_.attribute(variable, "grid_mapping", crs_name_);
    return variable;
  }

  template <typename Rows>
  void connectivity(const std::string& of, const std::vector<int>& dimensions, const Rows& rows) {
    const int variable = defineConnectivity(of, dimensions);
    if (rows.empty()) return;
    const std::size_t width = rows.front().size();
    putEach(variable, rows.size() * width, [&rows, width](std::size_t i) {
      return static_cast<std::int32_t>(rows[i / width][i % width]) + kStartIndex;
    });
  }

  // REQUIRES: there are quadrilaterals, and `elements` outlive the writing.
  void mixedFaces(const std::vector<int>& dimensions, const Elements& elements) {
    putEach(defineConnectivity("face", dimensions), elements.size() * 4, [&elements](std::size_t i) {
      const Elements::Nodes nodes = elements.nodesOf(i / 4);
      return i % 4 < nodes.count ? static_cast<std::int32_t>(nodes.v[i % 4]) + kStartIndex : kFillNode;
    });
  }

  // Writes names as rows of characters.
  void names(const std::string& name, int dimension, const std::string& long_name,
             const std::vector<std::string>& texts) {
    std::size_t longest = 1;
    for (const std::string& text : texts) longest = std::max(longest, text.size());
    const int length = file_.dimension("mesh2d_" + name + "_length", longest);
    const int variable = file_.variable("mesh2d_" + name, NC_CHAR, {dimension, length});
    file_.attribute(variable, "long_name", long_name);
    file_.attribute(variable, "_Encoding", "utf-8");
    put(variable, [texts, longest] {
      std::string all;
      for (const std::string& text : texts) all += text + std::string(longest - text.size(), '\0');
      return all;
    });
  }

  // Gives the values 1, 2, … of a variable their meanings, in which CF allows no blanks.
  void flags(int variable, const std::vector<std::string>& meanings) {
    std::vector<int> values;
    std::string words;
    for (const std::string& meaning : meanings) {
      values.push_back(static_cast<int>(values.size()) + 1);
      std::string word = meaning;
      std::ranges::replace_if(
          word, [](unsigned char c) { return c <= ' '; }, '_');
      words += (words.empty() ? "" : " ") + word;
    }
    file_.attribute(variable, "flag_values", values);
    file_.attribute(variable, "flag_meanings", words);
  }

  void close(const ItemLoop& loop) {
    file_.endDefinitions();
    for (const auto& put : puts_) put();
    file_.close(loop);
  }

 private:
  int defineConnectivity(const std::string& of, const std::vector<int>& dimensions) {
    const int variable = file_.variable("mesh2d_" + of + "_nodes", NC_INT, dimensions);
    file_.attribute(variable, "cf_role", of + "_node_connectivity");
    file_.attribute(variable, "long_name", "nodes of each " + of);
    file_.attribute(variable, "start_index", kStartIndex);
    file_.attribute(variable, "_FillValue", kFillNode);
    return variable;
  }

  NetcdfWriter file_;
  std::string crs_name_;
  std::vector<std::function<void()>> puts_;
};

void defineCoordinate(UgridFile& ugrid, const Grid& grid, int nodes, bool is_x) {
  const Crs& crs = grid.crs;
  const int variable = ugrid.file().variable(is_x ? "mesh2d_node_x" : "mesh2d_node_y", NC_DOUBLE, {nodes});
  const auto attribute = [&](const char* name, const std::string& text) {
    ugrid.file().attribute(variable, name, text);
  };
  if (crs.geographic) {
    attribute("units", is_x ? "degrees_east" : "degrees_north");
    attribute("standard_name", is_x ? "longitude" : "latitude");
    attribute("long_name", is_x ? "longitude of the nodes" : "latitude of the nodes");
  } else {
    attribute("units", lengthUnit(crs));
    attribute("standard_name", is_x ? "projection_x_coordinate" : "projection_y_coordinate");
    attribute("long_name", is_x ? "x of the nodes" : "y of the nodes");
  }
  attribute("mesh", "mesh2d");
  attribute("location", "node");
  if (!crs.isPlane()) attribute("grid_mapping", crsVariableName(crs));
  ugrid.putEach(variable, grid.nodes.size(),
                [&grid, part = is_x ? &Point::x : &Point::y](std::size_t n) { return grid.nodes[n].*part; });
}

// Values that are not known are the fill value, and one equal to it is its neighbouring double, as for elevations.
void defineFields(UgridFile& ugrid, const Grid& grid, int nodes) {
  for (const NodeField& field : grid.node_fields) {
    const FieldName* const known = findFieldName(field.name);
    const std::string long_name = known != nullptr ? std::string(known->long_name) : titleOf(field);
    const auto valueOf = [&field](std::size_t n) {
      if (std::isnan(field.values[n])) return kFillZ;
      return field.values[n] == kFillZ ? std::nextafter(kFillZ, 0.0) : field.values[n];
    };
    const int variable = ugrid.dataOfEach("node_" + variableWordOf(field), nodes, "node", long_name, field.unit,
                                          field.values.size(), valueOf);
    if (known != nullptr && !known->standard_name.empty())
      ugrid.file().attribute(variable, "standard_name", std::string(known->standard_name));
    ugrid.file().attribute(variable, "_FillValue", kFillZ);
    ugrid.file().attribute(variable, "nodal_attribute", field.name);
    if (field.component > 0)
      ugrid.file().attribute(variable, "nodal_attribute_value", static_cast<int>(field.component));
    if (!std::isnan(field.usual)) ugrid.file().attribute(variable, "nodal_attribute_default", field.usual);
  }
}

void defineNodes(UgridFile& ugrid, const Grid& grid, int nodes) {
  defineCoordinate(ugrid, grid, nodes, true);
  defineCoordinate(ugrid, grid, nodes, false);
  if (!grid.z.empty()) {
    // An elevation equal to the fill value would be read as missing; its neighbouring double is used instead.
    const auto zOf = [&grid](std::size_t n) {
      if (std::isnan(grid.z[n])) return kFillZ;
      return grid.z[n] == kFillZ ? std::nextafter(kFillZ, 0.0) : grid.z[n];
    };
    const int z = ugrid.dataOfEach("node_z", nodes, "node", "elevation of the nodes", "m", grid.z.size(), zOf);
    ugrid.file().attribute(z, "standard_name", "altitude");
    ugrid.file().attribute(z, "positive", "up");
    ugrid.file().attribute(z, "_FillValue", kFillZ);
  }
  if (!grid.size_m.empty())
    ugrid.dataOfEach("node_size", nodes, "node", "length that edges were to have", "m", grid.size_m.size(),
                     [&grid](std::size_t n) { return grid.size_m[n]; });
  defineFields(ugrid, grid, nodes);
}

// `value(b)` for each edge of each boundary b.
template <typename T, typename Value>
std::vector<T> ofBoundaryEdges(const Grid& grid, Value&& value) {
  std::vector<T> values;
  for (std::size_t b = 0; b < grid.boundaries.size(); ++b)
    values.insert(values.end(), edgesOf(grid.boundaries[b]).size(), static_cast<T>(value(b)));
  return values;
}

void defineBoundaryNames(UgridFile& ugrid, const Grid& grid) {
  std::vector<std::string> names;
  for (const Boundary& boundary : grid.boundaries) names.push_back(boundary.name);
  if (std::ranges::all_of(names, &std::string::empty)) return;
  ugrid.names("boundary_name", ugrid.dimension("mesh2d_nBoundaries", names.size()), "names of the boundaries", names);
}

void defineBoundaries(UgridFile& ugrid, const Grid& grid, int two, const std::vector<NodePair>& edges) {
  if (edges.empty()) return;
  const int dimension = ugrid.dimension("mesh2d_nBoundaryEdges", edges.size());
  ugrid.connectivity("boundary", {dimension, two}, edges);
  ugrid.data("boundary_number", NC_INT, dimension, "boundary", "boundary that the edge belongs to, from 1", {},
             [&grid] { return ofBoundaryEdges<int>(grid, [](std::size_t b) { return b + 1; }); });
  const int role = ugrid.data("boundary_role", NC_BYTE, dimension, "boundary", "role of the edge", {}, [&grid] {
    return ofBoundaryEdges<signed char>(grid, [&](std::size_t b) { return grid.boundaries[b].role; });
  });
  ugrid.file().attribute(role, "flag_values", std::vector<signed char>{0, 1, 2, 3});
  ugrid.file().attribute(role, "flag_meanings", "land island open river");
  defineBoundaryNames(ugrid, grid);
  if (std::ranges::none_of(grid.boundaries, [](const Boundary& boundary) { return boundary.ibtype >= 0; })) return;
  const int type = ugrid.data(
      "boundary_ibtype", NC_INT, dimension, "boundary", "ADCIRC's type of the edge", {},
      [&grid] { return ofBoundaryEdges<int>(grid, [&](std::size_t b) { return grid.boundaries[b].ibtype; }); });
  ugrid.file().attribute(type, "_FillValue", kNoIbtype);
}

// True if fids are written as int, for programs that read no wider integers; else they are written as double.
bool fidsFitInt(const Grid& grid) {
  return std::ranges::all_of(grid.features, [](const GridFeature& feature) {
    return feature.fid > std::numeric_limits<int>::min() && feature.fid <= std::numeric_limits<int>::max();
  });
}

void defineRegions(UgridFile& ugrid, const Grid& grid, const Elements& elements, int faces) {
  const std::vector<std::string> names = regionNames(grid);
  if (names.empty() || grid.feature_of.empty()) return;
  const int region =
      ugrid.dataOfEach("region", faces, "face", "region that the face lies in, 0 in none", {}, elements.size(),
                       [&grid, &elements, numbers = regionNumbers(grid, names)](std::size_t face) {
                         return std::int32_t{numbers[grid.feature_of[elements.triangleOf(face)]]};
                       });
  ugrid.flags(region, names);
  ugrid.names("region_name", ugrid.dimension("mesh2d_nRegions", names.size()), "names of the regions", names);
}

// The name and the source of each feature, and its number for each face, as fids may repeat. Nothing for features
// without names from one source, whose fids tell them apart.
void defineFeatureNames(UgridFile& ugrid, const Grid& grid, const Elements& elements, int faces) {
  std::vector<std::string> names, sources;
  for (const GridFeature& feature : grid.features) {
    names.emplace_back(nameOf(feature.attributes));
    sources.push_back(feature.source);
  }
  const auto allEmpty = [](const std::vector<std::string>& texts) {
    return std::ranges::all_of(texts, &std::string::empty);
  };
  const bool several = std::ranges::adjacent_find(sources, std::not_equal_to()) != sources.end();
  if (grid.feature_of.empty() || (allEmpty(names) && !several)) return;
  ugrid.dataOfEach("feature_number", faces, "face",
                   "number of the source feature in the tables of names and sources, from 1", {}, elements.size(),
                   [&grid, &elements](std::size_t face) {
                     return static_cast<std::int32_t>(grid.feature_of[elements.triangleOf(face)]) + 1;
                   });
  const int features = ugrid.dimension("mesh2d_nFeatures", names.size());
  if (!allEmpty(names)) ugrid.names("feature_name", features, "names of the source features", names);
  if (!allEmpty(sources)) ugrid.names("feature_source", features, "files of the source features", sources);
}

// REQUIRES: `elements` outlive the writing.
void defineFaces(UgridFile& ugrid, const Grid& grid, const Elements& elements, int faces) {
  const auto data = [&](const std::string& name, const std::string& long_name, const std::string& units,
                        const auto& valueOf) {
    ugrid.dataOfEach(name, faces, "face", long_name, units, elements.size(),
                     [&elements, valueOf](std::size_t face) { return valueOf(elements.triangleOf(face)); });
  };
  if (!grid.min_angle_deg.empty())
    data("min_angle", "smallest angle", "degree", [&grid](std::size_t t) { return grid.min_angle_deg[t]; });
  if (!grid.area_m2.empty())
    ugrid.dataOfEach("area", faces, "face", "area", "m2", elements.size(),
                     [&grid, &elements](std::size_t face) { return elements.sumOver(face, grid.area_m2); });
  if (!grid.feature_of.empty()) {
    const auto fidOf = [&grid](std::size_t t) { return grid.features[grid.feature_of[t]].fid; };
    const std::string what = "fid of the source feature";
    if (fidsFitInt(grid)) {
      data("feature", what, {}, [fidOf](std::size_t t) { return static_cast<std::int32_t>(fidOf(t)); });
    } else {
      data("feature", what, {}, [fidOf](std::size_t t) { return static_cast<double>(fidOf(t)); });
    }
  }
  defineFeatureNames(ugrid, grid, elements, faces);
  defineRegions(ugrid, grid, elements, faces);
  if (!grid.piece_of.empty())
    data("piece", "piece that the face was refined in, from 1", {},
         [&grid](std::size_t t) { return static_cast<std::int32_t>(grid.piece_of[t]) + 1; });
  if (!grid.part_of.empty())
    data("partition", "process of a solver that the face belongs to, from 0", {},
         [&grid](std::size_t t) { return static_cast<std::int32_t>(grid.part_of[t]); });
}

void defineLines(UgridFile& ugrid, const Grid& grid, int edge_dimension, std::span<const NodePair> edges) {
  if (grid.lines.empty()) return;
  const int number = ugrid.data(
      "edge_line", NC_INT, edge_dimension, "edge", "line that the edge belongs to, 0 to none", {}, [&grid, edges] {
        std::vector<int> numbers(edges.size(), 0);
        for (std::size_t i = grid.lines.size(); i-- > 0;) {
          for (const auto& [a, b] : edgesOf(grid.lines[i])) {
            const auto at = std::ranges::lower_bound(edges, NodePair{std::min(a, b), std::max(a, b)});
            numbers[static_cast<std::size_t>(at - edges.begin())] = static_cast<int>(i) + 1;
          }
        }
        return numbers;
      });
  std::vector<std::string> names, meanings;
  for (const GridLine& line : grid.lines) {
    names.push_back(line.name);
    meanings.push_back(std::string(toString(line.kind)) + (line.name.empty() ? "" : ' ' + line.name));
  }
  ugrid.flags(number, meanings);
  const int lines = ugrid.dimension("mesh2d_nLines", grid.lines.size());
  const int kind = ugrid.file().variable("mesh2d_line_kind", NC_BYTE, {lines});
  ugrid.file().attribute(kind, "long_name", "what the line is");
  ugrid.file().attribute(kind, "flag_values", std::vector<signed char>{0, 1, 2});
  ugrid.file().attribute(kind, "flag_meanings", "constraint weir region_border");
  ugrid.put(kind, [&grid] {
    std::vector<signed char> kinds;
    for (const GridLine& line : grid.lines) kinds.push_back(static_cast<signed char>(line.kind));
    return kinds;
  });
  ugrid.names("line_name", lines, "names of the lines", names);
}

void defineTopology(UgridFile& ugrid, bool quads, bool with_boundaries) {
  NetcdfWriter& file = ugrid.file();
  const int mesh = file.variable("mesh2d", NC_INT, {});
  file.attribute(mesh, "cf_role", "mesh_topology");
  file.attribute(mesh, "long_name",
                 quads ? "topology of the mesh of triangles and quadrilaterals" : "topology of the triangle mesh");
  file.attribute(mesh, "topology_dimension", 2);
  file.attribute(mesh, "node_coordinates", "mesh2d_node_x mesh2d_node_y");
  file.attribute(mesh, "node_dimension", "mesh2d_nNodes");
  file.attribute(mesh, "edge_dimension", "mesh2d_nEdges");
  file.attribute(mesh, "face_dimension", "mesh2d_nFaces");
  file.attribute(mesh, "max_face_nodes_dimension", "mesh2d_nMax_face_nodes");
  file.attribute(mesh, "face_node_connectivity", "mesh2d_face_nodes");
  file.attribute(mesh, "edge_node_connectivity", "mesh2d_edge_nodes");
  if (with_boundaries) file.attribute(mesh, "boundary_node_connectivity", "mesh2d_boundary_nodes");
  ugrid.put(mesh, [] { return std::array{0}; });
}

// Every edge once, in the order of `uniqueEdges`; diagonals of quadrilaterals are none.
BulkList<NodePair> edgesOfElements(const Grid& grid, const ItemLoop& loop) {
  BulkList<NodePair> edges = uniqueEdges(grid.nodes.size(), grid.triangles, loop);
  const std::vector<NodePair> diagonals = diagonalEdges(grid);
  if (!diagonals.empty())
    std::erase_if(edges, [&](const NodePair& edge) { return std::ranges::binary_search(diagonals, edge); });
  return edges;
}

// Writes UGRID-1.0 NetCDF (64-bit offset; CDF-5 above its limit of 4 GiB per array) as MDAL, xugrid and D-FlowFM read
// it: mesh topology `mesh2d` with face_nodes, edge_nodes and the boundary's edges, the CRS in
// `projected_coordinate_system` or `wgs84`, elevation, smallest angle, area and source fid as data. A node without z
// has the fill value -999. Throws OutputError.
void writeUgrid(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  const Elements elements(grid);
  const auto edges = edgesOfElements(grid, loop);
  std::vector<NodePair> boundary_edges;
  for (const Boundary& boundary : grid.boundaries)
    for (const NodePair& edge : edgesOf(boundary)) boundary_edges.push_back(edge);
  constexpr std::size_t kLargest = 4'000'000'000;  // bytes of an array in a 64-bit offset file, with some to spare
  const std::size_t bytes =
      std::max({elements.size() * (elements.quads() > 0 ? 16 : 12), grid.nodes.size() * 8, edges.size() * 8});
  UgridFile ugrid(grid, path, bytes > kLargest);
  NetcdfWriter& file = ugrid.file();
  file.attribute(NC_GLOBAL, "Conventions", "CF-1.8 UGRID-1.0");
  if (!grid.title.empty()) file.attribute(NC_GLOBAL, "title", grid.title);
  file.attribute(NC_GLOBAL, "source", "coastmesh");
  const int node_dim = ugrid.dimension("mesh2d_nNodes", grid.nodes.size());
  const int edge_dim = ugrid.dimension("mesh2d_nEdges", edges.size());
  const int face_dim = ugrid.dimension("mesh2d_nFaces", elements.size());
  const int corner_dim = ugrid.dimension("mesh2d_nMax_face_nodes", elements.quads() > 0 ? 4 : 3);
  const int two_dim = ugrid.dimension("Two", 2);

  defineTopology(ugrid, elements.quads() > 0, !boundary_edges.empty());
  if (!grid.crs.isPlane()) {
    const int crs = defineCrs(file, grid.crs);
    ugrid.put(crs, [&grid] { return std::array{epsgOf(grid.crs)}; });
  }
  defineNodes(ugrid, grid, node_dim);
  if (elements.quads() > 0)
    ugrid.mixedFaces({face_dim, corner_dim}, elements);
  else
    ugrid.connectivity("face", {face_dim, corner_dim}, grid.triangles);
  ugrid.connectivity("edge", {edge_dim, two_dim}, edges);
  defineBoundaries(ugrid, grid, two_dim, boundary_edges);
  defineFaces(ugrid, grid, elements, face_dim);
  defineLines(ugrid, grid, edge_dim, edges);
  ugrid.close(loop);
}

}  // namespace

FormatRecord ugridFormat() {
  return {{.name = "ugrid",
           .endings = {".nc"},
           .description = "UGRID NetCDF for QGIS, xugrid and D-FlowFM (_net.nc)",
           .readable = true,
           .writable = true,
           .holds = {GridPart::Title, GridPart::Quads, GridPart::Sizes, GridPart::Features, GridPart::Regions,
                     GridPart::Pieces, GridPart::Partition, GridPart::Lines, GridPart::LineNames, GridPart::Rivers,
                     GridPart::Ibtypes, GridPart::BareWeirs, GridPart::PartIslands, GridPart::FeatureNames,
                     GridPart::BoundaryNames, GridPart::NodeFields},
           .places = NodePlaces::OneTurn},
          {writeUgrid, readUgrid, nullptr, nullptr, depthRemark}};
}

}  // namespace coastmesh
