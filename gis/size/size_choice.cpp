#include "gis/size/size_choice.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/metric.hpp"
#include "core/size/on_surface.hpp"
#include "gis/clean/geodesic_area.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

namespace {

constexpr double kVertices = 30'000.0;
constexpr double kElementsAcross = 20.0;
// Estimates of vertices are accurate to a factor of about two; between these bounds the mesh has 10^4 to 10^5.
constexpr double kFewEnough = 50'000.0, kManyEnough = 18'000.0;
constexpr int kRounds = 8;
// Largest size over that at the shore; a fifth of this suffices for a straight shore across the domain.
constexpr double kMostGrowth = 1000.0;
// Smaller sizes are of no use if they raise the number of vertices by no more than this factor.
constexpr double kHardlyMore = 1.05;
constexpr double kBetweenProbes = 1.1;

// Rounds to two digits, as a person would.
double rounded(double size) {
  const double place = std::floor(std::log10(size)) - 1.0;
  const double unit = std::pow(10.0, std::abs(place));  // a whole number, so that the result is the nearest to 0.3
  return place < 0.0 ? std::round(size * unit) / unit : std::round(size / unit) * unit;
}

struct Expected {
  double vertices = 0.0;
  bool has_shore = true;
  double floor_m = 0.0;  // the largest size that the time step requires
};

Expected expectedFor(const SizeOptions& options, const SizeInputs& inputs, const Domain& domain, const ItemLoop& loop) {
  constexpr double kFarTooMany = 100.0 * kVertices;
  try {
    const DomainSizes sizes = makeSizeFunction(options, inputs, domain, kFarTooMany, loop);
    return {sizes.demand.vertices, sizes.has_shore, sizes.floor_m};
  } catch (const TooManyVertices& error) {
    return {.vertices = std::max(kFarTooMany, error.demand.vertices)};
  }
}

// The size with which a mesh of equal triangles has so many vertices.
double uniformSize(const Domain& domain, const SizeInputs& inputs, double vertices) {
  // With coordinates used as they are, lengths are in their units.
  const double area = geodesicArea(domain, domain.projection.isIdentity() ? Crs{} : inputs.crs);
  return std::sqrt(2.0 / std::sqrt(3.0) * area / vertices);
}

}  // namespace

SizeOptions chooseSizes(const SizeOptions& options, const SizeInputs& inputs, const Domain& domain,
                        const ItemLoop& loop, double share) {
  Box box;
  for (const Point& p : domain.pslg.points) box.add(p);
  const Point middle{0.5 * (box.xmin + box.xmax), 0.5 * (box.ymin + box.ymax)};
  const double area = areaOn(domain.projection.surface(), {box.xmin, box.ymin}, {box.xmax, box.ymax});
  const double across = std::sqrt(area) / domain.projection.measureAt(middle);
  const auto allowed = [&options](double size) { return std::max(rounded(size), options.least_m); };
  const double most = allowed(across / kElementsAcross), finest = allowed(most / kMostGrowth);
  SizeOptions chosen = options;
  chosen.choose = false;
  chosen.most_m = most;
  chosen.shore_m = allowed(most / 20.0);
  SizeOptions before = chosen;
  double vertices_before = 0.0;
  bool has_shore = true, shore_decides = true;
  for (int round = 0; round < kRounds; ++round) {
    const Expected expected = expectedFor(chosen, inputs, domain, loop);
    const double vertices = expected.vertices / share;
    const double least_most = expected.floor_m > 0.0 ? allowed(kBetweenProbes * expected.floor_m) : options.least_m;
    if (has_shore) chosen.most_m = std::max(chosen.most_m, least_most);
    if (has_shore && !expected.has_shore) {
      has_shore = shore_decides = false;
      chosen.shore_m = chosen.most_m = SizeOptions::kNone;
      chosen.size_m = most;
    }
    if (vertices >= kManyEnough && vertices <= kFewEnough) break;
    // Finer sizes had no effect, perhaps because the time step does not allow them.
    if (vertices_before < kManyEnough && vertices < kHardlyMore * vertices_before) {
      chosen = before;
      if (!shore_decides) break;
      shore_decides = false;
    }
    before = chosen;
    vertices_before = vertices;
    // The number of vertices is proportional to a power of the size: between -1, along a shore, and -2.
    const double ratio = vertices / kVertices;
    double size = has_shore ? chosen.shore_m * std::pow(ratio, 0.65) : chosen.size_m * std::sqrt(ratio);
    if (has_shore && size < finest) {
      shore_decides = shore_decides && chosen.shore_m > finest;
      size = finest;
    }
    // Seas where most vertices are in shallow water, not at the shore.
    if (vertices > kFewEnough && size > most / 8.0)
      chosen.depth.wave_elements = std::round(0.6 * chosen.depth.wave_elements);
    if (!has_shore) {
      chosen.size_m = allowed(std::min(size, most));
    } else if (shore_decides || vertices > kFewEnough) {
      chosen.shore_m = allowed(std::min(size, chosen.most_m));
    } else {
      const double of_lacking = uniformSize(domain, inputs, (kVertices - vertices) * share);
      chosen.most_m = std::max({allowed(std::min(of_lacking, chosen.most_m)), chosen.shore_m, least_most});
    }
  }
  return chosen;
}

double shoreSpacing(const Domain& domain) {
  std::vector<double> lengths;
  for (const Segment& segment : domain.pslg.segments) {
    if (isOpenTag(segment.tag)) continue;
    const Point &a = domain.pslg.points[segment.a], &b = domain.pslg.points[segment.b];
    lengths.push_back(distance(a, b) / domain.projection.scaleAt(a + 0.5 * (b - a)));
  }
  if (lengths.empty()) return 0.0;
  const auto quarter = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 4);
  std::ranges::nth_element(lengths, quarter);
  return *quarter;
}

std::string sizesAsOptions(const SizeOptions& options) {
  std::string text;
  const auto add = [&text](const char* option, double value) {
    char number[400];
    const std::to_chars_result end = std::to_chars(number, number + sizeof number, value, std::chars_format::fixed);
    text += (text.empty() ? "" : " ") + std::string(option) + " " + std::string(number, end.ptr);
  };
  if (std::isfinite(options.size_m)) add("--size", options.size_m);
  if (std::isfinite(options.shore_m)) {
    add("--size-shore", options.shore_m);
    if (!options.given.shore_rate) add("--shore-rate", options.shore_rate);
  }
  if (std::isfinite(options.most_m)) add("--size-max", options.most_m);
  if (!options.given.gradation) add("--grade", options.gradation);
  if (options.depth.wave_elements > 0.0) add("--wave-elements", options.depth.wave_elements);
  if (!options.given.time_step && options.time_step_s > 0.0) add("--time-step", options.time_step_s);
  if (!options.given.coast) text += options.coast == CoastDetail::Follow ? " --coast follow" : " --coast keep";
  return text;
}

}  // namespace coastmesh
