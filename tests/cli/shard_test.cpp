#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

constexpr int kLakes = 23;

// Lakes of 3 to 60 corners, the second and the third side by side, the last a bow tie without area that is refused.
class Shard : public ProgramTest {
 protected:
  std::string lakes(double shift = 0.0) const {
    Json features = Json::array();
    for (int i = 0; i < kLakes; ++i) {
      Json ring = Json::array();
      const int corners = 3 + (i * 37) % 58;
      for (int k = 0; k <= corners; ++k) {
        const double angle = 6.283185307179586 * (k % corners) / corners;
        const double radius = 0.01 * (1.0 + 0.3 * ((k % corners) % 3));
        const double west = i == 2 ? -87.4 + 0.02 : -87.4 + 0.1 * (i % 6);
        const double y = 41.6 + 0.1 * (i == 2 ? 0 : i / 6) + shift;
        ring.push_back({west + radius * std::cos(angle), y + radius * std::sin(angle)});
      }
      if (i == kLakes - 1) ring = {{-80.0, 41.0}, {-80.1, 41.0}, {-80.0, 41.0}, {-80.0, 41.0}};
      features.push_back({{"type", "Feature"},
                          {"properties", {{"name", "lake " + std::to_string(i)}}},
                          {"geometry", {{"type", "Polygon"}, {"coordinates", {ring}}}}});
    }
    return write("lakes.geojson", Json{{"type", "FeatureCollection"}, {"features", features}}.dump());
  }
  std::string shardFile(int i) const { return file("s" + std::to_string(i) + ".shard"); }
  // The exit codes of all shards.
  std::vector<int> runShards(const std::string& input, int count, const std::vector<std::string>& options) const {
    std::vector<int> codes;
    for (int i = 1; i <= count; ++i) {
      std::vector<std::string> words{"mesh", input,        "--shard", std::to_string(i) + '/' + std::to_string(count),
                                     "-o",   shardFile(i), "--quiet"};
      words.insert(words.end(), options.begin(), options.end());
      codes.push_back(runProgram(words).code);
    }
    return codes;
  }
  std::vector<std::string> gather(int count, const std::vector<std::string>& options) const {
    std::vector<std::string> words{"gather"};
    for (int i = count; i >= 1; --i) words.push_back(shardFile(i));
    words.insert(words.end(), options.begin(), options.end());
    return words;
  }
  void expectRefused(const std::vector<std::string>& words, int code, const std::string& why) const {
    const ProgramRun run = runProgram(words);
    EXPECT_EQ(run.code, code) << run.errors;
    EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
    EXPECT_THAT(run.errors, HasSubstr(why));
  }
};

// The report without measured times and properties of the process.
Json lasting(Json report) {
  for (const char* key : {"time_s", "parallel", "peak_memory_mib", "threads"}) report.erase(key);
  return report;
}

