// Formats of global models: the contents of their files, read by independent code, and what is read back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netcdf.h>

#include <GeographicLib/UTMUPS.hpp>
#include <cstring>
#include <iterator>
#include <set>
#include <sstream>

#include "gis/error.hpp"
#include "gis/format/grid_io.hpp"
#include "tests/gis/globe_samples.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/bulk_lists.hpp"

namespace coastmesh {
namespace {

using testing::cross;
using testing::dot;
using ::testing::HasSubstr;
using testing::lengthOf;
using testing::octahedralGlobe;
using testing::SpaceVector;
using testing::TemporaryFolder;
using testing::vectorOf;

const auto kAll = [](const SpaceVector&) { return true; };
// All except a cap around the middle of an octant.
const auto kSea = [](const SpaceVector& middle) { return middle[0] + middle[1] + middle[2] < 4.5; };

void writeAs(const std::string& path, const Grid& grid, const std::string& format = {}) {
  StagedOutput output(path, gridFormatFor(path, format), true);
  output.write(grid);
  output.commit();
}

std::string bytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

// Every number of a file, as a list-directed READ takes them.
std::vector<double> numbersIn(const std::string& path) {
  std::istringstream text(bytesOf(path));
  std::vector<double> numbers{std::istream_iterator<double>(text), {}};
  EXPECT_TRUE(text.eof()) << path << " holds something else than numbers";
  return numbers;
}

std::vector<bool> onOneTriangleOnly(const Grid& grid) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& v : grid.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++uses[std::minmax(v[i], v[(i + 1) % 3])];
  std::vector<bool> coast(grid.nodes.size(), false);
  for (const auto& [edge, count] : uses)
    if (count == 1) coast[edge.first] = coast[edge.second] = true;
  return coast;
}

TEST(Fesom, FilesAreWhatItReads) {
  const TemporaryFolder folder;
  for (const bool closed : {true, false}) {
    Grid grid = closed ? octahedralGlobe(3, kAll) : octahedralGlobe(3, kSea);
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) grid.z.push_back(i == 0 ? 7.0 : -10.0 * static_cast<double>(i));
    writeAs(folder / "nod2d.out", grid);
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"aux3d.out", "elem2d.out", "nod2d.out"}));
    const std::vector<double> nodes = numbersIn(folder / "nod2d.out"), elements = numbersIn(folder / "elem2d.out"),
                              depths = numbersIn(folder / "aux3d.out");
    const std::size_t n = grid.nodes.size();
    ASSERT_EQ(nodes.size(), 1 + 4 * n);
    EXPECT_EQ(nodes[0], static_cast<double>(n));
    const std::vector<bool> coast = onOneTriangleOnly(grid);
    EXPECT_EQ(std::ranges::count(coast, true) == 0, closed);
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_EQ(nodes[1 + 4 * i], static_cast<double>(i + 1));
      EXPECT_EQ(nodes[2 + 4 * i], grid.nodes[i].x);
      EXPECT_EQ(nodes[3 + 4 * i], grid.nodes[i].y);
      EXPECT_EQ(nodes[4 + 4 * i], coast[i] ? 1.0 : 0.0) << i;
    }
    ASSERT_EQ(elements.size(), 1 + 3 * grid.triangles.size());
    EXPECT_EQ(elements[0], static_cast<double>(grid.triangles.size()));
    for (std::size_t t = 0; t < grid.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(elements[1 + 3 * t + i], grid.triangles[t][i] + 1.0);
    const auto levels = static_cast<std::size_t>(depths[0]);
    ASSERT_EQ(depths.size(), 1 + levels + n);
    EXPECT_EQ(depths[1], 0.0);
    for (std::size_t k = 1; k < levels; ++k) EXPECT_LT(depths[1 + k], depths[k]);
    for (std::size_t k = 2; k + 1 < levels; ++k)  // no layer is thinner than the one above
      EXPECT_LE(depths[2 + k] - depths[1 + k], depths[1 + k] - depths[k]) << k;
    EXPECT_LE(depths[levels], -6000.0);
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(depths[1 + levels + i], std::min(0.0, grid.z[i]));
    const Grid got = readGrid(folder / "nod2d.out");
    EXPECT_EQ(got.nodes, grid.nodes);
    EXPECT_EQ(got.triangles, grid.triangles);
    EXPECT_EQ(got.z.size(), n);
    EXPECT_EQ(got.z[1], grid.z[1]);
    EXPECT_TRUE(sameCrs(got.crs, wgs84()));
    EXPECT_EQ(got.boundaries.size(), closed ? 0u : 1u);
    EXPECT_TRUE(got.notes.empty());
    const std::array before{bytesOf(folder / "nod2d.out"), bytesOf(folder / "elem2d.out"),
                            bytesOf(folder / "aux3d.out")};
    writeAs(folder / "nod2d.out", got);
    EXPECT_EQ(before, (std::array{bytesOf(folder / "nod2d.out"), bytesOf(folder / "elem2d.out"),
                                  bytesOf(folder / "aux3d.out")}));
  }
}

