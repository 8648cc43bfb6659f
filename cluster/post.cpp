#include "cluster/post.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <future>
#include <memory>
#include <new>

namespace coastmesh {

namespace {

// Interval at which an idle post checks for messages: short at first, then longer.
constexpr auto kLeastPause = std::chrono::microseconds(20), kMostPause = std::chrono::microseconds(1000);
// Exit code if all ranks are ended for lack of memory: that of an input that is too large.
constexpr int kNoMemoryCode = 3, kBugCode = 70;

}  // namespace

Post::Post(std::unique_ptr<Transport> (*join)(), int expected_ranks, std::uint64_t command) {
  std::promise<void> promise;
  std::future<void> joined = promise.get_future();
  thread_ = std::thread([this, join, expected_ranks, command, &promise] {
    run(join, expected_ranks, command, [&promise](std::exception_ptr error) {
      error ? promise.set_exception(std::move(error)) : promise.set_value();
    });
  });
  try {
    joined.get();
  } catch (...) {
    thread_.join();
    throw;
  }
}

void Post::leave() {
  {
    const std::lock_guard lock(mutex_);
    leaving_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Post::listen(std::function<void(Message&&, int)> take) {
  const std::lock_guard lock(mutex_);
  take_ = std::move(take);
}

void Post::send(int to, Message message) {
  {
    const std::lock_guard lock(mutex_);
    outgoing_.emplace_back(to, std::move(message));
  }
  changed_.notify_all();
}

void Post::sendToOthers(const Message& message) {
  for (int to = 0; to < ranks_; ++to)
    if (to != rank_) send(to, message);
}

void Post::finish() {
  {
    const std::lock_guard lock(mutex_);
    finishing_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Post::run(std::unique_ptr<Transport> (*join)(), int expected_ranks, std::uint64_t command,
               const std::function<void(std::exception_ptr)>& joined) {
  std::unique_ptr<Transport> transport;
  try {
    transport = join();
    rank_ = transport->rank();
    ranks_ = transport->ranks();
    host_ = transport->host();
    std::string wrong;
    if (ranks_ != expected_ranks) {
      wrong = "this coastmesh was started as one of " + std::to_string(expected_ranks) +
              " ranks, by an MPI other than that which it was built with, " + transport->library() +
              ": start it with that one's mpirun";
    } else if (!transport->agree(command)) {
      wrong =
          "the ranks of this run were started with different commands: they make one mesh together; start others "
          "apart, or with --shard";
    }
    if (!wrong.empty()) {
      transport->finish();
      throw CannotJoin(wrong);
    }
  } catch (...) {
    joined(std::current_exception());
    return;
  }
  joined(nullptr);
  // After an error the run cannot make a mesh, and this thread has no caller to report to.
  try {
    carry(*transport);
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "coastmesh: error: rank %d on %s: there is not enough memory\n", rank_, host_.c_str());
    transport->abort(kNoMemoryCode);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "coastmesh: error: rank %d on %s: this is a bug in coastmesh, please report it: %s\n", rank_,
                 host_.c_str(), error.what());
    transport->abort(kBugCode);
  }
}

void Post::carry(Transport& transport) {
  std::chrono::microseconds pause = kLeastPause;
  std::vector<std::pair<int, Message>> leaving;
  std::function<void(Message&&, int)> take;
  std::unique_lock lock(mutex_);
  for (;;) {
    if (leaving_) return;
    leaving.swap(outgoing_);
    take = take_;
    const bool finishing = finishing_;
    lock.unlock();
    bool busy = !leaving.empty();
    for (auto& [to, message] : leaving) transport.send(to, std::move(message));
    leaving.clear();
    const bool idle = transport.isIdle();
    Message message;
    int from = 0;
    while (take && transport.receive(message, from)) {
      busy = true;
      take(std::move(message), from);
    }
    moved_ = transport.bytesMoved();
    lock.lock();
    if (finishing && idle && !busy && outgoing_.empty()) {
      lock.unlock();
      transport.finish();
      return;
    }
    pause = busy ? kLeastPause : std::min(kMostPause, 2 * pause);
    if (!busy && outgoing_.empty() && !leaving_) changed_.wait_for(lock, pause);
  }
}

}  // namespace coastmesh
