#include "gis/follow/shore_opening.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>

#include "core/large_list.hpp"
#include "core/metric.hpp"
#include "core/union_find.hpp"
#include "gis/follow/shore_guides.hpp"
#include "gis/follow/shore_patches.hpp"
#include "gis/follow/shore_settle.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

namespace {

constexpr double kLongestIsland = 3.0;  // in elements; longer ones stay
constexpr double kLongSpit = 3.0;       // in elements; longer ones are reported
constexpr double kShallow = 0.3;        // of the size; shallower patches are left to simplification
constexpr double kBlunt = 0.6;     // of its gate; so are patches shallower than this: corners of 80 degrees and more
constexpr double kWinding = 2.5;   // of its gate; simplification cannot straighten longer shores
constexpr double kPassage = 0.55;  // of its width; nearer to its line is part of a passage
constexpr double kLeastOpening = 1.0;            // elements of open boundary: a shorter one may become shore
constexpr double kLeastWater = 6.0;              // triangles of the size wanted
constexpr double kGrazed = 0.1;                  // of the water at open boundaries: the frame only grazes smaller parts
constexpr std::size_t kPlaces = 8;               // per water
const double kTriangle = 0.25 * std::sqrt(3.0);  // area of one of side 1

class Opening {
 public:
  Opening(ShoreTriangles& triangles, const ShoreSizes& sizes, const ShoreGuides& guides, const ShoreEdit& edit,
          WaterAreas& gained, const ItemLoop& loop)
      : t_(triangles),
        scale_(sizes.scale),
        passages_(guides.passages),
        barriers_(guides.barriers),
        lands_(guides.land),
        edit_(edit),
        gained_(gained),
        loop_(loop) {}

  void dropIslands(const SmallWaters& small) {
    const Patches lands = patchesOf(mesh(), [&](TriId t) { return isLand(t); });
    keeps_all_.assign(mesh().triangles.size(), false);
    for (const std::vector<TriId>& land : lands.triangles) {
      if (usesOf(land) & kAround) continue;
      const RegionId water = waterAround(land);
      if (isIn(small, water)) continue;
      if (std::ranges::any_of(land, [&](TriId t) { return isAt(lands_, t, 0.0); })) continue;
      if (water != kNoRegion && isSmall(land)) {
        flip(land, water, EditKind::SmallIsland, firstVertexOf(land));
      } else if (std::ranges::all_of(land, [&](TriId t) { return t_.width[t] < narrowest_; })) {
        for (const TriId t : land) keeps_all_[t] = true;
      }
    }
  }

  void openLand(double narrowest, const SmallWaters& small, std::vector<DroppedSpit>& long_spits) {
    narrowest_ = narrowest;
    dropIslands(small);
    // Removes triangles from the ends, one by one, so that no land is cut in two.
    std::vector<char> thin(mesh().triangles.size(), 0), off(mesh().triangles.size(), 0);
    const auto isEnd = [&](TriId t) {
      int beside = 0;
      for (const EdgeRef e : mesh().triangles[t].adj) beside += isLand(triOf(e)) && off[triOf(e)] == 0 ? 1 : 0;
      return beside <= 1;
    };
    std::vector<TriId> ends = numbersWith(loop_, 0, thin.size(), [&](TriId t) {
      thin[t] = isLand(t) && t_.width[t] < narrowest && !keeps_all_[t] && (usesOf(t) & ~kOnShore) == 0 &&
                !isAt(barriers_, t, 0.0) && !isAt(lands_, t, 0.0);
      return thin[t] != 0 && isEnd(t);
    });
    for (const TriId t : ends) off[t] = 1;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      for (const EdgeRef e : mesh().triangles[ends[i]].adj) {
        const TriId next = triOf(e);
        if (thin[next] != 0 && off[next] == 0 && isEnd(next)) ends.push_back(next), off[next] = 1;
      }
    }
    const Patches spits = patchesOf(mesh(), [&](TriId t) { return off[t] != 0; });
    for (const std::vector<TriId>& spit : spits.triangles) {
      const RegionId water = waterAround(spit);
      const auto gates = gatesOf(spit, spits.of, [&](TriId t) { return isLand(t); });
      const auto [deepest, depth] = deepestOf(spit, gates);
      if (water == kNoRegion || isIn(small, water) || isShallow(spit, gates, depth)) continue;
      const auto [end, length] = farthestAlong(spit, spits.of, gates);
      if (length > kLongSpit * t_.size[end]) {
        const Point place = centreOf(end);
        long_spits.push_back({place, length / scale_.at(place)});
      }
      flip(spit, water, EditKind::DroppedSpit, deepest);
    }
  }

