#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/item_loop.hpp"

namespace coastmesh {

// A stretch of a file, made where it is needed: `fill(first, bytes)` sets those from the stretch's byte `first` on. It
// is called for parts of the stretch in any order, from several threads at the same time.
struct FilePart {
  std::uint64_t begin = 0, size = 0;  // bytes
  std::function<void(std::uint64_t first, std::span<std::byte> bytes)> fill;
};

// A file of so many bytes is written past the system's cache of files: to fill that with hundreds of megabytes takes
// longer than a fast disk does.
inline constexpr std::uint64_t kLargeFile = std::uint64_t{64} << 20;

// Writes parts, which do not overlap, into a file that is there already; the rest of it stays as it is. Memory: a few
// megabytes a thread. Throws OutputError with the path and the system's reason.
void writeParts(const std::string& path, std::vector<FilePart> parts, const ItemLoop& loop,
                std::uint64_t large_file = kLargeFile);

}  // namespace coastmesh
