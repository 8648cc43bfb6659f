#include "core/lattice/lattice_rows.hpp"

#include <algorithm>

namespace coastmesh {

Intervals unionOf(Intervals any) {
  std::erase_if(any, [](const Interval& i) { return i.first >= i.last; });
  std::ranges::sort(any, {}, &Interval::first);
  Intervals all;
  for (const Interval& i : any) {
    if (!all.empty() && i.first <= all.back().last) {
      all.back().last = std::max(all.back().last, i.last);
    } else {
      all.push_back(i);
    }
  }
  return all;
}

Intervals intersectionOf(std::span<const Interval> a, std::span<const Interval> b) {
  Intervals both;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const std::int64_t first = std::max(a[i].first, b[j].first), last = std::min(a[i].last, b[j].last);
    if (first < last) both.push_back({first, last});
    if (a[i].last < b[j].last) {
      ++i;
    } else {
      ++j;
    }
  }
  return both;
}

Intervals differenceOf(std::span<const Interval> a, std::span<const Interval> b) {
  Intervals left;
  std::size_t j = 0;
  for (Interval i : a) {
    while (j < b.size() && b[j].last <= i.first) ++j;
    for (std::size_t k = j; k < b.size() && b[k].first < i.last; ++k) {
      if (b[k].first > i.first) left.push_back({i.first, b[k].first});
      i.first = std::min(b[k].last, i.last);
    }
    if (i.first < i.last) left.push_back(i);
  }
  return left;
}

Intervals shifted(std::span<const Interval> a, std::int64_t by) {
  Intervals moved(a.begin(), a.end());
  for (Interval& i : moved) i = {i.first + by, i.last + by};
  return moved;
}

std::int64_t countOf(std::span<const Interval> a) {
  std::int64_t count = 0;
  for (const Interval& i : a) count += i.last - i.first;
  return count;
}

std::span<const Interval> LatticeRows::row(std::int64_t b) const {
  if (b < first || b >= first + static_cast<std::int64_t>(rows.size())) return {};
  return rows[static_cast<std::size_t>(b - first)];
}

std::int64_t LatticeRows::count() const {
  std::int64_t count = 0;
  for (const Intervals& row : rows) count += countOf(row);
  return count;
}

BulkList<LatticePlace> placesIn(const LatticeRows& set, const ItemLoop& loop) {
  std::vector<std::size_t> starts{0};
  for (const Intervals& row : set.rows) starts.push_back(starts.back() + static_cast<std::size_t>(countOf(row)));
  BulkList<LatticePlace> places = unsetList<LatticePlace>(starts.back());
  const auto fill = [&](std::size_t first, std::size_t last) {
    for (std::size_t r = first; r < last; ++r) {
      std::size_t next = starts[r];
      for (const Interval& i : set.rows[r])
        for (std::int64_t a = i.first; a < i.last; ++a) places[next++] = {a, set.first + static_cast<std::int64_t>(r)};
    }
  };
  constexpr std::size_t kWorthAStretch = 64;
  forStretches(loop, set.rows.size(), fill, kWorthAStretch);
  return places;
}

LatticeRows eroded(const LatticeRows& set, const ItemLoop& loop) {
  return eachRow(set, loop, [&](std::int64_t b) {
    const auto here = set.row(b), above = set.row(b + 1), below = set.row(b - 1);
    Intervals left = intersectionOf(here, shifted(here, 1));
    left = intersectionOf(left, shifted(here, -1));
    left = intersectionOf(left, intersectionOf(above, shifted(above, 1)));
    return intersectionOf(left, intersectionOf(below, shifted(below, -1)));
  });
}

}  // namespace coastmesh
