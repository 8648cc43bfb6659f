#pragma once

namespace coastmesh {

// Returns the text that follows a number in a message: `one` after 1, else `many`.
template <typename Count>
constexpr const char* forCount(Count count, const char* one, const char* many) {
  return count == 1 ? one : many;
}

}  // namespace coastmesh
