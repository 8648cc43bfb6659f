#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <future>
#include <nlohmann/json.hpp>
#include <tuple>

#include "parallel/byte_hash.hpp"
#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

constexpr int kKilled = 128 + SIGKILL;

// Identifies the file that has this name now; zeros if there is none.
std::tuple<ino_t, time_t, long> fileAt(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return {0, 0, 0};
  return {status.st_ino, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

class Checkpoint : public ProgramTest {
 protected:
  std::string kept(const std::string& name) const { return file("kept/" + name); }

  // A lake that is cut into pieces, and one that is not.
  std::string lakes() const {
    const LonLatRing shore{{-87.50, 41.600}, {-87.49, 41.598}, {-87.478, 41.601}, {-87.475, 41.61},
                           {-87.48, 41.617}, {-87.49, 41.619}, {-87.501, 41.614}};
    const LonLatRing pond{{-87.47, 41.600}, {-87.4699, 41.600}, {-87.4699, 41.6001}};
    return write("lakes.geojson", geoJsonPolygons({{pond}, {shore}}));
  }
  std::vector<std::string> command(const std::string& input, std::vector<std::string> further = {}) const {
    std::vector<std::string> words{
        "mesh",       input, "--size-max",  "9",  "--min-angle",  "33",       "--progress",   "json",         "-o",
        file("x.nc"), "-o",  file("x.2dm"), "-o", file("x.gpkg"), "--report", file("x.json"), "--mark-pieces"};
    words.insert(words.end(), further.begin(), further.end());
    return words;
  }
  std::vector<std::string> keeping(const std::string& input, std::vector<std::string> further = {}) const {
    further.insert(further.begin(), {"--checkpoint", file("kept")});
    return command(input, further);
  }
  // The outputs of a run without a checkpoint; they are removed afterwards.
  std::vector<std::string> plainBytes(const std::string& input) const {
    const ProgramRun run = runProgram(command(input));
    EXPECT_EQ(run.code, 0) << run.errors;
    return takeBytes();
  }
  std::vector<std::string> takeBytes() const {
    std::vector<std::string> all;
    for (const char* name : {"x.nc", "x.2dm", "x.gpkg"}) all.push_back(readText(file(name)));
    for (const char* name : {"x.nc", "x.2dm", "x.gpkg"}) std::filesystem::remove(file(name));
    last_use_ = Json::parse(readText(file("x.json")))["checkpoint"];
    std::filesystem::remove(file("x.json"));
    return all;
  }
  std::uint64_t used(const char* key) const { return last_use_[key].get<std::uint64_t>(); }
  void expectSame(const std::vector<std::string>& bytes, const std::vector<std::string>& expected) const {
    ASSERT_EQ(bytes.size(), expected.size());
    for (std::size_t i = 0; i < bytes.size(); ++i) EXPECT_TRUE(bytes[i] == expected[i]) << i;
  }
  // Kills a run after its first round.
  void killInRounds(const std::string& input) const {
    const ProgramRun run = killWhen(input, [&] { return std::filesystem::exists(roundsFile()); });
    ASSERT_EQ(run.code, kKilled) << run.errors;
  }
  // Starts a run without a checkpoint folder and kills it as soon as `due` returns true.
  ProgramRun killWhen(const std::string& input, const std::function<bool()>& due) const {
    return runUntilSignalled(keeping(input), due, SIGKILL, [&] { removeAllMade(); });
  }
  ProgramRun stopInWriting(const std::string& input, int signal_number) const {
    return runUntilSignalled(keeping(input), std::string(R"("phase":"write")"), signal_number,
                             [&] { removeAllMade(); });
  }
  void removeAllMade() const {
    std::filesystem::remove_all(file("kept"));
    for (const char* name : {"x.nc", "x.2dm", "x.gpkg", "x.json"}) std::filesystem::remove(file(name));
  }
  // The rounds of the large lake.
  std::string roundsFile() const {
    return std::filesystem::exists(kept("rounds-0")) ? kept("rounds-0") : kept("rounds-1");
  }
  void expectRefused(const std::vector<std::string>& words, int code, const std::string& why) const {
    const ProgramRun run = runProgram(words);
    EXPECT_EQ(run.code, code) << run.errors;
    EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
    EXPECT_THAT(run.errors, HasSubstr(why));
  }

 private:
  mutable Json last_use_;
};

TEST_F(Checkpoint, ChangesNoByteAndLeavesNothing) {
  const std::string input = lakes();
  const std::vector<std::string> expected = plainBytes(input);
  EXPECT_EQ(used("rounds_kept"), 0u);
  const ProgramRun run = runProgram(keeping(input));
  EXPECT_EQ(run.code, 0) << run.errors;
  expectSame(takeBytes(), expected);
  EXPECT_GT(used("rounds_kept"), 3u);
  EXPECT_EQ(names(), (std::set<std::string>{"lakes.geojson", "x.prj"}));
}

// Each run is killed after one more round, until a run completes before that.
TEST_F(Checkpoint, KilledAgainAndAgainInRounds) {
  const std::string input = lakes();
  const std::vector<std::string> expected = plainBytes(input);
  constexpr int kEnough = 100, kMostTries = 10;
  int runs = 0;
  // On a busy machine a signal may come after several rounds.
  for (int tries = 0; tries < kMostTries && runs <= 2; ++tries) {
    removeAllMade();
    for (runs = 0; runs < kEnough; ++runs) {
      const auto before = fileAt(roundsFile());
      const auto aRoundMore = [&] {
        const auto now = fileAt(roundsFile());
        return now != before && now != decltype(now){};
      };
      const ProgramRun run = runAndSignal(keeping(input), aRoundMore, SIGKILL);
      if (run.code == 0) break;
      ASSERT_EQ(run.code, kKilled) << run.errors;
    }
  }
  EXPECT_GT(runs, 2);
  expectSame(takeBytes(), expected);
  EXPECT_GT(used("regions_gone_on") + used("groups_taken"), 0u);
  EXPECT_FALSE(std::filesystem::exists(file("kept")));
}

TEST_F(Checkpoint, KilledWhileTheMeshIsBeingKept) {
  const std::string input = lakes();
  const std::vector<std::string> expected = plainBytes(input);
  const auto unfinished = [&] {
    return std::filesystem::exists(kept("rounds-0")) && std::filesystem::exists(kept("rounds-0.new"));
  };
  const ProgramRun killed = killWhen(input, [&] {
    return unfinished() || (std::filesystem::exists(kept("rounds-1")) && std::filesystem::exists(kept("rounds-1.new")));
  });
  ASSERT_EQ(killed.code, kKilled) << killed.errors;
  EXPECT_EQ(runProgram(keeping(input)).code, 0);
  expectSame(takeBytes(), expected);
  EXPECT_GT(used("regions_gone_on") + used("groups_taken"), 0u);
}

TEST_F(Checkpoint, KilledWhileWriting) {
  const std::string input = lakes();
  const std::vector<std::string> expected = plainBytes(input);
  const ProgramRun killed = stopInWriting(input, SIGKILL);
  ASSERT_EQ(killed.code, kKilled) << killed.errors;
  EXPECT_FALSE(std::filesystem::exists(file("x.nc")));
  // The number of threads may differ.
  EXPECT_EQ(runProgram(keeping(input, {"--threads", "1"})).code, 0);
  expectSame(takeBytes(), expected);
  EXPECT_EQ(used("groups_taken"), 2u);
  EXPECT_EQ(used("rounds_kept"), 0u);
}

// What a killed run leaves beside its outputs is removed by the next one, and nothing else is.
TEST_F(Checkpoint, RemovesWhatAKilledRunLeft) {
  const std::string input = lakes();
  const auto left = [&] {
    const std::set<std::string> all = names();
    return std::ranges::count_if(all, [](const std::string& name) { return name.find(".part-") != name.npos; });
  };
  ASSERT_EQ(stopInWriting(input, SIGKILL).code, kKilled);
  ASSERT_EQ(left(), 4);  // three meshes and a report
  std::filesystem::create_directory(file(".x.nc.part-abcdef"));
  // Killed again, in whatever stage.
  const ProgramRun killed = runAndSignal(keeping(input), std::string(R"("phase")"), SIGKILL);
  ASSERT_EQ(killed.code, kKilled) << killed.errors;
  EXPECT_EQ(left(), 5);
  EXPECT_EQ(runProgram(keeping(input)).code, 0);
  EXPECT_EQ(left(), 1);
  EXPECT_TRUE(std::filesystem::exists(file(".x.nc.part-abcdef")));
}

// They are known by their names too, also without a checkpoint.
TEST_F(Checkpoint, RemovesByNamesWhatADamagedListDoesNotTell) {
  const std::string input = lakes();
  ASSERT_EQ(stopInWriting(input, SIGKILL).code, kKilled);
  std::filesystem::create_directory(file(".x.nc.part-abcdef"));
  writeText(kept("outputs"), "damaged");
  EXPECT_EQ(runProgram(keeping(input)).code, 0);
  EXPECT_EQ(std::ranges::count_if(names(), [](const std::string& name) { return name.find(".part-") != name.npos; }),
            1);
  EXPECT_FALSE(std::filesystem::exists(file("kept")));
}

// A group that was being appended when the run was killed is meshed again.
TEST_F(Checkpoint, TakesTheGroupsThatAreWhole) {
  const std::string input = lakes();
  const std::vector<std::string> expected = plainBytes(input);
  ASSERT_EQ(stopInWriting(input, SIGKILL).code, kKilled);
  const std::string whole = readText(kept("groups"));
  for (const std::size_t less : {std::size_t{1}, whole.size() / 2, whole.size() - 5}) {
    std::filesystem::copy(file("kept"), file("copy"));
    std::filesystem::resize_file(kept("groups"), whole.size() - less);
    EXPECT_EQ(runProgram(keeping(input)).code, 0);
    expectSame(takeBytes(), expected);
    EXPECT_LT(used("groups_taken"), 2u) << less;
    std::filesystem::rename(file("copy"), file("kept"));
  }
}

TEST_F(Checkpoint, AnInterruptedRunGoesOn) {
  const std::string input = lakes();
  const std::vector<std::string> expected = plainBytes(input);
  EXPECT_EQ(stopInWriting(input, SIGTERM).code, 5);
  EXPECT_TRUE(std::filesystem::exists(kept("run")));
  EXPECT_EQ(runProgram(keeping(input)).code, 0);
  expectSame(takeBytes(), expected);
  EXPECT_EQ(used("groups_taken"), 2u);
}

TEST_F(Checkpoint, IsOfOneCommandAndInput) {
  const std::string input = lakes();
  writeText(file("lakes.geojson.aux.xml"), "<PAMDataset/>");
  killInRounds(input);
  expectRefused(keeping(input, {"--no-coarsen"}), 2, "was begun with another --coarsen: remove the folder '");
  expectRefused(keeping(input, {"--shard", "1/2"}), 2, "was begun with another --shard");
  expectRefused(keeping(lake()), 2, "was begun with another INPUT");
  // Sidecar files of the input count too.
  writeText(file("lakes.geojson.aux.xml"), "<PAMDataset></PAMDataset>");
  expectRefused(keeping(input), 3, "lakes.geojson.aux.xml' has changed since");
  const std::string text = readText(input);
  writeText(input, text + "\n");
  expectRefused(keeping(input), 3, "lakes.geojson' has changed since");
  EXPECT_TRUE(std::filesystem::exists(kept("run")));
}

TEST_F(Checkpoint, OfAnotherVersionIsRefused) {
  const std::string input = lakes();
  killInRounds(input);
  const std::string whole = readText(kept("run"));
  for (const std::string other : {"0.0.9", "12.10.11-rc1"}) {
    std::string bytes = withVersion(whole, other);
    bytes.resize(bytes.size() - sizeof(std::uint64_t));
    ByteHash hash;
    hash.add(bytes);
    const std::uint64_t sum = hash.value();
    bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
    writeText(kept("run"), bytes);
    expectRefused(keeping(input), 2,
                  "kept: was begun by coastmesh " + other + ", this is " + programVersion() + ": remove the folder '");
  }
  // The refusals have not damaged the checkpoint.
  writeText(kept("run"), whole);
  EXPECT_EQ(runProgram(keeping(input)).code, 0);
  takeBytes();
  EXPECT_GT(used("regions_gone_on") + used("groups_taken"), 0u);
}

TEST_F(Checkpoint, WhatIsDamagedIsNotGoneOnFrom) {
  const std::string input = lakes();
  killInRounds(input);
  for (const std::string& name : {std::string("run"), std::filesystem::path(roundsFile()).filename().string()}) {
    const std::string whole = readText(kept(name));
    std::string damaged = whole;
    damaged[whole.size() / 2] ^= 4;
    writeText(kept(name), damaged);
    expectRefused(keeping(input), 3, name + "' is damaged: remove the folder '");
    writeText(kept(name), whole);
  }
}

TEST_F(Checkpoint, TheFolderIsItsOwn) {
  const std::string input = lake();
  std::filesystem::create_directory(file("kept"));
  write("kept/precious", "text");
  expectRefused(keeping(input), 2, "there are other files in it");
  EXPECT_EQ(readText(kept("precious")), "text");
  std::filesystem::remove(kept("precious"));
  // An existing empty folder is accepted.
  EXPECT_EQ(runProgram(keeping(input)).code, 0);
  write("text", "text");
  expectRefused(command(input, {"--overwrite", "--checkpoint", file("text")}), 2, "is not a folder");
  expectRefused(command(input, {"--overwrite", "--checkpoint", file("no/kept")}), 4, "cannot be made");
}

// Of a file of options the options count: the number of threads may change, and they may be typed instead.
TEST_F(Checkpoint, GoesOnAfterTheFileOfOptionsHasChanged) {
  const std::string input = lakes();
  const auto writeOptions = [&](const std::string& threads) {
    return write("job.toml", "input = \"" + input + "\"\noutput = \"" + file("x.nc") + "\"\ncheckpoint = \"" +
                                 file("kept") + "\"\nsize-max = 9\nthreads = " + threads + "\n");
  };
  const std::vector<std::string> from_file{"mesh", "--config", file("job.toml"), "--progress", "json"};
  const std::vector<std::string> typed{"mesh",       input, "-o",           file("x.nc"),
                                       "--size-max", "9",   "--checkpoint", file("kept")};
  const std::function<bool()> in_rounds = [&] { return std::filesystem::exists(roundsFile()); };
  for (const bool is_typed : {false, true}) {
    writeOptions("1");
    ASSERT_EQ(runUntilSignalled(from_file, in_rounds, SIGKILL, [&] { removeAllMade(); }).code, kKilled);
    writeOptions("2");
    const ProgramRun run = runProgram(is_typed ? typed : from_file);
    EXPECT_EQ(run.code, 0) << run.errors;
    removeAllMade();
  }
}

TEST_F(Checkpoint, BelongsToOneRunAtATime) {
  const std::string input = lakes();
  killInRounds(input);
  const int lock = open(kept("coastmesh.lock").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_GE(lock, 0);
  ASSERT_EQ(flock(lock, LOCK_EX | LOCK_NB), 0);
  expectRefused(keeping(input), 2, "another run is using it");
  close(lock);
  EXPECT_EQ(runProgram(keeping(input)).code, 0);
}

// The run that holds the lock removes the folder when it is done.
TEST_F(Checkpoint, BeginsAnewWhereTheRunBeforeIsDoneMeanwhile) {
  const std::string input = lake();
  std::filesystem::create_directory(file("kept"));
  const int lock = open(kept("coastmesh.lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  ASSERT_GE(lock, 0);
  ASSERT_EQ(flock(lock, LOCK_EX | LOCK_NB), 0);
  std::future<ProgramRun> waiting = std::async(std::launch::async, [&] { return runProgram(keeping(input)); });
  EXPECT_EQ(waiting.wait_for(std::chrono::seconds(1)), std::future_status::timeout);
  std::filesystem::remove_all(file("kept"));
  close(lock);
  const ProgramRun run = waiting.get();
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_FALSE(std::filesystem::exists(file("kept")));
}

TEST_F(Checkpoint, TheFolderIsNoInputAndNoOutput) {
  const std::string input = lake();
  for (const std::string folder : {"r.nc", "r.nc/", "r.json", "./r.nc"}) {
    expectRefused({"mesh", input, "-o", file("r.nc"), "--report", file("r.json"), "--checkpoint", file(folder)}, 2,
                  "would both write");
  }
  expectRefused({"mesh", input, "-o", file("r.nc"), "--checkpoint", input}, 2, "is input and output at once");
  EXPECT_EQ(names(), std::set<std::string>{"lake.geojson"});
}

TEST_F(Checkpoint, AFailureBeforeAnythingIsKeptLeavesNoFolder) {
  expectRefused(keeping(file("nothing.geojson")), 3, "nothing.geojson");
  EXPECT_TRUE(names().empty());
  const ProgramRun piped = runShell("\"$0\" mesh - -o " + file("x.nc") + " --checkpoint " + file("kept"));
  EXPECT_EQ(piped.code, 2) << piped.errors;
  EXPECT_THAT(piped.errors, HasSubstr("standard input"));
  // Standard input under its other name, a named pipe, and pipes for other inputs.
  ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
  for (const std::string& words : {std::string("/dev/stdin"), file("pipe"), lake() + " --constraints -",
                                   lake() + " --size-features " + file("pipe")}) {
    const ProgramRun run = runShell("\"$0\" mesh " + words + " -o " + file("x.nc") + " --checkpoint " + file("kept"));
    EXPECT_EQ(run.code, 2) << words << run.errors;
    EXPECT_THAT(run.errors, HasSubstr("other pipes")) << words;
    EXPECT_FALSE(std::filesystem::exists(kept(""))) << words;
  }
  expectRefused({"mesh", lake(), "--per-feature", "-o", file("l-{}.nc"), "--checkpoint", file("kept")}, 2,
                "--skip-existing");
}

// A resumed shard is the same too.
TEST_F(Checkpoint, OfAShard) {
  const std::string input = lakes();
  const auto words = [&](const std::string& out) {
    return std::vector<std::string>{"mesh",    input, "--size-max",   "9",          "-o",         out,
                                    "--shard", "1/1", "--checkpoint", file("kept"), "--progress", "json"};
  };
  const std::function<bool()> in_rounds = [&] { return std::filesystem::exists(roundsFile()); };
  const auto removeShard = [&] { std::filesystem::remove(file("a.shard")); };
  ASSERT_EQ(runUntilSignalled(words(file("a.shard")), in_rounds, SIGKILL, removeShard).code, kKilled);
  EXPECT_EQ(runProgram(words(file("a.shard"))).code, 0);
  EXPECT_EQ(runProgram({"gather", file("a.shard"), "-o", file("g.nc")}).code, 0);
  EXPECT_EQ(runProgram({"mesh", input, "--size-max", "9", "-o", file("m.nc")}).code, 0);
  EXPECT_TRUE(readText(file("g.nc")) == readText(file("m.nc")));
}

}  // namespace

}  // namespace coastmesh::test
