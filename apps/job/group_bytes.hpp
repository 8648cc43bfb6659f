#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "apps/job/group_task.hpp"

namespace coastmesh {

// A group's result as bytes, for one version of coastmesh: everything but the log, of which only the total work is
// kept.
std::string bytesOf(const GroupResult& result);
// The same, passed to `put` piece by piece.
void putBytesOf(const GroupResult& result, const std::function<void(std::string_view)>& put);
// Throws InputError if the bytes are damaged; `what` names them in the message.
GroupResult groupFrom(std::string_view bytes, const std::string& what);

}  // namespace coastmesh
