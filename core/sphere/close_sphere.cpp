#include "core/sphere/close_sphere.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/links.hpp"
#include "core/sphere/sphere_place.hpp"

namespace coastmesh {

namespace {

// So many diameters from the origin: of the Earth, less than a micrometre from the place meant.
constexpr double kFarAway = 1e14;

}  // namespace

SphereCap sphereCap(const Surface& surface, std::vector<Point> ring) {
  return {{kFarAway * 2.0 * surface.radius(), 0.0}, std::move(ring)};
}

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

bool facesOutwards(const Point& a, const Point& b, const Point& c, const Surface& surface) {
  constexpr double kFlattest = 1e-6;
  const SpacePoint p = placeOnSphere(a, surface), q = placeOnSphere(b, surface), r = placeOnSphere(c, surface);
  const SpacePoint pq = q - p, qr = r - q, rp = p - r;
  const double longest = std::max({dot(pq, pq), dot(qr, qr), dot(rp, rp)});
  return dot(cross(pq, qr), p + q + r) > 3.0 * kFlattest * longest;
}

}  // namespace coastmesh