TEST_F(Shard, GatheredIsTheWholeByteForByte) {
  const std::string input = lakes();
  for (const char* folder : {"w", "g"}) std::filesystem::create_directory(file(folder));
  const auto asInW = [&](std::string text) {
    for (std::size_t at = 0; (at = text.find(file("g") + "/", at)) != std::string::npos;)
      text.replace(at, file("g").size(), file("w"));
    return text;
  };
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--min-angle", "30", "--no-smooth"},
                                                  {"--size-max", "400", "--max-vertices", "4000", "--mark-pieces"},
                                                  // No element fits into these lakes: one note for all.
                                                  {"--size-shore", "4000", "--coast", "follow"},
                                                  // Repairs process each group again, in its own plane.
                                                  {"--size", "500", "--target", "fvcom", "--partition", "4"}}) {
    std::vector<std::string> whole{
        "mesh",        input,          "-o",      file("w/x.nc"),        "-o",       file("w/x.gpkg"),
        "-o",          file("w/x.14"), "--edits", file("w/x_e.geojson"), "--report", file("w/x.json"),
        "--overwrite", "--quiet"};
    whole.insert(whole.end(), options.begin(), options.end());
    const ProgramRun one = runProgram(whole);
    EXPECT_EQ(one.code, 1) << one.errors;  // because of the refused lake
    std::vector<std::string> of_shards = options;
    const bool parts = of_shards.back() == "4";
    if (parts) of_shards.resize(of_shards.size() - 2);
    of_shards.push_back("--overwrite");
    const std::vector<int> codes = runShards(input, 7, of_shards);
    EXPECT_EQ(std::ranges::max(codes), 1);
    std::vector<std::string> words =
        gather(7, {"-o", file("g/x.nc"), "-o", file("g/x.gpkg"), "-o", file("g/x.14"), "--edits", file("g/x_e.geojson"),
                   "--report", file("g/x.json"), "--overwrite", "--quiet", "--threads", "1"});
    if (parts) words.insert(words.end(), {"--partition", "4"});
    const ProgramRun gathered = runProgram(words);
    EXPECT_EQ(gathered.code, 1) << gathered.errors;
    EXPECT_EQ(asInW(gathered.errors), one.errors);
    for (const std::string name : {".nc", ".gpkg", ".14", "_e.geojson"}) {
      EXPECT_TRUE(readText(file("w/x" + name)) == readText(file("g/x" + name))) << name;
    }
    EXPECT_EQ(lasting(Json::parse(asInW(readText(file("g/x.json"))))),
              lasting(Json::parse(readText(file("w/x.json")))));
  }
}

// Each group is in exactly one shard; a shard's own mesh is its part of the whole mesh.
TEST_F(Shard, DealsEveryLakeOnce) {
  const std::string input = lakes();
  std::multiset<std::int64_t> fids;
  std::vector<std::uint64_t> triangles;
  for (int i = 1; i <= 3; ++i) {
    const std::string out = file("part" + std::to_string(i) + ".geojson");
    runProgram({"mesh", input, "--shard", std::to_string(i) + "/3", "-o", out, "--size-max", "300", "--quiet"});
    std::set<std::int64_t> own;
    const Json part = Json::parse(readText(out));
    for (const Json& triangle : part["features"]) own.insert(triangle["properties"]["src_fid"].get<std::int64_t>());
    fids.insert(own.begin(), own.end());
    triangles.push_back(part["features"].size());
  }
  EXPECT_EQ(fids.size(), std::size_t{kLakes - 1});
  EXPECT_EQ(std::set(fids.begin(), fids.end()).size(), fids.size());
}

// Standard output holds nothing but what programs read.
TEST_F(Shard, WithoutAMeshNoProseIsPrintedForPrograms) {
  const std::string input = lakes();
  const std::vector<std::string> made{"mesh", input, "--shard", "2/3", "-o", shardFile(2), "--skip-existing"};
  const std::vector<std::string> nothing{"mesh",    "--domain", "globe", "--size",        "2000000",
                                         "--shard", "2/2",      "-o",    file("g.shard"), "--overwrite"};
  ASSERT_LE(runProgram(made).code, 1);
  for (const auto& [words, line] :
       {std::pair(made, "all outputs exist already"), std::pair(nothing, "nothing of this shard was meshed")}) {
    const auto with = [&words = words](std::initializer_list<std::string> more) {
      std::vector<std::string> all = words;
      all.insert(all.end(), more);
      return runProgram(all);
    };
    const ProgramRun plain = with({});
    EXPECT_THAT(plain.output, ::testing::EndsWith(std::string(line) + "\n"));
    const ProgramRun report = with({"--report", "-"});
    EXPECT_TRUE(report.output.empty() || Json::accept(report.output)) << report.output;
    EXPECT_THAT(report.errors, HasSubstr(line));
    const ProgramRun progress = with({"--progress", "json"});
    EXPECT_THAT(progress.output, ::testing::EndsWith("{\"phase\":\"done\",\"share\":1.0000}\n"));
    EXPECT_THAT(progress.output, ::testing::Not(HasSubstr(line)));
    EXPECT_THAT(progress.errors, HasSubstr(line));
    EXPECT_EQ(with({"--quiet"}).output, "");
  }
}

