#pragma once

#include <cpl_vsi.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string>

namespace coastmesh {

// The bytes of a file, or of anything else that GDAL can open, in sequence. Buffered here: a parser that calls the
// library for each byte spends half of its time on that. A file that cannot be opened reads as empty.
class FileBytes {
 public:
  // `size`, in bytes, keeps the buffer of a small file small. The buffer is not zeroed: it is filled at once.
  FileBytes(const std::string& path, std::uintmax_t size)
      : file_(VSIFOpenL(path.c_str(), "rb")),
        block_size_(static_cast<std::size_t>(std::clamp<std::uintmax_t>(size, kLeastBlock, kBlock))),
        block_(std::make_unique_for_overwrite<char[]>(block_size_)) {
    next();
  }

  bool atEnd() const { return at_ == end_; }
  char byte() const { return block_[at_]; }
  void step() {
    if (++at_ == end_) next();
  }

 private:
  static constexpr std::size_t kLeastBlock = 1 << 12, kBlock = 1 << 18;

  struct Close {
    void operator()(VSILFILE* file) const { VSIFCloseL(file); }
  };

  void next() {
    at_ = 0;
    end_ = file_ ? VSIFReadL(block_.get(), 1, block_size_, file_.get()) : 0;
  }

  std::unique_ptr<VSILFILE, Close> file_;
  std::size_t block_size_;
  std::unique_ptr<char[]> block_;
  std::size_t at_ = 0, end_ = 0;
};

class ByteIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = char;

  explicit ByteIterator(FileBytes* bytes) : bytes_(bytes) {}  // null: the end
  char operator*() const { return bytes_->byte(); }
  ByteIterator& operator++() {
    bytes_->step();
    return *this;
  }
  friend bool operator==(const ByteIterator& a, const ByteIterator& b) { return a.atEnd() == b.atEnd(); }

 private:
  bool atEnd() const { return bytes_ == nullptr || bytes_->atEnd(); }

  FileBytes* bytes_;
};

}  // namespace coastmesh
