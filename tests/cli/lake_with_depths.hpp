#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"

namespace coastmesh::test {

// For commands on a part of a mesh: the lake of the tests with depths, from 0 m in the west to 2 m in the east.
class LakeWithDepths : public ProgramTest {
 protected:
  // The path of its raster.
  std::string dem() const {
    std::string raster = "ncols 40\nnrows 40\nxllcorner -87.52\nyllcorner 41.58\ncellsize 0.0015\n";
    for (int row = 0; row < 40; ++row) {
      for (int column = 0; column < 40; ++column) raster += std::to_string(-5.0 - 0.05 * column) + " ";
      raster += "\n";
    }
    write("dem.asc", raster);
    return file("dem.asc");
  }
  // The path of its mesh, with edges of at most `size_m`.
  std::string meshOf(const std::string& name, const std::string& size_m) const {
    const ProgramRun run = runProgram(
        {"mesh", lake(), "-o", file(name), "--size-max", size_m, "--bathymetry", dem(), "--quiet", "--overwrite"});
    EXPECT_EQ(run.code, 0) << run.errors;
    return file(name);
  }
  // The west of the lake, and about half of the island.
  static std::string box() { return "--bbox=-88,41,-87.4865,42"; }

  static std::vector<std::string> linesOf(const std::string& path) {
    std::istringstream text(readText(path));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }
};

}  // namespace coastmesh::test
