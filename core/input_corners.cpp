#include "core/input_corners.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "core/input_angle.hpp"
#include "core/large_list.hpp"
#include "core/predicates.hpp"

namespace coastmesh {

namespace {

// In a mesh from a file, edges that bend less (radians) are one straight constraint: rounding and reprojection bend
// lines.
constexpr double kStraight = toRadians(0.1);

// Largest angle of a corner (radians): a straight line, even a rounded one, is no cause.
constexpr double kLargest = std::numbers::pi - 1e-6;

// A constrained edge, listed once.
struct Link {
  VertexId a = kNone, b = kNone;
  SegmentId segment = kNone;  // kNone if a boundary edge has none
};

// The constrained edges of a mesh and the chains that they form.
class Constraints {
 public:
  Constraints(const TriMesh& mesh, const ItemLoop& loop) : mesh_(mesh) {
    links_ = joined(overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
      std::vector<Link> some;
      for (auto t = static_cast<TriId>(first); t < last; ++t)
        for (unsigned i = 0; i < 3; ++i) {
          const EdgeRef e = edgeRef(t, i), twin = mesh.twin(e);
          if (twin == kNone || (e < twin && mesh.segment(e) != kNone))
            some.push_back({mesh.origin(e), mesh.target(e), mesh.segment(e)});
        }
      return some;
    }));
    // Vertices of lattices come last and have no constraints.
    const VertexId end =
        std::ranges::max(overStretches(loop, links_.size(), [this](std::size_t first, std::size_t last) {
          VertexId beyond = 0;
          for (std::size_t l = first; l < last; ++l) beyond = std::max({beyond, links_[l].a + 1, links_[l].b + 1});
          return beyond;
        }));
    first_ = filledList(loop, std::size_t{end} + 1, std::uint32_t{0});
    forEachByStretches(loop, links_.size(), [this](std::size_t l) {
      for (const VertexId v : {links_[l].a, links_[l].b}) __atomic_add_fetch(&first_[v], 1, __ATOMIC_RELAXED);
    });
    // first_ holds ends now; filling backwards turns them into starts.
    sumUpOn(loop, first_);
    resizeUnset(at_, 2 * links_.size());
    forEachByStretches(loop, links_.size(), [this](std::size_t l) {
      for (const VertexId v : {links_[l].a, links_[l].b})
        at_[__atomic_sub_fetch(&first_[v], 1, __ATOMIC_RELAXED)] = static_cast<std::uint32_t>(l);
    });
    forEachByStretches(loop, end, [this](std::size_t v) {
      if (first_[v + 1] - first_[v] > 1) std::sort(at_.begin() + first_[v], at_.begin() + first_[v + 1]);
    });
    nameChains(loop);
  }

  const std::vector<Link>& links() const { return links_; }
  std::uint32_t chainOf(std::uint32_t link) const { return chain_[link]; }
  std::span<const std::uint32_t> at(VertexId v) const {
    if (v + 1 >= first_.size()) return {};
    return {at_.data() + first_[v], at_.data() + first_[v + 1]};
  }
  VertexId across(std::uint32_t link, VertexId v) const {
    return links_[link].a == v ? links_[link].b : links_[link].a;
  }
  bool isInput(VertexId v) const {
    if (mesh_.input_vertices != 0) return v < mesh_.input_vertices;
    const std::span<const std::uint32_t> here = at(v);
    if (here.size() != 2 || links_[here[0]].segment != links_[here[1]].segment) return !here.empty();
    return angleAt(mesh_.point(v), mesh_.point(across(here[0], v)), mesh_.point(across(here[1], v))) <
           std::numbers::pi - kStraight;
  }
  // The other end of the constraint that leaves input vertex v along a link.
  VertexId farEnd(std::uint32_t link, VertexId v) const {
    const VertexId from = v;
    follow(link, v, [](std::uint32_t) {});
    return v == from ? across(link, v) : v;
  }

 private:
  // Follows links from v to the next input vertex, or around a ring back to the first link. Returns the last link.
  template <typename Visit>
  std::uint32_t follow(std::uint32_t link, VertexId& v, const Visit& visit) const {
    const std::uint32_t begin = link;
    do {
      visit(link);
      v = across(link, v);
      if (isInput(v)) return link;
      link = at(v)[0] == link ? at(v)[1] : at(v)[0];
    } while (link != begin);
    return begin;
  }
  // A chain's name is a number of its links: of the smaller one at its ends, or of a ring's first.
  void nameChains(const ItemLoop& loop) {
    chain_.assign(links_.size(), kNone);
    const auto name = [this](std::uint32_t l, VertexId v) {
      follow(l, v, [&](std::uint32_t link) { lowerTo(chain_[link], l); });
    };
    forEachByStretches(loop, links_.size(), [&](std::size_t i) {
      const auto l = static_cast<std::uint32_t>(i);
      for (const VertexId v : {links_[l].a, links_[l].b}) {
        if (!isInput(v)) continue;
        VertexId end = v;
        if (follow(l, end, [](std::uint32_t) {}) >= l) name(l, v);
      }
    });
    // Rings without an input vertex.
    for (std::uint32_t l = 0; l < links_.size(); ++l)
      if (chain_[l] == kNone) name(l, links_[l].a);
  }

