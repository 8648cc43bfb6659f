#include "core/links.hpp"

namespace coastmesh {

EdgeRef findBrokenLink(std::span<const Triangle> triangles) {
  for (TriId t = 0; t < triangles.size(); ++t) {
    const Triangle& own = triangles[t];
    if (own.v[0] == kNone) continue;
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef f = own.adj[i];
      if (f == kNone) continue;
      const unsigned j = indexOf(f);
      if (triOf(f) >= triangles.size() || j > 2) return edgeRef(t, i);
      const Triangle& other = triangles[triOf(f)];
      if (other.adj[j] != edgeRef(t, i) || other.seg[j] != own.seg[i] || other.v[next3(j)] != own.v[prev3(i)] ||
          other.v[prev3(j)] != own.v[next3(i)])
        return edgeRef(t, i);
    }
  }
  return kNone;
}

}  // namespace coastmesh
