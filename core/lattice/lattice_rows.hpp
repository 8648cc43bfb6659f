#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/item_loop.hpp"

namespace coastmesh {

// Integers from `first` up to, but not including, `last`.
struct Interval {
  std::int64_t first = 0;
  std::int64_t last = 0;

  friend bool operator==(const Interval&, const Interval&) = default;
};

// A set of integers: disjoint intervals that do not touch, ascending.
using Intervals = std::vector<Interval>;

// The union of any intervals; empty ones are ignored.
Intervals unionOf(Intervals any);
Intervals intersectionOf(std::span<const Interval> a, std::span<const Interval> b);
Intervals differenceOf(std::span<const Interval> a, std::span<const Interval> b);
Intervals shifted(std::span<const Interval> a, std::int64_t by);
std::int64_t countOf(std::span<const Interval> a);

// Points of a lattice of equilateral triangles, row by row. Point (a, b) of row b has the neighbours (a ± 1, b), (a, b
// ± 1), (a - 1, b + 1) and (a + 1, b - 1).
struct LatticeRows {
  std::int64_t first = 0;  // the number of the first row
  std::vector<Intervals> rows;

  // Row b; empty beyond the stored rows.
  std::span<const Interval> row(std::int64_t b) const;
  std::int64_t count() const;
};

// Point a of row b.
struct LatticePlace {
  std::int64_t a = 0;
  std::int64_t b = 0;
};

// Row by row, ascending.
BulkList<LatticePlace> placesIn(const LatticeRows& set, const ItemLoop& loop = inOrder);

// `make(b)` for every row of `like`.
template <typename Make>
LatticeRows eachRow(const LatticeRows& like, const ItemLoop& loop, const Make& make) {
  LatticeRows made{like.first, std::vector<Intervals>(like.rows.size())};
  loop(made.rows.size(), [&](std::size_t i) { made.rows[i] = make(like.first + static_cast<std::int64_t>(i)); });
  return made;
}

// The points of the set whose six neighbours are all in it too.
LatticeRows eroded(const LatticeRows& set, const ItemLoop& loop);

}  // namespace coastmesh