TEST(Fesom, KeepsOpenWaterAndTakesDegreesAlone) {
  const TemporaryFolder folder;
  const Grid utm = testing::sampleGrid(parseCrs("EPSG:32616"), {448123.4, 4.8e6}, 250.0);
  writeAs(folder / "lake_nod2d.out", utm);
  const Grid got = readGrid(folder / "lake_nod2d.out");
  ASSERT_EQ(got.nodes.size(), utm.nodes.size());
  for (std::size_t i = 0; i < got.nodes.size(); ++i) {
    double lat, lon;
    GeographicLib::UTMUPS::Reverse(16, true, utm.nodes[i].x, utm.nodes[i].y, lat, lon);
    EXPECT_NEAR(got.nodes[i].x, lon, 1e-9);
    EXPECT_NEAR(got.nodes[i].y, lat, 1e-9);
  }
  const auto open = [](const Grid& grid) {
    std::vector<std::vector<std::uint32_t>> chains;
    for (const Boundary& boundary : grid.boundaries)
      if (boundary.role == BoundaryRole::Open) chains.push_back(boundary.nodes);
    return chains;
  };
  EXPECT_EQ(open(got), open(utm));
  Grid plane = utm;
  plane.crs = {};
  try {
    writeAs(folder / "plane_nod2d.out", plane);
    ADD_FAILURE() << "a plane has no longitudes";
  } catch (const OutputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("longitudes"));
  }
}

