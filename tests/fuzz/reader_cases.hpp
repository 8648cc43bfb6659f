#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace coastmesh {

// A reader of the program's, and the files that it is given: one after another in what is drawn, set apart by lines
// that are `kNextFile`; but for the first, what is empty is not there.
struct ReaderCase {
  std::string_view name;
  std::vector<std::string_view> files;    // the first is the one that is named to the reader
  void (*read)(const std::string& path);  // and all that the program does with it before it looks at options
};

inline constexpr std::string_view kNextFile = "\n%%%%\n";

const std::vector<ReaderCase>& readerCases();
const ReaderCase& readerCase(std::string_view name);  // throws std::invalid_argument

// Whether `bytes` are read, and else why not. What is no error in an input (InputError, OptionError), and what such an
// error lacks (the file that it is about), comes as std::logic_error, or as the reader threw it.
struct ReadOutcome {
  bool read = false;
  std::string refusal;
};

// `folder` is an empty one, and is so afterwards.
ReadOutcome runReader(const ReaderCase& reader, std::span<const std::uint8_t> bytes, const std::string& folder);

}  // namespace coastmesh
