#pragma once

#include <span>
#include <utility>

#include "core/pslg.hpp"
#include "gis/clean/domain.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// The middle of the box around a domain; the origin for a whole globe.
Point centreOf(const Pslg& pslg);

// Smallest and largest value of `Projection::scaleAt` at a sample of the points.
std::pair<double, double> scaleRange(std::span<const Point> points, const Projection& projection);

// Smallest and largest measure in the domain, its centre included: in a conformal plane that is fitted to it, the
// measure is smallest there.
std::pair<double, double> measureRange(const Domain& domain);

}  // namespace coastmesh
