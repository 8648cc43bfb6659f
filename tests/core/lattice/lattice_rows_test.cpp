#include "core/lattice/lattice_rows.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <utility>

namespace coastmesh {
namespace {

using Numbers = std::set<std::int64_t>;

Numbers numbersOf(std::span<const Interval> intervals) {
  Numbers numbers;
  for (const Interval& i : intervals)
    for (std::int64_t a = i.first; a < i.last; ++a) numbers.insert(a);
  return numbers;
}

Intervals someIntervals(std::mt19937_64& random) {
  Intervals some;
  for (auto i = random() % 6; i > 0; --i) {
    const auto first = static_cast<std::int64_t>(random() % 40) - 20;
    some.push_back({first, first + static_cast<std::int64_t>(random() % 8)});
  }
  return some;
}

void expectInOrder(const Intervals& intervals) {
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    EXPECT_LT(intervals[i].first, intervals[i].last);
    if (i > 0) {
      EXPECT_LT(intervals[i - 1].last, intervals[i].first);
    }
  }
}

TEST(Intervals, AreSetsOfNumbers) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 2000; ++i) {
    const Intervals raw = someIntervals(random), a = unionOf(raw), b = unionOf(someIntervals(random));
    const Numbers in_a = numbersOf(a), in_b = numbersOf(b);
    expectInOrder(a);
    EXPECT_EQ(in_a, numbersOf(raw));
    EXPECT_EQ(countOf(a), static_cast<std::int64_t>(in_a.size()));
    Numbers both, left, moved;
    for (const std::int64_t n : in_a) {
      (in_b.contains(n) ? both : left).insert(n);
      moved.insert(n - 3);
    }
    EXPECT_EQ(numbersOf(intersectionOf(a, b)), both);
    EXPECT_EQ(numbersOf(differenceOf(a, b)), left);
    EXPECT_EQ(numbersOf(shifted(a, -3)), moved);
  }
}

TEST(LatticeRows, ErodedKeepsPlacesWithAllNeighbours) {
  std::mt19937_64 random(11);
  for (int n = 0; n < 50; ++n) {
    LatticeRows set{-2, {}};
    std::set<std::pair<std::int64_t, std::int64_t>> places;
    for (std::int64_t b = -2; b < 6; ++b) {
      Intervals row = someIntervals(random);
      row.push_back({-9, 9});
      set.rows.push_back(differenceOf(unionOf(row), unionOf({{static_cast<std::int64_t>(random() % 18) - 9, 4}})));
      for (const std::int64_t a : numbersOf(set.rows.back())) places.insert({a, b});
    }
    const LatticeRows inner = eroded(set, inOrder);
    EXPECT_EQ(set.count(), static_cast<std::int64_t>(places.size()));
    for (std::int64_t b = -3; b < 7; ++b) {
      const Numbers kept = numbersOf(inner.row(b));
      for (std::int64_t a = -30; a < 30; ++a) {
        bool all = places.contains({a, b});
        for (const auto& [da, db] : {std::pair{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}})
          all = all && places.contains({a + da, b + db});
        EXPECT_EQ(kept.contains(a), all) << a << " " << b;
      }
    }
  }
}

}  // namespace
}  // namespace coastmesh
