// `check` on meshes of other programs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/cli/program.hpp"

namespace coastmesh::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Check : public ProgramTest {
 protected:
  // A fort.14 without boundaries: 4 by 4 squares of 1 km at each of `origins`, in metres.
  std::string sheets(const std::string& name, const std::vector<std::pair<double, double>>& origins,
                     double depth) const {
    constexpr int kSide = 4, kNodes = (kSide + 1) * (kSide + 1);
    std::string nodes, triangles;
    int node = 0, triangle = 0;
    for (std::size_t sheet = 0; sheet < origins.size(); ++sheet) {
      char line[100];
      for (int j = 0; j <= kSide; ++j) {
        for (int i = 0; i <= kSide; ++i) {
          std::snprintf(line, sizeof line, "%d %.1f %.1f %g\n", ++node, origins[sheet].first + 1000.0 * i,
                        origins[sheet].second + 1000.0 * j, depth);
          nodes += line;
        }
      }
      for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) {
          const int a = static_cast<int>(sheet) * kNodes + j * (kSide + 1) + i + 1, d = a + kSide + 1;
          std::snprintf(line, sizeof line, "%d 3 %d %d %d\n", ++triangle, a, a + 1, d + 1);
          triangles += line;
          std::snprintf(line, sizeof line, "%d 3 %d %d %d\n", ++triangle, a, d + 1, d);
          triangles += line;
        }
      }
    }
    return write(name, "sheets\n" + std::to_string(triangle) + " " + std::to_string(node) + "\n" + nodes + triangles +
                           "0\n0\n0\n0\n");
  }
};

TEST_F(Check, SheetsOverOneAnother) {
  const std::string one = sheets("one.14", {{0, 0}}, 10.0), two = sheets("two.14", {{0, 0}, {1500, 1500}}, 10.0);
  EXPECT_EQ(runProgram({"check", one}).code, 0);
  const ProgramRun plain = runProgram({"check", two});
  EXPECT_EQ(plain.code, 1);
  EXPECT_THAT(plain.output, AllOf(HasSubstr("overlapping triangles: "), HasSubstr(", with triangle ")));
  EXPECT_EQ(runProgram({"convert", two, "-o", file("out.14"), "--target", "adcirc"}).code, 1);
}

TEST_F(Check, NodesThatDoNotHangTogether) {
  const ProgramRun hanging = runProgram({"check", sheets("hanging.14", {{0, 0}, {4000, 500}}, 10.0)});
  EXPECT_EQ(hanging.code, 1);
  EXPECT_THAT(hanging.output, HasSubstr("hanging node: 8"));
  const ProgramRun seam = runProgram({"check", sheets("seam.14", {{0, 0}, {4000, 0}}, 10.0)});
  EXPECT_EQ(seam.code, 1);
  EXPECT_THAT(seam.output, HasSubstr("repeated node: 5"));
}

TEST_F(Check, DepthsThatEarthDoesNotHaveAreWarnedOf) {
  const ProgramRun run = runProgram({"check", sheets("deep.14", {{0, 0}}, -99999.0)});
  EXPECT_EQ(run.code, 0);
  EXPECT_THAT(run.errors, HasSubstr("25 of 25 nodes have depths that do not occur on Earth, such as -99999 m"));
  EXPECT_EQ(runProgram({"check", sheets("sea.14", {{0, 0}}, 10900.0)}).errors, "");
}

TEST_F(Check, TimeStepsNeedDepths) {
  for (const double depth : {0.0, -3.0}) {
    const ProgramRun run = runProgram({"check", sheets("dry.14", {{0, 0}}, depth), "--time-step", "10"});
    EXPECT_EQ(run.code, 3);
    EXPECT_TRUE(isOneErrorLine(run.errors));
    EXPECT_THAT(run.errors, AllOf(HasSubstr("--time-step needs depths"), HasSubstr("dry.14")));
  }
  EXPECT_EQ(runProgram({"check", sheets("wet.14", {{0, 0}}, 10.0), "--time-step", "10"}).code, 0);
}

// A run that misses its bounds reports it even with --quiet.
TEST_F(Check, QuietMeshesSayThatTheyFallShort) {
  const std::vector<std::string> command{"mesh",    lake(),           "-o", file("m.nc"), "--min-angle", "40",
                                         "--quiet", "--max-vertices", "14"};
  const ProgramRun run = runProgram(command);
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.output, "");
  EXPECT_THAT(run.errors, HasSubstr("short of what was asked: "));
  EXPECT_THAT(run.errors, HasSubstr(" the bounds on angles or lengths, the first at (-87."));
}

}  // namespace
}  // namespace coastmesh::test
