#include "apps/cli/checkpoint_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <optional>
#include <system_error>
#include <thread>
#include <tuple>
#include <utility>

#include "apps/job/bytes.hpp"
#include "apps/job/group_bytes.hpp"
#include "apps/process/memory_lacked.hpp"
#include "gis/error.hpp"
#include "gis/file/remove_folder.hpp"
#include "parallel/byte_hash.hpp"

namespace coastmesh {

// Found by argument-dependent lookup from `pass`.
auto partsOf(auto& stamp) requires std::is_same_v<std::remove_cvref_t<decltype(stamp)>, FileStamp> {
  auto& [path, bytes, changed_ns] = stamp;
  return std::tie(path, bytes, changed_ns);
}
// All members but the version, which comes first.
auto partsOf(auto& header) requires std::is_same_v<std::remove_cvref_t<decltype(header)>, CheckpointHeader> {
  auto& [version, options, shard, shards, files, input_digest, groups] = header;
  return std::tie(options, shard, shards, files, input_digest, groups);
}

namespace {

namespace fs = std::filesystem;

constexpr const char *kLock = "coastmesh.lock", *kRun = "run", *kGroups = "groups", *kRounds = "rounds-",
                     *kOutputs = "outputs", *kUnfinished = ".new";

[[noreturn]] void failToKeep(const fs::path& path, int error) {
  throw OutputError("'" + path.string() + "' cannot be written: " + std::strerror(error));
}

// Buffers and hashes bytes that are written to a file.
class Output {
 public:
  Output(int file, std::uint64_t at, const fs::path& path) : file_(file), at_(at), path_(path) {}

  void put(std::string_view bytes) {
    hash_.add(bytes);
    write(bytes);
  }
  // Appends the hash of all bytes that were put.
  void end() {
    const std::uint64_t hash = hash_.value();
    write({reinterpret_cast<const char*>(&hash), sizeof hash});
    flush();
  }
  void waitForDisk() const {
    if (::fdatasync(file_) != 0 && errno != EINVAL) failToKeep(path_, errno);
  }
  std::uint64_t at() const { return at_ + waiting_.size(); }

 private:
  static constexpr std::size_t kMostWaiting = 1 << 20;

  void write(std::string_view bytes) {
    if (waiting_.size() + bytes.size() > kMostWaiting) flush();
    if (bytes.size() > kMostWaiting) {
      writeNow(bytes);
    } else {
      waiting_ += bytes;
    }
  }
  void flush() {
    writeNow(waiting_);
    waiting_.clear();
  }
  void writeNow(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(at_));
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) failToKeep(path_, written < 0 ? errno : ENOSPC);
      at_ += static_cast<std::uint64_t>(written);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  int file_;
  std::uint64_t at_;
  const fs::path& path_;
  std::string waiting_;
  ByteHash hash_;
};

// Maps a file into memory during its lifetime; empty if the file does not exist.
class MappedFile {
 public:
  explicit MappedFile(const fs::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) {
      if (errno == ENOENT) return;
      throw InputError("'" + path.string() + "' cannot be read: " + std::strerror(errno));
    }
    is_there_ = true;
    struct stat status {};
    const bool known = ::fstat(file, &status) == 0;
    size_ = known ? static_cast<std::size_t>(status.st_size) : 0;
    if (size_ > 0) start_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
    const int error = errno;
    ::close(file);
    if (!known || start_ == MAP_FAILED)
      throw InputError("'" + path.string() + "' cannot be read: " + std::strerror(error));
  }
  ~MappedFile() {
    if (start_ != nullptr) ::munmap(start_, size_);
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  bool isThere() const { return is_there_; }
  std::string_view bytes() const { return {static_cast<const char*>(start_), size_}; }

 private:
  bool is_there_ = false;
  void* start_ = nullptr;
  std::size_t size_ = 0;
};

// The bytes without the hash at their end; nullopt if that does not match.
std::optional<std::string_view> sound(std::string_view bytes) {
  std::uint64_t hash = 0;
  if (bytes.size() < sizeof hash) return std::nullopt;
  const std::string_view put = bytes.substr(0, bytes.size() - sizeof hash);
  std::memcpy(&hash, bytes.data() + put.size(), sizeof hash);
  ByteHash now;
  now.add(put);
  return now.value() == hash ? std::optional(put) : std::nullopt;
}

std::vector<std::string> namesIn(const fs::path& folder, std::error_code& error) {
  std::vector<std::string> names;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    names.push_back(entry->path().filename());
  return names;
}

// Precedes each group in the file of groups.
struct GroupMark {
  std::uint64_t group = 0, size = 0;
};
constexpr std::uint64_t kMarkBytes = 2 * sizeof(std::uint64_t), kHashBytes = sizeof(std::uint64_t);

}  // namespace

