#include "gis/crs_map.hpp"

#include <functional>
#include <limits>
#include <thread>
#include <utility>

#include "gis/error.hpp"
#include "gis/ogr_support.hpp"

namespace coastmesh {

namespace {

Point transform(OGRCoordinateTransformation& by, const Point& p) {
  double x = p.x, y = p.y;
  if (by.Transform(1, &x, &y)) return {x, y};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {nan, nan};
}

std::string named(const OGRSpatialReference& srs) { return srs.GetName() ? srs.GetName() : "unnamed"; }

}  // namespace

CrsMap::CrsMap(const OGRSpatialReference& from, const OGRSpatialReference& to) {
  const OgrErrors errors;
  first_.reset(OGRCreateCoordinateTransformation(&from, &to));
  const Transformation back(first_ ? first_->GetInverse() : nullptr);
  if (!first_ || !back) {
    throw InputError("PROJ knows no way from the CRS " + named(from) + " to " + named(to) +
                     (errors.text().empty() ? "" : " (" + errors.text() + ")"));
  }
  first_->SetEmitErrors(false);
}

CrsMap::Shelf& CrsMap::shelfOfThread() const {
  return shelves_[std::hash<std::thread::id>{}(std::this_thread::get_id()) % shelves_.size()];
}

CrsMap::Pair CrsMap::take() const {
  Shelf& shelf = shelfOfThread();
  {
    const std::lock_guard lock(shelf.mutex);
    if (!shelf.idle.empty()) {
      Pair pair = std::move(shelf.idle.back());
      shelf.idle.pop_back();
      return pair;
    }
  }
  const std::lock_guard lock(first_mutex_);
  Pair pair{Transformation(first_->Clone()), Transformation(first_->GetInverse())};
  pair.forward->SetEmitErrors(false);
  pair.inverse->SetEmitErrors(false);
  return pair;
}

void CrsMap::giveBack(Pair pair) const {
  Shelf& shelf = shelfOfThread();
  const std::lock_guard lock(shelf.mutex);
  shelf.idle.push_back(std::move(pair));
}

Point CrsMap::forward(const Point& p) const {
  Pair pair = take();
  const Point image = transform(*pair.forward, p);
  giveBack(std::move(pair));
  return image;
}

Point CrsMap::inverse(const Point& p) const {
  Pair pair = take();
  const Point image = transform(*pair.inverse, p);
  giveBack(std::move(pair));
  return image;
}

OGRSpatialReference geographicBase(const Crs& crs) {
  const OGRSpatialReference srs = toOgr(crs);
  const std::unique_ptr<OGRSpatialReference> base(srs.CloneGeogCS());
  if (!base) throw InputError("the CRS " + nameOf(crs) + " has no longitudes and latitudes");
  OGRSpatialReference result(*base);
  // Degrees, whatever the base of the projected CRS measures in (grads, for some French ones).
  result.SetAngularUnits(SRS_UA_DEGREE, CPLAtof(SRS_UA_DEGREE_CONV));
  result.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return result;
}

}  // namespace coastmesh
