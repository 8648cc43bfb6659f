#include "gis/size/size_source.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/metric.hpp"
#include "core/size/on_surface.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/crs/ground_balls.hpp"
#include "gis/error.hpp"
#include "gis/long_wave.hpp"
#include "gis/projection/scale_table.hpp"
#include "gis/size/composed_sizes.hpp"
#include "gis/size/depth_gaps.hpp"
#include "gis/size/guide_lines.hpp"
#include "gis/size/read_frames.hpp"
#include "gis/size/size_channel.hpp"
#include "gis/size/size_distance.hpp"
#include "gis/size/size_floor.hpp"
#include "gis/size/size_raster.hpp"
#include "gis/size/sizes_by_distance.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// True if the rule may request no size where a raster knows the depth.
bool mayRequestNothing(const SizeRule& rule) { return rule.kind == SizeRule::Kind::Depths && !rule.depths.byWaves(); }

// A field for each rule; where several rasters overlap, the first with a value is used.
std::vector<std::unique_ptr<SizeField>> rasterFields(const std::vector<RasterGeometry>& rasters,
                                                     const SizeInputs& inputs, const Projection& projection,
                                                     const Box& box, const std::vector<SizeRule>& rules,
                                                     const ItemLoop& loop) {
  std::vector<std::shared_ptr<const RasterFrame>> frames;
  for (const RasterGeometry& raster : rasters)
    frames.push_back(std::make_shared<RasterFrame>(raster, inputs.crs, projection, box, loop));
  std::vector<SizeRule> read = rules;
  const bool needs_coverage = frames.size() > 1 && std::ranges::any_of(rules, mayRequestNothing);
  if (needs_coverage) read.push_back({SizeRule::Kind::Known, {}, 0.0, 0.0});
  FrameTiles tiles = readFrames(frames, std::span<const SizeRule>(read), inputs.readers, loop);
  const auto fieldsOf = [&](std::vector<std::vector<SizeTile>> of_rule) {
    FirstOfFields::Fields fields;
    for (std::size_t f = 0; f < frames.size(); ++f)
      fields.push_back(std::make_unique<RasterField>(frames[f], std::move(of_rule[f])));
    return fields;
  };
  std::vector<std::unique_ptr<SizeField>> by_rule;
  for (std::size_t r = 0; r < rules.size(); ++r) {
    FirstOfFields::Fields fields = fieldsOf(std::move(tiles[r]));
    if (fields.size() == 1)
      by_rule.push_back(std::move(fields.front()));
    else if (needs_coverage && mayRequestNothing(rules[r]))
      by_rule.push_back(std::make_unique<FirstOfFields>(std::move(fields), fieldsOf(tiles.back())));
    else
      by_rule.push_back(std::make_unique<FirstOfFields>(std::move(fields)));
  }
  return by_rule;
}

// The centres of `across` by `across` squares, of those of a square that are wanted.
template <typename IsWanted>
std::vector<Point> probesOf(const SizeBox& square, int across, const IsWanted& is_wanted) {
  const double step = 2.0 * square.half / across;
  std::vector<Point> places;
  for (int j = 0; j < across; ++j) {
    for (int i = 0; i < across; ++i) {
      const Point place = square.centre + Point{(i + 0.5) * step - square.half, (j + 0.5) * step - square.half};
      if (is_wanted(SizeBox{place, 0.5 * step})) places.push_back(place);
    }
  }
  return places;
}

// The largest value of a field in the domain, from probes.
double largestOf(const SizeField& field, const DomainMask& mask, const SizeBox& square) {
  constexpr int kProbes = 64;
  const std::vector<Point> places = probesOf(square, kProbes, [&](const SizeBox& box) { return mask.meets(box); });
  std::vector<double> sizes(places.size());
  field.sample(places, sizes);
  return std::accumulate(sizes.begin(), sizes.end(), 0.0, [](double a, double b) { return std::max(a, b); });
}

