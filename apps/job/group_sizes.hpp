#pragma once

#include <memory>

#include "apps/job/group_task.hpp"

namespace coastmesh {

// The options for coasts that follow sizes.
FollowOptions followOptionsOf(const MeshJob& job);

// The sizes of a group's domain; with --coast follow, also coarsens the domain accordingly. Null if no sizes are
// requested. Throws TooManyVertices if they require many more vertices than there is room for.
std::unique_ptr<SizeFunction> sizeStage(const GroupTask& task, Domain& domain, GroupResult& result);

}  // namespace coastmesh
