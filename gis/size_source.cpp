#include "gis/size_source.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/metric.hpp"
#include "gis/domain_mask.hpp"
#include "gis/error.hpp"
#include "gis/plane_table.hpp"
#include "gis/size_channel.hpp"
#include "gis/size_distance.hpp"
#include "gis/size_raster.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Several fields as one source in plane units.
class ComposedSizes final : public SizeSource {
 public:
  ComposedSizes(const SizeOptions& options, std::function<double(const Point&)> scale, const DomainMask& mask,
                const ItemLoop& loop)
      : options_(options), scale_(std::move(scale)), mask_(mask), loop_(loop) {}

  void add(std::unique_ptr<SizeField> field) { fields_.push_back(std::move(field)); }
  void setFloor(std::unique_ptr<SizeField> field) { floor_ = std::move(field); }

  void sample(std::span<const Point> places, std::span<double> sizes) const override {
    forStretches(loop_, places.size(), [&](std::size_t first, std::size_t last) {
      const auto here = places.subspan(first, last - first);
      const auto out = sizes.subspan(first, last - first);
      std::vector<double> own(here.size());
      std::ranges::fill(out, options_.size_m);
      std::vector<Point> asked;
      std::vector<std::size_t> which;
      for (const auto& field : fields_) {
        asked.clear();
        which.clear();
        for (std::size_t i = 0; i < out.size(); ++i) {
          if (!(out[i] > field->least())) continue;
          asked.push_back(here[i]);
          which.push_back(i);
        }
        field->sample(asked, std::span(own).first(asked.size()));
        for (std::size_t k = 0; k < which.size(); ++k) out[which[k]] = std::min(out[which[k]], own[k]);
      }
      std::ranges::fill(own, 0.0);
      if (floor_) floor_->sample(here, own);
      for (std::size_t i = 0; i < out.size(); ++i) out[i] = bounded(out[i], own[i]) * scale_(here[i]);
    });
  }

  void limitSize(double most_m) { most_m_ = most_m; }
  void limitRate(double rate) {
    for (const auto& field : fields_) field->limitRate(rate);
  }
  bool isWanted(const SizeBox& box) const override { return mask_.meets(box); }

  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override {
    forStretches(loop_, boxes.size(), [&](std::size_t first, std::size_t last) {
      const auto here = boxes.subspan(first, last - first);
      const auto out = ranges.subspan(first, last - first);
      std::vector<SizeRange> own(here.size());
      std::ranges::fill(out, SizeRange{options_.size_m, options_.size_m});
      std::vector<SizeBox> asked;
      std::vector<std::size_t> which;
      for (const auto& field : fields_) {
        asked.clear();
        which.clear();
        for (std::size_t i = 0; i < out.size(); ++i) {
          if (!(out[i].high > field->least())) continue;
          asked.push_back(here[i]);
          which.push_back(i);
        }
        field->bound(asked, std::span(own).first(asked.size()));
        for (std::size_t k = 0; k < which.size(); ++k) {
          SizeRange& range = out[which[k]];
          range = {std::min(range.low, own[k].low), std::min(range.high, own[k].high)};
        }
      }
      std::ranges::fill(own, SizeRange{kInfinity, kInfinity});
      if (floor_) floor_->bound(here, own);
      for (std::size_t i = 0; i < out.size(); ++i) {
        const double scale = scale_(here[i].centre);
        // Where the depth is not known there is no floor; where it is known in a part of the box only, there may be any.
        const bool none = own[i].low == kInfinity, part = !none && own[i].high == kInfinity;
        out[i] = {bounded(out[i].low, none || part ? 0.0 : own[i].low) * scale,
                  (part ? options_.most_m : bounded(out[i].high, none ? 0.0 : own[i].high)) * scale};
      }
    });
  }

 private:
  double bounded(double size, double floor) const {
    return std::min({std::max({size, options_.least_m, std::isfinite(floor) ? floor : 0.0}), options_.most_m, most_m_});
  }

  const SizeOptions& options_;
  double most_m_ = kInfinity;
  std::function<double(const Point&)> scale_;
  const DomainMask& mask_;
  const ItemLoop& loop_;
  std::vector<std::unique_ptr<SizeField>> fields_;
  std::unique_ptr<SizeField> floor_;  // what the time step allows
};

TileRule rawRule() {
  return {
      0.0, [](const RasterTile& tile, std::span<float> sizes) {
        for (int y = 0; y < tile.height; ++y) {
          for (int x = 0; x < tile.width; ++x) {
            const float size = tile.at(x, y);
            if (std::isnan(size)) continue;
            if (!(size > 0.0F)) {
              throw InputError(tile.file + ": holds the size " + std::to_string(size) +
                               ", but sizes are lengths in metres, above 0; mark pixels without one as no data");
            }
            sizes[static_cast<std::size_t>(y) * static_cast<std::size_t>(tile.width) + static_cast<std::size_t>(x)] =
                size;
          }
        }
      }};
}

std::unique_ptr<SizeField> rasterFields(const std::vector<RasterGeometry>& rasters, const Crs& input,
                                        const Projection& projection, const Box& box, const TileRule& rule,
                                        const ItemLoop& loop) {
  std::vector<std::unique_ptr<SizeField>> fields;
  for (const RasterGeometry& raster : rasters)
    fields.push_back(std::make_unique<RasterField>(raster, input, projection, box, rule, loop));
  if (fields.size() == 1) return std::move(fields.front());
  return std::make_unique<FirstOfFields>(std::move(fields));
}

