#include "apps/plot/plot_style.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace coastmesh {
namespace {

// The colour at a share of the way along four evenly spaced ones.
Color between(const std::array<Color, 4>& stops, double share) {
  const double at = std::clamp(share, 0.0, 1.0) * 3.0;
  const auto stop = std::min<std::size_t>(2, static_cast<std::size_t>(at));
  return mix(stops[stop], stops[stop + 1], at - static_cast<double>(stop));
}

}  // namespace

Color rampColor(double share) {
  return between({{{0.80, 0.25, 0.18}, {0.97, 0.78, 0.47}, {0.90, 0.94, 0.80}, {0.18, 0.49, 0.66}}}, share);
}

Color depthColor(double share) {
  return between({{{0.06, 0.16, 0.42}, {0.15, 0.47, 0.73}, {0.60, 0.83, 0.79}, {0.97, 0.92, 0.72}}}, share);
}

Color featureColor(std::size_t feature) {
  const double hue = std::fmod(static_cast<double>(feature) * 0.6180339887498949, 1.0);
  const auto channel = [hue](double shift) { return 0.80 + 0.14 * std::cos(2.0 * std::numbers::pi * (hue + shift)); };
  return {channel(0.0), channel(1.0 / 3.0), channel(2.0 / 3.0)};
}

void drawRamp(PlotCanvas& canvas, Color (*color_at)(double), const std::string& low, const std::string& high) {
  constexpr int kSteps = 60;
  constexpr double kStep = (kRampPx - 12.0) / kSteps;
  const double left = canvas.width() - kRampPx, top = canvas.mapHeight() + 12.0;
  if (left < canvas.width() / 2) return;  // no room beside the other entries
  for (int i = 0; i < kSteps; ++i)
    canvas.fillRectangle({left + i * kStep, top}, kStep + 0.5, 10.0, color_at((i + 0.5) / kSteps));
  canvas.text({left, top + 26.0}, low, 13.0, kInk);
  canvas.textEndingAt({left + kSteps * kStep, top + 26.0}, high, 13.0, kInk);
}

}  // namespace coastmesh
