// NetCDF meshes of other programs, and error messages for those that cannot be read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netcdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "gis/error.hpp"
#include "gis/format/grid_io.hpp"
#include "tests/gis/format/read_grid.hpp"
#include "tests/gis/quad_samples.hpp"
#include "tests/support/bulk_lists.hpp"

namespace coastmesh {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

class ReadNetcdfGrid : public ReadGrid {};

// A variable at the nodes of a UGRID file, with values 1, 2, 3 and 4, and 10 more for each further time. Empty
// attributes are omitted.
struct NodeVariable {
  std::string name, standard_name, positive, location = "node";
  std::size_t times = 0;
  std::string of_times = "time";  // the name of their dimension
  bool on_faces = false;
};

// A UGRID file of another program: other names, indices from 0, transposed, depth positive down, and a fourth column
// for quads, which is empty unless `quad`.
class Ugrid {
 public:
  Ugrid(const std::string& path, bool quad, const std::vector<NodeVariable>& depths = {{"depth", "altitude", "down"}}) {
    nc_create(path.c_str(), NC_NETCDF4 | NC_CLOBBER, &id_);
    int nodes = 0, faces = 0, corners = 0;
    nc_def_dim(id_, "n", 4, &nodes);
    nc_def_dim(id_, "f", 2, &faces);
    nc_def_dim(id_, "max", 4, &corners);
    const int mesh = variable("Topology", NC_INT, {});
    text(mesh, "cf_role", "mesh_topology");
    const int two = 2, start = 0, fill = -1;
    nc_put_att_int(id_, mesh, "topology_dimension", NC_INT, 1, &two);
    text(mesh, "node_coordinates", "lat lon");
    text(mesh, "face_node_connectivity", "conn");
    text(mesh, "face_dimension", "f");
    const int lat = variable("lat", NC_FLOAT, {nodes}), lon = variable("lon", NC_DOUBLE, {nodes});
    text(lat, "standard_name", "latitude");
    text(lon, "standard_name", "longitude");
    std::vector<int> depth_ids;
    for (const auto& [name, standard_name, positive, location, times, of_times, on_faces] : depths) {
      std::vector<int> dimensions{on_faces ? faces : nodes};
      if (times > 0) nc_def_dim(id_, of_times.c_str(), times, &*dimensions.insert(dimensions.begin(), 0));
      depth_ids.push_back(variable(name.c_str(), NC_DOUBLE, dimensions));
      if (!standard_name.empty()) text(depth_ids.back(), "standard_name", standard_name);
      if (!location.empty()) text(depth_ids.back(), "mesh", "Topology");
      if (!location.empty()) text(depth_ids.back(), "location", location);
      if (!positive.empty()) text(depth_ids.back(), "positive", positive);
    }
    const int conn = variable("conn", NC_INT64, {corners, faces});
    nc_put_att_int(id_, conn, "start_index", NC_INT, 1, &start);
    const long long no_node = fill;
    nc_put_att_longlong(id_, conn, "_FillValue", NC_INT64, 1, &no_node);
    nc_enddef(id_);
    const double y[] = {50, 50, 51, 51}, x[] = {5, 6, 6, 5};
    const double z[] = {1, 2, 3, 4, 11, 12, 13, 14, 21, 22, 23, 24};
    nc_put_var_double(id_, lat, y);
    nc_put_var_double(id_, lon, x);
    for (const int depth : depth_ids) nc_put_var_double(id_, depth, z);
    const int columns[] = {0, 0, 1, 2, 2, 3, -1, quad ? 1 : -1};
    nc_put_var_int(id_, conn, columns);
    nc_close(id_);
  }

