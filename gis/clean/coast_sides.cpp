#include "gis/clean/coast_sides.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/metric.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/coast/snap_distance.hpp"
#include "gis/error.hpp"
#include "gis/for_count.hpp"
#include "gis/geometry/box.hpp"
#include "gis/places.hpp"

namespace coastmesh {

namespace {

// Coasts follow the rule if at least this share of their length does.
constexpr double kAgreement = 0.9;

class WaterFinder {
 public:
  WaterFinder(const CoastMap& coast, const CleanVertices& vertices, const Coastline& coastline,
              const Projection& projection, CleanReport& report)
      : coast_(coast), vertices_(vertices), coastline_(coastline), projection_(projection), report_(report) {}

  std::vector<char> run() {
    refuseGaps();
    water_.assign(coast_.map.faceCount(), 0);
    if (coast_.seed) {
      flood(*coast_.seed, true, [](std::uint32_t, bool) {});
      leaveOutUnreached();
    } else {
      byTheRule();
    }
    return std::move(water_);
  }

 private:
  // Finds the sides of all faces connected to `first` on which water may lie, given the side of `first`: crossing a
  // coast changes sides. Calls `found(face, water)` for each.
  template <typename Found>
  void flood(std::uint32_t first, bool water, Found&& found) {
    if (seen_.empty()) seen_.assign(coast_.map.faceCount(), 0);
    std::vector<std::uint32_t> queue{first};
    seen_[first] = 1;
    water_[first] = water;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const std::uint32_t face = queue[i];
      found(face, water_[face] != 0);
      for (const PlanarMap::HalfEdge h : coast_.map.around(face)) {
        const std::uint32_t beyond = coast_.map.faceOf(h ^ 1u);
        if (seen_[beyond] || !coast_.framed[beyond]) continue;
        seen_[beyond] = 1;
        water_[beyond] = (water_[face] != 0) != coast_.edges[h / 2].parts;
        queue.push_back(beyond);
      }
    }
  }

  // Warns of parts of the frame without a connection to the seed. They are land.
  void leaveOutUnreached() {
    if (std::ranges::none_of(coast_.edges, &CoastEdge::of_frame)) return;
    std::vector<Point> places;
    for (std::uint32_t face = 0; face < coast_.map.faceCount(); ++face) {
      if (!coast_.framed[face] || seen_[face]) continue;
      std::vector<std::uint32_t> members;
      flood(face, true, [&](std::uint32_t member, bool) { members.push_back(member); });
      for (const std::uint32_t member : members) water_[member] = 0;
      places.push_back(middleOf(members));
    }
    if (places.empty()) return;
    report_.warnings.push_back(partsInWords(places) + " not connected with the place of --water-at, and " +
                               forCount(places.size(), "is", "are") + " not meshed: mesh " +
                               forCount(places.size(), "it", "them") + " in another run");
  }

  // The middle of the faces' bounds, in the input's coordinates.
  Point middleOf(const std::vector<std::uint32_t>& faces) const {
    Box box;
    for (const std::uint32_t face : faces)
      for (const PlanarMap::HalfEdge h : coast_.map.around(face)) {
        const CoastEdge& edge = coast_.edges[h / 2];
        for (const VertexId v : {edge.low, edge.high}) box.add(vertices_.plane[v]);
      }
    return projection_.inverse(midpoint(Point{box.xmin, box.ymin}, Point{box.xmax, box.ymax}));
  }

  // "2 parts of the frame, around (1, 2) and (3, 4), are", with some of the places.
  static std::string partsInWords(const std::vector<Point>& places) {
    constexpr std::size_t kNamed = 5;
    const std::size_t named = std::min(kNamed, places.size());
    std::string text = std::to_string(places.size()) + forCount(places.size(), " part", " parts") + " of the frame, ";
    text += places.size() > kNamed ? "such as those around " : "around ";
    for (std::size_t i = 0; i < named; ++i)
      text += (i == 0 ? "(" : i + 1 == named ? " and (" : ", (") + roughPlaceInWords(places[i]) + ")";
    return text + ", " + forCount(places.size(), "is", "are");
  }