TEST_F(Shard, IsNotMadeTwice) {
  const std::string input = lakes();
  const auto words = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all{"mesh", input, "--shard", "2/3", "-o", shardFile(2), "--report", file("r.json")};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const ProgramRun first = runProgram(words({"--skip-existing"}));
  writeText(file("r.json"), "precious");
  const ProgramRun second = runProgram(words({"--skip-existing"}));
  EXPECT_EQ(second.code, first.code);
  EXPECT_THAT(second.output, HasSubstr("exist already"));
  EXPECT_EQ(readText(file("r.json")), "precious");
  // One of its files is missing: all are made again.
  std::filesystem::remove(file("r.json"));
  EXPECT_EQ(runProgram(words({"--skip-existing"})).code, first.code);
  EXPECT_NE(readText(file("r.json")), "precious");
  // The existing file belongs to another run.
  expectRefused(words({"--skip-existing", "--min-angle", "20"}), 2, "to another run");
  expectRefused(words({}), 4, "exists already");
}

// As left by a full disk, or by a version that wrote in place.
TEST_F(Shard, ThatIsDamagedIsMadeAgain) {
  const std::string input = lakes();
  const std::vector<std::string> words{"mesh", input, "--shard", "2/3", "-o", shardFile(2), "--skip-existing"};
  const int code = runProgram(words).code;
  const auto expectWhole = [&] {
    const ProgramRun run = runProgram(words);
    EXPECT_EQ(run.code, code);
    EXPECT_EQ(run.errors, "");
    EXPECT_THAT(run.output, HasSubstr("exist already"));
  };
  expectWhole();
  const std::string whole = readText(shardFile(2));
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 4);
  for (const std::string& damaged : {whole.substr(0, whole.size() - 1), whole.substr(0, whole.size() / 2),
                                     whole.substr(0, 40), whole.substr(0, 7), flipped}) {
    writeText(shardFile(2), damaged);
    const ProgramRun run = runProgram(words);
    EXPECT_EQ(run.code, code) << run.errors;
    EXPECT_THAT(run.errors, HasSubstr("s2.shard' is damaged, or not whole: it is made again"));
    expectWhole();
  }
  writeText(shardFile(2), "");
  EXPECT_EQ(runProgram(words).code, code);
  expectWhole();
  // A file that is not a shard is never replaced.
  for (const std::string other : {"precious", "{}", "coastmesh is"}) {
    writeText(shardFile(2), other);
    expectRefused(words, 3, "was not written by mesh --shard");
    EXPECT_EQ(readText(shardFile(2)), other);
  }
}

// A shard killed midway leaves no file that could pass for a shard, and the same command makes it.
TEST_F(Shard, KilledIsRunAgain) {
  const std::string input = lakes();
  runShards(input, 3, {});
  std::filesystem::remove(shardFile(2));
  const std::vector<std::string> words{"mesh",       input, "--shard", "2/3", "-o", shardFile(2), "--skip-existing",
                                       "--progress", "json"};
  std::vector<std::string> longer = words;
  longer.insert(longer.end(), {"--size", "2"});  // long enough to be killed in it
  const ProgramRun killed =
      runUntilSignalled(longer, std::string("\"refine\""), SIGKILL, [&] { std::filesystem::remove(shardFile(2)); });
  ASSERT_EQ(killed.code, 128 + SIGKILL) << killed.output;
  EXPECT_EQ(names().count("s2.shard"), 0u);
  EXPECT_LE(runProgram(words).code, 1);
  ASSERT_EQ(runProgram({"mesh", input, "-o", file("w.nc"), "--quiet"}).code, 1);
  ASSERT_EQ(runProgram(gather(3, {"-o", file("g.nc"), "--quiet"})).code, 1);
  EXPECT_TRUE(readText(file("w.nc")) == readText(file("g.nc")));
}

