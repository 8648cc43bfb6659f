#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/item_loop.hpp"
#include "core/run_control.hpp"
#include "parallel/recorder.hpp"

namespace coastmesh {

// A helper's reply: the result of a request, or why there is none.
struct Reply {
  enum class Outcome : std::uint8_t { Done, NoMemory, Failed, BadInput };
  Outcome outcome = Outcome::Done;
  std::string bytes;  // the reason, if it failed
};

// Totals of what helpers did so far.
struct HelpersUse {
  int ranks = 1;                   // processes that share in the work, this one included
  std::uint64_t pieces_dealt = 0;  // requests sent
  std::uint64_t bytes_moved = 0;   // of all messages, in both directions
  std::vector<double> peak_mib;    // memory of each rank at its last reply; unset for this process
};

// Helpers that take work. The creator decides who they are and how they are reached. All functions may be called from
// several threads.
struct Helpers {
  // Sends all helpers the shared context of a region's pieces (see piece_context); returns the region's number.
  std::function<std::uint32_t(std::string&& context)> begin;
  // No more requests for pieces of this region will follow.
  std::function<void(std::uint32_t region)> end;
  // Reserves room for one request with some helper, or returns a negative number if none has room. Reserved room must
  // be used.
  std::function<int()> reserve;
  // `take` is called once, from another thread, with the reply.
  std::function<void(int room, std::uint32_t region, std::string&& request, std::function<void(Reply&&)> take)> send;
  // Sends a request without a region to one of `ranks` - 1 helpers, numbered from 1; otherwise like `send`.
  std::function<void(int rank, std::string&& request, std::function<void(Reply&&)> take)> ask;
  std::function<HelpersUse()> use;
};

// Makes a region known to helpers for the lifetime of this object.
class HelpedRegion {
 public:
  HelpedRegion(const Helpers& helpers, std::string&& context)
      : helpers_(helpers), region_(helpers.begin(std::move(context))) {}
  ~HelpedRegion() { helpers_.end(region_); }
  HelpedRegion(const HelpedRegion&) = delete;
  HelpedRegion& operator=(const HelpedRegion&) = delete;

  int reserve() const { return helpers_.reserve(); }
  void send(int room, std::string&& request, std::function<void(Reply&&)>&& take) const {
    helpers_.send(room, region_, std::move(request), std::move(take));
  }

 private:
  const Helpers& helpers_;
  std::uint32_t region_;
};

// A helper failed to do what was requested, for lack of memory or another reason.
struct HelperFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};
struct HelperOutOfMemory : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// How items of work are processed, here and by helpers. The result for an item must not depend on where it is
// processed.
struct DealtWork {
  std::function<bool(std::size_t i)> may_go;          // true if the item may be sent; called first, once
  std::function<std::string(std::size_t i)> request;  // the request to send
  std::function<void(std::size_t i)> here;            // processes the item on this thread
  std::function<void(std::size_t i, Reply&&)> take;   // stores a reply; throws if it is not usable
};

// Processes every item below `count`, roughly in order: by helpers as long as they have room, otherwise by local
// threads. Throws what the work throws, and Cancelled.
void dealItems(const HelpedRegion& helpers, std::size_t count, const RunControl& control, Recorder& recorder,
               std::string_view name, const DealtWork& work);

// The same for items with an owner: 0 for items processed here, on the threads of `loop`, otherwise the rank of a
// helper. Does not call `work.may_go`.
void dealToOwners(const Helpers& helpers, std::span<const int> owners, const RunControl& control, const ItemLoop& loop,
                  const DealtWork& work);

}  // namespace coastmesh
