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

constexpr Color kFive{0.05, 0.60, 0.20};
constexpr Color kSeven{0.93, 0.45, 0.05};
constexpr Color kOtherDegree{0.55, 0.05, 0.55};

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

Color degreeColor(std::uint32_t degree) { return degree == 5 ? kFive : degree == 7 ? kSeven : kOtherDegree; }

}  // namespace coastmesh
