#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace coastmesh {

// Numbers by size, the least first; of equal sizes the least number. What is far from being next waits unsorted in
// buckets of a 64th of an octave: pushing it costs no more than a write.
class SizeQueue {
 public:
  struct Entry {
    double size;  // above 0, finite
    std::uint32_t number;
    bool operator<(const Entry& other) const { return size != other.size ? size > other.size : number > other.number; }
  };

  explicit SizeQueue(const std::vector<Entry>& entries) {
    if (entries.empty()) return;
    lowest_ = bucketOf(std::max_element(entries.begin(), entries.end())->size);  // the one that comes first
    for (const Entry& e : entries) push(e);
  }

  void push(const Entry& entry) {
    const std::size_t bucket = bucketOf(entry.size);
    if (bucket < lowest_ + opened_) {
      heap_.push_back(entry);
      std::push_heap(heap_.begin(), heap_.end());
      return;
    }
    if (bucket - lowest_ >= waiting_.size()) waiting_.resize(bucket - lowest_ + 1);
    waiting_[bucket - lowest_].push_back(entry);
  }

  // Takes the next one out; false where there is none.
  bool pop(Entry& next) {
    while (heap_.empty()) {
      if (opened_ >= waiting_.size()) return false;
      heap_.swap(waiting_[opened_]);
      waiting_[opened_++] = {};
      std::make_heap(heap_.begin(), heap_.end());
    }
    std::pop_heap(heap_.begin(), heap_.end());
    next = heap_.back();
    heap_.pop_back();
    return true;
  }

 private:
  static std::size_t bucketOf(double size) { return std::bit_cast<std::uint64_t>(size) >> 46; }

  std::size_t lowest_ = 0;                   // the bucket that comes first
  std::size_t opened_ = 0;                   // buckets whose entries went to the heap
  std::vector<std::vector<Entry>> waiting_;  // from `lowest_` on
  std::vector<Entry> heap_;                  // all that may be next
};

}  // namespace coastmesh
