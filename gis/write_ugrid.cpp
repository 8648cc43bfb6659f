#include "gis/write_ugrid.hpp"

#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "gis/boundary_chains.hpp"
#include "gis/cf_grid_mapping.hpp"
#include "gis/grid_formats.hpp"
#include "gis/mesh_edges.hpp"
#include "gis/netcdf_file.hpp"
#include "gis/ogr_support.hpp"
#include "gis/read_ugrid.hpp"

namespace coastmesh {
namespace {

constexpr int kStartIndex = 1;
constexpr int kFillNode = -999;
constexpr double kFillZ = -999.0;

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

std::string lengthUnit(const Crs& crs) {
  if (crs.isPlane()) return "m";
  const char* name = nullptr;
  const double metres = toOgr(crs).GetLinearUnits(&name);
  return metres == 1.0 || name == nullptr ? "m" : name;
}

int defineCoordinate(NetcdfWriter& file, const Crs& crs, int nodes, bool is_x) {
  const int variable = file.variable(is_x ? "mesh2d_node_x" : "mesh2d_node_y", NC_DOUBLE, {nodes});
  if (crs.geographic) {
    file.attribute(variable, "units", is_x ? "degrees_east" : "degrees_north");
    file.attribute(variable, "standard_name", is_x ? "longitude" : "latitude");
    file.attribute(variable, "long_name", is_x ? "longitude of the nodes" : "latitude of the nodes");
  } else {
    file.attribute(variable, "units", lengthUnit(crs));
    file.attribute(variable, "standard_name", is_x ? "projection_x_coordinate" : "projection_y_coordinate");
    file.attribute(variable, "long_name", is_x ? "x of the nodes" : "y of the nodes");
  }
  file.attribute(variable, "mesh", "mesh2d");
  file.attribute(variable, "location", "node");
  if (!crs.isPlane()) file.attribute(variable, "grid_mapping", crsVariableName(crs));
  return variable;
}

int defineConnectivity(NetcdfWriter& file, const std::string& of, const std::vector<int>& dimensions) {
  const int variable = file.variable("mesh2d_" + of + "_nodes", NC_INT, dimensions);
  file.attribute(variable, "cf_role", of + "_node_connectivity");
  file.attribute(variable, "long_name", "nodes of each " + of);
  file.attribute(variable, "start_index", kStartIndex);
  file.attribute(variable, "_FillValue", kFillNode);
  return variable;
}

int defineData(NetcdfWriter& file, const Crs& crs, const std::string& name, int type, int dimension,
               const std::string& location, const std::string& long_name, const std::string& units) {
  const int variable = file.variable("mesh2d_" + name, type, {dimension});
  file.attribute(variable, "mesh", "mesh2d");
  file.attribute(variable, "location", location);
  file.attribute(variable, "long_name", long_name);
  if (!units.empty()) file.attribute(variable, "units", units);
  if (!crs.isPlane()) file.attribute(variable, "grid_mapping", crsVariableName(crs));
  return variable;
}

template <std::size_t N>
std::vector<int> numbered(const std::vector<std::array<std::uint32_t, N>>& rows) {
  std::vector<int> out;
  out.reserve(N * rows.size());
  for (const auto& row : rows)
    for (std::uint32_t node : row) out.push_back(static_cast<int>(node) + kStartIndex);
  return out;
}

// The boundary's edges, which boundary each belongs to, and its role.
struct BoundaryEdges {
  std::vector<NodePair> edges;
  std::vector<int> number;
  std::vector<signed char> role;
};

BoundaryEdges boundaryEdges(const Grid& grid) {
  BoundaryEdges out;
  for (std::size_t b = 0; b < grid.boundaries.size(); ++b) {
    for (const NodePair& edge : edgesOf(grid.boundaries[b])) {
      out.edges.push_back(edge);
      out.number.push_back(static_cast<int>(b) + 1);
      out.role.push_back(static_cast<signed char>(grid.boundaries[b].role));
    }
  }
  return out;
}

// One a triangle. As int where all fit, for programs that read no wider whole numbers, else as double.
std::vector<double> fidsOf(const Grid& grid) {
  std::vector<double> fids;
  fids.reserve(grid.feature_of.size());
  for (std::uint32_t feature : grid.feature_of) fids.push_back(static_cast<double>(grid.features[feature].fid));
  return fids;
}

bool fitsInt(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) {
    return value > std::numeric_limits<int>::min() && value <= std::numeric_limits<int>::max();
  });
}

}  // namespace

