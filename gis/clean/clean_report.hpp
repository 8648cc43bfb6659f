#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "core/point.hpp"
#include "gis/clean/followed_waters.hpp"
#include "gis/coast/coastline.hpp"

namespace coastmesh {

enum class EditKind {
  RepeatedPoint,    // a point that repeats the previous one, or is within the snap distance of another
  Spike,            // an edge that runs back along itself
  SelfCrossing,     // two edges of a feature cross: a vertex was inserted
  FeaturesCross,    // edges of two features cross: a vertex was inserted
  TouchingRing,     // a ring meets another, or itself, in a vertex: the domain is pinched there (unchanged)
  OverlappingEdge,  // two edges overlap, or a vertex lies on an edge: made to meet in vertices
  DegenerateRing,   // a ring without area was dropped
  SmallIsland,      // dropped for `min_island_area_m2`
  SimplifiedPoint,  // dropped for `simplify_m`
  FeaturesOverlap,  // an area is in two features: the first of them applies; the edit names the other
  MisplacedRing,    // a hole outside its outer ring, or an outer ring inside another: taken by the even-odd rule
  OutsideWater,     // a point requested as a vertex is outside the domain: dropped
  DissolvedEdge,    // an edge between two features, or a vertex left by such edges: dropped by `dissolve`
  OpenedPinch,      // water can pass where rings touched, or crossed, in a vertex: made by `Pinches::Open`
  ClosedWater,      // water narrower or smaller than the elements there: closed by `followSizes`
  DroppedSpit,      // land narrower than the elements there that ends in water: dropped by `followSizes`
  CutOffWater,      // water cut off by closing narrow water: left out by `followSizes`
  MovedPoint,       // a point of the shore: moved by `followSizes`, by at most half the size there
  WidenedPassage,   // given by the user, or the only connection of waters: land beside it receded, by `followSizes`
  Barrier,          // water on a line given by the user: closed by `followSizes`
  RepeatedRing,     // an island, or an outer ring, that its feature has twice: counted once
};
inline constexpr std::size_t kEditKinds = 21;
std::string_view toString(EditKind kind);  // "repeated point"

// One change to the input.
struct Edit {
  EditKind kind;
  Point place;  // in the input's CRS
  std::int64_t fid = 0;
  std::uint32_t feature = 0;  // index in the coastline, since fids of several sources may be equal
};

struct CleanReport {
  std::vector<Edit> edits;
  std::vector<std::string> notes;     // decisions where the input was ambiguous
  std::vector<std::string> warnings;  // decisions that cost more than users may expect
  std::vector<std::string> idle;      // inputs without effect on this group: noted if true of all groups
  // Features whose lines or borders are edges within the domain, or repeat lines of such features; ascending.
  std::vector<std::uint32_t> took_part;
  FollowedWaters waters;
  std::array<std::uint64_t, kEditKinds> counts{};

  void add(EditKind kind, const Point& place, const Coastline& coastline, std::size_t feature) {
    edits.push_back({kind, place, coastline.features[feature].fid, static_cast<std::uint32_t>(feature)});
    ++counts[static_cast<std::size_t>(kind)];
  }
  void append(CleanReport&& more) {
    edits.insert(edits.end(), more.edits.begin(), more.edits.end());
    std::ranges::move(more.notes, std::back_inserter(notes));
    std::ranges::move(more.warnings, std::back_inserter(warnings));
    std::ranges::move(more.idle, std::back_inserter(idle));
    took_part.insert(took_part.end(), more.took_part.begin(), more.took_part.end());
    waters.append(std::move(more.waters));
    for (std::size_t kind = 0; kind < kEditKinds; ++kind) counts[kind] += more.counts[kind];
  }
};

}  // namespace coastmesh
