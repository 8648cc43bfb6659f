#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace coastmesh {

// Arrays as text within a page, for its script to unpack (page/data.js): what differs from value to value comes in
// planes, the first byte of every value, then the second, least first; deflated (zlib), in base64.
struct PackedArray {
  std::string_view form;  // "integers": differences from the value before; "singles" and "doubles": IEEE 754
  std::size_t count = 0;
  std::string text;
};

PackedArray packIntegers(std::span<const std::int32_t> values);
// With 32 bits each where these hold every value exactly, else with 64.
PackedArray packNumbers(std::span<const double> values);

// As RFC 4648 has it, with padding.
std::string base64Of(std::span<const std::uint8_t> bytes);

}  // namespace coastmesh