// The gradation to be reserved for changes of the measure k. The tree grades lengths k h on the surface, but lengths h
// on the ground must be graded. k grad h is grad (k h) less h grad k: at most this value. In a plane k is the scale; on
// a sphere it hardly changes. Infinite h counts as `most_m`.
double gradationForMeasure(const ComposedSizes& source, const ScaleTable& scales, const SizeBox& square,
                           double most_m) {
  constexpr int kProbes = 64;
  const double step = 2.0 * square.half / kProbes;
  const std::vector<Point> places = probesOf(square, kProbes, [&](const SizeBox& box) { return source.isWanted(box); });
  std::vector<double> lengths(places.size());
  source.sample(places, lengths);
  double most = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Point x{0.5 * step, 0.0}, y{0.0, 0.5 * step};
    const auto measure = [&](const Point& place) { return scales.measureAt(place); };
    const double k = measure(places[i]), h = std::min(lengths[i] / k, most_m);
    const double slope =
        std::hypot(measure(places[i] + x) - measure(places[i] - x), measure(places[i] + y) - measure(places[i] - y));
    if (std::isfinite(slope)) most = std::max(most, h * slope / step / scales.surface().shrinkAt(places[i]));
  }
  constexpr double kBetweenProbes = 1.25;
  return kBetweenProbes * most;
}

// The largest gradient of the measure within the square, estimated from probes.
double steepestMeasure(const ScaleTable& scales, const SizeBox& square) {
  constexpr int kProbes = 32;
  const double step = 2.0 * square.half / kProbes;
  const auto at = [&](int i, int j) {
    return scales.measureAt(square.centre + Point{i * step - square.half, j * step - square.half});
  };
  double most = 0.0;
  for (int j = 0; j < kProbes; ++j)
    for (int i = 0; i < kProbes; ++i)
      most = std::max(most, std::hypot(at(i + 1, j) - at(i, j), at(i, j + 1) - at(i, j)) / step);
  return most;
}

// An upper bound of a domain's extent on the surface, from that in the plane: at most half the circumference of a
// sphere.
double reachOn(const Surface& surface, double extent, const SizeBox& square) {
  if (!surface.isCurved()) return extent;
  return std::min(extent * shrinkIn(surface, square).high, std::numbers::pi * surface.radius());
}

// Few edges are shorter than this share of the size there.
constexpr double kShortestOfSize = 0.6;
// Edges of a shore that follows the sizes are shorter: beside it, the time step requires sizes larger by this factor.
constexpr double kShoreFloor = 1.4;

// Limits of a map of sizes, which takes about one cell for two vertices; more if few vertices resolve small details.
constexpr double kCellsPerVertex = 2.0;
constexpr double kLeastCells = 200'000.0;

std::string askingOfDepths(const DepthRules& rules) {
  std::string options;
  for (const auto& [asked, option] : {std::pair{rules.wave_elements > 0.0, "--wave-elements"},
                                      {rules.crossing_s > 0.0, "--courant-min"},
                                      {rules.slope_elements > 0.0, "--slope-elements"},
                                      {!rules.bands.empty(), "--depth-band"}})
    if (asked) options += (options.empty() ? "" : " or ") + std::string(option);
  return options;
}

// Sizes from depths; null if none are requested.
struct DepthSizes {
  std::unique_ptr<SizeField> asked, step;
  FilledWater filled;
};

