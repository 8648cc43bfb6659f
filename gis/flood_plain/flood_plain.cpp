#include "gis/flood_plain/flood_plain.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include "gis/coast/flood_plains.hpp"
#include "gis/coast/nest_rings.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/flood_plain/flood_contours.hpp"
#include "gis/flood_plain/flooded_cells.hpp"
#include "gis/flood_plain/height_cells.hpp"
#include "gis/follow/water_notes.hpp"
#include "gis/for_count.hpp"
#include "gis/places.hpp"

namespace coastmesh {

namespace {

// The boundary of the waters, in the coastline's coordinates.
struct WaterEdges {
  std::vector<PlaceEdge> shores, open;
};

WaterEdges edgesOf(const std::vector<Domain>& waters) {
  WaterEdges edges;
  for (const Domain& domain : waters)
    for (const Segment& s : domain.pslg.segments) {
      if ((s.left == kOutside) == (s.right == kOutside)) continue;
      (isOpenTag(s.tag) ? edges.open : edges.shores).emplace_back(domain.input_points[s.a], domain.input_points[s.b]);
    }
  return edges;
}

std::vector<PlaceEdge> edgesOfFrames(const Coastline& coastline) {
  std::vector<PlaceEdge> edges;
  const auto add = [&edges](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) edges.emplace_back(ring[i], ring[(i + 1) % ring.size()]);
  };
  for (const Feature& feature : coastline.features) {
    if (feature.use != FeatureUse::Frame) continue;
    for (const Polygon& polygon : feature.polygons) {
      add(polygon.outer);
      for (const Ring& hole : polygon.holes) add(hole);
    }
  }
  return edges;
}

// The areas of cells, which depend on their rows.
class CellAreas {
 public:
  CellAreas(const CellLattice& lattice, const Crs& crs) : lattice_(lattice) {
    std::vector<Point> corners;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t row = 0; row <= lattice.rows; ++row)
      for (const double column : {-0.5, 0.5}) corners.push_back(lattice.placeOf(column, row - 0.5));
    for (std::uint32_t row = 0; row < lattice.rows; ++row) {
      triangles.push_back({2 * row, 2 * row + 1, 2 * row + 3});
      triangles.push_back({2 * row, 2 * row + 3, 2 * row + 2});
    }
    const BulkList<double> areas = triangleAreas(corners, triangles, crs);
    for (std::size_t row = 0; row < lattice.rows; ++row) of_row_.push_back(areas[2 * row] + areas[2 * row + 1]);
  }
  double of(std::size_t cell) const { return of_row_[cell / lattice_.columns]; }
  double of(const std::vector<std::size_t>& cells) const {
    double sum = 0.0;
    for (const std::size_t cell : cells) sum += of(cell);
    return sum;
  }

 private:
  const CellLattice& lattice_;
  std::vector<double> of_row_;
};

std::string optionText(double height_m) {
  char text[60];
  std::snprintf(text, sizeof text, "--flood-height %.6g: ", height_m);
  return text;
}

std::string hollowsText(const DryHollows& hollows, const CellAreas& areas, const CellLattice& lattice, bool in_plane) {
  return areaInWords(areas.of(hollows.cells), in_plane) + " of low land in " + std::to_string(hollows.count) +
         forCount(hollows.count, " part", " parts") + " without a connection to the water through such land " +
         forCount(hollows.count, "stays", "stay") + " out, the largest, of " +
         areaInWords(areas.of(hollows.largest), in_plane) + ", around (" +
         roughPlaceInWords(lattice.centreOf(hollows.largest[hollows.largest.size() / 2])) + ")";
}

std::vector<Feature> featuresOf(std::vector<Ring> rings) {
  std::vector<Feature> features;
  for (const NestedRing& nested : nestRings(rings, false)) {
    Feature& feature = features.emplace_back();
    feature.fid = -1;
    feature.source = kFloodPlainSource;
    Polygon& polygon = feature.polygons.emplace_back();
    polygon.outer = std::move(rings[nested.outer]);
    for (const std::size_t hole : nested.holes) polygon.holes.push_back(std::move(rings[hole]));
  }
  return features;
}

}  // namespace

FloodPlain floodPlainOf(const Coastline& coastline, const std::vector<Domain>& waters, const FloodOptions& options,
                        const ItemLoop& loop) {
  const double limit_m = *options.height_m;
  HeightCells heights = heightCells(coastline, options, loop);
  const WaterEdges water = edgesOf(waters);
  FloodedCells cells(heights, limit_m, water.shores, water.open, edgesOfFrames(coastline));
  FloodPlain plain;
  plain.features = featuresOf(floodContours(cells, heights, limit_m));
  plain.notes = std::move(heights.notes);
  const CellAreas areas(heights.lattice, coastline.crs);
  const bool in_plane = coastline.crs.isPlane();
  double flooded = 0.0;
  for (std::size_t cell = 0; cell < heights.lattice.count(); ++cell)
    if (cells.has(cell, kFlooded)) flooded += areas.of(cell);
  plain.notes.push_back(optionText(limit_m) + (flooded > 0.0 ? areaInWords(flooded, in_plane) : std::string("none")) +
                        " of the land is meshed besides the water");
  if (const DryHollows hollows = cells.findHollows(); hollows.count > 0)
    plain.notes.push_back(optionText(limit_m) + hollowsText(hollows, areas, heights.lattice, in_plane));
  return plain;
}

}  // namespace coastmesh
