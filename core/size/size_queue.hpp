#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace coastmesh {

// A queue of numbers by size, in batches of a 64th of an octave, smallest first; within a batch first in, first out. An
// exact order would need a heap, with scattered memory accesses.
class SizeQueue {
 public:
  struct Entry {
    double size;  // above 0, finite
    std::uint32_t number;
  };

  // Anything below the batch taken last joins the next one.
  void push(const Entry& entry) {
    const std::size_t batch = std::max(batchOf(entry.size), next_);
    if (waiting_.empty()) lowest_ = batch;
    if (batch < lowest_) {
      waiting_.insert(waiting_.begin(), lowest_ - batch, {});
      lowest_ = batch;
    }
    if (batch - lowest_ >= waiting_.size()) waiting_.resize(batch - lowest_ + 1);
    waiting_[batch - lowest_].push_back(entry);
  }

  // Takes the next batch into `batch`; false if there is none. Numbers pushed for the same batch afterwards form the
  // next one.
  bool take(std::vector<Entry>& batch) {
    batch.clear();
    next_ = std::max(next_, lowest_);
    while (next_ - lowest_ < waiting_.size() && waiting_[next_ - lowest_].empty()) ++next_;
    if (next_ - lowest_ >= waiting_.size()) return false;
    batch.swap(waiting_[next_ - lowest_]);
    return true;
  }

 private:
  static std::size_t batchOf(double size) { return std::bit_cast<std::uint64_t>(size) >> 46; }

  std::vector<std::vector<Entry>> waiting_;  // batches starting with `lowest_`
  std::size_t lowest_ = 0;
  std::size_t next_ = 0;  // all batches before this one are empty
};

}  // namespace coastmesh
