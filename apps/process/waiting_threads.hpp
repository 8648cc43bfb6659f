#pragma once

#include <cstddef>
#include <functional>

namespace coastmesh {

// An ItemLoop for work that does little but wait for the disk: uses more threads than there are cores, none for a few
// items. It may be called with a lock held, as its threads do no other work. `work` must not throw.
void onWaitingThreads(std::size_t count, const std::function<void(std::size_t)>& work);

}  // namespace coastmesh
