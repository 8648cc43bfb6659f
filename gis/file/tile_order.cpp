#include "gis/file/tile_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>

namespace coastmesh {
namespace {

// A row, and the middle of its box in units of 2^-32 of the bounds.
struct Place {
  std::uint32_t x, y, row;
};

// Keys of 32 bits have three digits.
constexpr unsigned kDigitBits = 11;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;

std::size_t digitOf(std::uint32_t key, unsigned shift) { return key >> shift & (kDigits - 1); }

IndexBox boundsOf(std::uint32_t rows, const std::function<IndexBox(std::uint32_t)>& box, const ItemLoop& loop) {
  const auto unite = [](IndexBox& all, const IndexBox& own) {
    all.low = {std::min(all.low.x, own.low.x), std::min(all.low.y, own.low.y)};
    all.high = {std::max(all.high.x, own.high.x), std::max(all.high.y, own.high.y)};
  };
  const std::vector<IndexBox> some = overStretches(loop, rows, [&](std::size_t first, std::size_t last) {
    IndexBox all = box(static_cast<std::uint32_t>(first));
    for (std::size_t i = first + 1; i < last; ++i) unite(all, box(static_cast<std::uint32_t>(i)));
    return all;
  });
  IndexBox all = some.front();
  for (const IndexBox& own : some) unite(all, own);
  return all;
}

// Scales the middle of an interval to 32 bits of a range. Calculates with halves, so that no difference overflows.
class Scale {
 public:
  Scale(double low, double high) : low_(low / 2), range_(high / 2 - low / 2) {}

  std::uint32_t operator()(double from, double to) const {
    constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
    const double part = (from / 4 + to / 4 - low_) / range_ * kMost;
    return part > 0.0 ? static_cast<std::uint32_t>(std::min(part, kMost)) : 0;
  }

 private:
  double low_, range_;
};

// Sorts by the lowest `digits` digits of a key, from the last digit to the first; equal keys keep their order. Returns
// the one of the two spans, which have the same length, that has the result.
template <typename Key>
std::span<Place> sortByDigits(std::span<Place> places, std::span<Place> spare, const Key& key, unsigned digits) {
  constexpr std::size_t kFew = 256;
  if (places.size() < kFew) {
    const std::uint32_t mask = digits * kDigitBits >= 32 ? ~0u : (1u << digits * kDigitBits) - 1;
    std::ranges::stable_sort(places, {}, [&](const Place& p) { return key(p) & mask; });
    return places;
  }
  for (unsigned digit = 0; digit < digits; ++digit) {
    std::array<std::uint32_t, kDigits> next{};
    for (const Place& p : places) ++next[digitOf(key(p), digit * kDigitBits)];
    std::uint32_t sum = 0;
    for (std::uint32_t& n : next) sum += std::exchange(n, sum);
    for (const Place& p : places) spare[next[digitOf(key(p), digit * kDigitBits)]++] = p;
    std::swap(places, spare);
  }
  return places;
}

// Sorts places by the first digit of x, stably, from `from` into `to`; returns where each digit begins, and the end.
std::vector<std::size_t> dealByX(std::span<const Place> from, std::span<Place> to, const ItemLoop& loop) {
  constexpr std::size_t kStretches = 64;
  constexpr unsigned kFirstDigit = 32 - kDigitBits;
  const auto begin = [&](std::size_t s) { return from.size() * s / kStretches; };
  std::vector<std::array<std::size_t, kDigits>> next(kStretches);
  loop(kStretches, [&](std::size_t s) {
    next[s].fill(0);
    for (std::size_t i = begin(s); i < begin(s + 1); ++i) ++next[s][digitOf(from[i].x, kFirstDigit)];
  });
  std::vector<std::size_t> first;
  std::size_t sum = 0;
  for (std::size_t digit = 0; digit < kDigits; ++digit) {
    first.push_back(sum);
    for (auto& of_stretch : next) sum += std::exchange(of_stretch[digit], sum);
  }
  first.push_back(sum);
  loop(kStretches, [&](std::size_t s) {
    for (std::size_t i = begin(s); i < begin(s + 1); ++i) to[next[s][digitOf(from[i].x, kFirstDigit)]++] = from[i];
  });
  return first;
}

// Sorts places by x from `from` into `to`, as far as needed to divide them into slices of `slice` places; `from` is
// overwritten.
void dealToSlices(std::span<Place> from, std::span<Place> to, std::size_t slice, const ItemLoop& loop) {
  constexpr std::size_t kWorthDealing = 65536;
  const auto sortByX = [](std::span<Place> places, std::span<Place> spare, unsigned digits) {
    return sortByDigits(
        places, spare, [](const Place& p) { return p.x; }, digits);
  };
  if (from.size() < kWorthDealing) {
    const std::span<Place> sorted = sortByX(from, to, 3);
    if (sorted.data() != to.data()) std::ranges::copy(sorted, to.begin());
    return;
  }
  const std::vector<std::size_t> first = dealByX(from, to, loop);
  loop(kDigits, [&](std::size_t digit) {
    const std::size_t begin = first[digit], count = first[digit + 1] - begin;
    // The order within a slice does not matter.
    if (count == 0 || begin / slice == (begin + count - 1) / slice) return;
    const std::span<Place> places = to.subspan(begin, count);
    const std::span<Place> sorted = sortByX(places, from.subspan(begin, count), 2);
    if (sorted.data() != places.data()) std::ranges::copy(sorted, places.begin());
  });
}

}  // namespace

TileOrder tileOrder(std::uint32_t rows, std::size_t together, const std::function<IndexBox(std::uint32_t)>& box,
                    const ItemLoop& loop) {
  TileOrder order{{}, boundsOf(rows, box, loop)};
  const auto& [low, high] = order.bounds;
  const Scale x(low.x, high.x), y(low.y, high.y);
  const auto memory = std::make_unique_for_overwrite<Place[]>(rows);
  const auto spare = std::make_unique_for_overwrite<Place[]>(rows);
  const std::span<Place> places(memory.get(), rows), dealt(spare.get(), rows);
  forEachByStretches(loop, rows, [&](std::size_t i) {
    const auto row = static_cast<std::uint32_t>(i);
    const IndexBox of = box(row);
    places[i] = {x(of.low.x, of.high.x), y(of.low.y, of.high.y), row};
  });
  const auto nodes = static_cast<double>((rows + together - 1) / together);
  const std::size_t slice = static_cast<std::size_t>(std::ceil(std::sqrt(nodes))) * together;
  dealToSlices(places, dealt, slice, loop);
  resizeAnew(loop, order.rows, rows);
  loop((rows + slice - 1) / slice, [&](std::size_t s) {
    const std::size_t from = s * slice, to = std::min<std::size_t>(rows, from + slice);
    const std::span<Place> sorted = sortByDigits(
        dealt.subspan(from, to - from), places.subspan(from, to - from), [](const Place& p) { return p.y; }, 3);
    for (std::size_t i = from; i < to; ++i) order.rows[i] = sorted[i - from].row;
  });
  return order;
}

}  // namespace coastmesh
