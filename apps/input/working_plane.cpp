#include "apps/input/working_plane.hpp"

#include "core/metric.hpp"
#include "gis/error.hpp"
#include "gis/places.hpp"
#include "gis/projection/distortion.hpp"

namespace coastmesh {

namespace {

// A ratio of the scales along and across. Below it, angles on the ground differ by up to half a degree: Web Mercator,
// conformal on a sphere but not on the ellipsoid, reaches 1.007.
constexpr double kWorthAWarning = 1.01;

}  // namespace

Crs parseWorkingCrs(const std::string& text) {
  try {
    return parseCrs(text);
  } catch (const InputError& error) {
    throw OptionError(std::string("--crs: ") + error.what());
  }
}

std::string judgeWorkingPlane(const Coastline& coastline, const Crs& working, const Projection& chosen) {
  if (working.isPlane() || coastline.crs.isPlane()) return {};
  const Distortion largest = largestDistortion(coastline, working, chosen);
  if (!(largest.ratio > kWorthAWarning)) return {};
  return "--crs: " + nameOf(working) + " distorts shapes: at " + pointText(largest.place) + " lengths differ by " +
         amount("%.3g", 100.0 * (largest.ratio - 1.0)) + " % with their direction, and angles by up to " +
         amount("%.2g", largest.degrees) +
         " degrees from those on the ground, whatever --min-angle says: leave out --crs, for a conformal plane that is "
         "fitted, or give a conformal CRS";
}

std::string judgeBoxInPlane(const Box& box, const Crs& input, const Crs& working, const Projection& chosen) {
  constexpr double kEdge = 180.0, kBeside = 1e-6;  // degrees
  constexpr double kTornM = 1000.0;
  if (!input.geographic || working.isPlane() || working.geographic) return {};
  const auto contains = [&](double longitude) { return box.xmin < longitude && longitude < box.xmax; };
  if (box.xmin <= box.xmax && !contains(kEdge) && !contains(-kEdge)) return {};
  const double latitude = 0.5 * (box.ymin + box.ymax);
  const Point west = chosen.forward({kEdge - kBeside, latitude}), east = chosen.forward({kBeside - kEdge, latitude});
  if (!(distance(west, east) * metresPerUnit(working) > kTornM)) return {};
  return "--crs: " + nameOf(working) +
         " is cut at the antimeridian, which --bbox crosses, so that the water is divided there: leave out --crs, or "
         "give a plane with its middle near, such as EPSG:3832";
}

}  // namespace coastmesh