// The tree grades lengths of the plane; what is asked for is that lengths on the ground are graded. The gradient of a length h on the
// ground is that of the plane's length k h, less h times the gradient of the scale k: at most so much. Infinite h counts as `most_m`.
double gradeForScale(const ComposedSizes& source, const std::function<double(const Point&)>& scale,
                     const SizeBox& square, double most_m) {
  constexpr int kProbes = 64;
  const double step = 2.0 * square.half / kProbes;
  std::vector<Point> places;
  for (int j = 0; j < kProbes; ++j) {
    for (int i = 0; i < kProbes; ++i) {
      const Point place = square.centre + Point{(i + 0.5) * step - square.half, (j + 0.5) * step - square.half};
      if (source.isWanted({place, 0.5 * step})) places.push_back(place);
    }
  }
  std::vector<double> lengths(places.size());
  source.sample(places, lengths);
  double most = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Point x{0.5 * step, 0.0}, y{0.0, 0.5 * step};
    const double k = scale(places[i]), h = std::min(lengths[i] / k, most_m);
    const double slope =
        std::hypot(scale(places[i] + x) - scale(places[i] - x), scale(places[i] + y) - scale(places[i] - y));
    if (std::isfinite(slope)) most = std::max(most, h * slope / step);
  }
  constexpr double kBetweenProbes = 1.25;
  return kBetweenProbes * most;
}

}  // namespace

SizeInputs readSizeInputs(const SizeOptions& options, const Crs& crs) {
  SizeInputs inputs;
  inputs.crs = crs;
  for (const std::string& path : options.features)
    inputs.features.push_back(readSizedFeatures(path, crs, options.grade));
  for (const std::string& path : options.rasters) inputs.rasters.push_back(readRasterGeometry(path));
  if (options.depth.any() || options.time_step_s > 0.0)
    for (const std::string& path : options.bathymetry) inputs.bathymetry.push_back(readRasterGeometry(path));
  return inputs;
}

std::unique_ptr<SizeFunction> makeSizeFunction(const SizeOptions& options, const SizeInputs& inputs,
                                               const Domain& domain, const ItemLoop& loop) {
  Box box;
  for (const Point& p : domain.pslg.points) box.add(p);
  const double extent = std::max(box.xmax - box.xmin, box.ymax - box.ymin);
  // Around the tree's square, which is larger than the domain's box.
  const Point middle{0.5 * (box.xmin + box.xmax), 0.5 * (box.ymin + box.ymax)};
  const Box square = Box::of(middle, middle).grownBy(0.51 * extent);
  const Projection& projection = domain.projection;
  constexpr double kScaleTolerance = 1e-5;
  const auto table = std::make_shared<PlaneTable>(
      [projection](const Point& x) {
        return Point{projection.scaleAt(x), 0.0};
      },
      square, kScaleTolerance);
  const auto scale = [table](const Point& x) { return table->at(x).x; };

  const SizeBox root{middle, 0.505 * extent};
  const DomainMask mask(domain.pslg, root);
  ComposedSizes source(options, scale, mask, loop);
  const double reach_m = extent / scale(middle), most_m = std::min(options.most_m, options.size_m);
  if (options.shore_m < kInfinity)
    source.add(
        std::make_unique<DistanceField>(shoreLines(domain.pslg, options.shore_m, options.shore_rate), scale, most_m));
  if (options.channel_elements > 0.0) {
    source.add(std::make_unique<DistanceField>(channelLines(domain.pslg, options.channel_elements, options.grade,
                                                            options.least_m, std::min(most_m, reach_m), scale),
                                               scale, most_m));
  }
  for (const SizedFeatures& features : inputs.features)
    for (auto& field : featureFields(features, projection, scale)) source.add(std::move(field));
  if (!inputs.rasters.empty())
    source.add(rasterFields(inputs.rasters, inputs.crs, projection, square, rawRule(), loop));
  if (options.depth.any())
    source.add(rasterFields(inputs.bathymetry, inputs.crs, projection, square, depthRule(options.depth), loop));
  if (options.time_step_s > 0.0) {
    source.setFloor(rasterFields(inputs.bathymetry, inputs.crs, projection, square,
                                 courantRule(options.time_step_s, options.courant, options.depth), loop));
  }
  source.limitRate(options.grade);
  double for_scale = gradeForScale(source, scale, root, reach_m);
  if (for_scale > 0.5 * options.grade) {  // elements as large as seas: no larger than leaves half of the grade
    source.limitSize(0.5 * options.grade / for_scale * reach_m);
    for_scale = 0.5 * options.grade;
  }
  SizeTreeOptions tree;
  tree.grade = options.grade - for_scale;
  // A little less: what is only just too steep everywhere would have to be flattened everywhere.
  constexpr double kJustBelow = 0.99;
  source.limitRate(kJustBelow * tree.grade);
  auto size = std::make_unique<SizeTree>(Point{box.xmin, box.ymin}, Point{box.xmax, box.ymax}, source, tree, loop);
  if (!size->isComplete()) {
    throw InputError(
        "the sizes asked for are so small that there is no room even for a map of them: give a larger --size-min");
  }
  return size;
}

}  // namespace coastmesh
