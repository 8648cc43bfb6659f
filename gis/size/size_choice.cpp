#include "gis/size/size_choice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/size/on_surface.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

namespace {

constexpr double kVertices = 30'000.0;
constexpr double kElementsAcross = 20.0;
// Estimates of vertices are right to half as much; between these bounds the mesh has 10^4 to 10^5.
constexpr double kFewEnough = 50'000.0, kManyEnough = 18'000.0;
constexpr int kRounds = 8;

// Two digits, as a person would choose.
double rounded(double size) {
  const double unit = std::pow(10.0, std::floor(std::log10(size)) - 1.0);
  return std::round(size / unit) * unit;
}

double verticesFor(const SizeOptions& options, const SizeInputs& inputs, const Domain& domain, const ItemLoop& loop) {
  constexpr double kFarTooMany = 100.0 * kVertices;
  try {
    return makeSizeFunction(options, inputs, domain, kFarTooMany, loop).demand.vertices;
  } catch (const TooManyVertices& error) {
    return std::max(kFarTooMany, error.demand.vertices);
  }
}

}  // namespace

SizeOptions chooseSizes(const SizeOptions& options, const SizeInputs& inputs, const Domain& domain,
                        const ItemLoop& loop) {
  Box box;
  for (const Point& p : domain.pslg.points) box.add(p);
  const Point middle{0.5 * (box.xmin + box.xmax), 0.5 * (box.ymin + box.ymax)};
  const double area = areaOn(domain.projection.surface(), {box.xmin, box.ymin}, {box.xmax, box.ymax});
  const double across = std::sqrt(area) / domain.projection.measureAt(middle);
  SizeOptions chosen = options;
  chosen.choose = false;
  chosen.most_m = rounded(across / kElementsAcross);
  chosen.shore_m = rounded(chosen.most_m / 20.0);
  for (int round = 0; round < kRounds; ++round) {
    const double vertices = verticesFor(chosen, inputs, domain, loop);
    if (vertices > kManyEnough && vertices < kFewEnough) break;
    // They go with the size to the power of -1, along a shore, to -2.
    const double size = chosen.shore_m * std::pow(vertices / kVertices, 0.65);
    // Seas where not the shore, but shallow water has most of them.
    if (vertices > kFewEnough && size > chosen.most_m / 8.0)
      chosen.depth.wave_elements = std::round(0.6 * chosen.depth.wave_elements);
    chosen.shore_m = rounded(std::min(size, chosen.most_m));
  }
  return chosen;
}

std::string sizesAsOptions(const SizeOptions& options) {
  std::string text;
  const auto add = [&text](const char* option, double value) {
    char number[40];
    std::snprintf(number, sizeof number, " %.10g", value);
    text += (text.empty() ? "" : " ") + std::string(option) + number;
  };
  add("--size-shore", options.shore_m);
  add("--shore-rate", options.shore_rate);
  add("--size-max", options.most_m);
  add("--grade", options.gradation);
  add("--wave-elements", options.depth.wave_elements);
  add("--time-step", options.time_step_s);
  return text + (options.coast == CoastDetail::Follow ? " --coast follow" : " --coast keep");
}

}  // namespace coastmesh
