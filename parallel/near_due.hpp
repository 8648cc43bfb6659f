#pragma once

#include "core/bulk_list.hpp"
#include "core/item_loop.hpp"
#include "core/refine/submesh.hpp"

namespace coastmesh {

// The triangles that are due or have a due vertex, and those within `edges` edges of them; ascending.
BulkList<TriId> trianglesNearDue(const MeshState& whole, unsigned edges, const ItemLoop& loop);

}  // namespace coastmesh
