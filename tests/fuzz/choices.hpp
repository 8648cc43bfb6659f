#pragma once

#include <cstdint>
#include <random>
#include <span>

namespace coastmesh {

// The decisions that define a random input: drawn from a seed, or read from a fuzzer's bytes, so that both kinds of
// test share their generators. When the bytes are used up, every decision is 0.
class Choices {
 public:
  explicit Choices(std::uint64_t seed) : random_(seed) {}
  explicit Choices(std::span<const std::uint8_t> bytes) : from_bytes_(true), bytes_(bytes) {}

  // 0 <= result < n. REQUIRES: n > 0.
  std::uint32_t below(std::uint32_t n);
  // 0 <= result < 1, in steps of 2^-32.
  double share();
  double between(double low, double high) { return low + (high - low) * share(); }
  bool oneIn(std::uint32_t n) { return below(n) == n - 1; }
  template <typename T>
  T oneOf(std::initializer_list<T> values) {
    return values.begin()[below(static_cast<std::uint32_t>(values.size()))];
  }

 private:
  std::uint64_t word(unsigned bytes);

  bool from_bytes_ = false;
  std::span<const std::uint8_t> bytes_;
  std::mt19937_64 random_;
};

}  // namespace coastmesh
