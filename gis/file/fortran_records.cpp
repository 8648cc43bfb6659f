#include "gis/file/fortran_records.hpp"

#include <bit>
#include <cstring>
#include <limits>

#include "gis/error.hpp"
#include "gis/file/single_precision.hpp"
#include "gis/file/whole_file.hpp"
#include "gis/for_count.hpp"

namespace coastmesh {
namespace {

static_assert(std::endian::native == std::endian::little, "bytes are swapped");

std::uint32_t swapped(std::uint32_t value) { return __builtin_bswap32(value); }
std::uint64_t swapped(std::uint64_t value) { return __builtin_bswap64(value); }

template <typename Bits>
Bits bitsAt(std::string_view bytes, std::size_t index) {
  Bits bits;
  std::memcpy(&bits, bytes.data() + index * sizeof(Bits), sizeof(Bits));
  return swapped(bits);
}

}  // namespace

void FortranWriter::length(std::uint64_t bytes) {
  if (bytes > static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max()))
    throw OutputError("cannot write '" + path_ + "': a record of it would pass 2 GiB; choose .nc");
  const std::uint32_t bits = swapped(static_cast<std::uint32_t>(bytes));
  file_.raw(&bits, sizeof(bits));
}

void FortranWriter::text(std::string_view value) {
  length(value.size());
  file_ << value;
  length(value.size());
}

void FortranWriter::integers(std::span<const std::int32_t> values) {
  integers(inOrder, values.size(), [values](std::size_t i) { return values[i]; });
}

void FortranWriter::doubles(std::span<const double> values) {
  doubles(inOrder, values.size(), [values](std::size_t i) { return values[i]; });
}

void FortranWriter::integers(const ItemLoop& loop, std::size_t count,
                             const std::function<std::int32_t(std::size_t)>& value) {
  length(count * sizeof(std::uint32_t));
  file_.rows(loop, count, [&value](TextBlock& block, std::size_t i) {
    const std::uint32_t bits = swapped(static_cast<std::uint32_t>(value(i)));
    block.raw(&bits, sizeof(bits));
  });
  length(count * sizeof(std::uint32_t));
}

void FortranWriter::doubles(const ItemLoop& loop, std::size_t count, const std::function<double(std::size_t)>& value) {
  length(count * sizeof(std::uint64_t));
  file_.rows(loop, count, [&value](TextBlock& block, std::size_t i) {
    const std::uint64_t bits = swapped(std::bit_cast<std::uint64_t>(value(i)));
    block.raw(&bits, sizeof(bits));
  });
  length(count * sizeof(std::uint64_t));
}

FortranReader::FortranReader(const std::string& path) : path_(path), bytes_(wholeFile(path)) {
  if (bytes_.size() < 8) return;
  const auto fits = [this](std::uint32_t length) { return length <= bytes_.size() - 8; };
  const auto length = bitsAt<std::uint32_t>(bytes_, 0);
  little_endian_ = !fits(length) && fits(swapped(length));
}

template <typename Bits>
Bits FortranReader::bitsOf(std::string_view bytes, std::size_t index) const {
  const Bits bits = bitsAt<Bits>(bytes, index);
  return little_endian_ ? swapped(bits) : bits;
}

void FortranReader::fail(const std::string& what) const { throw InputError("'" + path_ + "': " + what); }

std::size_t FortranReader::nextSize() const {
  if (bytes_.size() - at_ < 8) fail("it ends too early, at byte " + std::to_string(bytes_.size()));
  const std::size_t size = bitsOf<std::uint32_t>(std::string_view(bytes_).substr(at_, 4), 0);
  if (size > bytes_.size() - at_ - 8) fail("it is not a Fortran file, or ends too early");
  return size;
}

std::string_view FortranReader::record() {
  const std::size_t size = nextSize();
  const std::string_view rest = std::string_view(bytes_).substr(at_ + 4);
  if (bitsOf<std::uint32_t>(rest.substr(size, 4), 0) != size)
    fail("the record at byte " + std::to_string(at_) + " has two different lengths");
  at_ += size + 8;
  return rest.substr(0, size);
}

std::string_view FortranReader::record(std::size_t bytes) {
  const std::size_t size = nextSize();
  if (size != bytes)
    fail("the record at byte " + std::to_string(at_) + " has " + std::to_string(size) +
         forCount(size, " byte", " bytes") + " where " + std::to_string(bytes) + " are expected");
  return record();
}

std::string FortranReader::text() { return std::string(record()); }

std::vector<std::int32_t> FortranReader::integers(std::size_t count) {
  const std::string_view bytes = record(4 * count);
  std::vector<std::int32_t> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<std::int32_t>(bitsOf<std::uint32_t>(bytes, i));
  return values;
}

std::vector<double> FortranReader::reals(std::size_t count, std::size_t bytes_each) {
  const std::string_view bytes = record(bytes_each * count);
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i)
    values[i] = bytes_each == 4 ? shortestDecimal(std::bit_cast<float>(bitsOf<std::uint32_t>(bytes, i)))
                                : std::bit_cast<double>(bitsOf<std::uint64_t>(bytes, i));
  return values;
}

}  // namespace coastmesh
