#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace coastmesh {

// The whole text as a finite number; spaces around it and a plus before it are allowed.
inline std::optional<double> finiteNumber(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double number = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || stop != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

}  // namespace coastmesh