void writeUgrid(const Grid& grid, const std::string& path) {
  const Crs& crs = grid.crs;
  const auto edges = uniqueEdges(grid.nodes.size(), grid.triangles);
  const BoundaryEdges boundary = boundaryEdges(grid);
  const std::vector<double> fids = fidsOf(grid);
  constexpr std::size_t kLargest = 4'000'000'000;  // bytes of an array in a 64-bit offset file, some to spare
  const std::size_t bytes = std::max({grid.triangles.size() * 12, grid.nodes.size() * 8, edges.size() * 8});
  NetcdfWriter file(path, bytes > kLargest);

  file.attribute(NC_GLOBAL, "Conventions", "CF-1.8 UGRID-1.0");
  if (!grid.title.empty()) file.attribute(NC_GLOBAL, "title", grid.title);
  file.attribute(NC_GLOBAL, "source", "coastmesh");
  const int node_dim = file.dimension("mesh2d_nNodes", grid.nodes.size());
  const int edge_dim = file.dimension("mesh2d_nEdges", edges.size());
  const int face_dim = file.dimension("mesh2d_nFaces", grid.triangles.size());
  const int corner_dim = file.dimension("mesh2d_nMax_face_nodes", 3);
  const int two_dim = file.dimension("Two", 2);

  const int mesh = file.variable("mesh2d", NC_INT, {});
  file.attribute(mesh, "cf_role", "mesh_topology");
  file.attribute(mesh, "long_name", "topology of the triangle mesh");
  file.attribute(mesh, "topology_dimension", 2);
  file.attribute(mesh, "node_coordinates", "mesh2d_node_x mesh2d_node_y");
  file.attribute(mesh, "node_dimension", "mesh2d_nNodes");
  file.attribute(mesh, "edge_dimension", "mesh2d_nEdges");
  file.attribute(mesh, "face_dimension", "mesh2d_nFaces");
  file.attribute(mesh, "max_face_nodes_dimension", "mesh2d_nMax_face_nodes");
  file.attribute(mesh, "face_node_connectivity", "mesh2d_face_nodes");
  file.attribute(mesh, "edge_node_connectivity", "mesh2d_edge_nodes");
  if (!boundary.edges.empty()) file.attribute(mesh, "boundary_node_connectivity", "mesh2d_boundary_nodes");

  const int crs_variable = crs.isPlane() ? -1 : defineCrs(file, crs);
  const int x = defineCoordinate(file, crs, node_dim, true);
  const int y = defineCoordinate(file, crs, node_dim, false);
  int z = -1;
  if (!grid.z.empty()) {
    z = defineData(file, crs, "node_z", NC_DOUBLE, node_dim, "node", "elevation of the nodes", "m");
    file.attribute(z, "standard_name", "altitude");
    file.attribute(z, "positive", "up");
    file.attribute(z, "_FillValue", kFillZ);
  }
  int size = -1;
  if (!grid.size_m.empty())
    size = defineData(file, crs, "node_size", NC_DOUBLE, node_dim, "node", "length that edges were to have", "m");
  const int face_nodes = defineConnectivity(file, "face", {face_dim, corner_dim});
  const int edge_nodes = defineConnectivity(file, "edge", {edge_dim, two_dim});
  int boundary_nodes = -1, boundary_number = -1, boundary_role = -1;
  if (!boundary.edges.empty()) {
    const int boundary_dim = file.dimension("mesh2d_nBoundaryEdges", boundary.edges.size());
    boundary_nodes = defineConnectivity(file, "boundary", {boundary_dim, two_dim});
    boundary_number = defineData(file, {}, "boundary_number", NC_INT, boundary_dim, "boundary",
                                 "boundary that the edge belongs to, from 1", {});
    boundary_role = defineData(file, {}, "boundary_role", NC_BYTE, boundary_dim, "boundary", "role of the edge", {});
    file.attribute(boundary_role, "flag_values", std::vector<signed char>{0, 1, 2, 3});
    file.attribute(boundary_role, "flag_meanings", "land island open river");
  }
  int angle = -1, area = -1, feature = -1;
  if (!grid.min_angle_deg.empty())
    angle = defineData(file, crs, "min_angle", NC_DOUBLE, face_dim, "face", "smallest angle", "degree");
  if (!grid.area_m2.empty()) area = defineData(file, crs, "area", NC_DOUBLE, face_dim, "face", "area", "m2");
  if (!fids.empty())
    feature = defineData(file, crs, "feature", fitsInt(fids) ? NC_INT : NC_DOUBLE, face_dim, "face",
                         "fid of the source feature", {});
  int piece = -1;
  if (!grid.piece_of.empty())
    piece = defineData(file, crs, "piece", NC_INT, face_dim, "face", "piece that the face was refined in, from 1", {});
  file.endDefinitions();

  if (crs_variable >= 0) {
    const int epsg = epsgOf(crs);
    file.put(crs_variable, &epsg);
  }
  const int topology = 0;
  file.put(mesh, &topology);
  std::vector<double> values(grid.nodes.size());
  std::ranges::transform(grid.nodes, values.begin(), &Point::x);
  file.put(x, values.data());
  std::ranges::transform(grid.nodes, values.begin(), &Point::y);
  file.put(y, values.data());
  if (z >= 0) {
    std::ranges::transform(grid.z, values.begin(), [](double value) { return std::isnan(value) ? kFillZ : value; });
    file.put(z, values.data());
  }
  if (size >= 0) file.put(size, grid.size_m.data());
  file.put(face_nodes, numbered(grid.triangles).data());
  file.put(edge_nodes, numbered(edges).data());
  if (!boundary.edges.empty()) {
    file.put(boundary_nodes, numbered(boundary.edges).data());
    file.put(boundary_number, boundary.number.data());
    file.put(boundary_role, boundary.role.data());
  }
  if (angle >= 0) file.put(angle, grid.min_angle_deg.data());
  if (area >= 0) file.put(area, grid.area_m2.data());
  if (feature >= 0) file.put(feature, fids.data());
  if (piece >= 0) {
    std::vector<int> pieces(grid.piece_of.size());
    std::ranges::transform(grid.piece_of, pieces.begin(), [](std::uint32_t p) { return static_cast<int>(p) + 1; });
    file.put(piece, pieces.data());
  }
  file.close();
}

FormatRecord ugridFormat() {
  return {{"ugrid", {".nc"}, "UGRID NetCDF for QGIS, xugrid and D-FlowFM (_net.nc)", true, true},
          {writeUgrid, readUgrid, nullptr}};
}

}  // namespace coastmesh