  void openWater(double narrowest, const ConnectedRegions& connected) {
    const std::vector<char> is_narrow = narrowTriangles(narrowest);
    small_ = smallWaters(is_narrow, connected);
    const auto narrow = [&](TriId t) { return is_narrow[t] != 0 && !isIn(small_, mesh().regions[t]); };
    const Patches closed = patchesOf(mesh(), narrow);
    for (const std::vector<TriId>& patch : closed.triangles) {
      const auto gates = gatesOf(patch, closed.of, [&](TriId t) { return !isLand(t); });
      const auto [deepest, depth] = deepestOf(patch, gates);
      if (isShallow(patch, gates, depth)) continue;
      flip(patch, t_.land, EditKind::ClosedWater, gates.size() == 1 ? deepest : mesh().triangles[patch.front()].v[0]);
    }
    parts_ = patchesOf(mesh(), [&](TriId t) { return !isLand(t); }).triangles;
    closeSmall(connected);
  }

  // For each triangle: true if it is water that may be closed.
  std::vector<char> narrowTriangles(double narrowest) const {
    std::vector<char> is_narrow(mesh().triangles.size(), 0);
    forEachByStretches(loop_, is_narrow.size(), [&](std::size_t i) {
      const auto t = static_cast<TriId>(i);
      is_narrow[t] = !isLand(t) && isNarrow(t, narrowest);
    });
    return is_narrow;
  }

  SmallWaters smallWaters(const std::vector<char>& is_narrow, const ConnectedRegions& connected) const {
    const auto largeIn = [&](std::size_t first, std::size_t last) {
      std::vector<std::size_t> large;
      for (auto t = static_cast<TriId>(first); t < last; ++t) {
        if (isLand(t) || is_narrow[t] != 0) continue;
        if (const std::size_t whole = wholeOf(mesh().regions[t], connected); large.empty() || large.back() != whole)
          large.push_back(whole);
      }
      return large;
    };
    SmallWaters small(connected.size(), true);
    for (const std::size_t whole : joined(overStretches(loop_, mesh().triangles.size(), largeIn))) small[whole] = false;
    for (std::size_t r = 0; r < small.size(); ++r) small[r] = small[static_cast<std::size_t>(connected[r])];
    return small;
  }

  // Applies to what `openWater` left, for each water separately.
  void keepWater(KeepWater keep, const ConnectedRegions& connected, std::vector<WaterPart>& waters) {
    struct Whole {
      double area = 0.0, at_open = 0.0, largest_at_open = 0.0;
      std::size_t largest = 0;
    };
    std::map<RegionId, Whole> wholes;
    for (const std::vector<TriId>& part : parts_) {
      const WaterPart& water = waters.emplace_back(partOf(part, connected));
      Whole& whole = wholes.try_emplace(water.whole, Whole{.largest = waters.size() - 1}).first->second;
      whole.area += water.area;
      if (water.at_open) {
        whole.at_open += water.area;
        whole.largest_at_open = std::max(whole.largest_at_open, water.area);
      }
      if (water.area > waters[whole.largest].area) whole.largest = waters.size() - 1;
    }
    for (std::size_t i = 0; i < waters.size(); ++i) {
      WaterPart& water = waters[i];
      const Whole& whole = wholes[water.whole];
      const double grazed = keep == KeepWater::Open ? 0.0 : kGrazed;
      const bool by_opening = keep != KeepWater::Largest && whole.at_open > 0.0 && whole.at_open >= grazed * whole.area;
      water.kept = by_opening ? water.at_open && water.area >= grazed * whole.largest_at_open : i == whole.largest;
      if (water.kept || keep == KeepWater::All) continue;
      for (const auto& [region, area] : water.areas) gained_[region] += area;
      flip(parts_[i], t_.land, EditKind::CutOffWater, firstVertexOf(parts_[i]));
    }
    for (std::size_t i = 0; i < waters.size(); ++i) waters[i].triangles = std::move(parts_[i]);
    parts_.clear();
  }

 private:
  static constexpr RegionId kNoRegion = kUnlabelled;

