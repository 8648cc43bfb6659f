// Sizes that require too many vertices are reported at once, with their number, and nothing is made.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.hpp"

namespace coastmesh::test {
namespace {

using Json = nlohmann::json;

// Sanitizers use a lot of memory themselves.
#ifdef COASTMESH_SANITIZED
constexpr bool kMemoryIsTheProgramsOwn = false;
#else
constexpr bool kMemoryIsTheProgramsOwn = true;
#endif

class SizeLimits : public ProgramTest {
 protected:
  ProgramRun mesh(const std::vector<std::string>& options) const {
    std::vector<std::string> arguments{"mesh", lake(), "-o", file("a.2dm"), "--report", file("a.json"), "--overwrite"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return runProgram(arguments);
  }
  Json report() const { return Json::parse(readText(file("a.json"))); }
  bool isMeshThere() const { return names().contains("a.2dm"); }
  // A text raster around the lake, in the lake's CRS, with one pixel that differs from the others.
  std::string raster(const std::string& name, double elsewhere, double there) const {
    std::ostringstream text;
    text << "ncols 20\nnrows 20\nxllcorner -87.51\nyllcorner 41.595\ncellsize 0.0025\n";
    for (int row = 0; row < 20; ++row)
      for (int column = 0; column < 20; ++column)
        text << (row == 13 && column == 4 ? there : elsewhere) << (column < 19 ? ' ' : '\n');
    return write(name, text.str());
  }
};

TEST_F(SizeLimits, BeyondTheBudgetNothingIsMade) {
  const std::vector<std::vector<std::string>> cases{
      {"--size", "1e-3"},
      {"--size", "1e-60"},
      {"--size-shore", "1e-3"},
      {"--size-shore", "1e-3", "--coast", "follow"},
      {"--size-raster", raster("sizes.asc", 500.0, 0.5)},
      {"--bathymetry", raster("depths.asc", -100.0, -90.0), "--wave-elements", "1e9"},
      {"--bathymetry", file("depths.asc"), "--depth-band", "0,95,0.01"},
      {"--channel-elements", "1000", "--size-min", "0.01"},
      {"--size", "100", "--grade", "1e-60"},
  };
  for (std::vector<std::string> options : cases) {
    options.insert(options.end(), {"--max-vertices", "20000"});
    const ProgramRun run = mesh(options);
    const std::string shown = ::testing::PrintToString(options) + run.errors;
    EXPECT_EQ(run.code, 1) << shown;
    EXPECT_TRUE(isOneErrorLine(run.errors)) << shown;
    EXPECT_NE(run.errors.find("--max-vertices allows 20000"), std::string::npos) << shown;
    EXPECT_FALSE(isMeshThere()) << shown;
    const Json json = report();
    EXPECT_GT(json["refine"]["estimated_vertices"].get<double>(), 40000.0) << shown;
    EXPECT_EQ(json["input"]["refused"].size(), 1u) << shown;
    EXPECT_LT(json["peak_memory_mib"].get<double>(), 500.0) << shown;
  }
}

// Shores that almost coincide take many vertices without any size; the budget keeps the run short.
TEST_F(SizeLimits, ASliverIsWarnedOf) {
  const auto meshStrip = [&](const std::string& width) {
    const std::string north = "5800000" + width;
    const std::string strip =
        write("strip.geojson", R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32631"}},
        "features":[{"type":"Feature","id":7,"properties":{},"geometry":{"type":"Polygon","coordinates":
        [[[500000,5800000],[520000,5800000],[520000,)" +
                                   north + "],[500000," + north + "],[500000,5800000]]]}}]}");
    return runProgram({"mesh", strip, "-o", file("a.nc"), "--max-vertices", "2000", "--overwrite", "--quiet"}).errors;
  };
  const std::string errors = meshStrip(".08");
  for (const char* part : {"strip.geojson', feature 7: bounds on angles take about 200000 vertices",
                           "along about 20 km", "0.08 m apart", "--snap"})
    EXPECT_NE(errors.find(part), std::string::npos) << part << errors;
  EXPECT_EQ(meshStrip(".2").find("coincide"), std::string::npos);
}

// A mesh slightly over the budget is recognised before the whole size map is made.
TEST_F(SizeLimits, ALittleBeyondWhatIsBegunTakesNoWholeMap) {
  // About 650,000 vertices are needed; up to 520,000 would be meshed.
  const ProgramRun run = mesh({"--size-shore", "0.1", "--size-max", "2000", "--max-vertices", "260000"});
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.errors.find("--max-vertices allows 260000"), std::string::npos) << run.errors;
  EXPECT_FALSE(isMeshThere());
  EXPECT_NEAR(report()["refine"]["estimated_vertices"].get<double>() / 650e3, 1.0, 0.25);
  if (kMemoryIsTheProgramsOwn) {
    EXPECT_LT(report()["peak_memory_mib"].get<double>(), 120.0);  // with the whole map four times as much
  }
}

TEST_F(SizeLimits, BeyondTheMemoryNothingIsTaken) {
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--size", "1e-3"},
                                             {"--size-shore", "1e-8"},
                                             {"--size-max", "1e-3"},
                                             {"--size", "100", "--grade", "1e-60"}}) {
    const ProgramRun run = mesh(options);
    const std::string shown = ::testing::PrintToString(options) + run.errors;
    EXPECT_EQ(run.code, 3) << shown;
    EXPECT_TRUE(isOneErrorLine(run.errors)) << shown;
    EXPECT_NE(run.errors.find("there is memory for about"), std::string::npos) << shown;
    EXPECT_FALSE(isMeshThere()) << shown;
    EXPECT_LT(report()["peak_memory_mib"].get<double>(), 500.0) << shown;
  }
}

TEST_F(SizeLimits, NumbersAreWrittenInFull) {
  const std::string sea = write("sea.geojson", geoJsonPolygons({{{{3, 52}, {6, 52}, {6, 55}, {3, 55}}}}));
  const ProgramRun run = runProgram({"mesh", sea, "-o", file("a.2dm"), "--size", "1000", "--max-vertices", "100"});
  EXPECT_EQ(run.code, 1) << run.errors;
  EXPECT_NE(run.errors.find("--size asks for 1000 m"), std::string::npos) << run.errors;
  EXPECT_EQ(run.errors.find("e+0"), std::string::npos) << run.errors;
}

// Lattices take less memory per vertex than refinement, and only one algorithm uses them.
TEST_F(SizeLimits, LatticesFitWhereRefinementDoesNot) {
  const auto room = [&](const std::string& algorithm) {
    const ProgramRun run = mesh({"--size-max", "1e-3", "--algorithm", algorithm});
    const std::string before = "there is memory for about ";
    const std::size_t at = run.errors.find(before);
    EXPECT_NE(at, std::string::npos) << run.errors;
    return at == std::string::npos ? 0.0 : std::stod(run.errors.substr(at + before.size()));
  };
  EXPECT_NEAR(room("relocate") / room("offcenter"), 600.0 / 320.0, 0.3);
}

// A creek 200 km long and 0.1 m wide: finding all widths would take more memory than the mesh may.
TEST_F(SizeLimits, ChannelsAreWalkedNoFurtherThanTheyMayAskFor) {
  LonLatRing creek;
  for (int k = 0; k <= 200; ++k) creek.emplace_back(1000.0 * k, 30.0 * (k % 2));
  for (int k = 200; k >= 0; --k) creek.emplace_back(1000.0 * k, 30.0 * (k % 2) + 0.1);
  const std::string input = write("creek.geojson", geoJsonPolygons({{creek}}));
  const ProgramRun run = runProgram({"mesh", input, "--crs", "plane", "-o", file("a.2dm"), "--channel-elements", "10",
                                     "--size-min", "1e-3", "--max-vertices", "20000", "--report", file("a.json")});
  EXPECT_EQ(run.code, 1) << run.errors;
  EXPECT_NE(run.errors.find("where --channel-elements asks for"), std::string::npos) << run.errors;
  EXPECT_NE(run.errors.find("--max-vertices allows 20000"), std::string::npos) << run.errors;
  EXPECT_FALSE(isMeshThere());
  // Edges of a tenth of the width: one vertex per sqrt(3) / 2 of their squared length.
  const double vertices = 200e3 * 0.1 / (0.01 * 0.01 * std::sqrt(3.0) / 2.0);
  EXPECT_NEAR(report()["refine"]["estimated_vertices"].get<double>() / vertices, 1.0, 0.15);
  if (kMemoryIsTheProgramsOwn) {
    EXPECT_LT(report()["peak_memory_mib"].get<double>(), 100.0);
  }
}

// A thread that cannot start because of a limit, such as one of memory for stacks, is no bug.
TEST_F(SizeLimits, ThreadsThatCannotBeStarted) {
  if (!kMemoryIsTheProgramsOwn) GTEST_SKIP() << "no limit can be set on memory";
  const std::string run = "\"$0\" mesh '" + lake() + "' -o '" + file("a.2dm") + "' --size-max 20 --quiet --threads ";
  for (const std::string& limited : {"ulimit -v 200000; " + run + "8", "ulimit -v 1000000; " + run + "1024"}) {
    const ProgramRun refused = runShell(limited);
    if (refused.code == 0) continue;  // on a machine where threads need less
    EXPECT_EQ(refused.code, 3) << refused.errors;
    EXPECT_TRUE(isOneErrorLine(refused.errors)) << refused.errors;
    EXPECT_EQ(names(), std::set<std::string>{"lake.geojson"});
  }
}

// Two shores of a kilometre, ten micrometres apart: a bound of 33 degrees takes a hundred million triangles between
// them.
TEST_F(SizeLimits, RefinementBeyondTheMemoryStopsAndSaysWhere) {
  if (!kMemoryIsTheProgramsOwn) GTEST_SKIP() << "no limit can be set on memory";
  const std::string strip = write("strip.geojson", geoJsonPolygons({{{{0, 0}, {1000, 0}, {1000, 1e-5}, {0, 1e-5}}}}));
  const std::string command =
      "\"$0\" mesh '" + strip + "' --crs plane --snap 0 --threads 1 -o '" + file("a.2dm") + "' --quiet";
  const ProgramRun run = runShell("ulimit -v 700000; " + command);
  EXPECT_EQ(run.code, 3) << run.errors;
  EXPECT_NE(run.errors.find("the most that fit in memory"), std::string::npos) << run.errors;
  double x = -1.0, y = -1.0;
  const std::size_t at = run.errors.find("near (");
  ASSERT_NE(at, std::string::npos) << run.errors;
  ASSERT_EQ(std::sscanf(run.errors.c_str() + at, "near (%lf, %lf)", &x, &y), 2);
  EXPECT_TRUE(x >= 0.0 && x <= 1000.0 && y >= 0.0 && y <= 1e-5) << run.errors;
  EXPECT_FALSE(isMeshThere());
  EXPECT_EQ(names(), std::set<std::string>{"strip.geojson"});
  EXPECT_EQ(runShell(command + " --max-vertices 5000").code, 1);
  EXPECT_TRUE(isMeshThere());
}

TEST_F(SizeLimits, NamesTheOptionAndThePlace) {
  const ProgramRun run = mesh({"--size-raster", raster("sizes.asc", 500.0, 0.5), "--max-vertices", "3000"});
  EXPECT_NE(run.errors.find("where --size-raster asks for 0.5 m"), std::string::npos) << run.errors;
  double lon = 0.0, lat = 0.0;
  const std::size_t at = run.errors.find("near (");
  ASSERT_NE(at, std::string::npos) << run.errors;
  ASSERT_EQ(std::sscanf(run.errors.c_str() + at, "near (%lf, %lf)", &lon, &lat), 2);
  EXPECT_NEAR(lon, -87.49875, 0.0015);
  EXPECT_NEAR(lat, 41.61125, 0.0015);
}

TEST_F(SizeLimits, EstimatesAreRightToHalfAsMuch) {
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {"--size", "50"},
           {"--size", "20"},
           {"--size-shore", "10", "--size-max", "300"},
           {"--size-shore", "5", "--shore-rate", "0.3", "--coast", "follow"},
           {"--size-raster", raster("sizes.asc", 80.0, 8.0)},
           {"--channel-elements", "6", "--size-min", "5", "--size-max", "200"},
           {"--bathymetry", raster("depths.asc", -100.0, -20.0), "--wave-elements", "30000"}}) {
    const ProgramRun run = mesh(options);
    const std::string shown = ::testing::PrintToString(options) + run.errors;
    EXPECT_EQ(run.code, 0) << shown;
    const Json json = report();
    const double share = json["refine"]["estimated_vertices"].get<double>() / json["mesh"]["vertices"].get<double>();
    EXPECT_GT(share, 1.0 / 1.5) << shown;
    EXPECT_LT(share, 1.5) << shown;
    EXPECT_NE(run.output.find("were expected from these sizes"), std::string::npos) << shown;
  }
}

TEST_F(SizeLimits, ALittleBeyondTheBudgetItIsRefinedAsFarAsThatGoes) {
  ASSERT_EQ(mesh({"--size", "30"}).code, 0);
  const auto vertices = report()["mesh"]["vertices"].get<std::uint64_t>();
  EXPECT_EQ(mesh({"--size", "30", "--max-vertices", std::to_string(vertices * 3 / 4)}).code, 1);
  EXPECT_TRUE(report()["refine"]["budget_reached"].get<bool>());
  EXPECT_EQ(runProgram({"check", file("a.2dm"), "--assume-crs", "EPSG:4326"}).code, 0);
}

// Sizes that vary from pixel to pixel: the mesh would have fewer vertices than the map of its sizes may have cells.
TEST_F(SizeLimits, SizesThatVaryTooMuchToBeStored) {
  constexpr int kPixels = 500;
  std::ostringstream noise;
  noise << "ncols 500\nnrows 500\nxllcorner 0\nyllcorner 0\ncellsize 20\n";
  for (unsigned random = 1, k = 0; k < kPixels * kPixels; ++k) {
    random = 1664525u * random + 1013904223u;
    noise << (random >> 31 != 0 ? 60 : 120) << (k % kPixels + 1 < kPixels ? ' ' : '\n');
  }
  const std::string basin =
      write("basin.geojson", geoJsonPolygons({{{{0, 0}, {10'000, 0}, {10'000, 10'000}, {0, 10'000}}}}));
  const auto meshed = [&, sizes = write("noise.asc", noise.str())](const std::vector<std::string>& further) {
    std::vector<std::string> options{"mesh", basin, "--crs", "plane", "-o", file("a.2dm"), "--size-raster", sizes};
    options.insert(options.end(), further.begin(), further.end());
    return runProgram(options);
  };
  const ProgramRun run = meshed({"--max-vertices", "50000"});
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.errors.find("these sizes vary so much that storing them takes more memory than such a mesh may: "
                            "--max-vertices allows 50000"),
            std::string::npos)
      << run.errors;
  EXPECT_FALSE(isMeshThere());
  // As the message advises.
  EXPECT_EQ(meshed({"--max-vertices", "50000", "--size-min", "120"}).code, 0);
}

// Values beyond any wave or model would overflow in the computation of sizes, and have no effect.
TEST_F(SizeLimits, NumbersBeyondAnyUseAreRefused) {
  const std::string depths = raster("depths.asc", -100.0, -90.0);
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{"--wave-elements", "100", "--wave-period", "1e-300"},
                                             {"--wave-elements", "100", "--wave-period", "1e300"},
                                             {"--size", "50", "--time-step", "1e308"},
                                             {"--size", "50", "--time-step", "10", "--courant", "1e-300"}}) {
    std::vector<std::string> options{"--bathymetry", depths};
    options.insert(options.end(), wrong.begin(), wrong.end());
    EXPECT_EQ(mesh(options).code, 2) << ::testing::PrintToString(wrong);
  }
}