TEST(Fesom, ReadsFilesOfOthers) {
  const TemporaryFolder folder;
  const auto put = [&](const char* name, const char* text) { std::ofstream(folder / name) << text; };
  put("nod2d.out", "       4\n 1  350.0 -3.5  1\n 2  351.0 -3.5 1\n 3  351 -2.5 1\n 4 350 -2.5 1\n");
  put("elem2d.out", " 2\n 1 2 3 1\n 1 3 4 1\n");  // four columns, as in files with quadrilaterals
  put("aux3d.out", "3\n 0. 5. 10.\n 100\n 200\n -300\n 0\n");
  const Grid grid = readGrid(folder / "nod2d.out");
  EXPECT_EQ(grid.nodes, (std::vector<Point>{{350, -3.5}, {351, -3.5}, {351, -2.5}, {350, -2.5}}));
  EXPECT_EQ(grid.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(grid.z, (std::vector<double>{-100, -200, -300, 0}));
  const auto errorWith = [&](const char* name, const char* text) -> std::string {
    put(name, text);
    try {
      readGrid(folder / "nod2d.out");
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(errorWith("elem2d.out", "1\n1 2 3 4\n"), HasSubstr("elem2d.out"));
  EXPECT_THAT(errorWith("elem2d.out", "2\n1 2 3\n"), HasSubstr("elem2d.out"));
  EXPECT_THAT(errorWith("elem2d.out", "1\n1 2 5\n"), HasSubstr("there is no node 5"));
  put("elem2d.out", "2\n1 2 3\n1 3 4\n");
  EXPECT_THAT(errorWith("aux3d.out", "3\n0 5 10\n1\n2\n3\n"), HasSubstr("aux3d.out"));
  std::filesystem::remove(folder / "aux3d.out");
  EXPECT_TRUE(readGrid(folder / "nod2d.out").z.empty());
  put("nod2d.out", "4\n 1 0 0 1\n 2 1 0 1\n 4 1 1 1\n 3 0 1 1\n");
  EXPECT_EQ(readGrid(folder / "nod2d.out").notes.size(), 1u);
}

// The sections of a JIGSAW mesh file, row by row.
using Rows = std::vector<std::vector<double>>;
std::map<std::string, Rows> sectionsIn(const std::string& path) {
  std::map<std::string, Rows> sections;
  std::string name;
  std::istringstream text(bytesOf(path));
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with('#')) continue;
    if (const auto equals = line.find('='); equals != std::string::npos) {
      name = line.substr(0, equals);
      EXPECT_FALSE(sections.contains(name)) << name;
      if (name == "MSHID" || name == "NDIMS" || name == "RADII") name = line;
      sections[name].reserve(static_cast<std::size_t>(std::atol(line.c_str() + equals + 1)));
      sections["count of " + name] = {{std::atof(line.c_str() + equals + 1)}};
      continue;
    }
    std::vector<double> row;
    std::istringstream words(line);
    for (std::string word; std::getline(words, word, ';');) row.push_back(std::strtod(word.c_str(), nullptr));
    sections[name].push_back(row);
  }
  return sections;
}

TEST(Jigsaw, GlobesAreInRadians) {
  const TemporaryFolder folder;
  Grid grid = octahedralGlobe(3, kSea);
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) grid.z.push_back(-4000.0 / static_cast<double>(i + 1));
  const std::string path = folder / "sea.msh";
  writeAs(path, grid, "jigsaw");
  auto sections = sectionsIn(path);
  EXPECT_TRUE(sections.contains("MSHID=3;ELLIPSOID-MESH"));
  EXPECT_TRUE(sections.contains("NDIMS=2"));
  EXPECT_TRUE(sections.contains("RADII=6371;6371;6371"));
  for (const char* name : {"POINT", "TRIA3", "EDGE2", "VALUE"})
    EXPECT_EQ(sections["count of " + std::string(name)][0][0], static_cast<double>(sections[name].size())) << name;
  ASSERT_EQ(sections["POINT"].size(), grid.nodes.size());
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
    ASSERT_EQ(sections["POINT"][i].size(), 3u);
    EXPECT_DOUBLE_EQ(sections["POINT"][i][0], grid.nodes[i].x * M_PI / 180.0);
    EXPECT_DOUBLE_EQ(sections["POINT"][i][1], grid.nodes[i].y * M_PI / 180.0);
    EXPECT_LE(std::abs(sections["POINT"][i][1]), M_PI / 2);
    EXPECT_EQ(sections["VALUE"][i], (std::vector<double>{grid.z[i]}));
  }
  ASSERT_EQ(sections["TRIA3"].size(), grid.triangles.size());
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    const auto& [a, b, c] = grid.triangles[t];
    EXPECT_EQ(sections["TRIA3"][t], (std::vector<double>{double(a), double(b), double(c), 0.0}));
  }
  const std::vector<bool> coast = onOneTriangleOnly(grid);
  std::vector<bool> on_edges(coast.size(), false);
  for (const auto& edge : sections["EDGE2"])
    on_edges[static_cast<std::size_t>(edge[0])] = on_edges[static_cast<std::size_t>(edge[1])] = true;
  EXPECT_EQ(on_edges, coast);
  const Grid got = readGrid(path);
  ASSERT_EQ(got.nodes.size(), grid.nodes.size());
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
    EXPECT_NEAR(got.nodes[i].x, grid.nodes[i].x, 1e-13);
    EXPECT_NEAR(got.nodes[i].y, grid.nodes[i].y, 1e-13);
  }
  EXPECT_EQ(got.triangles, grid.triangles);
  EXPECT_EQ(got.z, grid.z);
  EXPECT_TRUE(sameCrs(got.crs, wgs84()));
  ASSERT_EQ(got.boundaries.size(), grid.boundaries.size());
  for (std::size_t b = 0; b < got.boundaries.size(); ++b) {
    EXPECT_EQ(got.boundaries[b].role, grid.boundaries[b].role);
    EXPECT_EQ(got.boundaries[b].nodes, grid.boundaries[b].nodes);
  }
}

