#include "gis/follow/water_basins.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/metric.hpp"
#include "gis/follow/shore_patches.hpp"
#include "gis/follow/shore_settle.hpp"

namespace coastmesh {

namespace {

constexpr double kLarge = 20.0;                  // triangles of the size wanted
const double kTriangle = 0.25 * std::sqrt(3.0);  // area of one of side 1

bool isWater(const ShoreTriangles& triangles, TriId t) { return triangles.mesh.regions[t] != triangles.land; }

double elementsIn(const ShoreTriangles& triangles, TriId t) {
  const auto& v = triangles.mesh.triangles[t].v;
  const Point& a = triangles.mesh.point(v[0]);
  const double area = 0.5 * cross(triangles.mesh.point(v[1]) - a, triangles.mesh.point(v[2]) - a);
  return area / (kTriangle * triangles.size[t] * triangles.size[t]);
}

// Calls `visit(e)` for edges within open water, once each.
template <typename Visit>
void forEdgesIn(const ShoreTriangles& triangles, const std::vector<std::uint32_t>& water, Visit&& visit) {
  const TriMesh& mesh = triangles.mesh;
  for (TriId t = 0; t < water.size(); ++t) {
    if (!isWater(triangles, t) || water[t] == kNone) continue;
    for (unsigned i = 0; i < 3; ++i) {
      const TriId next = triOf(mesh.twin(edgeRef(t, i)));
      if (next > t && isWater(triangles, next) && water[next] == water[t]) visit(edgeRef(t, i));
    }
  }
}

class LandFinder {
 public:
  LandFinder(const WaterGaps& gaps, WaterBasins&& basins)
      : t_(gaps.triangles()), gaps_(gaps), basins_(std::move(basins)) {}

  std::vector<ShoreLine> run() {
    if (!findShared()) return {};
    addNarrow();
    return separating();
  }

 private:
  const TriMesh& mesh() const { return t_.mesh; }
  Point centreOf(TriId t) const {
    const auto& v = mesh().triangles[t].v;
    return centroid(mesh().point(v[0]), mesh().point(v[1]), mesh().point(v[2]));
  }
  std::uint32_t waterOf(TriId t) const { return basins_.water[t]; }
  bool isShared(TriId t) const { return waterOf(t) != kNone && is_shared_[waterOf(t)] != 0; }

  // Finds waters with several large basins. Returns false if there are none.
  bool findShared() {
    std::size_t waters = 0;
    for (const std::uint32_t water : basins_.water)
      if (water != kNone) waters = std::max<std::size_t>(waters, water + 1);
    std::vector<std::size_t> count(waters, 0);
    for (TriId t = 0; t < basins_.water.size(); ++t)
      if (basins_.is_large[t] != 0) ++count[waterOf(t)];
    for (const std::size_t basins : count) is_shared_.push_back(basins > 1 ? 1 : 0);
    return std::ranges::find(is_shared_, 1) != is_shared_.end();
  }

  void unite(TriId a, TriId b) {
    const bool large = isInLarge(a) || isInLarge(b);
    basins_.sets.unite(a, b);
    basins_.is_large[basins_.sets.find(a)] = large ? 1 : 0;
  }
  bool isInLarge(TriId t) { return basins_.is_large[basins_.sets.find(t)] != 0; }

  // Adds other water to the large basin that the widest way leads to.
  void addNarrow() {
    std::vector<std::pair<double, EdgeRef>> sorted;
    forEdgesIn(t_, basins_.water, [&](EdgeRef e) {
      if (gaps_.isNarrow(e) && isShared(triOf(e))) sorted.emplace_back(-gaps_.share(e), e);
    });
    std::ranges::sort(sorted);
    for (const auto& [share, e] : sorted) {
      const TriId t = triOf(e), next = triOf(mesh().twin(e));
      if (!isInLarge(t) || !isInLarge(next)) unite(t, next);
    }
  }

