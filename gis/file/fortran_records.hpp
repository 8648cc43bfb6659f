#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gis/file/text_writer.hpp"

namespace coastmesh {

// A Fortran sequential unformatted file, big-endian: each record between two copies of its length in bytes.
class FortranWriter {
 public:
  explicit FortranWriter(std::string path) : path_(path), file_(std::move(path)) {}

  // Each writes one record; throws OutputError, also for one longer than the 2 GiB limit of its length.
  void text(std::string_view value);
  void integers(std::span<const std::int32_t> values);
  void doubles(std::span<const double> values);
  // The same for `value(i)` for every i below `count`, made by the threads of `loop`.
  void integers(const ItemLoop& loop, std::size_t count, const std::function<std::int32_t(std::size_t)>& value);
  void doubles(const ItemLoop& loop, std::size_t count, const std::function<double(std::size_t)>& value);
  void close() { file_.close(); }

 private:
  void length(std::uint64_t bytes);

  std::string path_;
  TextWriter file_;
};

// Reads the same in either byte order, which the length of the first record tells. Throws InputError if a record does
// not have the requested size.
class FortranReader {
 public:
  explicit FortranReader(const std::string& path);

  bool atEnd() const { return at_ >= bytes_.size(); }
  std::size_t nextSize() const;  // bytes of the next record
  std::string text();
  std::vector<std::int32_t> integers(std::size_t count);
  // Of 4 or 8 bytes; those of single precision are the shortest decimals that mean them.
  std::vector<double> reals(std::size_t count, std::size_t bytes_each);
  [[noreturn]] void fail(const std::string& what) const;

 private:
  template <typename Bits>
  Bits bitsOf(std::string_view bytes, std::size_t index) const;  // of the value at `index`
  std::string_view record();
  std::string_view record(std::size_t bytes);

  std::string path_;
  std::string bytes_;
  bool little_endian_ = false;
  std::size_t at_ = 0;
};

}  // namespace coastmesh
