#include "gis/file/text_writer.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "gis/error.hpp"

namespace coastmesh {
namespace {

constexpr std::size_t kBufferSize = 1 << 20;
#ifdef SYNC_FILE_RANGE_WRITE
constexpr std::int64_t kFlushedAtOnce = 32 << 20;
#endif

[[noreturn]] void fail(const std::string& path) {
  throw OutputError("cannot write '" + path + "': " + std::strerror(errno));
}

}  // namespace

TextWriter::TextWriter(std::string path) : path_(std::move(path)), buffer_(kBufferSize) {
  file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file_ < 0) fail(path_);
}

TextWriter::~TextWriter() {
  if (file_ >= 0) ::close(file_);
}

TextWriter& TextWriter::operator<<(std::string_view text) {
  if (text.size() > buffer_.size() - used_) flush();
  if (text.size() > buffer_.size()) {
    put(text.data(), text.size());
  } else {
    std::memcpy(buffer_.data() + used_, text.data(), text.size());
    used_ += text.size();
  }
  return *this;
}

void TextWriter::close() {
  flush();
  const int file = file_;
  file_ = -1;
  if (::close(file) != 0) fail(path_);
}

void TextWriter::flush() {
  put(buffer_.data(), used_);
  used_ = 0;
}

void TextWriter::put(const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(file_, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(path_);
    bytes += written;
    size -= static_cast<std::size_t>(written);
    put_ += written;
  }
  beginToFlush();
}

// Lets the disk write while the rest is made. By default the system begins only when a tenth of the memory is dirty, so
// that a later sync waits for all of it.
void TextWriter::beginToFlush() {
#ifdef SYNC_FILE_RANGE_WRITE
  if (put_ - flushed_ < kFlushedAtOnce) return;
  ::sync_file_range(file_, flushed_, put_ - flushed_, SYNC_FILE_RANGE_WRITE);
  flushed_ = put_;
#endif
}

}  // namespace coastmesh
