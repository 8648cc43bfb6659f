// Meshes of triangles and quadrilaterals through the commands that read meshes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

using ::testing::HasSubstr;
using ::testing::IsSubsetOf;

// A grid in SCHISM's format: the places of nodes as texts, and elements as sets of these.
struct Gr3 {
  using Element = std::multiset<std::string>;
  std::multiset<Element> triangles, quads;

  explicit Gr3(const std::string& text) {
    std::istringstream file(text);
    std::string line;
    std::getline(file, line);
    std::size_t elements = 0, nodes = 0;
    file >> elements >> nodes;
    std::vector<std::string> places(nodes + 1);
    for (std::size_t i = 1; i <= nodes; ++i) {
      std::string number, x, y, z;
      file >> number >> x >> y >> z;
      places[i] = x + " " + y;
    }
    for (std::size_t e = 0; e < elements; ++e) {
      std::size_t number = 0, corners = 0;
      file >> number >> corners;
      Element element;
      for (std::size_t i = 0; i < corners; ++i) {
        std::size_t node = 0;
        file >> node;
        element.insert(places.at(node));
      }
      (corners == 4 ? quads : triangles).insert(element);
    }
  }
};

// A bay of triangles, two for each square of ten metres, and a river of quadrilaterals east of it.
class Quads : public ProgramTest {
 protected:
  Quads() {
    const auto node = [](int i, int j) { return std::to_string(j * (kColumns + 1) + i + 1); };
    std::string nodes, elements;
    std::size_t count = 0;
    for (int j = 0; j <= kRows; ++j)
      for (int i = 0; i <= kColumns; ++i)
        nodes += node(i, j) + " " + std::to_string(1000 + 10 * i) + " " + std::to_string(1000 + 10 * j) + " 5\n";
    const auto add = [&](const std::vector<std::string>& corners) {
      elements += std::to_string(++count) + " " + std::to_string(corners.size());
      for (const std::string& corner : corners) elements += " " + corner;
      elements += "\n";
    };
    for (int j = 0; j < kRows; ++j)
      for (int i = 0; i < kColumns; ++i) {
        const std::string a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
        if (i >= kBay) {
          add({a, b, c, d});
        } else {
          add({a, b, c});
          add({a, c, d});
        }
      }
    const int all = (kColumns + 1) * (kRows + 1);
    writeText(file("mixed.gr3"),
              "mixed\n" + std::to_string(count) + " " + std::to_string(all) + "\n" + nodes + elements);
  }

  ProgramRun run(std::vector<std::string> arguments) const {
    ProgramRun done = runProgram(arguments);
    EXPECT_EQ(done.code, 0) << done.errors << done.output;
    return done;
  }
  Gr3 read(const std::string& name) const { return Gr3(readText(file(name))); }

  static constexpr int kColumns = 24, kRows = 8, kBay = 12;
};

TEST_F(Quads, AreDescribedAndChecked) {
  EXPECT_THAT(run({"info", file("mixed.gr3")}).output, HasSubstr("192 triangles, 96 quadrilaterals"));
  EXPECT_THAT(run({"info", file("mixed.gr3"), "--json"}).output, HasSubstr("\"quadrilaterals\": {\n    \"count\": 96"));
  EXPECT_THAT(run({"check", file("mixed.gr3"), "--min-angle", "44"}).output, HasSubstr(" 0 defects"));
  const ProgramRun adcirc = runProgram({"check", file("mixed.gr3"), "--target", "adcirc"});
  EXPECT_EQ(adcirc.code, 1);
  EXPECT_THAT(adcirc.output, HasSubstr("adcirc: quadrilateral: 96"));
  EXPECT_THAT(adcirc.output, HasSubstr("element 25\n"));  // the first of the river, after the bay's in its row
}

