#pragma once

#include <string>
#include <vector>

#include "apps/plot/plot_canvas.hpp"
#include "apps/plot/plot_lines.hpp"

namespace coastmesh {

// What a colour stands for: of a line or of a dot.
struct LegendItem {
  enum class Mark { Line, Dot };
  Mark mark = Mark::Line;
  Color color;
  std::string name;
};

// Of coloured lines, land beside islands only if there is an open boundary; with `degrees`, of dots on nodes too.
std::vector<LegendItem> legendItems(const std::vector<PlotLines>& lines, bool degrees);

// "12.5 km" of a length in metres; bare numbers in a plane without a place on Earth. Rounded: to two digits.
std::string lengthText(double length, bool plane);
std::string roundedLengthText(double length, bool plane);

// A scale of colours and the labels of its ends.
struct LegendRamp {
  Color (*color_at)(double share);
  std::string low, high;
};

// The strip below a map: on the left a scale bar or caption, then items in rows, on the right a scale of colours. What
// has no room beside the others is below them, so that narrow pictures have a higher strip. Lengths in pixels.
class PlotLegend {
 public:
  // `left`: the width that the scale bar or caption takes, from the picture's edge.
  PlotLegend(double width, double left, std::vector<LegendItem> items, bool has_ramp);

  double height() const { return height_; }
  void drawItems(PlotCanvas& canvas) const;
  void drawRamp(PlotCanvas& canvas, const LegendRamp& ramp) const;

 private:
  struct Placed {
    LegendItem item;
    Point at;  // the beginning of its mark, below the map
  };

  double placeItems(std::vector<LegendItem>&& items, double from, double to, double top);

  double height_ = 0.0;
  std::vector<Placed> items_;
  Point ramp_;  // upper left corner, below the map
  double ramp_width_ = 0.0;
};

}  // namespace coastmesh
