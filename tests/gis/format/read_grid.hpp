#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "gis/error.hpp"
#include "gis/format/grid_io.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {

// Meshes in files that a test writes.
class ReadGrid : public ::testing::Test {
 protected:
  std::string put(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  std::string errorOf(const std::string& path) {
    try {
      readGrid(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  std::string errorIn(const std::string& name, const std::string& text) { return errorOf(put(name, text)); }

  testing::TemporaryFolder folder_;
};

}  // namespace coastmesh
