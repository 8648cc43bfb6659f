#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "cluster/transport.hpp"

namespace coastmesh {

// Carries messages to and from the other ranks, on a thread of its own: the only one that uses the transport.
class Post {
 public:
  // Returns when the ranks have joined. `command` stands for what this process was started with, which must be the same
  // on all ranks. Throws CannotJoin.
  Post(std::unique_ptr<Transport> (*join)(), int expected_ranks, std::uint64_t command);
  ~Post() { leave(); }
  Post(const Post&) = delete;
  Post& operator=(const Post&) = delete;

  int rank() const { return rank_; }
  int ranks() const { return ranks_; }
  const std::string& host() const { return host_; }
  std::uint64_t bytesMoved() const { return moved_; }

  // `take(message, from)` is called for each message from now on, from the post's thread; it must not throw.
  void listen(std::function<void(Message&&, int from)> take);
  // From any thread.
  void send(int to, Message message);
  void sendToOthers(const Message& message);
  // Both are the end. Sends what is still to be sent, and waits for all ranks to come here;
  void finish();
  // leaves at once.
  void leave();

 private:
  void run(std::unique_ptr<Transport> (*join)(), int expected_ranks, std::uint64_t command,
           const std::function<void(std::exception_ptr)>& joined);
  void carry(Transport& transport);

  int rank_ = 0, ranks_ = 1;
  std::string host_;
  std::atomic<std::uint64_t> moved_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::pair<int, Message>> outgoing_;
  std::function<void(Message&&, int)> take_;
  bool finishing_ = false, leaving_ = false;
  std::thread thread_;
};

}  // namespace coastmesh
