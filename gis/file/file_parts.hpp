#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/item_loop.hpp"

namespace coastmesh {

// A part of a file, made on demand: `fill(first, bytes)` sets the bytes starting at the part's byte `first`. It is
// called for sections of the part in any order, from several threads at the same time.
struct FilePart {
  std::uint64_t begin = 0, size = 0;  // bytes
  std::function<void(std::uint64_t first, std::span<std::byte> bytes)> fill;
};

// Parts of at least this size in total are written without the page cache: filling it with hundreds of megabytes takes
// longer than writing to a fast disk.
inline constexpr std::uint64_t kLargeFile = std::uint64_t{64} << 20;

// Writes parts, which do not overlap, into an existing file; the rest of it is unchanged. Large files are written while
// the following bytes are made. Memory: 32 MiB. Throws OutputError with the path and the system's reason.
void writeParts(const std::string& path, std::vector<FilePart> parts, const ItemLoop& loop,
                std::uint64_t large_file = kLargeFile);

}  // namespace coastmesh