  // One face with six nodes.
  static void writeHexagon(const std::string& path) {
    int id = 0, nodes = 0, faces = 0, mesh = 0, x = 0, y = 0, conn = 0;
    nc_create(path.c_str(), NC_NETCDF4 | NC_CLOBBER, &id);
    nc_def_dim(id, "nodes", 6, &nodes);
    nc_def_dim(id, "faces", 1, &faces);
    nc_def_var(id, "mesh", NC_INT, 0, nullptr, &mesh);
    const std::vector<std::pair<const char*, std::string>> texts{{"cf_role", "mesh_topology"},
                                                                 {"topology_dimension", "2"},
                                                                 {"node_coordinates", "x y"},
                                                                 {"face_node_connectivity", "conn"}};
    for (const auto& [name, text] : texts) nc_put_att_text(id, mesh, name, text.size(), text.c_str());
    nc_def_var(id, "x", NC_DOUBLE, 1, &nodes, &x);
    nc_def_var(id, "y", NC_DOUBLE, 1, &nodes, &y);
    const int shape[] = {faces, nodes};
    nc_def_var(id, "conn", NC_INT, 2, shape, &conn);
    nc_enddef(id);
    const double xs[] = {0, 2, 3, 2, 0, -1}, ys[] = {0, 0, 1, 2, 2, 1};
    const int face[] = {0, 1, 2, 3, 4, 5};
    nc_put_var_double(id, x, xs);
    nc_put_var_double(id, y, ys);
    nc_put_var_int(id, conn, face);
    nc_close(id);
  }

 private:
  int variable(const char* name, nc_type type, const std::vector<int>& dimensions) {
    int variable_id = 0;
    nc_def_var(id_, name, type, static_cast<int>(dimensions.size()), dimensions.data(), &variable_id);
    return variable_id;
  }
  void text(int variable_id, const char* name, const std::string& value) {
    nc_put_att_text(id_, variable_id, name, value.size(), value.data());
  }

