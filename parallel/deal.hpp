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

// What a helper sends back: the answer to a request, or why there is none.
struct Reply {
  enum class Outcome : std::uint8_t { Done, NoMemory, Failed, BadInput };
  Outcome outcome = Outcome::Done;
  std::string bytes;  // what failed, where it did
};

// What helpers did so far.
struct HelpersUse {
  int ranks = 1;                   // processes that share in the work, this one included
  std::uint64_t pieces_dealt = 0;  // requests sent
  std::uint64_t bytes_moved = 0;   // of all messages, in both directions
  std::vector<double> peak_mib;    // memory of each rank when it was last heard of; not known of this process
};

// Others who take work: who they are, and how they are reached, is known to whoever made this. All functions may be
// called from several threads.
struct Helpers {
  // Tells all helpers what pieces of a region share (see piece_context); gives the region's number.
  std::function<std::uint32_t(std::string&& context)> begin;
  // No more requests for pieces of a region follow.
  std::function<void(std::uint32_t region)> end;
  // Gives room for one request with some helper, or a number below 0 where nobody has any. Room that was given has to
  // be used.
  std::function<int()> reserve;
  // `take` is called once, from another thread, with the reply.
  std::function<void(int room, std::uint32_t region, std::string&& request, std::function<void(Reply&&)> take)> send;
  // Asks one of `ranks` - 1 helpers, from 1 on, for something that has nothing to do with a region; as `send` else.
  std::function<void(int rank, std::string&& request, std::function<void(Reply&&)> take)> ask;
  std::function<HelpersUse()> use;
};

// A region that helpers know of for as long as this lives.
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

// A helper could not do what it was asked for; or not for want of memory.
struct HelperFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};
struct HelperOutOfMemory : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// How items of work are done here, and by others. What is made of an item must be the same wherever it is done.
struct DealtWork {
  std::function<bool(std::size_t i)> may_go;          // whether it is worth sending; called first, once
  std::function<std::string(std::size_t i)> request;  // what is sent
  std::function<void(std::size_t i)> here;            // does it on this thread
  std::function<void(std::size_t i, Reply&&)> take;   // keeps a reply; throws where it is of no use
};

// Gets every item below `count` done, in about their order: by helpers as far as they have room, else by the threads at
// hand. Throws what the work throws, and Cancelled.
void dealItems(const HelpedRegion& helpers, std::size_t count, const RunControl& control, Recorder& recorder,
               std::string_view name, const DealtWork& work);

// The same for items each of which has an owner: 0, whose items are done here, on the threads that `loop` lends, or a
// helper. What `work` says of going is not asked.
void dealToOwners(const Helpers& helpers, std::span<const int> owners, const RunControl& control, const ItemLoop& loop,
                  const DealtWork& work);

}  // namespace coastmesh
