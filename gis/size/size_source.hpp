#pragma once

#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "core/size/size_tree.hpp"
#include "gis/clean/clean.hpp"
#include "gis/follow/follow_options.hpp"
#include "gis/follow/shore_guides.hpp"
#include "gis/raster/raster_band.hpp"
#include "gis/size/size_depth.hpp"
#include "gis/size/size_features.hpp"
#include "gis/size/size_field.hpp"

namespace coastmesh {

struct RasterReaders;

enum class CoastDetail { Keep, Follow };

// How large elements should be. Sizes are lengths of edges in metres on the ground; an infinite one asks for nothing.
struct SizeOptions {
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  double size_m = kNone;                // everywhere
  double least_m = 0.0;                 // no size below
  double most_m = kNone;                // none above
  double gradation = 0.3;               // above 0: sizes at two places differ by at most this times their distance
  double shore_m = kNone;               // at the shore
  double shore_rate = 0.15;             // how fast that grows with the distance
  double channel_elements = 0.0;        // across the water; 0 asks for nothing
  std::vector<std::string> features;    // vector files with an attribute `size`
  std::vector<std::string> rasters;     // of sizes, in metres; of those that cover a place the first counts
  std::vector<std::string> bathymetry;  // the first that covers a place counts
  DepthRules depth;
  double time_step_s = 0.0;  // 0 asks for nothing
  double courant = 1.0;      // above 0

  CoastDetail coast = CoastDetail::Keep;        // Follow: the shore is made as coarse as the elements beside it
  FollowOptions follow;                         // how
  std::vector<std::string> passages, barriers;  // vector files with lines: see `ShoreGuides`
  double passage_elements = 1.0;
  bool keep_water_given = false;  // where not, a model's grid keeps what hangs together with an open boundary

  bool choose = false;  // sizes are chosen for each domain: `chooseSizes`

  // Whether anything but bounds is asked for.
  bool any() const {
    return choose || size_m < kNone || shore_m < kNone || channel_elements > 0.0 || !features.empty() ||
           !rasters.empty() || depth.any();
  }
};

// What the options name, read once for all groups of features.
struct SizeInputs {
  std::vector<SizedFeatures> features;
  std::vector<RasterGeometry> rasters, bathymetry;
  std::vector<ShoreLine> passages, barriers;  // in the input's CRS
  Crs crs;                                    // of the input
  const RasterReaders* readers = nullptr;     // who reads rasters; null: the caller alone
};

// Throws InputError.
SizeInputs readSizeInputs(const SizeOptions& options, const Crs& crs);

// How many vertices sizes ask for, and where most of them lie.
struct VertexDemand {
  double vertices = 0.0;       // without those that segments add, see `verticesOfSegments`
  Point place;                 // in the input's CRS
  double size_m = 0.0;         // wanted there
  std::string option;          // that asks for it
  bool map_too_large = false;  // no fine enough map of the sizes could be made
};

// They ask for more than there is room for.
struct TooManyVertices : std::runtime_error {
  explicit TooManyVertices(VertexDemand d);
  VertexDemand demand;
};

// No size that the options ask for is less, metres; 0 where that is not known before they are looked for.
double leastWanted(const SizeOptions& options, const SizeInputs& inputs);

// How far sizes may be off between the places that they are measured at: a few hundredths, or a tenth, which takes half
// the time and is enough for a coast that is to follow them. Where they grow with the distance from the shore alone
// there is no map for that: each place is measured, and the demand is not known.
enum class SizeAccuracy { Fine, Rough };

struct DomainSizes {
  std::unique_ptr<SizeFunction> function;  // of places in the domain's plane; lengths on the surface it stands for
  VertexDemand demand;
  // Where the distance from the shore alone decides on sizes and there is no map: how fast they grow with it, and what
  // they are on the shore, in metres on the ground. Else NaN.
  double rate = std::numeric_limits<double>::quiet_NaN(), shore_m = rate;
};

// The sizes of a domain: the least that any of the options asks for, within the bounds, not below what the time step
// allows, graded. `loop` lends threads; the function does not depend on it. Throws InputError, BadPslg; TooManyVertices
// where they ask for more than `most_vertices`: then the demand is right in its order of magnitude, and little memory
// was taken to find it.
DomainSizes makeSizeFunction(const SizeOptions& options, const SizeInputs& inputs, const Domain& domain,
                             double most_vertices, const ItemLoop& loop, SizeAccuracy accuracy = SizeAccuracy::Fine);

}  // namespace coastmesh