// A plane graph with a hole point.
TEST_F(SizeLimits, OfAPlaneGraph) {
  const std::string poly = write("ring.poly",
                                 "8 2 0 0\n0 0 0\n1 10 0\n2 10 10\n3 0 10\n4 1 1\n5 9 1\n6 9 9\n7 1 9\n"
                                 "8 0\n0 0 1\n1 1 2\n2 2 3\n3 3 0\n4 4 5\n5 5 6\n6 6 7\n7 7 4\n1\n0 5 5\n");
  const auto run = [&](const std::string& size, const std::string& most) {
    return runProgram({"mesh", poly, "-o", file("a.2dm"), "--report", file("a.json"), "--overwrite", "--size", size,
                       "--max-vertices", most})
        .code;
  };
  EXPECT_EQ(run("0.1", "20000"), 0);
  EXPECT_NEAR(report()["refine"]["estimated_vertices"].get<double>() / report()["mesh"]["vertices"].get<double>(), 1.0,
              0.15);
  EXPECT_EQ(run("0.01", "20000"), 1);
  EXPECT_EQ(report()["mesh"]["triangles"], 0);
}

// A lake of one hectare, and one that takes some 930,000 vertices, more than `kLittle` allows. In a plane.
class LackingMemory : public SizeLimits {
 protected:
  static constexpr const char* kLittle = "ulimit -v 450000; ";

