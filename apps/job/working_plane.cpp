#include "apps/job/working_plane.hpp"

#include <cstdio>

#include "gis/error.hpp"
#include "gis/projection/distortion.hpp"

namespace coastmesh {

namespace {

// Ratios of the scales along and across. Below the first, angles on the ground differ by up to half a degree: Web
// Mercator, conformal on a sphere but not on the ellipsoid, reaches 1.007. At the second they differ by up to 13
// degrees: a third of the smallest angle asked for.
constexpr double kWorthTelling = 1.01, kUseless = 1.25;

std::string inDigits(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

Crs parseWorkingCrs(const std::string& text) {
  const Crs crs = [&text] {
    try {
      return parseCrs(text);
    } catch (const InputError& error) {
      throw OptionError(std::string("--crs: ") + error.what());
    }
  }();
  if (crs.geographic)
    throw OptionError("--crs: " + nameOf(crs) +
                      " has longitudes and latitudes, which are no plane to work in: leave out --crs, and the mesh has "
                      "the coordinates of the input; for longitudes and latitudes, bring the input to them first "
                      "(ogr2ogr -t_srs " +
                      nameOf(crs) + ")");
  return crs;
}

std::string judgeWorkingPlane(const Coastline& coastline, const Crs& working, const Projection& chosen) {
  if (working.isPlane() || coastline.crs.isPlane()) return {};
  const Distortion largest = largestDistortion(coastline, working, chosen);
  if (!(largest.ratio > kWorthTelling)) return {};
  const std::string what = nameOf(working) + " distorts shapes: at " + std::to_string(largest.place.x) + ", " +
                           std::to_string(largest.place.y) + " lengths differ by " +
                           inDigits("%.3g", 100.0 * (largest.ratio - 1.0)) +
                           " % with their direction, and angles by up to " + inDigits("%.2g", largest.degrees) +
                           " degrees from those on the ground";
  const std::string instead = ": leave out --crs, for a conformal plane that is fitted, or give a conformal CRS";
  if (largest.ratio > kUseless)
    throw OptionError("--crs: " + what + ", more than the 25 % at which meshes are still of use" + instead);
  return "--crs: " + what + ", whatever --min-angle says" + instead;
}

}  // namespace coastmesh
