#pragma once

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gis/file/file_parts.hpp"

namespace coastmesh {

// An open NetCDF file. Writing throws OutputError with the path and the reason, reading InputError.
class NetcdfWriter {
 public:
  // `large`: arrays of more than 4 GiB, in a format that fewer programs read.
  NetcdfWriter(std::string path, bool large);
  ~NetcdfWriter();
  NetcdfWriter(const NetcdfWriter&) = delete;
  NetcdfWriter& operator=(const NetcdfWriter&) = delete;

  int dimension(const std::string& name, std::size_t length);
  int variable(const std::string& name, int type, const std::vector<int>& dimensions);
  void attribute(int variable, const std::string& name, const std::string& text);
  void attribute(int variable, const std::string& name, int value);
  void attribute(int variable, const std::string& name, double value);
  void attribute(int variable, const std::string& name, const std::vector<signed char>& values);
  void attribute(int variable, const std::string& name, const std::vector<int>& values);

  void endDefinitions();
  void put(int variable, const int* values);
  void put(int variable, const double* values);
  void put(int variable, const signed char* values);
  void put(int variable, const char* values);
  // Sets a variable of NC_INT or NC_DOUBLE to the `count` values `valueOf(i)`. They are made when the file is closed,
  // by the threads of `close`, and written without the library, which is single-threaded.
  template <typename ValueOf>
  void putLater(int variable, std::size_t count, ValueOf valueOf) {
    using Value = decltype(valueOf(count));
    static_assert(std::same_as<Value, std::int32_t> || std::same_as<Value, double>);
    const auto fill = [valueOf](std::uint64_t first, std::span<std::byte> bytes) {
      fillWith<Value>(first, bytes, valueOf);
    };
    later_.push_back({variable, {0, count * sizeof(Value), fill}});
  }
  void close(const ItemLoop& loop = inOrder);

 private:
  void check(int status) const;

  // Fills `bytes` with values in the format's byte order, starting at byte `first` of the variable.
  template <typename Value, typename ValueOf>
  static void fillWith(std::uint64_t first, std::span<std::byte> bytes, const ValueOf& valueOf) {
    using Bits = std::conditional_t<sizeof(Value) == 4, std::uint32_t, std::uint64_t>;
    const auto bitsOf = [&](std::uint64_t i) {
      const Bits bits = std::bit_cast<Bits>(valueOf(static_cast<std::size_t>(i)));
      if constexpr (std::endian::native == std::endian::big) return bits;
      if constexpr (sizeof(Value) == 4)
        return Bits{__builtin_bswap32(bits)};
      else
        return Bits{__builtin_bswap64(bits)};
    };
    while (!bytes.empty()) {
      const std::uint64_t i = first / sizeof(Value), into = first % sizeof(Value);
      std::size_t done = 0;
      if (into == 0) {
        const std::size_t whole = bytes.size() / sizeof(Value);
        for (std::size_t k = 0; k < whole; ++k) {
          const Bits bits = bitsOf(i + k);
          std::memcpy(bytes.data() + k * sizeof(Value), &bits, sizeof(Value));
        }
        done = whole * sizeof(Value);
      }
      if (done == 0) {  // a part of a value
        const Bits bits = bitsOf(i);
        done = std::min<std::size_t>(bytes.size(), sizeof(Value) - into);
        std::memcpy(bytes.data(), reinterpret_cast<const std::byte*>(&bits) + into, done);
      }
      first += done;
      bytes = bytes.subspan(done);
    }
  }

  std::string path_;
  int id_ = -1;
  std::vector<std::pair<int, FilePart>> later_;  // variables' numbers and values
};

class NetcdfReader {
 public:
  explicit NetcdfReader(std::string path);
  ~NetcdfReader();
  NetcdfReader(const NetcdfReader&) = delete;
  NetcdfReader& operator=(const NetcdfReader&) = delete;

  std::vector<std::string> variables() const;
  bool hasVariable(const std::string& name) const;
  std::vector<std::size_t> shape(const std::string& variable) const;
  std::vector<std::string> dimensionsOf(const std::string& variable) const;
  // Empty if there is none, or it is not text.
  std::string text(const std::string& variable, const std::string& attribute) const;
  std::string globalText(const std::string& attribute) const;
  std::optional<double> number(const std::string& variable, const std::string& attribute) const;
  // In the unit of the variable, if the file holds them packed (`scale_factor`, `add_offset`). Numbers of single
  // precision are the shortest decimals that mean them: 12.1, not 12.100000381469727.
  std::vector<double> doubles(const std::string& variable) const;
  // The same, NaN for a value that the file calls missing or that was never written. `row`: only that one of the first
  // dimension.
  std::vector<double> knownDoubles(const std::string& variable, std::optional<std::size_t> row = std::nullopt) const;
  std::vector<std::int64_t> integers(const std::string& variable) const;
  // Numbers of nodes or other things, kMissing for the fill value, which is the library's if the file names none.
  // Programs with missing numbers often store them as reals and NaN.
  static constexpr std::int64_t kMissing = std::numeric_limits<std::int64_t>::min();
  std::vector<std::int64_t> indices(const std::string& variable) const;
  std::vector<std::string> texts(const std::string& variable) const;  // rows of characters, padded with zeros

  [[noreturn]] void fail(const std::string& what) const;

 private:
  void check(int status) const;
  int variableId(const std::string& name) const;
  std::string textOf(int variable, const std::string& attribute) const;
  std::size_t sizeOf(const std::string& variable) const;
  std::vector<double> packedDoubles(const std::string& variable, std::optional<std::size_t> row = std::nullopt) const;
  // Turns stored numbers into those that they mean.
  void unpack(const std::string& variable, std::vector<double>& values) const;

  std::string path_;
  int id_ = -1;
};

}  // namespace coastmesh
