#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace coastmesh::test {

// What a run of the program left behind.
struct ProgramRun {
  int code = -1;       // exit code; 128 + the signal's number where one killed it
  std::string output;  // standard output
  std::string errors;  // standard error
};

// Runs the coastmesh program to its end.
ProgramRun runProgram(const std::vector<std::string>& arguments);

// Runs a script of the shell in which "$0" is the program.
ProgramRun runShell(const std::string& script);

// Starts the program, sends `signal_number` once its standard output holds `awaited`, and waits for its end.
ProgramRun runAndSignal(const std::vector<std::string>& arguments, const std::string& awaited, int signal_number);

// Starts the program, sends `signal_number` as soon as `due` says so, asked every millisecond, and waits for its end.
ProgramRun runAndSignal(const std::vector<std::string>& arguments, const std::function<bool()>& due, int signal_number);

// The same, for what may be over before the signal comes on a busy machine: then `undo` takes away what was made, and
// it is run again, up to a bound.
template <class Awaited>
ProgramRun runUntilSignalled(const std::vector<std::string>& arguments, const Awaited& awaited, int signal_number,
                             const std::function<void()>& undo) {
  constexpr int kMostRuns = 20;
  ProgramRun run;
  for (int i = 0; i < kMostRuns; ++i) {
    run = runAndSignal(arguments, awaited, signal_number);
    if (run.code != 0) break;
    undo();
  }
  return run;
}

// What it says of itself, as 1.2.3.
std::string programVersion();

// The bytes of a file that the program keeps for itself, as those of another version of it would begin.
std::string withVersion(std::string bytes, const std::string& version);

// A file of tests/cli/inputs.
std::string inputFile(const std::string& name);

std::string readText(const std::filesystem::path& path);
void writeText(const std::filesystem::path& path, const std::string& text);

// A polygon layer in longitudes and latitudes; each ring closes itself.
using LonLatRing = std::vector<std::pair<double, double>>;
std::string geoJsonPolygons(const std::vector<std::vector<LonLatRing>>& polygons);

// A test with a folder of its own, which goes with it.
class ProgramTest : public testing::Test {
 protected:
  ProgramTest();
  ~ProgramTest() override;

  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const;
  // All that lies in the folder, hidden files too.
  std::set<std::string> names() const;

  // A lake of some 2 km with an island.
  std::string lake() const;

 private:
  std::filesystem::path folder_;
};

// One sentence on standard error, as every error is reported.
testing::AssertionResult isOneErrorLine(const std::string& errors);

}  // namespace coastmesh::test
