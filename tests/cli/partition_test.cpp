#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

// The numbers of each line, `columns` of them, as Fortran's `read(unit, *)` needs them. Expects nothing else in a line.
std::vector<std::vector<long>> rowsOf(const std::string& path, std::size_t columns) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  std::vector<std::vector<long>> rows;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::vector<long>& row = rows.emplace_back();
    for (long value; words >> value;) row.push_back(value);
    EXPECT_TRUE(words.eof()) << path << ": " << line;
    EXPECT_EQ(row.size(), columns) << path << ": " << line;
  }
  return rows;
}

class Partition : public ProgramTest {
 protected:
  // A mesh of some thousand triangles.
  std::string mesh() const {
    const std::string path = file("mesh.2dm");
    const ProgramRun run = runProgram({"mesh", lake(), "-o", path, "--size-max", "60", "--quiet"});
    EXPECT_EQ(run.code, 0) << run.errors;
    return path;
  }
  // The triangles of a .2dm in file order, nodes counted from 1, and the number of nodes.
  static std::pair<std::vector<std::array<long, 3>>, std::size_t> trianglesOf(const std::string& path) {
    std::ifstream in(path);
    std::vector<std::array<long, 3>> triangles;
    std::size_t nodes = 0;
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      std::string card;
      long id = 0, a = 0, b = 0, c = 0;
      words >> card >> id >> a >> b >> c;
      if (card == "E3T") triangles.push_back({a, b, c});
      if (card == "ND") ++nodes;
    }
    return {triangles, nodes};
  }
};

// partition.prop as SCHISM's partition_hgrid requires it: elements in order, ranks from 0 to one less than the number
// of processes, each with some elements.
TEST_F(Partition, SchismReadsItsFile) {
  const std::string grid = mesh();
  ASSERT_EQ(runProgram({"partition", grid, "7", "-o", file("partition.prop"), "--quiet"}).code, 0);
  const auto rows = rowsOf(file("partition.prop"), 2);
  const auto [triangles, nodes] = trianglesOf(grid);
  ASSERT_EQ(rows.size(), triangles.size());
  std::map<long, std::size_t> sizes;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i][0], static_cast<long>(i) + 1);
    ++sizes[rows[i][1]];
  }
  EXPECT_EQ(sizes.size(), 7u);
  EXPECT_EQ(sizes.begin()->first, 0);
  EXPECT_EQ(sizes.rbegin()->first, 6);
  for (const auto& [rank, size] : sizes)
    EXPECT_LE(static_cast<double>(size), 1.03 * static_cast<double>(rows.size()) / 7.0) << rank;
}

// partmesh.txt as adcprep requires it: a subdomain per node, from 1 (with a 0 in it, adcprep adds 1 to all).
TEST_F(Partition, AdcprepReadsItsFile) {
  const std::string grid = mesh();
  ASSERT_EQ(runProgram({"partition", grid, "7", "-o", file("partmesh.txt"), "--quiet"}).code, 0);
  const auto rows = rowsOf(file("partmesh.txt"), 1);
  const auto [triangles, nodes] = trianglesOf(grid);
  ASSERT_EQ(rows.size(), nodes);
  std::set<long> subdomains;
  for (const auto& row : rows) subdomains.insert(row[0]);
  EXPECT_EQ(subdomains, (std::set<long>{1, 2, 3, 4, 5, 6, 7}));
}

