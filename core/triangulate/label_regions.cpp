#include "core/triangulate/label_regions.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/triangulate/delaunay.hpp"

namespace coastmesh {

namespace {

// The region of all triangles if segments name at most one (0 if none); kUnlabelled if they name several.
RegionId onlyRegion(const Pslg& pslg) {
  RegionId only = kUnlabelled;
  for (const Segment& s : pslg.segments) {
    for (const RegionId side : {s.left, s.right}) {
      if (side < 0 || side == only) continue;
      if (only != kUnlabelled) return kUnlabelled;
      only = side;
    }
  }
  return only == kUnlabelled ? 0 : only;
}

}  // namespace

void labelRegions(TriMesh& mesh, const Pslg& pslg, const ItemLoop& loop) {
  const RegionId only = onlyRegion(pslg);
  resizeUnset(mesh.regions, mesh.triangles.size());
  forEachByStretches(loop, mesh.regions.size(), [&](std::size_t t) { mesh.regions[t] = only; });
  if (mesh.regions.empty() || mesh.regions.front() != kUnlabelled) return;
  std::vector<TriId> stack;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.regions[t] != kUnlabelled) continue;
    for (unsigned i = 0; i < 3 && mesh.regions[t] == kUnlabelled; ++i) {
      const SegmentId s = mesh.triangles[t].seg[i];
      if (s >= pslg.segments.size()) continue;  // none, or frozen
      const Segment& segment = pslg.segments[s];
      // Subsegments run along their segment or against it, decided by the longer difference alone, since products
      // underflow.
      const Point &a = pslg.points[segment.a], &b = pslg.points[segment.b];
      const Point &from = mesh.points[mesh.origin(edgeRef(t, i))], &to = mesh.points[mesh.target(edgeRef(t, i))];
      const bool by_x = std::abs(b.x - a.x) >= std::abs(b.y - a.y);
      const bool along = by_x ? (b.x > a.x) == (to.x > from.x) : (b.y > a.y) == (to.y > from.y);
      mesh.regions[t] = along ? segment.left : segment.right;
    }
    if (mesh.regions[t] == kUnlabelled) continue;
    stack.push_back(t);
    while (!stack.empty()) {
      const TriId here = stack.back();
      stack.pop_back();
      for (unsigned i = 0; i < 3; ++i) {
        const Triangle& tri = mesh.triangles[here];
        if (tri.seg[i] != kNone || tri.adj[i] == kNone || mesh.regions[triOf(tri.adj[i])] != kUnlabelled) continue;
        mesh.regions[triOf(tri.adj[i])] = mesh.regions[here];
        stack.push_back(triOf(tri.adj[i]));
      }
    }
  }
  std::ranges::replace(mesh.regions, kUnlabelled, 0);
}

bool hasRegions(const Pslg& pslg) {
  return std::ranges::any_of(pslg.segments, [](const Segment& s) { return s.left >= 0 || s.right >= 0; });
}

void labelSegments(Pslg& pslg) {
  const auto isLabelled = [](const Segment& s) { return s.left != kUnlabelled || s.right != kUnlabelled; };
  if (pslg.segments.empty() || std::ranges::any_of(pslg.segments, isLabelled)) return;
  const TriMesh mesh = constrainedDelaunay(pslg);
  for (Segment& s : pslg.segments) s.left = s.right = kOutside;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (mesh.segment(e) == kNone) continue;
      Segment& s = pslg.segments[mesh.segment(e)];
      auto& side = mesh.origin(e) == s.a ? s.left : s.right;
      side = mesh.regions[t];
    }
  }
  pslg.holes.clear();
}

}  // namespace coastmesh
