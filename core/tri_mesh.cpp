#include "core/tri_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/large_list.hpp"
#include "core/links.hpp"

namespace coastmesh {

TriMesh linkTriangles(BulkList<Point> points, std::span<const std::array<VertexId, 3>> corners,
                      std::vector<EdgeConflict>& conflicts, const ItemLoop& loop) {
  TriMesh mesh;
  mesh.points = std::move(points);
  resizeUnset(mesh.triangles, corners.size());
  resizeUnset(mesh.regions, corners.size());

  // The edges that leave each vertex in a list. Threads prepend edges in any order, on which nothing below depends.
  BulkList<EdgeRef> first = noNumbers(loop, mesh.points.size()), next;
  resizeUnset(next, 3 * corners.size());
  const auto nextOf = [&](EdgeRef e) -> EdgeRef& { return next[3 * std::size_t{triOf(e)} + indexOf(e)]; };
  forEachByStretches(loop, corners.size(), [&](std::size_t t) {
    mesh.triangles[t] = unlinked(corners[t]);
    mesh.regions[t] = 0;
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(static_cast<TriId>(t), i);
      nextOf(e) = __atomic_exchange_n(&first[mesh.origin(e)], e, __ATOMIC_RELAXED);
    }
  });

  // How many edges lead from `from` to `to`, and one of them.
  const auto edgesTo = [&](VertexId from, VertexId to) {
    std::pair<std::size_t, EdgeRef> found{0, kNone};
    for (EdgeRef e = first[from]; e != kNone; e = nextOf(e))
      if (mesh.target(e) == to) found = {found.first + 1, e};
    return found;
  };
  // Links both sides of the edges whose lower end is `a`; adds those to `rejected` that claim what others claim.
  const auto linkFrom = [&](VertexId a, std::vector<EdgeRef>& rejected) {
    for (EdgeRef e = first[a]; e != kNone; e = nextOf(e)) {
      const VertexId b = mesh.target(e);
      const std::size_t claims = edgesTo(a, b).first;
      if (b < a && claims == 1) continue;
      const auto [returning, twin] = edgesTo(b, a);
      if (a == b || claims > 1 || returning > 1) {
        if (a <= b || returning == 0) rejected.push_back(e);
      } else if (returning == 1) {
        setTwins(mesh.triangles, e, twin);
      }
    }
  };
  std::vector<EdgeRef> rejected =
      joined(overStretches(loop, mesh.points.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<EdgeRef> here;
        for (auto a = static_cast<VertexId>(begin); a < end; ++a) linkFrom(a, here);
        return here;
      }));
  std::ranges::sort(rejected);
  for (const EdgeRef e : rejected) conflicts.push_back({mesh.origin(e), mesh.target(e)});
  return mesh;
}

std::vector<EdgeRef> outgoingEdges(const TriMesh& mesh) {
  std::vector<EdgeRef> out(mesh.points.size(), kNone);
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      EdgeRef& slot = out[mesh.origin(e)];
      if (slot == kNone || (mesh.twin(slot) != kNone && mesh.twin(e) == kNone)) slot = e;
    }
  }
  return out;
}

namespace {

EdgeRef nextInTriangle(EdgeRef e) { return edgeRef(triOf(e), next3(indexOf(e))); }

// The boundary edge that follows `e` around the same fan of triangles.
EdgeRef nextOnBoundary(const TriMesh& mesh, EdgeRef e) {
  EdgeRef f = nextInTriangle(e);
  while (mesh.twin(f) != kNone) f = nextInTriangle(mesh.twin(f));
  return f;
}

// For each edge of `boundary`, which is ascending, the index there of the edge that follows it.
std::vector<std::uint32_t> followersOf(const TriMesh& mesh, std::span<const EdgeRef> boundary, const ItemLoop& loop) {
  constexpr std::uint32_t kSeveral = kNone - 1;
  BulkList<std::uint32_t> leaving = noNumbers(loop, mesh.points.size());
  forEachByStretches(loop, boundary.size(), [&](std::size_t i) {
    std::uint32_t none = kNone;
    std::uint32_t& slot = leaving[mesh.origin(boundary[i])];
    if (!__atomic_compare_exchange_n(&slot, &none, static_cast<std::uint32_t>(i), false, __ATOMIC_RELAXED,
                                     __ATOMIC_RELAXED))
      __atomic_store_n(&slot, kSeveral, __ATOMIC_RELAXED);
  });
  std::vector<std::uint32_t> followers(boundary.size());
  forEachByStretches(loop, boundary.size(), [&](std::size_t i) {
    followers[i] = leaving[mesh.target(boundary[i])];
    if (followers[i] == kSeveral)
      followers[i] = static_cast<std::uint32_t>(std::ranges::lower_bound(boundary, nextOnBoundary(mesh, boundary[i])) -
                                                boundary.begin());
  });
  return followers;
}

}  // namespace

