#include "gis/format/read_vtu.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "gis/error.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/bulk_lists.hpp"

namespace coastmesh {
namespace {

using testing::TemporaryFolder;

// Two triangles in a file of another program, with arrays as text.
constexpr const char* kText = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid>
<Piece NumberOfPoints="4" NumberOfCells="3">
<Points>
<DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 -1  1 0 -2  1 1 -3  0 1 -4</DataArray>
</Points>
<Cells>
<DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 0 1 0 2 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3 5 8</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5 3 5</DataArray>
</Cells>
<CellData><DataArray type="Float64" Name="area_m2" format="ascii">0.5 0 0.25</DataArray></CellData>
</Piece>
</UnstructuredGrid>
</VTKFile>
)";

Grid read(const std::string& text) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.vtu", std::ios::binary) << text;
  return readVtu(folder / "a.vtu", Crs{});
}

// The file with `passage` replaced by `other`.
std::string with(const std::string& passage, const std::string& other) {
  std::string text = kText;
  const std::size_t at = text.find(passage);
  EXPECT_NE(at, std::string::npos) << passage;
  return text.replace(at, passage.size(), other);
}

std::string refusalOf(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ReadVtu, TextWithLinesBetweenTheTriangles) {
  const Grid grid = read(kText);
  EXPECT_EQ(grid.nodes, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  ASSERT_EQ(grid.triangles.size(), 2u);
  EXPECT_EQ(grid.triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
  EXPECT_EQ(grid.z, (std::vector<double>{-1, -2, -3, -4}));
  EXPECT_EQ(grid.area_m2, (std::vector<double>{0.5, 0.25}));  // of the triangles, not of the line
}

// The numbers 3, 5 and 8 after their length in bytes, in every type that holds them; base64 with line breaks.
TEST(ReadVtu, BytesInBase64OfEveryType) {
  const std::vector<std::pair<std::string, std::string>> offsets{
      {"UInt8", "AwAAAAMF\n CA=="},
      {"Int8", "AwAAAAMFCA=="},
      {"Int32", "DAAAAAMAAAAFAAAACAAAAA=="},
      {"UInt32", "DAAAAAMAAAAFAAAACAAAAA=="},
      {"Int64", "GAAAAAMAAAAAAAAABQAAAAAAAAAIAAAAAAAAAA=="},
      {"UInt64", "GAAAAAMAAAAAAAAABQAAAAAAAAAIAAAAAAAAAA=="},
      {"Float32", "DAAAAAAAQEAAAKBAAAAAQQ=="},
      {"Float64", "GAAAAAAAAAAAAAhAAAAAAAAAFEAAAAAAAAAgQA=="}};
  for (const auto& [type, text] : offsets) {
    const Grid grid = read(with("<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 5 8",
                                "<DataArray type=\"" + type + "\" Name=\"offsets\" format=\"binary\">" + text));
    EXPECT_EQ(grid.triangles.size(), 2u) << type;
  }
  // The same as appended data; its first four characters belong to no array.
  std::string appended = with("format=\"ascii\">3 5 8</DataArray>", "format=\"appended\" offset=\"4\"/>");
  appended.replace(appended.find("</VTKFile>"), std::string::npos,
                   "<AppendedData encoding=\"base64\">_AAAADAAAAAMAAAAFAAAACAAAAA==</AppendedData></VTKFile>");
  EXPECT_EQ(read(appended).triangles.size(), 2u);
}

// A line as `writeVtu` writes it: its nodes, the end of each line, their kinds, and whether they are closed.
TEST(ReadVtu, LinesHaveTwoNodesAndClosedOnesThree) {
  const auto line = [](const std::string& nodes, int ends, int closed) {
    std::string fields = "<FieldData>";
    for (const auto& [name, values] : {std::pair<std::string, std::string>{"line_nodes", nodes},
                                       {"line_ends", std::to_string(ends)},
                                       {"line_kinds", "0"},
                                       {"line_closed", std::to_string(closed)}})
      fields += "<DataArray type=\"Int64\" Name=\"" + name + "\" format=\"ascii\">" + values + "</DataArray>";
    return with("<Piece", fields + "</FieldData><Piece");
  };
  EXPECT_EQ(read(line("0 2", 2, 0)).lines.at(0).nodes, (std::vector<std::uint32_t>{0, 2}));
  EXPECT_TRUE(read(line("0 1 2", 3, 1)).lines.at(0).closed);
  for (const auto& text : {line("0 2", 1, 0), line("0 2", 0, 0), line("0 2", 2, 1)})
    EXPECT_NE(refusalOf(text).find("line 1 has too few nodes"), std::string::npos) << refusalOf(text);
  EXPECT_NE(refusalOf(line("0 9", 2, 0)).find("line 1 names a node that is not there"), std::string::npos);
  EXPECT_NE(refusalOf(line("0 2", 3, 0)).find("line 1 is of no kind that is known"), std::string::npos);
}

// The same two triangles compressed, as meshio writes files unless told otherwise; the depths in two blocks.
constexpr const char* kCompressed = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" compressor="vtkZLibDataCompressor">
<UnstructuredGrid>
<Piece NumberOfPoints="4" NumberOfCells="2">
<Points>
<DataArray type="Float32" NumberOfComponents="3" format="binary">
AQAAAOgDAAAwAAAAEwAAAA==eJxjYEAGDfaobHQ+AwMAOuQC/Q==
</DataArray>
</Points>
<Cells>
<DataArray type="Int32" Name="connectivity" format="binary">
AQAAAOgDAAAYAAAAFgAAAA==eJxjYGBgYARiJgYIANHMQAwAAGgACQ==
</DataArray>
<DataArray type="Int32" Name="offsets" format="binary">
AQAAAOgDAAAIAAAADgAAAA==eJxjZmBgYANiAAA4AAo=
</DataArray>
<DataArray type="UInt8" Name="types" format="binary">
AQAAAOgDAAACAAAACgAAAA==eJxjZQUAABEACw==
</DataArray>
</Cells>
<PointData>
<DataArray type="Float64" Name="depth" format="binary">
AgAAABgAAAAIAAAAFAAAAA0AAAA=eJxjYACBD/YMEOAAoTgcABe3Abh4nGNgAAEBBwAAaABR
</DataArray>
</PointData>
</Piece>
</UnstructuredGrid>
</VTKFile>
)";

TEST(ReadVtu, CompressedWithZlib) {
  const Grid grid = read(kCompressed);
  EXPECT_EQ(grid.nodes, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_EQ(grid.triangles.size(), 2u);
  EXPECT_EQ(grid.z, (std::vector<double>{-1, -2, -3, -4}));
  const std::string depths = "AgAAABgAAAAIAAAAFAAAAA0AAAA=eJxjYACBD/YMEOAAoTgcABe3Abh4nGNgAAEBBwAAaABR";
  const std::string damaged = "AgAAABgAAAAIAAAAFAAAAA0AAAA=eJxjYACBD/YMEOAAoTgcABe3Abh4nGNgAAEBBwAAAAAA",
                    too_many = "AAAAgAgAAAAAAAAA";
  for (const std::string& other : {damaged, too_many}) {
    std::string text = kCompressed;
    text.replace(text.find(depths), depths.size(), other);
    EXPECT_NE(refusalOf(text), "") << other;
  }
}

TEST(ReadVtu, DepthsOfOtherPrograms) {
  const auto depthsOf = [](const std::string& name, const std::string& values, const std::string& places) {
    std::string text = with("<Cells>", "<PointData><DataArray type=\"Float32\" Name=\"" + name +
                                           "\" format=\"ascii\">" + values + "</DataArray></PointData><Cells>");
    const std::string third = "0 0 -1  1 0 -2  1 1 -3  0 1 -4";
    return read(text.replace(text.find(third), third.size(), places)).z;
  };
  const std::string flat = "0 0 0  1 0 0  1 1 0  0 1 0", raised = "0 0 -1  1 0 -2  1 1 -3  0 1 -4";
  const std::vector<double> down{-5, -6, -7, -8}, up{5, 6, 7, 8}, of_places{-1, -2, -3, -4};
  EXPECT_EQ(depthsOf("z", "5 6 7 8", raised), up);
  EXPECT_EQ(depthsOf("Depth", "5 6 7 8", raised), down);
  EXPECT_EQ(depthsOf("bathymetry", "5 6 7 8", flat), down);
  EXPECT_EQ(depthsOf("Bathymetry", "-5 -6 -7 -8", flat), down);  // elevations under this name
  EXPECT_EQ(depthsOf("depth", "-5 -6 -7 -8", flat), up);
  EXPECT_EQ(depthsOf("bed_level", "5 6 7 8", flat), up);
  EXPECT_EQ(depthsOf("Elevation", "0 0.5 1 1", raised), of_places);  // of ParaView's filter
  EXPECT_EQ(depthsOf("h", "5 6 7 8", flat), std::vector<double>());
  EXPECT_EQ(depthsOf("depth", "5 6 7 8 9 10 11 12", flat), std::vector<double>());  // a vector
}

// 12.1 in single precision.
TEST(ReadVtu, SinglePrecisionHasTheDigitsThatItMeans) {
  EXPECT_EQ(read(with("<Cells>",
                      "<PointData><DataArray type=\"Float32\" Name=\"depth\" format=\"binary\">"
                      "EAAAAJqZQUGamUFBmplBQZqZQUE=</DataArray></PointData><Cells>"))
                .z,
            (std::vector<double>{-12.1, -12.1, -12.1, -12.1}));
}

TEST(ReadVtu, WhatCannotBeReadIsSaid) {
  const std::vector<std::pair<std::string, std::string>> refused{
      {"<a", "it is not XML"},
      {"<a/>", "it has no VTKFile"},
      {with("byte_order=\"LittleEndian\"", "compressor=\"vtkLZ4DataCompressor\""),
       "save it with ZLib or without compression"},
      {with("LittleEndian", "BigEndian"), "save it as little-endian"},
      {with("<UnstructuredGrid>", "<UnstructuredGrid><!-- --></UnstructuredGrid><UnstructuredGrid>"),
       "it has no unstructured grid"},
      {with("</Piece>", "</Piece><Piece/>"), "it has several pieces"},
      {with("NumberOfCells=\"3\"", "NumberOfCells=\"three\""), "its NumberOfCells is \"three\""},
      {with("NumberOfPoints=\"4\"", "NumberOfPoints=\"99999999\""), "its NumberOfPoints is \"99999999\""},
      {with("NumberOfPoints=\"4\"", "NumberOfPoints=\"5\""), "has 12 values where 15 are expected"},
      {with("Name=\"types\"", "Name=\"kinds\""), "there is no array \"types\" in Cells"},
      {with("Name=\"connectivity\"", "Name=\"nodes\""), "there is no array \"connectivity\" in Cells"},
      {with("5 3 5", "5 3 7"), "cell 3 is of type 7"},
      {with("5 3 5", "5 3 9"), "cell 3 does not have 4 nodes"},
      {with("5 3 5", "1e300 3 5"), "cell 1 is of no type"},
      {with("5 3 5", "nan 3 5"), "cell 1 is of no type"},
      {with("3 5 8", "3 5 9"), "cell 3 does not have 3 nodes"},
      {with("3 5 8", "-3 5 8"), "cell 1 does not have 3 nodes"},
      {with("0 1 2 0 1", "0 1 4 0 1"), "cell 1 names a node that is not there"},
      {with("0 1 2 0 1", "0 1 two"), "an array holds a value that is not a number"},
      {with("1 1 -3", "1 inf -3"), "node 3 has no finite coordinates"},
      {with("format=\"ascii\">5 3 5", "format=\"raw\">5 3 5"), "an array of format \"raw\""},
      {with("\"UInt8\" Name=\"types\" format=\"ascii\">5 3 5", "\"Bit\" Name=\"types\" format=\"binary\">AwAAAAUDBQ=="),
       "an array of type \"Bit\""},
      {with("format=\"ascii\">5 3 5", "format=\"binary\">AwA="), "an array lies beyond its end"},
      {with("format=\"ascii\">5 3 5", "format=\"binary\">BAAAAAUDBQ=="), "an array lies beyond its end"},
      {with("format=\"ascii\">5 3 5", "format=\"appended\" offset=\"0\">"), "an array lies beyond its end"},
      {with("<Piece",
            "<FieldData><DataArray type=\"Float64\" Name=\"region_names\" format=\"ascii\">1e9 "
            "0</DataArray></FieldData><Piece"),
       "its texts hold a value that is not a byte"},
      {with("</UnstructuredGrid>", "</UnstructuredGrid><AppendedData encoding=\"raw\">"),
       "its appended data does not start"},
  };
  for (const auto& [text, reason] : refused) {
    const std::string refusal = refusalOf(text);
    EXPECT_NE(refusal.find(reason), std::string::npos) << reason << "; it is: " << refusal;
    EXPECT_NE(refusal.find("a.vtu'"), std::string::npos) << refusal;
  }
  const TemporaryFolder folder;
  EXPECT_THROW(readVtu(folder / "nowhere.vtu", Crs{}), InputError);
}

}  // namespace
}  // namespace coastmesh
