#include "gis/file/file_parts.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>

#include "gis/error.hpp"

namespace coastmesh {
namespace {

constexpr std::uint64_t kWindow = std::uint64_t{2} << 20;  // bytes made and written at once
// O_DIRECT requires offsets, lengths and addresses that are multiples of this.
constexpr std::uint64_t kSector = 4096;

[[noreturn]] void fail(const std::string& path, int error) {
  throw OutputError("cannot write '" + path + "': " + std::strerror(error));
}

// An open file, written past the page cache if requested and supported by the file system.
class OpenFile {
 public:
  OpenFile(const std::string& path, bool past_cache) : path_(path) {
    cached_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (cached_ < 0) fail(path, errno);
    if (past_cache) direct_ = ::open(path.c_str(), O_WRONLY | O_DIRECT | O_CLOEXEC);
  }
  ~OpenFile() {
    if (direct_ >= 0) ::close(direct_);
    if (cached_ >= 0) ::close(cached_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  // Reserves the disk space beforehand: in one piece, and a full disk is reported before anything is made.
  void allocate(std::uint64_t size) const {
    while (::fallocate(cached_, FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(size)) != 0) {
      if (errno == EINTR) continue;
      if (errno == ENOSPC || errno == EDQUOT || errno == EFBIG) fail(path_, errno);
      return;  // not every file system can; writing reports other errors
    }
  }

  void write(std::uint64_t at, std::span<const std::byte> bytes) const {
    bool direct = direct_ >= 0 && at % kSector == 0 && bytes.size() % kSector == 0;
    while (!bytes.empty()) {
      const ssize_t written = ::pwrite(direct ? direct_ : cached_, bytes.data(), bytes.size(), static_cast<off_t>(at));
      if (written < 0 && errno == EINTR) continue;
      if (direct && (written <= 0 || static_cast<std::size_t>(written) % kSector != 0)) {
        direct = false;  // other alignment needed, or an error that the cached write reports
        continue;
      }
      if (written <= 0) fail(path_, written < 0 ? errno : EIO);
      bytes = bytes.subspan(static_cast<std::size_t>(written));
      at += static_cast<std::uint64_t>(written);
    }
  }

  // Throws errors that systems report only on closing.
  void close() {
    const int file = cached_;
    cached_ = -1;
    if (::close(file) != 0) fail(path_, errno);
  }

 private:
  const std::string& path_;
  int cached_ = -1, direct_ = -1;
};

}  // namespace

void writeParts(const std::string& path, std::vector<FilePart> parts, const ItemLoop& loop, std::uint64_t large_file) {
  std::erase_if(parts, [](const FilePart& part) { return part.size == 0; });
  if (parts.empty()) return;
  std::ranges::sort(parts, {}, &FilePart::begin);
  std::uint64_t all = 0;
  for (const FilePart& part : parts) all += part.size;
  OpenFile file(path, all >= large_file);
  const std::uint64_t first = parts.front().begin / kWindow, size = parts.back().begin + parts.back().size;
  if (all >= large_file) file.allocate(size);
  const auto writeWindow = [&](std::uint64_t begin, std::byte* const buffer) {
    const std::uint64_t end = std::min(begin + kWindow, size);
    // Adjacent parts are written together.
    std::uint64_t from = begin, to = begin;
    const auto flush = [&] { file.write(from, {buffer + (from - begin), to - from}); };
    const auto endOf = [](const FilePart& p) { return p.begin + p.size; };
    for (auto part = std::ranges::upper_bound(parts, begin, {}, endOf); part != parts.end() && part->begin < end;
         ++part) {
      const std::uint64_t head = std::max(begin, part->begin), tail = std::min(end, endOf(*part));
      if (head != to) {
        flush();
        from = head;
      }
      part->fill(head - part->begin, {buffer + (head - begin), tail - head});
      to = tail;
    }
    flush();
  };
  const std::uint64_t windows = (size - 1) / kWindow - first + 1;
  const auto writeWindows = [&](std::size_t from, std::size_t to) {
    const std::unique_ptr<void, decltype(&std::free)> buffer(std::aligned_alloc(kSector, kWindow), &std::free);
    if (!buffer) throw std::bad_alloc();
    for (std::size_t w = from; w < to; ++w) writeWindow((first + w) * kWindow, static_cast<std::byte*>(buffer.get()));
  };
  constexpr std::size_t kWindowsABuffer = 4;
  forStretches(loop, windows, writeWindows, kWindowsABuffer);
  file.close();
}

}  // namespace coastmesh