  const TriMesh& mesh_;
  std::vector<Link> links_;
  BulkList<std::uint32_t> first_, at_;  // the links at vertex v: at_[first_[v]] up to at_[first_[v + 1]]
  std::vector<std::uint32_t> chain_;    // for each link: the constraint that it is part of
};

// A vertex or constraint to which distances are measured.
struct Feature {
  VertexId a = kNone, b = kNone;  // equal for a vertex
  std::uint32_t chain = kNone;
};

std::vector<Feature> featuresOf(const TriMesh& mesh, const Constraints& constraints, const ItemLoop& loop) {
  const auto addOf = [&](std::size_t i, std::vector<Feature>& features) {
    const auto l = static_cast<std::uint32_t>(i);
    const Link& link = constraints.links()[l];
    const std::uint32_t chain = constraints.chainOf(l);
    if (mesh.input_vertices == 0) {
      features.push_back({link.a, link.b, chain});
      return;
    }
    // The whole input segment, since its pieces are rounded; once, from its end with the smaller number.
    for (const VertexId v : {link.a, link.b}) {
      if (!constraints.isInput(v)) continue;
      const VertexId end = constraints.farEnd(l, v);
      if (v < end) features.push_back({v, end, chain});
    }
  };
  std::vector<Feature> features = listOver<Feature>(loop, constraints.links().size(), addOf);
  const auto alone = listOver<VertexId>(loop, mesh.input_vertices, [&](std::size_t i, std::vector<VertexId>& list) {
    const auto v = static_cast<VertexId>(i);
    if (constraints.at(v).empty()) list.push_back(v);
  });
  if (alone.empty()) return features;
  const BulkList<std::uint8_t> used = usedVertices(mesh, loop);
  for (const VertexId v : alone)
    if (used[v]) features.push_back({v, v, kNone});
  return features;
}

struct Apex {
  VertexId vertex, right, left;  // the apex, and the next vertices on both sides
};

// The sectors that may be corners, by rounded subsegments; the whole constraints decide later.
std::vector<Apex> smallSectors(const TriMesh& mesh, const TriangleBound& bound, const ItemLoop& loop) {
  constexpr double kRounding = 0.01;
  const double largest = std::min(bound.max_angle, std::numbers::pi - 2.0 * bound.min_angle);
  // True if the angle is too large for n pieces and too small for n + 1.
  const auto mayBeCorner = [&](double angle) {
    for (int pieces = 0; pieces * largest < angle + kRounding; ++pieces)
      if (angle - kRounding < (pieces + 1) * bound.min_angle) return angle < std::numbers::pi + kRounding;
    return false;
  };
  const VertexId vertices = mesh.input_vertices != 0 ? mesh.input_vertices : static_cast<VertexId>(mesh.points.size());
  return joined(overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
    std::vector<Apex> some;
    for (auto t = static_cast<TriId>(first); t < last; ++t)
      for (unsigned i = 0; i < 3; ++i) {
        const VertexId v = mesh.triangle(t).v[i];
        const EdgeRef right = edgeRef(t, prev3(i));
        if (v >= vertices || (mesh.segment(right) == kNone && mesh.twin(right) != kNone)) continue;
        if (!mayBeSmall(mesh, t, i, bound)) continue;
        const Sector sector = sectorAt(mesh, t, i);
        if (mayBeCorner(sector.angle)) some.push_back({v, mesh.target(sector.right), mesh.origin(sector.left)});
      }
    return some;
  }));
}

BoxHalves disksOf(std::span<const InputCorner> corners) {
  std::vector<Bounds> boxes(corners.size());
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point reach{corners[k].radius, corners[k].radius};
    boxes[k].add(corners[k].apex - reach);
    boxes[k].add(corners[k].apex + reach);
  }
  return BoxHalves(boxes);
}

}  // namespace

void BoundCounts::add(Excuse excuse) {
  ++below;
  corner += excuse == Excuse::Corner;
  near += excuse == Excuse::Near;
}

void BoundCounts::add(const BoundCounts& other) {
  below += other.below;
  corner += other.corner;
  near += other.near;
}