FileStamp stampOf(const std::string& path) {
  FileStamp stamp{path, 0, 0};
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return stamp;
  stamp.bytes = static_cast<std::uint64_t>(status.st_size);
  stamp.changed_ns = std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec;
  return stamp;
}

CheckpointFolder::CheckpointFolder(const std::string& folder, CheckpointHeader header)
    : folder_(folder), header_(std::move(header)) {
  std::error_code error;
  made_ = fs::create_directory(folder_, error);
  if (!made_ && !fs::is_directory(folder_)) {
    if (fs::exists(folder_)) throw OptionError("--checkpoint " + folder + ": is not a folder");
    throw OutputError("the folder '" + folder +
                      "' cannot be made: " + (error ? error.message() : std::strerror(ENOENT)));
  }
  const std::vector<std::string> names = namesIn(folder_, error);
  // Another run may just have removed it.
  if (error && error != std::errc::no_such_file_or_directory)
    throw OutputError("the folder '" + folder + "' cannot be listed: " + error.message());
  if (!names.empty() && std::ranges::find(names, kLock) == names.end())
    throw OptionError("--checkpoint " + folder + ": there are other files in it; name a folder that is empty or new");
  lock();
  try {
    const MappedFile run(folder_ / kRun);
    if (!run.isThere()) return;
    const std::optional<std::string_view> bytes = sound(run.bytes());
    if (!bytes) throw InputError("'" + (folder_ / kRun).string() + "' is damaged" + remedy());
    ByteReader reader(*bytes, "'" + (folder_ / kRun).string() + "'");
    CheckpointHeader kept;
    reader.pass(kept.version);
    if (kept.version != header_.version)
      throw OptionError("--checkpoint " + folder + ": was begun by coastmesh " + kept.version + ", this is " +
                        header_.version + remedy());
    reader.pass(kept);
    requireSameRun(kept);
    header_ = std::move(kept);
    begun_ = true;
  } catch (...) {
    ::close(lock_);
    throw;
  }
}

CheckpointFolder::~CheckpointFolder() {
  if (groups_ >= 0) ::close(groups_);
  if (lock_ < 0) return;
  if (begun_) {
    ::close(lock_);
  } else {
    remove(made_);
  }
}

// A killed process keeps its lock until all its memory is released, hence the retries.
void CheckpointFolder::lock() {
  constexpr int kTries = 200;
  constexpr auto kWait = std::chrono::milliseconds(50);
  const fs::path path = folder_ / kLock;
  for (int i = 0; i < kTries; ++i) {
    lock_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock_ < 0 && errno != ENOENT) failToKeep(path, errno);
    if (lock_ < 0) {
      // The previous run has finished and removed the folder: make it again.
      std::error_code error;
      made_ = fs::create_directory(folder_, error) || made_;
      if (error) failToKeep(folder_, error.value());
      continue;
    }
    const int error = ::flock(lock_, LOCK_EX | LOCK_NB) == 0 ? 0 : errno;
    struct stat ours {
    }, there{};
    // The previous owner may have removed the file when it finished.
    if (error == 0 && ::fstat(lock_, &ours) == 0 && ::stat(path.c_str(), &there) == 0 && ours.st_ino == there.st_ino)
      return;
    ::close(std::exchange(lock_, -1));
    if (error != 0 && error != EWOULDBLOCK) failToKeep(path, error);
    std::this_thread::sleep_for(kWait);
  }
  throw OptionError("--checkpoint " + folder_.string() + ": another run is using it; give each run its own folder");
}

std::string CheckpointFolder::remedy() const { return ": remove the folder '" + folder_.string() + "' to start over"; }