TEST(Jigsaw, PlanesComeBackBitForBit) {
  for (const char* crs : {"EPSG:32616", "plane"}) {
    const TemporaryFolder folder;
    const Grid grid = testing::sampleGrid(parseCrs(crs), {448123.4, 4.8e6}, 250.0);
    const std::string path = folder / "lakes_jigsaw.msh";
    writeAs(path, grid);
    EXPECT_TRUE(sectionsIn(path).contains("MSHID=3;EUCLIDEAN-MESH"));
    const Grid got = readGrid(path);
    EXPECT_EQ(got.nodes, grid.nodes);
    EXPECT_EQ(got.z, grid.z);
    EXPECT_EQ(got.triangles, grid.triangles);
    EXPECT_TRUE(sameCrs(got.crs, grid.crs));
    ASSERT_EQ(got.boundaries.size(), grid.boundaries.size());
    for (std::size_t b = 0; b < got.boundaries.size(); ++b) {
      EXPECT_EQ(got.boundaries[b].role, grid.boundaries[b].role);
      EXPECT_EQ(got.boundaries[b].nodes, grid.boundaries[b].nodes);
    }
    const std::string before = bytesOf(path);
    writeAs(path, got);
    EXPECT_EQ(bytesOf(path), before);
  }
}

// As JIGSAW writes its own meshes, on a sphere and in a plane; Gmsh files have the same ending.
TEST(Jigsaw, MeshesOfItsOwnAreToldFromGmshs) {
  const TemporaryFolder folder;
  const auto put = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return folder / name;
  };
  const std::string points = "POINT=4\n6371;0;0;0\n0;6371;0;0\n0;0;6371;0\n-6371;0;0;0\n";
  const Grid globe = readGrid(put("a.msh", "# earth.msh; created by JIGSAW \nMSHID=3;EUCLIDEAN-MESH \nNDIMS=3 \n" +
                                               points + "EDGE2=1\n0;1;0\nTRIA3=2\n0;1;2;0\n1;3;2;0\n"));
  EXPECT_EQ(globe.nodes, (std::vector<Point>{{0, 0}, {90, 0}, {0, 90}, {180, 0}}));
  EXPECT_EQ(globe.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {1, 3, 2}}));
  EXPECT_TRUE(globe.crs.geographic);
  EXPECT_TRUE(globe.boundaries.empty());
  const Grid plane =
      readGrid(put("b.msh", "MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=3\n0;0;0\n1;0;0\n0;1.5;-1\nTRIA3=1\n0;1;2;7\n"));
  EXPECT_EQ(plane.nodes, (std::vector<Point>{{0, 0}, {1, 0}, {0, 1.5}}));
  EXPECT_TRUE(plane.crs.isPlane());
  const Grid grid = octahedralGlobe(1, kAll);
  writeAs(folder / "gmsh.msh", grid);
  writeAs(folder / "jigsaw.msh", grid, "jigsaw");
  EXPECT_THAT(bytesOf(folder / "gmsh.msh"), HasSubstr("$MeshFormat"));
  EXPECT_EQ(readGrid(folder / "gmsh.msh").triangles, grid.triangles);
  EXPECT_EQ(readGrid(folder / "jigsaw.msh").triangles, grid.triangles);
  const auto errorIn = [&](const std::string& text) -> std::string {
    try {
      readGrid(put("bad.msh", "MSHID=3;EUCLIDEAN-MESH\n" + text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(errorIn("NDIMS=2\nPOINT=1\n0;0;0\n"), HasSubstr("TRIA3"));
  EXPECT_THAT(errorIn("NDIMS=2\nPOINT=2\n0;0;0\n"), HasSubstr("line"));
  EXPECT_THAT(errorIn("POINT=1\n0;0;0\n"), HasSubstr("NDIMS"));
  EXPECT_THAT(errorIn("NDIMS=3\n" + points + "TRIA3=1\n0;1;4;0\n"), HasSubstr("point 4"));
  EXPECT_THAT(errorIn("NDIMS=3\n" + points + "QUAD4=1\n0;1;2;3;0\n"), HasSubstr("triangles"));
  EXPECT_THAT(errorIn("NDIMS=3\nPOINT=3\n0;0;1;0\n5;0;0;0\n0;5;0;0\nTRIA3=1\n0;1;2;0\n"), HasSubstr("sphere"));
}

// A NetCDF file, read by the library alone.
class Netcdf {
 public:
  explicit Netcdf(const std::string& path) { EXPECT_EQ(nc_open(path.c_str(), NC_NOWRITE, &id_), NC_NOERR) << path; }
  ~Netcdf() { nc_close(id_); }
  Netcdf(const Netcdf&) = delete;
  Netcdf& operator=(const Netcdf&) = delete;

  std::size_t dimension(const char* name) const {
    int dim = -1;
    std::size_t length = 0;
    EXPECT_EQ(nc_inq_dimid(id_, name, &dim), NC_NOERR) << name;
    nc_inq_dimlen(id_, dim, &length);
    return length;
  }
  bool has(const char* name) const {
    int variable = -1;
    return nc_inq_varid(id_, name, &variable) == NC_NOERR;
  }
  // Row by row; expects these dimensions.
  std::vector<double> values(const char* name, const std::vector<std::string>& dimensions) const {
    int variable = -1, count = 0, dims[NC_MAX_VAR_DIMS];
    EXPECT_EQ(nc_inq_varid(id_, name, &variable), NC_NOERR) << name;
    nc_inq_varndims(id_, variable, &count);
    nc_inq_vardimid(id_, variable, dims);
    std::vector<std::string> names;
    std::size_t length = 1;
    for (int k = 0; k < count; ++k) {
      char dim[NC_MAX_NAME + 1];
      nc_inq_dimname(id_, dims[k], dim);
      names.emplace_back(dim);
      length *= dimension(dim);
    }
    EXPECT_EQ(names, dimensions) << name;
    std::vector<double> all(length);
    EXPECT_EQ(nc_get_var_double(id_, variable, all.data()), NC_NOERR) << name;
    return all;
  }
  std::string text(const char* name) const {
    std::size_t length = 0;
    EXPECT_EQ(nc_inq_attlen(id_, NC_GLOBAL, name, &length), NC_NOERR) << name;
    std::string value(length, ' ');
    nc_get_att_text(id_, NC_GLOBAL, name, value.data());
    return value;
  }
  double number(const char* name) const {
    double value = -1.0;
    EXPECT_EQ(nc_get_att_double(id_, NC_GLOBAL, name, &value), NC_NOERR) << name;
    return value;
  }
  std::vector<SpaceVector> places(const char* kind, const char* dim) const {
    std::vector<SpaceVector> all(dimension(dim));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::vector<double> values_k = values((std::string(1, "xyz"[k]) + kind).c_str(), {dim});
      for (std::size_t i = 0; i < all.size(); ++i) all[i][k] = values_k[i];
    }
    return all;
  }

 private:
  int id_ = -1;
};

double distanceOf(const SpaceVector& a, const SpaceVector& b) {
  return lengthOf({a[0] - b[0], a[1] - b[1], a[2] - b[2]});
}

TEST(Mpas, CellsAreNodesAndVerticesTheCentresOfTriangles) {
  constexpr double kRadius = 6371220.0;
  for (const bool closed : {true, false}) {
    const TemporaryFolder folder;
    Grid grid = closed ? octahedralGlobe(3, kAll) : octahedralGlobe(3, kSea);
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
      grid.z.push_back(-10.0 * static_cast<double>(i));
      grid.size_m.push_back(i % 2 == 0 ? 1e5 : 2e5);
    }
    const std::string path = folder / "globe_mpas.nc";
    writeAs(path, grid);
    const Netcdf file(path);
    EXPECT_EQ(file.text("on_a_sphere"), "YES");
    EXPECT_EQ(file.number("sphere_radius"), kRadius);
    ASSERT_EQ(file.dimension("nCells"), grid.nodes.size());
    ASSERT_EQ(file.dimension("nVertices"), grid.triangles.size());
    EXPECT_EQ(file.dimension("vertexDegree"), 3u);
    const std::vector<SpaceVector> cells = file.places("Cell", "nCells"), vertices = file.places("Vertex", "nVertices");
    const std::vector<double> corners = file.values("cellsOnVertex", {"nVertices", "vertexDegree"});
    const std::vector<double> density = file.values("meshDensity", {"nCells"});
    const std::vector<double> depth = file.values("bottomDepth", {"nCells"});
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const SpaceVector want = vectorOf(grid.nodes[i]);
      EXPECT_LT(distanceOf(cells[i], {kRadius * want[0], kRadius * want[1], kRadius * want[2]}), 1e-8);
      EXPECT_DOUBLE_EQ(density[i], i % 2 == 0 ? 1.0 : 1.0 / 16.0);
      EXPECT_EQ(depth[i], 10.0 * static_cast<double>(i));
    }
    std::set<std::pair<std::size_t, std::size_t>> edges;
    for (std::size_t t = 0; t < vertices.size(); ++t) {
      std::array<std::size_t, 3> v;
      for (std::size_t k = 0; k < 3; ++k) {
        v[k] = static_cast<std::size_t>(corners[3 * t + k]) - 1;
        ASSERT_EQ(v[k], grid.triangles[t][k]);
      }
      for (std::size_t k = 0; k < 3; ++k) edges.insert(std::minmax(v[k], v[(k + 1) % 3]));
      EXPECT_NEAR(lengthOf(vertices[t]), kRadius, 1e-8);
      const double reach = distanceOf(vertices[t], cells[v[0]]);
      EXPECT_LT(reach, 0.5 * kRadius);  // not the antipode
      EXPECT_NEAR(distanceOf(vertices[t], cells[v[1]]), reach, 1e-7);
      EXPECT_NEAR(distanceOf(vertices[t], cells[v[2]]), reach, 1e-7);
      EXPECT_GT(dot(cells[v[0]], cross(cells[v[1]], cells[v[2]])), 0.0);
    }
    const auto euler = static_cast<std::ptrdiff_t>(cells.size() + vertices.size()) - std::ssize(edges);
    EXPECT_EQ(euler, closed ? 2 : 1);
    const Grid got = readGrid(path);
    EXPECT_EQ(got.triangles, grid.triangles);
    EXPECT_EQ(got.z, grid.z);
    EXPECT_TRUE(sameCrs(got.crs, wgs84()));
    for (std::size_t i = 0; i < grid.nodes.size(); ++i)
      EXPECT_LT(distanceOf(vectorOf(got.nodes[i]), vectorOf(grid.nodes[i])), 1e-14);
    EXPECT_EQ(got.boundaries.size(), closed ? 0u : 1u);
  }
}

