#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/lake_with_depths.hpp"
#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

using ::testing::HasSubstr;

// A part of the lake in finer triangles, put into a mesh of all of it.
class Merge : public LakeWithDepths {
 protected:
  std::string whole(const std::string& name) const { return meshOf(name, "250"); }
  std::string part(const std::string& name) const {
    const std::string fine = meshOf("fine.nc", "60");
    const ProgramRun run = runProgram({"cut", fine, box(), "-o", file(name), "--quiet", "--overwrite"});
    EXPECT_EQ(run.code, 0) << run.errors;
    return file(name);
  }
};

// Counts of rows by item and mesh, and the sources of nodes.
struct SourceTable {
  std::map<std::string, std::size_t> rows;
  std::vector<std::pair<std::string, std::size_t>> nodes;

  explicit SourceTable(const std::vector<std::string>& lines) {
    EXPECT_EQ(lines[0], "item,number,mesh,source");
    for (std::size_t i = 1; i < lines.size(); ++i) {
      std::istringstream row(lines[i]);
      std::string item, number, mesh, source;
      std::getline(row, item, ',');
      std::getline(row, number, ',');
      std::getline(row, mesh, ',');
      std::getline(row, source, ',');
      ++rows[item + " " + mesh];
      if (item == "node") nodes.emplace_back(mesh, source.empty() ? 0 : std::stoul(source));
    }
  }
};

TEST_F(Merge, PutsAFinerPartIntoAMesh) {
  const std::string coarse = whole("whole.14"), fine = part("part.14");
  const ProgramRun run = runProgram(
      {"merge", coarse, fine, "-o", file("both.14"), "--assume-crs", "EPSG:4326", "--numbers", file("numbers.csv")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("part.14': "));
  EXPECT_THAT(run.output, HasSubstr(" triangles in place of "));
  EXPECT_THAT(run.output, HasSubstr("between both: "));
  const std::vector<std::string> of_whole = linesOf(coarse), of_part = linesOf(fine), both = linesOf(file("both.14"));
  std::size_t nodes = 0, triangles = 0, part_nodes = 0, part_triangles = 0;
  std::istringstream(both[1]) >> triangles >> nodes;
  std::istringstream(of_part[1]) >> part_triangles >> part_nodes;
  const SourceTable table(linesOf(file("numbers.csv")));
  EXPECT_EQ(table.rows.at("node 2"), part_nodes);
  EXPECT_EQ(table.rows.at("triangle 2"), part_triangles);
  EXPECT_GT(table.rows.at("node 1"), 20u);
  EXPECT_GT(table.rows.at("triangle 1"), 10u);
  ASSERT_EQ(table.nodes.size(), nodes);
  // Places and depths are the same text.
  const auto withoutNumber = [](const std::string& line) {
    return line.substr(line.find(' ', line.find_first_not_of(' ')));
  };
  for (std::size_t n = 0; n < nodes; ++n) {
    const auto& [mesh, source] = table.nodes[n];
    if (mesh.empty()) continue;
    EXPECT_EQ(withoutNumber(both[2 + n]), withoutNumber((mesh == "1" ? of_whole : of_part)[1 + source]));
  }
  const ProgramRun check = runProgram({"check", file("both.14"), "--target", "adcirc", "--assume-crs", "EPSG:4326"});
  EXPECT_EQ(check.code, 0) << check.output;
}

TEST_F(Merge, WorksOnEveryFormatAlike) {
  const std::string coarse = whole("whole.nc"), fine = part("part.nc");
  ASSERT_EQ(runProgram({"merge", coarse, fine, "-o", file("both.14"), "--quiet"}).code, 0);
  const std::vector<std::string> wanted = linesOf(file("both.14"));
  for (const std::string ending : {"gpkg", "14", "gr3", "2dm"}) {
    for (const std::string name : {"whole.", "part."})
      ASSERT_EQ(runProgram({"convert", file(name + "nc"), "-o", file(name + ending), "--quiet", "--overwrite"}).code,
                0);
    const ProgramRun run = runProgram({"merge", file("whole." + ending), file("part." + ending), "--assume-crs",
                                       "EPSG:4326", "-o", file("other.14"), "--overwrite"});
    ASSERT_EQ(run.code, 0) << ending << run.errors;
    const std::vector<std::string> lines = linesOf(file("other.14"));
    EXPECT_EQ(lines[1], wanted[1]) << ending;  // the numbers of triangles and nodes
  }
}

TEST_F(Merge, SeveralMeshesAndAModel) {
  const std::string coarse = whole("whole.nc");
  part("west.nc");
  ASSERT_EQ(
      runProgram({"cut", file("fine.nc"), "--bbox=-87.478,41.58,-87.45,41.65", "-o", file("east.nc"), "--quiet"}).code,
      0);
  const ProgramRun run = runProgram({"merge", coarse, file("west.nc"), file("east.nc"), "-o", file("all.gr3"),
                                     "--target", "schism", "--grade", "0.3"});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("west.nc': "));
  EXPECT_THAT(run.output, HasSubstr("east.nc': "));
  EXPECT_EQ(runProgram({"check", file("all.gr3"), "--target", "schism", "--assume-crs", "EPSG:4326"}).code, 0);
  ASSERT_EQ(runProgram({"merge", coarse, file("west.nc"), file("east.nc"), "-o", file("all.nc"), "--numbers",
                        file("numbers.csv"), "--quiet"})
                .code,
            0);
  const SourceTable table(linesOf(file("numbers.csv")));
  EXPECT_GT(table.rows.at("node 1"), 0u);
  EXPECT_GT(table.rows.at("node 2"), 0u);
  EXPECT_GT(table.rows.at("node 3"), 0u);
}

