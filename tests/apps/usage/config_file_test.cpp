#include "apps/usage/config_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <utility>

#include "gis/error.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// The values taken from a file of options and from options given before it.
struct Job {
  std::vector<std::string> inputs, outputs;
  double size_max = 0.0, water_level = 0.0;
  std::vector<double> bbox;
  std::vector<std::vector<double>> bands;
  bool coarsen = true, quiet = false;
  OptionTable table{"mesh", "meshes"};
  std::vector<std::string> warnings;

  Job() {
    const auto add = [](auto& to) {
      return [&to](const std::vector<double>& numbers) {
        to.push_back(numbers);
        return std::string{};
      };
    };
    const auto store = [this](const std::vector<double>& numbers) {
      bbox = numbers;
      return std::string{};
    };
    table.arguments("INPUT", inputs, "");
    table.file("--config", "");
    table.texts("-o,--output", outputs, "FILE", true, "");
    table.number("--size-max", size_max, "M", {.low = 0.0}, "");
    table.numbers("--bbox", "W,S,E,N", false, store, "");
    table.numbers("--depth-band", "FROM,TO,SIZE", true, add(bands), "");
    table.number("--water-level", water_level, "M", {}, "");
    table.flag("--coarsen,!--no-coarsen", coarsen, "").formerly({"--felt", "--no-felt"});
    table.flag("--quiet", quiet, "");
  }
};

class ConfigFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = std::filesystem::temp_directory_path() / ("coastmesh-config-" + std::to_string(::getpid()) + name);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) {
    std::ofstream((folder_ / name).string()) << text;
    return (folder_ / name).string();
  }
  // Options given before the file are passed as names and texts.
  std::unique_ptr<Job> taken(const std::string& file,
                             const std::vector<std::pair<std::string, std::string>>& before = {}) {
    auto job = std::make_unique<Job>();
    for (const auto& [name, text] : before) job->table.setText(name, text);
    takeConfig(file, job->table, {"mesh", "plot"}, job->warnings);
    return job;
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
    const auto job = taken(file);
    EXPECT_THAT(job->inputs, ElementsAre("lake.gpkg", "river #2.gpkg")) << file;
    EXPECT_THAT(job->outputs, ElementsAre("a.nc", "b.14")) << file;
    EXPECT_EQ(job->size_max, 500.0) << file;
    EXPECT_EQ(job->water_level, -0.5) << file;
    EXPECT_FALSE(job->coarsen) << file;
    EXPECT_TRUE(job->quiet) << file;
    EXPECT_THAT(job->table.missing(), IsEmpty()) << file;
  }
}

TEST_F(ConfigFile, WhatWasGivenBeforeGoesBeforeIt) {
  const std::string file =
      write("a.toml", "input = \"a.gpkg\"\noutput = [\"a.nc\", \"b.nc\"]\nsize-max = 500\ncoarsen = true\n");
  const auto job = taken(file, {{"INPUT", "other.gpkg"}, {"--output", "c.nc"}, {"--coarsen", "false"}});
  EXPECT_THAT(job->inputs, ElementsAre("other.gpkg"));
  EXPECT_THAT(job->outputs, ElementsAre("c.nc"));
  EXPECT_FALSE(job->coarsen);
  EXPECT_EQ(job->size_max, 500.0);
  const auto sized = taken(file, {{"--size-max", "3"}});
  EXPECT_EQ(sized->size_max, 3.0);
  EXPECT_THAT(sized->inputs, ElementsAre("a.gpkg"));
  EXPECT_THAT(sized->outputs, ElementsAre("a.nc", "b.nc"));
}

TEST_F(ConfigFile, SectionsAreCommands) {
  for (const std::string& file :
       {write("a.toml", "quiet = true\n[mesh]\nsize-max = 7\n[plot]\nwidth = 100\n"),
        write("b.json", R"({"quiet": true, "mesh": {"size-max": 7}, "plot": {"width": 100}})"),
        write("c.toml", "quiet = true\nmesh.size-max = 7\nplot.width = 3\n")}) {
    const auto job = taken(file);
    EXPECT_EQ(job->size_max, 7.0) << file;
    EXPECT_TRUE(job->quiet) << file;
    EXPECT_THAT(job->table.missing(), ElementsAre("INPUT", "--output")) << file;
  }
}

