#include "apps/plot/plot_globe.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <numbers>

#include "apps/plot/globe_chart.hpp"
#include "apps/plot/mesh_shape.hpp"
#include "apps/plot/plot_canvas.hpp"
#include "apps/plot/plot_legend.hpp"
#include "apps/plot/plot_lines.hpp"
#include "apps/plot/plot_style.hpp"
#include "core/metric.hpp"
#include "core/tri_mesh.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/format/grid_names.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/geographic_nodes.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/grid/linked_grid.hpp"
#include "gis/grid/local_plane.hpp"
#include "gis/grid/on_sphere.hpp"
#include "gis/model/time_step.hpp"

namespace coastmesh {
namespace {

constexpr double kRoom = 1.04;          // half the picture's side over the globe's radius
constexpr double kStep = 0.035;         // of the radius: longer edges are drawn as several lines
constexpr double kGraticuleDeg = 15.0;  // between meridians and parallels
constexpr double kCaptionLeft = 12.0;
constexpr double kGraticulePx = 0.5, kOutlinePx = 1.4;
const Color kGraticule = mix(kLand, kShore, 0.22);

// The values that triangles' colours show, as shares of a ramp.
struct Shares {
  std::vector<double> of;  // per triangle; NaN: unknown
  LegendRamp ramp{rampColor, {}, {}};
};

std::string formatted(const char* format, double value) {
  char text[60];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// Dots are not drawn on the globe.
PlotLegend legendOf(const GlobeChart& chart, const std::vector<PlotLines>& lines, const PlotOptions& options) {
  const Point corner = kRoom * chart.half();
  const double width = PlotCanvas::widthOf(-1.0 * corner, corner, static_cast<double>(options.size_px));
  return {width, kCaptionLeft + textWidth(chart.caption(), kTextPx), legendItems(lines, false), hasRamp(options.color)};
}

class GlobePlot {
 public:
  GlobePlot(const Grid& grid, const PlotOptions& options, const std::vector<SphereVector>& places,
            const GlobeChart& chart, const std::string& path)
      : grid_(grid),
        options_(options),
        places_(places),
        chart_(chart),
        lines_(colouredLines(grid)),
        legend_(legendOf(chart, lines_, options)),
        canvas_(path, (-kRoom) * chart.half(), kRoom * chart.half(), static_cast<double>(options.size_px),
                legend_.height()),
        quads_(quadAnglesOf(grid)) {
    for (const SphereVector& place : places) seen_.push_back(chart.see(place));
    mesh_ = linkGrid(grid).mesh;
  }

  void draw() {
    findColors();
    canvas_.fillRectangle({0.0, 0.0}, canvas_.width(), canvas_.mapHeight() + legend_.height(), kPaper);
    std::vector<Point> outline = chart_.outline();
    for (Point& p : outline) p = canvas_.toPixel(p);
    canvas_.fillLoops({outline}, kLand);
    const bool many = grid_.triangles.size() > kMostVectorTriangles;
    if (many) canvas_.beginPixels();
    for (TriId t = 0; t < grid_.triangles.size(); ++t) drawTriangle(t);
    drawGraticule();
    if (options_.edges) drawEdges();
    if (many) canvas_.endPixels();
    drawShore();
    Lines rim;
    for (std::size_t i = 0; i < outline.size(); ++i) rim.push_back({outline[i], outline[(i + 1) % outline.size()]});
    canvas_.strokeLines(rim, kOutlinePx, kShore);
    drawLegend();
    canvas_.finish();
  }

 private:
  using Lines = GlobeChart::Lines;

  std::array<double, 3> anglesOf(TriId t) const {
    const auto& [a, b, c] = grid_.triangles[t];
    return flatAnglesDeg(places_[a], places_[b], places_[c]);
  }
  double smallestAngle(TriId t) const { return quads_.has(t) ? quads_.least_deg[t] : std::ranges::min(anglesOf(t)); }

  // Squared sides of the flat triangle, in units of the sphere's radius.
  std::array<double, 3> squaresOf(TriId t) const {
    std::array<double, 3> squares;
    for (unsigned i = 0; i < 3; ++i) {
      const SphereVector side = minus(places_[grid_.triangles[t][next3(i)]], places_[grid_.triangles[t][prev3(i)]]);
      squares[i] = dot(side, side);
    }
    return squares;
  }
  double areaOf(TriId t) const {
    const auto& [a, b, c] = grid_.triangles[t];
    const SphereVector normal = cross(minus(places_[b], places_[a]), minus(places_[c], places_[a]));
    return std::sqrt(dot(normal, normal)) / 2.0;
  }

  void takeShares(const std::function<double(TriId)>& value, double low, double high) {
    for (TriId t = 0; t < grid_.triangles.size(); ++t)
      shares_.of.push_back((value(t) - low) / std::max(1e-12, high - low));
  }

  // The range of the finite values without the smallest 2 %. Throws InputError with `else_text` if there are none.
  static std::pair<double, double> rangeOf(const std::function<double(TriId)>& value, std::size_t count,
                                           const char* else_text) {
    std::vector<double> values;
    for (TriId t = 0; t < count; ++t)
      if (const double v = value(t); std::isfinite(v)) values.push_back(v);
    if (values.empty()) throw InputError(else_text);
    std::ranges::sort(values);
    return {values[values.size() / 50], values.back()};
  }

  void findColors() {
    const std::size_t count = grid_.triangles.size();
    switch (options_.color) {
      case PlotColor::Angle:
        shares_.ramp.low = "0\u00b0";
        shares_.ramp.high = "60\u00b0 smallest angle";
        return takeShares([this](TriId t) { return smallestAngle(t); }, 0.0, 60.0);
      case PlotColor::Quality:
        shares_.ramp.low = formatted("%g", kLeastQuality);
        shares_.ramp.high = "1 quality";
        return takeShares(
            [this](TriId t) {
              if (quads_.has(t)) return quads_.quality(t);
              const auto [a, b, c] = squaresOf(t);
              return 4.0 * std::numbers::sqrt3 * areaOf(t) / (a + b + c);
            },
            kLeastQuality, 1.0);
      case PlotColor::Size: {
        // The edge of an equilateral triangle of that area, in metres.
        const auto edge = [this](TriId t) { return std::log(std::sqrt(2.309 * areaOf(t)) * grid_.crs.semi_major_m); };
        const auto [low, high] = rangeOf(edge, count, "the mesh has no triangle with an area");
        shares_.ramp.low = roundedLengthText(std::exp(low), false);
        shares_.ramp.high = roundedLengthText(std::exp(high), false) + " edge";
        return takeShares(edge, low, high);
      }
      case PlotColor::Depth: {
        if (grid_.z.empty()) throw InputError("the mesh has no depth to colour it by");
        const auto height = [this](TriId t) {
          double sum = 0.0;
          for (const std::uint32_t node : grid_.triangles[t]) sum += grid_.z[node];
          return sum / 3.0;
        };
        const auto [low, high] = rangeOf(height, count, "the mesh has no depth to colour it by");
        shares_.ramp.color_at = depthColor;
        shares_.ramp.low = formatted("%.4g m", low);
        shares_.ramp.high = formatted("%.4g m up", high);
        return takeShares(height, low, high);
      }
      case PlotColor::TimeStep: {
        const std::vector<double> steps = timeSteps(grid_);
        const auto step = [&steps](TriId t) { return std::log(steps[t]); };
        const auto [low, high] =
            rangeOf(step, steps.size(), "the mesh has no depth below water, so no time step to colour it by");
        shares_.ramp.low = formatted("%.3g s", std::exp(low));
        shares_.ramp.high = formatted("%.3g s by CFL", std::exp(high));
        return takeShares(step, low, high);
      }
      case PlotColor::Region:
        regions_ = regionNumbers(grid_, regionNames(grid_));
        return;
      case PlotColor::Feature:
      case PlotColor::Piece:
      case PlotColor::None:
        return;
    }
  }

  Color colorOf(TriId t) const {
    if (smallestAngle(t) < options_.min_angle_deg - kAngleSlackDeg) return kBad;
    if (!shares_.of.empty()) return std::isfinite(shares_.of[t]) ? shares_.ramp.color_at(shares_.of[t]) : kUnknown;
    const std::uint32_t feature = grid_.feature_of.empty() ? 0 : grid_.feature_of[t];
    if (options_.color == PlotColor::Feature) return featureColor(feature);
    if (options_.color == PlotColor::Piece) return featureColor(grid_.piece_of[t]);
    if (options_.color == PlotColor::Region)
      return featureColor(regions_.empty() ? 0 : static_cast<std::size_t>(regions_[feature]));
    return kWater;
  }

  // Adds points of the great circle from `a` to `b`, without `b`.
  void addArc(const SphereVector& a, const SphereVector& b, std::vector<SphereVector>& line) const {
    const SphereVector chord = minus(b, a);
    const int steps = std::max(1, static_cast<int>(std::ceil(std::sqrt(dot(chord, chord)) / kStep)));
    for (int k = 0; k < steps; ++k) {
      const double share = static_cast<double>(k) / steps;
      line.push_back(k == 0 ? a : unit({a[0] + share * chord[0], a[1] + share * chord[1], a[2] + share * chord[2]}));
    }
  }

  double longestEdgePx(TriId t) const {
    double longest = 0.0;
    for (unsigned i = 0; i < 3; ++i) {
      longest = std::max(longest, chart_.lengthOf(seen_[grid_.triangles[t][i]], seen_[grid_.triangles[t][next3(i)]]));
    }
    return longest * canvas_.pixelsPerUnit();
  }

  Color edgeColor() const { return options_.color == PlotColor::None ? kEdge : kEdgeOnColor; }

  void drawTriangle(TriId t) {
    const auto& [a, b, c] = grid_.triangles[t];
    std::vector<SphereVector> outline;
    addArc(seen_[a], seen_[b], outline);
    addArc(seen_[b], seen_[c], outline);
    addArc(seen_[c], seen_[a], outline);
    areas_.clear();
    chart_.addArea(outline, areas_);
    if (areas_.empty()) return;
    Color color = colorOf(t);
    if (options_.edges && longestEdgePx(t) < kBlurPx) color = mix(color, edgeColor(), kEdgeCover);
    for (const auto& [p, q, r] : areas_)
      canvas_.fillTriangle({canvas_.toPixel(p), canvas_.toPixel(q), canvas_.toPixel(r)}, color);
  }

  // Adds what is seen of a line, in pixels.
  void addSeen(const std::vector<SphereVector>& line, Lines& lines) const {
    const std::size_t before = lines.size();
    chart_.addLine(line, lines);
    for (std::size_t i = before; i < lines.size(); ++i)
      lines[i] = {canvas_.toPixel(lines[i][0]), canvas_.toPixel(lines[i][1])};
  }

  void addEdge(std::uint32_t a, std::uint32_t b, Lines& lines) const {
    std::vector<SphereVector> line;
    addArc(seen_[a], seen_[b], line);
    line.push_back(seen_[b]);
    addSeen(line, lines);
  }

  double shareAslant(std::uint32_t a, std::uint32_t b) const { return chart_.widthAt(seen_[a], seen_[b]); }

  void drawGraticule() {
    Lines lines;
    constexpr double kFine = 2.0, kLast = 90.0 - kGraticuleDeg;
    for (double lon = -180.0; lon < 180.0; lon += kGraticuleDeg) {
      std::vector<SphereVector> line;
      for (double lat = -kLast; lat <= kLast; lat += kFine / 2) line.push_back(chart_.see(onSphere({lon, lat})));
      addSeen(line, lines);
    }
    for (double lat = -kLast; lat <= kLast; lat += kGraticuleDeg) {
      std::vector<SphereVector> line;
      for (double lon = -180.0; lon <= 180.0; lon += kFine) line.push_back(chart_.see(onSphere({lon, lat})));
      addSeen(line, lines);
    }
    canvas_.strokeLines(lines, kGraticulePx, kGraticule);
  }

  // Lines get thinner with the triangles, so that places with small or foreshortened triangles keep the same tint.
  void drawEdges() {
    const std::vector<std::uint8_t> diagonals = diagonalsOf(grid_);
    std::map<int, Lines> by_width;  // in quarter octaves below the widest
    for (TriId t = 0; t < mesh_.triangles.size(); ++t) {
      if (longestEdgePx(t) < kBlurPx) continue;
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(t, i), twin = mesh_.twin(e);
        if (twin == kNone || (twin < e && longestEdgePx(triOf(twin)) >= kBlurPx)) continue;
        if (!diagonals.empty() && diagonals[t] == i) continue;
        const std::uint32_t a = mesh_.origin(e), b = mesh_.target(e);
        const double length = chart_.lengthOf(seen_[a], seen_[b]) * canvas_.pixelsPerUnit();
        const double width = std::min(kWidestEdgePx, kEdgeShare * length) * shareAslant(a, b);
        addEdge(a, b, by_width[static_cast<int>(std::floor(4.0 * std::log2(kWidestEdgePx / std::max(width, 1e-3))))]);
      }
    }
    for (const auto& [level, lines] : by_width)
      canvas_.strokeLines(lines, kWidestEdgePx * std::exp2(-level / 4.0), edgeColor());
  }

  void drawShore() {
    std::map<int, Lines> by_width;  // in eighths of the widest
    for (TriId t = 0; t < mesh_.triangles.size(); ++t) {
      for (unsigned i = 0; i < 3; ++i) {
        if (mesh_.triangles[t].adj[i] != kNone) continue;
        const std::uint32_t a = mesh_.origin(edgeRef(t, i)), b = mesh_.target(edgeRef(t, i));
        addEdge(a, b, by_width[static_cast<int>(std::ceil(8.0 * shareAslant(a, b)))]);
      }
    }
    for (const auto& [level, shore] : by_width) canvas_.strokeLines(shore, kShorePx * level / 8.0, kShore);
    Lines borders;
    for (const GridLine& line : grid_.lines)
      if (line.kind == LineKind::RegionBorder)
        for (const auto& [a, b] : edgesOf(line)) addEdge(a, b, borders);
    canvas_.strokeLines(borders, kShorePx, kShore);
    for (const PlotLines& kind : lines_) {
      if (kind.kind == PlotLineKind::Island) continue;  // on the globe they are shores
      Lines lines;
      for (const auto& [a, b] : kind.edges) addEdge(a, b, lines);
      canvas_.strokeLines(lines, kind.width_px, kind.color);
    }
  }

  void drawLegend() {
    canvas_.text({kCaptionLeft, canvas_.mapHeight() + 24.0}, chart_.caption(), kTextPx, kInk);
    legend_.drawItems(canvas_);
    if (!shares_.of.empty()) legend_.drawRamp(canvas_, shares_.ramp);
  }

  const Grid& grid_;
  const PlotOptions& options_;
  const std::vector<SphereVector>& places_;  // per node
  const GlobeChart& chart_;
  const std::vector<PlotLines> lines_;
  const PlotLegend legend_;
  PlotCanvas canvas_;
  std::vector<SphereVector> seen_;  // per node
  TriMesh mesh_;
  Shares shares_;
  GlobeChart::Triangles areas_;  // of one triangle of the mesh
  std::vector<int> regions_;     // per feature
  const QuadAngles quads_;
};

}  // namespace

LonLat middleOnGlobe(const Grid& grid, const std::vector<SphereVector>& places) {
  SphereVector sum{};
  for (const auto& [a, b, c] : grid.triangles) {
    const SphereVector normal = cross(minus(places[b], places[a]), minus(places[c], places[a]));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += normal[k];
  }
  constexpr double kAllRound = 0.05;  // radius squared; for the vector sum of the flat triangles' areas
  if (std::sqrt(dot(sum, sum)) < kAllRound) return {0.0, 20.0};
  const LonLat middle = placeOf(sum);
  return {std::round(middle.lon), std::round(middle.lat)};
}

std::optional<GlobeView> globeViewNamed(const std::string& text) {
  if (text == "plane") return std::nullopt;
  const std::size_t equals = std::min(text.find('='), text.size());
  const std::string name = text.substr(0, equals);
  std::vector<double> numbers;
  const auto fail = [&]() -> std::optional<GlobeView> {
    throw OptionError("--view: '" + text +
                      "' is none of plane, orthographic, orthographic=LON,LAT, natural-earth and natural-earth=LON in "
                      "degrees");
  };
  const char* const end = text.data() + text.size();
  for (const char* at = text.data() + equals; at != end;) {
    if (*at != (numbers.empty() ? '=' : ',')) return fail();
    const auto read = std::from_chars(at + 1, end, numbers.emplace_back());
    if (read.ec != std::errc()) return fail();
    at = read.ptr;
  }
  if (!numbers.empty() && !(std::abs(numbers[0]) <= 360.0)) return fail();
  if (name == "orthographic" && numbers.empty()) return GlobeView{};
  if (name == "orthographic" && numbers.size() == 2 && std::abs(numbers[1]) <= 90.0)
    return GlobeView{.above = LonLat{numbers[0], numbers[1]}};
  if (name == "natural-earth" && numbers.size() < 2)
    return GlobeView{.all = true, .above = LonLat{numbers.empty() ? 0.0 : numbers[0], 0.0}};
  return fail();
}

void plotGlobe(const Grid& grid, const PlotOptions& options, const GlobeView& view, const std::string& path) {
  requirePlotFormat(path);
  if (grid.crs.isPlane()) throw InputError("the mesh lies in a plane, and has no place on a globe; say its CRS");
  requireColors(grid, options);
  std::vector<SphereVector> places;
  for (const Point& place : geographicNodes(grid)) places.push_back(onSphere(asLonLat(place)));
  const LonLat above = view.above ? *view.above : middleOnGlobe(grid, places);
  const std::unique_ptr<GlobeChart> chart = view.all ? naturalEarthChart(above.lon) : orthographicChart(above);
  GlobePlot(grid, options, places, *chart, path).draw();
}

std::string plotMeshOrGlobe(const Grid& grid, const PlotOptions& options, const std::string& path) {
  if (plotMesh(grid, options, path)) return {};
  plotGlobe(grid, options, {}, path);
  return std::string("the mesh is too large for a plane: it is drawn on a globe") +
         (options.degrees ? ", without dots on irregular nodes" : "");
}

}  // namespace coastmesh
