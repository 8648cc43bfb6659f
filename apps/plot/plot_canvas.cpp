#include "apps/plot/plot_canvas.hpp"

#include <cairo-svg.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <utility>

#include "gis/error.hpp"
#include "gis/file/room_on_disk.hpp"

namespace coastmesh {

namespace {

// Cairo's time grows faster than the number of lines in one path.
constexpr std::size_t kLinesPerStroke = 400;

constexpr double kPixelsInVector = 2.0;  // per unit of the drawing, in an image within a vector drawing

void setFont(cairo_t* context, double height) {
  cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, height);
}

double advanceOf(cairo_t* context, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(context, text.c_str(), &extents);
  return extents.x_advance;
}

}  // namespace

Color mix(const Color& a, const Color& b, double share_of_b) {
  const double s = std::clamp(share_of_b, 0.0, 1.0);
  return {a.red + (b.red - a.red) * s, a.green + (b.green - a.green) * s, a.blue + (b.blue - a.blue) * s};
}

double textWidth(const std::string& text, double height) {
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
      cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1), cairo_surface_destroy);
  const std::unique_ptr<cairo_t, void (*)(cairo_t*)> context(cairo_create(surface.get()), cairo_destroy);
  setFont(context.get(), height);
  return advanceOf(context.get(), text);
}

double PlotCanvas::widthOf(const Point& low, const Point& high, double size_px) {
  const double across = high.x - low.x;
  return std::max(1.0, std::round(across * size_px / std::max(across, high.y - low.y)));
}

PlotCanvas::PlotCanvas(const std::string& path, const Point& low, const Point& high, double size_px, double strip_px)
    : path_(path), vector_(std::filesystem::path(path).extension() == ".svg"), low_(low), high_(high) {
  scale_ = size_px / std::max(high.x - low.x, high.y - low.y);
  width_ = widthOf(low, high, size_px);
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
  pixels_ = !vector_;
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
  if (pixels_) {
    cairo_surface_flush(surface_.get());
    fillPixels(corners, color);
    cairo_surface_mark_dirty(surface_.get());
    return;
  }
  cairo_t* context = context_.get();
  setColor(color);
  cairo_move_to(context, corners[0].x, corners[0].y);
  cairo_line_to(context, corners[1].x, corners[1].y);
  cairo_line_to(context, corners[2].x, corners[2].y);
  cairo_close_path(context);
  // Viewers smooth the edges of neighbours separately; a hairline of the same colour closes the gap.
  cairo_fill_preserve(context);
  cairo_set_line_width(context, 0.3);
  cairo_stroke(context);
}

// Fills every pixel whose centre is in the triangle; a centre on a shared side belongs to only one of the two
// triangles.
void PlotCanvas::fillPixels(const std::array<Point, 3>& corners, const Color& color) {
  cairo_surface_t* surface = surface_.get();
  const int width = cairo_image_surface_get_width(surface);
  const int height = static_cast<int>(map_height_ * pixel_scale_);
  std::array<Point, 3> c;
  for (std::size_t i = 0; i < 3; ++i) c[i] = {corners[i].x * pixel_scale_ - 0.5, corners[i].y * pixel_scale_ - 0.5};
  if ((c[1].x - c[0].x) * (c[2].y - c[0].y) < (c[2].x - c[0].x) * (c[1].y - c[0].y)) std::swap(c[1], c[2]);
  const auto [left, right] = std::minmax({c[0].x, c[1].x, c[2].x});
  const auto [top, bottom] = std::minmax({c[0].y, c[1].y, c[2].y});
  const int x0 = static_cast<int>(std::clamp(std::ceil(left), 0.0, static_cast<double>(width)));
  const int x1 = static_cast<int>(std::clamp(std::floor(right), -1.0, static_cast<double>(width - 1)));
  const int y0 = static_cast<int>(std::clamp(std::ceil(top), 0.0, static_cast<double>(height)));
  const int y1 = static_cast<int>(std::clamp(std::floor(bottom), -1.0, static_cast<double>(height - 1)));
  if (x0 > x1 || y0 > y1) return;

  struct Side {
    Point from;
    Point way;
    double sense;  // 1, or -1 if the triangle is on the other side
    bool has(double x, double y) const {
      const double turn = sense * (way.x * (y - from.y) - way.y * (x - from.x));
      return turn > 0.0 || (turn == 0.0 && sense > 0.0);
    }
  };
  std::array<Side, 3> sides;
  for (std::size_t i = 0; i < 3; ++i) {
    // From the lexicographically smaller end, for both triangles: they round alike, and no pixel between them is lost.
    const bool turned = std::pair(c[(i + 1) % 3].x, c[(i + 1) % 3].y) < std::pair(c[i].x, c[i].y);
    const Point& a = turned ? c[(i + 1) % 3] : c[i];
    const Point& b = turned ? c[i] : c[(i + 1) % 3];
    sides[i] = {a, {b.x - a.x, b.y - a.y}, turned ? -1.0 : 1.0};
  }
  const auto byte = [](double share) { return static_cast<std::uint32_t>(std::lround(share * 255.0)); };
  const std::uint32_t pixel = byte(color.red) << 16 | byte(color.green) << 8 | byte(color.blue) | 0xff000000u;
  const int stride = cairo_image_surface_get_stride(surface) / 4;
  auto* const data = reinterpret_cast<std::uint32_t*>(cairo_image_surface_get_data(surface));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      if (sides[0].has(x, y) && sides[1].has(x, y) && sides[2].has(x, y)) data[y * stride + x] = pixel;
    }
  }
}