  const TriMesh& mesh() const { return t_.mesh; }
  static std::size_t wholeOf(RegionId region, const ConnectedRegions& connected) {
    return static_cast<std::size_t>(connected[static_cast<std::size_t>(region)]);
  }
  static bool isIn(const SmallWaters& small, RegionId region) {
    return region >= 0 && static_cast<std::size_t>(region) < small.size() && small[static_cast<std::size_t>(region)];
  }
  bool isLand(TriId t) const { return mesh().regions[t] == t_.land; }
  // True if this triangle of the water may be closed.
  bool isNarrow(TriId t, double narrowest) const {
    return t_.width[t] < narrowest && !hasOffShore(t_, t) && !allOpen(t) &&
           (!isAt(passages_, t, kPassage * t_.size[t]) || isAt(barriers_, t, kPassage * t_.size[t]));
  }
  std::uint8_t usesOf(TriId t) const {
    const auto& v = mesh().triangles[t].v;
    return t_.use[v[0]] | t_.use[v[1]] | t_.use[v[2]];
  }
  std::uint8_t usesOf(const std::vector<TriId>& patch) const {
    std::uint8_t use = 0;
    for (const TriId t : patch) use |= usesOf(t);
    return use;
  }
  bool allOpen(TriId t) const {
    const auto& v = mesh().triangles[t].v;
    return (t_.use[v[0]] & t_.use[v[1]] & t_.use[v[2]] & kOnOpen) != 0;
  }
  double areaOf(TriId t) const {
    const auto& v = mesh().triangles[t].v;
    return 0.5 * cross(mesh().point(v[1]) - mesh().point(v[0]), mesh().point(v[2]) - mesh().point(v[0]));
  }
  Point centreOf(TriId t) const {
    const auto& v = mesh().triangles[t].v;
    return centroid(mesh().point(v[0]), mesh().point(v[1]), mesh().point(v[2]));
  }
  double groundAreaOf(TriId t) const {
    const double scale = scale_.at(centreOf(t));
    return areaOf(t) / scale / scale;
  }
  WaterPart partOf(const std::vector<TriId>& patch, const ConnectedRegions& connected) const {
    WaterPart part;
    part.whole = connected[static_cast<std::size_t>(mesh().regions[patch.front()])];
    part.small = isIn(small_, part.whole);
    struct Sized {
      double area;
      TriId t;
      bool operator<(const Sized& other) const { return area != other.area ? area > other.area : t < other.t; }
    };
    std::vector<Sized> sized(patch.size());
    std::vector<double> areas(patch.size());
    const auto measure = [&](std::size_t i) {
      sized[i] = {areaOf(patch[i]), patch[i]};
      areas[i] = groundAreaOf(patch[i]);
    };
    forEachByStretches(loop_, patch.size(), measure);
    RegionId region = mesh().regions[patch.front()];
    double* in_region = &part.areas[region];
    for (std::size_t i = 0; i < patch.size(); ++i) {
      if (mesh().regions[patch[i]] != region) in_region = &part.areas[region = mesh().regions[patch[i]]];
      part.area += areas[i];
      *in_region += areas[i];
    }
    part.at_open = openingOf(patch) >= kLeastOpening;
    std::vector<Sized> largest(std::min(kPlaces, patch.size()));
    std::partial_sort_copy(sized.begin(), sized.end(), largest.begin(), largest.end());
    for (const Sized& one : largest) part.inside.push_back(centreOf(one.t));
    return part;
  }
  bool isAt(const LineZone& lines, TriId t, double reach) const {
    const auto& v = mesh().triangles[t].v;
    return lines.holds(mesh().point(v[0]), mesh().point(v[1]), mesh().point(v[2]), reach);
  }
  // The length of the patch's open boundary, in elements.
  double openingOf(const std::vector<TriId>& patch) const {
    double opening = 0.0;
    for (const TriId t : patch) {
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(t, i);
        const VertexId a = mesh().origin(e), b = mesh().target(e);
        if (isLand(triOf(mesh().twin(e))) && (t_.use[a] & t_.use[b] & kOnOpen) != 0)
          opening += distance(mesh().point(a), mesh().point(b)) / t_.size[t];
      }
    }
    return opening;
  }
  // The area, in triangles of the size wanted.
  double elementsIn(const std::vector<TriId>& patch) const {
    double elements = 0.0;
    for (const TriId t : patch) elements += areaOf(t) / (kTriangle * t_.size[t] * t_.size[t]);
    return elements;
  }

  // The region of all water beside the patch; kNoRegion if there are several, or an open boundary, or a line or point
  // on it.
  RegionId waterAround(const std::vector<TriId>& patch) const {
    RegionId water = kNoRegion;
    for (const TriId t : patch) {
      if ((usesOf(t) & ~kOnShore) != 0) return kNoRegion;
      for (const EdgeRef e : mesh().triangles[t].adj) {
        const RegionId beside = mesh().regions[triOf(e)];
        if (beside == t_.land) continue;
        if (water != kNoRegion && water != beside) return kNoRegion;
        water = beside;
      }
    }
    return water;
  }

  bool isSmall(const std::vector<TriId>& land) const {
    if (elementsIn(land) >= 1.0) return false;
    Box box;
    double size = std::numeric_limits<double>::infinity();
    for (const TriId t : land) {
      for (const VertexId v : mesh().triangles[t].v) box.add(mesh().point(v));
      size = std::min(size, t_.size[t]);
    }
    return std::max(box.xmax - box.xmin, box.ymax - box.ymin) <= kLongestIsland * size;
  }

  VertexId firstVertexOf(const std::vector<TriId>& patch) const {
    VertexId first = kNone;
    for (const TriId t : patch)
      for (const VertexId v : mesh().triangles[t].v) first = std::min(first, v);
    return first;
  }

  // Edges between the patch and the rest of its kind.
  template <typename Same>
  std::vector<EdgeRef> gatesOf(const std::vector<TriId>& patch, const std::vector<std::uint32_t>& number,
                               Same&& same) const {
    std::vector<EdgeRef> gates;
    for (const TriId t : patch) {
      for (unsigned i = 0; i < 3; ++i) {
        const TriId beside = triOf(mesh().twin(edgeRef(t, i)));
        if (same(beside) && number[beside] != number[t]) gates.push_back(edgeRef(t, i));
      }
    }
    return gates;
  }

  // True if the shore of a patch is much longer than its gates. REQUIRES: all of one kind, water or land.
  bool isWinding(const std::vector<TriId>& patch, const std::vector<EdgeRef>& gates) const {
    double shore = 0.0, opening = 0.0;
    for (const TriId t : patch)
      for (const EdgeRef twin : mesh().triangles[t].adj)
        if (isLand(triOf(twin)) != isLand(t)) shore += lengthOf(twin);
    for (const EdgeRef e : gates) opening += lengthOf(e);
    return shore > kWinding * opening;
  }
  double lengthOf(EdgeRef e) const { return distance(mesh().point(mesh().origin(e)), mesh().point(mesh().target(e))); }

  // The vertex farthest from the gate, and its distance as a share of the size there; infinite unless there is exactly
  // one gate.
  std::pair<VertexId, double> deepestOf(const std::vector<TriId>& patch, const std::vector<EdgeRef>& gates) const {
    if (gates.size() != 1) return {firstVertexOf(patch), std::numeric_limits<double>::infinity()};
    const Point &a = mesh().point(mesh().origin(gates[0])), &b = mesh().point(mesh().target(gates[0]));
    std::pair<VertexId, double> deepest{firstVertexOf(patch), 0.0};
    for (const TriId t : patch) {
      for (const VertexId v : mesh().triangles[t].v) {
        const double depth = std::sqrt(squaredDistanceToSegment(mesh().point(v), a, b)) / t_.size[t];
        if (depth > deepest.second) deepest = {v, depth};
      }
    }
    return deepest;
  }

  // The triangle of the patch with the longest way to the gates, along the middles of crossed edges, and that way.
  std::pair<TriId, double> farthestAlong(const std::vector<TriId>& patch, const std::vector<std::uint32_t>& number,
                                         const std::vector<EdgeRef>& gates) const {
    const auto middleOf = [&](EdgeRef e) {
      return midpoint(mesh().point(mesh().origin(e)), mesh().point(mesh().target(e)));
    };
    std::map<TriId, double> ways;
    using Entry = std::tuple<double, TriId, EdgeRef>;  // way, and the edge by which the triangle is entered
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const EdgeRef gate : gates) queue.emplace(0.0, triOf(gate), gate);
    std::pair<TriId, double> farthest{patch.front(), 0.0};
    while (!queue.empty()) {
      const auto [way, t, entrance] = queue.top();
      queue.pop();
      if (!ways.emplace(t, way).second) continue;
      if (way > farthest.second) farthest = {t, way};
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(t, i), back = mesh().twin(e);
        if (back == kNone || number[triOf(back)] != number[t] || ways.contains(triOf(back))) continue;
        queue.emplace(way + distance(middleOf(entrance), middleOf(e)), triOf(back), back);
      }
    }
    return farthest;
  }

  // True if the patch, `depth` deep, can be left to simplification.
  bool isShallow(const std::vector<TriId>& patch, const std::vector<EdgeRef>& gates, double depth) const {
    if (gates.size() != 1 || isWinding(patch, gates)) return false;
    return depth < std::max(kShallow, kBlunt * lengthOf(gates[0]) / t_.size[triOf(gates[0])]);
  }

  void flip(const std::vector<TriId>& patch, RegionId region, EditKind kind, VertexId place) {
    RegionId water = region;
    for (const TriId t : patch) {
      if (region == t_.land) water = mesh().regions[t];
      gained_[water] += (region == t_.land ? -1.0 : 1.0) * groundAreaOf(t);
      t_.mesh.regions[t] = region;
    }
    edit_(kind, mesh().point(place), water);
  }

  // Closes the smallest parts of each water, but not the largest of its parts.
  void closeSmall(const ConnectedRegions& connected) {
    std::vector<double> elements;
    std::map<std::size_t, std::size_t> largest;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      elements.push_back(elementsIn(parts_[i]));
      const std::size_t whole = wholeOf(mesh().regions[parts_[i].front()], connected);
      std::size_t& most = largest.try_emplace(whole, i).first->second;
      if (elements[i] > elements[most]) most = i;
    }
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const RegionId region = mesh().regions[parts_[i].front()];
      if (elements[i] >= kLeastWater || isIn(small_, region) || largest[wholeOf(region, connected)] == i) continue;
      flip(parts_[i], t_.land, EditKind::ClosedWater, firstVertexOf(parts_[i]));
      parts_[i].clear();
    }
    std::erase_if(parts_, [](const std::vector<TriId>& water) { return water.empty(); });
  }

  ShoreTriangles& t_;
  const ScaleTable& scale_;
  const LineZone passages_, barriers_, lands_;
  const ShoreEdit& edit_;
  WaterAreas& gained_;
  const ItemLoop& loop_;
  double narrowest_ = 0.0;
  std::vector<bool> keeps_all_;
  SmallWaters small_;
  std::vector<std::vector<TriId>> parts_;  // of the opened water
};

}  // namespace

