#include "apps/plot/plot_legend.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "apps/plot/plot_style.hpp"

namespace coastmesh {
namespace {

constexpr double kMargin = 12.0, kGap = 16.0;  // beside the picture's edges, between entries
constexpr double kRow = 16.0, kFirstRow = 20.0;
constexpr double kMark = 18.0, kToName = 22.0;
constexpr double kRampHeight = 10.0, kLabelsBelow = 26.0;
constexpr double kDotRadius = 3.5;

double widthOf(const LegendItem& item) { return kToName + textWidth(item.name, kTextPx); }

}  // namespace

std::vector<LegendItem> legendItems(const std::vector<PlotLines>& lines, bool degrees) {
  constexpr LegendItem::Mark kLineMark = LegendItem::Mark::Line, kDotMark = LegendItem::Mark::Dot;
  std::vector<LegendItem> items;
  for (const PlotLines& kind : lines) {
    if (kind.kind == PlotLineKind::Island) continue;
    items.push_back({kLineMark, kind.color, kind.name});
    if (kind.kind == PlotLineKind::Open)
      items.insert(items.end(), {{kLineMark, kIsland, "island"}, {kLineMark, kShore, "land"}});
  }
  if (degrees)
    items.insert(items.end(), {{kDotMark, degreeColor(5), "5 neighbours"},
                               {kDotMark, degreeColor(7), "7"},
                               {kDotMark, degreeColor(8), "other"}});
  return items;
}

std::string lengthText(double length, bool plane) {
  char text[40];
  if (plane) {
    std::snprintf(text, sizeof text, "%g", length);
  } else if (length >= 1000.0) {
    std::snprintf(text, sizeof text, "%g km", length / 1000.0);
  } else {
    std::snprintf(text, sizeof text, "%g m", length);
  }
  return text;
}

std::string roundedLengthText(double length, bool plane) {
  const double power = std::pow(10.0, std::floor(std::log10(length)) - 1.0);
  return lengthText(std::round(length / power) * power, plane);
}

PlotLegend::PlotLegend(double width, double left, std::vector<LegendItem> items, bool has_ramp)
    : ramp_width_(has_ramp ? std::min(kRampPx, width - 2.0 * kMargin) : 0.0) {
  double widest = 0.0;
  for (const LegendItem& item : items) widest = std::max(widest, widthOf(item));
  const double after = left + kGap, end = width - kMargin;
  const double needed = items.empty() ? 0.0 : widest + kGap;
  const bool is_ramp_beside = !has_ramp || after + needed + ramp_width_ <= end;
  const bool are_items_beside = after + widest <= (is_ramp_beside && has_ramp ? end - ramp_width_ - kGap : end);
  height_ = kStripPx;
  if (is_ramp_beside) ramp_ = {end - ramp_width_, kMargin};
  if (are_items_beside) {
    const double to = is_ramp_beside && has_ramp ? end - ramp_width_ - kGap : end;
    height_ = std::max(height_, placeItems(std::move(items), after, to, 0.0));
  } else {
    height_ = placeItems(std::move(items), kMargin, end, height_ - kFirstRow + kRow);
  }
  if (is_ramp_beside) return;
  ramp_ = {kMargin, height_ + kMargin / 2.0};
  height_ += kStripPx;
}

// Places the items in rows between two places across, from `top` down; returns where the strip may end below them.
// Items wider than a row are left out.
double PlotLegend::placeItems(std::vector<LegendItem>&& items, double from, double to, double top) {
  Point at{from, top + kFirstRow};
  for (LegendItem& item : items) {
    const double width = widthOf(item);
    if (width > to - from) continue;
    if (at.x > from && at.x + width > to) at = {from, at.y + kRow};
    items_.push_back({std::move(item), at});
    at.x += width + kGap;
  }
  return items_.empty() ? kStripPx : at.y + kRow / 2.0;
}

void PlotLegend::drawItems(PlotCanvas& canvas) const {
  for (const auto& [item, at] : items_) {
    const double y = canvas.mapHeight() + at.y;
    if (item.mark == LegendItem::Mark::Line)
      canvas.strokeLine({at.x, y}, {at.x + kMark, y}, kRolePx, item.color);
    else
      canvas.fillCircle({at.x + kMark / 2.0, y}, kDotRadius, item.color);
    canvas.text({at.x + kToName, y + 4.0}, item.name, kTextPx, kInk);
  }
}

void PlotLegend::drawRamp(PlotCanvas& canvas, const LegendRamp& ramp) const {
  if (!(ramp_width_ > 0.0)) return;
  constexpr int kSteps = 60;
  const double step = ramp_width_ / kSteps, top = canvas.mapHeight() + ramp_.y;
  for (int i = 0; i < kSteps; ++i)
    canvas.fillRectangle({ramp_.x + i * step, top}, step + 0.5, kRampHeight, ramp.color_at((i + 0.5) / kSteps));
  canvas.text({ramp_.x, top + kLabelsBelow}, ramp.low, kTextPx, kInk);
  canvas.textEndingAt({ramp_.x + ramp_width_, top + kLabelsBelow}, ramp.high, kTextPx, kInk);
}

}  // namespace coastmesh
