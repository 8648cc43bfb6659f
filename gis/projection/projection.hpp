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

struct ProjectionMap;  // what stands behind a Projection: see projection_map.hpp

// Places of a plane that stands for the Earth, one item each.
struct GroundPlaces {
  std::vector<Point> input;       // as `Projection::inverse`
  std::vector<SpacePoint> space;  // metres from the middle of the ellipsoid
  std::vector<double> measure;    // as `Projection::measureAt`, to a few units of the last place

  bool empty() const { return space.empty(); }
};

// A map between the input's coordinates and the working plane, in metres where the input lies on Earth. Conformal
// unless the user chose a CRS that is not. Cheap to copy; usable from several threads at once.
class Projection {
 public:
  // The identity: coordinates are plane already (a CRS-less input, `--crs plane`).
  static Projection plane();
  // A conformal projection fitted to the extent of `features[members]`, on the ellipsoid of `crs`: transverse Mercator,
  // Lambert conformal conic, polar or oblique stereographic. Crosses the antimeridian and the poles unharmed. The plane
  // for a plane. Throws InputError for a point that is no place on Earth and for a group that leaves no land out.
  // Where `kind` asks for a surface the projection is stereographic, and `surface` says which sphere it is of. So it is
  // for a whole globe, whatever `kind` says: away from a place that lies far from all features, and in none.
  static Projection fitted(const Coastline& coastline, const std::vector<std::size_t>& members,
                           SurfaceKind kind = SurfaceKind::Plane);
  // The same for each of many groups; what they have in common is done once.
  static std::vector<Projection> fittedEach(const Coastline& coastline,
                                            const std::vector<std::vector<std::size_t>>& groups,
                                            SurfaceKind kind = SurfaceKind::Plane);
  // The CRS of the user's choice. Throws InputError where no transformation exists.
  static Projection to(const Crs& input, const Crs& working);

  Point forward(const Point& input) const;
  Point inverse(const Point& plane) const;
  // Plane length over true length on the ellipsoid at a place of the plane. 1 for `plane()`.
  double scaleAt(const Point& plane) const;
  // What lengths and angles are measured on: a sphere that stands for the ellipsoid, or the plane.
  Surface surface() const;
  // Length on that surface over length on the ellipsoid at a place of the plane: near 1 on a sphere, `scaleAt` in the
  // plane.
  double measureAt(const Point& plane) const;
  // Places of the plane on the ground; empty where the plane itself rules.
  GroundPlaces groundPlaces(std::span<const Point> plane, const ItemLoop& loop = inOrder) const;
  // The place, in the input's CRS, that lies beyond all of the plane, for maps that show all others.
  std::optional<Point> infinity() const;
  bool isIdentity() const;                 // of `plane()`
  bool mayTear() const;                    // of a chosen CRS: places that touch may lie far apart in the plane
  const std::string& reason() const;       // why this one was chosen, for people; empty where nobody chose
  const std::string& description() const;  // for people: "transverse Mercator, central meridian -87.5°"

 private:
  explicit Projection(std::shared_ptr<const ProjectionMap> impl);
  std::shared_ptr<const ProjectionMap> impl_;
};

}  // namespace coastmesh
