#include "core/size/size_vertices.hpp"

#include <utility>
#include <vector>

#include "core/large_list.hpp"

namespace coastmesh {

void sampleNew(SizeVertices& vertices, const SizeCells& cells, const SizeTreeTask& task) {
  const ItemLoop& loop = task.loop;
  std::vector<double>& own = vertices.sizes.own;
  const std::size_t count = vertices.places.size(), known = std::exchange(vertices.sampled, count);
  resizeOn(loop, own, count, kUnasked);
  const std::vector<std::uint32_t> asked =
      numbersWith(loop, known, count, [&](std::uint32_t v) { return own[v] == kUnasked; });
  std::vector<Point> places;
  resizeAnew(loop, places, asked.size());
  forEachByStretches(loop, asked.size(), [&](std::size_t k) { places[k] = cells.placeOf(vertices.places[asked[k]]); });
  BulkList<double> sizes = unsetList<double>(places.size());
  task.source.sample(places, sizes);
  forEachByStretches(loop, asked.size(), [&](std::size_t k) { own[asked[k]] = sizes[k]; });
}

}  // namespace coastmesh