DepthSizes sizesOfDepths(const SizeOptions& options, const SizeInputs& inputs, const Domain& domain, const Box& square,
                         const SizeBox& root, const DomainMask& mask, double others_least_m,
                         const std::function<double(const Point&)>& scale, const ItemLoop& loop) {
  DepthSizes sizes;
  const DepthRules& rules = options.depth;
  const bool has_step = options.time_step_s > 0.0;
  // Slopes request nothing where depths were not measured. On a whole globe land is meshed as well, and has no depths.
  const bool fills =
      options.gaps != GapFill::None && !domain.closed() && (has_step || rules.byWaves() || !rules.bands.empty());
  const SizeRule asked{SizeRule::Kind::Depths, rules, 0.0, 0.0};
  const SizeRule step{SizeRule::Kind::Step, rules, options.time_step_s, kShortestOfSize * options.courant};
  // Squares at the edges of gaps need not be smaller than the smallest size; if that is unknown, this share of the root
  // limits them.
  constexpr double kFinest = 1e-4;
  double least_m = others_least_m, deepest_m = rules.least_depth_m;
  for (const DepthBand& band : rules.bands) {
    least_m = std::min(least_m, band.size_m);
    deepest_m = std::max(deepest_m, std::isfinite(band.to_m) ? band.to_m : band.from_m);
  }
  least_m = std::max(
      {std::isfinite(least_m) ? least_m : 0.0, options.least_m, kFinest * 2.0 * root.half / scale(root.centre)});
  // The rule from whose sizes depths are computed. Without a time step, one whose sizes are about as large as elements:
  // for the wave, or for the bands.
  const double long_step_s = rules.crossing_s > 0.0      ? rules.crossing_s
                             : rules.wave_elements > 0.0 ? rules.period_s / rules.wave_elements
                                                         : least_m / longWaveSpeed(deepest_m);
  const SizeRule telling = has_step ? step : SizeRule{SizeRule::Kind::Step, rules, long_step_s, 1.0};
  // Depths are read once for all rules.
  std::vector<SizeRule> of_depths;
  if (rules.any()) of_depths.push_back(asked);
  if (has_step) of_depths.push_back(step);
  // With bands alone, an infinite size may mean a depth outside them.
  const bool by_parts = fills && !has_step && !rules.byWaves();
  if (by_parts) of_depths.push_back(telling);
  if (of_depths.empty()) return sizes;
  const auto read = [&](const std::vector<SizeRule>& which) {
    return rasterFields(inputs.bathymetry, inputs, domain.projection, square, which, loop);
  };
  std::vector<std::unique_ptr<SizeField>> fields = read(of_depths);
  std::shared_ptr<DepthGaps> gaps;
  if (fills) gaps = std::make_shared<DepthGaps>(*fields.back(), mask, root, least_m, scale, loop);
  if (gaps && gaps->any()) {
    std::unique_ptr<SizeField> again;
    if (!has_step && !by_parts) again = std::move(read({telling}).front());
    const SizeField& known = again ? *again : *fields.back();
    gaps->fill(
        known, mask, [&](double size_m) { return depthOfStep(size_m, telling.time_step_s, telling.courant); },
        options.gaps, loop);
    sizes.filled = {gaps->area(), domain.projection.inverse(gaps->place())};
    for (std::size_t f = 0; f < of_depths.size(); ++f)
      fields[f] = std::make_unique<FilledField>(std::move(fields[f]), gaps, of_depths[f]);
  }
  if (rules.any()) sizes.asked = std::move(fields.front());
  if (has_step) sizes.step = std::move(fields.back());
  return sizes;
}

// The place with the smallest size in the cell that requires the most vertices.
VertexDemand demandOf(const ComposedSizes& source, const SizeDemand& demand, const Projection& projection) {
  constexpr int kProbes = 8;
  const SizeBox& box = demand.most_in;
  std::vector<Point> places = probesOf(box, kProbes, [&](const SizeBox& part) { return source.isWanted(part); });
  if (places.empty()) places.push_back(box.centre);
  std::vector<double> sizes(places.size());
  source.sample(places, sizes);
  const Point& place = places[static_cast<std::size_t>(std::ranges::min_element(sizes) - sizes.begin())];
  return {demand.vertices, projection.inverse(place),
          std::min(std::ranges::min(sizes), demand.size) / projection.measureAt(place), source.optionAt(place)};
}

// The shore as in `shoreLines`, and the coast between the domain's water and a flood plain.
std::vector<SizedLine> shoreAndCoast(const Pslg& shore, const Domain& domain, double size_m, double rate) {
  std::vector<SizedLine> lines = shoreLines(shore, size_m, rate);
  for (const auto& [a, b] : domain.coast) lines.push_back({a, b, size_m, rate});
  if (domain.lines.empty()) return lines;
  for (const Segment& s : shore.segments)
    if (isLineTag(s.tag) && domain.lines[lineOfTag(s.tag)].use == FeatureUse::Area)
      lines.push_back({shore.points[s.a], shore.points[s.b], size_m, rate});
  return lines;
}

bool isByShoreAlone(const SizeOptions& options, const SizeInputs& inputs) {
  return options.shore_m < kInfinity && options.channel_elements == 0.0 && inputs.layers->features.empty() &&
         inputs.rasters.empty() && !options.depth.any() && !(options.time_step_s > 0.0);
}

