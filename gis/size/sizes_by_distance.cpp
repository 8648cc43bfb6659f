#include "gis/size/sizes_by_distance.hpp"

#include <algorithm>
#include <utility>

namespace coastmesh {

SizesByDistance::SizesByDistance(std::unique_ptr<DistanceField> field, double least_m, double most_m,
                                 std::shared_ptr<const ScaleTable> scales, const Box& box)
    : field_(std::move(field)), least_m_(least_m), most_m_(most_m), scales_(std::move(scales)) {
  constexpr int kProbes = 16;
  constexpr double kBetweenProbes = 1.05;
  double least = scales_->at({box.xmin, box.ymin}), most = least;
  for (int j = 0; j <= kProbes; ++j) {
    for (int i = 0; i <= kProbes; ++i) {
      const double scale =
          scales_->at({box.xmin + (box.xmax - box.xmin) * i / kProbes, box.ymin + (box.ymax - box.ymin) * j / kProbes});
      least = std::min(least, scale), most = std::max(most, scale);
    }
  }
  least_ = std::clamp(field_->least(), least_m_, most_m_) * least / kBetweenProbes;
  most_ = most_m_ * most * kBetweenProbes;
}

double SizesByDistance::at(const Point& x) const {
  double size = 0.0;
  sample(std::span(&x, 1), std::span(&size, 1));
  return size;
}

void SizesByDistance::sample(std::span<const Point> places, std::span<double> sizes) const {
  field_->sample(places, sizes);
  for (std::size_t i = 0; i < places.size(); ++i)
    sizes[i] = std::clamp(std::clamp(sizes[i], least_m_, most_m_) * scales_->at(places[i]), least_, most_);
}

}  // namespace coastmesh
