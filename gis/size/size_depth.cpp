#include "gis/size/size_depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "gis/long_wave.hpp"
#include "gis/size/depth_gaps.hpp"

namespace coastmesh {

namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

// A tabulated function of the depth: it is evaluated for each pixel.
class DepthTable {
 public:
  template <typename F>
  DepthTable(double least, F&& f) : least_(least) {
    for (int i = 0; i <= kEntries; ++i) values_.push_back(f(least_ * std::exp(kStep * i)));
  }
  double at(double depth) const {
    const double u = std::clamp(std::log(depth / least_) / kStep, 0.0, kEntries - 1e-6);
    const auto i = static_cast<std::size_t>(u);
    const double share = u - static_cast<double>(i);
    return (1.0 - share) * values_[i] + share * values_[i + 1];
  }

 private:
  static constexpr int kEntries = 2048;
  static constexpr double kStep = 0.01;  // 2048 entries reach 8e8 times the least depth

  double least_;
  std::vector<double> values_;
};

// Smooths depths, including the margin, by three box filters, which is close to a Gaussian filter. NaN where no depth
// is known. `radius`: half the box's width and height, pixels.
void smooth(std::vector<double>& depth, std::size_t width, std::size_t height, std::array<int, 2> radius) {
  std::vector<double> sums, counts;
  const auto pass = [&](std::size_t first, std::size_t step, std::size_t count, int radius_there) {
    if (radius_there < 1) return;
    const auto half = static_cast<std::size_t>(radius_there);
    sums.assign(count + 1, 0.0);
    counts.assign(count + 1, 0.0);
    for (std::size_t i = 0; i < count; ++i) {
      const double value = depth[first + i * step];
      sums[i + 1] = sums[i] + (std::isnan(value) ? 0.0 : value);
      counts[i + 1] = counts[i] + (std::isnan(value) ? 0.0 : 1.0);
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (std::isnan(depth[first + i * step])) continue;
      const std::size_t from = i - std::min(i, half), to = std::min(count, i + half + 1);
      depth[first + i * step] = (sums[to] - sums[from]) / (counts[to] - counts[from]);
    }
  };
  for (int repeat = 0; repeat < 3; ++repeat) {
    for (std::size_t y = 0; y < height; ++y) pass(y * width, 1, width, radius[0]);
    for (std::size_t x = 0; x < width; ++x) pass(x, width, height, radius[1]);
  }
}

double slopeBetween(double before, double here, double after, double pixel_m) {
  if (std::isnan(before) && std::isnan(after)) return 0.0;
  if (std::isnan(before)) return (after - here) / pixel_m;
  if (std::isnan(after)) return (here - before) / pixel_m;
  return (after - before) / (2.0 * pixel_m);
}

double depthOf(double value, const DepthRules& rules) {
  return rules.water_level_m + (rules.positive_down ? value : -value);
}

// Calls `f(pixel, x, y, depth)` for the tile's own pixels with data.
template <typename F>
void forEachDepth(const RasterTile& tile, const DepthRules& rules, F&& f) {
  for (int y = 0; y < tile.height; ++y) {
    for (int x = 0; x < tile.width; ++x) {
      const double value = tile.at(x, y);
      if (std::isnan(value)) continue;
      const double depth = depthOf(value, rules);
      f(static_cast<std::size_t>(y) * static_cast<std::size_t>(tile.width) + static_cast<std::size_t>(x), x, y, depth);
    }
  }
}

void applySlope(const RasterTile& tile, const DepthRules& rules, std::span<float> sizes) {
  const std::size_t width = tile.stride();
  std::vector<double> depth(tile.values.begin(), tile.values.end());
  for (double& d : depth) d = depthOf(d, rules);
  // Three box filters of this half width remove features shorter than the filter length.
  const auto radius = [&](int axis) {
    return static_cast<int>(std::lround(rules.slope_filter_m / (4.0 * tile.pixel_m[static_cast<std::size_t>(axis)])));
  };
  smooth(depth, width, depth.size() / width, {radius(0), radius(1)});
  forEachDepth(tile, rules, [&](std::size_t pixel, int x, int y, double) {
    const std::size_t k = tile.indexOf(x, y);
    const double dx = slopeBetween(depth[k - 1], depth[k], depth[k + 1], tile.pixel_m[0]);
    const double dy = slopeBetween(depth[k - width], depth[k], depth[k + width], tile.pixel_m[1]);
    const double slope = std::hypot(dx, dy);
    if (!(slope > 0.0)) return;
    const double d = std::max(depth[k], rules.least_depth_m);
    sizes[pixel] =
        std::min(sizes[pixel], static_cast<float>(2.0 * std::numbers::pi / rules.slope_elements * d / slope));
  });
}

}  // namespace

double wavelengthOf(double period_s, double depth_m) {
  const double deep = kGravity * period_s * period_s / (2.0 * std::numbers::pi);
  // Solves x tanh x = k0 d for x = k d by Newton's method, from the limit for shallow or for deep water.
  const double k0d = 2.0 * std::numbers::pi * depth_m / deep;
  double x = k0d < 1.0 ? std::sqrt(k0d) * (1.0 + k0d / 6.0) : k0d;
  for (int i = 0; i < 20; ++i) {
    const double t = std::tanh(x);
    const double step = (x * t - k0d) / (t + x * (1.0 - t * t));
    x -= step;
    if (std::abs(step) < 1e-14 * x) break;
  }
  return 2.0 * std::numbers::pi * depth_m / x;
}

