#include "apps/usage/command_line.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
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
  CommandLineTest() : line_(app_, declared(values_)) {}

  static OptionTable declared(Values& values) {
    OptionTable table = commandOptions("knit", "Knit a sock");
    table.arguments("INPUT", values.inputs, "wool");
    table.number({"--angle", "Angle of the heel"}, values.angle, "DEG", {0.0, 45.0}, "angle", &values.angle_given);
    table.section(Section::Sizes);
    table.number({"--size", "Size"}, values.size, "M", {0.0, std::numeric_limits<double>::infinity(), true},
                 "size of the sock");
    table.integer("--count", values.count, "N", 2, 9, "count");
    table.flag("--coarsen,!--no-coarsen", values.coarsen, "coarsen").formerly({"--felt", "--no-felt"});
    table.choice("--name", values.name, {"a", "b"}, "name");
    table.text("--path", values.path, "FILE", "path");
    table.texts("-o,--output", values.outputs, "FILE", true, "output");
    return table;
  }

  void parse(std::vector<std::string> words) {
    std::vector<std::string> warnings;
    const std::string command = words.front();
    words = line_.toParse({words.begin() + 1, words.end()}, warnings);
    words.insert(words.begin(), command);
    std::reverse(words.begin(), words.end());
    app_.parse(words);
    if (line_.chosen()) line_.complete({"knit"}, warnings);
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
}

TEST_F(CommandLineTest, ArgumentsThatMustBeGivenAreAskedFor) {
  EXPECT_THROW(parse({"knit", "-o", "sock"}), OptionError);
}

TEST_F(CommandLineTest, OptionsThatMustBeGivenAreAskedFor) {
  EXPECT_THROW(parse({"knit", "wool"}), OptionError);
  const std::string help = app_.get_subcommand("knit")->help();
  EXPECT_NE(help.find("INPUT..."), std::string::npos);
  EXPECT_EQ(help.find("[INPUT..."), std::string::npos);
  EXPECT_NE(help.find("--output FILE (repeat) REQUIRED"), std::string::npos) << help;
}

TEST_F(CommandLineTest, UsageSaysWhatWasDeclared) {
  std::string text;
  try {
    parse({"knit", "--json-usage"});
  } catch (const UsageText& asked) {
    text = asked.text;
  }
  EXPECT_EQ(text, line_.options().jsonUsage());
  const Json usage = Json::parse(text);
  EXPECT_EQ(usage["command"], "knit");
  EXPECT_EQ(usage["arguments"].size(), 1u);
  ASSERT_EQ(usage["options"].size(), 8u);  // and --config
  const auto option = [&usage](const std::string& name) {
    for (const Json& each : usage["options"])
      if (each["name"] == name) return each;
    return Json();
  };
  const Json angle = option("--angle");
  EXPECT_EQ(angle, (Json{{"name", "--angle"},
                         {"names", {"--angle"}},
                         {"label", "Angle of the heel"},
                         {"section", "The run"},
                         {"type", "number"},
                         {"help", "angle"},
                         {"unit", "DEG"},
                         {"default", 33.0},
                         {"minimum", 0.0},
                         {"maximum", 45.0}}));
  EXPECT_EQ(option("--coarsen")["names"], (Json{"--coarsen", "--no-coarsen"}));
  EXPECT_EQ(option("--coarsen")["former_names"], (Json{{"--felt", "--coarsen"}, {"--no-felt", "--no-coarsen"}}));
}

TEST_F(CommandLineTest, FormerNamesBecomeThePresentOnesWithAWarning) {
  using Words = std::vector<std::string>;
  Words warnings;
  EXPECT_EQ(line_.toParse({"--no-felt", "--angle", "3", "--felt=true", "--", "--felt"}, warnings),
            (Words{"--no-coarsen", "--angle", "3", "--coarsen=true", "--", "--felt"}));
  EXPECT_EQ(warnings, (Words{"--no-felt is called --no-coarsen now; the next version will not accept the former name",
                             "--felt is called --coarsen now; the next version will not accept the former name"}));
  warnings.clear();
  const Words present{"--coarsen", "--no-coarsen", "--felted", "felt", "--path", "--felt", "-o=--felt"};
  EXPECT_EQ(line_.toParse(present, warnings), present);
  EXPECT_TRUE(warnings.empty());
}

