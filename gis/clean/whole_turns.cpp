#include "gis/clean/whole_turns.hpp"

#include <GeographicLib/Math.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

#include "gis/coast/feature_names.hpp"
#include "gis/coast/turned_rings.hpp"
#include "gis/error.hpp"
#include "gis/for_count.hpp"
#include "gis/places.hpp"

namespace coastmesh {

namespace {

using HasLength = std::function<bool(const Point&, const Point&)>;

struct WholeTurn {
  Point from, to;
};

bool isPole(const Point& a, const Point& b) { return a.y == b.y && std::abs(a.y) == 90.0; }

// Calls `found(i)` for each edge of a whole turn that has no length.
template <typename Found>
void forEachWholeTurn(const std::vector<Point>& chain, bool closed, const HasLength& hasLength, Found&& found) {
  const auto next = [&](std::size_t i) { return chain[(i + 1) % chain.size()]; };
  const std::size_t edges = chain.size() < 2 ? 0 : chain.size() - (closed ? 0 : 1);
  const auto isWhole = [&](std::size_t i) {
    return std::abs(next(i).x - chain[i].x) == 360.0 && !isPole(chain[i], next(i));
  };
  std::vector<std::size_t> whole;
  for (std::size_t i = 0; i < edges; ++i)
    if (isWhole(i)) whole.push_back(i);
  if (whole.empty()) return;
  const Turns turns = turnsOf(chain, closed);
  for (const std::size_t i : whole) {
    const int after = i + 1 < chain.size() ? turns.of[i + 1] : turns.round;
    if (after == turns.of[i] && !hasLength(chain[i], next(i))) found(i);
  }
}

// So many that a parallel changes its direction by at most 5 degrees per piece, and none is wider than 10 degrees.
int piecesOf(const Point& a, const Point& b) {
  constexpr double kTurn = 360.0, kMostTurn = 5.0, kWidest = 10.0;
  const double middle = (a.y + b.y) / 2 * GeographicLib::Math::degree();
  return static_cast<int>(std::ceil(std::max(kTurn / kWidest, kTurn * std::abs(std::sin(middle)) / kMostTurn)));
}

// The same points for either direction of the edge. Longitudes of the pieces are multiples of their width.
void addPieces(const Point& a, const Point& b, std::vector<Point>& divided) {
  const int pieces = piecesOf(a, b);
  for (int k = 1; k < pieces; ++k) {
    const int from_west = a.x < b.x ? k : pieces - k;
    const Point &west = a.x < b.x ? a : b, &east = a.x < b.x ? b : a;
    const double share = static_cast<double>(from_west) / pieces;
    divided.push_back({west.x + share * (east.x - west.x), west.y + share * (east.y - west.y)});
  }
}

// Returns the edges that it divided.
std::vector<WholeTurn> divide(std::vector<Point>& chain, bool closed, const HasLength& hasLength) {
  std::vector<std::size_t> whole;
  forEachWholeTurn(chain, closed, hasLength, [&](std::size_t i) { whole.push_back(i); });
  if (whole.empty()) return {};
  std::vector<WholeTurn> edges;
  std::vector<Point> divided;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    divided.push_back(chain[i]);
    if (!std::ranges::binary_search(whole, i)) continue;
    edges.push_back({chain[i], chain[(i + 1) % chain.size()]});
    addPieces(edges.back().from, edges.back().to, divided);
  }
  chain = std::move(divided);
  return edges;
}

bool isLeft(const Feature& feature) {
  return feature.use == FeatureUse::Frame || feature.use == FeatureUse::Open || feature.use == FeatureUse::Boundary ||
         !feature.vertex_order.empty();
}

// Uses whose edges only the lines of the map give a meaning.
bool isOfMap(FeatureUse use) {
  return use == FeatureUse::Region || use == FeatureUse::Constraint || use == FeatureUse::Weir;
}

// Calls `act(chain, closed)` for all rings and lines.
template <typename AnyFeature, typename Act>
void forEachChain(AnyFeature& feature, Act&& act) {
  for (auto& polygon : feature.polygons) {
    act(polygon.outer, true);
    for (auto& hole : polygon.holes) act(hole, true);
  }
  for (auto& line : feature.lines) act(line, false);
}

std::string edgeInWords(const Feature& feature, const WholeTurn& edge) {
  return featureInWords(feature) + ": its edge from " + placeInWords(edge.from) + " to " + placeInWords(edge.to);
}

bool touchesPole(const std::vector<Point>& ring) {
  return std::ranges::any_of(ring, [](const Point& p) { return std::abs(p.y) == 90.0; });
}

// Returns notes.
std::vector<std::string> divideWholeTurns(Coastline& coastline, EdgeLine line, const HasLength& hasLength) {
  if (line == EdgeLine::Geodesic) return {};
  std::size_t count = 0;
  std::string first;
  for (Feature& feature : coastline.features) {
    if (isLeft(feature) || !(line == EdgeLine::LonLat || isOfMap(feature.use))) continue;
    forEachChain(feature, [&](std::vector<Point>& chain, bool closed) {
      const std::vector<WholeTurn> edges = divide(chain, closed, hasLength);
      if (first.empty() && !edges.empty()) first = edgeInWords(feature, edges.front());
      count += edges.size();
    });
  }
  if (count == 0) return {};
  std::string note = first + " goes once round the globe, straight in longitudes and latitudes";
  if (count > 1)
    note += ", as " + std::to_string(count - 1) + forCount(count - 1, " other edge does", " other edges do");
  return {note};
}

// Returns warnings of those that close a polygon over a pole.
std::vector<std::string> refuseWholeTurns(const Coastline& coastline, EdgeLine line, const HasLength& hasLength) {
  const std::string why = line == EdgeLine::Geodesic ? " goes once round the globe, and has no length as a geodesic"
                                                     : " goes once round the globe, and has no length in the plane";
  const std::string along = "; --edges lonlat takes it along its line of longitudes and latitudes";
  std::vector<std::string> warnings;
  for (const Feature& feature : coastline.features) {
    if (isLeft(feature)) continue;
    forEachChain(feature, [&](const std::vector<Point>& chain, bool closed) {
      std::vector<WholeTurn> edges;
      forEachWholeTurn(chain, closed, hasLength, [&](std::size_t i) {
        edges.push_back({chain[i], chain[(i + 1) % chain.size()]});
      });
      if (edges.empty()) return;
      const bool closes = closed && edges.size() == 1 && !touchesPole(chain) && !isOfMap(feature.use);
      if (!closes) throw InputError(edgeInWords(feature, edges.front()) + why + along);
      warnings.push_back(edgeInWords(feature, edges.front()) + why + ": the polygon is closed over the pole" + along);
    });
  }
  return warnings;
}

}  // namespace

FrameReport frameWithWholeTurns(Coastline& coastline, const FrameOptions& options, EdgeLine line,
                                const HasLength& hasLength) {
  if (!coastline.crs.geographic || options.in_plane) return frameCoastline(coastline, options);
  // Before the frame cuts edges: a part of one would look as if it jumped across the antimeridian.
  std::vector<std::string> notes = divideWholeTurns(coastline, line, hasLength);
  FrameReport report = frameCoastline(coastline, options);
  std::ranges::move(notes, std::back_inserter(report.notes));
  std::ranges::move(refuseWholeTurns(coastline, line, hasLength), std::back_inserter(report.warnings));
  return report;
}

}  // namespace coastmesh
