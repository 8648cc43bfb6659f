#include "parallel/deal.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "parallel/workers.hpp"

namespace coastmesh {

namespace {

// Replies that have arrived. Shared with the callbacks that deliver them, which may run after the call has ended.
class Inbox {
 public:
  void expect() {
    const std::lock_guard lock(mutex_);
    ++awaited_;
  }
  void put(std::size_t item, Reply&& reply) {
    {
      const std::lock_guard lock(mutex_);
      replies_.emplace_back(item, std::move(reply));
    }
    changed_.notify_all();
  }
  // Takes a reply that has arrived; false if there is none.
  bool get(std::pair<std::size_t, Reply>& reply) {
    const std::lock_guard lock(mutex_);
    return pop(reply);
  }
  // Waits for a reply; false if none is outstanding, or `stop` is set. Throws Cancelled.
  bool await(std::pair<std::size_t, Reply>& reply, const RunControl& control, const std::atomic<bool>& stop) {
    constexpr auto kLook = std::chrono::milliseconds(50);
    std::unique_lock lock(mutex_);
    for (;;) {
      if (pop(reply)) return true;
      if (awaited_ == 0 || stop) return false;
      changed_.wait_for(lock, kLook);
      if (control.cancelled && control.cancelled()) throw Cancelled();
    }
  }

 private:
  bool pop(std::pair<std::size_t, Reply>& reply) {
    if (replies_.empty()) return false;
    reply = std::move(replies_.back());
    replies_.pop_back();
    --awaited_;
    return true;
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::pair<std::size_t, Reply>> replies_;
  std::size_t awaited_ = 0;
};

}  // namespace

void dealItems(const HelpedRegion& helpers, std::size_t count, const RunControl& control, Recorder& recorder,
               std::string_view name, const DealtWork& work) {
  const auto inbox = std::make_shared<Inbox>();
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> stop = false;
  const auto share = [&] {
    std::pair<std::size_t, Reply> reply;
    while (!stop) {
      if (control.cancelled && control.cancelled()) throw Cancelled();
      if (inbox->get(reply)) {
        work.take(reply.first, std::move(reply.second));
        continue;
      }
      const std::size_t i = next.fetch_add(1);
      if (i >= count) break;
      const int room = work.may_go(i) ? helpers.reserve() : -1;
      if (room < 0) {
        work.here(i);
        continue;
      }
      inbox->expect();
      helpers.send(room, work.request(i), [inbox, i](Reply&& answer) { inbox->put(i, std::move(answer)); });
    }
    while (inbox->await(reply, control, stop)) work.take(reply.first, std::move(reply.second));
  };
  recorder.forEach(name, static_cast<std::size_t>(threadCount()), {control.cancelled, {}}, [&](std::size_t) {
    try {
      share();
    } catch (...) {
      stop = true;
      throw;
    }
  });
}

void dealToOwners(const Helpers& helpers, std::span<const int> owners, const RunControl& control, const ItemLoop& loop,
                  const DealtWork& work) {
  const auto inbox = std::make_shared<Inbox>();
  std::vector<std::size_t> here;
  for (std::size_t i = 0; i < owners.size(); ++i) {
    if (owners[i] == 0) {
      here.push_back(i);
      continue;
    }
    inbox->expect();
    helpers.ask(owners[i], work.request(i), [inbox, i](Reply&& answer) { inbox->put(i, std::move(answer)); });
  }
  loop(here.size(), [&](std::size_t k) { work.here(here[k]); });
  const std::atomic<bool> stop = false;
  for (std::pair<std::size_t, Reply> reply; inbox->await(reply, control, stop);)
    work.take(reply.first, std::move(reply.second));
}

}  // namespace coastmesh
