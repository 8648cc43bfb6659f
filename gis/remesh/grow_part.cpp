#include "gis/remesh/grow_part.hpp"

#include <algorithm>

namespace coastmesh {

namespace {

// Takes in the triangles within reach for which `isWanted(t)`, judged by the flags before.
template <typename IsWanted>
std::size_t takeIn(const TriMesh& mesh, const std::vector<std::uint8_t>& reach, std::vector<std::uint8_t>& taken,
                   const ItemLoop& loop, const IsWanted& isWanted) {
  const std::vector<TriId> wanted =
      joined(overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
        std::vector<TriId> some;
        for (auto t = static_cast<TriId>(first); t < last; ++t)
          if (taken[t] == 0 && reach[t] != 0 && isWanted(t)) some.push_back(t);
        return some;
      }));
  for (const TriId t : wanted) taken[t] = 1;
  return wanted.size();
}

}  // namespace

std::vector<std::uint8_t> reachOf(const TriMesh& mesh, const std::vector<std::uint8_t>& taken, const ItemLoop& loop) {
  std::vector<std::uint8_t> at_node(mesh.points.size(), 0), reach(taken.size(), 0);
  for (std::size_t t = 0; t < taken.size(); ++t)
    if (taken[t] != 0)
      for (const VertexId v : mesh.triangles[t].v) at_node[v] = 1;
  forEachByStretches(loop, taken.size(), [&](std::size_t t) {
    reach[t] = std::ranges::any_of(mesh.triangles[t].v, [&](VertexId v) { return at_node[v] != 0; }) ? 1 : 0;
  });
  return reach;
}

std::size_t takeInSingle(const TriMesh& mesh, const std::vector<std::uint8_t>& reach, std::vector<std::uint8_t>& taken,
                         const ItemLoop& loop) {
  return takeIn(mesh, reach, taken, loop, [&](TriId t) {
    bool has_taken = false, has_other = false;
    for (const EdgeRef across : mesh.triangles[t].adj)
      if (across != kNone) (taken[triOf(across)] != 0 ? has_taken : has_other) = true;
    return has_taken && !has_other;
  });
}

std::size_t takeInAt(const TriMesh& mesh, const std::vector<std::uint8_t>& at_nodes,
                     const std::vector<std::uint8_t>& reach, std::vector<std::uint8_t>& taken, const ItemLoop& loop) {
  return takeIn(mesh, reach, taken, loop, [&](TriId t) {
    return std::ranges::any_of(mesh.triangles[t].v, [&](VertexId v) { return at_nodes[v] != 0; });
  });
}

}  // namespace coastmesh
