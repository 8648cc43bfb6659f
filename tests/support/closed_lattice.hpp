#pragma once

#include <span>

#include "core/sphere/close_sphere.hpp"
#include "core/sphere/sphere_lattice.hpp"
#include "core/sphere/sphere_place.hpp"
#include "core/tri_mesh.hpp"
#include "core/triangulate/delaunay.hpp"

namespace coastmesh {

// The cap around the pole of a lattice.
inline SphereCap latticeCap(std::span<const SpacePoint> places, const Surface& surface) {
  std::vector<Point> ring;
  for (const SpacePoint& p : places.subspan(kLatticePole, kLatticeRing)) ring.push_back(planeOf(p, surface));
  return sphereCap(surface, std::move(ring));
}

// The triangles of a closed lattice; the ring around the pole comes first, the pole last.
inline TriMesh closedLattice(const SphereLattice& lattice, const Surface& surface) {
  const std::vector<SpacePoint> places = placesOf(lattice);
  const SphereCap cap = latticeCap(places, surface);
  Pslg pslg;
  for (std::size_t i = kLatticePole; i < places.size(); ++i) pslg.points.push_back(planeOf(places[i], surface));
  const auto corners = static_cast<VertexId>(kLatticeRing);
  for (VertexId i = 0; i < corners; ++i) pslg.segments.push_back({i, (i + 1) % corners, 0, 0, kOutside});
  TriMesh mesh = constrainedDelaunay(pslg, surface);
  freezeRing(mesh, 0, cap);
  closeSphere(mesh, 0, cap);
  return mesh;
}

}  // namespace coastmesh