  void SetUp() override {
    if (!kMemoryIsTheProgramsOwn) GTEST_SKIP() << "no limit can be set on memory";
    lakes_ = write("lakes.geojson", geoJsonPolygons({{{{0, 0}, {100, 0}, {100, 100}, {0, 100}}},
                                                     {{{9000, 0}, {9900, 0}, {9900, 900}, {9000, 900}}}}));
  }
  std::string command(const std::string& more) const {
    return "\"$0\" mesh '" + lakes_ + "' --crs plane --size-max 1 --threads 1 --quiet " + more;
  }
  std::string quoted(const std::string& name) const { return "'" + file(name) + "' "; }
  std::string whole() const {
    EXPECT_EQ(runShell(command("-o " + quoted("whole.2dm"))).code, 0);
    return readText(file("whole.2dm"));
  }

  std::string lakes_;
};

TEST_F(LackingMemory, AShardIsMadeAnewWhereThereIsMore) {
  const std::string shard = command("--shard 1/1 --skip-existing -o " + quoted("a.shard"));
  const ProgramRun little = runShell(kLittle + shard);
  EXPECT_EQ(little.code, 1);
  EXPECT_NE(little.errors.find("there is memory for about"), std::string::npos) << little.errors;
  EXPECT_EQ(runShell(shard).code, 0);
  EXPECT_EQ(runProgram({"gather", file("a.shard"), "-o", file("a.2dm"), "--quiet"}).code, 0);
  EXPECT_TRUE(readText(file("a.2dm")) == whole());
}