TEST_F(ConfigFile, ListsOfNumbersAreOneValueWhereTheOptionHasCommas) {
  const std::string toml = write("a.toml",
                                 "\xEF\xBB\xBF"
                                 "bbox = [-87.5, 41, -87, 0x2A]\ndepth-band = [[0, 10, 50], [10, inf, 200]]\n");
  const auto lists = taken(toml);
  EXPECT_THAT(lists->bbox, ElementsAre(-87.5, 41.0, -87.0, 42.0));
  EXPECT_THAT(lists->bands, ElementsAre(ElementsAre(0.0, 10.0, 50.0), ElementsAre(10.0, INFINITY, 200.0)));
  const auto texts = taken(write("b.json", R"({"bbox": "1,2,3,4", "depth-band": [0, 10, 50]})"));
  EXPECT_THAT(texts->bbox, ElementsAre(1.0, 2.0, 3.0, 4.0));
  EXPECT_THAT(texts->bands, ElementsAre(ElementsAre(0.0, 10.0, 50.0)));
}

// Letters beyond ASCII outside of texts cause undefined behaviour in the library.
TEST_F(ConfigFile, LettersBeyondAsciiStandInTextsAndComments) {
  const auto job = taken(
      write("a.toml", "# \u00e9\ninput = \"\u00e9.gpkg\" # \u00e9\noutput = ['\u02df.nc', \"\"\"\n\u00e9\"\"\"]\n"));
  EXPECT_THAT(job->inputs, ElementsAre("\u00e9.gpkg"));
  EXPECT_THAT(job->outputs, ElementsAre("\u02df.nc", "\u00e9"));
  for (const char* const text : {"\n\u02df = 1\n", "\na\u02dfb = 1\n", "\n[m\u00e9]\n", "\nquiet = true\u02df\n"}) {
    try {
      taken(write("b.toml", text));
      ADD_FAILURE() << text;
    } catch (const OptionError& error) {
      EXPECT_NE(std::string(error.what()).find("line 2 is not TOML: letters beyond ASCII"), std::string::npos);
    }
  }
}

// After such a word the library would not find the end of the value either.
TEST_F(ConfigFile, AQuoteWithinAWordBeginsNoText) {
  for (const char* const text : {"\nsize-max = 2_'\u00e9'\n", "\nsize-max = 2[[['\u00e9']]]\n",
                                 "\nsize-max = 2='\u00e9'\n", "\ntitle = it's \u00e9\n", "\noutput = \"a\"'b'\n"}) {
    try {
      taken(write("b.toml", text));
      ADD_FAILURE() << text;
    } catch (const OptionError& error) {
      EXPECT_NE(std::string(error.what()).find("line 2 is not TOML: "), std::string::npos) << error.what();
    }
  }
  const auto job = taken(write("a.toml", "output=['a.nc',\"b.nc\"]\n\"quiet\"=true\n"));
  EXPECT_THAT(job->outputs, ElementsAre("a.nc", "b.nc"));
}