TEST(Mpas, PlanesStayPlanesAndOpenWaterIsKept) {
  const TemporaryFolder folder;
  Grid grid = testing::sampleGrid({}, {-3.0, 1e-7}, 1.0 / 3.0);
  const std::string path = folder / "lakes_mpas.nc";
  writeAs(path, grid);
  const Netcdf file(path);
  EXPECT_EQ(file.text("on_a_sphere"), "NO");
  const std::vector<SpaceVector> cells = file.places("Cell", "nCells"), vertices = file.places("Vertex", "nVertices");
  for (std::size_t t = 0; t < vertices.size(); ++t) {
    EXPECT_EQ(vertices[t][2], 0.0);
    for (const std::uint32_t node : grid.triangles[t])
      EXPECT_NEAR(distanceOf(vertices[t], cells[node]), distanceOf(vertices[t], cells[grid.triangles[t][0]]), 1e-12);
  }
  const Grid got = readGrid(path);
  EXPECT_EQ(got.nodes, grid.nodes);
  EXPECT_EQ(got.triangles, grid.triangles);
  EXPECT_TRUE(got.crs.isPlane());
  const auto open = [](const Grid& of) {
    return std::ranges::count(of.boundaries, BoundaryRole::Open, &Boundary::role);
  };
  EXPECT_EQ(open(grid), 1);
  EXPECT_EQ(open(got), 1);
  // A projected mesh is not a plane of MPAS.
  const Grid utm = testing::sampleGrid(parseCrs("EPSG:32616"), {448123.4, 4.8e6}, 250.0);
  writeAs(folder / "utm_mpas.nc", utm);
  EXPECT_EQ(Netcdf(folder / "utm_mpas.nc").text("on_a_sphere"), "YES");
  const Grid back = readGrid(folder / "utm_mpas.nc");
  double lat, lon;
  GeographicLib::UTMUPS::Reverse(16, true, utm.nodes[5].x, utm.nodes[5].y, lat, lon);
  EXPECT_NEAR(back.nodes[5].x, lon, 1e-9);
  EXPECT_NEAR(back.nodes[5].y, lat, 1e-9);
  // A UGRID file is not an MPAS file.
  writeAs(folder / "lakes.nc", grid);
  EXPECT_EQ(readGrid(folder / "lakes.nc").title, grid.title);
  // A triangle without area has no circumcentre.
  grid.nodes[grid.triangles[0][2]] = grid.nodes[grid.triangles[0][0]];
  EXPECT_THROW(writeAs(path, grid), OutputError);
}

