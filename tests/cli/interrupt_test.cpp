#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

class Interrupted : public ProgramTest {
 protected:
  // Edges of 1 m on a lake of some kilometres: millions of triangles.
  std::vector<std::string> endlessRun() const {
    return {"mesh",       lake(),
            "-o",         file("out.gpkg"),
            "-o",         file("out.msh"),
            "--report",   file("report.json"),
            "--size-max", "1",
            "--progress", "json"};
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

// After a crash in a library or in our code, existing files are unchanged and one line reports the crash.
TEST_F(Interrupted, ByACrash) {
#ifdef COASTMESH_SANITIZED
  const std::vector<int> crashes = {SIGABRT};  // sanitizers handle the other signals
#else
  const std::vector<int> crashes = {SIGABRT, SIGSEGV, SIGBUS};
#endif
  for (const int crash : crashes) {
    write("out.gpkg", "precious");
    std::vector<std::string> arguments = endlessRun();
    arguments.push_back("--overwrite");
    const ProgramRun run = runAndSignal(arguments, R"("phase":"refine")", crash);
    EXPECT_EQ(run.code, 70) << run.errors;
    EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
    EXPECT_EQ(readText(file("out.gpkg")), "precious");
    EXPECT_EQ(names(), (std::set<std::string>{"lake.geojson", "out.gpkg"}));
  }
}

// The caller may ignore signals, as nohup does with SIGHUP, and a shell with SIGINT for background jobs: these stay
// ignored, and the others still stop the program.
TEST_F(Interrupted, NotByWhatIsIgnored) {
  const std::string run = "\"$0\" mesh '" + lake() + "' -o '" + file("out.gpkg") +
                          "' --size-max 1 --progress json > '" + file("log") + "' & until grep -qs refine '" +
                          file("log") + "'; do sleep 0.01; done\n";
  const ProgramRun stopped = runShell("trap '' HUP INT; " + run + "kill -HUP $!; kill -INT $!; sleep 1; kill -0 $! " +
                                      "|| exit 99; kill -TERM $!; wait $!");
  EXPECT_EQ(stopped.code, 5) << stopped.errors;
  EXPECT_TRUE(isOneErrorLine(stopped.errors)) << stopped.errors;
  const ProgramRun killed = runShell("trap '' HUP INT TERM; " + run + "kill -HUP $!; kill -TERM $!; sleep 1; " +
                                     "kill -0 $! || exit 99; kill -KILL $!; wait $!");
  EXPECT_EQ(killed.code, 128 + SIGKILL) << killed.errors;
  EXPECT_EQ(runShell("trap '' HUP INT TERM; \"$0\" mesh '" + lake() + "' -o '" + file("x.2dm") + "'").code, 0);
}

// Opening a pipe that nobody writes to blocks: only the watcher thread can then end the program.
TEST_F(Interrupted, WhileALibraryCallHangs) {
  ASSERT_EQ(mkfifo(file("pipe.geojson").c_str(), 0600), 0);
  const ProgramRun run = runAndSignal({"mesh", file("pipe.geojson"), "-o", file("out.gpkg"), "-o", file("out.nc"),
                                       "--report", file("report.json"), "--progress", "json"},
                                      R"("phase":"read")", SIGTERM);
  EXPECT_EQ(run.code, 5) << run.errors;
  EXPECT_TRUE(isOneErrorLine(run.errors));
  EXPECT_EQ(names(), std::set<std::string>{"pipe.geojson"});
}

}  // namespace

}  // namespace coastmesh::test
