#include "parallel/near_due.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include "core/large_list.hpp"

namespace coastmesh {

namespace {

bool isDue(const MeshState& whole, TriId t) {
  if (!whole.due_triangles.empty() && whole.due_triangles[t]) return true;
  if (whole.due_vertices.empty()) return false;
  const auto& v = whole.mesh.triangle(t).v;
  return whole.due_vertices[v[0]] || whole.due_vertices[v[1]] || whole.due_vertices[v[2]];
}

// Concatenates lists, of most triangles of a large mesh.
BulkList<TriId> joinedOn(const ItemLoop& loop, const std::vector<std::vector<TriId>>& lists) {
  std::vector<std::size_t> before(lists.size() + 1, 0);
  for (std::size_t i = 0; i < lists.size(); ++i) before[i + 1] = before[i] + lists[i].size();
  BulkList<TriId> all = unsetList<TriId>(before.back());
  loop(lists.size(),
       [&](std::size_t i) { std::ranges::copy(lists[i], all.begin() + static_cast<std::ptrdiff_t>(before[i])); });
  return all;
}

}  // namespace

BulkList<TriId> trianglesNearDue(const MeshState& whole, unsigned edges, const ItemLoop& loop) {
  const std::size_t count = whole.mesh.triangles.size();
  BulkList<std::uint8_t> taken = filledList(loop, count, std::uint8_t{0});
  const auto stretchesOf = [&](const auto& take) {
    return joinedOn(loop, overStretches(loop, count, [&](std::size_t first, std::size_t last) {
                      std::vector<TriId> some;
                      for (std::size_t t = first; t < last; ++t)
                        if (take(static_cast<TriId>(t))) some.push_back(static_cast<TriId>(t));
                      return some;
                    }));
  };
  BulkList<TriId> front = stretchesOf([&](TriId t) { return (taken[t] = isDue(whole, t)) != 0; });
  for (unsigned edge = 0; edge < edges && !front.empty(); ++edge) {
    // The set does not depend on which thread reaches a triangle first.
    front = joinedOn(
        loop, overStretches(loop, front.size(), [&](std::size_t first, std::size_t last) {
          std::vector<TriId> next;
          for (std::size_t i = first; i < last; ++i)
            for (const EdgeRef twin : whole.mesh.triangle(front[i]).adj)
              if (twin != kNone && std::atomic_ref(taken[triOf(twin)]).exchange(1, std::memory_order_relaxed) == 0)
                next.push_back(triOf(twin));
          return next;
        }));
  }
  return stretchesOf([&](TriId t) { return taken[t] != 0; });
}

}  // namespace coastmesh
