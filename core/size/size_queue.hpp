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
  static constexpr std::size_t kNoBatch = static_cast<std::size_t>(-1);

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
    const std::size_t next = nextBatch();
    takeOnly(next, batch);
    return next != kNoBatch;
  }
  // The batch that `take` would take, or kNoBatch.
  std::size_t nextBatch() {
    next_ = std::max(next_, lowest_);
    while (next_ - lowest_ < waiting_.size() && waiting_[next_ - lowest_].empty()) ++next_;
    return next_ - lowest_ < waiting_.size() ? next_ : kNoBatch;
  }
  // Takes this batch, which may be empty. REQUIRES: it is not after `nextBatch()`.
  void takeOnly(std::size_t number, std::vector<Entry>& batch) {
    batch = {};
    if (number == kNoBatch) return;
    next_ = number;
    if (number >= lowest_ && number - lowest_ < waiting_.size()) batch = std::move(waiting_[number - lowest_]);
  }

 private:
  static std::size_t batchOf(double size) { return std::bit_cast<std::uint64_t>(size) >> 46; }

  std::vector<std::vector<Entry>> waiting_;  // batches starting with `lowest_`
  std::size_t lowest_ = 0;
  std::size_t next_ = 0;  // all batches before this one are empty
};

// The same for ranges of numbers, whose queues and batches several threads can use at once, one for each range.
class SizeQueues {
 public:
  struct alignas(64) Range {
    SizeQueue queue;
    std::vector<SizeQueue::Entry> batch;  // of this range
  };

  explicit SizeQueues(std::size_t numbers) {
    constexpr std::size_t kMostRanges = 64;
    while (kMostRanges << shift_ < numbers) ++shift_;
    ranges_.resize((numbers >> shift_) + 1);
  }

  std::size_t count() const { return ranges_.size(); }
  std::size_t rangeOf(std::uint32_t number) const { return number >> shift_; }
  Range& operator[](std::size_t range) { return ranges_[range]; }
  void push(const SizeQueue::Entry& entry) { ranges_[rangeOf(entry.number)].queue.push(entry); }
  // Takes the next batch of all ranges together, and returns its number of entries; 0 if there is none.
  std::size_t take() {
    std::size_t next = SizeQueue::kNoBatch, entries = 0;
    for (Range& range : ranges_) next = std::min(next, range.queue.nextBatch());
    for (Range& range : ranges_) {
      range.queue.takeOnly(next, range.batch);
      entries += range.batch.size();
    }
    return entries;
  }

 private:
  std::vector<Range> ranges_;
  unsigned shift_ = 12;  // a range has two to the power of this many numbers
};

}  // namespace coastmesh