TEST_F(LackingMemory, GatherMeshesWhatShardsCouldNot) {
  const int codes = runShell(kLittle + command("--shard 1/2 -o " + quoted("a.shard"))).code +
                    runShell(kLittle + command("--shard 2/2 -o " + quoted("b.shard"))).code;
  EXPECT_EQ(codes, 1);  // for one of them
  const std::string gather =
      "\"$0\" gather " + quoted("a.shard") + quoted("b.shard") + "--overwrite --quiet --threads 1 ";
  EXPECT_EQ(runShell(kLittle + gather + "-o " + quoted("a.2dm")).code, 1);
  EXPECT_EQ(runShell(gather + "-o " + quoted("a.2dm")).code, 0);
  EXPECT_TRUE(readText(file("a.2dm")) == whole());
}

TEST_F(LackingMemory, ACheckpointKeepsTheRest) {
  const std::string kept =
      command("--overwrite --checkpoint " + quoted("kept") + "--report " + quoted("a.json") + "-o " + quoted("a.2dm"));
  const ProgramRun little = runShell(kLittle + kept);
  EXPECT_EQ(little.code, 1);
  EXPECT_NE(little.errors.find("resumes from it"), std::string::npos) << little.errors;
  EXPECT_TRUE(std::filesystem::exists(file("kept")));
  EXPECT_EQ(runShell(kept).code, 0);
  EXPECT_EQ(report()["checkpoint"]["groups_taken"], 1);
  EXPECT_TRUE(readText(file("a.2dm")) == whole());
  EXPECT_FALSE(std::filesystem::exists(file("kept")));
}

