#include "apps/plot_canvas.hpp"

#include <cairo-svg.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "gis/error.hpp"

namespace coastmesh {

namespace {

// Cairo's time grows faster than the number of lines in one path.
constexpr std::size_t kLinesPerStroke = 400;

}  // namespace

Color mix(const Color& a, const Color& b, double share_of_b) {
  const double s = std::clamp(share_of_b, 0.0, 1.0);
  return {a.red + (b.red - a.red) * s, a.green + (b.green - a.green) * s, a.blue + (b.blue - a.blue) * s};
}

PlotCanvas::PlotCanvas(const std::string& path, const Point& low, const Point& high, double size_px, double strip_px)
    : path_(path), vector_(std::filesystem::path(path).extension() == ".svg"), low_(low), high_(high) {
  scale_ = size_px / std::max(high.x - low.x, high.y - low.y);
  width_ = std::max(1.0, std::round((high.x - low.x) * scale_));
  map_height_ = std::max(1.0, std::round((high.y - low.y) * scale_));
  const double height = map_height_ + strip_px;
  surface_.reset(
      vector_ ? cairo_svg_surface_create(path.c_str(), width_, height)
              : cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width_), static_cast<int>(height)));
  require(cairo_surface_status(surface_.get()));
  context_.reset(cairo_create(surface_.get()));
  require(cairo_status(context_.get()));
  cairo_set_line_cap(context_.get(), CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
}

bool PlotCanvas::showsAny(const Point* pixels, std::size_t count) const {
  const auto [left, right] = std::minmax_element(pixels, pixels + count, [](auto& a, auto& b) { return a.x < b.x; });
  const auto [top, bottom] = std::minmax_element(pixels, pixels + count, [](auto& a, auto& b) { return a.y < b.y; });
  return right->x >= 0.0 && left->x <= width_ && bottom->y >= 0.0 && top->y <= map_height_;
}

void PlotCanvas::setColor(const Color& color) {
  cairo_set_source_rgb(context_.get(), color.red, color.green, color.blue);
}

void PlotCanvas::fillRectangle(const Point& corner, double width, double height, const Color& color) {
  setColor(color);
  cairo_rectangle(context_.get(), corner.x, corner.y, width, height);
  cairo_fill(context_.get());
}

void PlotCanvas::fillTriangle(const std::array<Point, 3>& corners, const Color& color) {
  cairo_t* context = context_.get();
  setColor(color);
  cairo_move_to(context, corners[0].x, corners[0].y);
  cairo_line_to(context, corners[1].x, corners[1].y);
  cairo_line_to(context, corners[2].x, corners[2].y);
  cairo_close_path(context);
  if (vector_) {
    // A viewer smooths the rims of neighbours one by one; a hairline of the same colour closes the gap.
    cairo_fill_preserve(context);
    cairo_set_line_width(context, 0.3);
    cairo_stroke(context);
  } else {
    cairo_set_antialias(context, CAIRO_ANTIALIAS_NONE);
    cairo_fill(context);
    cairo_set_antialias(context, CAIRO_ANTIALIAS_DEFAULT);
  }
}

void PlotCanvas::fillLoops(const std::vector<std::vector<Point>>& loops, const Color& color) {
  cairo_t* context = context_.get();
  for (const std::vector<Point>& loop : loops) {
    cairo_move_to(context, loop.front().x, loop.front().y);
    for (const Point& p : loop) cairo_line_to(context, p.x, p.y);
    cairo_close_path(context);
  }
  setColor(color);
  cairo_set_fill_rule(context, CAIRO_FILL_RULE_EVEN_ODD);
  cairo_fill(context);
}

void PlotCanvas::strokeLine(const Point& a, const Point& b, double width, const Color& color) {
  strokeLines({{a, b}}, width, color);
}

void PlotCanvas::strokeCircle(const Point& centre, double radius, double width, const Color& color) {
  setColor(color);
  cairo_set_line_width(context_.get(), width);
  cairo_arc(context_.get(), centre.x, centre.y, radius, 0.0, 2.0 * std::numbers::pi);
  cairo_stroke(context_.get());
}

void PlotCanvas::strokeLines(const std::vector<std::array<Point, 2>>& lines, double width, const Color& color) {
  cairo_t* context = context_.get();
  setColor(color);
  cairo_set_line_width(context, width);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    cairo_move_to(context, lines[i][0].x, lines[i][0].y);
    cairo_line_to(context, lines[i][1].x, lines[i][1].y);
    if (i % kLinesPerStroke == kLinesPerStroke - 1) cairo_stroke(context);
  }
  cairo_stroke(context);
}

void PlotCanvas::text(const Point& baseline, const std::string& text, double height, const Color& color) {
  cairo_t* context = context_.get();
  setColor(color);
  cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, height);
  cairo_move_to(context, baseline.x, baseline.y);
  cairo_show_text(context, text.c_str());
}

void PlotCanvas::textEndingAt(const Point& baseline, const std::string& content, double height, const Color& color) {
  cairo_text_extents_t extents;
  cairo_select_font_face(context_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_.get(), height);
  cairo_text_extents(context_.get(), content.c_str(), &extents);
  text({baseline.x - extents.x_advance, baseline.y}, content, height, color);
}

void PlotCanvas::clipToMap() {
  cairo_save(context_.get());
  cairo_rectangle(context_.get(), 0.0, 0.0, width_, map_height_);
  cairo_clip(context_.get());
}

void PlotCanvas::unclip() { cairo_restore(context_.get()); }

void PlotCanvas::finish() {
  require(cairo_status(context_.get()));
  if (!vector_) require(cairo_surface_write_to_png(surface_.get(), path_.c_str()));
  cairo_surface_finish(surface_.get());
  require(cairo_surface_status(surface_.get()));
}

void PlotCanvas::require(cairo_status_t status) const {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw OutputError("cannot draw '" + path_ + "': " + cairo_status_to_string(status));
}

}  // namespace coastmesh
