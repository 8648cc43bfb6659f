#include "core/quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/metric.hpp"

namespace coastmesh {

std::array<double, 3> anglesDeg(const Point& a, const Point& b, const Point& c) {
  return {toDegrees(angleAt(a, b, c)), toDegrees(angleAt(b, c, a)), toDegrees(angleAt(c, a, b))};
}

double signedArea(const Point& a, const Point& b, const Point& c) { return 0.5 * cross(b - a, c - a); }

void MeshQuality::add(const MeshQuality& other) {
  vertices += other.vertices;
  triangles += other.triangles;
  area += other.area;
  min_angle_deg = std::min(min_angle_deg, other.min_angle_deg);
  max_angle_deg = std::max(max_angle_deg, other.max_angle_deg);
  shortest_edge = std::min(shortest_edge, other.shortest_edge);
  longest_edge = std::max(longest_edge, other.longest_edge);
  bounds.add(other.bounds);
  for (std::size_t i = 0; i < angle_histogram.size(); ++i) angle_histogram[i] += other.angle_histogram[i];
}

MeshQuality measureQuality(const TriMesh& mesh, double min_angle_deg, double max_angle_deg, const ItemLoop& loop) {
  struct Part {
    MeshQuality quality;
    std::vector<TriId> below;
  };
  const auto measure = [&](std::size_t first, std::size_t last) {
    Part part;
    MeshQuality& quality = part.quality;
    quality.triangles = last - first;
    for (std::size_t t = first; t < last; ++t) {
      const auto& v = mesh.triangles[t].v;
      const Point* p[3] = {&mesh.points[v[0]], &mesh.points[v[1]], &mesh.points[v[2]]};
      quality.area += signedArea(*p[0], *p[1], *p[2]);
      const std::array<double, 3> angles = anglesDeg(*p[0], *p[1], *p[2]);
      double least = 180.0, most = 0.0;
      for (unsigned i = 0; i < 3; ++i) {
        least = std::min(least, angles[i]);
        most = std::max(most, angles[i]);
        const auto bin = static_cast<std::size_t>(angles[i] / 5.0);
        ++quality.angle_histogram[std::min(bin, quality.angle_histogram.size() - 1)];
        const double length = distance(*p[i], *p[next3(i)]);
        quality.shortest_edge = std::min(quality.shortest_edge, length);
        quality.longest_edge = std::max(quality.longest_edge, length);
      }
      quality.min_angle_deg = std::min(quality.min_angle_deg, least);
      quality.max_angle_deg = std::max(quality.max_angle_deg, most);
      if (least < min_angle_deg || most > max_angle_deg) part.below.push_back(static_cast<TriId>(t));
    }
    return part;
  };
  const std::vector<Part> parts = overStretches(loop, mesh.triangles.size(), measure);
  MeshQuality whole;
  for (const Part& part : parts) whole.add(part.quality);
  if (std::ranges::any_of(parts, [](const Part& part) { return !part.below.empty(); })) {
    const TriangleBound asked(min_angle_deg, max_angle_deg, std::numeric_limits<double>::infinity());
    const InputCorners corners(mesh, asked, loop);
    for (const Part& part : parts) {
      for (const TriId t : part.below) {
        const auto& v = mesh.triangles[t].v;
        whole.bounds.add(corners.excuseOf(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]));
      }
    }
  }
  const std::vector<std::uint8_t> used = usedVertices(mesh, loop);
  whole.vertices = static_cast<std::uint64_t>(std::ranges::count(used, std::uint8_t{1}));
  return whole;
}

}  // namespace coastmesh
