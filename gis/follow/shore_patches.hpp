#pragma once

#include <cstddef>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Sets of triangles that are connected by edges.
struct Patches {
  std::vector<std::uint32_t> of;  // patch of each triangle, or kNone
  std::vector<std::vector<TriId>> triangles;
};

template <typename In>
Patches patchesOf(const TriMesh& mesh, In&& in) {
  Patches patches;
  patches.of.assign(mesh.triangles.size(), kNone);
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    if (patches.of[t] != kNone || !in(t)) continue;
    const auto number = static_cast<std::uint32_t>(patches.triangles.size());
    std::vector<TriId>& patch = patches.triangles.emplace_back(1, t);
    patches.of[t] = number;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (const EdgeRef e : mesh.triangles[patch[i]].adj) {
        if (e == kNone || patches.of[triOf(e)] != kNone || !in(triOf(e))) continue;
        patches.of[triOf(e)] = number;
        patch.push_back(triOf(e));
      }
    }
  }
  return patches;
}

}  // namespace coastmesh
