#pragma once

#include <pybind11/pybind11.h>

#include "apps/python/mesh_result.hpp"

namespace coastmesh {

// A mesh of `points` (n, 2), `triangles` (m, 3) with indices of points, and depths `z` (n,), NaN where unknown, or
// None; arrays as for `pslgOf`. `crs`: as for the keyword assume_crs; None: a plane. Its boundaries are the loops
// around it. Warns of triangles that are not counter-clockwise, and of a plane that may be in degrees. Throws
// InputError, OptionError.
MeshResult meshFromArrays(const pybind11::object& points, const pybind11::object& triangles, const pybind11::object& z,
                          const pybind11::object& crs);

// A copy with the depths `z`, or without any for None. Throws InputError.
MeshResult meshWithDepths(const MeshResult& mesh, const pybind11::object& z);

}  // namespace coastmesh
