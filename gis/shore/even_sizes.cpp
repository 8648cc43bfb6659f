#include "gis/shore/even_sizes.hpp"

namespace coastmesh {

std::vector<double> sizesAt(std::span<const Point> places, std::span<const char> on_shore, const SizeFunction& size,
                            const EvenSizes* even, const ItemLoop& loop) {
  std::vector<double> sizes(places.size());
  forStretches(loop, places.size(), [&](std::size_t first, std::size_t last) {
    if (even == nullptr) {
      size.sample(places.subspan(first, last - first), std::span(sizes).subspan(first, last - first));
      return;
    }
    for (std::size_t i = first; i < last; ++i)
      sizes[i] = on_shore[i] != 0 ? even->on_shore.at(places[i]) : size.at(places[i]);
  });
  return sizes;
}

}  // namespace coastmesh
