#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ranges>
#include <utility>

#include "gis/error.hpp"
#include "gis/grid_edit.hpp"
#include "gis/grid_formats.hpp"
#include "gis/grid_io.hpp"
#include "gis/prj_file.hpp"

namespace coastmesh {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBackupFolder = ".before";  // within the staging folder

fs::path folderOf(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

bool isThere(const fs::path& path) {
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

std::string quoted(const fs::path& path) {
  std::string text(1, '\'');
  text += path.string();
  text += '\'';
  return text;
}

[[noreturn]] void failToWrite(const fs::path& path, const std::string& why) {
  throw OutputError("cannot write " + quoted(path) + ": " + why);
}

[[noreturn]] void refuse(const fs::path& path) {
  throw OutputError(quoted(path) + " exists already; give --overwrite to replace it");
}

void replaceAll(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

std::vector<fs::path> filesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (!entry->is_directory()) files.push_back(entry->path());
  if (error) failToWrite(folder, error.message());
  std::ranges::sort(files);
  return files;
}

bool sameBytes(const fs::path& a, const fs::path& b) {
  std::ifstream first(a, std::ios::binary), second(b, std::ios::binary);
  using Bytes = std::istreambuf_iterator<char>;
  return first && second && std::equal(Bytes(first), Bytes(), Bytes(second), Bytes());
}

// Waits until the file is on the disk: some systems tell only then that it is full.
void flushToDisk(const fs::path& file, const fs::path& target) {
  const int handle = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (handle < 0) failToWrite(target, std::strerror(errno));
  const int failure = ::fsync(handle) == 0 ? 0 : errno;
  ::close(handle);
  if (failure != 0 && failure != EINVAL) failToWrite(target, std::strerror(failure));
}

// Renames that can be taken back.
class Moves {
 public:
  void move(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::rename(from, to, error);
    if (error) {
      undo();
      failToWrite(to, error.message());
    }
    done_.emplace_back(from, to);
  }

 private:
  void undo() {
    std::error_code ignored;  // the first error is the one to tell
    for (const auto& [from, to] : std::views::reverse(done_)) fs::rename(to, from, ignored);
  }

  std::vector<std::pair<fs::path, fs::path>> done_;
};

}  // namespace

StagedOutput::StagedOutput(std::string path, const GridFormat& format, bool overwrite)
    : path_(std::move(path)), format_(&format), overwrite_(overwrite) {
  const fs::path target(path_);
  std::error_code error;
  if (!format.writable) failToWrite(target, "the format " + std::string(format.name) + " can only be read");
  if (!target.has_filename()) failToWrite(target, "it is a folder; name a file");
  const fs::path folder = folderOf(target);
  if (!fs::is_directory(folder, error)) failToWrite(target, "there is no folder " + quoted(folder));
  refuseExisting();
  fs::path pattern = folder / ".";
  pattern += target.filename();
  pattern += ".part-XXXXXX";
  std::string name = pattern.string();
  if (::mkdtemp(name.data()) == nullptr) failToWrite(target, std::strerror(errno));
  staging_folder_ = name;
}

StagedOutput::~StagedOutput() {
  if (staging_folder_.empty()) return;
  std::error_code ignored;  // a destructor cannot tell
  fs::remove_all(staging_folder_, ignored);
}

StagedOutput::StagedOutput(StagedOutput&& other) noexcept
    : path_(std::move(other.path_)),
      format_(other.format_),
      overwrite_(other.overwrite_),
      staging_folder_(std::exchange(other.staging_folder_, {})),
      keep_prj_(other.keep_prj_) {}

void StagedOutput::refuseExisting() const {
  std::error_code error;
  for (const std::string& target : filesOf(*format_, path_).targets) {
    if (fs::is_directory(target, error)) failToWrite(target, "it is a folder; name a file");
    if (!overwrite_ && isThere(target)) refuse(target);
  }
}

bool StagedOutput::keepsPrj(const Grid& grid) const {
  const fs::path prj = filesOf(*format_, path_).prj;
  if (prj.empty() || !isThere(prj)) return false;
  if (sameBytes(prj, fs::path(staging_folder_) / prj.filename())) return true;
  try {
    if (sameCrs(readPrjBeside(prj.string()), grid.crs)) return true;
  } catch (const InputError&) {
    // It says nothing that can be read, so not the grid's CRS either.
  }
  if (!overwrite_) refuse(prj);
  const fs::path shapefile = fs::path(prj).replace_extension(".shp");
  if (isThere(shapefile) && format_->name != "shp")
    failToWrite(path_, quoted(prj) + " belongs to " + quoted(shapefile) +
                           " and says another CRS than the mesh has; give the mesh another name");
  return false;
}

void StagedOutput::write(const Grid& grid) {
  assert(!staging_folder_.empty());
  if (grid.triangles.empty()) failToWrite(path_, "the mesh has no triangles");
  requireConsistent(grid);
  const fs::path staging(staging_folder_);
  std::error_code error;
  for (const fs::path& earlier : filesIn(staging)) {
    fs::remove(earlier, error);
    if (error) failToWrite(earlier, error.message());
  }
  try {
    functionsOf(*format_).write(grid, (staging / fs::path(path_).filename()).string());
  } catch (const OutputError& failure) {
    std::string text = failure.what();
    replaceAll(text, staging_folder_, folderOf(path_).string());
    throw OutputError(text);
  }
  keep_prj_ = keepsPrj(grid);
  if (keep_prj_) fs::remove(staging / fs::path(filesOf(*format_, path_).prj).filename(), error);
  if (error) failToWrite(path_, error.message());
}

void StagedOutput::commit() {
  assert(!staging_folder_.empty());
  const fs::path staging(staging_folder_), folder = folderOf(path_);
  const OutputFiles files = filesOf(*format_, path_);
  std::error_code error;
  // Another output of the same run, a .msh beside this .2dm say, may have brought the .prj since `write`.
  if (const fs::path prj(files.prj); !keep_prj_ && sameBytes(prj, staging / prj.filename())) {
    keep_prj_ = fs::remove(staging / prj.filename(), error);
  }
  const std::vector<fs::path> staged = filesIn(staging);
  assert(!staged.empty());
  for (const fs::path& file : staged) {
    const fs::path target = folder / file.filename();
    if (!overwrite_ && isThere(target)) refuse(target);
    flushToDisk(file, target);
  }
  refuseExisting();

  std::vector<fs::path> before;
  if (staged.size() > 1)
    before.assign(files.targets.begin(), files.targets.end());  // a single file is replaced at once
  before.insert(before.end(), files.stale.begin(), files.stale.end());
  if (!files.prj.empty() && !std::ranges::count(before, fs::path(files.prj))) before.emplace_back(files.prj);
  if (keep_prj_) std::erase(before, fs::path(files.prj));
  fs::create_directory(staging / kBackupFolder, error);
  if (error) failToWrite(path_, error.message());
  Moves moves;
  for (const fs::path& old : before)
    if (isThere(old)) moves.move(old, staging / kBackupFolder / old.filename());
  for (const fs::path& file : staged) moves.move(file, folder / file.filename());
  fs::remove_all(staging, error);
  staging_folder_.clear();
}

}  // namespace coastmesh