// Returns no function if there is no shore, if it alone may require more vertices than there is room for, or if changes
// of the scale matter beside the gradation: these cases need a map.
DomainSizes sizesByShore(const SizeOptions& options, const Pslg& shore, const Domain& domain,
                         const std::shared_ptr<const ScaleTable>& scales, const SizeBox& square, double most_vertices) {
  constexpr double kHardly = 0.05, kJustBelow = 0.99;
  const double rate = std::min(options.shore_rate, kJustBelow * options.gradation);
  std::vector<SizedLine> lines = shoreAndCoast(shore, domain, options.shore_m, rate);
  double length_m = 0.0;
  for (const SizedLine& line : lines) length_m += distance(line.a, line.b) / scales->at(midpoint(line.a, line.b));
  const double reach_m = 2.0 * square.half / scales->at(square.centre);
  const double most_m = std::min({options.most_m, options.size_m, options.shore_m + 2.0 * rate * reach_m});
  // Vertices beside the shore: its length times the integral of 2 / (sqrt(3) h²) over the distance from it.
  const double at_shore = std::clamp(options.shore_m, options.least_m, most_m);
  const double vertices = 2.0 / std::sqrt(3.0) * length_m / at_shore / std::max(rate, at_shore / reach_m);
  if (lines.empty() || !(vertices <= most_vertices) ||
      steepestMeasure(*scales, square) * most_m > kHardly * options.gradation)
    return {};
  auto field = std::make_unique<DistanceField>(
      std::move(lines), [scales](const Point& x) { return scales->at(x); }, most_m);
  const Point corner{square.half, square.half};
  return {std::make_unique<SizesByDistance>(std::move(field), std::min(options.least_m, most_m), most_m, scales,
                                            Box::of(square.centre - corner, square.centre + corner)),
          {},
          rate,
          at_shore,
          {}};
}

RaisedShore raisedShore(const std::vector<SizedLine>& shore, const SizeField& floor, double least_m,
                        const std::function<double(const Point&)>& scale) {
  constexpr std::size_t kMostSamples = 2000;
  constexpr double kMore = 1.1;  // less is not reported
  const std::size_t step = std::max<std::size_t>(1, shore.size() / kMostSamples);
  std::vector<Point> places;
  for (std::size_t i = 0; i < shore.size(); i += step) places.push_back(midpoint(shore[i].a, shore[i].b));
  std::vector<double> floors(places.size());
  floor.sample(places, floors);
  RaisedShore raised;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const SizedLine& line = shore[k * step];
    const double length_m = static_cast<double>(step) * distance(line.a, line.b) / scale(places[k]);
    raised.length_m += length_m;
    if (!(floors[k] > kMore * std::max(line.size_m, least_m))) continue;
    raised.raised_m += length_m;
    raised.most_m = std::max(raised.most_m, floors[k]);
  }
  return raised;
}

Pslg boundaryOf(const Box& box) {
  Pslg pslg;
  pslg.points = {{box.xmin, box.ymin}, {box.xmax, box.ymin}, {box.xmax, box.ymax}, {box.xmin, box.ymax}};
  for (VertexId i = 0; i < 4; ++i) pslg.segments.push_back({i, (i + 1) % 4, 0, 0, kOutside});
  return pslg;
}

// A domain in its plane: where it lies, and the scale there.
struct PlaneOfDomain {
  const Domain& domain;
  Box box;
  double extent;
  Point middle;
  SizeBox root;  // the tree's square
  Box square;    // around it
  std::shared_ptr<const ScaleTable> table;
  std::function<double(const Point&)> scale, measure;
  double reach;  // at least the extent on the surface

  explicit PlaneOfDomain(const Domain& whole) : domain(whole) {
    for (const Point& p : domain.pslg.points) box.add(p);
    extent = std::max(box.xmax - box.xmin, box.ymax - box.ymin);
    middle = {0.5 * (box.xmin + box.xmax), 0.5 * (box.ymin + box.ymax)};
    root = {middle, 0.505 * extent};
    square = Box::of(middle, middle).grownBy(0.51 * extent);
    table = std::make_shared<ScaleTable>(domain.projection, square);
    scale = [table = table](const Point& x) { return table->at(x); };
    measure = [table = table](const Point& x) { return table->measureAt(x); };
    reach = reachOn(table->surface(), extent, root);
  }
  double reachM() const { return reach / measure(middle); }
};

// Where nothing is requested.
double largestSize(const SizeOptions& options) { return std::min(options.most_m, options.size_m); }

