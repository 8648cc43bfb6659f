#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "core/point.hpp"

namespace coastmesh {

enum class EditKind {
  RepeatedPoint,    // a point that repeats the one before it, or comes nearer to another than the snap distance
  Spike,            // an edge that runs out and back along itself
  SelfCrossing,     // two edges of a feature cross: a vertex was put there
  FeaturesCross,    // edges of two features cross: a vertex was put there
  TouchingRing,     // a ring meets another, or itself, in a vertex: the domain is pinched there (nothing was changed)
  OverlappingEdge,  // two edges run along one another, or a vertex lies on an edge: made to meet in vertices
  DegenerateRing,   // a ring without area was dropped
  SmallIsland,      // dropped for `min_island_area_m2`
  SimplifiedPoint,  // dropped for `simplify_m`
  FeaturesOverlap,  // a place lies in two features: the first of them keeps it; the edit names the other
  MisplacedRing,    // a hole outside its outer ring, or an outer ring inside another: taken by the even-odd rule
  OutsideWater,     // a point asked for as a vertex lies outside of the domain: dropped
  DissolvedEdge,    // an edge between two features, or a vertex that only such an edge had made: dropped by `dissolve`
  OpenedPinch,      // water passes where rings touched, or crossed, in a vertex: made by `Pinches::Open`
  ClosedWater,      // water narrower or smaller than the elements wanted there: closed by `followSizes`
  DroppedSpit,      // land narrower than these that ends in water: dropped by `followSizes`
  CutOffWater,      // water cut off where narrow water was closed: left out by `followSizes`
  MovedPoint,       // a point of the shore: moved by `followSizes` within half the size wanted there
  WidenedPassage,   // one that the user named, or that alone joins waters: land beside it gave way, by `followSizes`
  Barrier,          // water on a line that the user named: closed by `followSizes`
};
inline constexpr std::size_t kEditKinds = 20;
std::string_view toString(EditKind kind);  // "repeated point"

// One change made to the input.
struct Edit {
  EditKind kind;
  Point place;  // in the input's CRS
  std::int64_t fid = 0;
};

struct CleanReport {
  std::vector<Edit> edits;
  std::vector<std::string> notes;     // what was decided where the input left a choice
  std::vector<std::string> warnings;  // what of that costs more than people may expect
  std::array<std::uint64_t, kEditKinds> counts{};

  void add(EditKind kind, const Point& place, std::int64_t fid) {
    edits.push_back({kind, place, fid});
    ++counts[static_cast<std::size_t>(kind)];
  }
  void append(CleanReport&& more) {
    edits.insert(edits.end(), more.edits.begin(), more.edits.end());
    std::ranges::move(more.notes, std::back_inserter(notes));
    std::ranges::move(more.warnings, std::back_inserter(warnings));
    for (std::size_t kind = 0; kind < kEditKinds; ++kind) counts[kind] += more.counts[kind];
  }
};

}  // namespace coastmesh
