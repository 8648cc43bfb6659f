#include "core/tri_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <utility>

namespace coastmesh {

TriMesh linkTriangles(std::vector<Point> points, std::span<const std::array<VertexId, 3>> corners,
                      std::vector<EdgeConflict>& conflicts) {
  TriMesh mesh;
  mesh.points = std::move(points);
  mesh.triangles.resize(corners.size());
  mesh.regions.assign(corners.size(), 0);

  // Edges in buckets by their origin, so that a twin is found among the few edges that leave the target.
  std::vector<std::uint32_t> first(mesh.points.size() + 1, 0);
  for (const auto& c : corners)
    for (VertexId v : c) ++first[v + 1];
  for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
  std::vector<EdgeRef> leaving(3 * corners.size());
  std::vector<std::uint32_t> fill(first.begin(), first.end() - 1);
  for (TriId t = 0; t < corners.size(); ++t) {
    mesh.triangles[t].v = corners[t];
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      leaving[fill[mesh.origin(e)]++] = e;
    }
  }

  for (TriId t = 0; t < corners.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      const VertexId a = mesh.origin(e), b = mesh.target(e);
      const auto from = [&](VertexId v) { return std::span(leaving).subspan(first[v], first[v + 1] - first[v]); };
      const auto claims = std::ranges::count_if(from(a), [&](EdgeRef f) { return mesh.target(f) == b; });
      EdgeRef twin = kNone;
      std::size_t twins = 0;
      for (EdgeRef f : from(b)) {
        if (mesh.target(f) != a) continue;
        twin = f;
        ++twins;
      }
      if (a == b || claims > 1 || twins > 1) {
        if (a <= b || twins == 0) conflicts.push_back({a, b});
      } else if (twins == 1) {
        mesh.triangles[t].adj[i] = twin;
      }
    }
  }
  // Where one side of an edge was refused, the other must not point there.
  for (TriId t = 0; t < corners.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef twin = mesh.triangles[t].adj[i];
      if (twin != kNone && mesh.twin(twin) != edgeRef(t, i)) mesh.triangles[t].adj[i] = kNone;
    }
  }
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

// The rim edge that follows `e` with the same fan of triangles between them.
EdgeRef nextOnRim(const TriMesh& mesh, EdgeRef e) {
  EdgeRef f = nextInTriangle(e);
  while (mesh.twin(f) != kNone) f = nextInTriangle(mesh.twin(f));
  return f;
}

}  // namespace

std::vector<std::vector<VertexId>> rimLoops(const TriMesh& mesh) {
  std::vector<std::vector<VertexId>> loops;
  std::vector<bool> seen(4 * mesh.triangles.size(), false);
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef start = edgeRef(t, i);
      if (mesh.twin(start) != kNone || seen[start]) continue;
      std::vector<VertexId> loop;
      for (EdgeRef e = start; !seen[e]; e = nextOnRim(mesh, e)) {
        seen[e] = true;
        loop.push_back(mesh.origin(e));
      }
      const auto less = [&](VertexId a, VertexId b) { return lexLess(mesh.points[a], mesh.points[b]); };
      std::ranges::rotate(loop, std::ranges::min_element(loop, less));
      loops.push_back(std::move(loop));
    }
  }
  std::ranges::stable_sort(
      loops, [&](const auto& a, const auto& b) { return lexLess(mesh.points[a.front()], mesh.points[b.front()]); });
  return loops;
}

std::uint64_t digestOf(const TriMesh& mesh, std::uint64_t seed) {
  // Multiply and rotate a word at a time; the constants are odd fractions of the golden ratio and of pi.
  std::uint64_t h = seed ^ 0x9E3779B97F4A7C15ull;
  const auto mix = [&h](std::uint64_t word) {
    h = std::rotl((h ^ word) * 0xC90FDAA22168C235ull, 29);
    h ^= h >> 32;
  };
  mix(mesh.points.size());
  for (const Point& p : mesh.points) {
    mix(std::bit_cast<std::uint64_t>(p.x));
    mix(std::bit_cast<std::uint64_t>(p.y));
  }
  mix(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    mix(std::uint64_t{t.v[0]} << 32 | t.v[1]);
    mix(t.v[2]);
  }
  return h;
}

}  // namespace coastmesh