void addChannels(ComposedSizes& source, const SizeOptions& options, const Pslg& shore, const PlaneOfDomain& plane,
                 double most_vertices) {
  const double most_m = largestSize(options);
  const Surface& surface = plane.table->surface();
  // The time step may require larger sizes than channels request: then only the number of lines is limited.
  ChannelLines channels = channelLines(shore, options.channel_elements, options.gradation, options.least_m,
                                       std::min(most_m, plane.reachM()), plane.scale,
                                       {options.time_step_s > 0.0 ? kInfinity : most_vertices, most_vertices}, surface);
  if (!channels.complete) {
    const SizedLine& last = channels.lines.back();
    throw TooManyVertices({channels.vertices, plane.domain.projection.inverse(last.a), last.size_m,
                           "--channel-elements", !(channels.vertices > most_vertices)});
  }
  source.add("--channel-elements",
             std::make_unique<DistanceField>(std::move(channels.lines), plane.scale, most_m, surface));
}

void addFeatures(ComposedSizes& source, const SizeOptions& options, const SizeInputs& inputs,
                 const PlaneOfDomain& plane) {
  if (inputs.layers->features.empty()) return;
  // The gradation is lowered to half at most, see `gradationForScale`, and slightly less.
  FeatureScope scope{{}, largestSize(options), 0.49 * options.gradation};
  if (!plane.table->surface().isCurved()) scope.ball = GroundBalls(inputs.crs).around(plane.domain.input_points);
  for (const SizedFeatures& features : inputs.layers->features)
    for (auto& field : featureFields(features, plane.domain.projection, plane.scale, scope))
      source.add("--size-features", std::move(field));
}

// What the time step allows, from the depths that are known; its effects are noted in `sizes`.
void addFloor(ComposedSizes& source, std::unique_ptr<SizeField> step, const SizeOptions& options,
              const PlaneOfDomain& plane, const std::vector<SizedLine>& sized_shore, const DomainMask& mask,
              DomainSizes& sizes, const ItemLoop& loop) {
  const Surface& surface = plane.table->surface();
  auto floor = std::make_unique<SizeFloor>(std::move(step), options.gradation, source.leastWanted() / kShoreFloor,
                                           plane.scale, plane.root, mask, loop, surface);
  if (options.coast == CoastDetail::Follow)
    floor->raiseNear(
        std::make_unique<DistanceField>(shoreAndCoast(plane.domain.pslg, plane.domain, 0.0, options.gradation),
                                        plane.scale, kInfinity, surface),
        kShoreFloor);
  sizes.raised = raisedShore(sized_shore, *floor, options.least_m, plane.scale);
  sizes.floor_m = largestOf(*floor, mask, plane.root);
  source.setFloor(std::move(floor));
}

// What the rim changes, from what is requested without it.
RimReach reachOfRim(const ComposedSizes& source, const std::vector<SizedLine>& rim, const SizeField& least,
                    const SizeField& most, const SizeOptions& options, const PlaneOfDomain& plane) {
  constexpr std::size_t kMostSamples = 2000;
  constexpr int kProbes = 128;
  constexpr double kSame = 1.1;
  const auto requestedAt = [&](const std::vector<Point>& places) {
    std::vector<double> sizes(places.size());
    source.sample(places, sizes);
    for (std::size_t i = 0; i < places.size(); ++i) sizes[i] /= plane.measure(places[i]);
    return sizes;
  };
  RimReach reach;
  const std::size_t step = std::max<std::size_t>(1, rim.size() / kMostSamples);
  std::vector<Point> places;
  for (std::size_t i = 0; i < rim.size(); i += step) places.push_back(midpoint(rim[i].a, rim[i].b));
  const std::vector<double> at_rim = requestedAt(places);
  for (std::size_t k = 0; k < places.size(); ++k)
    if (at_rim[k] < kInfinity)
      reach.width_m = std::max(reach.width_m, std::abs(at_rim[k] - rim[k * step].size_m) / options.gradation);
  places = probesOf(plane.root, kProbes, [&](const SizeBox& box) { return source.isWanted(box); });
  const std::vector<double> requested = requestedAt(places);
  std::vector<double> low(places.size()), high(places.size());
  least.sample(places, low);
  most.sample(places, high);
  std::size_t changed = 0;
  for (std::size_t k = 0; k < places.size(); ++k)
    if (low[k] > kSame * requested[k] || kSame * high[k] < requested[k]) ++changed;
  if (!places.empty()) reach.share = static_cast<double>(changed) / static_cast<double>(places.size());
  return reach;
}

