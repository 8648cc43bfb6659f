#include "gis/coast/unite_frames.hpp"

#include <ogr_api.h>
#include <ogr_geometry.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "gis/coast/feature_bounds.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/coast/ogr_polygons.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

namespace {

// A point inside the polygon; null if GEOS fails. OGRPolygon::PointOnSurface always fails in GDAL 3.6.
Shape insideOf(const OGRPolygon& polygon) {
  OGRGeometryH handle = OGRGeometry::ToHandle(const_cast<OGRPolygon*>(&polygon));  // not changed by the call
  return Shape(OGRGeometry::FromHandle(OGR_G_PointOnSurface(handle)));
}

Box boxOf(const OGREnvelope& envelope) { return {envelope.MinX, envelope.MinY, envelope.MaxX, envelope.MaxY}; }

}  // namespace

void uniteFrames(Coastline& coastline) {
  std::vector<Feature*> frames;
  std::vector<Box> boxes;
  for (Feature& feature : coastline.features) {
    const bool whole = std::ranges::none_of(feature.polygons, [](const Polygon& p) { return p.outer.empty(); });
    if (feature.use != FeatureUse::Frame || feature.polygons.empty() || !whole) continue;
    frames.push_back(&feature);
    boxes.push_back(boundsOf(feature));
  }
  const BoxTree tree(boxes, BoxTree::Order::Hilbert);
  std::vector<Feature*> meeting;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    std::size_t met = 0;  // including itself
    tree.visit(boxes[i], [&](std::uint32_t) { ++met; });
    if (met > 1) meeting.push_back(frames[i]);
  }
  if (meeting.empty()) return;

  const OgrErrors errors;
  const auto require = [&](const Shape& shape, const Feature& feature) -> const OGRGeometry& {
    if (shape) return *shape;
    throw InputError(featureInWords(feature) + ": its polygons cannot be united" +
                     (errors.text().empty() ? "" : " (" + errors.text() + ")") + ": unite them first, to one feature");
  };
  std::vector<Shape> valid;
  OGRMultiPolygon all;
  for (const Feature* frame : meeting) {
    valid.emplace_back(shapeOf(frame->polygons)->MakeValid());
    for (const OGRPolygon* polygon : polygonsOf(require(valid.back(), *frame))) all.addGeometry(polygon);
  }
  const Shape united(all.UnionCascaded());
  const std::vector<const OGRPolygon*> parts = polygonsOf(require(united, *meeting.front()));
  // The part that contains each polygon, found by a point inside the polygon.
  std::vector<Box> part_boxes;
  for (const OGRPolygon* part : parts) {
    OGREnvelope box;
    part->getEnvelope(&box);
    part_boxes.push_back(boxOf(box));
  }
  const BoxTree part_tree(part_boxes, BoxTree::Order::Hilbert);
  std::vector<std::vector<std::size_t>> parts_of(meeting.size());
  for (std::size_t f = 0; f < meeting.size(); ++f) {
    for (const OGRPolygon* polygon : polygonsOf(*valid[f])) {
      const Shape inside = insideOf(*polygon);
      OGREnvelope place;
      require(inside, *meeting[f]).getEnvelope(&place);
      part_tree.visit(boxOf(place), [&](std::uint32_t p) {
        if (parts[p]->Intersects(inside.get())) parts_of[f].push_back(p);
      });
    }
  }
  // Features that share a part are united into the first of them.
  std::vector<std::size_t> first_of(parts.size(), meeting.size());
  std::vector<std::size_t> count_of(parts.size(), 0);
  for (std::size_t f = 0; f < meeting.size(); ++f) {
    std::ranges::sort(parts_of[f]);
    parts_of[f].erase(std::unique(parts_of[f].begin(), parts_of[f].end()), parts_of[f].end());
    for (const std::size_t p : parts_of[f]) {
      first_of[p] = std::min(first_of[p], f);
      ++count_of[p];
    }
  }
  for (std::size_t f = 0; f < meeting.size(); ++f) {
    const bool shared = std::ranges::any_of(parts_of[f], [&](std::size_t p) { return count_of[p] > 1; });
    if (!shared) continue;  // its rings keep their bits
    meeting[f]->polygons.clear();
    for (const std::size_t p : parts_of[f])
      if (first_of[p] == f) meeting[f]->polygons.push_back(fromOgr(*parts[p]));
  }
  std::erase_if(coastline.features, [](const Feature& feature) {
    return feature.use == FeatureUse::Frame && feature.polygons.empty() && feature.lines.empty();
  });
}

}  // namespace coastmesh