// The array at an offset of the appended section.
std::vector<double> appendedDoubles(const std::string& bytes, const std::string& name) {
  const std::size_t declared = bytes.find("Name=\"" + name + '"');
  EXPECT_NE(declared, std::string::npos) << name;
  const std::size_t offset = bytes.find("offset=\"", declared) + 8;
  const std::size_t at = bytes.find("<AppendedData encoding=\"raw\">\n_") + 31 +
                         static_cast<std::size_t>(std::atoll(bytes.c_str() + offset));
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data() + at, sizeof(size));
  std::vector<double> values(size / sizeof(double));
  std::memcpy(values.data(), bytes.data() + at + sizeof(size), size);
  return values;
}

TEST(VtuGlobe, PointsLieOnASphereAndComeBackAsDegrees) {
  const TemporaryFolder folder;
  Grid grid = octahedralGlobe(3, kSea);
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) grid.z.push_back(-1.0 * static_cast<double>(i));
  const std::string path = folder / "sea_globe.vtu";
  writeAs(path, grid);
  const std::vector<double> points = appendedDoubles(bytesOf(path), "Points");
  ASSERT_EQ(points.size(), 3 * grid.nodes.size());
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
    const SpaceVector want = vectorOf(grid.nodes[i]);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(points[3 * i + k], 6371220.0 * want[k], 1e-8);
  }
  const Grid got = readGrid(path);
  EXPECT_EQ(got.nodes, grid.nodes);
  EXPECT_EQ(got.triangles, grid.triangles);
  EXPECT_EQ(got.z, grid.z);
  EXPECT_TRUE(sameCrs(got.crs, grid.crs));
  ASSERT_EQ(got.boundaries.size(), 1u);
  EXPECT_EQ(got.boundaries[0].nodes, grid.boundaries[0].nodes);
  // Without depths, none are derived from the points' third coordinates.
  grid.z.clear();
  writeAs(path, grid);
  EXPECT_TRUE(readGrid(path).z.empty());
  grid.crs = {};
  EXPECT_THROW(writeAs(path, grid), OutputError);
}

