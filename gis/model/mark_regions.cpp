#include "gis/model/mark_regions.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "gis/coast/feature_names.hpp"
#include "gis/coast/input_polygons.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/geometry/chain_index.hpp"

namespace coastmesh {

namespace {

constexpr std::uint32_t kNoRegion = std::numeric_limits<std::uint32_t>::max();

struct MemberRegion {
  std::size_t member;
  ChainIndex rings;  // in the plane
  bool inside_out;   // in the plane: the region holds the place at infinity

  bool holds(const Point& p) const {
    const Location location = rings.locate(p);
    return location != Location::Boundary && (location == Location::Inside) != inside_out;
  }
};

std::vector<MemberRegion> regionsOf(const Coastline& coastline, const std::vector<std::size_t>& members,
                                    const Projection& projection) {
  const std::optional<Point> infinity = projection.infinity();
  std::vector<MemberRegion> regions;
  for (const std::size_t member : members) {
    const Feature& feature = coastline.features[member];
    if (feature.use != FeatureUse::Region) continue;
    ChainIndex rings(ChainIndex::Kind::Rings);
    const auto add = [&](Ring ring) {
      for (Point& p : ring) p = projection.forward(p);
      rings.add(ring);
    };
    for (const Polygon& polygon : feature.polygons) {
      add(polygon.outer);
      for (const Ring& hole : polygon.holes) add(hole);
    }
    rings.build();
    if (rings.edgeCount() == 0) continue;
    const bool inside_out =
        infinity && InputPolygons(feature.polygons, coastline.crs.geographic).holdAtAnyTurn(*infinity);
    regions.push_back({member, std::move(rings), inside_out});
  }
  return regions;
}

// The first region that contains each triangle, or kNoRegion. Candidates come from a tree of boxes, since there may be
// as many regions as triangles; boxes say nothing of those that are inside out.
std::vector<std::uint32_t> regionOfTriangles(const std::vector<MemberRegion>& regions, const TriMesh& mesh,
                                             const ItemLoop& loop) {
  std::vector<Box> boxes;
  std::vector<std::uint32_t> inside_out;
  for (std::uint32_t r = 0; r < regions.size(); ++r) {
    boxes.push_back(regions[r].rings.bounds());
    if (regions[r].inside_out) inside_out.push_back(r);
  }
  const BoxTree tree(boxes, BoxTree::Order::Hilbert);
  std::vector<std::uint32_t> region_of(mesh.triangles.size(), kNoRegion);
  forEachByStretches(loop, mesh.triangles.size(), [&](std::size_t t) {
    const auto& [a, b, c] = mesh.triangles[t].v;
    const Point centre{(mesh.points[a].x + mesh.points[b].x + mesh.points[c].x) / 3,
                       (mesh.points[a].y + mesh.points[b].y + mesh.points[c].y) / 3};
    const auto look = [&](std::uint32_t r) {
      if (r < region_of[t] && regions[r].holds(centre)) region_of[t] = r;
    };
    tree.visit(Box::of(centre, centre), look);
    std::ranges::for_each(inside_out, look);
  });
  return region_of;
}

}  // namespace

std::vector<std::uint32_t> markRegions(const Coastline& coastline, const std::vector<std::size_t>& members,
                                       const Projection& projection, TriMesh& mesh, Coastline& names,
                                       const ItemLoop& loop) {
  const std::vector<MemberRegion> regions = regionsOf(coastline, members, projection);
  std::vector<std::uint32_t> used;
  if (regions.empty()) return used;
  const std::vector<std::uint32_t> region_of = regionOfTriangles(regions, mesh, loop);
  std::map<std::pair<RegionId, std::uint32_t>, RegionId> parts;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (region_of[t] == kNoRegion) continue;
    const auto [part, made] =
        parts.try_emplace({mesh.regions[t], region_of[t]}, static_cast<RegionId>(names.features.size()));
    if (made) {
      Feature name = names.features[static_cast<std::size_t>(mesh.regions[t])];
      name.region = regionNameOf(coastline.features[regions[region_of[t]].member]);
      names.features.push_back(std::move(name));
      used.push_back(static_cast<std::uint32_t>(regions[region_of[t]].member));
    }
    mesh.regions[t] = part->second;
  }
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

}  // namespace coastmesh