void PlotCanvas::beginPixels() {
  if (!vector_) return;
  pixel_scale_ = kPixelsInVector;
  outer_surface_ = std::move(surface_);
  outer_context_ = std::move(context_);
  const auto side = [this](double length) { return static_cast<int>(std::ceil(length * pixel_scale_)); };
  surface_.reset(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, side(width_), side(map_height_)));
  require(cairo_surface_status(surface_.get()));
  context_.reset(cairo_create(surface_.get()));
  cairo_scale(context_.get(), pixel_scale_, pixel_scale_);
  cairo_set_line_cap(context_.get(), CAIRO_LINE_CAP_ROUND);
  pixels_ = true;
}

void PlotCanvas::endPixels() {
  if (!outer_surface_) return;
  cairo_surface_flush(surface_.get());
  cairo_t* outer = outer_context_.get();
  cairo_save(outer);
  cairo_scale(outer, 1.0 / pixel_scale_, 1.0 / pixel_scale_);
  cairo_set_source_surface(outer, surface_.get(), 0.0, 0.0);
  cairo_paint(outer);
  cairo_restore(outer);
  context_ = std::move(outer_context_);
  surface_ = std::move(outer_surface_);
  pixel_scale_ = 1.0;
  pixels_ = false;
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

void PlotCanvas::fillCircle(const Point& centre, double radius, const Color& color) {
  setColor(color);
  cairo_arc(context_.get(), centre.x, centre.y, radius, 0.0, 2.0 * std::numbers::pi);
  cairo_fill(context_.get());
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
  setFont(context, height);
  cairo_move_to(context, baseline.x, baseline.y);
  cairo_show_text(context, text.c_str());
}

void PlotCanvas::textEndingAt(const Point& baseline, const std::string& content, double height, const Color& color) {
  setFont(context_.get(), height);
  text({baseline.x - advanceOf(context_.get(), content), baseline.y}, content, height, color);
}

void PlotCanvas::clipToMap() {
  cairo_save(context_.get());
  cairo_rectangle(context_.get(), 0.0, 0.0, width_, map_height_);
  cairo_clip(context_.get());
}

void PlotCanvas::unclip() { cairo_restore(context_.get()); }

void PlotCanvas::finish() {
  errno = 0;  // cairo does not say why it cannot write
  require(cairo_status(context_.get()));
  if (!vector_) require(cairo_surface_write_to_png(surface_.get(), path_.c_str()));
  cairo_surface_finish(surface_.get());
  require(cairo_surface_status(surface_.get()));
}

void PlotCanvas::require(cairo_status_t status) const {
  if (status == CAIRO_STATUS_SUCCESS) return;
  const std::string why = status == CAIRO_STATUS_WRITE_ERROR ? whyNoRoom(path_, errno) : "";
  throw OutputError("cannot draw '" + path_ + "': " + (why.empty() ? cairo_status_to_string(status) : why));
}

}  // namespace coastmesh