// Sizes that join those of the elements beside the rim.
RimReach addRim(ComposedSizes& source, const std::vector<SizedLine>& rim, const SizeOptions& options,
                const PlaneOfDomain& plane) {
  const Surface& surface = plane.table->surface();
  std::vector<SizedLine> lines = rim;
  double longest = 0.0;
  for (SizedLine& line : lines) {
    line.rate = options.gradation;
    longest = std::max(longest, line.size_m);
  }
  auto least = std::make_unique<FallingField>(lines, plane.scale, surface);
  auto most =
      std::make_unique<DistanceField>(std::move(lines), plane.scale, std::max(largestSize(options), longest), surface);
  const RimReach reach = reachOfRim(source, rim, *least, *most, options, plane);
  source.setRim(std::move(least), std::move(most));
  return reach;
}

// The gradation to be reserved for changes of the scale: at most half of it. For elements as large as seas, sizes are
// limited so that half is left.
double gradationForScale(ComposedSizes& source, const SizeOptions& options, const PlaneOfDomain& plane) {
  const double needed = gradationForMeasure(source, *plane.table, plane.root, plane.reachM());
  const double half = 0.5 * options.gradation;
  if (!(needed > half)) return needed;
  const double most_m = half / needed * plane.reachM();
  if (most_m < options.least_m) {
    throw InputError(
        "--grade: too small for sizes of --size-min on a projection whose scale varies so much; give a larger one");
  }
  source.limitSize(most_m);
  return half;
}

SizeTreeOptions treeOptions(const SizeOptions& options, SizeAccuracy accuracy, double most_vertices) {
  SizeTreeOptions tree;
  // Sizes that only grow with distance usually have smaller errors, because their kinks are only where two lines are
  // equally near.
  constexpr double kRough = 0.1, kRoughOfLines = 0.2, kFineOfLines = 0.1;
  tree.tolerance_graded = accuracy == SizeAccuracy::Rough ? kRoughOfLines : kFineOfLines;
  if (accuracy == SizeAccuracy::Rough) tree.tolerance = kRough;
  // Across a cell as small as `finest_graded`, graded sizes vary by about this share.
  constexpr double kNothing = 0.1;
  tree.finest_graded = std::clamp(kNothing / options.gradation, tree.finest, 1.0);
  tree.most_vertices = most_vertices;
  tree.most_cells =
      static_cast<std::uint32_t>(std::min<double>(tree.most_cells, kLeastCells + kCellsPerVertex * most_vertices));
  return tree;
}

// Throws InputError if sizes are so small that coordinates do not resolve good triangles. The limit is relative to the
// extent: far out in the plane of a sphere coordinates are coarser, but triangles are larger too.
void requireResolved(const SizeTree& size, const PlaneOfDomain& plane) {
  constexpr double kLeastSize = 1e-9;
  if (!(size.least() < kLeastSize * plane.reach)) return;
  char text[200];
  std::snprintf(text, sizeof text,
                "sizes come down to %.3g m, too little for coordinates over an extent of %.3g m: give a --size-min",
                size.least() / plane.measure(plane.middle), plane.reachM());
  throw InputError(text);
}

}  // namespace

TooManyVertices::TooManyVertices(VertexDemand d)
    : std::runtime_error("sizes require more vertices than there is room for"), demand(std::move(d)) {}

SizeLayers readSizeLayers(const SizeOptions& options, const Crs& crs) {
  SizeLayers layers;
  for (const std::string& path : options.features)
    layers.features.push_back(readSizedFeatures(path, crs, options.gradation));
  const auto readLines = [&](const std::vector<std::string>& paths, std::vector<ShoreLine>& lines) {
    for (std::size_t file = 0; file < paths.size(); ++file) {
      for (ShoreLine& line : readGuideLines(paths[file], crs)) {
        line.file = file;
        lines.push_back(std::move(line));
      }
    }
  };
  readLines(options.passages, layers.passages);
  for (ShoreLine& line : layers.passages) line.elements = options.passage_elements;
  readLines(options.barriers, layers.barriers);
  return layers;
}

