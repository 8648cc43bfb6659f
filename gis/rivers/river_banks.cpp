#include "gis/rivers/river_banks.hpp"

#include <cmath>
#include <iterator>
#include <optional>

#include "gis/coast/coastline.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/coast/unite_frames.hpp"
#include "gis/crs/crs_map.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/places.hpp"
#include "gis/read/read_coastline.hpp"

namespace coastmesh {

void readRiverBanks(const std::string& path, const Crs& crs, RiverBanks& banks, std::vector<std::string>& warnings) {
  ReadReport report;
  // Polygons of one use that touch, as where a data set is divided into tiles, become one.
  Coastline coastline = readCoastline({{path, FeatureUse::Frame}}, {}, report);
  if (!crs.isPlane()) std::ranges::move(report.warnings, std::back_inserter(warnings));
  uniteFrames(coastline);
  std::optional<CrsMap> map;
  if (!crs.isPlane() && !coastline.crs.isPlane() && !sameCrs(crs, coastline.crs))
    map.emplace(toOgr(coastline.crs), toOgr(crs));
  const auto add = [&](Ring ring, const Feature& feature) {
    for (Point& p : ring) {
      const Point given = p;
      if (map) p = map->forward(p);
      if (!std::isfinite(p.x) || !std::isfinite(p.y))
        throw InputError(featureInWords(feature) + ": has a place, (" + placeInWords(given) +
                         "), that the mesh's coordinate system does not reach; take it out");
    }
    for (std::size_t i = 0; i < ring.size(); ++i) banks.edges.emplace_back(ring[i], ring[(i + 1) % ring.size()]);
  };
  for (const Feature& feature : coastline.features)
    for (const Polygon& polygon : feature.polygons) {
      add(polygon.outer, feature);
      for (const Ring& hole : polygon.holes) add(hole, feature);
    }
}

}  // namespace coastmesh