std::vector<std::vector<VertexId>> boundaryLoops(const TriMesh& mesh, const ItemLoop& loop) {
  const std::vector<EdgeRef> boundary =
      joined(overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
        std::vector<EdgeRef> edges;
        for (auto t = static_cast<TriId>(first); t < last; ++t)
          for (unsigned i = 0; i < 3; ++i)
            if (mesh.triangles[t].adj[i] == kNone) edges.push_back(edgeRef(t, i));
        return edges;
      }));
  const std::vector<std::uint32_t> followers = followersOf(mesh, boundary, loop);
  // What one thread reads in the order of the loops is collected before, by all.
  std::vector<VertexId> vertices(boundary.size());
  std::vector<Point> places(boundary.size());
  forEachByStretches(loop, boundary.size(), [&](std::size_t i) {
    vertices[i] = mesh.origin(boundary[i]);
    places[i] = mesh.points[vertices[i]];
  });
  std::vector<std::vector<std::uint32_t>> loops;  // of edges, then of vertices
  std::vector<bool> seen(boundary.size(), false);
  for (std::size_t start = 0; start < boundary.size(); ++start) {
    if (seen[start]) continue;
    std::vector<std::uint32_t> edges;
    for (std::size_t at = start; !seen[at]; at = followers[at]) {
      seen[at] = true;
      edges.push_back(static_cast<std::uint32_t>(at));
    }
    loops.push_back(std::move(edges));
  }
  const auto less = [&](std::uint32_t a, std::uint32_t b) { return lexLess(places[a], places[b]); };
  const auto begin = [&](std::size_t first, std::size_t last) {
    for (std::vector<std::uint32_t>& edges : std::span(loops).subspan(first, last - first))
      std::ranges::rotate(edges, std::ranges::min_element(edges, less));
  };
  constexpr std::size_t kWorthAStretch = 4;  // some loops are very long
  forStretches(loop, loops.size(), begin, kWorthAStretch);
  std::ranges::stable_sort(loops, less, [](const auto& each) { return each.front(); });
  const auto name = [&](std::size_t first, std::size_t last) {
    for (std::vector<std::uint32_t>& each : std::span(loops).subspan(first, last - first))
      for (std::uint32_t& i : each) i = vertices[i];
  };
  forStretches(loop, loops.size(), name, kWorthAStretch);
  return loops;
}

BulkList<std::uint8_t> usedVertices(const TriMesh& mesh, const ItemLoop& loop) {
  BulkList<std::uint8_t> used = filledList(loop, mesh.points.size(), std::uint8_t{0});
  forEachByStretches(loop, mesh.triangles.size(), [&](std::size_t t) {
    // Several threads may set the flag of a vertex at the same time.
    for (const VertexId v : mesh.triangles[t].v) __atomic_store_n(&used[v], std::uint8_t{1}, __ATOMIC_RELAXED);
  });
  return used;
}

namespace {

// Multiplies and rotates a word at a time; the constants are odd fractions of the golden ratio and of pi.
struct Hash {
  std::uint64_t value;

  explicit Hash(std::uint64_t seed) : value(seed ^ 0x9E3779B97F4A7C15ull) {}
  void mix(std::uint64_t word) {
    value = std::rotl((value ^ word) * 0xC90FDAA22168C235ull, 29);
    value ^= value >> 32;
  }
};

}  // namespace

std::uint64_t digestOf(const TriMesh& mesh, std::uint64_t seed, const ItemLoop& loop) {
  Hash whole(seed);
  whole.mix(mesh.points.size());
  for (const std::uint64_t part : overStretches(loop, mesh.points.size(), [&](std::size_t first, std::size_t last) {
         Hash hash(0);
         for (std::size_t v = first; v < last; ++v) {
           hash.mix(std::bit_cast<std::uint64_t>(mesh.points[v].x));
           hash.mix(std::bit_cast<std::uint64_t>(mesh.points[v].y));
         }
         return hash.value;
       }))
    whole.mix(part);
  whole.mix(mesh.triangles.size());
  for (const std::uint64_t part : overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
         Hash hash(0);
         for (std::size_t t = first; t < last; ++t) {
           const auto& v = mesh.triangles[t].v;
           hash.mix(std::uint64_t{v[0]} << 32 | v[1]);
           hash.mix(v[2]);
         }
         return hash.value;
       }))
    whole.mix(part);
  return whole.value;
}

}  // namespace coastmesh
