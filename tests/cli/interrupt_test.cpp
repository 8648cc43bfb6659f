#include <gtest/gtest.h>
#include <signal.h>

#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

class Interrupted : public ProgramTest {
 protected:
  // Triangles of centimetres on a lake of kilometres: days of work.
  std::vector<std::string> endlessRun() const {
    return {"mesh",       lake(),          "-o",         file("out.gpkg"),
            "-o",         file("out.msh"), "--report",   file("report.json"),
            "--size-max", "0.02",          "--progress", "json"};
  }
  void expectNothingLeft() const { EXPECT_EQ(names(), std::set<std::string>{"lake.geojson"}); }
};

TEST_F(Interrupted, ByTerminalWhileRefining) {
  const ProgramRun run = runAndSignal(endlessRun(), R"("phase":"refine")", SIGINT);
  EXPECT_EQ(run.code, 5) << run.errors;
  EXPECT_TRUE(isOneErrorLine(run.errors));
  expectNothingLeft();
}

TEST_F(Interrupted, ByTerminationWhileReading) {
  const ProgramRun run = runAndSignal(endlessRun(), R"("phase":"read")", SIGTERM);
  EXPECT_EQ(run.code, 5) << run.errors;
  EXPECT_TRUE(isOneErrorLine(run.errors));
  expectNothingLeft();
}

TEST_F(Interrupted, ExistingOutputsStayAsTheyWere) {
  write("out.gpkg", "precious");
  std::vector<std::string> arguments = endlessRun();
  arguments.push_back("--overwrite");
  EXPECT_EQ(runAndSignal(arguments, R"("phase":"refine")", SIGTERM).code, 5);
  EXPECT_EQ(readText(file("out.gpkg")), "precious");
  EXPECT_EQ(names(), (std::set<std::string>{"lake.geojson", "out.gpkg"}));
}

}  // namespace

}  // namespace coastmesh::test
