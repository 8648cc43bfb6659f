#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "apps/job/mesh_group.hpp"

namespace coastmesh {

// A group's result as bytes, for one version of coastmesh: everything except, in its log, only the work.
std::string bytesOf(const GroupResult& result);
// The same, passed on as they are made.
void putBytesOf(const GroupResult& result, const std::function<void(std::string_view)>& put);
// `what` names the bytes in the error if they are damaged; throws InputError.
GroupResult groupFrom(std::string_view bytes, const std::string& what);

}  // namespace coastmesh