  void byTheRule() {
    double agreeing = 0, all = 0;
    std::vector<Point> bare;  // places of parts without a coast
    for (std::uint32_t face = 0; face < coast_.map.faceCount(); ++face) {
      if (!coast_.framed[face] || (!seen_.empty() && seen_[face])) continue;
      std::vector<std::uint32_t> members;
      double for_water = 0, length = 0;
      flood(face, true, [&](std::uint32_t member, bool water) {
        members.push_back(member);
        for (const PlanarMap::HalfEdge h : coast_.map.around(member)) {
          const CoastEdge& edge = coast_.edges[h / 2];
          if (!edge.parts || edge.direction == 0 || coast_.map.faceOf(h) == coast_.map.faceOf(h ^ 1u)) continue;
          // The half-edge has the face on its left; a coast in the opposite direction has it on its right.
          const bool on_right = (h % 2 == 0) != (edge.direction > 0);
          const double weight = lengthOf(edge);
          length += weight;
          for_water += on_right == water ? weight : -weight;
        }
      });
      if (length == 0) {
        for (const std::uint32_t member : members) water_[member] = 0;
        bare.push_back(middleOf(members));
        continue;
      }
      if (for_water < 0) {
        for (const std::uint32_t member : members) water_[member] = water_[member] == 0;
      }
      agreeing += (length + std::abs(for_water)) / 2;
      all += length;
    }
    if (all == 0) {
      throw InputError(
          "no coastline lies within the frame, so it is unknown whether there is water: give --water-at LON,LAT, or "
          "another frame");
    }
    if (agreeing < kAgreement * all) {
      char text[256];
      std::snprintf(text, sizeof text,
                    "only %.0f %% of the coastlines' length has water on its right, as in OpenStreetMap, so their "
                    "direction does not identify the water: give --water-at LON,LAT",
                    100 * agreeing / all);
      throw InputError(text);
    }
    if (!bare.empty())
      report_.warnings.push_back(partsInWords(bare) +
                                 " without a coastline, so that it is unknown whether there is water, and " +
                                 forCount(bare.size(), "is", "are") + " not meshed: for the sea, mesh " +
                                 forCount(bare.size(), "it", "them") + " in another run with --water-at LON,LAT");
    char text[256];
    std::snprintf(text, sizeof text,
                  "meshed the side to the right of the coastlines, where OpenStreetMap has the water (%.4g %% of their "
                  "length agree); --water-at LON,LAT sets another side",
                  100 * agreeing / all);
    report_.notes.emplace_back(text);
  }

  double lengthOf(const CoastEdge& edge) const {
    const Point &a = vertices_.plane[edge.low], &b = vertices_.plane[edge.high];
    return std::hypot(b.x - a.x, b.y - a.y);
  }

  // Follows each line from a loose end within the frame. If it reaches the boundary of the frame, or another loose end,
  // it should have separated water from land. A line that ends at another coast is a pier.
  void refuseGaps() const {
    const std::size_t n = vertices_.plane.size();
    std::vector<std::uint32_t> degree(n, 0);
    std::vector<char> on_frame(n, 0);
    std::vector<std::array<std::uint32_t, 2>> at(n, {kNone, kNone});
    for (std::uint32_t e = 0; e < coast_.edges.size(); ++e) {
      const CoastEdge& edge = coast_.edges[e];
      if (!edge.parts && !edge.of_frame) continue;
      for (const VertexId v : {edge.low, edge.high}) {
        if (degree[v] < 2) at[v][degree[v]] = e;
        ++degree[v];
        on_frame[v] |= edge.of_frame;
      }
    }
    std::vector<VertexId> loose;
    for (VertexId v = 0; v < n; ++v) {
      if (degree[v] == 1 && coast_.edges[at[v][0]].line && framedBeside(at[v][0])) loose.push_back(v);
    }
    for (const VertexId start : loose) {
      std::uint32_t e = at[start][0];
      VertexId v = start;
      // Terminates: all vertices between the ends have exactly two edges.
      while (true) {
        v = coast_.edges[e].low == v ? coast_.edges[e].high : coast_.edges[e].low;
        if (degree[v] != 2 || on_frame[v]) break;
        e = at[v][0] == e ? at[v][1] : at[v][0];
      }
      if (on_frame[v] || degree[v] == 1) refuseGap(start, loose);
    }
  }

  bool framedBeside(std::uint32_t e) const {
    return coast_.framed[coast_.map.faceOf(2 * e)] || coast_.framed[coast_.map.faceOf(2 * e + 1)];
  }

  [[noreturn]] void refuseGap(VertexId end, const std::vector<VertexId>& loose) const {
    const Point& place = vertices_.plane[end];
    double nearest = -1;
    for (const VertexId v : loose) {
      if (v == end) continue;
      const double distance = std::hypot(vertices_.plane[v].x - place.x, vertices_.plane[v].y - place.y);
      if (nearest < 0 || distance < nearest) nearest = distance;
    }
    std::uint32_t feature = 0;
    for (const CoastEdge& edge : coast_.edges) {
      if (edge.parts && (edge.low == end || edge.high == end)) feature = edge.feature;
    }
    std::string text = featureInWords(coastline_.features[feature]) + ": the coastline ends at " +
                       placeInWords(vertices_.input[end]) + ", inside of the frame, without meeting another";
    if (nearest >= 0) {
      const double metres = nearest / projection_.scaleAt(place);
      char more[160];
      if (metres <= kMostSnapped)
        std::snprintf(more, sizeof more, "; the next loose end is %.4g m away: join them, or give --snap %.2g", metres,
                      std::ceil(metres * 1.1 * 1000) / 1000);
      else
        std::snprintf(more, sizeof more,
                      "; the next loose end is %.4g m away: join them, continue the line, or give a frame that it "
                      "reaches",
                      metres);
      text += more;
    } else {
      text += ": continue it, or give a frame that it reaches";
    }
    throw InputError(text);
  }

  const CoastMap& coast_;
  const CleanVertices& vertices_;
  const Coastline& coastline_;
  const Projection& projection_;
  CleanReport& report_;
  std::vector<char> water_, seen_;
};

}  // namespace

std::vector<char> findWater(const CoastMap& coast, const CleanVertices& vertices, const Coastline& coastline,
                            const Projection& projection, CleanReport& report) {
  return WaterFinder(coast, vertices, coastline, projection, report).run();
}

}  // namespace coastmesh
