#include "tests/fuzz/choices.hpp"

namespace coastmesh {

std::uint64_t Choices::word(unsigned bytes) {
  if (!from_bytes_) return random_() >> (64 - 8 * bytes);
  std::uint64_t value = 0;
  for (unsigned i = 0; i < bytes && !bytes_.empty(); ++i) {
    value |= std::uint64_t{bytes_.front()} << (8 * i);
    bytes_ = bytes_.subspan(1);
  }
  return value;
}

std::uint32_t Choices::below(std::uint32_t n) {
  // Takes as few bytes as possible: a fuzzer searches better if every byte has an effect.
  return static_cast<std::uint32_t>(word(n <= 256 ? (from_bytes_ ? 1 : 2) : 4) % n);
}

double Choices::share() { return static_cast<double>(word(4)) * 0x1p-32; }

}  // namespace coastmesh
