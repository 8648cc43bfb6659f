#include "gis/file/netcdf_header.hpp"

#include <array>
#include <cassert>
#include <fstream>
#include <utility>

namespace coastmesh {
namespace {

// Walks the header as in "The NetCDF Classic Format Specification". After the first misfit nothing more is read.
class HeaderWalk {
 public:
  explicit HeaderWalk(const std::string& path) : file_(path, std::ios::binary | std::ios::ate) {
    left_ = file_ ? static_cast<std::uint64_t>(file_.tellg()) : 0;
    file_.seekg(0);
  }

  bool fits() {
    std::array<char, 4> magic{};
    if (left_ < magic.size() || !file_.read(magic.data(), magic.size())) return true;
    left_ -= magic.size();
    version_ = static_cast<unsigned char>(magic[3]);
    if (magic[0] != 'C' || magic[1] != 'D' || magic[2] != 'F' || (version_ != 1 && version_ != 2 && version_ != 5))
      return true;
    count();  // of records
    list([this] {
      name();
      count();
    });
    attributes();
    list([this] {
      name();
      skip(count(), countSize());  // dimensions
      attributes();
      type();
      count();  // size of a record
      begins_.push_back(number(version_ == 1 ? 4 : 8));
    });
    return sound_;
  }

  std::vector<std::uint64_t>&& begins() { return std::move(begins_); }

 private:
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
      constexpr std::array<std::uint64_t, 12> kBytes{1, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};  // by type
      const std::uint64_t bytes = kBytes[type()];
      skip(count(), bytes);
    });
  }

  void list(auto&& item) {
    number(4);  // tag
    const std::uint64_t items = count();
    for (std::uint64_t i = 0; sound_ && i < items; ++i) item();  // bounded: every item takes bytes of the file
  }

  std::ifstream file_;
  std::uint64_t left_ = 0;
  int version_ = 0;
  bool sound_ = true;
  std::vector<std::uint64_t> begins_;  // of the variables' values
};

}  // namespace

bool headerFitsFile(const std::string& path) { return HeaderWalk(path).fits(); }

std::vector<std::uint64_t> beginningsOfVariables(const std::string& path) {
  HeaderWalk walk(path);
  [[maybe_unused]] const bool sound = walk.fits();
  assert(sound);
  return walk.begins();
}

}  // namespace coastmesh
