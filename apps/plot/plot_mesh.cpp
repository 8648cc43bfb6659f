#include "apps/plot/plot_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "apps/job/grid_pieces.hpp"
#include "apps/plot/mesh_shape.hpp"
#include "apps/plot/plot_box.hpp"
#include "apps/plot/plot_canvas.hpp"
#include "apps/plot/plot_legend.hpp"
#include "apps/plot/plot_lines.hpp"
#include "apps/plot/plot_style.hpp"
#include "core/quality.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/format/grid_names.hpp"
#include "gis/grid/local_plane.hpp"
#include "gis/model/time_step.hpp"

namespace coastmesh {

namespace {

// Dots on nodes.
constexpr double kWidestDotPx = 3.5, kDotShare = 0.18;  // a dot's radius, over the length of the edges
constexpr double kLeastDotPx = 0.8;

constexpr double kMargin = 0.03;  // of the window, around what is drawn
struct Window {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void add(const Point& p) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return;
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  double longerSide() const { return std::max(high.x - low.x, high.y - low.y); }
};

Window windowOf(const GridPiece& piece, const PlotOptions& options) {
  Window window;
  if (options.bbox) {
    // The box's sides are curves in the plane.
    const auto& [west, south, east, north] = *options.bbox;
    constexpr int kSteps = 32;
    for (int i = 0; i <= kSteps; ++i) {
      const double share = static_cast<double>(i) / kSteps;
      const double x = west + (east - west) * share;
      const double y = south + (north - south) * share;
      for (const Point& p : {Point{x, south}, Point{x, north}, Point{west, y}, Point{east, y}}) {
        window.add(piece.projection.forward(p));
      }
    }
  } else {
    for (const Point& p : piece.mesh.points) window.add(p);
  }
  const double margin = options.bbox ? 0.0 : kMargin * window.longerSide();
  window.low = {window.low.x - margin, window.low.y - margin};
  window.high = {window.high.x + margin, window.high.y + margin};
  if (!(window.longerSide() > 0.0) || !std::isfinite(window.longerSide())) {
    throw InputError("there is nothing to draw in the box asked for");
  }
  return window;
}

// True if the plane's scale differs by more than this factor: in a mesh that reaches more than 120 degrees from its
// middle.
bool isTooLargeForAPlane(const GridPiece& piece) {
  constexpr double kMostScales = 4.0;
  if (piece.places.empty()) return false;
  double least = std::numeric_limits<double>::infinity(), greatest = 0.0;
  for (const Point& p : piece.mesh.points) {
    const double scale = piece.projection.scaleAt(p);
    least = std::min(least, scale), greatest = std::max(greatest, scale);
  }
  return greatest > kMostScales * least;
}

constexpr double kBarLeft = 12.0;  // of the scale bar
constexpr double kBarShare = 0.2;  // of the map's width, at most
constexpr double kBarText = 60.0;

PlotLegend legendOf(const Window& window, const std::vector<PlotLines>& lines, const PlotOptions& options) {
  const double width = PlotCanvas::widthOf(window.low, window.high, static_cast<double>(options.size_px));
  return {width, kBarLeft + std::max(kBarShare * width, kBarText), legendItems(lines, options.degrees),
          hasRamp(options.color)};
}

class MeshPlot {
 public:
  MeshPlot(const Grid& grid, const GridPiece& piece, const PlotOptions& options, const Window& window,
           const std::string& path)
      : grid_(grid),
        piece_(piece),
        mesh_(piece.mesh),
        options_(options),
        lines_(colouredLines(grid)),
        legend_(legendOf(window, lines_, options)),
        canvas_(path, window.low, window.high, static_cast<double>(options.size_px), legend_.height()),
        diagonals_(diagonalsOf(grid)),
        quads_(quadAnglesOf(grid)) {
    pixels_.reserve(mesh_.points.size());
    for (const Point& p : mesh_.points) pixels_.push_back(canvas_.toPixel(p));
    centre_ = {(window.low.x + window.high.x) / 2, (window.low.y + window.high.y) / 2};
  }

