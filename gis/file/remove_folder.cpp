#include "gis/file/remove_folder.hpp"

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

namespace coastmesh {
namespace {

constexpr int kDepth = 4;  // folders within folders; there is one, of files that are replaced

// Entries are read as the system gives them: the C library would ask for memory.
bool removeIn(int above, const char* name, int depth) {
  const int folder = openat(above, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
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
      if (unlinkat(folder, entry.name, 0) != 0 && depth > 0) removeIn(folder, entry.name, depth - 1);
    }
  }
  close(folder);
  return unlinkat(above, name, AT_REMOVEDIR) == 0 || errno == ENOENT;
}

}  // namespace

bool removeFolder(const char* path) noexcept { return removeIn(AT_FDCWD, path, kDepth); }

}  // namespace coastmesh
