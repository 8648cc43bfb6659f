// Meshes of other programs, and error messages for those that cannot be read.
#include "tests/gis/format/read_grid.hpp"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>
#include <sstream>

#include "gis/error.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/lower_case.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/bulk_lists.hpp"

namespace coastmesh {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

TEST_F(ReadGrid, NamesWhatCannotBeRead) {
  EXPECT_THAT(errorOf(folder_ / "no.msh"), HasSubstr("there is no file"));
  EXPECT_THAT(errorIn("mesh.xyz", "1"), AllOf(HasSubstr("mesh.xyz"), HasSubstr(".2dm")));
  EXPECT_THAT(errorIn("empty.2dm", ""), HasSubstr("empty.2dm' is empty"));
  EXPECT_THAT(errorIn("lake.nc", "no netcdf"), HasSubstr("lake.nc"));
  EXPECT_THAT(errorIn("lake.gpkg", "no sqlite"), HasSubstr("lake.gpkg"));
  EXPECT_THAT(errorIn("lake.vtu", "<VTKFile/>"), HasSubstr("no unstructured grid"));
}

TEST_F(ReadGrid, Fort14WithElementsOutOfOrder) {
  const Grid grid = readGrid(put("fort.14",
                                 "two\n2 4\n1 0 0 5\n2 1 0 5\n3 1 1 5\n4 0 1 5\n"
                                 "7 3 1 2 3\n4 3 1 3 4\n0\n0\n0\n0\n"));
  EXPECT_EQ(grid.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_THAT(grid.notes, Contains("elements are not numbered from 1 in their order"));
}

TEST_F(ReadGrid, NumbersOfFortran) {
  const Grid grid = readGrid(put("fort.14",
                                 "a 3d title\n1 3\n1 0.5D+00 1.5d-01 2.D2\n2 1 0 -1.25D+1\n3 +1D0 1 .5d0\n"
                                 "1 3 1 2 3\n0\n0\n0\n0\n"));
  EXPECT_EQ(grid.nodes, (std::vector<Point>{{0.5, 0.15}, {1, 0}, {1, 1}}));
  EXPECT_EQ(grid.z, (std::vector<double>{-200, 12.5, -0.5}));
  for (const char* const wrong : {"D", "D5", "1D", "1DD5", "1D5D5", "1eD5", "d", "1D+-5"})
    EXPECT_THAT(errorIn("fort.14", std::string("t\n1 3\n1 0 ") + wrong + " 1\n"), HasSubstr("line 3: a number is"));
}

// What Fortran's READ(14,*) accepts: repeated values, commas, tabs, exponents without a letter, statements that go on
// in the next line, blank lines, and comments and slashes after the values.
TEST_F(ReadGrid, Fort14AsFortranReadsIt) {
  const Grid grid =
      readGrid(put("fort.14",
                   "t\n1, 3 elements and nodes\n1,2*0.5,53.0\n2\t1,\t0 2*5.0\n\n3 1.;\n\n1.0+0 .5q-1/ a node\n"
                   "1*1 3 1,2,3 4 5 ! an element\n1\n2 / nodes\n2/0\n1\n 2 \n0\n0\n"));
  EXPECT_EQ(grid.nodes, (std::vector<Point>{{0.5, 0.5}, {1, 0}, {1, 1}}));
  EXPECT_EQ(grid.z, (std::vector<double>{-53, -5, -0.05}));
  EXPECT_EQ(grid.triangles, (Triangles{{0, 1, 2}}));
  ASSERT_EQ(grid.boundaries.size(), 1u);
  EXPECT_EQ(grid.boundaries[0].nodes, (std::vector<std::uint32_t>{0, 1}));
  const auto refusalOf = [&](const std::string& nodes) { return errorIn("fort.14", "t\n1 3\n" + nodes); };
  EXPECT_THAT(refusalOf("1 0 0/ 5\n"), HasSubstr("line 3: a slash ends it before all its values"));
  for (const char* const wrong : {"2*", "*5", "0*5", "-1*5", "1.5*2"})
    EXPECT_THAT(refusalOf(std::string("1 0 0 ") + wrong + "\n"), HasSubstr("line 3: \"")) << wrong;
  // Nodes without depths, as Fortran would misread them too.
  EXPECT_THAT(refusalOf("1 0 0\n2 1 0\n3 1 1\n1 3 1 2 3\n0\n0\n0\n0\n"),
              HasSubstr("line 3 has too few values, so the next line was read as a part of it"));
}

// The first line is the title, whatever it holds.
TEST_F(ReadGrid, Fort14WithoutATitle) {
  for (const char* const title : {"", "  ", "\r", ","}) {
    const Grid grid =
        readGrid(put("hgrid.gr3", std::string(title) + "\n1 3\n1 0 0 5\n2 1 0 5\n\n3 1 1 5\n1 3 1 2 3\n"));
    EXPECT_EQ(grid.triangles, (Triangles{{0, 1, 2}})) << title;
    EXPECT_EQ(grid.title, "");
  }
  EXPECT_THAT(errorIn("fort.14", "\n"), HasSubstr("ends too early, after line 1"));
}

TEST_F(ReadGrid, TwoDmOfOtherPrograms) {
  const Grid grid = readGrid(put("lake.2dm",
                                 "MESH2D\r\nMESHNAME \"x\"\r\nNUM_MATERIALS_PER_ELEM 1\r\n"
                                 "ND 10 0.0 0 1.5\r\nND 20 1.0E+0 0 +2.5\r\nND 5 1 1 3\r\nND 7 0 1 4\r\n"
                                 "E3T 3 10 20 5 4\r\nE3T 9 10 5 7 2\r\n"
                                 "NS 20 -10 1\r\nNS 10 5 -7\r\nNS 10 20 5\r\nNS 7 -10 8\r\n"));
  EXPECT_EQ(grid.nodes, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_EQ(grid.z, (std::vector<double>{1.5, 2.5, 3, 4}));
  EXPECT_EQ(grid.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(grid.feature_of, (std::vector<std::uint32_t>{1, 0}));
  // The first string is reversed, the second has an inner edge that is dropped, the third is the whole shore.
  ASSERT_EQ(grid.boundaries.size(), 3u);
  EXPECT_EQ(grid.boundaries[0].role, BoundaryRole::Open);
  EXPECT_THAT(grid.boundaries[0].nodes, ElementsAre(0, 1));
  EXPECT_THAT(grid.boundaries[1].nodes, ElementsAre(2, 3));
  EXPECT_EQ(grid.boundaries[2].role, BoundaryRole::Land);
  EXPECT_TRUE(grid.boundaries[2].closed);
  EXPECT_TRUE(grid.crs.isPlane());
}

// A node string added to our own in SMS.
TEST_F(ReadGrid, TwoDmKeepsOurRolesBesideOtherStrings) {
  const Grid grid = readGrid(put("lake.2dm",
                                 "MESH2D\nE3T 1 1 2 3 1\nE3T 2 1 3 4 1\n"
                                 "ND 1 0 0 0\nND 2 1 0 0\nND 3 1 1 0\nND 4 0 1 0\n"
                                 "NS 3 -4 5\nNS 2 -3 23\nNS 4 1 -2 11\n"));
  ASSERT_EQ(grid.boundaries.size(), 3u);
  EXPECT_EQ(grid.boundaries[0].role, BoundaryRole::Open);
  EXPECT_EQ(grid.boundaries[1].role, BoundaryRole::Open);
  EXPECT_EQ(grid.boundaries[2].role, BoundaryRole::Land);
  EXPECT_THAT(grid.boundaries[2].nodes, ElementsAre(3, 0, 1));
}

TEST_F(ReadGrid, TwoDmErrorsNameTheLine) {
  EXPECT_THAT(errorIn("a.2dm", "ND 1 0 0 0\n"), HasSubstr("line 1"));
  EXPECT_THAT(errorIn("a.2dm", "MESH2D\nND 1 0 zero 0\n"), AllOf(HasSubstr("line 2"), HasSubstr("\"zero\"")));
  EXPECT_THAT(errorIn("a.2dm", "MESH2D\n\nND 1 0 nan 0\n"), AllOf(HasSubstr("line 3"), HasSubstr("finite")));
  EXPECT_THAT(errorIn("a.2dm", "MESH2D\nE8Q 1 1 2 3 4 5 6 7 8 1\n"), AllOf(HasSubstr("line 2"), HasSubstr("E8Q")));
  EXPECT_THAT(errorIn("a.2dm", "MESH2D\nND 1 0 0 0\nND 2 0 1 0\nND 2 1 1 0\n"), HasSubstr("node 2"));
  EXPECT_THAT(errorIn("a.2dm", "MESH2D\nND 1 0 0 0\nE3T 1 1 1 9 1\n"), HasSubstr("node 9"));
  EXPECT_THAT(errorIn("a.2dm", "MESH2D\nND 1 0 0 0\nNS 1\n"), HasSubstr("NS"));
}

constexpr const char* kSquare22 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\nnot $Nodes\n$EndComments\n"
    "$PhysicalNames\n2\n1 7 \"Open sea\"\n2 3 \"bay\"\n$EndPhysicalNames\n"
    "$Nodes\n4\n4 0 1 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n$EndNodes\n"
    "$Elements\n7\n1 15 2 0 1 1\n2 1 2 7 1 2 1\n3 1 2 8 2 2 3\n4 1 2 8 3 3 4\n5 1 2 8 4 4 1\n"
    "7 2 2 3 1 1 3 4\n6 2 2 3 1 1 2 3\n$EndElements\n";

TEST_F(ReadGrid, GmshOfOtherPrograms) {
  const Grid grid = readGrid(put("bay.msh", kSquare22));
  EXPECT_EQ(grid.nodes, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_EQ(grid.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_TRUE(grid.z.empty());
  ASSERT_EQ(grid.features.size(), 1u);
  EXPECT_EQ(grid.features[0].fid, 3);
  ASSERT_EQ(grid.boundaries.size(), 2u);
  EXPECT_EQ(grid.boundaries[0].role, BoundaryRole::Open);
  EXPECT_THAT(grid.boundaries[0].nodes, ElementsAre(0, 1));
  EXPECT_EQ(grid.boundaries[1].role, BoundaryRole::Land);
  EXPECT_THAT(grid.boundaries[1].nodes, ElementsAre(1, 2, 3, 0));
}

// As Gmsh saves nodes with Mesh.SaveParametric: the dimension and tag of their curve or surface, and places on it.
TEST_F(ReadGrid, GmshWithParametricNodes) {
  std::string text = kSquare22;
  const std::size_t nodes = text.find("\n$Nodes") + 1, elements = text.find("$Elements");
  text.replace(nodes, elements - nodes,
               "$ParametricNodes\n4\n4 0 1 0 1 4 0.5\n1 0 0 0 0 1\n2 1 0 0 2 1 0.25 0.75\n3 1 1 0 2 1 0 1\n"
               "$EndParametricNodes\n");
  const Grid grid = readGrid(put("bay.msh", text));
  EXPECT_EQ(grid.nodes, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_EQ(grid.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST_F(ReadGrid, GmshWithDepthsAsThirdCoordinate) {
  std::string text = kSquare22;
  text.replace(text.find("1 0 0 0\n2 1"), 7, "1 0 0 -5");
  EXPECT_EQ(readGrid(put("bay.msh", text)).z, (std::vector<double>{-5, 0, 0, 0}));
}

TEST_F(ReadGrid, GmshNamesOfOpenings) {
  std::string text = kSquare22;
  const std::size_t name = text.find("\"", text.find("$PhysicalNames"));
  const std::size_t length = text.find("\"", name + 1) + 1 - name;
  for (const char* const word : {"Ocean", "sea 2", "tide_1"}) {
    const Grid grid = readGrid(put("bay.msh", std::string(text).replace(name, length, '"' + std::string(word) + '"')));
    EXPECT_EQ(grid.boundaries.at(0).role, BoundaryRole::Open) << word;
  }
  for (const char* const word : {"Sea wall", "season", "coast"}) {
    const Grid grid = readGrid(put("bay.msh", std::string(text).replace(name, length, '"' + std::string(word) + '"')));
    EXPECT_EQ(grid.boundaries.at(0).role, BoundaryRole::Land) << word;
  }
}

// Other tools do not give these files the ending that we give them.
TEST_F(ReadGrid, WaveWatchByItsContent) {
  Grid grid = testing::sampleGrid({}, {1000.0, 2000.0}, 50.0);
  for (const bool opening : {true, false}) {
    if (!opening) std::erase_if(grid.boundaries, [](const Boundary& b) { return b.role == BoundaryRole::Open; });
    StagedOutput output(folder_ / "a_ww3.msh", gridFormatFor("a_ww3.msh"), true);
    output.write(grid);
    output.commit();
    const Grid known = readGrid(folder_ / "a_ww3.msh");
    std::filesystem::copy_file(folder_ / "a_ww3.msh", folder_ / "a.msh",
                               std::filesystem::copy_options::overwrite_existing);
    const Grid got = readGrid(folder_ / "a.msh");
    EXPECT_EQ(got.z, grid.z);
    ASSERT_EQ(got.boundaries.size(), known.boundaries.size());
    for (std::size_t i = 0; i < known.boundaries.size(); ++i)
      EXPECT_EQ(got.boundaries[i].role, known.boundaries[i].role);
  }
  // Lines are Gmsh's, whose third coordinate is up.
  std::string text = kSquare22;
  text.replace(text.find("2.2 0 8"), 7, "2 0 8");
  text.erase(text.find("$Comments"), text.find("$Nodes\n4") - text.find("$Comments"));
  text.replace(text.find("1 0 0 0\n2 1"), 7, "1 0 0 -5");
  EXPECT_EQ(readGrid(put("bay.msh", text)).z, (std::vector<double>{-5, 0, 0, 0}));
}

// Files from Windows.
TEST_F(ReadGrid, FilesOfASetInCapitals) {
  const Grid grid = testing::sampleGrid({}, {1000.0, 2000.0}, 50.0);
  const auto isOpen = [](const Boundary& boundary) { return boundary.role == BoundaryRole::Open; };
  const std::vector<std::vector<std::string>> sets{{".slf", ".cli"}, {"_grd.dat", "_dep.dat", "_obc.dat", "_cor.dat"}};
  for (const std::vector<std::string>& endings : sets) {
    StagedOutput output(folder_ / ("lake" + endings[0]), gridFormatFor("lake" + endings[0]), false);
    output.write(grid);
    output.commit();
    const auto capitals = [&](const std::string& ending) { return folder_ / ("LAKE" + upperCase(ending)); };
    for (const std::string& ending : endings) std::filesystem::rename(folder_ / ("lake" + ending), capitals(ending));
    const Grid got = readGrid(capitals(endings[0]));
    EXPECT_EQ(std::ranges::count_if(got.boundaries, isOpen), 1) << endings[0];
    EXPECT_EQ(got.z, grid.z);
    EXPECT_THAT(got.notes, ::testing::IsEmpty());
  }
}

TEST_F(ReadGrid, FvcomWithoutItsOpenNodesIsRemarked) {
  StagedOutput output(folder_ / "lake_grd.dat", gridFormatFor("lake_grd.dat"), false);
  output.write(testing::sampleGrid({}, {1000.0, 2000.0}, 50.0));
  output.commit();
  EXPECT_EQ(remarkOnGrid(folder_ / "lake_grd.dat"), "");
  std::filesystem::remove(folder_ / "lake_obc.dat");
  EXPECT_THAT(remarkOnGrid(folder_ / "lake_grd.dat"), HasSubstr("lake_obc.dat', so all boundaries are taken as shore"));
}

// Some readers expect $NodeData in the order of $Nodes.
TEST_F(ReadGrid, GmshHasNodeDataInTheOrderOfNodes) {
  const Grid grid = testing::sampleGrid({}, {1000.0, 2000.0}, 50.0);
  for (const char* name : {"a.msh", "a_22.msh"}) {
    StagedOutput output(folder_ / name, gridFormatFor(name), false);
    output.write(grid);
    output.commit();
    std::ifstream file(folder_ / name);
    std::vector<std::size_t> nodes, data;
    std::string line, section;
    while (std::getline(file, line)) {
      if (line.starts_with("$")) section = line;
      std::istringstream words(line);
      std::vector<double> numbers;
      for (double number = 0; words >> number;) numbers.push_back(number);
      const bool old = std::string_view(name).ends_with("_22.msh");
      if (section == "$Nodes" && numbers.size() == (old ? 4 : 1) && (old || numbers[0] > 0))
        nodes.push_back(static_cast<std::size_t>(numbers[0]));
      if (section == "$NodeData" && numbers.size() == 2) data.push_back(static_cast<std::size_t>(numbers[0]));
    }
    EXPECT_EQ(nodes.size(), grid.nodes.size());
    EXPECT_EQ(data, nodes) << name;
    EXPECT_EQ(readGrid(folder_ / name).z, grid.z);
  }
}

TEST_F(ReadGrid, GmshErrors) {
  EXPECT_THAT(errorIn("a.msh", "$Nodes\n0\n$EndNodes\n"), AllOf(HasSubstr("line 1"), HasSubstr("$MeshFormat")));
  EXPECT_THAT(errorIn("a.msh", "$MeshFormat\n4.1 1 8\n"), AllOf(HasSubstr("line 2"), HasSubstr("binary")));
  EXPECT_THAT(errorIn("a.msh", "$MeshFormat\n4.0 0 8\n"), HasSubstr("4.0"));
  EXPECT_THAT(errorIn("a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0 0 0\n"),
              HasSubstr("ends too early"));
  std::string curved = kSquare22;
  curved.replace(curved.find("6 2 2 3 1 1 2 3"), 15, "6 9 2 3 1 1 2 3 4 1 2");
  EXPECT_THAT(errorIn("a.msh", curved), HasSubstr("type 9"));
  std::string missing = kSquare22;
  missing.replace(missing.find("6 2 2 3 1 1 2 3"), 15, "6 2 2 3 1 1 2 9");
  EXPECT_THAT(errorIn("a.msh", missing), HasSubstr("no node 9"));
}

TEST_F(ReadGrid, TriangleOfOtherPrograms) {
  put("a.1.node", "# from 0\n4 2 2 1\n0 0 0 9 9 1\n 1  1 0 9 9 1 # corner\n2 1 1 9 9 1\n\n3 0 1 9 9 0\n");
  put("a.1.poly", "0 2 0 1\n2 1\n1 0 1 1\n2 1 2 1\n0\n");
  const Grid grid = readGrid(put("a.1.ele", "2 3 1\n0 0 1 2 0.5\n1 0 2 3 1.5\n"));
  EXPECT_EQ(grid.nodes, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_EQ(grid.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_TRUE(grid.z.empty());           // two attributes are ambiguous
  EXPECT_TRUE(grid.features.empty());    // the triangles' attribute is not a feature number
  EXPECT_TRUE(grid.boundaries.empty());  // markers without a role
  EXPECT_EQ(readGrid(folder_ / "a.1.node").triangles, grid.triangles);
}

TEST_F(ReadGrid, TriangleErrorsNameTheFile) {
  put("a.node", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n");
  EXPECT_THAT(errorOf(folder_ / "a.node"), HasSubstr("a.ele"));
  EXPECT_THAT(errorIn("a.ele", "1 6 0\n1 1 2 3 1 2 3\n"), HasSubstr("three nodes"));
  EXPECT_THAT(errorIn("a.ele", "1 3 0\n1 1 2 4\n"), AllOf(HasSubstr("line 2"), HasSubstr("no node 4")));
  EXPECT_THAT(errorIn("a.ele", "2 3 0\n1 1 2 3\n"), HasSubstr("ends too early"));
  put("a.node", "3 3 0 0\n");
  EXPECT_THAT(errorOf(folder_ / "a.ele"), HasSubstr("two dimensions"));
}

TEST_F(ReadGrid, GisLayersOfOtherPrograms) {
  const std::string head = R"({"type":"FeatureCollection","features":[)";
  const auto feature = [](const std::string& rings) {
    return R"({"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":)" + rings + "}}";
  };
  const std::string first = feature("[[[0,0],[1,0],[1,1],[0,0]]]"), turned = feature("[[[0,0],[0,1],[1,1],[0,0]]]");
  const Grid grid = readGrid(put("tin.geojson", head + first + "," + turned + "]}"));
  EXPECT_EQ(grid.nodes, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_EQ(grid.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(grid.crs.authority, "EPSG:4326");
  const std::string quad = feature("[[[0,0],[1,0],[1,1],[0,1],[0,0]]]");
  EXPECT_THAT(errorIn("lake.geojson", head + first + "," + quad + "]}"),
              AllOf(HasSubstr("lake.geojson"), HasSubstr("feature 1"), HasSubstr("4 corners")));
  EXPECT_THAT(errorIn("point.geojson", head + R"({"type":"Feature","properties":{},"geometry":)"
                                              R"({"type":"Point","coordinates":[1,2]}}]})"),
              HasSubstr("no layer of polygons"));
}

// Third coordinates of corners: a node gets the z of all corners there, or NaN if they differ.
TEST_F(ReadGrid, GisLayersWithHeights) {
  const std::string head = R"({"type":"FeatureCollection","features":[)";
  const auto feature = [](const std::string& ring) {
    return R"({"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[)" + ring + "]]}}";
  };
  const std::string first = feature("[0,0,-5],[1,0,-6],[1,1,-7],[0,0,-5]");
  const auto read = [&](const std::string& second) {
    return readGrid(put("tin.geojson", head + first + "," + second + "]}"));
  };
  const Grid alike = read(feature("[0,0,-5],[0,1,-8],[1,1,-7],[0,0,-5]"));
  EXPECT_EQ(alike.nodes, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_EQ(alike.z, (std::vector<double>{-5, -6, -7, -8}));
  const Grid differing = read(feature("[0,0,-5],[0,1,-8],[1,1,-9],[0,0,-5]"));
  EXPECT_TRUE(std::isnan(differing.z.at(2)));
  EXPECT_EQ(differing.z.at(0), -5);
  const Grid flat = readGrid(put("flat.geojson", head + feature("[0,0,0],[1,0,0],[1,1,0],[0,0,0]") + "]}"));
  EXPECT_TRUE(flat.z.empty());
}

// For an empty polygon, OGR has no ring.
TEST_F(ReadGrid, EmptyPartsOfGisLayersAreRefused) {
  GDALAllRegister();
  const auto errorOfLayers = [this](const std::string& triangle, const std::string& boundary) {
    const std::string path = folder_ / "parts.gpkg";
    const std::unique_ptr<GDALDataset> dataset(
        GetGDALDriverManager()->GetDriverByName("GPKG")->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    const auto addLayer = [&](const char* name, const std::vector<std::string>& shapes) {
      OGRLayer* const layer = dataset->CreateLayer(name, nullptr, wkbUnknown, nullptr);
      OGRFieldDefn id("id", OFTInteger64), role("role", OFTString);
      layer->CreateField(&id);
      layer->CreateField(&role);
      for (const std::string& wkt : shapes) {
        OGRFeature feature(layer->GetLayerDefn());
        OGRGeometry* shape = nullptr;
        OGRGeometryFactory::createFromWkt(wkt.c_str(), nullptr, &shape);
        feature.SetGeometryDirectly(shape);
        feature.SetField("role", "land");
        EXPECT_EQ(layer->CreateFeature(&feature), OGRERR_NONE);
      }
    };
    addLayer("triangles", {"POLYGON((0 0,1 0,0 1,0 0))", triangle});
    addLayer("boundaries", {boundary});
    dataset->FlushCache();
    return errorOf(path);
  };
  EXPECT_THAT(errorOfLayers("MULTIPOLYGON(EMPTY,((1 0,1 1,0 1,1 0)))", "LINESTRING(0 0,1 0)"),
              AllOf(HasSubstr("parts.gpkg"), HasSubstr("layer \"triangles\", feature 2"), HasSubstr("is empty")));
  EXPECT_THAT(errorOfLayers("POLYGON((1 0,1 1,0 1,1 0))", "LINESTRING EMPTY"),
              AllOf(HasSubstr("layer \"boundaries\", feature 1"), HasSubstr("not a line")));
}

TEST_F(ReadGrid, FvcomWithOrWithoutBlanksAtItsCounts) {
  for (const std::string equals : {" = ", "=", " =", "=\t"}) {
    const std::string cells = "Node Number" + equals + "3\nCell Number" + equals + "1\n1 1 2 3 1\n";
    EXPECT_EQ(readGrid(put("a_grd.dat", cells + "1 0 0 5\n2 1 0 5\n3 1 1 5\n")).z.size(), 3u) << equals;
  }
  EXPECT_THAT(errorIn("a_grd.dat", "Node Number =\n"), HasSubstr("line 1: a whole number is expected"));
  EXPECT_THAT(errorIn("a_grd.dat", "Node Number: 3\n"), HasSubstr("\"Node Number = ...\" is expected"));
}

// A SELAFIN file of two triangles in single precision, in either byte order.
TEST_F(ReadGrid, SelafinInEitherByteOrder) {
  for (const bool little : {true, false}) {
    std::string bytes;
    const auto number = [&](auto value) {
      std::array<char, 4> four{};
      std::memcpy(four.data(), &value, 4);
      if (!little) std::ranges::reverse(four);
      bytes.append(four.data(), 4);
    };
    const auto record = [&](const auto& values) {
      number(static_cast<std::int32_t>(4 * values.size()));
      for (const auto value : values) number(value);
      number(static_cast<std::int32_t>(4 * values.size()));
    };
    const auto text = [&](std::string value, std::size_t length) {
      value.resize(length, ' ');
      number(static_cast<std::int32_t>(length));
      bytes += value;
      number(static_cast<std::int32_t>(length));
    };
    using Integers = std::vector<std::int32_t>;
    using Reals = std::vector<float>;
    text("a sea", 80);
    record(Integers{1, 0});
    text("BOTTOM          M", 32);
    record(Integers{1, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    record(Integers{2, 4, 3, 1});
    record(Integers{1, 2, 3, 1, 3, 4});
    record(Integers{1, 2, 3, 4});
    record(Reals{0, 1000, 1000, 0.1f});
    record(Reals{0, 0, 1000, 1000});
    record(Reals{0});
    record(Reals{-12.1f, -3274.2f, -5, -6});
    const Grid grid = readGrid(put("sea.slf", bytes));
    EXPECT_EQ(grid.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(grid.nodes[3], (Point{0.1, 1000}));
    EXPECT_EQ(grid.z, (std::vector<double>{-12.1, -3274.2, -5, -6}));
  }
}

// A file truncated anywhere is refused or read in part, but never crashes or hangs.
TEST_F(ReadGrid, CutFilesDoNoHarm) {
  const Grid grid = testing::sampleGrid(wgs84(), {-87.5, 43.1}, 0.01, 2);
  for (const GridFormat& format : gridFormats()) {
    if (!format.readable || !format.writable || format.endings.empty()) continue;
    const std::string name = "whole" + std::string(format.endings[0]);
    StagedOutput output(folder_ / name, format, true);
    output.write(grid);
    output.commit();
    std::ifstream file(folder_ / name, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    std::filesystem::remove(folder_ / "cut.prj");
    for (std::size_t size = 1; size < bytes.size(); size += 1 + bytes.size() / 40) {
      const std::string path = put("cut" + std::string(format.endings[0]), bytes.substr(0, size));
      for (const char* beside : {".ele", ".shx", ".dbf"})
        if (std::filesystem::exists(folder_ / ("whole" + std::string(beside))) && !path.ends_with(beside))
          std::filesystem::copy_file(folder_ / ("whole" + std::string(beside)), folder_ / ("cut" + std::string(beside)),
                                     std::filesystem::copy_options::overwrite_existing);
      ::testing::internal::CaptureStderr();
      try {
        readGrid(path);
      } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("cut")) << size;
      }
      EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << format.name << " cut at " << size;
    }
  }
}

}  // namespace
}  // namespace coastmesh
