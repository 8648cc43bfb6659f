#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace coastmesh::test {

// The result of a run of the program.
struct ProgramRun {
  int code = -1;       // exit code, or 128 + the number of the signal that killed it
  std::string output;  // standard output
  std::string errors;  // standard error
};

// Runs the coastmesh program to its end.
ProgramRun runProgram(const std::vector<std::string>& arguments);

// Runs a shell script in which "$0" is the program.
ProgramRun runShell(const std::string& script);

// Starts the program, sends `signal_number` once its standard output holds `awaited`, and waits for its end.
ProgramRun runAndSignal(const std::vector<std::string>& arguments, const std::string& awaited, int signal_number);

// Starts the program, calls `due` every millisecond, sends `signal_number` once it returns true, and waits for the end.
ProgramRun runAndSignal(const std::vector<std::string>& arguments, const std::function<bool()>& due, int signal_number);

// The same for a run that may end before the signal on a busy machine: `undo` then removes its outputs and the run is
// repeated, up to a bound.
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

// The version that the program prints, such as 1.2.3.
std::string programVersion();

// `bytes` of a file in one of the program's own formats, with another version in its header.
std::string withVersion(std::string bytes, const std::string& version);

// A file of tests/cli/inputs.
std::string inputFile(const std::string& name);

std::string readText(const std::filesystem::path& path);
void writeText(const std::filesystem::path& path, const std::string& text);

// A polygon layer in longitudes and latitudes; each ring closes itself.
using LonLatRing = std::vector<std::pair<double, double>>;
std::string geoJsonPolygons(const std::vector<std::vector<LonLatRing>>& polygons);

// A test with its own folder, which is removed at the end.
class ProgramTest : public testing::Test {
 protected:
  ProgramTest();
  ~ProgramTest() override;

  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const;
  // The names of all files in the folder, including hidden ones.
  std::set<std::string> names() const;

  // A lake of some 2 km with an island.
  std::string lake() const;

 private:
  std::filesystem::path folder_;
};

// True if standard error is a single error line.
testing::AssertionResult isOneErrorLine(const std::string& errors);

}  // namespace coastmesh::test
