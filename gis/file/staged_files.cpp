#include "gis/file/staged_files.hpp"

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
#include <vector>

#include "gis/error.hpp"
#include "gis/file/remove_folder.hpp"

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

void replaceAll(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

// Checks that a file may be created at `path`. A link is rejected: replacing it would break it, and writing through it
// would change a file that nobody named, perhaps on a disk without room for staging.
void requireReplaceable(const fs::path& path, bool overwrite) {
  std::error_code error;
  switch (fs::symlink_status(path, error).type()) {
    case fs::file_type::not_found:
      return;
    case fs::file_type::regular:
      if (!overwrite) throw OutputError(quoted(path) + " exists already; give --overwrite to replace it");
      return;
    case fs::file_type::directory:
      failToWrite(path, "it is a folder; name a file");
    case fs::file_type::symlink:
      failToWrite(path, "it is a link to " + quoted(fs::read_symlink(path, error)) +
                            "; name the file itself, or remove the link");
    case fs::file_type::none:
      failToWrite(path, error.message());
    default:
      failToWrite(path, "it is a device or a pipe, no regular file; name a file");
  }
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

// Starts writing a file to disk, if the system can: several started together finish sooner. Errors are left to
// `flushToDisk`.
void beginToFlush([[maybe_unused]] const fs::path& path) {
#ifdef SYNC_FILE_RANGE_WRITE
  const int handle = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (handle < 0) return;
  ::sync_file_range(handle, 0, 0, SYNC_FILE_RANGE_WRITE);
  ::close(handle);
#endif
}

// Waits until a file, or the entries of a folder, are on disk: some systems report a full disk only then.
void flushToDisk(const fs::path& path, const fs::path& target) {
  const int handle = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (handle < 0) failToWrite(target, std::strerror(errno));
  const int failure = ::fsync(handle) == 0 ? 0 : errno;
  ::close(handle);
  if (failure != 0 && failure != EINVAL) failToWrite(target, std::strerror(failure));
}

// Renames that can be undone.
class Moves {
 public:
  // Moves the file at `target`, if any, to `backup`.
  void remove(const fs::path& target, const fs::path& backup) {
    if (isThere(target)) rename(target, backup, target);
  }

  // Replaces the file at `target` by `from`, atomically if the file system has hard links.
  void replace(const fs::path& from, const fs::path& target, const fs::path& backup) {
    if (isThere(target)) {
      requireReplaceable(target, true);
      if (::link(target.c_str(), backup.c_str()) == 0) {
        done_.emplace_back(target, backup);
      } else {
        rename(target, backup, target);
      }
    }
    rename(from, target, target);
    placed_.insert(target);
    folders_.insert(folderOf(target));
  }

  bool placed(const fs::path& target) const { return placed_.contains(target); }

  void flushFolders() const {
    for (const fs::path& folder : folders_)
      if (::access(folder.c_str(), R_OK) == 0) flushToDisk(folder, folder);
  }

  void undo() {
    std::error_code ignored;  // the first error is the one to report
    for (const auto& [from, to] : std::views::reverse(done_)) fs::rename(to, from, ignored);
    done_.clear();
  }

 private:
  void rename(const fs::path& from, const fs::path& to, const fs::path& target) {
    done_.emplace_back(from, to);  // first: a rename without a record could not be undone
    std::error_code error;
    fs::rename(from, to, error);
    if (!error) return;
    done_.pop_back();
    failToWrite(target, error.message());
  }

  std::vector<std::pair<fs::path, fs::path>> done_;
  std::set<fs::path> placed_, folders_;
};

}  // namespace

StagedFiles::StagedFiles(std::string path, OutputFiles files, bool overwrite)
    : path_(std::move(path)), files_(std::move(files)), overwrite_(overwrite) {
  const fs::path target(path_);
  std::error_code error;
  if (!target.has_filename()) failToWrite(target, "it is a folder; name a file");
  const fs::path folder = folderOf(target);
  if (!fs::is_directory(folder, error)) failToWrite(target, "there is no folder " + quoted(folder));
  requireFree();
  fs::path pattern = folder / ".";
  pattern += target.filename();
  pattern += ".part-XXXXXX";
  std::string name = pattern.string();
  keepSpareDescriptor();
  if (::mkdtemp(name.data()) == nullptr) failToWrite(target, std::strerror(errno));
  staging_folder_ = name;
}

StagedFiles::~StagedFiles() {
  if (!staging_folder_.empty()) removeFolder(staging_folder_.c_str());  // a destructor cannot report
}

StagedFiles::StagedFiles(StagedFiles&& other) noexcept
    : path_(std::move(other.path_)),
      files_(std::move(other.files_)),
      overwrite_(other.overwrite_),
      made_(other.made_),
      kept_(std::move(other.kept_)),
      staging_folder_(std::exchange(other.staging_folder_, {})) {}

void StagedFiles::requireFree() const {
  for (const std::string& target : files_.targets) requireReplaceable(target, overwrite_);
}

void StagedFiles::make(const std::function<void(const std::string& path)>& writer) {
  assert(!staging_folder_.empty());
  const fs::path staging(staging_folder_);
  std::error_code error;
  for (const fs::path& earlier : filesIn(staging)) {
    fs::remove(earlier, error);
    if (error) failToWrite(earlier, error.message());
  }
  kept_.clear();
  made_ = false;
  try {
    writer((staging / fs::path(path_).filename()).string());
  } catch (const OutputError& failure) {
    std::string text = failure.what();
    replaceAll(text, staging_folder_, folderOf(path_).string());
    throw OutputError(text);
  }
  made_ = true;
}

void StagedFiles::write(std::string_view content) {
  make([content](const std::string& path) {
    std::ofstream file(path, std::ios::binary);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    file.close();
    if (!file) failToWrite(path, std::strerror(errno));
  });
}

void StagedFiles::keep(const std::string& target) {
  std::error_code error;
  fs::remove(fs::path(staging_folder_) / fs::path(target).filename(), error);
  if (error) failToWrite(path_, error.message());
  kept_.insert(target);
}

void StagedFiles::checkAndFlush() const {
  assert(made_ && !staging_folder_.empty());
  requireFree();
  for (const fs::path& file : filesIn(staging_folder_)) {
    const fs::path target = folderOf(path_) / file.filename();
    requireReplaceable(target, overwrite_);
    flushToDisk(file, target);
  }
}

template <typename Moves>
void StagedFiles::move(Moves& moves) const {
  const fs::path staging(staging_folder_), folder = folderOf(path_), backups = staging / kBackupFolder;
  std::error_code error;
  const std::vector<fs::path> staged = filesIn(staging);  // sorted: a partition has two files per process
  fs::create_directory(backups, error);
  if (error) failToWrite(path_, error.message());
  std::vector<fs::path> old(files_.targets.begin(), files_.targets.end());
  old.insert(old.end(), files_.stale.begin(), files_.stale.end());
  if (!files_.prj.empty() && !std::ranges::count(old, fs::path(files_.prj))) old.emplace_back(files_.prj);
  for (const fs::path& file : old) {
    const bool replaced = std::ranges::binary_search(staged, staging / file.filename());
    if (!replaced && !kept_.contains(file.string()) && !moves.placed(folder / file.filename()))
      moves.remove(folder / file.filename(), backups / file.filename());
  }
  for (const fs::path& file : staged) {
    const fs::path target = folder / file.filename();
    // Another output of the run, such as a .msh beside this .2dm, may have written the same .prj.
    if (!moves.placed(target)) moves.replace(file, target, backups / file.filename());
  }
}

void StagedFiles::commit() {
  StagedFiles* const self = this;
  commitTogether({&self, 1});
}

void commitTogether(std::span<StagedFiles* const> outputs) {
  for (const StagedFiles* output : outputs)
    for (const fs::path& file : filesIn(output->staging_folder_)) beginToFlush(file);
  for (const StagedFiles* output : outputs) output->checkAndFlush();
  Moves moves;
  try {
    for (const StagedFiles* output : outputs) output->move(moves);
    moves.flushFolders();
  } catch (...) {
    moves.undo();
    throw;
  }
  for (StagedFiles* output : outputs) {
    removeFolder(output->staging_folder_.c_str());  // all is in place
    output->staging_folder_.clear();
  }
}

}  // namespace coastmesh
