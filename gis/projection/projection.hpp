#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "core/space_point.hpp"
#include "core/surface.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/crs/crs.hpp"
#include "gis/projection/surface_kind.hpp"

namespace coastmesh {

struct ProjectionMap;  // implementation of a Projection: see projection_map.hpp

// The places on the ground of points of the plane, one item for each point.
struct GroundPlaces {
  std::vector<Point> input;       // like `Projection::inverse`
  std::vector<SpacePoint> space;  // metres from the centre of the ellipsoid
  std::vector<double> measure;    // like `Projection::measureAt`, to a few units in the last place

  bool empty() const { return space.empty(); }
};

// A map between the input's coordinates and the working plane, in metres if the input is on Earth. Conformal unless the
// user chose a CRS that is not. Cheap to copy; usable from several threads at once.
class Projection {
 public:
  // The identity: coordinates are plane already (a CRS-less input, `--crs plane`).
  static Projection plane();
  // A conformal projection fitted to the extent of `features[members]`, on the ellipsoid of `crs`: transverse Mercator,
  // Lambert conformal conic, polar or oblique stereographic. Handles the antimeridian and the poles. The identity if
  // `crs` is a plane. Throws InputError for a point that is not on Earth, a group without points, and a group larger
  // than a hemisphere that leaves no area out. If `kind` requires a surface the projection is stereographic, and
  // `surface` is its sphere. The same holds for a whole globe and any `kind`: it is projected from a place that is far
  // from all features, and in none.
  static Projection fitted(const Coastline& coastline, const std::vector<std::size_t>& members,
                           SurfaceKind kind = SurfaceKind::Plane);
  // The same for each of many groups; common work is done once.
  static std::vector<Projection> fittedEach(const Coastline& coastline,
                                            const std::vector<std::vector<std::size_t>>& groups,
                                            SurfaceKind kind = SurfaceKind::Plane);
  // The user's CRS. Throws InputError if no transformation exists.
  static Projection to(const Crs& input, const Crs& working);

  Point forward(const Point& input) const;
  Point inverse(const Point& plane) const;
  // Plane length over true length on the ellipsoid at a place of the plane. 1 for `plane()`.
  double scaleAt(const Point& plane) const;
  // The surface on which lengths and angles are measured: a sphere that represents the ellipsoid, or the plane.
  Surface surface() const;
  // Length on that surface over length on the ellipsoid at a place of the plane: near 1 on a sphere, `scaleAt` in the
  // plane.
  double measureAt(const Point& plane) const;
  // Points of the plane on the ground; empty if the plane itself is the surface.
  GroundPlaces groundPlaces(std::span<const Point> plane, const ItemLoop& loop = inOrder) const;
  // Side of a square of the plane, in its units, over which a polynomial of degree five in either coordinate is as good
  // as the map for most places; 0 if unknown.
  double smoothOver() const;
  // The place, in the input's CRS, that maps to infinity, if the map shows all others and that CRS is geographic.
  std::optional<Point> infinity() const;
  bool isIdentity() const;                 // of `plane()`
  bool mayTear() const;                    // of a user's CRS: places that touch may be far apart in the plane
  const std::string& reason() const;       // why it was chosen, for messages; empty if it was not
  const std::string& description() const;  // for people: "transverse Mercator, central meridian -87.5°"

 private:
  explicit Projection(std::shared_ptr<const ProjectionMap> impl);
  std::shared_ptr<const ProjectionMap> impl_;
};

}  // namespace coastmesh
