#include "core/predicates.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace coastmesh::detail {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_2 toCgal(const Point& p) { return {p.x, p.y}; }

}  // namespace

int orient2dExact(const Point& a, const Point& b, const Point& c) {
  return static_cast<int>(CGAL::orientation(toCgal(a), toCgal(b), toCgal(c)));
}

int inCircleExact(const Point& a, const Point& b, const Point& c, const Point& d) {
  return static_cast<int>(CGAL::side_of_oriented_circle(toCgal(a), toCgal(b), toCgal(c), toCgal(d)));
}

}  // namespace coastmesh::detail