  void draw() {
    canvas_.fillRectangle({0.0, 0.0}, canvas_.width(), canvas_.mapHeight() + legend_.height(), kPaper);
    canvas_.fillRectangle({0.0, 0.0}, canvas_.width(), canvas_.mapHeight(), kLand);
    canvas_.clipToMap();
    drawWater();
    const bool many = mesh_.triangles.size() > kMostVectorTriangles;
    if (many) canvas_.beginPixels();
    drawTriangles();
    if (options_.edges) drawEdges();
    if (options_.degrees) drawDegrees();
    if (many) canvas_.endPixels();
    drawShore();
    drawLines();
    markBad();
    canvas_.unclip();
    drawScaleBar();
    legend_.drawItems(canvas_);
    if (hasRamp(options_.color)) legend_.drawRamp(canvas_, ramp());
    canvas_.finish();
  }

 private:
  std::array<Point, 3> corners(TriId t) const {
    const auto& v = mesh_.triangles[t].v;
    return {pixels_[v[0]], pixels_[v[1]], pixels_[v[2]]};
  }
  bool shows(TriId t) const { return canvas_.showsAny(corners(t).data(), 3); }
  double smallestAngle(TriId t) const {
    if (const std::uint32_t own = piece_.triangles[t]; quads_.has(own)) return quads_.least_deg[own];
    const auto& v = mesh_.triangles[t].v;
    if (!piece_.places.empty())
      return std::ranges::min(spaceAnglesDeg(piece_.places[v[0]], piece_.places[v[1]], piece_.places[v[2]]));
    return leastAngleDeg(mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]]);
  }
  bool isHalf(TriId t) const { return !diagonals_.empty() && diagonals_[piece_.triangles[t]] != kNoDiagonal; }
  bool isBad(TriId t) const { return smallestAngle(t) < options_.min_angle_deg - kAngleSlackDeg; }
  double qualityOf(TriId t) const {
    if (const std::uint32_t own = piece_.triangles[t]; quads_.has(own)) return quads_.quality(own);
    const auto& v = mesh_.triangles[t].v;
    return shapeQuality(mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]]);
  }
  double area(TriId t) const {
    const auto& v = mesh_.triangles[t].v;
    return std::abs(signedArea(mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]]));
  }
  double longestEdgePx(TriId t) const {
    const std::array<Point, 3> c = corners(t);
    const auto length = [](const Point& a, const Point& b) { return std::hypot(b.x - a.x, b.y - a.y); };
    return std::max({length(c[0], c[1]), length(c[1], c[2]), length(c[2], c[0])});
  }

  Color edgeColor() const { return options_.color == PlotColor::None ? kEdge : kEdgeOnColor; }

  void drawWater() {
    for (const auto& loop : boundaryLoops(mesh_)) {
      std::vector<Point>& drawn = loops_.emplace_back();
      for (VertexId v : loop) drawn.push_back(pixels_[v]);
    }
    canvas_.fillLoops(loops_, kWater);
  }

  Color colorOf(TriId t) const {
    switch (options_.color) {
      case PlotColor::Angle:
        return rampColor(smallestAngle(t) / 60.0);
      case PlotColor::Quality:
        return rampColor((qualityOf(t) - kLeastQuality) / (1.0 - kLeastQuality));
      case PlotColor::Feature:
      case PlotColor::Piece:  // stored as regions: see `plotMesh`
        return featureColor(static_cast<std::size_t>(std::max(0, mesh_.regions[t])));
      case PlotColor::Size:
        return rampColor((log_areas_[t] - least_log_area_) / std::max(1e-12, most_log_area_ - least_log_area_));
      case PlotColor::Region:
        return featureColor(parts_[t]);
      case PlotColor::Depth: {
        const double z = heightOf(t);
        if (!std::isfinite(z)) return kUnknown;
        return depthColor((z - lowest_z_) / std::max(1e-12, highest_z_ - lowest_z_));
      }
      case PlotColor::TimeStep: {
        const double step = steps_[piece_.triangles[t]];
        if (!std::isfinite(step)) return kUnknown;
        return rampColor(std::log(step / least_step_s_) / std::max(1e-12, std::log(most_step_s_ / least_step_s_)));
      }
      case PlotColor::None:
        break;
    }
    return kWater;
  }

  // Metres, positive up; NaN if a corner has none.
  double heightOf(TriId t) const {
    double sum = 0.0;
    for (VertexId v : mesh_.triangles[t].v) sum += grid_.z[piece_.nodes[v]];
    return sum / 3.0;
  }

  void findHeights() {
    if (grid_.z.empty()) throw InputError("the mesh has no depth to colour it by");
    lowest_z_ = std::numeric_limits<double>::infinity();
    highest_z_ = -lowest_z_;
    for (TriId t = 0; t < mesh_.triangles.size(); ++t) {
      const double z = heightOf(t);
      if (!std::isfinite(z) || !shows(t)) continue;
      lowest_z_ = std::min(lowest_z_, z);
      highest_z_ = std::max(highest_z_, z);
    }
    if (lowest_z_ > highest_z_) throw InputError("the mesh has no depth to colour it by");
  }

  void findSteps() {
    steps_ = timeSteps(grid_);
    least_step_s_ = std::numeric_limits<double>::infinity();
    for (TriId t = 0; t < mesh_.triangles.size(); ++t) {
      const double step = steps_[piece_.triangles[t]];
      if (!std::isfinite(step) || !shows(t)) continue;
      least_step_s_ = std::min(least_step_s_, step);
      most_step_s_ = std::max(most_step_s_, step);
    }
    if (!(most_step_s_ > 0.0)) throw InputError("the mesh has no depth below water, so no time step to colour it by");
  }

  // Numbers the regions by name if there are names, otherwise the connected parts.
  void findParts() {
    if (const std::vector<std::string> names = regionNames(grid_); !names.empty()) {
      const std::vector<int> numbers = regionNumbers(grid_, names);
      for (const RegionId feature : mesh_.regions)
        parts_.push_back(static_cast<std::uint32_t>(numbers[static_cast<std::size_t>(feature)]));
      return;
    }
    parts_ = partsOf(mesh_);
  }

  // On the ground: the plane's scale varies over a large mesh.
  double logArea(TriId t) const {
    const auto& v = mesh_.triangles[t].v;
    const Point middle = centroid(mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]]);
    return std::log(area(t)) - 2.0 * std::log(piece_.projection.scaleAt(middle));
  }

  // The range of colours: log areas of the triangles shown, without the smallest 2 %.
  void findAreas() {
    std::vector<double> shown;
    log_areas_.assign(mesh_.triangles.size(), 0.0);
    for (TriId t = 0; t < mesh_.triangles.size(); ++t) {
      if (!shows(t)) continue;
      log_areas_[t] = logArea(t);
      if (area(t) > 0.0) shown.push_back(log_areas_[t]);
    }
    if (shown.empty()) return;
    std::ranges::sort(shown);
    least_log_area_ = shown[shown.size() / 50];
    most_log_area_ = shown.back();
  }

  void drawTriangles() {
    if (options_.color == PlotColor::Size) findAreas();
    if (options_.color == PlotColor::Depth) findHeights();
    if (options_.color == PlotColor::Region) findParts();
    if (options_.color == PlotColor::TimeStep) findSteps();
    for (TriId t = 0; t < mesh_.triangles.size(); ++t) {
      const bool blurred = options_.edges && longestEdgePx(t) < kBlurPx;
      const bool bad = isBad(t);
      if (!blurred && !bad && options_.color == PlotColor::None) continue;
      if (!shows(t)) continue;
      const Color color = bad ? kBad : colorOf(t);
      canvas_.fillTriangle(corners(t), blurred && !bad ? mix(color, edgeColor(), kEdgeCover) : color);
    }
  }

  // Lines get thinner with the triangles, so that places with small triangles keep the same tint.
  void drawEdges() {
    std::map<int, std::vector<std::array<Point, 2>>> by_width;  // in quarter octaves below the widest
    for (TriId t = 0; t < mesh_.triangles.size(); ++t) {
      if (longestEdgePx(t) < kBlurPx || !shows(t)) continue;
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(t, i);
        const EdgeRef twin = mesh_.twin(e);
        if (twin == kNone || (twin < e && longestEdgePx(triOf(twin)) >= kBlurPx)) continue;
        if (isHalf(t) && diagonals_[piece_.triangles[t]] == i) continue;
        const Point& a = pixels_[mesh_.origin(e)];
        const Point& b = pixels_[mesh_.target(e)];
        const double width = std::min(kWidestEdgePx, kEdgeShare * std::hypot(b.x - a.x, b.y - a.y));
        const int level = static_cast<int>(std::floor(4.0 * std::log2(kWidestEdgePx / std::max(width, 1e-3))));
        by_width[level].push_back({a, b});
      }
    }
    for (const auto& [level, lines] : by_width) {
      canvas_.strokeLines(lines, kWidestEdgePx * std::exp2(-level / 4.0), edgeColor());
    }
  }

  void drawDegrees() {
    const std::vector<std::uint32_t> degrees = degreesInside(mesh_);
    std::vector<double> longest(degrees.size(), 0.0);
    for (TriId t = 0; t < mesh_.triangles.size(); ++t)
      for (const VertexId v : mesh_.triangles[t].v) longest[v] = std::max(longest[v], longestEdgePx(t));
    for (VertexId v = 0; v < degrees.size(); ++v) {
      if (degrees[v] == 0 || degrees[v] == 6 || !canvas_.showsAny(&pixels_[v], 1)) continue;
      canvas_.fillCircle(pixels_[v], std::clamp(kDotShare * longest[v], kLeastDotPx, kWidestDotPx),
                         degreeColor(degrees[v]));
    }
  }

  void drawShore() {
    std::vector<std::array<Point, 2>> borders;
    for (TriId t = 0; t < mesh_.triangles.size(); ++t) {
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(t, i);
        const EdgeRef twin = mesh_.twin(e);
        if (twin == kNone || twin < e || mesh_.regions[t] == mesh_.regions[triOf(twin)]) continue;
        borders.push_back({pixels_[mesh_.origin(e)], pixels_[mesh_.target(e)]});
      }
    }
    canvas_.strokeLines(borders, 0.9, mix(kShore, edgeColor(), 0.5));

    std::map<int, std::vector<std::array<Point, 2>>> by_width;  // in eighths of the widest
    for (const std::vector<Point>& loop : loops_) {
      if (!canvas_.showsAny(loop.data(), loop.size())) continue;
      std::vector<std::array<Point, 2>>& lines = by_width[shoreLevel(loop)];
      for (std::size_t i = 0; i < loop.size(); ++i) lines.push_back({loop[i], loop[i + 1 == loop.size() ? 0 : i + 1]});
    }
    for (const auto& [level, lines] : by_width) canvas_.strokeLines(lines, kShorePx * level / 8.0, kShore);
  }

  void drawLines() {
    for (const PlotLines& kind : lines_) {
      std::vector<std::array<Point, 2>> shown;
      for (const auto& [a, b] : kind.edges) {
        const auto at = [this](std::uint32_t node) {
          return canvas_.toPixel(piece_.projection.forward(grid_.nodes[node]));
        };
        const std::array<Point, 2> line{at(a), at(b)};
        if (canvas_.showsAny(line.data(), 2)) shown.push_back(line);
      }
      canvas_.strokeLines(shown, kind.width_px, kind.color);
    }
  }

  // Lakes and islands of a few pixels get a thin shore, which otherwise would cover them.
  static int shoreLevel(const std::vector<Point>& loop) {
    Window extent;
    for (const Point& p : loop) extent.add(p);
    return static_cast<int>(std::clamp(extent.longerSide() / 2.0, 1.0, 8.0));
  }

  // Bad triangles of a few pixels are marked with a circle, or they would not be seen.
  void markBad() {
    for (TriId t = 0; t < mesh_.triangles.size(); ++t) {
      if (!isBad(t) || longestEdgePx(t) > 8.0 || !shows(t)) continue;
      const std::array<Point, 3> c = corners(t);
      canvas_.strokeCircle({(c[0].x + c[1].x + c[2].x) / 3, (c[0].y + c[1].y + c[2].y) / 3}, 5.0, 1.2, kBad);
    }
  }

  void drawScaleBar() {
    const double units_per_metre = piece_.projection.scaleAt(centre_);
    const double pixels_per_metre = canvas_.pixelsPerUnit() * units_per_metre;
    const double wanted = kBarShare * canvas_.width() / pixels_per_metre;
    const double power = std::pow(10.0, std::floor(std::log10(wanted)));
    double length = power;
    for (double digit : {2.0, 5.0}) {
      if (digit * power <= wanted) length = digit * power;
    }
    const double y = canvas_.mapHeight() + 20.0;
    const double end = kBarLeft + length * pixels_per_metre;
    canvas_.strokeLine({kBarLeft, y}, {end, y}, 1.5, kInk);
    canvas_.strokeLine({kBarLeft, y - 4.0}, {kBarLeft, y + 4.0}, 1.5, kInk);
    canvas_.strokeLine({end, y - 4.0}, {end, y + 4.0}, 1.5, kInk);
    canvas_.text({kBarLeft, y + 18.0}, lengthText(length, grid_.crs.isPlane()), kTextPx, kInk);
  }

  LegendRamp ramp() const {
    const auto formatted = [](const char* format, double value) {
      char text[40];
      std::snprintf(text, sizeof text, format, value);
      return std::string(text);
    };
    switch (options_.color) {
      case PlotColor::Quality:
        return {rampColor, formatted("%g", kLeastQuality), "1 quality"};
      case PlotColor::Size: {
        const auto sideOf = [this](double log_area) {
          return roundedLengthText(std::sqrt(std::exp(log_area) * 2.309), grid_.crs.isPlane());
        };
        return {rampColor, sideOf(least_log_area_), sideOf(most_log_area_) + " edge"};
      }
      case PlotColor::Depth:
        return {depthColor, formatted("%.4g m", lowest_z_), formatted("%.4g m up", highest_z_)};
      case PlotColor::TimeStep:
        return {rampColor, formatted("%.3g s", least_step_s_), formatted("%.3g s by CFL", most_step_s_)};
      default:
        return {rampColor, "0\u00b0", "60\u00b0 smallest angle"};
    }
  }

  const Grid& grid_;
  const GridPiece& piece_;
  const TriMesh& mesh_;
  const PlotOptions& options_;
  const std::vector<PlotLines> lines_;
  const PlotLegend legend_;
  PlotCanvas canvas_;
  std::vector<Point> pixels_;              // per point of the mesh
  std::vector<std::vector<Point>> loops_;  // the boundary
  Point centre_;                           // of the window, in the plane
  std::vector<double> log_areas_;          // per triangle, if shown as sizes; square metres
  double least_log_area_ = 0.0;
  double most_log_area_ = 0.0;
  double lowest_z_ = 0.0;  // metres, of the triangles shown
  double highest_z_ = 0.0;
  std::vector<double> steps_;  // per triangle of the grid, if shown
  double least_step_s_ = 0.0;  // of the triangles shown
  double most_step_s_ = 0.0;
  std::vector<std::uint32_t> parts_;  // per triangle, if parts are shown
  const std::vector<std::uint8_t> diagonals_;
  const QuadAngles quads_;
};

}  // namespace

