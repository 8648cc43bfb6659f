#pragma once

#include <limits>

#include "core/item_loop.hpp"
#include "core/size_function.hpp"
#include "gis/clean/clean.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/follow/follow_options.hpp"
#include "gis/follow/shore_guides.hpp"
#include "gis/follow/shore_sizes.hpp"
#include "gis/shore/data_shores.hpp"

namespace coastmesh {

// Known properties of a domain that is to follow sizes.
struct FollowStart {
  double thinned_m = 0.0;            // shores were thinned for a size of so many metres on the ground: `thinToLeast`
  WaterAreas gained{};               // by that, for each region
  const DataShores* data = nullptr;  // shores before that; null: those of the domain
  // If the distance from the shore alone determines sizes: their growth with it, and the size at the shore, in metres
  // on the ground. Otherwise NaN.
  double rate = std::numeric_limits<double>::quiet_NaN(), shore_m = rate;
};

// Removes detail of shores finer than the smallest size anywhere, in metres on the ground (`thinShores`), if
// worthwhile: the cost of later steps, above all of maps of sizes, depends on what is left. Changes go to the report,
// and to `start`.
Domain thinToLeast(Domain&& domain, double least_m, const FollowOptions& options, const Coastline& coastline,
                   const ShoreGuides& guides, CleanReport& report, FollowStart& start, const ItemLoop& loop = inOrder);

// Generalises the shore to the sizes: narrow land that ends in water and small islands are removed, narrow and
// small water is closed (`openLand`, `openWater`), shores get segments about as long as the size (`coarsenShores`),
// and what is still short, sharp or narrow is repaired by moving vertices by up to half the size (`mendShores`). If
// the area of a water would differ by more than half a percent, its shores are moved by up to a tenth of the size
// (`shiftShores`). Nothing crosses. Lines in the water end at the new shore, with segments of about the size
// (`returnLines`); open boundaries keep their corners. Changes go to the report, with notes on the largest waters that
// were cut off, the longest straits that were closed, lines and points that were left out, and the effect of `guides`,
// which are applied first. A graph without labels is labelled first, by its holes. Throws BadPslg if that is
// impossible. Sizes are lengths on the projection's surface; shores are measured in its plane, which is conformal, with
// the local scale. `loop` provides threads; the result does not depend on it.
Domain followSizes(Domain&& domain, const SizeFunction& wanted, const FollowOptions& options,
                   const Coastline& coastline, CleanReport& report, const ShoreGuides& guides = {},
                   const ItemLoop& loop = inOrder, FollowStart start = {});

// The largest factor by which sizes have grown: at vertices of shores, and at all others.
struct SizeGrowth {
  double shore = 0.0, elsewhere = 0.0;
};
SizeGrowth growthOf(const Pslg& pslg, const SizeFunction& before, const SizeFunction& after,
                    const ItemLoop& loop = inOrder);

// Coarsens the boundaries of a domain that follows sizes where the new ones are larger. Opens and closes nothing, so
// nothing in the domain should be much narrower than these.
Domain coarsenFurther(Domain&& domain, const SizeFunction& size, const Coastline& coastline, CleanReport& report,
                      const ItemLoop& loop = inOrder);

// Adds a warning, with a place, if boundaries of a domain that follows sizes still have segments much shorter than
// these, other than at lines in the water and requested points, or in water narrower than the sizes.
void warnOfShortSegments(const Domain& followed, const SizeFunction& size, CleanReport& report,
                         const ItemLoop& loop = inOrder);

}  // namespace coastmesh
