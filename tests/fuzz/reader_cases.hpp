#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace coastmesh {

// A reader of the program, and its files. Fuzzed bytes contain the files one after another, separated by `kNextFile`;
// an empty file is left out, unless it is the first.
struct ReaderCase {
  std::string_view name;
  std::vector<std::string_view> files;    // the first one is passed to the reader
  void (*read)(const std::string& path);  // reads, and processes the result as the program does before options apply
};

inline constexpr std::string_view kNextFile = "\n%%%%\n";

const std::vector<ReaderCase>& readerCases();
const ReaderCase& readerCase(std::string_view name);  // throws std::invalid_argument

// Either the bytes were read, or `refusal` is the text of the InputError or OptionError.
struct ReadOutcome {
  bool read = false;
  std::string refusal;
};

// `folder` must be empty; it is empty afterwards, unless the reader throws an unexpected exception, which passes
// through. Throws std::logic_error if a refusal names no file.
ReadOutcome runReader(const ReaderCase& reader, std::span<const std::uint8_t> bytes, const std::string& folder);

}  // namespace coastmesh
