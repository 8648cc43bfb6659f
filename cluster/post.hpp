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

// Sends and receives messages, on its own thread: the only one that uses the transport.
class Post {
 public:
  // Returns when all ranks have joined. `command` is the command line of this process, which must be the same on all
  // ranks. Throws CannotJoin.
  Post(std::unique_ptr<Transport> (*join)(), int expected_ranks, std::uint64_t command);
  ~Post() { leave(); }
  Post(const Post&) = delete;
  Post& operator=(const Post&) = delete;

  int rank() const { return rank_; }
  int ranks() const { return ranks_; }
  const std::string& host() const { return host_; }
  std::uint64_t bytesMoved() const { return moved_; }

  // From now on `take(message, from)` is called for each message, on the post's thread; it must not throw.
  void listen(std::function<void(Message&&, int from)> take);
  // May be called from any thread.
  void send(int to, Message message);
  void sendToOthers(const Message& message);
  // Ends the post once all pending messages are sent and all ranks have called this.
  void finish();
  // Ends the post at once.
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
