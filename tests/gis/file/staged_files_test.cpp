// Several outputs that are moved into place one after another.
#include "gis/file/staged_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "gis/error.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

std::string textOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class StagedFilesTest : public ::testing::Test {
 protected:
  // Two outputs each, NAME.a and NAME.b.
  void addGroup(const std::string& name) {
    std::vector<StagedFiles*>& group = groups_.emplace_back();
    for (const char* ending : {".a", ".b"}) {
      outputs_.push_back(std::make_unique<StagedFiles>(folder_ / (name + ending), true));
      outputs_.back()->write("new");
      group.push_back(outputs_.back().get());
      all_.push_back(group.back());
    }
  }
  void put(const std::string& name) const { std::ofstream(folder_ / name) << "old"; }
  std::string errorOf(const std::function<void()>& act) const {
    try {
      act();
    } catch (const OutputError& error) {
      return error.what();
    }
    return "no error";
  }

  TemporaryFolder folder_;
  std::vector<std::unique_ptr<StagedFiles>> outputs_;
  std::vector<std::vector<StagedFiles*>> groups_;
  std::vector<StagedFiles*> all_;
};

TEST_F(StagedFilesTest, AllGroupsAppear) {
  put("two.a");
  for (const char* name : {"one", "two", "three"}) addGroup(name);
  syncToDisk(all_);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "one.a"));
  EXPECT_EQ(textOf(folder_ / "two.a"), "old");
  moveInTurn(groups_);
  EXPECT_THAT(folder_.names(), ElementsAre("one.a", "one.b", "three.a", "three.b", "two.a", "two.b"));
  for (const std::string& name : folder_.names()) EXPECT_EQ(textOf(folder_ / name), "new") << name;
}

TEST_F(StagedFilesTest, OfTheGroupThatFailsAndThoseAfterItNoneAppears) {
  for (const char* name : {"one.a", "two.a", "three.a"}) put(name);
  for (const char* name : {"one", "two", "three"}) addGroup(name);
  syncToDisk(all_);
  std::filesystem::create_directory(folder_ / "two.b");  // cannot be replaced
  EXPECT_THAT(errorOf([&] { moveInTurn(groups_); }), HasSubstr(folder_ / "two.b"));
  outputs_.clear();
  EXPECT_THAT(folder_.names(), ElementsAre("one.a", "one.b", "three.a", "two.a", "two.b"));
  EXPECT_EQ(textOf(folder_ / "one.a"), "new");
  EXPECT_EQ(textOf(folder_ / "one.b"), "new");
  EXPECT_EQ(textOf(folder_ / "two.a"), "old");
  EXPECT_EQ(textOf(folder_ / "three.a"), "old");
}

TEST_F(StagedFilesTest, NothingIsMovedIfAFileIsNotOnDisk) {
  for (const char* name : {"one", "two"}) addGroup(name);
  std::filesystem::create_directory(folder_ / "two.a");
  EXPECT_THAT(errorOf([&] { syncToDisk(all_); }), HasSubstr(folder_ / "two.a"));
  outputs_.clear();
  EXPECT_THAT(folder_.names(), ElementsAre("two.a"));
}

TEST_F(StagedFilesTest, EachFileIsSyncedOnceByAnyLoop) {
  for (const char* name : {"one", "two", "three"}) addGroup(name);
  std::size_t items = 0;
  syncToDisk(all_, [&](std::size_t count, const std::function<void(std::size_t)>& work) {
    for (std::size_t i = count; i-- > 0; ++items) work(i);
  });
  EXPECT_EQ(items, 6u);
  moveInTurn(groups_);
  EXPECT_EQ(folder_.names().size(), 6u);
}

}  // namespace
}  // namespace coastmesh
