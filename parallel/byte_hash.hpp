#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace coastmesh {

// A hash of bytes to detect damage: independent of how the bytes are split, for one kind of machine. Not secure against
// deliberate changes.
class ByteHash {
 public:
  void add(std::string_view bytes) {
    count_ += bytes.size();
    while (!bytes.empty() && (begun_ > 0 || bytes.size() < kWord)) {
      word_[begun_++] = bytes.front();
      bytes.remove_prefix(1);
      if (begun_ < kWord) continue;
      mix(word_);
      begun_ = 0;
    }
    for (; bytes.size() >= kWord; bytes.remove_prefix(kWord)) mix(bytes.data());
    if (!bytes.empty()) std::memcpy(word_, bytes.data(), bytes.size());
    begun_ += bytes.size();
  }

  std::uint64_t value() const {
    ByteHash last = *this;
    std::memset(last.word_ + begun_, 0, kWord - begun_);
    last.mix(last.word_);
    return mixed(last.value_, count_);
  }

 private:
  static constexpr std::size_t kWord = sizeof(std::uint64_t);

  static std::uint64_t mixed(std::uint64_t value, std::uint64_t next) {
    return std::rotl((value ^ next) * 0x9E3779B97F4A7C15ull, 31);
  }
  void mix(const char* word) {
    std::uint64_t next = 0;
    std::memcpy(&next, word, kWord);
    value_ = mixed(value_, next);
  }

  std::uint64_t value_ = 0, count_ = 0;
  std::size_t begun_ = 0;  // bytes of an incomplete word
  char word_[kWord] = {};
};

}  // namespace coastmesh