TEST_F(Partition, OfAMeshIsThatOfItsFile) {
  const ProgramRun run = runProgram({"mesh",        lake(),
                                     "-o",          file("a.14"),
                                     "-o",          file("a.prop"),
                                     "-o",          file("a_partmesh.txt"),
                                     "-o",          file("a.msh"),
                                     "-o",          file("a.nc"),
                                     "--size-max",  "60",
                                     "--partition", "5",
                                     "--threads",   "1",
                                     "--report",    file("r.json")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.errors, ::testing::Not(HasSubstr("cannot hold")));
  EXPECT_THAT(run.output, HasSubstr("5 parts of "));
  const Json report = Json::parse(readText(file("r.json")))["partition"];
  EXPECT_EQ(report["parts"], 5);
  EXPECT_LE(report["elements"]["balance"], 1.03);
  EXPECT_GT(report["nodes"]["edge_cut"], 0);
  // Again from the file, with the default number of threads.
  ASSERT_EQ(runProgram({"partition", file("a.nc"), "5", "-o", file("b.prop"), "-o", file("b_partmesh.txt"), "-o",
                        file("b.nc"), "--quiet"})
                .code,
            0);
  EXPECT_EQ(readText(file("a.prop")), readText(file("b.prop")));
  EXPECT_EQ(readText(file("a_partmesh.txt")), readText(file("b_partmesh.txt")));
  EXPECT_EQ(readText(file("a.nc")), readText(file("b.nc")));
  // Files that hold parts keep them.
  for (const std::string name : {"a.nc", "a.msh"}) {
    ASSERT_EQ(runProgram({"convert", file(name), "-o", file("c.prop"), "--quiet", "--overwrite"}).code, 0) << name;
    EXPECT_EQ(readText(file("a.prop")), readText(file("c.prop"))) << name;
  }
  ASSERT_EQ(runProgram({"convert", file("a.msh"), "-o", file("d.msh"), "--quiet"}).code, 0);
  EXPECT_EQ(readText(file("a.msh")), readText(file("d.msh")));
}

// The lake with depths from 7 m in the east to 21 m in the south-west, in longitudes and latitudes.
class PartitionByWork : public Partition {
 protected:
  std::string deepLake() const {
    std::string raster = "ncols 2\nnrows 2\nxllcorner -87.52\nyllcorner 41.58\ncellsize 0.03\n-20 -10\n-900 -10\n";
    write("deep.asc", raster);
    write("deep.prj",
          "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],"
          "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]]");
    const ProgramRun run =
        runProgram({"mesh", lake(), "-o", file("nod2d.out"), "-o", file("deep.nc"), "--size-max", "60", "--bathymetry",
                    file("deep.asc"), "--attribute", "cost=" + file("deep.asc"), "--quiet", "--overwrite"});
    EXPECT_EQ(run.code, 0) << run.errors;
    return file("nod2d.out");
  }
  // The section of the report of a run that is to succeed.
  Json partitioned(const std::vector<std::string>& options) const {
    std::vector<std::string> arguments{"partition", file("nod2d.out"), "4", "--report", file("r.json"), "--overwrite"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, 0) << run.errors;
    return Json::parse(readText(file("r.json")))["partition"];
  }
};

// FESOM2 has layers of levels: those of the aux3d.out beside the folder are counted.
TEST_F(PartitionByWork, Fesom2GetsTheSameLayersInAllParts) {
  deepLake();
  std::filesystem::create_directory(file("dist_4"));
  const std::string parts = file("dist_4/rpart.out");
  const auto sizes = [](const Json& report) {
    return report["nodes"]["most"].get<double>() / report["nodes"]["least"].get<double>();
  };
  const Json layers = partitioned({"-o", parts});
  EXPECT_EQ(layers["weight"], "layers");
  EXPECT_LE(layers["nodes"]["balance"], 1.03);
  EXPECT_GT(sizes(layers), 1.5);
  const std::string by_layers = readText(parts);
  const Json even = partitioned({"-o", parts, "--partition-weight", "even"});
  EXPECT_EQ(even["weight"], "even");
  EXPECT_LT(sizes(even), 1.2);
  EXPECT_NE(readText(parts), by_layers);
  // With the file given, and in the run that makes the mesh.
  EXPECT_EQ(partitioned({"-o", parts, "--partition-levels", file("aux3d.out")}), layers);
  EXPECT_EQ(readText(parts), by_layers);
  ASSERT_EQ(runProgram({"mesh", lake(), "-o", file("nod2d.out"), "-o", parts, "--size-max", "60", "--bathymetry",
                        file("deep.asc"), "--partition", "4", "--quiet", "--overwrite"})
                .code,
            0);
  EXPECT_EQ(readText(parts), by_layers);
  // Two levels: all nodes have the four layers that FESOM2 needs.
  write("aux3d.out", std::regex_replace(readText(file("aux3d.out")),
                                        std::regex("^[0-9]+\n(0\n)(-5\n)[^]*?(-6[0-9]{3}\n)"), "3\n$1$2$3"));
  EXPECT_LT(sizes(partitioned({"-o", parts})), 1.2);
}

TEST_F(PartitionByWork, OtherFilesAreEvenUnlessLevelsOrAnAttributeAreGiven) {
  deepLake();
  const std::string parts = file("partition.prop");
  EXPECT_EQ(partitioned({"-o", parts})["weight"], "even");
  const std::string even = readText(parts);
  write("vgrid.in",
        "2\n12 6 30.\nZ levels\n1 -5000.\n2 -600.\n3 -400.\n4 -200.\n5 -100.\n6 -30.\nS levels\n"
        "10. 1. 1.e-4\n6 -1.\n7 -0.8\n8 -0.6\n9 -0.4\n10 -0.2\n11 -0.1\n12 0.\n");
  const Json layers = partitioned({"-o", parts, "--partition-levels", file("vgrid.in")});
  EXPECT_EQ(layers["weight"], "layers");
  EXPECT_LE(layers["elements"]["balance"], 1.03);
  EXPECT_NE(readText(parts), even);
  const ProgramRun run =
      runProgram({"partition", file("deep.nc"), "4", "-o", parts, "--partition-weight", "cost", "--overwrite"});
  EXPECT_EQ(run.code, 3);
  EXPECT_THAT(run.errors, HasSubstr("cost: it is negative at node 1"));
  ASSERT_EQ(runProgram({"convert", file("deep.nc"), "-o", file("even.nc"), "--attribute", "load=2", "--quiet"}).code,
            0);
  const ProgramRun loaded =
      runProgram({"partition", file("even.nc"), "4", "-o", parts, "--partition-weight", "load", "--overwrite"});
  EXPECT_EQ(loaded.code, 0) << loaded.errors;
  EXPECT_THAT(loaded.output, HasSubstr(" by load; "));
}

TEST_F(PartitionByWork, WhatIsNoVerticalGridIsRefused) {
  deepLake();
  const auto refused = [&](const std::string& path, int code, const std::string& why) {
    const ProgramRun run =
        runProgram({"partition", file("nod2d.out"), "4", "-o", file("a.prop"), "--partition-levels", path});
    EXPECT_EQ(run.code, code) << run.errors;
    EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
    EXPECT_THAT(run.errors, HasSubstr(why));
  };
  refused(write("levels.txt", "3\n"), 2, "neither a vgrid.in of SCHISM nor an aux3d.out of FESOM2");
  refused(file("vgrid.in"), 3, "vgrid.in");
  refused(write("vgrid.in", "1\n5\n3 3 3\n"), 3, "has the levels of 3 nodes, and the mesh has");
}

// Reads the sections about parts as Gmsh's manual describes them: every element is in a declared partitioned entity,
// which belongs to one part and whose parent is declared; tags of entities are unique.
TEST_F(Partition, GmshEntitiesAreDeclared) {
  ASSERT_EQ(runProgram({"partition", mesh(), "5", "-o", file("a.msh"), "-o", file("a.prop"), "--quiet"}).code, 0);
  std::ifstream in(file("a.msh"));
  const auto seek = [&in](const std::string& section) {
    for (std::string line; std::getline(in, line);)
      if (line == section) return;
    FAIL() << section;
  };
  const auto next = [&in] {
    std::string line;
    EXPECT_TRUE(std::getline(in, line));
    return std::istringstream(line);
  };
  const auto number = [](std::istringstream& words) {
    double value = 0;
    EXPECT_TRUE(words >> value);
    return value;
  };
  std::set<std::pair<int, long>> entities;
  seek("$Entities");
  std::istringstream counts = next();
  const long points = static_cast<long>(number(counts)), curves = static_cast<long>(number(counts)),
             surfaces = static_cast<long>(number(counts));
  EXPECT_EQ(points, 0);
  for (long i = 0; i < curves + surfaces; ++i) {
    std::istringstream words = next();
    EXPECT_TRUE(entities.emplace(i < curves ? 1 : 2, static_cast<long>(number(words))).second);
  }
  seek("$PartitionedEntities");
  EXPECT_EQ(next().str(), "5");
  EXPECT_EQ(next().str(), "0");  // ghosts
  counts = next();
  EXPECT_EQ(number(counts), 0.0);
  const long parts_of_curves = static_cast<long>(number(counts)), parts_of_surfaces = static_cast<long>(number(counts));
  EXPECT_EQ(number(counts), 0.0);
  std::map<std::pair<int, long>, long> part_of;
  for (long i = 0; i < parts_of_curves + parts_of_surfaces; ++i) {
    std::istringstream words = next();
    const int dimension = i < parts_of_curves ? 1 : 2;
    const long tag = static_cast<long>(number(words));
    EXPECT_EQ(number(words), dimension);
    EXPECT_TRUE(entities.contains({dimension, static_cast<long>(number(words))}));
    EXPECT_EQ(number(words), 1.0);  // parts
    const long part = static_cast<long>(number(words));
    EXPECT_TRUE(part >= 1 && part <= 5);
    EXPECT_FALSE(entities.contains({dimension, tag}));
    EXPECT_TRUE(part_of.try_emplace({dimension, tag}, part).second);
    for (int k = 0; k < 6; ++k) number(words);  // box
    const long groups = static_cast<long>(number(words));
    for (long k = 0; k < groups; ++k) number(words);
    const long around = static_cast<long>(number(words));
    for (long k = 0; k < around; ++k) {
      const auto curve = part_of.find({1, static_cast<long>(number(words))});
      ASSERT_NE(curve, part_of.end());
      EXPECT_EQ(curve->second, part);
    }
    EXPECT_TRUE((words >> std::ws).eof());
  }
  EXPECT_EQ(next().str(), "$EndPartitionedEntities");
  seek("$Nodes");
  counts = next();
  for (long blocks = static_cast<long>(number(counts)); blocks > 0; --blocks) {
    std::istringstream words = next();
    const int dimension = static_cast<int>(number(words));
    EXPECT_TRUE(part_of.contains({dimension, static_cast<long>(number(words))}));
    number(words);
    const long count = static_cast<long>(number(words));
    for (long i = 0; i < 2 * count; ++i) next();
  }
  seek("$Elements");
  counts = next();
  std::map<long, long> part_of_triangle;  // by tag
  std::set<long> tags;
  for (long blocks = static_cast<long>(number(counts)); blocks > 0; --blocks) {
    std::istringstream words = next();
    const int dimension = static_cast<int>(number(words));
    const auto found = part_of.find({dimension, static_cast<long>(number(words))});
    ASSERT_NE(found, part_of.end());
    number(words);
    for (long count = static_cast<long>(number(words)); count > 0; --count) {
      std::istringstream element = next();
      const long tag = static_cast<long>(number(element));
      EXPECT_TRUE(tags.insert(tag).second);
      if (dimension == 2) part_of_triangle[tag] = found->second;
    }
  }
  const auto rows = rowsOf(file("a.prop"), 2);
  ASSERT_EQ(part_of_triangle.size(), rows.size());
  auto row = rows.begin();
  for (const auto& [tag, part] : part_of_triangle) EXPECT_EQ(part, (*row++)[1] + 1);
}

TEST_F(Partition, WhatCannotBeIsRefused) {
  const auto refused = [&](const std::vector<std::string>& arguments, int code, const std::string& why) {
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, code) << run.errors;
    EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
    EXPECT_THAT(run.errors, HasSubstr(why));
  };
  const std::string grid = mesh();
  refused({"mesh", lake(), "-o", file("a.prop")}, 2, "--partition");
  refused({"partition", grid, "4", "-o", file("a.2dm")}, 2, "no output can hold parts");
  refused({"partition", grid, "0", "-o", file("a.prop")}, 2, "N");
  refused({"partition", grid, "four", "-o", file("a.prop")}, 2, "N");
  refused({"partition", grid, "900000", "-o", file("a.prop")}, 3, "too few");
  refused({"convert", grid, "-o", file("a.prop")}, 4, "--partition");
  EXPECT_EQ(names().count("a.prop"), 0u);
}

}  // namespace

}  // namespace coastmesh::test
