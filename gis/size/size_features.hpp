#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/crs/crs.hpp"
#include "gis/crs/space_ball.hpp"
#include "gis/projection/projection.hpp"
#include "gis/size/size_distance.hpp"
#include "gis/size/size_field.hpp"

namespace coastmesh {

// Points, lines and polygons with a size on and in them.
struct SizedFeatures {
  struct Part {
    std::vector<Polygon> polygons;          // inside is even-odd over all rings
    std::vector<std::vector<Point>> lines;  // a point is a line with one point
    double size_m = 0.0;
    double rate = 0.0;
    SpaceBall ball;  // around all points
  };
  Crs crs;
  std::vector<Part> parts;
};

// The water for which fields are made.
struct FeatureScope {
  std::optional<SpaceBall> ball{};                          // around it; nullopt: unknown
  double most_m = std::numeric_limits<double>::infinity();  // larger sizes have no effect
  double rate = 0.0;                                        // features' rates are not limited to less than this
};

// Reads what `openSource` opens: all vector layers, or the one that `path` names. The attribute `size` (metres, above
// 0) is the size, the optional attribute `rate` its growth with the distance; otherwise `usual_rate`. Transforms
// coordinates to `crs`; a source without a CRS is assumed to be in it. Throws InputError: unreadable, damaged, no
// attribute `size`, a size that is not above 0 or a rate below 0, no transformation between the CRS.
SizedFeatures readSizedFeatures(const std::string& path, const Crs& crs, double usual_rate);

// The fields of such features: their size inside polygons, growing with the distance around all of them. Edges are
// straight in the CRS of the features. Parts of lines that leave the area of the projection are dropped, and features
// that are too far from the scope to have an effect there. `scale` is plane length over metres; distances are
// those on the projection's surface.
std::vector<std::unique_ptr<SizeField>> featureFields(const SizedFeatures& features, const Projection& projection,
                                                      const std::function<double(const Point&)>& scale,
                                                      const FeatureScope& scope = {});

}  // namespace coastmesh