void openLand(ShoreTriangles& triangles, const ShoreSizes& sizes, const ShoreGuides& guides, double narrowest,
              const SmallWaters& small, const ShoreEdit& edit, WaterAreas& gained, std::vector<DroppedSpit>& spits,
              const ItemLoop& loop) {
  Opening(triangles, sizes, guides, edit, gained, loop).openLand(narrowest, small, spits);
  settleShores(triangles, sizes.wanted, loop);
}

ConnectedRegions connectedRegions(const ShoreTriangles& triangles, const ItemLoop& loop) {
  const TriMesh& mesh = triangles.mesh;
  UnionFind sets(static_cast<std::size_t>(triangles.land));
  const auto bordersOf = [&](std::size_t first, std::size_t last) {
    std::vector<std::pair<RegionId, RegionId>> borders;
    for (std::size_t t = first; t < last; ++t) {
      const RegionId region = mesh.regions[t];
      if (region == triangles.land) continue;
      for (const EdgeRef e : mesh.triangles[t].adj)
        if (const RegionId beside = mesh.regions[triOf(e)]; beside != triangles.land && beside != region)
          borders.emplace_back(region, beside);
    }
    return borders;
  };
  if (triangles.land > 1)
    for (const auto& [region, beside] : joined(overStretches(loop, mesh.triangles.size(), bordersOf)))
      sets.unite(static_cast<std::uint32_t>(region), static_cast<std::uint32_t>(beside));
  ConnectedRegions first;
  for (std::uint32_t r = 0; r < static_cast<std::uint32_t>(triangles.land); ++r)
    first.push_back(static_cast<RegionId>(sets.find(r)));
  return first;
}

SmallWaters smallWaters(ShoreTriangles& triangles, const ShoreSizes& sizes, const ShoreGuides& guides, double narrowest,
                        const ConnectedRegions& connected, const ItemLoop& loop) {
  const ShoreEdit none;
  WaterAreas gained;
  const Opening opening(triangles, sizes, guides, none, gained, loop);
  return opening.smallWaters(opening.narrowTriangles(narrowest), connected);
}

OpenedWater openWater(ShoreTriangles& triangles, const ShoreSizes& sizes, const ShoreGuides& guides, double narrowest,
                      KeepWater keep, const ConnectedRegions& connected, const ShoreEdit& edit, WaterAreas& gained,
                      const ItemLoop& loop) {
  OpenedWater opened;
  Opening opening(triangles, sizes, guides, edit, gained, loop);
  opening.openWater(narrowest, connected);
  opening.keepWater(keep, connected, opened.waters);
  for (const WaterPart& water : opened.waters) {
    if (!water.kept && keep != KeepWater::All) continue;
    for (const auto& [region, area] : water.areas) opened.areas[region] += area;
  }
  return opened;
}

}  // namespace coastmesh
