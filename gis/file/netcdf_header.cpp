#include "gis/file/netcdf_header.hpp"

#include <array>
#include <cassert>
#include <fstream>
#include <limits>
#include <utility>

namespace coastmesh {
namespace {

// Walks the header as in "The NetCDF Classic Format Specification". After the first misfit nothing more is read.
class HeaderWalk {
 public:
  explicit HeaderWalk(const std::string& path) : file_(path, std::ios::binary | std::ios::ate) {
    left_ = file_bytes_ = file_ ? static_cast<std::uint64_t>(file_.tellg()) : 0;
    file_.seekg(0);
  }

  bool fits() {
    std::array<char, 4> magic{};
    if (left_ < magic.size() || !file_.read(magic.data(), magic.size())) return true;
    left_ -= magic.size();
    version_ = static_cast<unsigned char>(magic[3]);
    if (magic[0] != 'C' || magic[1] != 'D' || magic[2] != 'F' || (version_ != 1 && version_ != 2 && version_ != 5))
      return true;
    records_ = count();
    list([this] {
      name();
      lengths_.push_back(count());
    });
    attributes();
    list([this] { variable(); });
    return sound_;
  }

  // False if the file ends before the values of a variable do. REQUIRES: `fits`.
  bool holdsValues() const {
    std::uint64_t record_bytes = 0, record_variables = 0;
    for (const Variable& each : variables_) {
      if (!each.of_records) continue;
      record_bytes = sum(record_bytes, padded(each.bytes));
      ++record_variables;
    }
    const bool streamed = records_ == (version_ == 5 ? kMost : std::numeric_limits<std::uint32_t>::max());
    for (std::size_t v = 0; v < variables_.size(); ++v) {
      const Variable& each = variables_[v];
      std::uint64_t bytes = each.bytes;
      if (each.of_records) {
        if (streamed || records_ == 0) continue;
        const std::uint64_t step = record_variables == 1 ? each.bytes : record_bytes;  // a single one is not padded
        bytes = sum(bytes, product(step, records_ - 1));
      }
      if (bytes > 0 && sum(begins_[v], bytes) > file_bytes_) return false;
    }
    return true;
  }

  std::vector<std::uint64_t>&& begins() { return std::move(begins_); }

 private:
  static constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  static constexpr std::array<std::uint64_t, 12> kBytes{1, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};  // by type

  struct Variable {
    std::uint64_t bytes;  // of its values, or of one record of them
    bool of_records;
  };

  // What exceeds the range is the largest number.
  static std::uint64_t sum(std::uint64_t a, std::uint64_t b) { return a > kMost - b ? kMost : a + b; }
  static std::uint64_t product(std::uint64_t a, std::uint64_t b) { return b > 0 && a > kMost / b ? kMost : a * b; }
  static std::uint64_t padded(std::uint64_t bytes) { return sum(bytes, 3) / 4 * 4; }

  std::uint64_t countSize() const { return version_ == 5 ? 8 : 4; }
  std::uint64_t count() { return number(countSize()); }

  std::uint64_t number(std::uint64_t bytes) {
    std::uint64_t value = 0;
    if (sound_ && (left_ < bytes)) sound_ = false;
    for (std::uint64_t i = 0; sound_ && i < bytes; ++i) value = value << 8 | static_cast<unsigned char>(file_.get());
    left_ -= sound_ ? bytes : 0;
    return value;
  }

  // Values are padded to a multiple of four bytes.
  void skip(std::uint64_t values, std::uint64_t bytes_each) {
    sound_ = sound_ && values <= left_ / bytes_each;
    if (!sound_) return;
    const std::uint64_t bytes = (values * bytes_each + 3) / 4 * 4;
    sound_ = bytes <= left_ && file_.seekg(static_cast<std::streamoff>(bytes), std::ios::cur);
    left_ -= sound_ ? bytes : 0;
  }

  void name() { skip(count(), 1); }

  // A type, or 0 if it is not valid. The twelfth, strings, has no size in these files: the library divides by that
  // size, and misreads the rest of the header.
  std::uint64_t type() {
    constexpr std::uint64_t kTypes = 11;
    const std::uint64_t type = number(4);
    sound_ = sound_ && type >= 1 && type <= kTypes;
    return sound_ ? type : 0;
  }

  void attributes() {
    list([this] {
      name();
      const std::uint64_t bytes = kBytes[type()];
      skip(count(), bytes);
    });
  }

  void variable() {
    name();
    const std::uint64_t dimensions = count();
    Variable read{1, false};
    for (std::uint64_t i = 0; sound_ && i < dimensions; ++i) {
      const std::uint64_t dimension = count();
      sound_ = sound_ && dimension < lengths_.size();
      if (!sound_) return;
      const std::uint64_t length = lengths_[dimension];  // 0: of records, if it is the first
      read.of_records = read.of_records || (i == 0 && length == 0);
      if (i > 0 || length > 0) read.bytes = product(read.bytes, length);
    }
    attributes();
    read.bytes = product(read.bytes, kBytes[type()]);
    count();  // its size, which is not known of large variables
    begins_.push_back(number(version_ == 1 ? 4 : 8));
    variables_.push_back(read);
  }

  void list(auto&& item) {
    number(4);  // tag
    const std::uint64_t items = count();
    for (std::uint64_t i = 0; sound_ && i < items; ++i) item();  // bounded: every item takes bytes of the file
  }

  std::ifstream file_;
  std::uint64_t left_ = 0, file_bytes_ = 0;
  int version_ = 0;
  bool sound_ = true;
  std::uint64_t records_ = 0;
  std::vector<std::uint64_t> lengths_;  // of dimensions
  std::vector<Variable> variables_;
  std::vector<std::uint64_t> begins_;  // of the variables' values
};

}  // namespace

bool headerFitsFile(const std::string& path) {
  HeaderWalk walk(path);
  return walk.fits() && walk.holdsValues();
}

std::vector<std::uint64_t> beginningsOfVariables(const std::string& path) {
  HeaderWalk walk(path);
  [[maybe_unused]] const bool sound = walk.fits();
  assert(sound);
  return walk.begins();
}

}  // namespace coastmesh
