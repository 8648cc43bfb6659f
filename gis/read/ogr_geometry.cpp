#include "gis/read/ogr_geometry.hpp"

#include <cmath>
#include <memory>

#include "core/pslg.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

std::string inWords(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

// `where` names the chain; it is called only for an error message.
template <typename Where>
std::vector<Point> takeChain(const OGRSimpleCurve& curve, GeometryParts& parts, Where&& where) {
  const auto n = static_cast<std::size_t>(curve.getNumPoints());
  std::vector<Point> chain(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Point p{curve.getX(static_cast<int>(i)), curve.getY(static_cast<int>(i))};
    if (!isInRange(p)) {
      throw InputError(where() + ", vertex " + std::to_string(i + 1) + " of " + std::to_string(n) +
                       ", is not a place (" + inWords(p.x) + ", " + inWords(p.y) + "): repair or remove this feature");
    }
    chain[i] = p;
  }
  parts.coordinates += n;
  return chain;
}

void takePoint(const OGRPoint& point, const std::string& what, GeometryParts& parts) {
  const Point p{point.getX(), point.getY()};
  if (!isInRange(p)) {
    throw InputError(what + " is a point that is not a place (" + inWords(p.x) + ", " + inWords(p.y) +
                     "): repair or remove this feature");
  }
  parts.points.push_back(p);
}

void takePolygon(const OGRPolygon& polygon, const std::string& what, GeometryParts& parts) {
  const std::size_t number = parts.polygons.size() + 1;
  Polygon taken;
  int ring_number = 0;
  for (const OGRLinearRing* ring : polygon) {
    const int r = ring_number++;
    if (ring->IsEmpty()) continue;
    Ring points = takeChain(*ring, parts, [&] {
      std::string name = what + ": polygon " + std::to_string(number);
      name += r == 0 ? ", outer ring" : ", hole " + std::to_string(r);
      return name;
    });
    closeRing(points, parts);
    if (r == 0) {
      taken.outer = std::move(points);
    } else {
      taken.holes.push_back(std::move(points));
    }
  }
  if (!taken.outer.empty() || !taken.holes.empty()) parts.polygons.push_back(std::move(taken));
}

void takeLinear(const OGRGeometry& geometry, const std::string& what, GeometryParts& parts);

template <typename Collection>
void takeEach(const Collection& collection, const std::string& what, GeometryParts& parts) {
  for (const auto* member : collection) takeLinear(*member, what, parts);
}

// REQUIRES: no curves in `geometry`.
void takeLinear(const OGRGeometry& geometry, const std::string& what, GeometryParts& parts) {
  if (geometry.IsEmpty()) return;
  switch (wkbFlatten(geometry.getGeometryType())) {
    case wkbPoint:
      takePoint(*geometry.toPoint(), what, parts);
      break;
    case wkbPolygon:
    case wkbTriangle:
      takePolygon(*geometry.toPolygon(), what, parts);
      break;
    case wkbLineString:
      parts.lines.push_back(takeChain(*geometry.toLineString(), parts,
                                      [&] { return what + ": line " + std::to_string(parts.lines.size() + 1); }));
      break;
    case wkbMultiPoint:
    case wkbMultiLineString:
    case wkbMultiPolygon:
    case wkbGeometryCollection:
      takeEach(*geometry.toGeometryCollection(), what, parts);
      break;
    case wkbPolyhedralSurface:
    case wkbTIN:
      takeEach(*geometry.toPolyhedralSurface(), what, parts);
      break;
    default:
      throw InputError(what + " is a " + geometry.getGeometryName() + ", which is neither polygon nor line");
  }
}

}  // namespace

void closeRing(Ring& ring, GeometryParts& parts) {
  ++parts.rings;
  if (ring.size() > 1 && ring.front() == ring.back()) {
    ring.pop_back();
  } else {
    if (parts.unclosed_rings++ == 0) parts.unclosed_place = ring.back();
  }
}

void takeApart(const OGRGeometry& geometry, const std::string& what, GeometryParts& parts) {
  if (!geometry.hasCurveGeometry()) return takeLinear(geometry, what, parts);
  // OGR's default: a chord every 4 degrees of arc.
  const std::unique_ptr<OGRGeometry> linear(geometry.getLinearGeometry());
  if (!linear) throw InputError(what + " holds a curve that cannot be made of straight pieces");
  takeLinear(*linear, what, parts);
}

}  // namespace coastmesh
