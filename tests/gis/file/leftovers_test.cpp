#include "gis/file/leftovers.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "gis/file/staged_files.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

// A process that has made an output and not moved it into place.
class Writer {
 public:
  explicit Writer(const std::string& path) {
    int ready[2];
    EXPECT_EQ(::pipe(ready), 0);
    process_ = ::fork();
    if (process_ == 0) {
      StagedFiles output(path, true);
      output.write("half of it");
      if (::write(ready[1], "!", 1) != 1) ::_exit(1);
      for (;;) ::pause();
    }
    char made = 0;
    EXPECT_EQ(::read(ready[0], &made, 1), 1);
    for (const int end : ready) ::close(end);
  }
  ~Writer() { kill(); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  void kill() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = -1;
  }

 private:
  pid_t process_ = -1;
};

// The process in a folder's name.
struct Mark {
  std::string boot, number, start;
};

Mark own() {
  std::istringstream rest(
      fs::path(stagingPattern("lake.nc")).filename().string().substr(std::string(".lake.nc.part-").size()));
  Mark mark;
  std::getline(std::getline(std::getline(rest, mark.boot, '-'), mark.number, '-'), mark.start, '-');
  return mark;
}

// Of a process that had this one's number before.
Mark ended() {
  Mark mark = own();
  mark.start += "0";
  return mark;
}

class Leftovers : public ::testing::Test {
 protected:
  // A staging folder with a file in it.
  std::string put(const Mark& mark, const std::string& file = "lake.nc") const {
    const std::string name = ".lake.nc.part-" + mark.boot + "-" + mark.number + "-" + mark.start + "-a1B2c3";
    fs::create_directory(folder_ / name);
    std::ofstream(folder_ / name + "/" + file) << "half";
    return folder_ / name;
  }
  std::size_t count() const { return folder_.names().size(); }

  TemporaryFolder folder_;
};

TEST_F(Leftovers, AreRemovedWhenTheirProcessWasKilled) {
  Writer writer(folder_ / "lake.nc"), other(folder_ / "sea.nc");
  ASSERT_EQ(count(), 2u);
  removeLeftovers(folder_ / "");
  EXPECT_EQ(count(), 2u);
  writer.kill();
  removeLeftovers(folder_ / "");
  ASSERT_EQ(count(), 1u);
  EXPECT_TRUE(folder_.names().front().starts_with(".sea.nc.part-"));
}

TEST_F(Leftovers, ANumberThatAnotherProcessHasNowIsNoMatch) {
  const std::string left = put(ended()), running = put(own());
  removeLeftovers(folder_ / "");
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(running));
}

TEST_F(Leftovers, OfOtherMachinesAndOtherProgramsStay) {
  Mark elsewhere = ended();
  elsewhere.boot = std::string(elsewhere.boot.size(), elsewhere.boot.front() == '0' ? '1' : '0');
  put(elsewhere);
  for (const char* other : {".lake.nc.part-a1B2c3", ".x.part-1-2-3", ".part-", "lake.part-1-1-1-aaaaaa"})
    fs::create_directory(folder_ / other);
  removeLeftovers(folder_ / "");
  EXPECT_EQ(count(), 5u);
}

TEST_F(Leftovers, WithFilesThatWereBeingReplacedStay) {
  const std::string left = put(ended(), "lake.nc~");
  removeLeftovers(folder_ / "");
  EXPECT_TRUE(fs::exists(left));
}

TEST_F(Leftovers, LinksAndFilesStay) {
  const std::string left = put(ended());
  const std::string elsewhere = folder_ / "elsewhere";
  fs::rename(left, elsewhere);
  fs::create_directory_symlink(elsewhere, left);
  removeLeftovers(folder_ / "");
  EXPECT_TRUE(fs::is_symlink(left));
  EXPECT_TRUE(fs::exists(elsewhere + "/lake.nc"));
  fs::remove(left);
  std::ofstream{left} << "a file";
  removeLeftovers(folder_ / "");
  EXPECT_TRUE(fs::exists(left));
  removeLeftovers(folder_ / "nowhere");
}

TEST_F(Leftovers, LongNamesHaveNoProcess) {
  const std::string long_name(230, 'x');
  EXPECT_EQ(fs::path(stagingPattern(folder_ / long_name)).filename(), "." + long_name + ".part-XXXXXX");
  StagedFiles output(folder_ / long_name, true);
  output.write("all");
  output.commit();
  EXPECT_TRUE(fs::exists(folder_ / long_name));
}

}  // namespace
}  // namespace coastmesh