TEST(Ply, IsAGlobeOrAReliefInSpace) {
  const TemporaryFolder folder;
  const auto written = [&](const Grid& grid) {
    writeAs(folder / "a.ply", grid);
    std::istringstream text(bytesOf(folder / "a.ply"));
    std::string line, header;
    while (std::getline(text, line) && line != "end_header") header += line + '\n';
    EXPECT_THAT(header, HasSubstr("element vertex " + std::to_string(grid.nodes.size()) + '\n'));
    EXPECT_THAT(header, HasSubstr("element face " + std::to_string(grid.triangles.size()) + '\n'));
    std::vector<double> numbers{std::istream_iterator<double>(text), {}};
    EXPECT_EQ(numbers.size(), 3 * grid.nodes.size() + 4 * grid.triangles.size());
    for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
      const double* const face = numbers.data() + 3 * grid.nodes.size() + 4 * t;
      EXPECT_EQ(face[0], 3.0);
      for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(face[1 + i], grid.triangles[t][i]);
    }
    return numbers;
  };
  const Grid globe = octahedralGlobe(2, kAll);
  const std::vector<double> round = written(globe);
  for (std::size_t i = 0; i < globe.nodes.size(); ++i) {
    const SpaceVector want = vectorOf(globe.nodes[i]);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(round[3 * i + k], 6371220.0 * want[k], 1e-8);
  }
  const Grid lakes = testing::sampleGrid(parseCrs("EPSG:32616"), {448123.4, 4.8e6}, 250.0);
  const std::vector<double> relief = written(lakes);
  for (std::size_t i = 0; i < lakes.nodes.size(); ++i) {
    EXPECT_EQ(relief[3 * i], lakes.nodes[i].x);
    EXPECT_EQ(relief[3 * i + 1], lakes.nodes[i].y);
    EXPECT_EQ(relief[3 * i + 2], lakes.z[i]);
  }
  EXPECT_THROW(readGrid(folder / "a.ply"), InputError);
}

