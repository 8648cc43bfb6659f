#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/edit_mesh.hpp"

namespace coastmesh {

// A bad triangle that waits. It carries its corners, so that it is known to be stale once the slot holds another triangle.
struct BadTriangle {
  TriId triangle = kNone;
  Corners corners{};
};

// Bad triangles, least rank first; of one rank the older first.
class BadQueue {
 public:
  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }

  void push(std::uint32_t rank, const BadTriangle& bad) {
    buckets_[rank].items.push_back(bad);
    ++size_;
  }
  BadTriangle pop() {
    const auto first = buckets_.begin();
    const BadTriangle bad = first->second.items[first->second.next++];
    if (first->second.next == first->second.items.size()) buckets_.erase(first);
    --size_;
    return bad;
  }

 private:
  struct Bucket {
    std::vector<BadTriangle> items;
    std::size_t next = 0;
  };
  std::map<std::uint32_t, Bucket> buckets_;
  std::size_t size_ = 0;
};

}  // namespace coastmesh