void CheckpointFolder::requireSameRun(const CheckpointHeader& kept) const {
  const std::string start = "--checkpoint " + folder_.string() + ": was begun ";
  // Names the first option that differs.
  const auto& [a, b] = std::tie(header_.options, kept.options);
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    if (i < a.size() && i < b.size() && a[i] == b[i]) continue;
    const std::string& name = i < a.size() ? a[i].first : b[i].first;
    throw OptionError(start + "with another " + name + remedy());
  }
  if (std::tie(kept.shard, kept.shards) != std::tie(header_.shard, header_.shards))
    throw OptionError(start + "with another --shard" + remedy());
  requireSameFiles(kept.files);
}

void CheckpointFolder::requireSameFiles(const std::vector<FileStamp>& kept) const {
  const std::string when = " when '" + folder_.string() + "' was begun";
  for (const FileStamp& file : header_.files) {
    const auto before = std::ranges::find(kept, file.path, &FileStamp::path);
    if (before == kept.end()) throw InputError("'" + file.path + "' was not read" + when + remedy());
    if (*before != file)
      throw InputError("'" + file.path + "' has changed since '" + folder_.string() + "' was begun" + remedy());
  }
  for (const FileStamp& file : kept)
    if (std::ranges::find(header_.files, file.path, &FileStamp::path) == header_.files.end())
      throw InputError("'" + file.path + "' was read" + when + ", and is not now" + remedy());
}

void CheckpointFolder::replaceUnfinished(const std::vector<fs::path>& folders) {
  std::vector<std::string> own, before;
  for (const fs::path& folder : folders) own.push_back(fs::absolute(folder).string());
  const auto read = [&before, this](std::string_view bytes) {
    ByteReader(bytes, "'" + (folder_ / kOutputs).string() + "'").pass(before);
  };
  try {
    restoreWhole(kOutputs, read);
  } catch (const std::runtime_error&) {
    before.clear();  // damaged: nothing is removed
  }
  for (const std::string& folder : before) {
    const std::string name = fs::path(folder).filename().string();
    const bool of_outputs = name.starts_with('.') && name.find(".part-") != name.npos;
    if (of_outputs && std::ranges::find(own, folder) == own.end()) removeFolder(folder.c_str());
  }
  keepWhole(kOutputs, [&own](const RegionCheckpoint::Put& put) { BasicByteWriter<PutSink>({&put}).pass(own); });
}

void CheckpointFolder::begin(std::uint64_t input_digest, std::size_t groups) {
  if (begun_ && std::tie(header_.input_digest, header_.groups) != std::tuple(input_digest, std::uint64_t{groups}))
    throw InputError("the input has changed since '" + folder_.string() + "' was begun" + remedy());
  if (!begun_) {
    // A run may have ended while it removed its files.
    removeKept(kOutputs);
    header_.input_digest = input_digest;
    header_.groups = groups;
    keepWhole(kRun, [this](const RegionCheckpoint::Put& put) {
      BasicByteWriter<PutSink> writer({&put});
      writer.pass(header_.version);
      writer.pass(header_);
    });
    begun_ = true;
  }
  readGroups();
}

void CheckpointFolder::readGroups() {
  const fs::path path = folder_ / kGroups;
  groups_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (groups_ < 0) failToKeep(path, errno);
  const MappedFile file(path);
  const std::string_view all = file.bytes();
  while (all.size() - groups_end_ >= kMarkBytes + kHashBytes) {
    GroupMark mark;
    std::memcpy(&mark.group, all.data() + groups_end_, sizeof mark.group);
    std::memcpy(&mark.size, all.data() + groups_end_ + sizeof mark.group, sizeof mark.size);
    if (mark.size > all.size() - groups_end_ - kMarkBytes - kHashBytes) break;
    if (mark.group >= header_.groups || !sound(all.substr(groups_end_, kMarkBytes + mark.size + kHashBytes))) break;
    places_[mark.group] = {groups_end_ + kMarkBytes, mark.size};
    groups_end_ += kMarkBytes + mark.size + kHashBytes;
  }
  // The group during which the run ended is incomplete; it is meshed again.
  if (groups_end_ < all.size() && ::ftruncate(groups_, static_cast<off_t>(groups_end_)) != 0) failToKeep(path, errno);
}

