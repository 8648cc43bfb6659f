#pragma once

#include <functional>
#include <map>

#include "core/size_function.hpp"
#include "gis/clean/clean.hpp"
#include "gis/projection/scale_table.hpp"

namespace coastmesh {

// Called with the kind of an edit, a point in the plane and the region of water beside it.
using ShoreEdit = std::function<void(EditKind, const Point&, RegionId)>;

// Square metres on the ground, by region of water.
using WaterAreas = std::map<RegionId, double>;

struct ShoreSizes {
  const SizeFunction& wanted;
  const ScaleTable& scale;  // plane length over length on the ground
};

}  // namespace coastmesh
