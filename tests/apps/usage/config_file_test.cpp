#include "apps/usage/config_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "gis/error.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;

const char* const kUsage =
    R"({"command": "mesh", "arguments": [{"name": "INPUT", "type": "file", "multiple": true}], "options": [
  {"name": "--output", "names": ["-o", "--output"], "type": "file", "multiple": true},
  {"name": "--size-max", "names": ["--size-max"], "type": "number"},
  {"name": "--bbox", "names": ["--bbox"], "type": "text", "unit": "W,S,E,N"},
  {"name": "--depth-band", "names": ["--depth-band"], "type": "text", "unit": "FROM,TO,SIZE", "multiple": true},
  {"name": "--water-level", "names": ["--water-level"], "type": "number"},
  {"name": "--coarsen", "names": ["--coarsen", "--no-coarsen"], "type": "flag",
   "former_names": {"--felt": "--coarsen", "--no-felt": "--no-coarsen"}},
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
    return expandConfig(arguments, kUsage, {"mesh", "plot"});
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
coarsen = false
quiet = true
)");
  const std::string json = write("a.json", R"({"input": ["lake.gpkg", "river #2.gpkg"], "output": ["a.nc", "b.14"],
    "size-max": 500, "water_level": -0.5, "coarsen": false, "quiet": true})");
  for (const std::string& file : {toml, json}) {
    EXPECT_THAT(expanded(file),
                ElementsAre("--config=" + file, "--output=a.nc", "--output=b.14", "--size-max=500",
                            "--water-level=-0.5", "--no-coarsen", "--quiet", "--", "lake.gpkg", "river #2.gpkg"))
        << file;
  }
}

TEST_F(ConfigFile, TheCommandLineGoesBeforeIt) {
  const std::string file = write("a.toml", "input = \"a.gpkg\"\noutput = \"a.nc\"\nsize-max = 500\ncoarsen = true\n");
  const std::string config = "--config=" + file;
  EXPECT_THAT(expanded(file, {"other.gpkg", "-o", "b.nc", "--no-coarsen"}),
              ElementsAre("other.gpkg", "-o", "b.nc", "--no-coarsen", config, "--size-max=500"));
  EXPECT_THAT(expanded(file, {"--size-max=3", "-ob.nc"}),
              ElementsAre("--size-max=3", "-ob.nc", config, "--coarsen", "--", "a.gpkg"));
  EXPECT_THAT(expanded(file, {"--size-max=3", "--", "-b.gpkg"}),
              ElementsAre("--size-max=3", config, "--output=a.nc", "--coarsen", "--", "-b.gpkg"));
}

TEST_F(ConfigFile, SectionsAreCommands) {
  const std::string file = write("a.toml", "quiet = true\n[mesh]\nsize-max = 7\n[plot]\nwidth = 100\n");
  EXPECT_THAT(expanded(file), ElementsAre("--config=" + file, "--quiet", "--size-max=7"));
  const std::string json = write("b.json", R"({"mesh": {"size-max": 7}, "plot": {"width": 100}})");
  EXPECT_THAT(expanded(json), ElementsAre("--config=" + json, "--size-max=7"));
  const std::string dotted = write("c.toml", "mesh.size-max = 7\nplot.width = 3\n");
  EXPECT_THAT(expanded(dotted), ElementsAre("--config=" + dotted, "--size-max=7"));
}

TEST_F(ConfigFile, ListsOfNumbersAreOneValueWhereTheOptionHasCommas) {
  const std::string toml = write("a.toml",
                                 "\xEF\xBB\xBF"
                                 "bbox = [-87.5, 41, -87, 0x2A]\ndepth-band = [[0, 10, 50], [10, inf, 200]]\n");
  EXPECT_THAT(expanded(toml), ElementsAre("--config=" + toml, "--bbox=-87.5,41,-87,42", "--depth-band=0,10,50",
                                          "--depth-band=10,inf,200"));
  const std::string json = write("b.json", R"({"bbox": "1,2,3,4", "depth-band": [0, 10, 50]})");
  EXPECT_THAT(expanded(json), ElementsAre("--config=" + json, "--bbox=1,2,3,4", "--depth-band=0,10,50"));
}

