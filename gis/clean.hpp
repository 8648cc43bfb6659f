#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/pslg.hpp"
#include "gis/coastline.hpp"
#include "gis/projection.hpp"

namespace coastmesh {

struct CleanOptions {
  double snap_m = 0.001;            // metres, 0 or more: points nearer than this become one (0 for a plane input)
  double simplify_m = 0.0;          // metres, 0 or more: Douglas-Peucker that keeps the topology
  double min_island_area_m2 = 0.0;  // square metres, 0 or more: smaller holes are filled
};

enum class EditKind {
  RepeatedPoint,    // a point that repeats the one before it, or comes nearer to it than the snap distance
  Spike,            // an edge that runs out and back along itself
  SelfCrossing,     // two edges of a feature cross: a vertex was put there
  FeaturesCross,    // edges of two features cross
  TouchingRing,     // a ring meets another, or itself, in a vertex
  OverlappingEdge,  // two edges run along one another
  DegenerateRing,   // a ring without area was dropped
  SmallIsland,      // dropped for `min_island_area_m2`
  SimplifiedPoint,  // dropped for `simplify_m`
};
inline constexpr std::size_t kEditKinds = 9;
std::string_view toString(EditKind kind);

// One change made to the input.
struct Edit {
  EditKind kind;
  Point place;  // in the input's CRS
  std::int64_t fid = 0;
};

struct CleanReport {
  std::vector<Edit> edits;
  std::array<std::uint64_t, kEditKinds> counts{};
};

// A group of features as a valid PSLG in the working plane.
struct Domain {
  Pslg pslg;  // labelled: a segment's sides hold the index of a feature in `Coastline::features`, or kOutside
  std::vector<Point> input_points;  // one a point of the PSLG: where it lies in the input's CRS, the input's own bits
  Projection projection = Projection::plane();
};

// Projects and cleans `coastline.features[members]`. A polygon's inside is even-odd over the rings of its feature;
// where two features overlap, the one that comes first keeps the place. Throws InputError for a group that encloses no
// area.
Domain cleanFeatures(const Coastline& coastline, const std::vector<std::size_t>& members, const Projection& projection,
                     const CleanOptions& options, CleanReport& report);

// Area of the group's polygons on the ellipsoid (or in the plane), holes taken out, in square metres, edges geodesic.
double geodesicArea(const Coastline& coastline, const std::vector<std::size_t>& members);

}  // namespace coastmesh
