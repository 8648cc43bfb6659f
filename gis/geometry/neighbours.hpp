#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace coastmesh {

// The neighbours of each vertex, in the order of the edges that lead to them.
class Neighbours {
 public:
  // `for_each_edge(visit)` calls `visit(a, b)` with the ends of each edge once; it is called twice.
  template <typename ForEachEdge>
  Neighbours(std::size_t vertices, const ForEachEdge& for_each_edge) : first_(vertices + 1, 0) {
    for_each_edge([&](std::uint32_t a, std::uint32_t b) {
      ++first_[a + 1];
      ++first_[b + 1];
    });
    for (std::size_t v = 0; v < vertices; ++v) first_[v + 1] += first_[v];
    ends_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for_each_edge([&](std::uint32_t a, std::uint32_t b) {
      ends_[next[a]++] = b;
      ends_[next[b]++] = a;
    });
  }

  std::span<const std::uint32_t> of(std::uint32_t v) const {
    return std::span(ends_).subspan(first_[v], first_[v + 1] - first_[v]);
  }

 private:
  std::vector<std::uint32_t> first_, ends_;
};

}  // namespace coastmesh