  // The smallest lands first: the others stay where they separate.
  std::vector<ShoreLine> separating() {
    const Patches lands = patchesOf(mesh(), [&](TriId t) { return !isWater(t_, t) && isShared(t); });
    std::vector<std::pair<double, std::size_t>> sorted;
    for (std::size_t i = 0; i < lands.triangles.size(); ++i) {
      double elements = 0.0;
      for (const TriId t : lands.triangles[i]) elements += elementsIn(t_, t);
      sorted.emplace_back(elements, i);
    }
    std::ranges::sort(sorted);
    std::vector<ShoreLine> lines;
    for (const auto& [elements, i] : sorted) {
      const std::vector<TriId> around = waterAround(lands.triangles[i]);
      std::size_t large = 0;
      for (const TriId basin : around) large += basins_.is_large[basin] != 0 ? 1 : 0;
      if (large > 1) {
        addLines(lands.triangles[i], lands.of, lines);
      } else {
        for (const TriId basin : around) unite(around.front(), basin);
      }
    }
    return lines;
  }

  std::vector<TriId> waterAround(const std::vector<TriId>& land) {
    std::vector<TriId> basins;
    for (const TriId t : land)
      for (const EdgeRef e : mesh().triangles[t].adj)
        if (isWater(t_, triOf(e)) && waterOf(triOf(e)) == waterOf(t)) basins.push_back(basins_.sets.find(triOf(e)));
    std::ranges::sort(basins);
    basins.erase(std::ranges::unique(basins).begin(), basins.end());
    return basins;
  }

  // Lines that meet all triangles of a land, and no others.
  void addLines(const std::vector<TriId>& land, const std::vector<std::uint32_t>& number,
                std::vector<ShoreLine>& lines) const {
    for (const TriId t : land) {
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(t, i);
        const TriId next = triOf(mesh().twin(e));
        const bool inside = number[next] == number[t];
        if (inside && next < t) continue;
        const Point x = midpoint(mesh().point(mesh().origin(e)), mesh().point(mesh().target(e)));
        if (inside) {
          lines.push_back({{centreOf(t), x, centreOf(next)}, ""});
        } else {
          lines.push_back({{centreOf(t), midpoint(centreOf(t), x)}, ""});
        }
      }
    }
  }

  const ShoreTriangles& t_;
  const WaterGaps& gaps_;
  WaterBasins basins_;
  std::vector<char> is_shared_;  // by water: has several large basins
};

}  // namespace

std::vector<std::uint32_t> watersIn(const ShoreTriangles& data, const OpenedShores& opened) {
  const TriMesh &mesh = data.mesh, &after = opened.after.mesh;
  std::vector<std::uint32_t> water(after.triangles.size(), kNone), of(mesh.triangles.size(), kNone);
  for (std::uint32_t i = 0; i < opened.waters.size(); ++i)
    for (const TriId t : opened.waters[i].triangles) water[t] = i;
  TriId last = 0;
  for (TriId t = 0; t < of.size(); ++t) {
    const auto& v = mesh.triangles[t].v;
    // Most triangles are still there, with their number.
    if (t < water.size() && after.triangles[t].v == v) {
      of[t] = water[t];
      continue;
    }
    const TriId there = locateIn(opened.after, centroid(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2])), last);
    if (there == kNone) continue;
    last = there;
    of[t] = water[there];
  }
  return of;
}

WaterBasins basinsOf(const WaterGaps& gaps, const OpenedShores& opened) {
  const ShoreTriangles& triangles = gaps.triangles();
  const std::size_t count = triangles.mesh.triangles.size();
  WaterBasins basins{watersIn(triangles, opened), UnionFind(count), std::vector<char>(count, 0)};
  forEdgesIn(triangles, basins.water, [&](EdgeRef e) {
    if (!gaps.isNarrow(e)) basins.sets.unite(triOf(e), triOf(triangles.mesh.twin(e)));
  });
  std::vector<double> elements(count, 0.0);
  for (TriId t = 0; t < count; ++t)
    if (isWater(triangles, t) && basins.water[t] != kNone) elements[basins.sets.find(t)] += elementsIn(triangles, t);
  for (TriId t = 0; t < count; ++t) basins.is_large[t] = elements[t] >= kLarge ? 1 : 0;
  return basins;
}

std::vector<ShoreLine> separatingLand(const WaterGaps& gaps, WaterBasins&& basins) {
  return LandFinder(gaps, std::move(basins)).run();
}

}  // namespace coastmesh
