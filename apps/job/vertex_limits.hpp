#pragma once

#include <cstdint>

#include "apps/job/group_task.hpp"

namespace coastmesh {

// The number of vertices above which a group is refused before it is meshed: `--max-vertices` by a factor that allows
// for errors of the estimate, or what there is memory for.
double mostVertices(const GroupTask& task, SurfaceKind surface);

// The number of vertices at which refinement stops because no more fit in memory.
std::uint64_t mostInMemory(const GroupTask& task, SurfaceKind surface);

// The area in the units in which lengths are measured: with coordinates used as they are, these are theirs, even if a
// CRS gives an area in square metres.
double areaAsMeasured(const Domain& domain, const GroupResult& result);

// If `--size-max` is only a bound, there is no map of sizes. The lower bound on vertices is then the number for
// equilateral triangles of that size. Throws TooManyVertices if these exceed the memory.
void requireMemory(const GroupTask& task, const Domain& domain, const GroupResult& result);

// Records why a group is not meshed.
void refuse(const TooManyVertices& error, const GroupTask& task, GroupResult& result);

}  // namespace coastmesh