TEST_F(ConfigFile, TextsOfEveryKindKeepTheirLetters) {
  const auto job = taken(write("a.toml", R"(output = ["\"\u00e9\\é.nc", 'C:\é "x".nc', """
é\
  \tb"""", '''é\'b''''', "😀"]
)"));
  EXPECT_THAT(job->outputs, ElementsAre("\"é\\é.nc", "C:\\é \"x\".nc", "é\tb\"", "é\\'b''", "😀"));
}

TEST_F(ConfigFile, TextsThatAreNotUtf8OrDoNotEndAreRefusedByTheirLine) {
  const auto refusal = [&](const std::string& text) {
    try {
      taken(write("b.toml", text));
    } catch (const OptionError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  for (const char* const bytes : {"\xE9", "\xC0\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE2\x82"}) {
    EXPECT_THAT(refusal("quiet = true\noutput = '" + std::string(bytes) + "'\n"),
                testing::HasSubstr("line 2 is not TOML: the text is not UTF-8"));
  }
  EXPECT_THAT(refusal("\n\noutput = 'a.nc\nquiet = true\n"),
              testing::HasSubstr("line 3 is not TOML: a text does not end"));
  EXPECT_THAT(refusal("output = '''a.nc\nquiet = true\n"),
              testing::HasSubstr("line 1 is not TOML: a text does not end"));
  EXPECT_THAT(refusal("output = \"a\\\u00e9\"\n"), testing::HasSubstr("a backslash stands before"));
}

TEST_F(ConfigFile, SwitchesByTheirOtherName) {
  EXPECT_FALSE(taken(write("a.toml", "no-coarsen = true\n"))->coarsen);
  EXPECT_TRUE(taken(write("a.toml", "no_coarsen = false\n"))->coarsen);
}

// A switch that is off by default counts as not given, so that it causes no warning.
TEST_F(ConfigFile, ASwitchWithoutAnOppositeIsNotGivenWhereItIsOff) {
  EXPECT_THAT(taken(write("a.toml", "quiet = false\n"))->table.given("--quiet"), IsEmpty());
}

TEST_F(ConfigFile, FormerNamesAreTakenWithAWarning) {
  for (const auto& [text, sentence] :
       {std::pair("felt = false\n", "'felt' is called 'coarsen' now; the next version will not accept the former name"),
        std::pair("no-felt = true\n",
                  "'no-felt' is called 'no-coarsen' now; the next version will not accept the former name")}) {
    const std::string file = write("a.toml", text);
    const auto job = taken(file);
    EXPECT_FALSE(job->coarsen);
    EXPECT_THAT(job->warnings, ElementsAre("'" + file + "': " + sentence));
    EXPECT_TRUE(taken(file, {{"--coarsen", "true"}})->coarsen) << "given before";
  }
}

TEST_F(ConfigFile, MistakesAreNamed) {
  const auto messageOf = [&](const std::string& file) -> std::string {
    try {
      taken(file);
    } catch (const OptionError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(messageOf("nothing.toml"), ::testing::HasSubstr("nothing.toml"));
  EXPECT_THAT(messageOf(write("f.toml", "felt = false\ncoarsen = true\n")), ::testing::HasSubstr("given twice"));
  EXPECT_THAT(messageOf(write("a.toml", "sise-max = 3\n")), ::testing::HasSubstr("'sise-max' is not an option"));
  EXPECT_THAT(messageOf(write("b.json", "{\"size-max\": }")), ::testing::HasSubstr("not JSON"));
  EXPECT_THAT(messageOf(write("c.toml", "coarsen = 3\n")), ::testing::HasSubstr("true or false"));
  EXPECT_THAT(messageOf(write("g.json", R"({"coarsen": []})")), ::testing::HasSubstr("true or false"));
  EXPECT_THAT(messageOf(write("h.json", R"({"coarsen": [true]})")), ::testing::HasSubstr("true or false"));
  EXPECT_THAT(messageOf(write("d.toml", "size-max = [1, 2]\n")), ::testing::HasSubstr("one value"));
  EXPECT_THAT(messageOf(write("e.toml", "output = [\"a\"\n")), ::testing::HasSubstr("not TOML"));
  EXPECT_THAT(messageOf(write("f.toml", "[mush]\nsize-max = 3\n")), ::testing::HasSubstr("'mush'"));
  EXPECT_THAT(messageOf(write("s.toml", "[mush]\n")), ::testing::HasSubstr("'mush'"));
  EXPECT_THAT(messageOf(write("s.json", R"({"size-max": {}})")), ::testing::HasSubstr("'size-max' is an option"));
  EXPECT_THAT(messageOf(write("g.toml", "[[mesh]]\nsize-max = 3\n")), ::testing::HasSubstr("one [mesh]"));
  EXPECT_THAT(messageOf(write("h.toml", "size-max = 3\nsize-max = 4\n")), ::testing::HasSubstr("not TOML"));
  EXPECT_THAT(messageOf(write("i.json", R"({"size-max": 3, "size-max": 4})")), ::testing::HasSubstr("twice"));
  EXPECT_THAT(messageOf(write("j.toml", "size-max = 3\n[mesh]\nsize_max = 4\n")), ::testing::HasSubstr("twice"));
  EXPECT_THAT(messageOf(write("k.toml", "size-max = 1979-05-27\n")), ::testing::HasSubstr("'size-max'"));
  EXPECT_THAT(messageOf(write("l.toml", "bbox = [1, 2, 3]\n")), ::testing::HasSubstr("4 numbers"));
  EXPECT_THAT(messageOf(write("m.toml", "bbox = \"\"\n")), ::testing::HasSubstr("empty"));
  EXPECT_THAT(messageOf(write("n.json", "{\"size-max\": 1e999}")), ::testing::HasSubstr("too large"));
  EXPECT_THAT(messageOf(write("p.toml", "config = \"q.toml\"\n")), ::testing::HasSubstr("'config' is not an option"));
  const std::string negative = write("q.toml", "size-max = -3\n");
  EXPECT_EQ(messageOf(negative), "'" + negative + "': 'size-max': '-3' is not a number in the range 0 or more");
  EXPECT_THAT(messageOf(write("r.toml", "quiet = [true]\n")), ::testing::HasSubstr("true or false"));
  EXPECT_THAT(messageOf(write("o.toml", "[mesh.size]\nmax = 4\n")), ::testing::HasSubstr("nested"));
}

}  // namespace
}  // namespace coastmesh