TEST_F(ConfigFile, SwitchesByTheirOtherName) {
  const std::string file = write("a.toml", "no-coarsen = true\n");
  EXPECT_THAT(expanded(file), ElementsAre("--config=" + file, "--no-coarsen"));
}

TEST_F(ConfigFile, FormerNamesAreTakenAndStayFormer) {
  for (const char* text : {"felt = false\n", "no-felt = true\n"}) {
    const std::string file = write("a.toml", text);
    EXPECT_THAT(expanded(file), ElementsAre("--config=" + file, "--no-felt"));
    EXPECT_THAT(expanded(file, {"--coarsen"}), ElementsAre("--coarsen", "--config=" + file)) << "given there already";
    EXPECT_THAT(expanded(file, {"--felt"}), ElementsAre("--felt", "--config=" + file)) << "given there already";
  }
}

TEST_F(ConfigFile, MistakesAreNamed) {
  const auto messageOf = [&](const std::string& file) -> std::string {
    try {
      expanded(file);
    } catch (const OptionError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(messageOf("nothing.toml"), ::testing::HasSubstr("nothing.toml"));
  EXPECT_THAT(messageOf(write("f.toml", "felt = false\ncoarsen = true\n")), ::testing::HasSubstr("given twice"));
  EXPECT_THAT(messageOf(write("a.toml", "sise-max = 3\n")), ::testing::HasSubstr("'sise-max' is no option"));
  EXPECT_THAT(messageOf(write("b.json", "{\"size-max\": }")), ::testing::HasSubstr("not JSON"));
  EXPECT_THAT(messageOf(write("c.toml", "coarsen = 3\n")), ::testing::HasSubstr("true or false"));
  EXPECT_THAT(messageOf(write("d.toml", "size-max = [1, 2]\n")), ::testing::HasSubstr("one value"));
  EXPECT_THAT(messageOf(write("e.toml", "output = [\"a\"\n")), ::testing::HasSubstr("not TOML"));
  EXPECT_THAT(messageOf(write("f.toml", "[mush]\nsize-max = 3\n")), ::testing::HasSubstr("'mush'"));
  EXPECT_THAT(messageOf(write("g.toml", "[[mesh]]\nsize-max = 3\n")), ::testing::HasSubstr("one [mesh]"));
  EXPECT_THAT(messageOf(write("h.toml", "size-max = 3\nsize-max = 4\n")), ::testing::HasSubstr("not TOML"));
  EXPECT_THAT(messageOf(write("i.json", R"({"size-max": 3, "size-max": 4})")), ::testing::HasSubstr("twice"));
  EXPECT_THAT(messageOf(write("j.toml", "size-max = 3\n[mesh]\nsize_max = 4\n")), ::testing::HasSubstr("twice"));
  EXPECT_THAT(messageOf(write("k.toml", "size-max = 1979-05-27\n")), ::testing::HasSubstr("'size-max'"));
  EXPECT_THAT(messageOf(write("l.toml", "bbox = [1, 2, 3]\n")), ::testing::HasSubstr("4 numbers"));
  EXPECT_THAT(messageOf(write("m.toml", "bbox = \"\"\n")), ::testing::HasSubstr("empty"));
  EXPECT_THAT(messageOf(write("n.json", "{\"size-max\": 1e999}")), ::testing::HasSubstr("too large"));
  EXPECT_THAT(messageOf(write("o.toml", "[mesh.size]\nmax = 4\n")), ::testing::HasSubstr("nested"));
}

TEST_F(ConfigFile, WithoutOneNothingChanges) {
  EXPECT_THAT(expandConfig({"a.gpkg", "-o", "b.nc"}, kUsage, {"mesh"}), ElementsAre("a.gpkg", "-o", "b.nc"));
}

}  // namespace
}  // namespace coastmesh
