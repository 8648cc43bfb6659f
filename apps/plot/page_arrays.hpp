#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace coastmesh {

// Arrays as text within a page, which its script unpacks (page/data.js): planes of bytes, the first byte of every
// value, then the second, least significant first; deflated (zlib), in base64.
struct PackedArray {
  std::string_view form;  // "integers": differences from the value before; "singles" and "doubles": IEEE 754
  std::size_t count = 0;
  std::string text;
};

PackedArray packIntegers(std::span<const std::int32_t> values);
// 32 bits each if these hold every value exactly, otherwise 64.
PackedArray packNumbers(std::span<const double> values);

// RFC 4648, with padding.
std::string base64Of(std::span<const std::uint8_t> bytes);

}  // namespace coastmesh
