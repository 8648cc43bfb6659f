#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
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
#include "gis/size/size_distance.hpp"
#include "gis/size/size_features.hpp"
#include "gis/size/size_field.hpp"

namespace coastmesh {

struct RasterReaders;

enum class CoastDetail { Keep, Follow };

// The requested sizes of elements: edge lengths in metres on the ground; infinite: not used.
struct SizeOptions {
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  double size_m = kNone;                  // everywhere
  double least_m = 0.0;                   // minimum size
  double most_m = kNone;                  // maximum size
  double gradation = 0.3;                 // above 0: sizes at two places differ by at most this times their distance
  double shore_m = kNone;                 // at the shore
  double shore_rate = 0.15;               // how fast that grows with the distance
  double channel_elements = 0.0;          // across the water; 0: not used
  std::vector<std::string> features{};    // vector files with an attribute `size`
  std::vector<std::string> rasters{};     // of sizes, in metres; the first that covers a place is used
  std::vector<std::string> bathymetry{};  // the first that covers a place is used
  DepthRules depth{};
  GapFill gaps = GapFill::Mean;  // depths used where `bathymetry` has none
  double time_step_s = 0.0;      // 0: not used
  double courant = 1.0;          // above 0
  double least_courant = 0.0;    // of `time_step_s`: see `DepthRules::crossing_s`; 0: not used

  CoastDetail coast = CoastDetail::Keep;            // Follow: the shore is generalised to the elements beside it
  FollowOptions follow{};                           // options of Follow
  std::vector<std::string> passages{}, barriers{};  // vector files with lines: see `ShoreGuides`
  double passage_elements = 1.0;
  bool keep_water_given = false;  // false: a model's grid keeps the water connected to an open boundary

  bool choose = false;  // sizes are to be chosen: `chooseSizes`
  struct {
    bool shore_rate = false, gradation = false, time_step = false, coast = false;
  } given{};  // options beside chosen sizes that the user gave

  // The size asked for along shores, before other sources and time steps; infinite if there is none.
  double atShores() const { return std::min({size_m, shore_m, most_m}); }
  // The largest size that is known to apply along shores, where a time step may ask for more than `shore_m`; 0 if none
  // is known before there is a map.
  double mostAtShores() const {
    const double elsewhere = std::min(size_m, most_m);
    const double most = time_step_s > 0.0 && elsewhere < kNone ? elsewhere : atShores();
    return most < kNone ? std::max(most, least_m) : 0.0;
  }
  // True if anything other than bounds is requested.
  bool any() const {
    return choose || size_m < kNone || shore_m < kNone || channel_elements > 0.0 || !features.empty() ||
           !rasters.empty() || depth.any();
  }
};

// The vector files that the options name.
struct SizeLayers {
  std::vector<SizedFeatures> features;
  std::vector<ShoreLine> passages, barriers;  // in the input's CRS
};

// The data that the options name, read once for all groups of features.
struct SizeInputs {
  std::shared_ptr<const SizeLayers> layers = std::make_shared<const SizeLayers>();
  std::vector<RasterGeometry> rasters, bathymetry;
  Crs crs;                                 // of the input
  const RasterReaders* readers = nullptr;  // readers of rasters; null: only the caller
  // The domain's graph without the parts of its boundary that will be open although their tags do not say so; nullopt
  // if there are none. The function may be empty.
  std::function<std::optional<Pslg>(const Domain& domain, const SizeOptions& options, const ItemLoop& loop)> shoreOf;
  // The domain with these parts tagged as open. The function may be empty.
  std::function<Domain(Domain&& domain, const SizeOptions& options, const ItemLoop& loop)> opened;
  // Lines in the plane of the only domain, with the lengths of elements that stay beside them. Whatever is requested,
  // sizes differ from these by at most the gradation times the distance.
  std::vector<SizedLine> rim;
};

// How the lines of `SizeInputs::rim` change what is requested.
struct RimReach {
  double width_m = 0.0;  // the distance over which sizes change between the rim and what is requested beside it
  double share = 0.0;    // of the domain: sizes differ from what is requested; estimated from samples
};

// Throws InputError.
SizeLayers readSizeLayers(const SizeOptions& options, const Crs& crs);

// Reads the vector files too if `layers` is null. Throws InputError.
SizeInputs readSizeInputs(const SizeOptions& options, const Crs& crs,
                          std::shared_ptr<const SizeLayers> layers = nullptr);

// The number of vertices that sizes require, and where most of them are.
struct VertexDemand {
  double vertices = 0.0;       // without those of segments, see `verticesOfSegments`
  Point place;                 // in the input's CRS
  double size_m = 0.0;         // size there
  std::string option;          // option that requests it
  bool map_too_large = false;  // a fine enough map of the sizes is impossible
};

// The water for which no raster has a depth, and whose sizes follow from depths around it.
struct FilledWater {
  double area_m2 = 0.0;  // 0: none
  Point place;           // in the input's CRS
};

// Sizes require more vertices than there is room for.
struct TooManyVertices : std::runtime_error {
  explicit TooManyVertices(VertexDemand d);
  VertexDemand demand;
};

// The smallest size that the options can request, metres; 0 if unknown in advance.
double leastWanted(const SizeOptions& options, const SizeInputs& inputs);

// The error of sizes between the places where they are evaluated: a few hundredths (Fine) or a tenth (Rough), which
// takes half the time and suffices for a coast that follows the sizes. With Rough, sizes that grow only with the
// distance from the shore are evaluated at each place, without a map, and the demand is unknown.
enum class SizeAccuracy { Fine, Rough };

// The part of the shore where the time step requires larger sizes than `SizeOptions::shore_m` requests; metres.
struct RaisedShore {
  double length_m = 0.0, raised_m = 0.0;  // of the whole shore, and of this part; both estimated from samples
  double most_m = 0.0;                    // the largest size there

  void add(const RaisedShore& other) {
    length_m += other.length_m;
    raised_m += other.raised_m;
    most_m = std::max(most_m, other.most_m);
  }
};

struct DomainSizes {
  std::unique_ptr<SizeFunction> function;  // of places in the domain's plane; lengths on the surface it represents
  VertexDemand demand;
  // If the distance from the shore alone determines sizes and there is no map: their growth with it, and the size at
  // the shore, in metres on the ground. Otherwise NaN.
  double rate = std::numeric_limits<double>::quiet_NaN(), shore_m = rate;
  FilledWater filled{};
  bool has_shore = true;  // false: sizes at the shore are requested, but there is none
  RaisedShore raised{};
  RimReach rim{};
  double floor_m = 0.0;  // the largest size that the time step requires anywhere, estimated from samples
};

// The sizes of a domain: the minimum that any of the options requests, within the bounds, not below what the time step
// allows, graded. `loop` provides threads; the function does not depend on it. Throws InputError, BadPslg;
// TooManyVertices if they require more than `most_vertices`: the demand then has the right order of magnitude, and was
// found with little memory.
DomainSizes makeSizeFunction(const SizeOptions& options, const SizeInputs& inputs, const Domain& domain,
                             double most_vertices, const ItemLoop& loop, SizeAccuracy accuracy = SizeAccuracy::Fine);

}  // namespace coastmesh
