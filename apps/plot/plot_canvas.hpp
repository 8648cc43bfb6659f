#pragma once

#include <cairo.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/point.hpp"

namespace coastmesh {

struct Color {
  double red = 0.0;  // 0 to 1
  double green = 0.0;
  double blue = 0.0;
};

Color mix(const Color& a, const Color& b, double share_of_b);

// The width in pixels that `PlotCanvas::text` takes.
double textWidth(const std::string& text, double height);

// A window of the plane drawn into a picture: coordinates are pixels, y down, unless named `plane`.
class PlotCanvas {
 public:
  // The width of a picture whose window fills `size_px` on its longer side.
  static double widthOf(const Point& low, const Point& high, double size_px);

  // The window fills `size_px` on its longer side, with `strip_px` below it. Throws OutputError.
  PlotCanvas(const std::string& path, const Point& low, const Point& high, double size_px, double strip_px);

  double width() const { return width_; }
  double mapHeight() const { return map_height_; }
  double pixelsPerUnit() const { return scale_; }
  Point toPixel(const Point& plane) const { return {(plane.x - low_.x) * scale_, (high_.y - plane.y) * scale_}; }
  // True if the box around the pixels meets the map.
  bool showsAny(const Point* pixels, std::size_t count) const;

  void fillRectangle(const Point& corner, double width, double height, const Color& color);
  // Areas that meet edge to edge are drawn without a gap between them.
  void fillTriangle(const std::array<Point, 3>& corners, const Color& color);
  // Even-odd over all loops together.
  void fillLoops(const std::vector<std::vector<Point>>& loops, const Color& color);
  void strokeLine(const Point& a, const Point& b, double width, const Color& color);
  void fillCircle(const Point& centre, double radius, const Color& color);
  void strokeCircle(const Point& centre, double radius, double width, const Color& color);
  // Many lines of one width and colour.
  void strokeLines(const std::vector<std::array<Point, 2>>& lines, double width, const Color& color);
  void text(const Point& baseline, const std::string& text, double height, const Color& color);
  void textEndingAt(const Point& baseline, const std::string& text, double height, const Color& color);
  void clipToMap();
  void unclip();

  // Between these calls, a vector drawing too gets pixels: for more areas and lines than viewers can handle.
  void beginPixels();
  void endPixels();

  // Writes the picture. Throws OutputError.
  void finish();

 private:
  struct DestroySurface {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  };
  struct DestroyContext {
    void operator()(cairo_t* context) const { cairo_destroy(context); }
  };

  void setColor(const Color& color);
  void fillPixels(const std::array<Point, 3>& corners, const Color& color);
  void require(cairo_status_t status) const;

  std::string path_;
  bool vector_;
  Point low_;
  Point high_;
  double scale_ = 1.0;
  double width_ = 0.0;
  double map_height_ = 0.0;
  std::unique_ptr<cairo_surface_t, DestroySurface> surface_;
  std::unique_ptr<cairo_t, DestroyContext> context_;
  // The vector drawing, while an image for it is drawn.
  std::unique_ptr<cairo_surface_t, DestroySurface> outer_surface_;
  std::unique_ptr<cairo_t, DestroyContext> outer_context_;
  bool pixels_ = false;       // an image is drawn into
  double pixel_scale_ = 1.0;  // of that image
};

}  // namespace coastmesh
