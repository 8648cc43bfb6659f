#include "gis/coast/box_of_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "gis/crs/geographic_map.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

constexpr double kTurn = 360;  // degrees

// True for a place on Earth that the CRS has elsewhere.
bool isBeyondEdge(const Point& p, const GeographicMap& map) {
  constexpr double kRounding = 1e-3;  // of the coordinates
  const LonLat place = map.forward(p);
  if (!std::isfinite(place.lon) || !std::isfinite(place.lat)) return false;
  const Point usual = map.inverse(place);
  return std::hypot(usual.x - p.x, usual.y - p.y) > kRounding * (std::abs(p.x) + std::abs(p.y));
}

// True if the middle of a side is.
bool isBeyondEdge(const Box& box, const GeographicMap& map) {
  const double x = (box.xmin + box.xmax) / 2, y = (box.ymin + box.ymax) / 2;
  return std::ranges::any_of(std::array{Point{box.xmin, y}, Point{box.xmax, y}, Point{x, box.ymin}, Point{x, box.ymax}},
                             [&map](const Point& p) { return isBeyondEdge(p, map); });
}

}  // namespace

std::string inWords(const Box& box) {
  char text[160];
  std::snprintf(text, sizeof text, "%.10g,%.10g,%.10g,%.10g", box.xmin, box.ymin, box.xmax, box.ymax);
  return text;
}

double widthOf(const Box& box) { return box.xmax - box.xmin + (box.xmax < box.xmin ? kTurn : 0); }

void refuseOddBox(const Box& box, const Crs& crs) {
  const std::string given = "--bbox " + inWords(box);
  if (!(box.ymin < box.ymax)) {
    throw OptionError(given + ": the south has to lie below the north (the order is west, south, east, north)");
  }
  if (box.xmin == box.xmax) throw OptionError(given + ": it has no width: the west has to differ from the east");
  if (!crs.geographic) {
    if (!(box.xmin < box.xmax))
      throw InputError(given + ": the west has to lie below the east; boxes across the antimeridian need an input in " +
                       "longitudes and latitudes, and the sides in degrees: reproject it (ogr2ogr -t_srs EPSG:4326)");
    return;
  }
  if (box.ymin < -90 || box.ymax > 90 || std::abs(box.xmin) > 540 || std::abs(box.xmax) > 540) {
    throw InputError(given + ": the input is in degrees (" + nameOf(crs) +
                     "), and these are none: give west, south, east, north in degrees");
  }
  if (box.xmax - box.xmin > kTurn) {
    throw InputError(given + ": from the west to the east it has to be at most 360 degrees");
  }
  if (!(widthOf(box) > 0)) {
    throw OptionError(given + ": it has no width: the east lies a full turn or more west of the west; for all " +
                      "longitudes give -180 as the west and 180 as the east");
  }
}

std::string wideBoxNote(const Box& box, const Crs& crs) {
  if (!crs.geographic || box.xmin < box.xmax) return {};
  const double width = widthOf(box);
  if (width <= kTurn / 2) return {};
  char text[60];
  std::snprintf(text, sizeof text, "reaches over %.6g degrees", width);
  return "--bbox " + inWords(box) + ": its east is less than its west, so that it " + text +
         " across the antimeridian; the order is west, south, east, north";
}

std::string beyondEdgeWarning(const Box& box, const Box& data, const Crs& crs) {
  if (crs.geographic || crs.isPlane() || data.empty()) return {};
  const GeographicMap map(crs);
  if (!isBeyondEdge(box, map) || isBeyondEdge(data, map)) return {};
  return "--bbox " + inWords(box) + ": it reaches past the edge of " + nameOf(crs) +
         ", and the input has what lies there at the other edge: it is missing in the mesh; reproject the input to "
         "longitudes and latitudes (ogr2ogr -t_srs EPSG:4326), and give the box in degrees";
}

}  // namespace coastmesh
