#include "apps/process/waiting_threads.hpp"

#include <algorithm>
#include <atomic>
#include <system_error>
#include <thread>
#include <vector>

namespace coastmesh {

void onWaitingThreads(std::size_t count, const std::function<void(std::size_t)>& work) {
  constexpr std::size_t kMostThreads = 16, kWorthThread = 8;  // items
  std::atomic<std::size_t> next{0};
  const auto workOn = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::jthread> others;
  others.reserve(kMostThreads);
  try {
    while (others.size() < std::min(kMostThreads, count / kWorthThread)) others.emplace_back(workOn);
  } catch (const std::system_error&) {
    // The system starts no more; those that run do all of it.
  }
  workOn();
}

}  // namespace coastmesh