  int id_ = 0;
};

TEST_F(ReadNetcdfGrid, UgridOfOtherPrograms) {
  const Ugrid file(folder_ / "other.nc", false);
  const Grid grid = readGrid(folder_ / "other.nc");
  EXPECT_EQ(grid.nodes, (std::vector<Point>{{5, 50}, {6, 50}, {6, 51}, {5, 51}}));
  EXPECT_EQ(grid.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(grid.z, (std::vector<double>{-1, -2, -3, -4}));
  EXPECT_EQ(grid.crs.authority, "EPSG:4326");
}

TEST_F(ReadNetcdfGrid, UgridDepthsOfModels) {
  const std::vector<double> down{-1, -2, -3, -4}, up{1, 2, 3, 4}, none;
  const std::vector<std::pair<NodeVariable, std::vector<double>>> cases{
      {{"Mesh2_depth", "sea_floor_depth_below_geoid", "down"}, down},
      {{"h", "sea_floor_depth_below_geoid", "", ""}, down},  // FVCOM
      {{"zb", "sea_floor_depth_below_mean_sea_level", ""}, down},
      {{"zb", "sea_floor_depth_below_reference_ellipsoid", "up"}, up},
      {{"zb", "bedrock_altitude", ""}, up},
      {{"zb", "surface_altitude", "up"}, up},
      {{"depth", "", ""}, down},  // SCHISM
      {{"z", "depth", ""}, down},
      {{"depth", "depth below geoid", ""}, down},  // ADCIRC
      {{"Topology_node_z", "", ""}, up},           // D-Flow FM
      {{"NetNode_z", "", "up"}, up},
      {{"Bathymetry", "", "down"}, down},
      {{"salinity", "", ""}, none},
      {{"depth", "sea_water_temperature", ""}, none},
      {{"depth", "sea_floor_depth_below_geoid", "down", "face"}, none},
  };
  for (const auto& [variable, z] : cases) {
    const Ugrid file(folder_ / "depth.nc", false, {variable});
    EXPECT_EQ(readGrid(folder_ / "depth.nc").z, z) << variable.name << ", " << variable.standard_name;
    EXPECT_EQ(remarkOnGrid(folder_ / "depth.nc"), "");
  }
}

// Morphological models write the bed at every time; depths of one time are as good as those of none.
TEST_F(ReadNetcdfGrid, UgridDepthsOfTheFirstTime) {
  const std::string path = folder_ / "times.nc";
  const std::vector<double> up{1, 2, 3, 4}, none;
  const auto read = [&](const NodeVariable& variable) {
    const Ugrid file(path, false, {variable});
    return readGrid(path).z;
  };
  EXPECT_EQ(read({"Topology_bed_level", "", "up", "node", 3}), up);
  EXPECT_EQ(remarkOnGrid(path),
            "'" + path + "': depths are taken from \"Topology_bed_level\" at the first of its 3 times");
  EXPECT_EQ(read({"zb", "altitude", "", "node", 1, "nTime"}), up);
  EXPECT_EQ(read({"zb", "altitude", "", "node", 1}), up);
  EXPECT_EQ(remarkOnGrid(path), "");
  EXPECT_EQ(read({"elevation", "", "", "node", 3}), none);  // the water's, as of SCHISM
  EXPECT_EQ(read({"zb", "altitude", "", "node", 2, "layer"}), none);
}

TEST_F(ReadNetcdfGrid, UgridDepthsOfNoTimeComeFirst) {
  const Ugrid file(folder_ / "both.nc", false, {{"zb", "altitude", "", "node", 2}, {"depth", "", ""}});
  EXPECT_EQ(readGrid(folder_ / "both.nc").z, (std::vector<double>{-1, -2, -3, -4}));
  EXPECT_THAT(remarkOnGrid(folder_ / "both.nc"), HasSubstr("from \"depth\", not from \"zb\""));
}

TEST_F(ReadNetcdfGrid, UgridDepthsOnFacesAreNamed) {
  // D-Flow FM has the depth of the water at each time too.
  const Ugrid file(folder_ / "faces.nc", false,
                   {{"Topology_waterdepth", "sea_floor_depth_below_sea_surface", "", "face", 2, "time", true},
                    {"Topology_flowelem_bl", "altitude", "", "face", 0, "", true}});
  EXPECT_EQ(readGrid(folder_ / "faces.nc").z, std::vector<double>());
  EXPECT_THAT(remarkOnGrid(folder_ / "faces.nc"), HasSubstr("depths on faces, \"Topology_flowelem_bl\""));
}

// Missing corners as NaN among reals, as xarray writes them, and as the library's fill value; 50.1 in single precision.
TEST_F(ReadNetcdfGrid, UgridWithMissingCornersOfAnyKind) {
  const auto write = [&](nc_type type, double missing) {
    int id = 0, nodes = 0, faces = 0, corners = 0, mesh = 0, x = 0, y = 0, of_faces = 0;
    nc_create((folder_ / "corners.nc").c_str(), NC_NETCDF4 | NC_CLOBBER, &id);
    nc_def_dim(id, "n", 4, &nodes);
    nc_def_dim(id, "f", 2, &faces);
    nc_def_dim(id, "c", 4, &corners);
    nc_def_var(id, "mesh", NC_INT, 0, nullptr, &mesh);
    nc_def_var(id, "x", NC_FLOAT, 1, &nodes, &x);
    nc_def_var(id, "y", NC_FLOAT, 1, &nodes, &y);
    const int shape[] = {faces, corners}, two = 2;
    nc_def_var(id, "of_faces", type, 2, shape, &of_faces);
    const auto text = [&](const char* name, const std::string& value) {
      nc_put_att_text(id, mesh, name, value.size(), value.data());
    };
    text("cf_role", "mesh_topology");
    // Some programs write this as text.
    if (std::isnan(missing))
      text("topology_dimension", "2");
    else
      nc_put_att_int(id, mesh, "topology_dimension", NC_INT, 1, &two);
    text("node_coordinates", "x y");
    text("face_node_connectivity", "of_faces");
    nc_enddef(id);
    const double xs[] = {0, 1, 1, 0}, ys[] = {50.1, 50.1, 51, 51};
    const double columns[] = {0, 1, 2, missing, 0, 2, 3, missing};
    nc_put_var_double(id, x, xs);
    nc_put_var_double(id, y, ys);
    nc_put_var_double(id, of_faces, columns);
    nc_close(id);
  };
  write(NC_DOUBLE, std::numeric_limits<double>::quiet_NaN());
  const Grid grid = readGrid(folder_ / "corners.nc");
  EXPECT_EQ(grid.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(grid.nodes[1], (Point{1, 50.1}));
  write(NC_INT, NC_FILL_INT);
  EXPECT_EQ(readGrid(folder_ / "corners.nc").triangles, grid.triangles);
  write(NC_DOUBLE, 1.5);
  EXPECT_THROW(readGrid(folder_ / "corners.nc"), InputError);
}

// Sets attributes of a variable in an existing NetCDF file, as one that stores it packed has.
void packed(const std::string& path, const char* variable, double factor, double offset, const std::string& unit = "",
            double missing = 0.0) {
  int file = 0, id = 0;
  ASSERT_EQ(nc_open(path.c_str(), NC_WRITE, &file), NC_NOERR);
  ASSERT_EQ(nc_inq_varid(file, variable, &id), NC_NOERR);
  nc_redef(file);
  nc_put_att_double(file, id, "scale_factor", NC_DOUBLE, 1, &factor);
  nc_put_att_double(file, id, "add_offset", NC_DOUBLE, 1, &offset);
  if (missing != 0.0) nc_put_att_double(file, id, "missing_value", NC_DOUBLE, 1, &missing);
  if (!unit.empty()) nc_put_att_text(file, id, "units", unit.size(), unit.data());
  nc_close(file);
}

TEST_F(ReadNetcdfGrid, UgridWithPackedNumbersAndOtherUnits) {
  const std::string path = folder_ / "packed.nc";
  const Ugrid file(path, false, {{"depth", "", ""}});
  packed(path, "lon", 0.5, 100.0);
  packed(path, "depth", 2.0, 0.5, "km", 3.0);
  const Grid grid = readGrid(path);
  EXPECT_EQ(grid.nodes, (std::vector<Point>{{102.5, 50}, {103, 50}, {103, 51}, {102.5, 51}}));
  ASSERT_EQ(grid.z.size(), 4u);
  EXPECT_EQ(grid.z[0], -2500.0);
  EXPECT_EQ(grid.z[1], -4500.0);
  EXPECT_TRUE(std::isnan(grid.z[2]));
  EXPECT_EQ(grid.z[3], -8500.0);
}

void putText(const std::string& path, const char* variable, const char* attribute, const std::string& value) {
  int file = 0, id = 0;
  ASSERT_EQ(nc_open(path.c_str(), NC_WRITE, &file), NC_NOERR);
  ASSERT_EQ(nc_inq_varid(file, variable, &id), NC_NOERR);
  nc_redef(file);
  ASSERT_EQ(nc_put_att_text(file, id, attribute, value.size(), value.data()), NC_NOERR);
  nc_close(file);
}

// The file names latitudes first.
TEST_F(ReadNetcdfGrid, UgridCoordinatesAreToldApartByCf) {
  const std::vector<Point> places{{5, 50}, {6, 50}, {6, 51}, {5, 51}};
  const std::string path = folder_ / "other.nc";
  for (const auto& [attribute, of_lat, of_lon] :
       {std::array{"units", "degrees_north", "degrees_east"}, std::array{"units", "degree_N", "degree_E"},
        std::array{"axis", "Y", "X"}}) {
    const Ugrid file(path, false);
    for (const char* variable : {"lat", "lon"}) putText(path, variable, "standard_name", "");
    putText(path, "lat", attribute, of_lat);
    putText(path, "lon", attribute, of_lon);
    EXPECT_EQ(readGrid(path).nodes, places) << of_lat;
  }
}

TEST_F(ReadNetcdfGrid, UgridCoordinatesInOtherUnits) {
  const std::string path = folder_ / "other.nc";
  {
    const Ugrid file(path, false);
    for (const char* variable : {"lat", "lon"}) packed(path, variable, 0.01, 0.0, "radians");
    const Grid grid = readGrid(path);
    EXPECT_TRUE(grid.crs.geographic);
    EXPECT_NEAR(grid.nodes[0].x, 2.864788975654116, 1e-9);
    EXPECT_NEAR(grid.nodes[0].y, 28.64788975654116, 1e-9);
  }
  const auto projected = [&](const std::string& units, const std::string& code) {
    const Ugrid file(path, false);
    putText(path, "lat", "standard_name", "projection_y_coordinate");
    putText(path, "lon", "standard_name", "projection_x_coordinate");
    for (const char* variable : {"lat", "lon"}) putText(path, variable, "units", units);
    putText(path, "lon", "grid_mapping", "Topology");
    putText(path, "Topology", "EPSG_code", code);
    return readGrid(path).nodes[0];
  };
  EXPECT_EQ(projected("km", "EPSG:28992"), (Point{5000, 50000}));
  EXPECT_EQ(projected("m", "EPSG:28992"), (Point{5, 50}));
  EXPECT_EQ(projected("m", "EPSG:2225"), (Point{5, 50}));  // in feet, as the CRS says
}

TEST_F(ReadNetcdfGrid, UgridDepthsAreLengths) {
  const std::string path = folder_ / "pressure.nc";
  const Ugrid file(path, false, {{"h", "", ""}});
  packed(path, "h", 1.0, 0.0, "dbar");
  EXPECT_EQ(readGrid(path).z, std::vector<double>());
}

// Standard names take precedence over variable names, altitudes over depths; other candidates are named.
TEST_F(ReadNetcdfGrid, UgridWithSeveralDepths) {
  const Ugrid file(folder_ / "depths.nc", false,
                   {{"depth", "", ""}, {"h", "sea_floor_depth", ""}, {"zb", "altitude", ""}});
  EXPECT_EQ(readGrid(folder_ / "depths.nc").z, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_THAT(remarkOnGrid(folder_ / "depths.nc"),
              AllOf(HasSubstr("depths.nc"), HasSubstr("from \"zb\", not from \"h\", \"depth\"")));
}

// Indices from 1 and one column a face, neither of which the file says.
TEST_F(ReadNetcdfGrid, OutputOfFvcom) {
  const std::string path = folder_ / "fvcom_0001.nc";
  int id = 0, nodes = 0, faces = 0, three = 0, mesh = 0, lon = 0, lat = 0, depth = 0, nv = 0;
  const auto text = [&](int variable, const char* name, const std::string& value) {
    nc_put_att_text(id, variable, name, value.size(), value.data());
  };
  nc_create(path.c_str(), NC_CLOBBER, &id);
  nc_def_dim(id, "node", 7, &nodes);
  nc_def_dim(id, "nele", 5, &faces);
  nc_def_dim(id, "three", 3, &three);
  nc_def_var(id, "fvcom_mesh", NC_INT, 0, nullptr, &mesh);
  nc_def_var(id, "lon", NC_DOUBLE, 1, &nodes, &lon);
  nc_def_var(id, "lat", NC_DOUBLE, 1, &nodes, &lat);
  nc_def_var(id, "h", NC_DOUBLE, 1, &nodes, &depth);
  const int shape[] = {three, faces};
  nc_def_var(id, "nv", NC_INT, 2, shape, &nv);
  const int two = 2;
  text(mesh, "cf_role", "mesh_topology");
  nc_put_att_int(id, mesh, "topology_dimension", NC_INT, 1, &two);
  text(mesh, "node_coordinates", "lon lat");
  text(mesh, "face_node_connectivity", "nv");
  text(lon, "standard_name", "longitude");
  text(lat, "standard_name", "latitude");
  text(depth, "standard_name", "sea_floor_depth_below_geoid");
  nc_enddef(id);
  const double x[] = {5, 6, 5.5, 6.5, 6, 7, 6.5}, y[] = {50, 50, 51, 51, 52, 52, 53}, z[] = {1, 2, 3, 4, 5, 6, 7};
  const int columns[] = {1, 2, 3, 4, 5, 2, 4, 4, 6, 6, 3, 3, 5, 5, 7};
  nc_put_var_double(id, lon, x);
  nc_put_var_double(id, lat, y);
  nc_put_var_double(id, depth, z);
  nc_put_var_int(id, nv, columns);
  nc_close(id);
  const Grid grid = readGrid(path);
  EXPECT_EQ(grid.triangles, (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}, {4, 5, 6}}));
  EXPECT_EQ(grid.z, (std::vector<double>{-1, -2, -3, -4, -5, -6, -7}));
}

TEST_F(ReadNetcdfGrid, UgridWithQuadrilaterals) {
  const Ugrid file(folder_ / "quads.nc", true);
  EXPECT_EQ(testing::elementsOf(readGrid(folder_ / "quads.nc")),
            (std::vector<std::vector<std::uint32_t>>{{0, 1, 2}, {0, 2, 3, 1}}));
}

TEST_F(ReadNetcdfGrid, UgridWithMoreNodesOfAFaceIsRefused) {
  const std::string path = folder_ / "hexagons.nc";
  Ugrid::writeHexagon(path);
  EXPECT_THAT(errorOf(path), AllOf(HasSubstr("face 1"), HasSubstr("6 nodes")));
}

// The NetCDF library would allocate what this header claims for its attributes.
TEST_F(ReadNetcdfGrid, NetcdfHeadersThatClaimTooMuchAreRefused) {
  const std::string header("CDF\x02\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x0C\x7F\xFF\xFF\xFF", 24);
  EXPECT_THAT(errorIn("damaged.nc", header), AllOf(HasSubstr("damaged.nc"), HasSubstr("claims more")));
}

}  // namespace
}  // namespace coastmesh
