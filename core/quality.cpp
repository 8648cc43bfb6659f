#include "core/quality.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include "core/large_list.hpp"
#include "core/metric.hpp"

namespace coastmesh {

std::array<double, 3> anglesDeg(const Point& a, const Point& b, const Point& c) {
  return {toDegrees(angleAt(a, b, c)), toDegrees(angleAt(b, c, a)), toDegrees(angleAt(c, a, b))};
}

// The smallest angle has the largest scalar product of its sides.
double leastAngleDeg(const Point& a, const Point& b, const Point& c) {
  const Point ab = b - a, bc = c - b, ca = a - c;
  const double at_a = -dot(ab, ca), at_b = -dot(ab, bc), at_c = -dot(bc, ca);
  if (at_a >= at_b && at_a >= at_c) return toDegrees(angleAt(a, b, c));
  return toDegrees(at_b >= at_c ? angleAt(b, c, a) : angleAt(c, a, b));
}

namespace {

// Scalar products of the sides at each corner, the smallest at the largest angle. 0.0 minus the product is never the
// negative zero that would make angles at coincident corners 180°.
std::array<double, 3> cornerProducts(const SpacePoint& ab, const SpacePoint& bc, const SpacePoint& ca) {
  return {0.0 - dot(ab, ca), 0.0 - dot(ab, bc), 0.0 - dot(bc, ca)};
}

}  // namespace

std::array<double, 3> spaceAnglesDeg(const SpacePoint& a, const SpacePoint& b, const SpacePoint& c) {
  const SpacePoint ab = b - a, bc = c - b, ca = a - c;
  const double twice_area = lengthOf(cross(ab, bc));
  const std::array<double, 3> cosines = cornerProducts(ab, bc, ca);
  const auto largest = static_cast<std::size_t>(std::ranges::min_element(cosines) - cosines.begin());
  std::array<double, 3> angles{};
  double left = 180.0;
  for (std::size_t i = 0; i < 3; ++i)
    if (i != largest) left -= angles[i] = toDegrees(std::atan2(twice_area, cosines[i]));
  angles[largest] = left;
  return angles;
}

double leastSpaceAngleDeg(const SpacePoint& a, const SpacePoint& b, const SpacePoint& c) {
  const SpacePoint ab = b - a, bc = c - b, ca = a - c;
  return toDegrees(std::atan2(lengthOf(cross(ab, bc)), std::ranges::max(cornerProducts(ab, bc, ca))));
}

std::array<double, 3> surfaceAnglesDeg(const Point& a, const Point& b, const Point& c, const Surface& surface) {
  if (!surface.isCurved()) return anglesDeg(a, b, c);
  // Relative to the point where the sphere touches the plane.
  const auto onSphere = [&surface](const Point& p) {
    const double shrink = surface.shrinkAt(p);
    return SpacePoint{shrink * p.x, shrink * p.y, -shrink * squaredLength(p) / (2.0 * surface.radius())};
  };
  return spaceAnglesDeg(onSphere(a), onSphere(b), onSphere(c));
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

namespace {

// Measures of a triangle other than its angles.
struct TriangleMeasure {
  double area;
  std::array<double, 3> lengths;
};

TriangleMeasure measureTriangle(const Point& a, const Point& b, const Point& c) {
  return {signedArea(a, b, c), {distance(a, b), distance(b, c), distance(c, a)}};
}

TriangleMeasure measureTriangle(const SpacePoint& a, const SpacePoint& b, const SpacePoint& c) {
  return {0.5 * lengthOf(cross(b - a, c - a)), {distance(a, b), distance(b, c), distance(c, a)}};
}

constexpr double kClassDeg = 5.0;
constexpr std::size_t kClasses = std::tuple_size_v<decltype(MeshQuality::angle_histogram)>;

std::size_t classOf(double angle_deg) {
  return std::min(static_cast<std::size_t>(angle_deg / kClassDeg), kClasses - 1);
}

// Finds classes of angles without arc tangents, unless rounding could change them.
class FastClasses {
 public:
  FastClasses() {
    for (std::size_t k = 0; k <= kClasses; ++k) {
      const double angle = toRadians(kClassDeg * static_cast<double>(k));
      ends_[k] = slopeOf(std::sin(angle), std::cos(angle));
    }
    for (std::size_t place = 0; place < kPlaces; ++place) {
      const double slope = 1.0 - static_cast<double>(place) / kPlacesOfOne;
      while (first_[place] + 1u < kClasses && ends_[first_[place] + 1u] > slope) ++first_[place];
      if (place + 1 < kPlaces) first_[place + 1] = first_[place];
    }
  }

  // Decreases with the angle, from 1 at 0° to -1 at 180°. Arguments: twice the area, above 0, and the scalar product of
  // the sides.
  static double slopeOf(double doubled, double product) { return product / (doubled + std::abs(product)); }

  // Returns kClasses if the angle is too near to the end of a class. A smaller margin would sometimes be wrong, a
  // larger one slow: rows of equal triangles have angles of 60° up to rounding.
  std::size_t classOf(double slope) const {
    constexpr double kRounding = 1e-14;
    std::size_t k = first_[static_cast<std::size_t>((1.0 - slope) * kPlacesOfOne)];
    if (k + 1 < kClasses && slope < ends_[k + 1]) ++k;
    return ends_[k] - slope > kRounding && slope - ends_[k + 1] > kRounding ? k : kClasses;
  }

 private:
  static constexpr double kPlacesOfOne = 128.0;
  static constexpr std::size_t kPlaces = 257;  // no class is narrower than one place

  std::array<double, kClasses + 1> ends_{};
  std::array<std::uint8_t, kPlaces> first_{};  // the class at the start of each place
};

const FastClasses kFastClasses;

// Accumulates the angles of triangles.
class AngleTally {
 public:
  explicit AngleTally(MeshQuality& quality) : quality_(quality) {}

  // Returns false, and adds nothing, if an angle may be outside the range seen so far or near the end of a class.
  bool addFast(const Point& a, const Point& b, const Point& c) {
    const Point ab = b - a, bc = c - b, ca = a - c;
    const double doubled = cross(ab, bc);
    if (!(doubled > 0.0)) return false;
    std::array<std::size_t, 3> classes{};
    const std::array<double, 3> products{-dot(ab, ca), -dot(ab, bc), -dot(bc, ca)};
    for (std::size_t i = 0; i < 3; ++i) {
      const double slope = FastClasses::slopeOf(doubled, products[i]);
      if (!(slope < steepest_ && slope > flattest_)) return false;
      classes[i] = kFastClasses.classOf(slope);
      if (classes[i] == kClasses) return false;
    }
    for (const std::size_t k : classes) ++quality_.angle_histogram[k];
    return true;
  }

  void add(const std::array<double, 3>& angles) {
    constexpr double kRounding = 1e-9;
    const auto slopeOf = [](double angle_deg) {
      return FastClasses::slopeOf(std::sin(toRadians(angle_deg)), std::cos(toRadians(angle_deg)));
    };
    for (const double angle : angles) {
      ++quality_.angle_histogram[classOf(angle)];
      if (angle < quality_.min_angle_deg) steepest_ = slopeOf(quality_.min_angle_deg = angle) - kRounding;
      if (angle > quality_.max_angle_deg) flattest_ = slopeOf(quality_.max_angle_deg = angle) + kRounding;
    }
  }

 private:
  MeshQuality& quality_;
  double steepest_ = -2.0, flattest_ = 2.0;  // slopes between them change neither extreme angle
};

}  // namespace

MeshQuality measureQuality(const TriMesh& mesh, double min_angle_deg, double max_angle_deg, const ItemLoop& loop,
                           std::span<const SpacePoint> places) {
  assert(places.empty() || places.size() == mesh.points.size());
  struct Part {
    MeshQuality quality;
    std::vector<TriId> below;
  };
  const bool is_asked = min_angle_deg > 0.0 || max_angle_deg < 180.0;
  const auto measure = [&](std::size_t first, std::size_t last) {
    Part part;
    MeshQuality& quality = part.quality;
    AngleTally tally(quality);
    quality.triangles = last - first;
    for (std::size_t t = first; t < last; ++t) {
      const auto& v = mesh.triangles[t].v;
      const TriangleMeasure measured = places.empty()
                                           ? measureTriangle(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]])
                                           : measureTriangle(places[v[0]], places[v[1]], places[v[2]]);
      quality.area += measured.area;
      for (const double length : measured.lengths) {
        quality.shortest_edge = std::min(quality.shortest_edge, length);
        quality.longest_edge = std::max(quality.longest_edge, length);
      }
      if (places.empty() && !is_asked && tally.addFast(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]))
        continue;
      const std::array<double, 3> angles = places.empty()
                                               ? anglesDeg(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]])
                                               : spaceAnglesDeg(places[v[0]], places[v[1]], places[v[2]]);
      tally.add(angles);
      const auto [least, most] = std::ranges::minmax(angles);
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
  const BulkList<std::uint8_t> used = usedVertices(mesh, loop);
  whole.vertices = countOn(loop, used, std::uint8_t{1});
  return whole;
}

}  // namespace coastmesh