const std::vector<std::string>& plotColorNames() {
  static const std::vector<std::string> kNames = {"none",  "angle", "feature",  "region", "size",
                                                  "depth", "piece", "timestep", "quality"};  // as in PlotColor
  return kNames;
}

PlotColor plotColorNamed(const std::string& name) {
  const auto at = std::ranges::find(plotColorNames(), name);
  if (at == plotColorNames().end()) throw OptionError("there is no colouring '" + name + "'");
  return static_cast<PlotColor>(at - plotColorNames().begin());
}

bool hasRamp(PlotColor color) {
  constexpr std::array kWithScale{PlotColor::Angle, PlotColor::Size, PlotColor::Depth, PlotColor::TimeStep,
                                  PlotColor::Quality};
  return std::ranges::count(kWithScale, color) > 0;
}

void requireColors(const Grid& grid, const PlotOptions& options) {
  if (options.color == PlotColor::Piece && grid.piece_of.empty())
    throw OptionError("the mesh does not say its pieces, to be coloured by: make it with --mark-pieces, as .nc");
}

void requirePlotFormat(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending != ".svg" && ending != ".png") {
    throw OutputError("cannot draw '" + path + "': give it one of the endings .svg, .png, or .html for a page");
  }
}

bool plotMesh(const Grid& grid, const PlotOptions& options, const std::string& path) {
  requirePlotFormat(path);
  requireColors(grid, options);
  std::vector<std::uint32_t> shown = trianglesIn(grid, options.bbox);
  if (shown.empty()) throw InputError("the mesh has no triangle in the box asked for");
  const Projection projection = fitProjection(grid, shown);
  GridPiece piece = makePiece(grid, std::move(shown), projection, LineEdges(grid));
  if (isTooLargeForAPlane(piece)) {
    if (!options.bbox) return false;
    throw OptionError(
        "--bbox shows too much of the Earth for a plane: make it smaller, or leave it out and give --view "
        "natural-earth or orthographic");
  }
  if (options.color == PlotColor::Piece) {
    for (std::size_t t = 0; t < piece.triangles.size(); ++t)
      piece.mesh.regions[t] = static_cast<RegionId>(grid.piece_of[piece.triangles[t]]);
  }
  const Window window = windowOf(piece, options);
  MeshPlot(grid, piece, options, window, path).draw();
  return true;
}

}  // namespace coastmesh
