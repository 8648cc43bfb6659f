#include "apps/config_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "apps/command_line.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;

const char* const kUsage =
    R"({"command": "mesh", "arguments": [{"name": "INPUT", "type": "file", "multiple": true}], "options": [
  {"name": "--output", "names": ["-o", "--output"], "type": "file", "multiple": true},
  {"name": "--size-max", "names": ["--size-max"], "type": "number"},
  {"name": "--water-level", "names": ["--water-level"], "type": "number"},
  {"name": "--shrink", "names": ["--shrink", "--no-shrink"], "type": "flag"},
  {"name": "--quiet", "names": ["--quiet"], "type": "flag"}]})";

class ConfigFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("coastmesh-config-") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) {
    std::ofstream((folder_ / name).string()) << text;
    return (folder_ / name).string();
  }
  std::vector<std::string> expanded(const std::string& file, std::vector<std::string> arguments = {}) {
    arguments.insert(arguments.begin(), {"--config", file});
    return expandConfig(arguments, kUsage);
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(ConfigFile, TomlAndJsonSayTheSame) {
  const std::string toml = write("a.toml", R"(# A lake.
input = ["lake.gpkg", "river #2.gpkg"]
output = [
  "a.nc",   # for the model
  "b.14",
]
size-max = 500
water_level = -0.5
shrink = false
quiet = true
)");
  const std::string json = write("a.json", R"({"input": ["lake.gpkg", "river #2.gpkg"], "output": ["a.nc", "b.14"],
    "size-max": 500, "water_level": -0.5, "shrink": false, "quiet": true})");
  for (const std::string& file : {toml, json}) {
    EXPECT_THAT(expanded(file), ElementsAre("lake.gpkg", "river #2.gpkg", "--output=a.nc", "--output=b.14",
                                            "--size-max=500", "--water-level=-0.5", "--no-shrink", "--quiet"))
        << file;
  }
}

TEST_F(ConfigFile, TheCommandLineGoesBeforeIt) {
  const std::string file = write("a.toml", "input = \"a.gpkg\"\noutput = \"a.nc\"\nsize-max = 500\nshrink = true\n");
  EXPECT_THAT(expanded(file, {"other.gpkg", "-o", "b.nc", "--no-shrink"}),
              ElementsAre("other.gpkg", "-o", "b.nc", "--no-shrink", "--size-max=500"));
  EXPECT_THAT(expanded(file, {"--size-max=3", "-ob.nc"}), ElementsAre("--size-max=3", "-ob.nc", "a.gpkg", "--shrink"));
}

TEST_F(ConfigFile, SectionsAreCommands) {
  const std::string file = write("a.toml", "quiet = true\n[mesh]\nsize-max = 7\n[plot]\nwidth = 100\n");
  EXPECT_THAT(expanded(file), ElementsAre("--quiet", "--size-max=7"));
  EXPECT_THAT(expanded(write("b.json", R"({"mesh": {"size-max": 7}, "plot": {"width": 100}})")),
              ElementsAre("--size-max=7"));
}

TEST_F(ConfigFile, MistakesAreNamed) {
  const auto messageOf = [&](const std::string& file) -> std::string {
    try {
      expanded(file);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(messageOf("nothing.toml"), ::testing::HasSubstr("nothing.toml"));
  EXPECT_THAT(messageOf(write("a.toml", "sise-max = 3\n")), ::testing::HasSubstr("'sise-max' is no option"));
  EXPECT_THAT(messageOf(write("b.json", "{\"size-max\": }")), ::testing::HasSubstr("not JSON"));
  EXPECT_THAT(messageOf(write("c.toml", "shrink = 3\n")), ::testing::HasSubstr("true or false"));
  EXPECT_THAT(messageOf(write("d.toml", "size-max = [1, 2]\n")), ::testing::HasSubstr("one value"));
  EXPECT_THAT(messageOf(write("e.toml", "output = [\"a\"\n")), ::testing::HasSubstr("closing bracket"));
  EXPECT_THAT(messageOf(write("f.toml", "[mush]\nsize-max = 3\n")), ::testing::HasSubstr("'mush'"));
}

TEST_F(ConfigFile, WithoutOneNothingChanges) {
  EXPECT_THAT(expandConfig({"a.gpkg", "-o", "b.nc"}, kUsage), ElementsAre("a.gpkg", "-o", "b.nc"));
}

}  // namespace
}  // namespace coastmesh
