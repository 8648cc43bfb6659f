#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include "cluster/message.hpp"

namespace coastmesh {

// This process cannot work with those that it was started with: why, and what to do.
struct CannotJoin : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// How the processes of one run reach one another. All of it is called from the thread that made it.
class Transport {
 public:
  virtual ~Transport() = default;

  virtual int rank() const = 0;  // of this process, from 0
  virtual int ranks() const = 0;
  virtual std::string host() const = 0;
  virtual std::string library() const = 0;
  // Whether all ranks say the same: every rank has to call it.
  virtual bool agree(std::uint64_t what) = 0;

  // Returns at once; messages from one rank to another come in the order sent.
  virtual void send(int to, Message&& message) = 0;
  // Takes a message that has come; false where none has. `from` is who sent it.
  virtual bool receive(Message& message, int& from) = 0;
  // Goes on with what is on its way; true where nothing is.
  virtual bool isIdle() = 0;
  // Of all messages, sent and received.
  virtual std::uint64_t bytesMoved() const = 0;

  // Waits until all ranks have come here; nothing else may be called after it.
  virtual void finish() = 0;
  // Ends all ranks, this one too.
  [[noreturn]] virtual void abort(int exit_code) = 0;
};

// Joins the other processes that were started with this one. Which library does it is decided by what is linked: MPI
// (cluster/mpi), or none (cluster/alone). Throws CannotJoin.
std::unique_ptr<Transport> joinRanks();

}  // namespace coastmesh
