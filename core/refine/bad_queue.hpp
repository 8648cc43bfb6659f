#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/edit_mesh.hpp"

namespace coastmesh {

// A queued bad triangle. It stores its corners, so that it is recognised as stale once its slot holds another triangle.
struct BadTriangle {
  TriId triangle = kNone;
  Corners corners{};
};

// Bad triangles, lowest rank first; within a rank the oldest first.
class BadQueue {
 public:
  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }

  void push(std::uint32_t rank, const BadTriangle& bad) {
    cover(rank);
    const std::size_t at = rank - lowest_;
    buckets_[at].items.push_back(bad);
    filled_[at / 64] |= std::uint64_t{1} << at % 64;
    first_word_ = std::min(first_word_, at / 64);
    ++size_;
  }
  // REQUIRES: not empty.
  BadTriangle pop() {
    while (filled_[first_word_] == 0) ++first_word_;
    const std::size_t at = 64 * first_word_ + static_cast<std::size_t>(std::countr_zero(filled_[first_word_]));
    Bucket& bucket = buckets_[at];
    const BadTriangle bad = bucket.items[bucket.next++];
    if (bucket.next == bucket.items.size()) {
      bucket = {};
      filled_[at / 64] &= ~(std::uint64_t{1} << at % 64);
    }
    --size_;
    return bad;
  }

 private:
  struct Bucket {
    std::vector<BadTriangle> items;
    std::size_t next = 0;
  };

  // Extends the buckets from the lowest rank so far to this one, in words of 64.
  void cover(std::uint32_t rank) {
    if (buckets_.empty()) lowest_ = rank / 64 * 64;
    if (rank < lowest_) {
      const std::uint32_t fewer = rank / 64 * 64, more = lowest_ - fewer;
      std::vector<Bucket> wider(more + buckets_.size());
      std::ranges::move(buckets_, wider.begin() + more);
      buckets_ = std::move(wider);
      filled_.insert(filled_.begin(), more / 64, 0);
      first_word_ += more / 64;
      lowest_ = fewer;
    }
    if (rank - lowest_ >= buckets_.size()) {
      filled_.resize((rank - lowest_) / 64 + 1, 0);
      buckets_.resize(64 * filled_.size());
    }
  }

  std::uint32_t lowest_ = 0;           // rank of the first bucket
  std::vector<Bucket> buckets_;        // one for each rank
  std::vector<std::uint64_t> filled_;  // one bit for each bucket
  std::size_t first_word_ = 0;         // all buckets before this word are empty
  std::size_t size_ = 0;
};

}  // namespace coastmesh
