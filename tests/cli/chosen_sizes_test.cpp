// Sizes that the program chooses for a model's sea: one choice for all waters, within the bounds that were given.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.hpp"

namespace coastmesh::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

LonLatRing squareAt(double west, double south, double width, double height) {
  return {{west, south}, {west + width, south}, {west + width, south + height}, {west, south + height}, {west, south}};
}

// A sea of 140 by 110 km, cut by the frame in the west, and three ponds of 5 km east of it.
class ChosenSizes : public ProgramTest {
 protected:
  static std::vector<std::vector<LonLatRing>> sea() { return {{squareAt(0, 50, 2, 1)}}; }
  static std::vector<std::vector<LonLatRing>> seaAndPonds() {
    std::vector<std::vector<LonLatRing>> all = sea();
    for (const double west : {2.2, 2.4, 2.6}) all.push_back({squareAt(west, 50.4, 0.07, 0.05)});
    return all;
  }
  // Runs with depths that grow from 10 m in the north by 20 m in each of 99 rows.
  ProgramRun mesh(const std::vector<std::vector<LonLatRing>>& waters, const std::vector<std::string>& more,
                  const std::string& output = "a.14") const {
    std::ostringstream depths;
    depths << "ncols 2\nnrows 100\nxllcorner -0.5\nyllcorner 49.5\ndx 2\ndy 0.02\n";
    for (int row = 0; row < 100; ++row) depths << -10 - 20 * row << " " << -10 - 20 * row << "\n";
    std::vector<std::string> all{"--bathymetry", write("depths.asc", depths.str())};
    all.insert(all.end(), more.begin(), more.end());
    return meshWithoutDepths(waters, all, output);
  }
  ProgramRun meshWithoutDepths(const std::vector<std::vector<LonLatRing>>& waters, const std::vector<std::string>& more,
                               const std::string& output = "a.14") const {
    std::vector<std::string> arguments{"mesh",
                                       write("waters.geojson", geoJsonPolygons(waters)),
                                       "--bbox=0.1,49.5,3,51.5",
                                       "--target",
                                       "adcirc",
                                       "--report",
                                       file("r.json"),
                                       "--overwrite",
                                       "-o",
                                       file(output)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runProgram(arguments);
  }
  Json report() const { return Json::parse(readText(file("r.json"))); }
  // The options that the note on chosen sizes names; fails unless there is one note.
  std::string saidOptions() const {
    std::vector<std::string> said;
    const Json whole = report();
    for (const std::string note : whole.at("input").at("notes")) {
      const std::string lead = "as with ";
      const std::size_t at = note.find(lead);
      if (note.starts_with("sizes were chosen"))
        said.push_back(note.substr(at + lead.size(), note.find(',', at) - at - lead.size()));
    }
    EXPECT_EQ(said.size(), 1u);
    return said.empty() ? "" : said.front();
  }
};

TEST_F(ChosenSizes, AreThoseOfTheLargestWater) {
  ASSERT_EQ(mesh(sea(), {}).code, 0);
  const std::string alone = saidOptions();
  ASSERT_EQ(mesh(seaAndPonds(), {}).code, 0);
  EXPECT_EQ(saidOptions(), alone);
  // The ponds are left out, in the figures of the input too.
  const Json left = report();
  EXPECT_NEAR(left.at("input").at("area_m2").get<double>() / left.at("mesh").at("area_m2").get<double>(), 1.0, 1e-3);
  EXPECT_LE(left.at("refine").at("steiner_points").get<int>(), left.at("mesh").at("vertices").get<int>());
  EXPECT_GE(left.at("mesh").at("vertices").get<int>(), 10'000);
  ASSERT_LE(mesh(seaAndPonds(), {"--keep-water", "all"}).code, 1);
  saidOptions();
  EXPECT_LE(report().at("mesh").at("vertices").get<int>(), 100'000);
}

// Sizes much finer than the data show nothing more of the shore.
TEST_F(ChosenSizes, AreComparedWithTheShoresDetail) {
  LonLatRing fine;
  constexpr int kPoints = 400;  // on each side, up to 350 m apart
  const LonLatRing corners = squareAt(0, 50, 2, 1);
  for (std::size_t side = 0; side + 1 < corners.size(); ++side)
    for (int i = 0; i < kPoints; ++i) {
      const auto& [x, y] = corners[side];
      const auto& [to_x, to_y] = corners[side + 1];
      fine.push_back({x + (to_x - x) * i / kPoints, y + (to_y - y) * i / kPoints});
    }
  fine.push_back(fine.front());
  for (const bool is_fine : {false, true}) {
    const ProgramRun run = mesh(is_fine ? std::vector<std::vector<LonLatRing>>{{fine}} : sea(), {"--coast", "follow"});
    ASSERT_EQ(run.code, 0) << run.errors;
    const std::string notes = report().at("input").at("notes").dump();
    EXPECT_EQ(notes.find("three in four edges of the input's shore are more than ") == std::string::npos, is_fine)
        << notes;
  }
}

TEST_F(ChosenSizes, AreNotBelowTheMinimum) {
  for (const std::string least : {"3000", "20000"}) {
    ASSERT_EQ(mesh(sea(), {"--size-min", least}).code, 0);
    EXPECT_GE(report().at("refine").at("size_max_m").get<double>(), std::stod(least));
    EXPECT_EQ(report().at("step").at("size_min").at("missed"), false);
  }
}

// In 2 km of water a wave travels at 140 m/s.
TEST_F(ChosenSizes, SuitTheTimeStep) {
  const ProgramRun run = mesh(sea(), {"--time-step", "60"});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_GE(report().at("refine").at("size_max_m").get<double>(), 60.0 * 140.0 * 5.0 / 3.0);
}

TEST_F(ChosenSizes, LeaveTheirEffectToOtherOptions) {
  for (const std::vector<std::string>& given : std::vector<std::vector<std::string>>{
           {"--size-min", "3000", "--grade", "0.1", "--land-min", "0", "--channel-min", "0.5", "--courant", "0.5",
            "--quality", "links", "--keep-water", "all", "--wave-period", "40000", "--shore-rate", "0.1"},
           {"--size-min", "3333.3333333333333", "--time-step", "0"},
           {"--size-min", "3000", "--coast", "keep"}}) {
    const ProgramRun run = mesh(sea(), given);
    ASSERT_EQ(run.code, 0) << run.errors;
    EXPECT_THAT(run.errors, Not(HasSubstr("has no effect")));
    EXPECT_TRUE(report().at("refine").at("size_max_m").is_number());
    // The options of the note make the same mesh, together with those given.
    std::vector<std::string> all = given;
    std::istringstream said(saidOptions());
    for (std::string word; said >> word;) all.push_back(word);
    const ProgramRun again = mesh(sea(), all, "b.14");
    ASSERT_EQ(again.code, 0) << again.errors;
    EXPECT_TRUE(readText(file("a.14")) == readText(file("b.14")));
  }
}

TEST_F(ChosenSizes, NeedNoDepths) {
  const ProgramRun run = meshWithoutDepths(sea(), {});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_GE(report().at("mesh").at("vertices").get<int>(), 10'000);
  EXPECT_LE(report().at("mesh").at("vertices").get<int>(), 100'000);
  std::vector<std::string> said;
  std::istringstream words(saidOptions());
  for (std::string word; words >> word;) said.push_back(word);
  EXPECT_THAT(said, Not(Contains("--wave-elements")));
  EXPECT_THAT(said, Not(Contains("--time-step")));
  ASSERT_EQ(meshWithoutDepths(sea(), said, "b.14").code, 0);
  EXPECT_TRUE(readText(file("a.14")) == readText(file("b.14")));
  // A wave and a time step need depths, so that options on them have no effect.
  const ProgramRun idle = meshWithoutDepths(sea(), {"--wave-period", "40000", "--courant", "0.5"});
  EXPECT_THAT(idle.errors, HasSubstr("--wave-period has no effect without --wave-elements"));
  EXPECT_THAT(idle.errors, HasSubstr("--courant has no effect without --time-step"));
}

TEST_F(ChosenSizes, DoNotExcuseWhatTheCoastIgnores) {
  const ProgramRun kept = mesh(sea(), {"--size-min", "3000", "--coast", "keep", "--land-min", "0"});
  EXPECT_THAT(kept.errors, HasSubstr("--land-min has no effect without --coast follow"));
  const ProgramRun free = mesh(sea(), {"--size-min", "3000", "--time-step", "0", "--courant", "0.5"});
  EXPECT_THAT(free.errors, HasSubstr("--courant has no effect without --time-step"));
}

// A bound alone says nothing of the coast, whose short edges a model would pay for.
TEST_F(ChosenSizes, ABoundAloneLeavesTheCoastWhichIsSaid) {
  LonLatRing fine = squareAt(0, 50, 2, 1);
  fine.insert(fine.begin() + 2, {{2, 50.5}, {1.99999, 50.50001}});
  const std::string note = "leaves the coast as it is in the data";
  EXPECT_THAT(meshWithoutDepths({{fine}}, {"--size-max", "20000"}).output, HasSubstr("--size-max 20000 " + note));
  EXPECT_THAT(meshWithoutDepths(sea(), {"--size-max", "20000"}).output, Not(HasSubstr(note)));
  EXPECT_THAT(meshWithoutDepths({{fine}}, {"--size", "20000", "--coast", "follow"}).output, Not(HasSubstr(note)));
}

}  // namespace
}  // namespace coastmesh::test
