#include "gis/read/near_box.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

namespace coastmesh {

namespace {

constexpr double kTurn = 360.0;
constexpr double kMargin = 0.11;  // of the box; framing looks a tenth around it

std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

double widthOf(const Box& box) { return box.xmax - box.xmin + (box.xmax < box.xmin ? kTurn : 0.0); }

// Others are refused later.
bool isSound(const Box& box) {
  const auto isLongitude = [](double x) { return std::abs(x) <= 540.0; };
  return box.ymin >= -90.0 && box.ymin < box.ymax && box.ymax <= 90.0 && isLongitude(box.xmin) &&
         isLongitude(box.xmax) && widthOf(box) > 0.0 && widthOf(box) <= kTurn;
}

bool hasIndex(OGRLayer& layer) {
  const OGRSpatialReference* crs = layer.GetSpatialRef();
  if (crs == nullptr || !crs->IsGeographic()) return false;
  const OGRwkbGeometryType type = wkbFlatten(layer.GetGeomType());
  if (type != wkbPolygon && type != wkbMultiPolygon) return false;  // lines are joined, wherever they are
  if (!layer.TestCapability(OLCFastSpatialFilter) || !layer.TestCapability(OLCFastFeatureCount)) return false;
  OGREnvelope extent;
  return layer.GetExtent(&extent, FALSE) == OGRERR_NONE && extent.MinX >= -180.0 && extent.MaxX <= 180.0;
}

// The number of rows of a table: of an index, without features that have no geometry.
std::uint64_t rowsIn(const OpenSource& source, const std::string& table) {
  OGRLayer* counted = source.dataset->ExecuteSQL(("SELECT COUNT(*) FROM " + quoted(table)).c_str(), nullptr, nullptr);
  if (counted == nullptr) return 0;
  const std::unique_ptr<OGRFeature> row(counted->GetNextFeature());
  const GIntBig rows = row ? row->GetFieldAsInteger64(0) : 0;
  source.dataset->ReleaseResultSet(counted);
  return static_cast<std::uint64_t>(rows);
}

// A condition on a box in the index. Several turns of the box may meet the layer.
std::string meets(const Box& box) {
  const double dx = kMargin * widthOf(box), dy = kMargin * (box.ymax - box.ymin);
  std::string either;
  for (const double turn : {-2.0 * kTurn, -kTurn, 0.0, kTurn, 2.0 * kTurn}) {
    const double west = box.xmin - dx + turn, east = box.xmin + widthOf(box) + dx + turn;
    if (west > 180.0 || east < -180.0) continue;
    char text[120];
    std::snprintf(text, sizeof text, "(maxx >= %.17g AND minx <= %.17g)", west, east);
    either += (either.empty() ? "" : " OR ") + std::string(text);
  }
  char text[120];
  std::snprintf(text, sizeof text, "maxy >= %.17g AND miny <= %.17g AND ", box.ymin - dy, box.ymax + dy);
  return text + ("(" + either + ")");
}

}  // namespace

std::uint64_t keepNear(const OpenSource& source, const Box& box) {
  const GDALDriver* driver = source.dataset->GetDriver();
  if (driver == nullptr || std::string_view(driver->GetDescription()) != "GPKG" || source.layers.size() != 1) return 0;
  OGRLayer& layer = *source.layers.front();
  if (!isSound(box) || !hasIndex(layer)) return 0;
  const std::string index = std::string("rtree_") + layer.GetName() + "_" + layer.GetGeometryColumn();
  const std::uint64_t before = rowsIn(source, index + "_rowid");
  // Not OGR's spatial filter, which also excludes features by their shape and may return them in another order.
  const std::string condition =
      quoted(layer.GetFIDColumn()) + " IN (SELECT id FROM " + quoted(index) + " WHERE " + meets(box) + ")";
  if (layer.SetAttributeFilter(condition.c_str()) != OGRERR_NONE) return 0;
  const auto kept = static_cast<std::uint64_t>(layer.GetFeatureCount());
  return before > kept ? before - kept : 0;
}

void keepAll(const OpenSource& source) {
  for (OGRLayer* layer : source.layers) layer->SetAttributeFilter(nullptr);
}

}  // namespace coastmesh