// Triangles around the whole globe, across the antimeridian and at both poles, with and without a coast.
TEST(AllFormats, GiveTheGlobeBack) {
  for (const bool closed : {true, false}) {
    Grid grid = closed ? octahedralGlobe(2, kAll) : octahedralGlobe(2, kSea);
    grid.area_m2 = triangleAreas(grid.nodes, grid.triangles, grid.crs);
    for (const GridFormat& format : gridFormats()) {
      if (!format.readable || !format.writable) continue;
      SCOPED_TRACE(format.name);
      const TemporaryFolder folder;
      const std::string path = folder / ("globe" + std::string(format.endings.front()));
      writeAs(path, grid);
      const Grid got = readGrid(path);
      EXPECT_EQ(got.triangles, grid.triangles);
      ASSERT_EQ(got.nodes.size(), grid.nodes.size());
      for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        if (format.places == NodePlaces::Sphere)
          EXPECT_LT(distanceOf(vectorOf(got.nodes[i]), vectorOf(grid.nodes[i])), 1e-14);
        else
          EXPECT_EQ(got.nodes[i], grid.nodes[i]);
      }
      EXPECT_TRUE(got.crs.geographic);
      EXPECT_TRUE(got.notes.empty());
      std::size_t edges = 0;  // models may cut the coast in two
      for (const Boundary& boundary : got.boundaries) {
        edges += edgesOf(boundary).size();
        if (boundary.closed) {
          EXPECT_EQ(boundary.role, grid.boundaries.at(0).role);
        }
      }
      EXPECT_EQ(edges, closed ? 0 : edgesOf(grid.boundaries.at(0)).size());
    }
  }
}

}  // namespace
}  // namespace coastmesh
