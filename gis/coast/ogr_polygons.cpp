#include "gis/coast/ogr_polygons.hpp"

namespace coastmesh {

namespace {

std::unique_ptr<OGRLinearRing> ringOf(const Ring& points) {
  auto ring = std::make_unique<OGRLinearRing>();
  for (const Point& p : points) ring->addPoint(p.x, p.y);
  ring->closeRings();
  return ring;
}

Ring pointsOf(const OGRLinearRing& ring) {
  Ring points;
  for (int i = 0; i + 1 < ring.getNumPoints(); ++i) points.push_back({ring.getX(i), ring.getY(i)});
  return points;
}

void addPolygons(const OGRGeometry& shape, std::vector<const OGRPolygon*>& found) {
  if (wkbFlatten(shape.getGeometryType()) == wkbPolygon) {
    found.push_back(shape.toPolygon());
  } else if (OGR_GT_IsSubClassOf(shape.getGeometryType(), wkbGeometryCollection)) {
    for (const OGRGeometry* part : shape.toGeometryCollection()) addPolygons(*part, found);
  }
}

}  // namespace

Shape shapeOf(const std::vector<Polygon>& polygons) {
  auto shape = std::make_unique<OGRMultiPolygon>();
  for (const Polygon& polygon : polygons) {
    OGRPolygon made;
    made.addRingDirectly(ringOf(polygon.outer).release());
    for (const Ring& hole : polygon.holes) made.addRingDirectly(ringOf(hole).release());
    shape->addGeometry(&made);
  }
  return shape;
}

std::vector<const OGRPolygon*> polygonsOf(const OGRGeometry& shape) {
  std::vector<const OGRPolygon*> found;
  addPolygons(shape, found);
  return found;
}

Polygon fromOgr(const OGRPolygon& polygon) {
  Polygon made;
  made.outer = pointsOf(*polygon.getExteriorRing());
  for (int i = 0; i < polygon.getNumInteriorRings(); ++i) made.holes.push_back(pointsOf(*polygon.getInteriorRing(i)));
  return made;
}

}  // namespace coastmesh