TEST_F(Merge, OfAnotherCrs) {
  const std::string coarse = whole("whole.nc");
  // Metres of a file that does not say its CRS.
  write("plane.2dm", "MESH2D\nE3T 1 1 2 3 1\nND 1 460000 4605000 0\nND 2 461000 4605000 0\nND 3 460500 4606000 0\n");
  const ProgramRun plane = runProgram({"merge", coarse, file("plane.2dm"), "-o", file("x.nc")});
  EXPECT_EQ(plane.code, 3);
  EXPECT_THAT(plane.errors, HasSubstr("plane.2dm' does not say its CRS, and the other mesh is in EPSG:4326"));
  const ProgramRun far =
      runProgram({"merge", coarse, file("plane.2dm"), "-o", file("x.nc"), "--assume-crs", "EPSG:32618"});
  EXPECT_EQ(far.code, 3);
  EXPECT_THAT(far.errors, HasSubstr("plane.2dm' cannot be put into '"));
  EXPECT_THAT(far.errors, HasSubstr("no water of the other one beside it"));
}

// A canal into a square sea, open where it is in the sea and across its far end, which one edge spans.
TEST_F(Merge, AnOpeningOfOneEdgeIsNamed) {
  const auto rectangle = [&](const std::string& name, const std::string& nodes) {
    return write(name, "4 2 0 0\n" + nodes + "4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
  };
  const auto openAt = [](const std::string& west, const std::string& east) {
    return "\"POLYGON ((" + west + " 3000, " + east + " 3000, " + east + " 6000, " + west + " 6000, " + west +
           " 3000))\",open\n";
  };
  const auto merged = [&](const std::string& open) {
    write("open.csv", "WKT,type\n" + open);
    const std::string sea = rectangle("sea.poly", "1 0 0\n2 10000 0\n3 10000 10000\n4 0 10000\n"),
                      canal = rectangle("canal.poly", "1 8000 4000\n2 14000 4000\n3 14000 5000\n4 8000 5000\n");
    const auto mesh = [&](const std::string& input, const std::string& name, std::vector<std::string> more) {
      std::vector<std::string> all{"mesh", input, "-o", file(name), "--size-max", "1300", "--quiet", "--overwrite"};
      all.insert(all.end(), more.begin(), more.end());
      EXPECT_EQ(runProgram(all).code, 0);
      return file(name);
    };
    const ProgramRun run =
        runProgram({"merge", mesh(sea, "sea.nc", {}), mesh(canal, "canal.nc", {"--boundaries", file("open.csv")}), "-o",
                    file("both.nc"), "--overwrite"});
    EXPECT_EQ(run.code, 0) << run.errors;
    return run.errors;
  };
  EXPECT_THAT(merged(openAt("7000", "10100") + openAt("13900", "15000")),
              HasSubstr("canal.nc': 1 open boundary is a single edge between shores, at (14000, 4500): "));
  EXPECT_THAT(merged(openAt("7000", "10100")), ::testing::Not(HasSubstr("single edge")));
}

TEST_F(Merge, RefusesAndWritesNothing) {
  const std::string coarse = whole("whole.nc"), fine = part("part.nc");
  const auto refused = [&](const std::vector<std::string>& arguments, int code, const std::string& text) {
    std::vector<std::string> all{"merge"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    all.insert(all.end(), {"-o", file("x.nc")});
    const ProgramRun run = runProgram(all);
    EXPECT_EQ(run.code, code) << run.errors;
    EXPECT_THAT(run.errors, HasSubstr(text));
    EXPECT_FALSE(std::filesystem::exists(file("x.nc")));
  };
  refused({coarse}, 2, "INSERT");
  refused({coarse, coarse}, 3, "covers all");
  refused({coarse, file("none.nc")}, 3, "none.nc");
  refused({coarse, fine, "--numbers", file("n.csv"), "--target", "adcirc"}, 2, "--numbers");
  // Depths for a few nodes between two meshes without any.
  ASSERT_EQ(runProgram({"mesh", lake(), "-o", file("bare.nc"), "--size-max", "250"}).code, 0);
  ASSERT_EQ(runProgram({"mesh", lake(), "-o", file("bare_fine.nc"), "--size-max", "60"}).code, 0);
  ASSERT_EQ(runProgram({"cut", file("bare_fine.nc"), box(), "-o", file("bare_part.nc")}).code, 0);
  refused({file("bare.nc"), file("bare_part.nc"), "--bathymetry", dem()}, 3, "convert --bathymetry");
  const ProgramRun over = runProgram({"merge", coarse, fine, "-o", fine, "--overwrite"});
  EXPECT_EQ(over.code, 2) << over.errors;
}

}  // namespace

}  // namespace coastmesh::test
