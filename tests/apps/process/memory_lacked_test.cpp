#include "apps/process/memory_lacked.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>
#include <string>

#include "apps/cli/run_outputs.hpp"
#include "apps/process/interrupt.hpp"

namespace coastmesh {

namespace {

namespace fs = std::filesystem;

// A noted failure is never reset, so each test runs in a process of its own.
class MemoryLackedDeathTest : public testing::Test {
 protected:
  void SetUp() override {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    // The process that a death test starts inherits the variable, and has the same folder.
    constexpr const char* kOwner = "COASTMESH_MEMORY_LACKED_TEST";
    ::setenv(kOwner, std::to_string(::getpid()).c_str(), /*overwrite=*/0);
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = fs::path(testing::TempDir()) / ("memory_lacked_" + std::string(std::getenv(kOwner)) + name);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "out.txt") << "before";
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path() const { return (folder_ / "out.txt").string(); }
  std::string content() const {
    std::ifstream file(path());
    return {std::istreambuf_iterator<char>(file), {}};
  }

  fs::path folder_;
};

// Returns 0 if the output was moved into place, 3 if it was refused for lack of memory, 1 otherwise.
int commitAfter(const std::string& path, bool lacked) {
  Interrupt interrupt;
  RunOutputs outputs(true, {}, interrupt);
  outputs.addFile(path).write("after");
  if (lacked) noteMemoryLacked();
  try {
    outputs.commit();
  } catch (const std::bad_alloc&) {
    return memoryLackedForOutputs() ? 3 : 1;
  }
  noteMemoryLacked();  // too late to harm the output
  return memoryLacked() && !memoryLackedForOutputs() ? 0 : 1;
}

TEST_F(MemoryLackedDeathTest, NothingComesIntoPlaceAfterAnAllocationFailed) {
  EXPECT_EXIT(std::_Exit(commitAfter(path(), true)), testing::ExitedWithCode(3), "");
  EXPECT_EQ(content(), "before");
}

TEST_F(MemoryLackedDeathTest, AnAllocationThatFailsAfterwardsChangesNothing) {
  EXPECT_EXIT(std::_Exit(commitAfter(path(), false)), testing::ExitedWithCode(0), "");
  EXPECT_EQ(content(), "after");
}

// `check` without an output and `info`: the printed text is the result.
TEST_F(MemoryLackedDeathTest, ARunWithoutOutputsLacksItToItsEnd) {
  const auto run = [] {
    Interrupt interrupt;
    RunOutputs outputs(true, {}, interrupt);
    outputs.commit();
    noteMemoryLacked();
    return memoryLackedForOutputs() ? 3 : 1;
  };
  EXPECT_EXIT(std::_Exit(run()), testing::ExitedWithCode(3), "");
}

}  // namespace

}  // namespace coastmesh