TEST_F(CommandLineTest, AnArgumentAfterTheValueOfARepeatedOptionIsPointedOut) {
  using Words = std::vector<std::string>;
  Words warnings;
  for (const Words& words : {Words{"wool", "-o", "sock", "more"}, Words{"wool", "--output=sock", "more"}}) {
    warnings.clear();
    line_.toParse(words, warnings);
    EXPECT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings.front().find("more is one more INPUT: -"), 0u) << warnings.front();
  }
  warnings.clear();
  for (const Words& words : {Words{"-o", "sock", "wool"}, Words{"wool", "-o", "sock", "-o", "hat"},
                             Words{"wool", "--path", "felt", "more"}, Words{"wool", "more", "-o", "sock"}})
    line_.toParse(words, warnings);
  EXPECT_TRUE(warnings.empty());
}

TEST_F(CommandLineTest, SwitchesTakeTruthValuesOnly) {
  for (const auto& [word, on] : std::vector<std::pair<std::string, bool>>{{"--coarsen", true},
                                                                          {"--coarsen=true", true},
                                                                          {"--coarsen=off", false},
                                                                          {"--no-coarsen", false},
                                                                          {"--no-coarsen=yes", false},
                                                                          {"--no-coarsen=0", true}}) {
    values_ = Values();
    app_.clear();
    parse({"knit", "wool", "-o", "sock", word});
    EXPECT_EQ(values_.coarsen, on) << word;
  }
  for (const char* value : {"maybe", "3.5", "-1", "2", "99999999999999999999", "", "x"}) {
    for (const std::string option : {"--coarsen=", "--no-coarsen=", "--felt="})
      EXPECT_THROW(parse({"knit", "wool", "-o", "sock", option + value}), OptionError) << option << value;
  }
}

TEST_F(CommandLineTest, AnEmptyValueIsRefusedAndTakesNoOtherWord) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"--path", ""}, {"--path="}, {"--path=", "yarn"}, {"--name", ""}, {"--size="}, {"-o", ""}, {"--config="}}) {
    std::vector<std::string> all{"knit", "wool", "-o", "sock"};
    all.insert(all.end(), words.begin(), words.end());
    EXPECT_THROW(parse(all), CLI::ParseError) << testing::PrintToString(words);
    EXPECT_TRUE(values_.path.empty());
    app_.clear();
  }
}

TEST_F(CommandLineTest, HelpShowsUnitDefaultAndRange) {
  const std::string help = app_.get_subcommand("knit")->help();
  for (const char* part : {"DEG", "33", "0 to 45", "above 0", "2 to 9", "--no-coarsen", "a|b"}) {
    EXPECT_NE(help.find(part), std::string::npos) << part << help;
  }
}

TEST_F(CommandLineTest, HelpHasLabelsUnderHeadingsInTheOrderOfSections) {
  const std::string help = app_.get_subcommand("knit")->help();
  std::size_t before = 0;
  for (const char* part : {"\nSizes:\n", "--size", "Size of the sock (above 0)", "\nThe run:\n", "--angle",
                           "Angle of the heel: angle (0 to 45)", "--help"}) {
    const std::size_t at = help.find(part, before);
    ASSERT_NE(at, std::string::npos) << part << help;
    before = at;
  }
  EXPECT_EQ(help.find("\n\n\n"), std::string::npos) << help;
  EXPECT_EQ(help.find("Options:\n"), std::string::npos) << help;
}

// A command with options that depend on others; `words` are its arguments.
struct Sock {
  explicit Sock(std::vector<std::string> words) : line(app, declared()) {
    words.insert(words.begin(), {"knit", "wool", "-o", "sock"});
    std::ranges::reverse(words);
    app.parse(words);
  }

