#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "core/item_loop.hpp"
#include "core/pslg.hpp"
#include "gis/coastline.hpp"
#include "gis/error.hpp"
#include "gis/projection.hpp"
#include "gis/resolution.hpp"

namespace coastmesh {

// What becomes of a place where rings, or a ring with itself, touch in one vertex.
enum class Pinches {
  Keep,  // the vertex stays in both; it is told of
  Open,  // land gives way a little, so that water passes: see `openPinches`
};

struct CleanOptions {
  double snap_m = 0.001;            // metres, 0 or more: points nearer than this become one (0 for a plane input)
  double simplify_m = 0.0;          // metres, 0 or more: no shore is moved further than this; see `simplifyEdges`
  double min_island_area_m2 = 0.0;  // square metres, 0 or more: smaller holes are filled
  bool dissolve = false;            // areas that share an edge become one, and the edge goes
  Pinches pinches = Pinches::Keep;
};

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
  WidenedPassage,   // a passage that the user named: land beside it gave way, by `followSizes`
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
  std::vector<std::string> notes;  // what was decided where the input left a choice
  std::array<std::uint64_t, kEditKinds> counts{};

  void add(EditKind kind, const Point& place, std::int64_t fid) {
    edits.push_back({kind, place, fid});
    ++counts[static_cast<std::size_t>(kind)];
  }
  void append(CleanReport&& more) {
    edits.insert(edits.end(), more.edits.begin(), more.edits.end());
    std::ranges::move(more.notes, std::back_inserter(notes));
    for (std::size_t kind = 0; kind < kEditKinds; ++kind) counts[kind] += more.counts[kind];
  }
};

// A line that the user named, with the domain on both sides: where features with lines run along one another, weirs
// come before constraints and these before borders of regions, of the same use the first feature.
struct DomainLine {
  std::size_t feature = 0;                  // index in `Coastline::features`
  FeatureUse use = FeatureUse::Constraint;  // Constraint, Weir or Region
  std::string name;                         // empty: none was given
  bool borders_region = false;              // a region has its border there, whatever else the line is
};

// A group of features as a valid PSLG in the working plane.
struct Domain {
  Pslg pslg;  // labelled: a segment's sides hold the index of a feature in `Coastline::features`, or kOutside
  std::vector<Point> input_points;  // one a point of the PSLG: where it lies in the input's CRS, the input's own bits
  Projection projection = Projection::plane();
  std::vector<DomainLine> lines{};  // what tags of segments refer to: see segment_tags.hpp
  Resolution resolution;            // what changes the domain further has to keep
};

// The group lies outside of the frame, or apart from the water asked for: there is nothing to mesh, and nothing wrong.
struct NothingWanted : InputError {
  using InputError::InputError;
};

// Projects and cleans `coastline.features[members]`, each feature by its use. A polygon's inside is even-odd over the rings of its feature;
// where two features overlap, the one that comes first keeps the place. Open lines inside become segments with the same
// label on both sides; those outside vanish. Where longitudes span exactly 360 degrees and the projection brings the
// first and the last meridian together, the cut along them is healed. Points of the PSLG come in the order of the
// input, new ones last. Throws NothingWanted, and InputError for a group that encloses no area, for coasts that do not part water
// from land, and for a point that the projection cannot map.
Domain cleanFeatures(const Coastline& coastline, const std::vector<std::size_t>& members, const Projection& projection,
                     const CleanOptions& options, CleanReport& report, const ItemLoop& loop = inOrder);

// Area of the group's polygons on the ellipsoid (or in the plane), holes taken out, in square metres, edges geodesic.
double geodesicArea(const Coastline& coastline, const std::vector<std::size_t>& members,
                    const ItemLoop& loop = inOrder);

// Area of what the domain's labels hold, as above.
double geodesicArea(const Domain& domain, const Crs& crs);

}  // namespace coastmesh