TEST_F(Quads, AreConverted) {
  for (const std::string ending : {"nc", "2dm", "msh", "vtu", "gpkg"}) {
    run({"convert", file("mixed.gr3"), "-o", file("m." + ending)});
    run({"convert", file("m." + ending), "-o", file("back.gr3"), "--overwrite"});
    EXPECT_EQ(read("back.gr3").quads, read("mixed.gr3").quads) << ending;
    EXPECT_EQ(read("back.gr3").triangles, read("mixed.gr3").triangles) << ending;
  }
  EXPECT_THAT(run({"convert", file("mixed.gr3"), "-o", file("m.14")}).errors,
              HasSubstr("cannot hold 96 quadrilaterals, which become two triangles each"));
  run({"check", file("m.14"), "--target", "adcirc"});
}

TEST_F(Quads, StayInPartsThatAreCutOut) {
  run({"cut", file("mixed.gr3"), "--bbox=1050,990,1172,1200", "-o", file("part.gr3"), "--numbers",
       file("numbers.csv")});
  const Gr3 part = read("part.gr3");
  EXPECT_EQ(part.quads.size(), 40u);  // the middles of five columns are in the box
  EXPECT_THAT(part.quads, IsSubsetOf(read("mixed.gr3").quads));
  EXPECT_THAT(part.triangles, IsSubsetOf(read("mixed.gr3").triangles));
  // The first row of the whole has 24 triangles, then 12 quadrilaterals; the part begins in its sixth column.
  const std::string numbers = readText(file("numbers.csv"));
  EXPECT_THAT(numbers, HasSubstr("\ntriangle,1,11\n"));
  EXPECT_THAT(numbers, HasSubstr("\nquadrilateral,15,25\n"));
  EXPECT_THAT(numbers, HasSubstr("\ntriangle,20,47\n"));
  run({"check", file("part.gr3"), "--target", "schism"});
}

TEST_F(Quads, StayWhereOthersAreMeshedAnew) {
  run({"remesh", file("mixed.gr3"), "--bbox=990,990,1120,1200", "--size", "6", "-o", file("finer.gr3")});
  EXPECT_EQ(read("finer.gr3").quads, read("mixed.gr3").quads);
  EXPECT_GT(read("finer.gr3").triangles.size(), 400u);
  run({"check", file("finer.gr3"), "--target", "schism"});
  // Those in the part become triangles.
  run({"remesh", file("mixed.gr3"), "--bbox=1150,990,1190,1200", "--size", "6", "-o", file("less.gr3")});
  EXPECT_EQ(read("less.gr3").quads.size(), 96u - 32u);
  run({"check", file("less.gr3"), "--target", "schism"});
}

TEST_F(Quads, StayInMeshesThatAreMerged) {
  run({"cut", file("mixed.gr3"), "--bbox=1080,990,1250,1200", "-o", file("river.gr3")});
  run({"cut", file("mixed.gr3"), "--bbox=990,990,1081,1200", "-o", file("bay.gr3")});
  run({"remesh", file("bay.gr3"), "--bbox=990,990,1060,1200", "--size", "5", "-o", file("fine.gr3")});
  // The bay in finer triangles, put into the whole: the river stays.
  run({"merge", file("mixed.gr3"), file("fine.gr3"), "-o", file("both.gr3")});
  EXPECT_EQ(read("both.gr3").quads, read("mixed.gr3").quads);
  run({"check", file("both.gr3"), "--target", "schism"});
  // The river, put into the bay: both stay.
  run({"merge", file("bay.gr3"), file("river.gr3"), "-o", file("joined.gr3")});
  EXPECT_EQ(read("joined.gr3").quads, read("river.gr3").quads);
  run({"check", file("joined.gr3"), "--target", "schism"});
}

TEST_F(Quads, AreAssignedWhole) {
  const ProgramRun done = run({"partition", file("mixed.gr3"), "4", "-o", file("partition.prop")});
  EXPECT_THAT(done.output, HasSubstr(" elements, balance 1.0"));
  EXPECT_EQ(std::ranges::count(readText(file("partition.prop")), '\n'), 192 + 96);
}

}  // namespace

}  // namespace coastmesh::test