// A skipped shard returns the exit code of its run, for scripts that run it again.
TEST_F(Shard, ThatIsSkippedHasTheCodeOfItsRun) {
  const std::string input = lakes();
  const std::vector<int> first = runShards(input, 3, {"--skip-existing"}),
                         second = runShards(input, 3, {"--skip-existing"});
  EXPECT_EQ(first, second);
  EXPECT_EQ(std::ranges::count(first, 1), 1);
  EXPECT_EQ(std::ranges::count(first, 0), 2);
}

TEST_F(Shard, WhatDoesNotGoTogetherIsRefused) {
  const std::string input = lakes();
  runShards(input, 3, {});
  const std::vector<std::string> out{"-o", file("g.nc")};
  const auto with = [&](std::vector<std::string> shards) {
    shards.insert(shards.begin(), "gather");
    shards.insert(shards.end(), out.begin(), out.end());
    return shards;
  };
  expectRefused(with({shardFile(1), shardFile(3)}), 3, "missing: 2/3");
  expectRefused(with({shardFile(1), shardFile(2), shardFile(2), shardFile(3)}), 3, "give it once");
  const ProgramRun other =
      runProgram({"mesh", input, "--shard", "3/3", "-o", file("other.shard"), "--min-angle", "20", "--quiet"});
  expectRefused(with({shardFile(1), shardFile(2), file("other.shard")}), 3, "to another run");
  expectRefused(with({input}), 3, "was not written by mesh --shard");
  std::string bytes = readText(shardFile(3));
  for (const std::size_t size : {bytes.size() - 1, bytes.size() / 2, std::size_t{40}}) {
    writeText(file("cut.shard"), bytes.substr(0, size));
    expectRefused(with({shardFile(1), shardFile(2), file("cut.shard")}), 3, "cut.shard");
  }
  for (const std::size_t at : {bytes.size() - 1, bytes.size() * 2 / 3, bytes.size() / 2, bytes.size() / 3}) {
    std::string flipped = bytes;
    flipped[at] = static_cast<char>(flipped[at] ^ 4);
    writeText(file("flipped.shard"), flipped);
    expectRefused(with({shardFile(1), shardFile(2), file("flipped.shard")}), 3, "damaged");
  }
  expectRefused(gather(3, {"-o", input, "--overwrite", "--format", "geojson"}), 2, "input and output at once");
  expectRefused({"mesh", "-", "--shard", "1/2", "-o", file("a.shard")}, 2, "standard input");
  expectRefused({"mesh", "/dev/stdin", "--shard", "1/1", "-o", file("a.shard")}, 2, "standard input");
  expectRefused({"mesh", "/vsistdin/", "--shard", "1/1", "-o", file("a.shard")}, 2, "standard input");
  ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
  expectRefused({"mesh", file("pipe"), "--shard", "1/1", "-o", file("a.shard")}, 2, "other pipes");
  for (const std::string wrong : {"0/3", "4/3", "1", "1/", "/3", "1/3x", "-1/3", "1/9999999"})
    expectRefused({"mesh", input, "--shard=" + wrong, "-o", file("a.shard")}, 2, "--shard");
  // The input has changed since: a name, the CRS, all coordinates.
  const std::string text = readText(input);
  std::string renamed = text;
  renamed.replace(renamed.find("lake 3"), 6, "loch 3");
  const std::string in_nad83 = R"({"crs":{"type":"name","properties":{"name":"EPSG:4269"}},)" + text.substr(1);
  for (const std::string& changed : {renamed, in_nad83}) {
    writeText(input, changed);
    expectRefused(gather(3, out), 3, "another input");
  }
  lakes(0.25);
  expectRefused(gather(3, out), 3, "another input");
  EXPECT_EQ(names().count("g.nc"), 0u);
}

