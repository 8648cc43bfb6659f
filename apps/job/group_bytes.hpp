#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "apps/job/mesh_group.hpp"

namespace coastmesh {

// A group's result as bytes, for one version of coastmesh: all of it, but of its log the work alone.
std::string bytesOf(const GroupResult& result);
// The same, handed on as they are made.
void putBytesOf(const GroupResult& result, const std::function<void(std::string_view)>& put);
// `what` names the bytes where they are damaged; throws InputError.
GroupResult groupFrom(std::string_view bytes, const std::string& what);

}  // namespace coastmesh
