#include "gis/file/staged_files.hpp"

#include <fcntl.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <ranges>
#include <string_view>
#include <utility>
#include <vector>

#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/file/leftovers.hpp"
#include "gis/file/remove_folder.hpp"
#include "gis/file/staging_names.hpp"
#include "gis/lower_case.hpp"
#include "gis/mesh_layers.hpp"

namespace coastmesh {
namespace {

namespace fs = std::filesystem;

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

// GeoPackages often hold all layers of a project: checks that replacing one would take away no layer but our own.
void requireNoOtherLayers(const fs::path& path) {
  if (lowerCase(path.extension().string()) != ".gpkg" || !isThere(path)) return;
  registerDrivers();
  const OgrErrors ignored;  // what is no GeoPackage holds no layer
  const char* const drivers[] = {"GPKG", nullptr};
  const std::unique_ptr<GDALDataset> dataset(
      GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_RASTER | GDAL_OF_READONLY, drivers));
  if (!dataset) return;
  std::string others;
  for (OGRLayer* const layer : dataset->GetLayers()) {
    if (!isOwnLayer(layer->GetName())) others += (others.empty() ? "" : ", ") + std::string(layer->GetName());
  }
  if (dataset->GetRasterCount() > 0 || dataset->GetMetadata("SUBDATASETS") != nullptr)
    others += (others.empty() ? "" : ", ") + std::string("rasters");
  if (others.empty()) return;
  constexpr std::size_t kShown = 80;
  throw OutputError(quoted(path) + " holds other layers (" + oneLine(others, kShown) +
                    "), which replacing it would delete: give the output another name, or remove the file");
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
// `errorOfFlushing`.
void beginToFlush([[maybe_unused]] const fs::path& path) {
#ifdef SYNC_FILE_RANGE_WRITE
  const int handle = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (handle < 0) return;
  ::sync_file_range(handle, 0, 0, SYNC_FILE_RANGE_WRITE);
  ::close(handle);
#endif
}

// Waits until a file, or the entries of a folder, are on disk: some systems report a full disk only then. Returns the
// system's error, 0 if there is none.
int errorOfFlushing(const fs::path& path) {
  const int handle = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (handle < 0) return errno;
  const int failure = ::fsync(handle) == 0 ? 0 : errno;
  ::close(handle);
  return failure == EINVAL ? 0 : failure;
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

  const std::set<fs::path>& folders() const { return folders_; }

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

void flushFolders(std::span<const Moves> moves) {
  std::set<fs::path> folders;
  for (const Moves& some : moves) folders.insert(some.folders().begin(), some.folders().end());
  for (const fs::path& folder : folders) {
    if (::access(folder.c_str(), R_OK) != 0) continue;
    if (const int failure = errorOfFlushing(folder); failure != 0) failToWrite(folder, std::strerror(failure));
  }
}

}  // namespace

StagedFiles::StagedFiles(std::string path, OutputFiles files, bool overwrite)
    : path_(std::move(path)), files_(std::move(files)), overwrite_(overwrite) {
  const fs::path target(path_);
  std::error_code error;
  if (!target.has_filename()) failToWrite(target, "it is a folder; name a file");
  const fs::path folder = folderOf(target);
  if (!fs::is_directory(folder, error)) failToWrite(target, "there is no folder " + quoted(folder));
  requireFree();
  for (const std::string& file : files_.targets) requireNoOtherLayers(file);
  std::string name = stagingPattern(path_);
  keepSpareDescriptor();
  if (::mkdtemp(name.data()) == nullptr) failToWrite(target, std::strerror(errno));
  staging_folder_ = std::move(name);  // without an allocation that may fail
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

template <typename Moves>
void StagedFiles::move(Moves& moves) const {
  const fs::path staging(staging_folder_), folder = folderOf(path_);
  const std::vector<fs::path> staged = filesIn(staging);  // sorted: a partition has two files per process
  std::vector<fs::path> old(files_.targets.begin(), files_.targets.end());
  old.insert(old.end(), files_.stale.begin(), files_.stale.end());
  if (!files_.prj.empty() && !std::ranges::count(old, fs::path(files_.prj))) old.emplace_back(files_.prj);
  const auto backupOf = [&](const fs::path& file) {
    std::string name = file.filename().string();
    return staging / name.append(kBackupEnding);
  };
  for (const fs::path& file : old) {
    const bool replaced = std::ranges::binary_search(staged, staging / file.filename());
    if (!replaced && !kept_.contains(file.string()) && !moves.placed(folder / file.filename()))
      moves.remove(folder / file.filename(), backupOf(file));
  }
  for (const fs::path& file : staged) {
    const fs::path target = folder / file.filename();
    // Another output of the run, such as a .msh beside this .2dm, may have written the same .prj.
    if (!moves.placed(target)) moves.replace(file, target, backupOf(file));
  }
}

void StagedFiles::commit() {
  StagedFiles* const self = this;
  commitTogether({&self, 1});
}

void syncToDisk(std::span<StagedFiles* const> outputs, const ItemLoop& loop) {
  std::vector<fs::path> files, targets;
  for (const StagedFiles* output : outputs) {
    assert(output->made_ && !output->staging_folder_.empty());
    output->requireFree();
    for (const fs::path& file : filesIn(output->staging_folder_)) {
      files.push_back(file);
      targets.push_back(folderOf(output->path_) / file.filename());
      requireReplaceable(targets.back(), output->overwrite_);
      beginToFlush(file);
    }
  }
  std::vector<int> failures(files.size());
  forItems(loop, files.size(), [&](std::size_t i) { failures[i] = errorOfFlushing(files[i]); });
  for (std::size_t i = 0; i < files.size(); ++i)
    if (failures[i] != 0) failToWrite(targets[i], std::strerror(failures[i]));
}

void moveInTurn(std::span<const std::vector<StagedFiles*>> groups) {
  const auto endOf = [&](std::size_t group) {  // all of it is in place
    for (StagedFiles* output : groups[group]) {
      removeFolder(output->staging_folder_.c_str());
      output->staging_folder_.clear();
    }
  };
  std::vector<Moves> moves(groups.size());
  std::size_t moved = 0;
  try {
    for (; moved < groups.size(); ++moved)
      for (const StagedFiles* output : groups[moved]) output->move(moves[moved]);
    flushFolders(moves);
  } catch (...) {
    if (moved == groups.size()) {
      for (Moves& some : std::views::reverse(moves)) some.undo();
    } else {
      moves[moved].undo();
      try {
        flushFolders({moves.data(), moved});
      } catch (const OutputError&) {
        // The first error is the one to report.
      }
      for (std::size_t group = 0; group < moved; ++group) endOf(group);
    }
    throw;
  }
  for (std::size_t group = 0; group < groups.size(); ++group) endOf(group);
}

void commitTogether(std::span<StagedFiles* const> outputs) {
  syncToDisk(outputs);
  const std::vector<StagedFiles*> group(outputs.begin(), outputs.end());
  moveInTurn({&group, 1});
}

}  // namespace coastmesh
