#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include "cluster/message.hpp"

namespace coastmesh {

// This process cannot join those it was started with; the message says why, and what to do.
struct CannotJoin : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Communication between the processes of a run. All functions are called from the thread that created it.
class Transport {
 public:
  virtual ~Transport() = default;

  virtual int rank() const = 0;  // of this process, from 0
  virtual int ranks() const = 0;
  virtual std::string host() const = 0;
  virtual std::string library() const = 0;
  // Returns whether all ranks pass the same value. Every rank must call it.
  virtual bool agree(std::uint64_t what) = 0;

  // Returns at once; messages from one rank to another arrive in the order sent.
  virtual void send(int to, Message&& message) = 0;
  // Takes a message that has arrived; false if there is none. `from` is its sender.
  virtual bool receive(Message& message, int& from) = 0;
  // Advances pending transfers; true if there are none.
  virtual bool isIdle() = 0;
  // Of all messages, sent and received.
  virtual std::uint64_t bytesMoved() const = 0;

  // Waits until all ranks have called it; nothing else may be called afterwards.
  virtual void finish() = 0;
  // Ends all ranks, including this one.
  [[noreturn]] virtual void abort(int exit_code) = 0;
};

// Joins the other processes that were started with this one. Implemented with MPI in cluster/mpi; a build without MPI
// links cluster/alone, which always throws. Throws CannotJoin.
std::unique_ptr<Transport> joinRanks();

}  // namespace coastmesh
