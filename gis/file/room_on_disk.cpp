#include "gis/file/room_on_disk.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace coastmesh {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kProbeBytes = 64 << 10;

bool isForRoom(int error) { return error == ENOSPC || error == EDQUOT || error == EFBIG; }

std::uintmax_t largestFileIn(const fs::path& folder) {
  std::uintmax_t largest = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code gone;
    const std::uintmax_t size = entry->is_regular_file(gone) ? entry->file_size(gone) : 0;
    if (!gone) largest = std::max(largest, size);
  }
  return largest;
}

bool reachesLimit(const fs::path& folder) {
  rlimit limit{};
  if (::getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return false;
  return limit.rlim_cur < kProbeBytes || largestFileIn(folder) > limit.rlim_cur - kProbeBytes;
}

// The system's error for the write, or for having it reach the disk; 0 if there is none.
int errorOfWriting(int file) {
  const std::array<char, 4096> block{};
  for (std::size_t written = 0; written < kProbeBytes;) {
    const ssize_t count = ::write(file, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return count == 0 ? ENOSPC : errno;
    written += static_cast<std::size_t>(count);
  }
  return ::fsync(file) == 0 ? 0 : errno;
}

}  // namespace

std::string whyNoRoom(const std::string& path, int error) {
  if (isForRoom(error)) return std::strerror(error);
  const fs::path folder = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : fs::path(".");
  if (reachesLimit(folder)) return std::strerror(EFBIG);
  std::string name = (folder / ".room-XXXXXX").string();
  const int file = ::mkstemp(name.data());
  // Without any room there may be none for the name either.
  if (file < 0) return isForRoom(errno) ? std::strerror(errno) : "";
  ::unlink(name.c_str());
  const int found = errorOfWriting(file);
  ::close(file);
  return isForRoom(found) ? std::strerror(found) : "";
}

}  // namespace coastmesh