TEST_F(LackingMemory, FeaturesApartAreMadeWhereThereIsMore) {
  const std::string apart = command("--per-feature --skip-existing -o " + quoted("lake-{}.2dm"));
  EXPECT_EQ(runShell(kLittle + apart).code, 1);
  EXPECT_EQ(runShell(apart).code, 0);
}

TEST_F(SizeLimits, OneLakeOfSeveralIsLeftOut) {
  const std::string input = write("two.geojson", geoJsonPolygons({{{{0, 0}, {0.001, 0}, {0.001, 0.001}, {0, 0.001}}},
                                                                  {{{1, 1}, {1.5, 1}, {1.5, 1.5}, {1, 1.5}}}}));
  for (const std::string threads : {"1", "2"}) {
    const ProgramRun run = runProgram(
        {"mesh", input, "-o", file(threads + ".2dm"), "--size", "50", "--max-vertices", "20000", "--threads", threads});
    EXPECT_EQ(run.code, 1) << run.errors;
    EXPECT_NE(run.errors.find("feature 1: these sizes ask for about"), std::string::npos) << run.errors;
    EXPECT_NE(run.errors.find("share by points"), std::string::npos) << run.errors;
  }
  EXPECT_EQ(readText(file("1.2dm")), readText(file("2.2dm")));
}

}  // namespace
}  // namespace coastmesh::test
