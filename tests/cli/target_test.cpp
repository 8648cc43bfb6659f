// What repairs for models leave in the outputs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace coastmesh::test {
namespace {

using Target = ProgramTest;
using Json = nlohmann::json;

// The sizes of the nodes in a layer that the program wrote.
std::map<std::pair<double, double>, double> sizesIn(const std::string& path) {
  std::map<std::pair<double, double>, double> sizes;
  const Json layer = Json::parse(readText(path));
  for (const Json& feature : layer.at("features")) {
    const Json& place = feature.at("geometry").at("coordinates");
    sizes[{place.at(0), place.at(1)}] = feature.at("properties").at("size");
  }
  return sizes;
}

TEST_F(Target, ADoubledNodeHasTheSizeOfTheNodeThatItWas) {
  const std::string input = inputFile("target/islands_that_touch.geojson");
  ASSERT_EQ(runProgram({"mesh", input, "--size", "20000", "-o", file("plain.geojson")}).code, 0);
  const auto plain = sizesIn(file("plain_nodes.geojson"));
  ASSERT_TRUE(plain.contains({0.5, 0.5}));
  const ProgramRun run = runProgram({"mesh", input, "--size", "20000", "--target", "adcirc", "--report",
                                     file("report.json"), "-o", file("mended.geojson")});
  ASSERT_EQ(run.code, 0) << run.errors;
  const Json repairs = Json::parse(readText(file("report.json"))).at("repairs").at("done");
  ASSERT_EQ(repairs.size(), 1u);
  EXPECT_THAT(repairs[0].at("repair").get<std::string>(), testing::StartsWith("node doubled"));
  const auto mended = sizesIn(file("mended_nodes.geojson"));
  ASSERT_EQ(mended.size(), plain.size() + 1);
  for (const auto& [place, size] : mended) {
    const auto was = plain.contains(place) ? plain.at(place) : plain.at({0.5, 0.5});
    EXPECT_EQ(size, was) << place.first << ", " << place.second;
  }
}

}  // namespace
}  // namespace coastmesh::test
