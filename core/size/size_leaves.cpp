#include "core/size/size_leaves.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/large_list.hpp"
#include "core/size/size_subtrees.hpp"

namespace coastmesh {

namespace {

// Spare room for the vertices that grading adds: one for every kSpare present.
constexpr std::size_t kSpare = 32;

// The middle of a side is a vertex if smaller leaves meet it, or if the leaf on the other side is as large and the size
// there is known.
void findMiddles(LeafVertices& leaf, std::uint32_t c, const SizeCells& cells, const SizePlaces& places) {
  for (unsigned side = 0; side < SizeCells::kSides; ++side) {
    const unsigned i = kMiddles[side];
    const std::uint32_t other = cells.beside(c, side);
    const bool is_larger = other != kNone && cells.level(other) < cells.level(c);
    leaf[i] = is_larger ? kNone : places.find(cells.vertexOf(c, i));
  }
}

// The numbers of vertices as leaves use them; unused ones come last.
std::vector<std::uint32_t> orderOfUse(const std::vector<LeafVertices>& leaves, std::size_t count,
                                      const ItemLoop& loop) {
  // The first use of each vertex, as 9 times the leaf plus the index in it.
  BulkList<std::uint32_t> first_use = noNumbers(loop, count);
  const auto useOf = [](std::size_t l, std::size_t i) { return static_cast<std::uint32_t>(9 * l + i); };
  forEachByStretches(loop, leaves.size(), [&](std::size_t l) {
    for (std::size_t i = 0; i < 9; ++i)
      if (leaves[l][i] != kNone) lowerTo(first_use[leaves[l][i]], useOf(l, i));
  });
  auto order = listOver<std::uint32_t>(loop, leaves.size(), [&](std::size_t l, std::vector<std::uint32_t>& list) {
    for (std::size_t i = 0; i < 9; ++i) {
      const std::uint32_t v = leaves[l][i];
      if (v != kNone && first_use[v] == useOf(l, i)) list.push_back(v);
    }
  });
  std::ranges::copy(numbersWith(loop, 0, count, [&](std::uint32_t v) { return first_use[v] == kNone; }),
                    std::back_inserter(order));
  return order;
}

// Renumbers vertices as leaves use them.
void putInOrder(SizeVertices& vertices, std::vector<LeafVertices>& leaves, const ItemLoop& loop) {
  const std::size_t count = vertices.places.size();
  const std::vector<std::uint32_t> order = orderOfUse(leaves, count, loop);
  BulkList<std::uint32_t> numbers = unsetList<std::uint32_t>(count);
  forEachByStretches(loop, count, [&](std::size_t v) { numbers[order[v]] = static_cast<std::uint32_t>(v); });
  forEachByStretches(loop, leaves.size(), [&](std::size_t l) {
    for (std::uint32_t& v : leaves[l])
      if (v != kNone) v = numbers[v];
  });
  vertices.places.reorder(loop, order, numbers);
  std::vector<double> own;
  reserveOn(loop, own, count, count / kSpare);
  own.resize(count);
  forEachByStretches(loop, count, [&](std::size_t v) { own[v] = vertices.sizes.own[order[v]]; });
  vertices.sizes.own = std::move(own);
}

// At first every size is the source's.
void beginGradedSizes(GradedSizes& sizes, const ItemLoop& loop) {
  const std::size_t count = sizes.own.size(), spare = sizes.own.capacity() - count;
  reserveOn(loop, sizes.size, count, spare);
  sizes.size = sizes.own;
  reserveOn(loop, sizes.source, count, spare);
  sizes.source.assign(count, kNone);
}

}  // namespace

SizeLeaves numberLeaves(SizeCells& cells, SizeVertices& vertices, std::vector<OwnVertices>&& own_vertices,
                        const SizeTreeTask& task) {
  constexpr std::size_t kEach = kOwnVertices.size();
  const ItemLoop& loop = task.loop;
  cells.leaf_cells = leavesDepthFirst(cells.cells, loop);
  const std::size_t count = cells.leaf_cells.size();
  BulkList<std::uint32_t> own = unsetList<std::uint32_t>(kEach * count);
  forEachByStretches(loop, count, [&](std::size_t l) {
    const std::uint32_t c = cells.leaf_cells[l];
    cells.cells[c].below = static_cast<std::uint32_t>(l);
    std::ranges::copy(c < own_vertices.size() ? own_vertices[c] : kNoVertices, &own[kEach * l]);
  });
  freeMemoryOf(own_vertices);
  vertices.places.addAll(
      loop, [&](std::size_t i) { return cells.vertexOf(cells.leaf_cells[i / kEach], kOwnVertices[i % kEach]); }, own);
  sampleNew(vertices, cells, task);

  SizeLeaves leaves;
  reserveOn(loop, leaves.is_wanted, count, count / kSpare);
  leaves.is_wanted.resize(count);
  reserveOn(loop, leaves.vertices, count, count / kSpare);
  leaves.vertices.resize(count);
  forEachByStretches(loop, count, [&](std::size_t l) {
    const std::uint32_t c = cells.leaf_cells[l];
    leaves.is_wanted[l] = task.source.isWanted(cells.boxOf(c));
    for (std::size_t k = 0; k < kEach; ++k) leaves.vertices[l][kOwnVertices[k]] = own[kEach * l + k];
    findMiddles(leaves.vertices[l], c, cells, vertices.places);
  });
  own = {};
  putInOrder(vertices, leaves.vertices, loop);
  beginGradedSizes(vertices.sizes, loop);
  return leaves;
}

std::vector<std::uint32_t> addNewLeaves(SizeLeaves& leaves, const SizeCells& cells, std::size_t first,
                                        SizeVertices& vertices, const SizeTreeTask& task) {
  leaves.is_wanted.resize(cells.leaf_cells.size());
  leaves.vertices.resize(cells.leaf_cells.size());
  std::vector<std::uint32_t> changed;
  for (auto c = static_cast<std::uint32_t>(first); c < cells.count(); ++c) {
    if (!cells.isLeaf(c)) continue;
    const std::uint32_t l = cells.below(c);
    leaves.is_wanted[l] = task.source.isWanted(cells.boxOf(c));
    for (const unsigned i : kOwnVertices) leaves.vertices[l][i] = vertices.places.add(cells.vertexOf(c, i));
    changed.push_back(l);
    for (unsigned side = 0; side < SizeCells::kSides; ++side) {
      const std::uint32_t other = cells.beside(c, side);
      if (other != kNone && cells.isLeaf(other)) changed.push_back(cells.below(other));
    }
  }
  std::ranges::sort(changed);
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  sampleNew(vertices, cells, task);
  for (const std::uint32_t l : changed) findMiddles(leaves.vertices[l], cells.leaf_cells[l], cells, vertices.places);
  GradedSizes& sizes = vertices.sizes;
  sizes.size.insert(sizes.size.end(), sizes.own.begin() + static_cast<std::ptrdiff_t>(sizes.size.size()),
                    sizes.own.end());
  sizes.source.resize(vertices.places.size(), kNone);
  return changed;
}

}  // namespace coastmesh
