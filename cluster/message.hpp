#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace coastmesh {

// Messages between ranks. Rank 0 sends requests, the others reply.
struct Message {
  enum class Kind : std::uint64_t {
    Start,    // to all: begin, with `number` threads, or if 0 with as many as there are cores
    Ready,    // from a rank: it works with `number` threads, `region` as of Reply
    Begin,    // to all: `bytes` are the shared context of the pieces of `region`
    Request,  // one piece of `region`, with a unique `number`
    Ask,      // a request without a region, with a unique `number`
    Reply,    // to the request of that number; `outcome` is the type of `bytes`, `region` the rank's memory, KiB
    End,      // to all: no more of `region`
    Stop,     // to all: the run is done
    Gone,     // from a rank, to Stop: it sends nothing more
  };
  Kind kind = Kind::Stop;
  std::uint64_t region = 0, number = 0, outcome = 0;
  std::shared_ptr<const std::string> bytes;  // shared if sent to several ranks; null: none
};

}  // namespace coastmesh
