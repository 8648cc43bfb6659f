#include "core/sphere/close_sphere.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/links.hpp"

namespace coastmesh {

namespace {

// Distance of the apex from the origin, in diameters: for the Earth, less than a micrometre from the pole.
constexpr double kFarAway = 1e14;

}  // namespace

Point antipodeOf(const Surface& surface) { return {kFarAway * 2.0 * surface.radius(), 0.0}; }

SphereCap sphereCap(const Surface& surface, std::vector<Point> ring) { return {antipodeOf(surface), std::move(ring)}; }

SphereCap sphereCap(const Surface& surface, double distance, unsigned corners) {
  const double diameter = 2.0 * surface.radius(), share = diameter / distance;
  const double from_origin = diameter * std::sqrt(share * share - 1.0);
  std::vector<Point> ring;
  constexpr double kTurn = 0.2;  // radians: no corner on an axis
  for (unsigned i = 0; i < corners; ++i) {
    const double angle = kTurn + 2.0 * std::numbers::pi * i / corners;
    ring.push_back({from_origin * std::cos(angle), from_origin * std::sin(angle)});
  }
  return sphereCap(surface, std::move(ring));
}

void freezeRing(TriMesh& mesh, VertexId first, const SphereCap& cap) {
  const auto corners = static_cast<VertexId>(cap.ring.size());
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (mesh.twin(e) != kNone || mesh.origin(e) - first >= corners || mesh.target(e) - first >= corners) continue;
      setSegment(mesh.triangles, e, kFrozen);
    }
  }
}

void closeSphere(TriMesh& mesh, VertexId first, const SphereCap& cap) {
  const auto corners = static_cast<VertexId>(cap.ring.size());
  const auto apex = static_cast<VertexId>(mesh.points.size());
  const auto next = static_cast<TriId>(mesh.triangles.size());
  std::vector<EdgeRef> beyond(corners, kNone);
  for (TriId t = 0; t < next; ++t)
    for (unsigned i = 0; i < 3; ++i)
      if (const EdgeRef e = edgeRef(t, i); mesh.segment(e) == kFrozen) {
        assert(mesh.twin(e) == kNone && mesh.origin(e) - first < corners);
        beyond[mesh.origin(e) - first] = e;
      }
  mesh.points.push_back(cap.apex);
  for (VertexId i = 0; i < corners; ++i) {
    const VertexId from = first + i, to = first + (i + 1) % corners;
    mesh.triangles.push_back(unlinked({apex, to, from}));
    link(mesh.triangles, edgeRef(next + i, 0), beyond[i], kNone);
    if (!mesh.regions.empty()) mesh.regions.push_back(mesh.regions[triOf(beyond[i])]);
  }
  for (VertexId i = 0; i < corners; ++i)
    setTwins(mesh.triangles, edgeRef(next + i, 2), edgeRef(next + (i + 1) % corners, 1));
  assert(findBrokenLink(mesh.triangles) == kNone);
}

bool isClosed(const TriMesh& mesh) {
  return !mesh.triangles.empty() && std::ranges::none_of(mesh.triangles, [](const Triangle& t) {
    return t.adj[0] == kNone || t.adj[1] == kNone || t.adj[2] == kNone;
  });
}

std::int64_t eulerNumber(const TriMesh& mesh) {
  const BulkList<std::uint8_t> used = usedVertices(mesh);
  std::int64_t halves = 0;  // half-edges; a boundary edge counts as two
  for (const Triangle& t : mesh.triangles)
    for (const EdgeRef twin : t.adj) halves += twin == kNone ? 2 : 1;
  return std::ranges::count(used, std::uint8_t{1}) - halves / 2 + static_cast<std::int64_t>(mesh.triangles.size());
}

}  // namespace coastmesh
