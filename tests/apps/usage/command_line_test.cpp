#include "apps/usage/command_line.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace coastmesh {

namespace {

using Json = nlohmann::json;

struct Values {
  double angle = 33.0;
  bool angle_given = false;
  double size = std::numeric_limits<double>::infinity();
  std::uint64_t count = 4;
  bool coarsen = true;
  std::string name = "b";
  std::string path;
  std::vector<std::string> inputs;
  std::vector<std::string> outputs;
};

class CommandLineTest : public testing::Test {
 protected:
  CommandLineTest() : line_(app_, "knit", "Knit a sock") {
    line_.arguments("INPUT", values_.inputs, "wool");
    line_.number("--angle", values_.angle, "DEG", {0.0, 45.0}, "angle", &values_.angle_given);
    line_.number("--size", values_.size, "M", {0.0, std::numeric_limits<double>::infinity(), true}, "size");
    line_.integer("--count", values_.count, "N", 2, 9, "count");
    line_.flag("--coarsen,!--no-coarsen", values_.coarsen, "coarsen").formerly({"--felt", "--no-felt"});
    line_.choice("--name", values_.name, {"a", "b"}, "name");
    line_.text("--path", values_.path, "FILE", "path");
    line_.texts("-o,--output", values_.outputs, "FILE", true, "output");
  }

  void parse(std::vector<std::string> words) {
    std::reverse(words.begin(), words.end());
    app_.parse(words);
  }

  CLI::App app_;
  Values values_;
  CommandLine line_;
};

TEST_F(CommandLineTest, DefaultsStayWhereNothingIsGiven) {
  parse({"knit", "wool", "-o", "sock"});
  EXPECT_TRUE(line_.chosen());
  EXPECT_EQ(values_.angle, 33.0);
  EXPECT_FALSE(values_.angle_given);
  EXPECT_TRUE(std::isinf(values_.size));
  EXPECT_EQ(values_.count, 4u);
  EXPECT_TRUE(values_.coarsen);
  EXPECT_EQ(values_.name, "b");
}

TEST_F(CommandLineTest, ValuesAreTaken) {
  parse({"knit", "-o", "sock", "wool", "yarn", "--angle", "45", "--size", "1e-3", "--count", "9", "--no-coarsen",
         "--name", "a", "--output", "hat"});
  EXPECT_EQ(values_.inputs, (std::vector<std::string>{"wool", "yarn"}));
  EXPECT_EQ(values_.outputs, (std::vector<std::string>{"sock", "hat"}));
  EXPECT_EQ(values_.angle, 45.0);
  EXPECT_TRUE(values_.angle_given);
  EXPECT_EQ(values_.size, 1e-3);
  EXPECT_EQ(values_.count, 9u);
  EXPECT_FALSE(values_.coarsen);
  EXPECT_EQ(values_.name, "a");
}

TEST_F(CommandLineTest, WhatIsOutOfRangeIsRefused) {
  for (const auto& [option, value] : std::vector<std::pair<std::string, std::string>>{{"--angle", "45.1"},
                                                                                      {"--angle", "-0.1"},
                                                                                      {"--angle", "nan"},
                                                                                      {"--angle", "inf"},
                                                                                      {"--angle", "3x"},
                                                                                      {"--size", "0"},
                                                                                      {"--size", "-1"},
                                                                                      {"--size", "inf"},
                                                                                      {"--count", "1"},
                                                                                      {"--count", "10"},
                                                                                      {"--count", "2.5"},
                                                                                      {"--count", "-3"},
                                                                                      {"--name", "c"}}) {
    EXPECT_THROW(parse({"knit", "wool", "-o", "sock", option + "=" + value}), CLI::ParseError) << option << value;
  }
  EXPECT_THROW(parse({"knit", "wool"}), CLI::ParseError);
  EXPECT_THROW(parse({"knit", "-o", "sock"}), CLI::ParseError);
}

TEST_F(CommandLineTest, UsageSaysWhatWasDeclared) {
  std::string text;
  try {
    parse({"knit", "--json-usage"});
  } catch (const UsageText& asked) {
    text = asked.text;
  }
  EXPECT_EQ(text, line_.jsonUsage());
  const Json usage = Json::parse(text);
  EXPECT_EQ(usage["command"], "knit");
  EXPECT_EQ(usage["arguments"].size(), 1u);
  ASSERT_EQ(usage["options"].size(), 8u);  // --config besides
  const Json& angle = usage["options"][1];
  EXPECT_EQ(angle, (Json{{"name", "--angle"},
                         {"names", {"--angle"}},
                         {"type", "number"},
                         {"help", "angle"},
                         {"unit", "DEG"},
                         {"default", 33.0},
                         {"minimum", 0.0},
                         {"maximum", 45.0}}));
  EXPECT_EQ(usage["options"][4]["names"], (Json{"--coarsen", "--no-coarsen"}));
  EXPECT_EQ(usage["options"][4]["former_names"], (Json{{"--felt", "--coarsen"}, {"--no-felt", "--no-coarsen"}}));
}

TEST_F(CommandLineTest, FormerNamesBecomeThePresentOnesWithAWarning) {
  using Words = std::vector<std::string>;
  Words warnings;
  EXPECT_EQ(line_.withPresentNames({"--no-felt", "--angle", "3", "--felt=true", "--", "--felt"}, warnings),
            (Words{"--no-coarsen", "--angle", "3", "--coarsen=true", "--", "--felt"}));
  EXPECT_EQ(warnings, (Words{"--no-felt is called --no-coarsen now; the next version will not take the former name",
                             "--felt is called --coarsen now; the next version will not take the former name"}));
  warnings.clear();
  const Words present{"--coarsen", "--no-coarsen", "--felted", "felt"};
  EXPECT_EQ(line_.withPresentNames(present, warnings), present);
  EXPECT_TRUE(warnings.empty());
}

TEST_F(CommandLineTest, HelpShowsUnitDefaultAndRange) {
  const std::string help = app_.get_subcommand("knit")->help();
  for (const char* part : {"DEG", "33", "0 to 45", "above 0", "2 to 9", "--no-coarsen", "a|b"}) {
    EXPECT_NE(help.find(part), std::string::npos) << part << help;
  }
}

// Two options, one of which counts only with the other.
class NeedsTest : public testing::Test {
 protected:
  NeedsTest() : line_(app_, "knit", "Knit a sock") {
    line_.arguments("INPUT", inputs_, "wool");
    line_.text("--pattern", pattern_, kVectorFile, "pattern");
    line_.number("--heel", heel_, "CM", {0.0, 9.0}, "heel");
    line_.number("--heel-stitches", stitches_, "N", {0.0, 9.0}, "stitches of the heel").needs({"--heel", "--pattern"});
    line_.flag("--plain", plain_, "no pattern").ignoredWith({"--pattern"});
    line_.choice("--toe", toe_, {"round", "wedge", "star"}, "toe");
    line_.number("--toe-rounds", rounds_, "N", {0.0, 9.0}, "rounds of a star").needs({"--toe star"});
    line_.outputs("-o,--output", outputs_, {.required = true, .files = twoFiles}, "socks");
    line_.output("--bill", bill_, {.standard_output = true}, "bill");
  }

