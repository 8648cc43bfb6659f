#include "tests/bench/cgal_peers.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "tests/bench/cpu_clock.hpp"

namespace coastmesh {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Storage = CGAL::Triangulation_data_structure_2<CGAL::Delaunay_mesh_vertex_base_2<Kernel>,
                                                     CGAL::Delaunay_mesh_face_base_2<Kernel>>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Storage>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Cdt>;

std::vector<Kernel::Point_2> kernelPoints(std::span<const Point> points) {
  std::vector<Kernel::Point_2> converted;
  converted.reserve(points.size());
  for (const Point& p : points) converted.emplace_back(p.x, p.y);
  return converted;
}

}  // namespace

Mesh2Result runMesh2(const Pslg& pslg, double min_angle_deg) {
  const std::vector<Kernel::Point_2> points = kernelPoints(pslg.points), seeds = kernelPoints(pslg.holes);
  std::vector<std::pair<std::size_t, std::size_t>> segments;
  segments.reserve(pslg.segments.size());
  for (const Segment& s : pslg.segments) segments.emplace_back(s.a, s.b);
  const double sine = std::sin(toRadians(min_angle_deg));

  Mesh2Result result;
  Cdt cdt;
  result.triangulate_s =
      cpuSecondsOf([&] { cdt.insert_constraints(points.begin(), points.end(), segments.begin(), segments.end()); });
  result.refine_s =
      cpuSecondsOf([&] { CGAL::refine_Delaunay_mesh_2(cdt, seeds.begin(), seeds.end(), Criteria(sine * sine, 0.0)); });
  result.vertices = cdt.number_of_vertices();
  for (auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f) result.triangles += f->is_in_domain();
  return result;
}

std::size_t runBareDelaunay(std::span<const Point> points) {
  const std::vector<Kernel::Point_2> converted = kernelPoints(points);
  CGAL::Delaunay_triangulation_2<Kernel> triangulation;
  triangulation.insert(converted.begin(), converted.end());
  return triangulation.number_of_faces();
}

}  // namespace coastmesh
