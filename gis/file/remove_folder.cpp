#include "gis/file/remove_folder.hpp"

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstring>

namespace coastmesh {
namespace {

constexpr int kDepth = 4;  // levels of folders; there are none unless a library makes some

// A spare descriptor, or -1. Several threads and signal handlers may compete for it.
int g_spare = -1;

int openFolder(const char* path) {
  constexpr int kFlags = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
  const int folder = open(path, kFlags);
  if (folder >= 0 || (errno != EMFILE && errno != ENFILE)) return folder;
  const int spare = __atomic_exchange_n(&g_spare, -1, __ATOMIC_ACQ_REL);
  if (spare < 0) return -1;
  close(spare);
  return open(path, kFlags);
}

// A path that grows without allocating memory. Text that would make it too long is not appended.
class Path {
 public:
  explicit Path(const char* path) { append(path); }

  const char* text() const { return text_; }
  std::size_t size() const { return std::strlen(text_); }
  void cutTo(std::size_t size) { text_[size] = '\0'; }
  bool enter(const char* name) { return append("/") && append(name); }

 private:
  bool append(const char* more) {
    const std::size_t before = size(), length = std::strlen(more);
    if (before + length >= sizeof text_) return false;
    std::memcpy(text_ + before, more, length + 1);
    return true;
  }

  char text_[PATH_MAX] = {};
};

// Removes the entries of a folder, except folders that are not empty: `left` is the name of one of these, or empty.
// False if the folder exists but cannot be opened. Reads entries by a system call: the C library allocates memory.
bool removeEntries(const char* path, char (&left)[NAME_MAX + 1]) {
  left[0] = '\0';
  const int folder = openFolder(path);
  if (folder < 0) return errno == ENOENT;
  struct Entry {
    std::uint64_t number;
    std::int64_t next;
    unsigned short size;
    unsigned char type;
    char name[1];
  };
  alignas(Entry) char entries[4096];
  for (long size = 0; (size = syscall(SYS_getdents64, folder, entries, sizeof entries)) > 0;) {
    for (long at = 0; at < size;) {
      const Entry& entry = *reinterpret_cast<const Entry*>(entries + at);
      at += entry.size;
      if (std::strcmp(entry.name, ".") == 0 || std::strcmp(entry.name, "..") == 0) continue;
      if (unlinkat(folder, entry.name, 0) == 0 || unlinkat(folder, entry.name, AT_REMOVEDIR) == 0) continue;
      if (errno == ENOTEMPTY || errno == EEXIST) std::strncpy(left, entry.name, NAME_MAX);
    }
  }
  close(folder);
  return true;
}

// Keeps only one folder open at a time, as there may be no more descriptors.
bool removeIn(Path& path, int depth) {
  constexpr int kMostFolders = 1000;  // other processes may keep making them
  char left[NAME_MAX + 1] = {};
  bool goes_on = true;
  for (int i = 0; i < kMostFolders && goes_on; ++i) {
    if (!removeEntries(path.text(), left)) return false;
    goes_on = false;
    const std::size_t here = path.size();
    if (left[0] != '\0' && depth > 0 && path.enter(left)) goes_on = removeIn(path, depth - 1);
    path.cutTo(here);
  }
  return rmdir(path.text()) == 0 || errno == ENOENT;
}

}  // namespace

void keepSpareDescriptor() noexcept {
  if (__atomic_load_n(&g_spare, __ATOMIC_ACQUIRE) >= 0) return;
  const int made = open("/dev/null", O_RDONLY | O_CLOEXEC);
  const int before = __atomic_exchange_n(&g_spare, made, __ATOMIC_ACQ_REL);
  if (before >= 0) close(before);
}

bool removeFolder(const char* path) noexcept {
  Path all(path);
  return all.size() == std::strlen(path) && removeIn(all, kDepth);
}

}  // namespace coastmesh
