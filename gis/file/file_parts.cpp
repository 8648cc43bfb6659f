#include "gis/file/file_parts.hpp"

#include <fcntl.h>
#include <linux/aio_abi.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>

#include "gis/error.hpp"

namespace coastmesh {
namespace {

// A window is made by all threads, section by section, while the disk writes the one before.
constexpr std::uint64_t kSection = std::uint64_t{128} << 10, kSections = 128, kWindow = kSection * kSections;
// O_DIRECT requires offsets, lengths and addresses that are multiples of this.
constexpr std::uint64_t kSector = 4096;

// An open file, written past the page cache if requested and supported by the file system.
class OpenFile {
 public:
  OpenFile(const std::string& path, bool past_cache) : path_(path) {
    cached_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (cached_ < 0) fail(errno);
    if (past_cache) direct_ = ::open(path.c_str(), O_WRONLY | O_DIRECT | O_CLOEXEC);
  }
  ~OpenFile() {
    if (direct_ >= 0) ::close(direct_);
    if (cached_ >= 0) ::close(cached_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  // Reserves the disk space beforehand: in one piece, and a full disk is reported before anything is made. The file
  // gets its length too: the caller of a write that extends it would have to wait for it.
  void allocate(std::uint64_t size) const {
    while (::fallocate(cached_, 0, 0, static_cast<off_t>(size)) != 0) {
      if (errno == EINTR) continue;
      if (errno == ENOSPC || errno == EDQUOT || errno == EFBIG) fail(errno);
      return;  // not every file system can; writing reports other errors
    }
  }

  [[noreturn]] void fail(int error) const {
    throw OutputError("cannot write '" + path_ + "': " + std::strerror(error));
  }

  // The file past the page cache, or -1.
  int direct() const { return direct_; }
  bool fitsDirect(std::uint64_t at, std::uint64_t size) const {
    return direct_ >= 0 && at % kSector == 0 && size % kSector == 0;
  }

  void write(std::uint64_t at, std::span<const std::byte> bytes) const {
    bool direct = fitsDirect(at, bytes.size());
    while (!bytes.empty()) {
      const ssize_t written = ::pwrite(direct ? direct_ : cached_, bytes.data(), bytes.size(), static_cast<off_t>(at));
      if (written < 0 && errno == EINTR) continue;
      if (direct && (written <= 0 || static_cast<std::size_t>(written) % kSector != 0)) {
        direct = false;  // other alignment needed, or an error that the cached write reports
        continue;
      }
      if (written <= 0) fail(written < 0 ? errno : EIO);
      bytes = bytes.subspan(static_cast<std::size_t>(written));
      at += static_cast<std::uint64_t>(written);
    }
  }

  // Throws errors that systems report only on closing.
  void close() {
    const int file = cached_;
    cached_ = -1;
    if (::close(file) != 0) fail(errno);
  }

 private:
  const std::string& path_;
  int cached_ = -1, direct_ = -1;
};

// Bytes in memory, and their place in the file.
struct Run {
  std::uint64_t at = 0;
  std::span<const std::byte> bytes;
};

// Writes that the kernel does while the caller goes on: Linux's native asynchronous writes, which need no thread. Each
// has a slot of one of two windows.
class WritesAhead {
 public:
  explicit WritesAhead(const OpenFile& file) : file_(file) {
    if (file.direct() < 0) return;
    available_ = ::syscall(SYS_io_setup, static_cast<unsigned>(slots_.size()), &context_) == 0;
  }
  // Waits for writes under way.
  ~WritesAhead() {
    if (available_) ::syscall(SYS_io_destroy, context_);
  }
  WritesAhead(const WritesAhead&) = delete;
  WritesAhead& operator=(const WritesAhead&) = delete;

  // Not for files in the page cache, nor where the system refuses it.
  bool available() const { return available_; }

  // `run.bytes` must stay unchanged until `wait`. Their address must have the remainder of `run.at` by the sector's
  // size. May be called for several slots at the same time.
  void begin(unsigned window, std::uint64_t section, const Run& run) {
    const auto& [at, bytes] = run;
    const std::uint64_t head = std::min<std::uint64_t>((kSector - at % kSector) % kSector, bytes.size());
    const std::uint64_t sectors = (bytes.size() - head) / kSector * kSector;
    if (head > 0) file_.write(at, bytes.first(head));
    if (sectors > 0) beginSectors(window * kSections + section, {at + head, bytes.subspan(head, sectors)});
    if (head + sectors < bytes.size()) file_.write(at + head + sectors, bytes.subspan(head + sectors));
  }

  // Waits for the writes of a window.
  void wait(unsigned window) {
    const auto slots = std::span(slots_).subspan(window * kSections, kSections);
    while (std::ranges::any_of(slots, [](const iocb& write) { return write.aio_nbytes > 0; })) {
      std::array<io_event, kSections> events;
      const long ended =
          ::syscall(SYS_io_getevents, context_, 1L, static_cast<long>(events.size()), events.data(), nullptr);
      if (ended < 0 && errno == EINTR) continue;
      if (ended < 1) file_.fail(errno);
      for (const io_event& event : std::span(events).first(static_cast<std::size_t>(ended))) finish(event);
    }
  }

 private:
  void beginSectors(std::uint64_t slot, const Run& run) {
    iocb& write = slots_[slot];
    if (write.aio_nbytes == 0) {
      write.aio_data = slot;
      write.aio_lio_opcode = IOCB_CMD_PWRITE;
      write.aio_fildes = static_cast<std::uint32_t>(file_.direct());
      write.aio_buf = reinterpret_cast<std::uintptr_t>(run.bytes.data());
      write.aio_nbytes = run.bytes.size();
      write.aio_offset = static_cast<std::int64_t>(run.at);
      iocb* const submitted = &write;
      if (::syscall(SYS_io_submit, context_, 1L, &submitted) == 1) return;
      write.aio_nbytes = 0;
    }
    file_.write(run.at, run.bytes);
  }

  void finish(const io_event& event) {
    iocb& write = slots_[event.data];
    const std::uint64_t written = event.res > 0 ? static_cast<std::uint64_t>(event.res) : 0;
    const std::byte* const bytes = reinterpret_cast<const std::byte*>(static_cast<std::uintptr_t>(write.aio_buf));
    // The rest, if there is any, as an ordinary write, which reports what prevents it.
    file_.write(static_cast<std::uint64_t>(write.aio_offset) + written, {bytes + written, write.aio_nbytes - written});
    write.aio_nbytes = 0;
  }

  const OpenFile& file_;
  aio_context_t context_ = 0;
  bool available_ = false;
  std::vector<iocb> slots_ = std::vector<iocb>(2 * kSections);  // of no bytes if not under way
};

// Adds a run that follows the others, to the last one if it begins where that ends, in the file and in memory.
void append(std::vector<Run>& runs, const Run& run) {
  if (!runs.empty() && runs.back().at + runs.back().bytes.size() == run.at &&
      runs.back().bytes.data() + runs.back().bytes.size() == run.bytes.data())
    runs.back().bytes = {runs.back().bytes.data(), runs.back().bytes.size() + run.bytes.size()};
  else
    runs.push_back(run);
}

// Sets the bytes of `buffer`, which stands for the file from `begin` on, as far as they are of a part.
std::vector<Run> fill(std::span<std::byte> buffer, std::uint64_t begin, const std::vector<FilePart>& parts) {
  const std::uint64_t end = begin + buffer.size();
  const auto endOf = [](const FilePart& p) { return p.begin + p.size; };
  std::vector<Run> runs;
  for (auto part = std::ranges::upper_bound(parts, begin, {}, endOf); part != parts.end() && part->begin < end;
       ++part) {
    const std::uint64_t head = std::max(begin, part->begin), tail = std::min(end, endOf(*part));
    const std::span<std::byte> bytes = buffer.subspan(head - begin, tail - head);
    part->fill(head - part->begin, bytes);
    append(runs, {head, bytes});
  }
  return runs;
}

// Memory for a window, aligned for direct writes.
class Buffer {
 public:
  // For direct writes in new memory, in huge pages where the system has them: one thread pins the pages of each write,
  // one by one. Otherwise from the heap, where much may be free.
  explicit Buffer(bool direct) : direct_(direct) {
    constexpr std::size_t kHugePage = std::size_t{2} << 20;
    static_assert(kWindow % kHugePage == 0);
    if (!direct) {
      bytes_ = static_cast<std::byte*>(std::aligned_alloc(kSector, kWindow));
      if (bytes_ == nullptr) throw std::bad_alloc();
      return;
    }
    void* const mapped =
        ::mmap(nullptr, kWindow + kHugePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapped == MAP_FAILED) throw std::bad_alloc();
    auto* const begin = static_cast<std::byte*>(mapped);
    const std::size_t before = (kHugePage - reinterpret_cast<std::uintptr_t>(begin) % kHugePage) % kHugePage;
    bytes_ = begin + before;
    if (before > 0) ::munmap(begin, before);
    ::munmap(bytes_ + kWindow, kHugePage - before);
    ::madvise(bytes_, kWindow, MADV_HUGEPAGE);  // if refused, nothing changes
  }
  ~Buffer() {
    if (direct_)
      ::munmap(bytes_, kWindow);
    else
      std::free(bytes_);
  }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  std::byte* get() const { return bytes_; }

 private:
  std::byte* bytes_ = nullptr;
  bool direct_;
};

}  // namespace

void writeParts(const std::string& path, std::vector<FilePart> parts, const ItemLoop& loop, std::uint64_t large_file) {
  std::erase_if(parts, [](const FilePart& part) { return part.size == 0; });
  if (parts.empty()) return;
  std::ranges::sort(parts, {}, &FilePart::begin);
  std::uint64_t all = 0;
  for (const FilePart& part : parts) all += part.size;
  OpenFile file(path, all >= large_file);
  const std::uint64_t size = parts.back().begin + parts.back().size;
  if (all >= large_file) file.allocate(size);
  const std::array<Buffer, 2> buffers{Buffer(file.direct() >= 0), Buffer(file.direct() >= 0)};
  WritesAhead ahead(file);
  unsigned window = 0;
  for (std::uint64_t begin = parts.front().begin / kWindow * kWindow; begin < size; begin += kWindow) {
    const std::uint64_t sections = (std::min(kWindow, size - begin) - 1) / kSection + 1;
    loop(sections, [&](std::size_t s) {
      const std::uint64_t first = s * kSection, bytes = std::min(kSection, size - begin - first);
      for (const Run& run : fill({buffers[window].get() + first, bytes}, begin + first, parts)) {
        if (ahead.available())
          ahead.begin(window, s, run);
        else
          file.write(run.at, run.bytes);
      }
    });
    window = 1 - window;
    ahead.wait(window);
  }
  ahead.wait(1 - window);
  file.close();
}

}  // namespace coastmesh
