#include "gis/file/whole_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "gis/error.hpp"

namespace coastmesh {

std::string wholeFile(const std::string& path) {
  const auto refuse = [&path](int error) { throw InputError("cannot read '" + path + "': " + std::strerror(error)); };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             [](std::FILE* f) { return f ? std::fclose(f) : 0; });
  if (!file) refuse(errno);
  std::setvbuf(file.get(), nullptr, _IONBF, 0);  // reads directly into `bytes`
  // The size is only a hint: a pipe has none, and a file may grow. One extra byte lets the first read find the end.
  constexpr std::uintmax_t kLeast = 1 << 12;
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(path, unknown);
  std::string bytes(static_cast<std::size_t>(unknown ? kLeast : std::max(size + 1, kLeast)), '\0');
  std::size_t length = 0;
  while (const std::size_t got = std::fread(bytes.data() + length, 1, bytes.size() - length, file.get())) {
    length += got;
    if (length == bytes.size()) bytes.resize(2 * length);
  }
  if (std::ferror(file.get())) refuse(errno);
  bytes.resize(length);
  return bytes;
}

}  // namespace coastmesh