TEST_F(Shard, WhatIsNoRegularFileIsRefused) {
  const std::string input = lakes();
  std::filesystem::create_directory(file("d.shard"));
  ASSERT_EQ(mkfifo(file("p.shard").c_str(), 0600), 0);
  for (const auto& [name, why] :
       {std::pair{"d.shard", "d.shard' is a folder"}, {"p.shard", "p.shard' is not a regular"}}) {
    expectRefused({"gather", file(name), "-o", file("g.nc")}, 3, why);
    expectRefused({"mesh", input, "--shard", "1/1", "-o", file(name), "--skip-existing"}, 3, why);
  }
}

// The version is named before any checksum error, because another version may compute checksums differently.
TEST_F(Shard, OfAnotherVersionIsRefused) {
  const std::string input = lakes();
  runShards(input, 2, {});
  const std::string bytes = readText(shardFile(2));
  for (const std::string other : {"0.0.9", "12.10.11-rc1"}) {
    writeText(shardFile(2), withVersion(bytes, other));
    const std::string why =
        "s2.shard' was made by coastmesh " + other + ", this is " + programVersion() + ": make it again";
    expectRefused(gather(2, {"-o", file("g.nc")}), 3, why);
    expectRefused({"mesh", input, "--shard", "2/2", "-o", shardFile(2), "--skip-existing"}, 3, why);
  }
  EXPECT_EQ(names().count("g.nc"), 0u);
}

// Two processes started by a launcher would race for the file.
TEST_F(Shard, IsMadeByOneOfTheRanks) {
  const std::string input = lakes();
  const auto as = [&](int rank, const std::string& shard, const std::string& option) {
    return runShell("OMPI_COMM_WORLD_SIZE=2 OMPI_COMM_WORLD_RANK=" + std::to_string(rank) + " \"$0\" mesh '" + input +
                    "' --overwrite --quiet --shard=" + shard + " " + option);
  };
  for (const std::string& option : {"-o '" + shardFile(1) + "'", "--per-feature -o '" + file("l-{}.2dm") + "'"}) {
    const ProgramRun refused = as(1, "1/3", option);
    EXPECT_EQ(refused.code, 2) << refused.errors;
    EXPECT_TRUE(isOneErrorLine(refused.errors)) << refused.errors;
    EXPECT_THAT(refused.errors, HasSubstr("of 2 ranks it is rank 0 that makes it, this is rank 1"));
    EXPECT_EQ(as(0, "2/3", option).code, 2);
  }
  EXPECT_EQ(names(), std::set<std::string>{"lakes.geojson"});
  EXPECT_EQ(as(0, "1/3", "-o '" + shardFile(1) + "'").code, 0);
  EXPECT_EQ(as(1, "2/3", "-o '" + shardFile(2) + "'").code, 0);
  EXPECT_NE(as(0, "3/3", "-o '" + shardFile(3) + "'").code, 2);
}

TEST_F(Shard, MoreShardsThanLakes) {
  const std::string input = lakes();
  const std::vector<int> codes = runShards(input, 30, {});
  EXPECT_EQ(std::ranges::count(codes, 1), 1);  // because of the refused lake
  EXPECT_EQ(std::ranges::count(codes, 0), 29);
  ASSERT_EQ(runProgram({"mesh", input, "-o", file("w.nc"), "--quiet"}).code, 1);
  ASSERT_EQ(runProgram(gather(30, {"-o", file("g.nc"), "--quiet"})).code, 1);
  EXPECT_TRUE(readText(file("w.nc")) == readText(file("g.nc")));
  expectRefused({"mesh", input, "--shard", "30/30", "-o", file("a.nc")}, 3, "fewer groups");
}

}  // namespace

}  // namespace coastmesh::test
