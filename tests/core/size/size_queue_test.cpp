#include "core/size/size_queue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace coastmesh {
namespace {

using Batch = std::vector<std::pair<std::uint32_t, double>>;

Batch sorted(Batch batch) {
  std::ranges::sort(batch);
  return batch;
}

// While batches are taken, larger entries and some smaller ones join.
TEST(SizeQueues, TakeTheBatchesOfOneQueue) {
  constexpr std::uint32_t kNumbers = 500'000;
  std::mt19937_64 random(1);
  const auto entry = [&](double from) {
    const double octaves = std::uniform_real_distribution<double>(-0.1, 3.0)(random);
    return SizeQueue::Entry{from * std::exp2(octaves), static_cast<std::uint32_t>(random() % kNumbers)};
  };
  SizeQueue queue;
  SizeQueues queues(kNumbers);
  ASSERT_GT(queues.count(), 16u);
  const auto push = [&](const SizeQueue::Entry& e) {
    queue.push(e);
    queues.push(e);
  };
  for (int i = 0; i < 5000; ++i) push(entry(1.0));
  std::size_t taken = 0, batches = 0;
  std::vector<SizeQueue::Entry> batch;
  while (queue.take(batch)) {
    Batch expected, found;
    for (const SizeQueue::Entry& e : batch) expected.push_back({e.number, e.size});
    ASSERT_EQ(queues.take(), batch.size());
    for (std::size_t r = 0; r < queues.count(); ++r) {
      for (const SizeQueue::Entry& e : queues[r].batch) {
        EXPECT_EQ(queues.rangeOf(e.number), r);
        found.push_back({e.number, e.size});
      }
    }
    ASSERT_EQ(sorted(found), sorted(expected));
    for (const SizeQueue::Entry& e : batch)
      if (taken++ < 20'000) push(entry(e.size));
    ++batches;
  }
  EXPECT_EQ(queues.take(), 0u);
  EXPECT_GT(batches, 200u);
}

}  // namespace
}  // namespace coastmesh