InputCorners::InputCorners(const TriMesh& mesh, const TriangleBound& bound, const ItemLoop& loop) {
  const std::vector<Apex> candidates = smallSectors(mesh, bound, loop);
  if (candidates.empty()) return;
  const Constraints constraints(mesh, loop);
  // In a mesh from a file a chain may bend slightly: its direction at the apex counts.
  const auto endOf = [&](VertexId v, VertexId next) {
    if (mesh.input_vertices == 0) return next;
    const auto links = constraints.at(v);
    return constraints.farEnd(
        *std::ranges::find_if(links, [&](std::uint32_t l) { return constraints.across(l, v) == next; }), v);
  };
  std::vector<VertexId> apexes;
  for (const Apex& apex : candidates) {
    if (!constraints.isInput(apex.vertex)) continue;
    const Point& at = mesh.point(apex.vertex);
    const Point& right = mesh.point(endOf(apex.vertex, apex.right));
    const Point& left = mesh.point(endOf(apex.vertex, apex.left));
    const double angle = angleAt(at, right, left);
    if (orient2d(at, right, left) <= 0 || angle > kLargest || bound.canDivide(angle)) continue;
    corners_.push_back({at, right, left, 0.0});
    apexes.push_back(apex.vertex);
  }
  if (corners_.empty()) return;

  const std::vector<Feature> features = featuresOf(mesh, constraints, loop);
  // The square of the distance to the nearest of some features, and the ends of the corner's own constraints; `visit`
  // calls `see(f)` for those to try.
  const auto nearestOf = [&](std::size_t k, const auto& visit) {
    const Point& at = corners_[k].apex;
    double nearest = std::numeric_limits<double>::infinity();
    std::vector<std::uint32_t> own;
    for (const std::uint32_t l : constraints.at(apexes[k])) {
      own.push_back(constraints.chainOf(l));
      nearest = std::min(nearest, squaredDistance(at, mesh.point(constraints.farEnd(l, apexes[k]))));
    }
    visit(nearest, [&](std::size_t f) {
      if (std::ranges::find(own, features[f].chain) != own.end()) return;
      nearest = std::min(nearest, squaredDistanceToSegment(at, mesh.point(features[f].a), mesh.point(features[f].b)));
    });
    return nearest;
  };
  const auto boxOf = [&](std::size_t f) {
    Bounds box;
    box.add(mesh.point(features[f].a));
    box.add(mesh.point(features[f].b));
    return box;
  };
  constexpr std::size_t kWorthTree = 16;
  if (corners_.size() < kWorthTree) {
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      const auto nearestIn = [&](std::size_t first, std::size_t last) {
        return nearestOf(k, [&](const double& nearest, const auto& see) {
          for (std::size_t f = first; f < last; ++f)
            if (boxOf(f).squaredDistanceTo(corners_[k].apex) < nearest) see(f);
        });
      };
      corners_[k].radius = kNearShare * std::sqrt(std::ranges::min(overStretches(loop, features.size(), nearestIn)));
    }
  } else {
    std::vector<Bounds> boxes(features.size());
    forEachByStretches(loop, features.size(), [&](std::size_t f) { boxes[f] = boxOf(f); });
    const BoxHalves nearby(boxes);
    forEachByStretches(loop, corners_.size(), [&](std::size_t k) {
      const double nearest = nearestOf(k, [&](const double& so_far, const auto& see) {
        nearby.visit([&](const Bounds& node) { return node.squaredDistanceTo(corners_[k].apex) < so_far; }, see);
      });
      corners_[k].radius = kNearShare * std::sqrt(nearest);
    });
  }
  disks_ = disksOf(corners_);
}

InputCorners::InputCorners(std::vector<InputCorner>&& corners)
    : corners_(std::move(corners)), disks_(disksOf(corners_)) {}

Excuse InputCorners::excuseOf(const Point& a, const Point& b, const Point& c) const {
  const std::array<Point, 3> vertices{a, b, c};
  const auto fills = [&](const InputCorner& corner) {
    if (std::ranges::find(vertices, corner.apex) == vertices.end()) return false;
    // Three times the vector to the centroid, from differences: far from the origin the centroid itself is rounded too
    // much.
    const Point way = (a - corner.apex) + (b - corner.apex) + (c - corner.apex);
    return cross(corner.right - corner.apex, way) > 0.0 && cross(way, corner.left - corner.apex) > 0.0;
  };
  const auto isNear = [&](const InputCorner& corner) {
    return std::ranges::all_of(
        vertices, [&](const Point& v) { return squaredDistance(v, corner.apex) <= corner.radius * corner.radius; });
  };
  Excuse excuse = Excuse::None;
  for (const Point& v : vertices) {
    disks_.visit([&](const Bounds& node) { return node.holds(v); },
                 [&](std::uint32_t k) {
                   if (fills(corners_[k])) excuse = Excuse::Corner;
                   if (excuse == Excuse::None && isNear(corners_[k])) excuse = Excuse::Near;
                 });
  }
  return excuse;
}

}  // namespace coastmesh