double sizeByWaves(const DepthRules& rules, double depth_m) {
  double size = std::numeric_limits<double>::infinity();
  if (rules.wave_elements > 0.0) size = wavelengthOf(rules.period_s, depth_m) / rules.wave_elements;
  if (rules.crossing_s > 0.0) size = std::min(size, longWaveSpeed(depth_m) * rules.crossing_s);
  return size;
}

TileRule depthRule(const DepthRules& rules) {
  TileRule rule;
  // Three box filters reach 1.5 times their width, and slopes one pixel further, also without a filter.
  constexpr double kNext = 1e-3;
  if (rules.slope_elements > 0.0) rule.margin_m = std::max(0.8 * rules.slope_filter_m, kNext);
  const DepthTable waves(rules.least_depth_m, [&](double depth) { return sizeByWaves(rules, depth); });
  rule.sizes = [rules, waves](const RasterTile& tile, std::span<float> sizes) {
    forEachDepth(tile, rules, [&](std::size_t pixel, int, int, double depth) {
      double size = kNothing;
      if (rules.byWaves()) size = waves.at(std::max(depth, rules.least_depth_m));
      for (const DepthBand& band : rules.bands)
        if (depth >= band.from_m && depth < band.to_m) size = std::min(size, band.size_m);
      sizes[pixel] = static_cast<float>(size);
    });
    if (rules.slope_elements > 0.0) applySlope(tile, rules, sizes);
  };
  return rule;
}

TileRule courantRule(double time_step_s, double courant, const DepthRules& rules) {
  return {0.0, [=](const RasterTile& tile, std::span<float> sizes) {
            forEachDepth(tile, rules, [&](std::size_t pixel, int, int, double depth) {
              const double speed = longWaveSpeed(std::max(depth, rules.least_depth_m));
              sizes[pixel] = static_cast<float>(speed * time_step_s / courant);
            });
          }};
}

double depthOfStep(double size_m, double time_step_s, double courant) {
  const double speed = size_m * courant / time_step_s;
  return speed * speed / kGravity;
}

FilledField::FilledField(std::unique_ptr<SizeField> known, std::shared_ptr<const DepthGaps> gaps, const SizeRule& rule)
    : known_(std::move(known)), gaps_(std::move(gaps)), rule_(rule), least_(known_->least()) {
  least_ = std::min(least_, sizeOf(gaps_->least()));
  if (rule_.kind == SizeRule::Kind::Depths)
    for (const DepthBand& band : rule_.depths.bands) least_ = std::min(least_, band.size_m);
}

double FilledField::mostIn(const SizeBox& box) const {
  // Other sizes need not grow with the depth.
  if (rule_.kind != SizeRule::Kind::Step) return SizeField::mostIn(box);
  const DepthGaps::Range depths = gaps_->within(box);
  const double known = known_->mostIn(box);
  return std::isfinite(depths.least_m) ? std::max(known, sizeOf(depths.most_m)) : known;
}

// Must agree with `depthRule` and `courantRule`.
double FilledField::sizeOf(double depth_m) const {
  const DepthRules& rules = rule_.depths;
  const double depth = std::max(depth_m, rules.least_depth_m);
  // A margin, because nodes get their depths along the edges of the mesh, which differ slightly.
  constexpr double kMargin = 1.1;
  if (rule_.kind == SizeRule::Kind::Step) return kMargin * longWaveSpeed(depth) * rule_.time_step_s / rule_.courant;
  double size = sizeByWaves(rules, depth);
  for (const DepthBand& band : rules.bands)
    if (depth_m >= band.from_m && depth_m < band.to_m) size = std::min(size, band.size_m);
  return size;
}

void FilledField::sample(std::span<const Point> places, std::span<double> sizes) const {
  known_->sample(places, sizes);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (std::isfinite(sizes[i])) continue;
    const double depth = gaps_->at(places[i]);
    if (!std::isnan(depth)) sizes[i] = sizeOf(depth);
  }
}

void FilledField::bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const {
  known_->bound(boxes, ranges);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    SizeRange& range = ranges[i];
    if (std::isfinite(range.high)) continue;
    const DepthGaps::Range depths = gaps_->within(boxes[i]);
    if (!std::isfinite(depths.least_m)) continue;
    // Sizes grow with the depth, except those of bands.
    const bool is_gap = depths.all && range.low == std::numeric_limits<double>::infinity();
    range.low = std::min(range.low, sizeOf(depths.least_m));
    double high = sizeOf(depths.most_m);
    for (const DepthBand& band : rule_.depths.bands) {
      if (rule_.kind == SizeRule::Kind::Step || band.to_m <= depths.least_m || band.from_m > depths.most_m) continue;
      range.low = std::min(range.low, band.size_m);
      if (band.from_m <= depths.least_m && band.to_m > depths.most_m) continue;
      high = std::numeric_limits<double>::infinity();  // the band applies in a part of the box
    }
    if (is_gap) range.high = high;
  }
}

}  // namespace coastmesh
