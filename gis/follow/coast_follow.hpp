#pragma once

#include <limits>

#include "core/item_loop.hpp"
#include "core/size_function.hpp"
#include "gis/clean/clean.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/follow/follow_options.hpp"
#include "gis/follow/shore_guides.hpp"
#include "gis/follow/shore_sizes.hpp"

namespace coastmesh {

// What is known beforehand of a domain that is to follow sizes.
struct FollowStart {
  double thinned_m = 0.0;  // shores were thinned for sizes of so many metres on the ground: `thinToLeast`
  WaterAreas gained{};     // by that
  // How fast sizes grow with the distance from the shore, where that alone decides on them, and what they are there, in
  // metres on the ground. Else NaN.
  double rate = std::numeric_limits<double>::quiet_NaN(), shore_m = rate;
};

// Takes out of shores what is finer than the least size wanted anywhere, in metres on the ground (`thinShores`), if
// that is worth it: what is done next, maps of sizes above all, costs by what is left. What was changed goes to the
// report, and to `start`.
Domain thinToLeast(Domain&& domain, double least_m, const FollowOptions& options, const Coastline& coastline,
                   const ShoreGuides& guides, CleanReport& report, FollowStart& start, const ItemLoop& loop = inOrder);

// Makes the shore that of a sea seen at the sizes wanted: narrow land that ends in water and small islands go, narrow
// and small water is closed (`openLand`, `openWater`), shores get segments about as long as the size (`coarsenShores`),
// and what is still short, sharp or narrow is mended by moving vertices by up to half the size (`mendShores`). Where
// the area of a water would differ by more than half a percent, its shores are moved by up to a tenth of the size
// (`shiftShores`). Nothing crosses. Lines inside the water stay as they are, open boundaries keep their corners. What
// was changed goes to the report, with notes on the largest waters that were cut off, the longest straits that were
// closed, and what became of `guides`, which come first of all. A graph without labels is labelled first, by its holes.
// Throws BadPslg where that cannot be. Sizes are lengths on the projection's surface, shores are measured in its plane,
// which is conformal: as long there as the surface's lengths are at the place. `loop` lends threads; the result does
// not depend on it.
Domain followSizes(Domain&& domain, const SizeFunction& wanted, const FollowOptions& options,
                   const Coastline& coastline, CleanReport& report, const ShoreGuides& guides = {},
                   const ItemLoop& loop = inOrder, FollowStart start = {});

// By what sizes have become larger, at most: at vertices of shores, and at all others.
struct SizeGrowth {
  double shore = 0.0, elsewhere = 0.0;
};
SizeGrowth growthOf(const Pslg& pslg, const SizeFunction& before, const SizeFunction& after,
                    const ItemLoop& loop = inOrder);

// Makes the boundaries of a domain that follows sizes as coarse as ones that are larger in places. Nothing is opened or
// closed: for what is not much narrower than these.
Domain coarsenFurther(Domain&& domain, const SizeFunction& size, const Coastline& coastline, CleanReport& report);

}  // namespace coastmesh
