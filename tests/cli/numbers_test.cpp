// Unusable numbers, given to every option that takes a number.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

class Numbers : public ProgramTest {
 protected:
  // Expects exit code 2 and the option's name in the error, before anything is read.
  void expectMisuse(const std::string& command, const std::string& option, const std::string& value) const {
    SCOPED_TRACE(command + " " + option + "=" + value);
    std::vector<std::string> arguments{command, file("nowhere.nc"), option + "=" + value};
    if (command != "check" && command != "info") {
      const std::string ending = command == "plot" ? ".png" : command == "clean" ? ".gpkg" : ".2dm";
      arguments.insert(arguments.end(), {"-o", file("out" + ending)});
    }
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, 2) << run.errors;
    EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
    EXPECT_THAT(run.errors, HasSubstr(option));
    EXPECT_THAT(run.errors, HasSubstr(value));
  }
};

TEST_F(Numbers, ThatOverflowOrVanishAreMisuse) {
  const Json usage = Json::parse(runProgram({"--json-usage"}).output);
  std::size_t options = 0;
  for (const Json& command : usage["commands"]) {
    for (const Json& option : command["options"]) {
      if (option["type"] != "number") continue;
      ++options;
      for (const char* value : {"1e71", "5e-324", "nan"}) expectMisuse(command["command"], option["name"], value);
    }
  }
  EXPECT_GT(options, 30u);
}

TEST_F(Numbers, InListsToo) {
  for (const char* odd : {"1e308", "1e-71", "nan", "1e999"}) {
    const std::string value = odd;
    for (const std::string command : {"mesh", "clean"}) {
      expectMisuse(command, "--bbox", "-87,41," + value + ",42");
      expectMisuse(command, "--water-at", "-87," + value);
    }
    expectMisuse("plot", "--bbox", "-87,41," + value + ",42");
    expectMisuse("mesh", "--depth-band", "0,10," + value);
    expectMisuse("mesh", "--depth-band", value + ",1e60,20");
  }
}

TEST_F(Numbers, AtTheEndsOfTheirRangeAreTaken) {
  const std::string input = lake();
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--simplify", "1e-70"},
                                                  {"--snap=0"},
                                                  {"--size", "1e70"},
                                                  {"--size-max", "1e70"},
                                                  {"--min-island-area", "1e70"},
                                                  {"--size-shore", "200", "--shore-rate", "1000"},
                                                  {"--channel-elements", "1000", "--size-min", "200"},
                                                  {"--size", "200", "--grade", "1"}}) {
    std::vector<std::string> arguments{"mesh", input, "-o", file("m.2dm"), "--overwrite", "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, 0) << options.front() << run.errors;
  }
}

}  // namespace

}  // namespace coastmesh::test