SizeInputs readSizeInputs(const SizeOptions& options, const Crs& crs, std::shared_ptr<const SizeLayers> layers) {
  SizeInputs inputs;
  inputs.crs = crs;
  inputs.layers = layers ? std::move(layers) : std::make_shared<const SizeLayers>(readSizeLayers(options, crs));
  for (const std::string& path : options.rasters) inputs.rasters.push_back(readRasterGeometry(path));
  if (options.depth.any() || options.time_step_s > 0.0)
    for (const std::string& path : options.bathymetry) inputs.bathymetry.push_back(readRasterGeometry(path));
  return inputs;
}

double leastWanted(const SizeOptions& options, const SizeInputs& inputs) {
  const bool known = options.channel_elements == 0.0 && inputs.layers->features.empty() && inputs.rasters.empty() &&
                     !options.depth.any();
  const double least = known ? std::min(options.size_m, options.shore_m) : 0.0;
  return std::min(std::max(least, options.least_m), options.most_m);
}

DomainSizes makeSizeFunction(const SizeOptions& options, const SizeInputs& inputs, const Domain& domain,
                             double most_vertices, const ItemLoop& loop, SizeAccuracy accuracy) {
  const PlaneOfDomain plane(domain);
  const Surface& surface = plane.table->surface();
  std::optional<Pslg> opened;
  if (inputs.shoreOf && (options.shore_m < kInfinity || options.channel_elements > 0.0))
    opened = inputs.shoreOf(domain, options, loop);
  const Pslg& shore = opened ? *opened : domain.pslg;
  if (accuracy == SizeAccuracy::Rough && isByShoreAlone(options, inputs) && !surface.isCurved()) {
    DomainSizes sizes = sizesByShore(options, shore, domain, plane.table, plane.root, most_vertices);
    if (sizes.function) return sizes;
  }

  DomainSizes sizes;
  const DomainMask mask(domain.closed() ? boundaryOf(plane.box) : domain.pslg, plane.root, surface);
  ComposedSizes source({options.size_m, options.least_m, options.most_m}, plane.measure, mask, loop);
  std::vector<SizedLine> sized_shore;  // that the time step may raise
  if (options.shore_m < kInfinity) {
    std::vector<SizedLine> lines = shoreAndCoast(shore, domain, options.shore_m, options.shore_rate);
    sizes.has_shore = !lines.empty();
    if (options.time_step_s > 0.0) sized_shore = lines;
    source.add("--size-shore",
               std::make_unique<DistanceField>(std::move(lines), plane.scale, largestSize(options), surface));
  }
  if (options.channel_elements > 0.0) addChannels(source, options, shore, plane, most_vertices);
  addFeatures(source, options, inputs, plane);
  if (!inputs.rasters.empty())
    source.add(
        "--size-raster",
        std::move(rasterFields(inputs.rasters, inputs, domain.projection, plane.square, {SizeRule{}}, loop).front()));
  DepthSizes depths =
      sizesOfDepths(options, inputs, domain, plane.square, plane.root, mask, source.leastWanted(), plane.scale, loop);
  sizes.filled = depths.filled;
  if (depths.asked) source.add(askingOfDepths(options.depth), std::move(depths.asked));
  if (depths.step) addFloor(source, std::move(depths.step), options, plane, sized_shore, mask, sizes, loop);
  if (!inputs.rim.empty()) sizes.rim = addRim(source, inputs.rim, options, plane);

  source.limitRate(options.gradation);
  const double for_scale = gradationForScale(source, options, plane);
  SizeTreeOptions tree = treeOptions(options, accuracy, most_vertices);
  tree.surface = surface;
  tree.gradation = options.gradation - for_scale;
  // Slightly less: sizes that are just too steep everywhere would have to be graded everywhere.
  constexpr double kJustBelow = 0.99;
  source.limitRate(kJustBelow * tree.gradation);
  const Box& box = plane.box;
  auto size = std::make_unique<SizeTree>(Point{box.xmin, box.ymin}, Point{box.xmax, box.ymax}, source, tree, loop);
  sizes.demand = demandOf(source, size->demand(), domain.projection);
  sizes.demand.map_too_large = !size->isComplete() && !(sizes.demand.vertices > most_vertices);
  if (!size->isComplete()) throw TooManyVertices(std::move(sizes.demand));
  requireResolved(*size, plane);
  sizes.function = std::move(size);
  return sizes;
}

}  // namespace coastmesh