GroupResult CheckpointFolder::take(std::size_t group) {
  const Place& place = places_.at(group);
  const std::string what = "'" + (folder_ / kGroups).string() + "'";
  std::string bytes(place.size, '\0');
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t got = ::pread(groups_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(place.at + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw InputError(what + " cannot be read");
    done += static_cast<std::size_t>(got);
  }
  ++groups_taken_;
  return groupFrom(bytes, what);
}

void CheckpointFolder::keep(std::size_t group, const GroupResult& result) {
  if (has(group) || result.lacks_memory) return;
  std::uint64_t size = 0;
  putBytesOf(result, [&size](std::string_view bytes) { size += bytes.size(); });
  const fs::path path = folder_ / kGroups, rounds = folder_ / (kRounds + std::to_string(group));
  const std::lock_guard lock(mutex_);
  Output output(groups_, groups_end_, path);
  const GroupMark mark{group, size};
  output.put({reinterpret_cast<const char*>(&mark.group), sizeof mark.group});
  output.put({reinterpret_cast<const char*>(&mark.size), sizeof mark.size});
  putBytesOf(result, [&output](std::string_view bytes) { output.put(bytes); });
  requireMemoryHeld();  // results of failed allocations may be wrong
  output.end();
  bytes_kept_ += output.at() - groups_end_;
  groups_end_ = output.at();
  // Its rounds are needed until it is on the disk.
  if (::access(rounds.c_str(), F_OK) != 0) return;
  output.waitForDisk();
  std::error_code ignored;
  fs::remove(rounds, ignored);
}

RegionCheckpoint CheckpointFolder::rounds(std::size_t group) {
  const std::string name = kRounds + std::to_string(group);
  return {[this, name](const std::function<void(const RegionCheckpoint::Put&)>& write) {
            keepWhole(name, write);
            ++rounds_kept_;
          },
          [this, name](const RegionCheckpoint::Read& read) {
            if (restoreWhole(name, read)) ++regions_gone_on_;
          }};
}

void CheckpointFolder::keepWhole(const std::string& name,
                                 const std::function<void(const RegionCheckpoint::Put&)>& write) {
  const fs::path path = folder_ / name, unfinished = folder_ / (name + kUnfinished);
  const int file = ::open(unfinished.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) failToKeep(unfinished, errno);
  try {
    Output output(file, 0, unfinished);
    write([&output](std::string_view bytes) { output.put(bytes); });
    requireMemoryHeld();
    output.end();
    output.waitForDisk();
    bytes_kept_ += output.at();
  } catch (...) {
    ::close(file);
    ::unlink(unfinished.c_str());
    throw;
  }
  ::close(file);
  if (::rename(unfinished.c_str(), path.c_str()) != 0) failToKeep(path, errno);
  const int folder = ::open(folder_.c_str(), O_RDONLY | O_CLOEXEC);
  if (folder < 0) return;  // writable, but not readable
  ::fsync(folder);
  ::close(folder);
}

bool CheckpointFolder::restoreWhole(const std::string& name, const RegionCheckpoint::Read& read) const {
  const MappedFile file(folder_ / name);
  if (!file.isThere()) return false;
  const std::optional<std::string_view> bytes = sound(file.bytes());
  if (!bytes) throw BadCheckpoint("'" + (folder_ / name).string() + "' is damaged");
  read(*bytes);
  return true;
}

CheckpointUse CheckpointFolder::use() const { return {groups_taken_, regions_gone_on_, rounds_kept_, bytes_kept_}; }

void CheckpointFolder::removeKept(std::string_view besides) const {
  std::error_code ignored;
  // First the file without which no run resumes.
  fs::remove(folder_ / kRun, ignored);
  for (const std::string& name : namesIn(folder_, ignored))
    if (name != besides &&
        (name == kGroups || name == kOutputs || name.starts_with(kRounds) || name.ends_with(kUnfinished)))
      fs::remove(folder_ / name, ignored);
}

void CheckpointFolder::remove(bool folder_too) {
  removeKept();
  begun_ = false;
  std::error_code ignored;
  fs::remove(folder_ / kLock, ignored);
  if (folder_too) fs::remove(folder_, ignored);
  ::close(std::exchange(lock_, -1));
}

}  // namespace coastmesh
