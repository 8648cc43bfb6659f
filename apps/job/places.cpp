#include "apps/job/places.hpp"

#include "gis/coast/feature_names.hpp"

namespace coastmesh {

std::string pointText(const Point& point) { return "(" + placeInWords(point) + ")"; }

std::string featureText(const Feature& feature) {
  return "'" + feature.source + "'" + (feature.fid < 0 ? "" : ", feature " + std::to_string(feature.fid));
}

}  // namespace coastmesh
