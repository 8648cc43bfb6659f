#pragma once

#include <array>

#include "gis/crs/crs_definition.hpp"
#include "gis/crs/lon_lat.hpp"

namespace coastmesh {

// Places on the sphere for models that use latitudes unchanged as those of a sphere: unit vectors, x towards longitude
// 0, z towards the north pole.
using SphereVector = std::array<double, 3>;

SphereVector onSphere(const LonLat& place);

// Where longitudes and latitudes lie: on the ellipsoid of their CRS, or on a sphere with unchanged latitudes. For the
// same coordinates, angles differ by up to 0.38 degrees.
enum class EarthShape { Ellipsoid, Sphere };

// Earth-centred, in semi-major axes of the ellipsoid, the sphere's radius.
SphereVector inSpace(const LonLat& place, const Crs& crs, EarthShape shape);
// The place on the sphere of one on the ellipsoid.
SphereVector fromEllipsoid(const SphereVector& place, const Crs& crs);

// The place of a vector of any length except 0; longitudes within ±180, 0 at a pole.
LonLat placeOf(const SphereVector& vector);

double dot(const SphereVector& a, const SphereVector& b);
SphereVector cross(const SphereVector& a, const SphereVector& b);
SphereVector scaled(const SphereVector& a, double by);
SphereVector minus(const SphereVector& a, const SphereVector& b);
SphereVector unit(const SphereVector& a);  // of a vector of any length except 0

// Angles in degrees of the flat triangle through three places, at each of its corners; 0 if two of them coincide.
std::array<double, 3> flatAnglesDeg(const SphereVector& a, const SphereVector& b, const SphereVector& c);

// The place on the sphere at equal distance from all three; for a counter-clockwise triangle the one on its side of the
// sphere. REQUIRES: no two coincide.
SphereVector circumcentreOnSphere(const SphereVector& a, const SphereVector& b, const SphereVector& c);

}  // namespace coastmesh