  OptionTable declared() {
    OptionTable table = commandOptions("knit", "Knit a sock");
    table.arguments("INPUT", inputs, "wool");
    table.text("--pattern", pattern, kVectorFile, "pattern");
    table.number("--heel", heel, "CM", {0.0, 9.0}, "heel");
    table.number("--heel-stitches", stitches, "N", {0.0, 9.0}, "stitches of the heel").needs({"--heel", "--pattern"});
    table.flag("--plain", plain, "no pattern").ignoredWith({"--pattern"});
    table.choice("--toe", toe, {"round", "wedge", "star"}, "toe");
    table.number("--toe-rounds", rounds, "N", {0.0, 9.0}, "rounds of a star").needs({"--toe star"});
    table.outputs("-o,--output", outputs, {.required = true, .files = twoFiles}, "socks");
    table.output("--bill", bill, {.standard_output = true}, "bill");
    return table;
  }

  static OutputFiles twoFiles(const std::string& path) { return {{path + ".left", path + ".right"}, {}, {}}; }
  std::vector<std::string> withoutEffect() const { return line.options().withoutEffect(); }

  CLI::App app;
  std::vector<std::string> inputs, outputs;
  std::string pattern, bill, toe = "round";
  double heel = 0.0, stitches = 3.0, rounds = 4.0;
  bool plain = false;
  CommandLine line;
};

using Sentences = std::vector<std::string>;

TEST(NeedsTest, WhatHasNoEffectIsSaid) {
  EXPECT_EQ(Sock({"--heel-stitches", "3", "--plain"}).withoutEffect(),
            Sentences{"--heel-stitches has no effect without one of --heel, --pattern"});
}

TEST(NeedsTest, AnOptionAtItsDefaultIsAsGoodAsNotGiven) {
  EXPECT_EQ(Sock({"--heel-stitches", "3", "--heel", "0.0"}).withoutEffect().size(), 1u);
}

TEST(NeedsTest, WithWhatItNeedsNothingIsSaid) {
  EXPECT_TRUE(Sock({"--heel-stitches", "4", "--pattern", "stars"}).withoutEffect().empty());
}

TEST(NeedsTest, AnotherOptionMayHaveToBeGivenAsOneOfItsValues) {
  for (const std::string toe : {"round", "wedge"}) {
    EXPECT_EQ(Sock({"--toe-rounds", "5", "--toe", toe}).withoutEffect(),
              Sentences{"--toe-rounds has no effect without --toe star"})
        << toe;
  }
  EXPECT_EQ(Sock({"--toe-rounds", "5"}).withoutEffect().size(), 1u);
  EXPECT_TRUE(Sock({"--toe-rounds", "5", "--toe", "star"}).withoutEffect().empty());
}

TEST(NeedsTest, WhatAnotherOptionOverridesIsSaid) {
  EXPECT_EQ(Sock({"--plain", "--pattern", "stars"}).withoutEffect(), Sentences{"--plain has no effect with --pattern"});
}

TEST(NeedsTest, FilesOfTheRunAreKnownByTheirOptions) {
  const Sock sock({"yarn", "-", "--pattern", "stars", "--config", "job.toml", "--bill", "-"});
  std::vector<std::string> read, written;
  for (const auto& [option, path] : sock.line.options().inputs()) read.push_back(option + " " + path);
  for (const auto& output : sock.line.options().outputs()) {
    for (const std::string& file : output.files.targets) written.push_back(output.option + " " + file);
  }
  EXPECT_EQ(read, (Sentences{"--config job.toml", "INPUT wool", "INPUT yarn", "--pattern stars"}));
  EXPECT_EQ(written, (Sentences{"--output sock.left", "--output sock.right"}));
}

TEST(NeedsTest, StandardOutputIsForThoseThatAllowIt) {
  const Sock sock({"-o", "-"});
  EXPECT_THROW(sock.line.options().outputs(), OptionError);
}

}  // namespace

}  // namespace coastmesh