  static OutputFiles twoFiles(const std::string& path) { return {{path + ".left", path + ".right"}, {}, {}}; }

  void parse(std::vector<std::string> words) {
    words.insert(words.begin(), {"knit", "wool", "-o", "sock"});
    std::reverse(words.begin(), words.end());
    app_.parse(words);
  }

  CLI::App app_;
  std::vector<std::string> inputs_, outputs_;
  std::string pattern_, bill_, toe_ = "round";
  double heel_ = 0.0, stitches_ = 3.0, rounds_ = 4.0;
  bool plain_ = false;
  CommandLine line_;
};

using Sentences = std::vector<std::string>;

TEST_F(NeedsTest, WhatHasNoEffectIsSaid) {
  parse({"--heel-stitches", "3", "--plain"});
  EXPECT_EQ(line_.withoutEffect(), Sentences{"--heel-stitches has no effect without one of --heel, --pattern"});
}

TEST_F(NeedsTest, AnOptionAtItsDefaultIsAsGoodAsNotGiven) {
  parse({"--heel-stitches", "3", "--heel", "0.0"});
  EXPECT_EQ(line_.withoutEffect().size(), 1u);
}

TEST_F(NeedsTest, WithWhatItNeedsNothingIsSaid) {
  parse({"--heel-stitches", "4", "--pattern", "stars"});
  EXPECT_TRUE(line_.withoutEffect().empty());
}

TEST_F(NeedsTest, AnotherOptionMayHaveToBeGivenAsOneOfItsValues) {
  for (const std::string toe : {"round", "wedge"}) {
    parse({"--toe-rounds", "5", "--toe", toe});
    EXPECT_EQ(line_.withoutEffect(), Sentences{"--toe-rounds has no effect without --toe star"}) << toe;
    app_.clear();
  }
  parse({"--toe-rounds", "5"});
  EXPECT_EQ(line_.withoutEffect().size(), 1u);
  app_.clear();
  parse({"--toe-rounds", "5", "--toe", "star"});
  EXPECT_TRUE(line_.withoutEffect().empty());
}

TEST_F(NeedsTest, WhatAnotherOptionOverridesIsSaid) {
  parse({"--plain", "--pattern", "stars"});
  EXPECT_EQ(line_.withoutEffect(), Sentences{"--plain has no effect with --pattern"});
}

TEST_F(NeedsTest, FilesOfTheRunAreKnownByTheirOptions) {
  parse({"yarn", "-", "--pattern", "stars", "--config", "job.toml", "--bill", "-"});
  std::vector<std::string> read, written;
  for (const auto& [option, path] : line_.inputs()) read.push_back(option + " " + path);
  for (const auto& output : line_.outputs()) {
    for (const std::string& file : output.files.targets) written.push_back(output.option + " " + file);
  }
  EXPECT_EQ(read, (Sentences{"--config job.toml", "INPUT wool", "INPUT yarn", "--pattern stars"}));
  EXPECT_EQ(written, (Sentences{"--output sock.left", "--output sock.right"}));
}

TEST_F(NeedsTest, StandardOutputIsForThoseThatAllowIt) {
  parse({"-o", "-"});
  EXPECT_THROW(line_.outputs(), OptionError);
}

}  // namespace

}  // namespace coastmesh
