#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "gis/crs/crs.hpp"
#include "gis/crs/lon_lat.hpp"

namespace coastmesh {

// True if such a place exists: longitudes within ±540, which covers -180 to 180, 0 to 360, and some overlap, and
// latitudes within ±90.
bool isOnEarth(const LonLat& place);

// Throws InputError with `path`, the number of the node, and its place, if a node has no place on the ellipsoid of the
// grid's CRS. Otherwise it can be measured, projected, and read back from any output.
void requirePlaces(std::span<const Point> nodes, const Crs& crs, const std::string& path);

// Areas of triangles on the ellipsoid of `crs`, edges geodesic, in square metres; positive for counter-clockwise ones.
// In a plane: the plane's area in its own units. The sum over a mesh is its geodesic area to better than one part in
// ten million. Throws InputError if a node has no place on the ellipsoid.
BulkList<double> triangleAreas(std::span<const Point> nodes, std::span<const std::array<std::uint32_t, 3>> triangles,
                               const Crs& crs, const ItemLoop& loop = inOrder);
// The same for a few triangles among many nodes: only their nodes are used.
std::vector<double> areasOfFew(std::span<const Point> nodes, std::span<const std::array<std::uint32_t, 3>> triangles,
                               const Crs& crs, const ItemLoop& loop = inOrder);

// Measures edges between nodes, which must outlive it: in metres on the ellipsoid of `crs`, with a relative error of
// 1e-6 up to 250 km and 1.4e-5 at 1000 km; in a plane: in its units. Throws InputError like `triangleAreas`.
class EdgeMeter {
 public:
  EdgeMeter(std::span<const Point> nodes, const Crs& crs, const ItemLoop& loop = inOrder);

  double between(std::uint32_t a, std::uint32_t b) const;
  // First to second corner of a triangle, second to third, third to first.
  std::array<double, 3> of(const std::array<std::uint32_t, 3>& corners) const {
    return {between(corners[0], corners[1]), between(corners[1], corners[2]), between(corners[2], corners[0])};
  }
  // The shortest of these; faster than measuring all three.
  double shortestOf(const std::array<std::uint32_t, 3>& corners) const;

 private:
  std::span<const Point> nodes_;
  double diameter_ = 0.0;                                  // twice the semi-major axis
  std::unique_ptr<const std::array<double, 3>[]> places_;  // of the nodes, Earth-centred; null in a plane
};

// The edges of all triangles, measured by `EdgeMeter::of`.
std::vector<std::array<double, 3>> edgeLengths(std::span<const Point> nodes,
                                               std::span<const std::array<std::uint32_t, 3>> triangles, const Crs& crs);

// Length of each chain of points in metres along geodesics (in a plane: in its units).
std::vector<double> chainLengths(const std::vector<std::vector<Point>>& chains, const Crs& crs,
                                 const ItemLoop& loop = inOrder);

}  // namespace coastmesh
