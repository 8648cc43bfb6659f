#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/ids.hpp"
#include "core/metric.hpp"
#include "core/size/large_list.hpp"
#include "core/size/on_surface.hpp"
#include "core/size/size_grading.hpp"
#include "core/size/size_places.hpp"
#include "core/size/size_subtrees.hpp"
#include "core/size/size_tree.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// If the lower bound of sizes in a cell is smaller by this factor than the sizes at its corners, sides and centre,
// something small lies between them. Bounds of sizes that grow with a distance are off by less.
constexpr double kHidden = 1.5;
constexpr double kUnasked = -1.0;
// Spare room for the vertices that grading adds: one for every kSpare present.
constexpr std::size_t kSpare = 32;
constexpr int kLevels = 24;
constexpr std::uint32_t kUnits = 1u << (kLevels + 1);  // per root side; leaves of the last level have centres too
// Vertices per unit area of equilateral triangles with edges of length 1.
const double kVerticesPerArea = 2.0 / std::sqrt(3.0);
// Margin for rounding in comparisons of slopes.
constexpr double kSafely = 1.0 - 1e-6;
// Largest ratio of scale factors within a cell: any, so that integrals over it are accurate, and one in which sizes
// change. Slopes in a cell are limited by its smallest scale factor, and a cone that grows by `kSizeGrowth` should
// hardly be steeper, since the excess must be flattened.
constexpr double kAnyStretch = 1.3, kGradedStretch = 1.06;

struct Square {
  std::uint32_t x = 0, y = 0;  // of the lower left corner, in units
  int level = 0;
  std::uint32_t side() const { return kUnits >> level; }
};

// Hundreds of loops over the cells of a small lake have a single item, for which it does not pay to wake threads.
ItemLoop withoutThreadsForOne(const ItemLoop& loop) {
  return [&loop](std::size_t count, const std::function<void(std::size_t)>& work) {
    count < 2 ? inOrder(count, work) : loop(count, work);
  };
}

}  // namespace

class SizeTreeBuilder {
 public:
  SizeTreeBuilder(SizeTree& tree, const SizeSource& source, const SizeTreeOptions& options, const ItemLoop& loop)
      : tree_(tree), source_(source), options_(options), loop_(withoutThreadsForOne(loop)) {}

  void build() {
    tree_.cells_.push_back({});
    squares_.push_back({});
    own_vertices_.push_back(kUnknown);
    refine();
    if (!tree_.complete_) return;
    balanceAll();
    number();
    limitGradation();
    tree_.demand_ = demandOfLeaves();
    if (!tree_.complete_) return;
    fill();
    makeStart();
  }

 private:
  // The vertices that every cell has.
  static constexpr std::array<unsigned, 5> kOwn = {0, 2, 4, 6, 8};
  static constexpr std::size_t kCentre = 2;  // index in kOwn
  static constexpr std::array<unsigned, 4> kMiddles = {1, 3, 5, 7};
  // Their numbers, in the order of kOwn, or `kUnknown`.
  using OwnVertices = std::array<std::uint32_t, kOwn.size()>;
  static constexpr std::array<unsigned, 9> kOwnThenMiddles = {0, 2, 4, 6, 8, 1, 3, 5, 7};
  static constexpr OwnVertices kUnknown = {kNone, kNone, kNone, kNone, kNone};

  double unit() const { return tree_.side_ / kUnits; }
  SizeBox boxOf(std::uint32_t c) const {
    const Square& s = squares_[c];
    const std::uint32_t half = s.side() / 2;
    return {placeOf({s.x + half, s.y + half}), unit() * half};
  }
  Point placeOf(const SizePlaces::Place& place) const {
    return tree_.origin_ + Point{unit() * place.x, unit() * place.y};
  }
  // An upper bound of a cell's longest side, on the surface.
  double sideOf(const SizeBox& box) const { return 2.0 * box.half * shrinkIn(options_.surface, box).high; }
  bool isStretched(const SizeBox& box, double most) const {
    const ShrinkRange shrink = shrinkIn(options_.surface, box);
    return shrink.high > most * shrink.low;
  }
  // The place of vertex i of a cell, numbered as in `LeafVertices`.
  SizePlaces::Place vertexOf(std::uint32_t c, unsigned i) const {
    const Square& s = squares_[c];
    return {s.x + (i % 3) * (s.side() / 2), s.y + (i / 3) * (s.side() / 2)};
  }

  // Splits a leaf when leaves have numbers.
  void split(std::uint32_t c) {
    const Square square = squares_[c];
    const std::uint32_t half = square.side() / 2;
    const std::uint32_t leaf = tree_.cells_[c].below;
    tree_.cells_[c] = {static_cast<std::uint32_t>(tree_.cells_.size()), false};
    for (unsigned k = 0; k < 4; ++k) {
      const auto child = static_cast<std::uint32_t>(tree_.cells_.size());
      tree_.cells_.push_back({});
      squares_.push_back({square.x + (k % 2) * half, square.y + (k / 2) * half, square.level + 1});
      // The first child takes its parent's number.
      tree_.cells_.back().below = k == 0 ? leaf : static_cast<std::uint32_t>(leaf_cells_.size());
      if (k == 0)
        leaf_cells_[leaf] = child;
      else
        leaf_cells_.push_back(child);
    }
  }

  // Splits the cells `cellAt(k)` in this order while leaves have no numbers, unless there would be too many.
  template <typename CellAt>
  void splitIfRoom(std::size_t count, const CellAt& cellAt) {
    if (tree_.cells_.size() + 4 * count > options_.most_cells)
      tree_.complete_ = false;
    else
      splitAll(count, cellAt);
  }
  template <typename CellAt>
  void splitAll(std::size_t count, const CellAt& cellAt) {
    const std::size_t first = tree_.cells_.size(), end = first + 4 * count;
    resizeOn(loop_, tree_.cells_, end);
    resizeOn(loop_, squares_, end);
    resizeOn(loop_, own_vertices_, end, kUnknown);
    forEachByStretches(loop_, count, [&](std::size_t k) {
      const std::uint32_t c = cellAt(k);
      const Square square = squares_[c];
      const std::uint32_t half = square.side() / 2;
      const std::size_t below = first + 4 * k;
      tree_.cells_[c] = {static_cast<std::uint32_t>(below), false};
      for (unsigned child = 0; child < 4; ++child)
        squares_[below + child] = {square.x + (child % 2) * half, square.y + (child / 2) * half, square.level + 1};
    });
  }

  bool isFull() {
    if (tree_.cells_.size() + 4 > options_.most_cells) tree_.complete_ = false;
    return !tree_.complete_;
  }

  // The vertices that a cell requires, from the range of its lengths: at least, and probably.
  struct CellDemand {
    double least = 0.0, likely = 0.0;
    double central = 0.0;  // from the length at the centre, if known
    double size = 0.0;
  };
  // The sums over some cells.
  struct Demand {
    double least = 0.0, likely = 0.0, central = 0.0;
    double most_here = 0.0;  // the largest `likely` of a cell
    SizeBox most_in;
    double size = 0.0;

    void add(const CellDemand& cell, const SizeBox& box) {
      add({cell.least, cell.likely, cell.central, cell.likely, box, cell.size});
    }
    void add(const Demand& other) {
      least += other.least;
      likely += other.likely;
      central += other.central;
      if (!(other.most_here > most_here)) return;
      most_here = other.most_here;
      most_in = other.most_in;
      size = other.size;
    }
  };

  CellDemand demandOf(std::uint32_t c, const SizeRange& range) const {
    const SizeBox box = boxOf(c);
    const double share = source_.share(box);
    const double area =
        options_.surface.isCurved() ? share * areaOn(options_.surface, box) : share * 4.0 * box.half * box.half;
    if (!(area > 0.0) || range.low == kInfinity) return {};
    // Graded lengths grow no faster from the smallest one; the mean of 1 / h² of a linearly growing length is 1 over
    // the product of its ends.
    const double high = std::min(range.high, range.low + options_.gradation * std::sqrt(2.0) * sideOf(box));
    const double low = range.low > 0.0 ? range.low : high;
    const double likely = kVerticesPerArea * area / low / high;
    const double least = kVerticesPerArea * area / range.high / range.high;
    const double centre = range.at_centre;
    const double central = std::isfinite(centre) && centre > 0.0 ? kVerticesPerArea * area / centre / centre : least;
    return {least, likely, central, low};
  }
  // `sum` and what `addTo(sum, k)` adds to it for every k below `count`.
  template <typename AddTo>
  Demand sumOver(std::size_t count, const Demand& sum, const AddTo& addTo) const {
    Demand all = sum;
    const auto sumOf = [&](std::size_t first, std::size_t last) {
      Demand here;
      for (std::size_t k = first; k < last; ++k) addTo(here, k);
      return here;
    };
    for (const Demand& part : overStretches(loop_, count, sumOf)) all.add(part);
    return all;
  }

  // True if the likely demand is far too large and has hardly decreased over some levels: the apparent demand of small
  // places halves from level to level, that of lines and areas stays.
  bool isSurelyTooMuch(double likely) {
    constexpr std::size_t kLevelsAlike = 3;
    constexpr double kAlike = 0.8, kFarTooMuch = 1.5;
    likely_.push_back(likely);
    if (likely_.size() <= kLevelsAlike || !(likely > kFarTooMuch * options_.most_vertices)) return false;
    return std::all_of(likely_.end() - kLevelsAlike - 1, likely_.end() - 1,
                       [&](double before) { return likely >= kAlike * before; });
  }

  // True if the demand from lengths at the centres of cells has exceeded the limit over some levels. A single level may
  // mislead, where a straight shore runs through the centres; on the next one it is far from them.
  bool isTooMuchOnAverage(double central) {
    constexpr int kLevelsAlike = 3;
    constexpr double kError = 1.1;  // of many cells together
    levels_beyond_ = central > kError * options_.most_vertices ? levels_beyond_ + 1 : 0;
    return levels_beyond_ >= kLevelsAlike;
  }

  // Gives up on the tree, and records the demand known so far.
  void abandon(const Demand& demand) {
    tree_.complete_ = false;
    tree_.demand_ = {std::max(demand.likely, demand.least), demand.most_in, demand.size};
  }

  // The demand of graded lengths.
  SizeDemand demandOfLeaves() const {
    const Demand all = sumOver(leaf_cells_.size(), {}, [&](Demand& sum, std::size_t l) {
      if (!is_wanted_[l]) return;
      const SizeBox box = boxOf(leaf_cells_[l]);
      const double share = source_.share(box);
      if (!(share > 0.0)) return;
      Demand here{0.0, 0.0, 0.0, 0.0, box, kInfinity};
      forEachTriangle(leaf_vertices_[l], [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const double x = sizes_.size[a], y = sizes_.size[b], z = sizes_.size[c];
        const auto atMiddle = [](double p, double q) { return 4.0 / (p + q) / (p + q); };
        // Area on the surface over area in the plane.
        const auto shareOf = [&](std::uint32_t p, std::uint32_t q) {
          if (!options_.surface.isCurved()) return 1.0;
          const double shrink = options_.surface.shrinkAt(tree_.origin_ + 0.5 * unit() * (gridPoint(p) + gridPoint(q)));
          return shrink * shrink;
        };
        const double area =
            0.5 * unit() * unit() * std::abs(cross(gridPoint(b) - gridPoint(a), gridPoint(c) - gridPoint(a)));
        here.likely +=
            kVerticesPerArea * share * area *
            (shareOf(a, b) * atMiddle(x, y) + shareOf(b, c) * atMiddle(y, z) + shareOf(c, a) * atMiddle(z, x)) / 3.0;
        here.size = std::min({here.size, x, y, z});
      });
      here.most_here = here.likely;
      sum.add(here);
    });
    return {all.likely, all.most_in, all.size};
  }
  Point gridPoint(std::uint32_t v) const { return {1.0 * vertices_[v].x, 1.0 * vertices_[v].y}; }

  // The cells from `first` to `end` for which `is(c)` is true.
  template <typename Is>
  std::vector<std::uint32_t> cellsWith(std::uint32_t first, std::uint32_t end, const Is& is) const {
    return joined(overStretches(loop_, end - first, [&](std::size_t from, std::size_t to) {
      std::vector<std::uint32_t> here;
      for (auto c = static_cast<std::uint32_t>(first + from); c < first + to; ++c)
        if (is(c)) here.push_back(c);
      return here;
    }));
  }

  // Splits cells level by level, so that many places are evaluated at once.
  void refine() {
    std::uint32_t first = 0;
    std::vector<SizeBox> boxes;
    std::vector<SizeRange> ranges;
    std::vector<CellDemand> demands;
    Demand settled;  // of cells that are not split
    bool too_much = false;
    for (int level = 0; level < kLevels; ++level) {
      const auto end = static_cast<std::uint32_t>(tree_.cells_.size());
      if (options_.surface.isCurved()) {
        const std::vector<std::uint32_t> stretched =
            cellsWith(first, end, [&](std::uint32_t c) { return isStretched(boxOf(c), kAnyStretch); });
        splitIfRoom(stretched.size(), [&](std::size_t k) { return stretched[k]; });
      }
      const std::vector<std::uint32_t> wanted =
          cellsWith(first, end, [&](std::uint32_t c) { return tree_.cells_[c].is_leaf && source_.isWanted(boxOf(c)); });
      if (wanted.empty() && tree_.cells_.size() == end) break;
      resizeAnew(loop_, boxes, wanted.size());
      forEachByStretches(loop_, wanted.size(), [&](std::size_t k) { boxes[k] = boxOf(wanted[k]); });
      resizeAnew(loop_, ranges, wanted.size());
      source_.bound(boxes, ranges);
      resizeAnew(loop_, demands, wanted.size());
      Demand pending = sumOver(wanted.size(), settled, [&](Demand& sum, std::size_t k) {
        demands[k] = demandOf(wanted[k], ranges[k]);
        sum.add(demands[k], boxes[k]);
      });
      // A few more cells cost nothing and improve the estimate.
      constexpr std::uint32_t kFewCells = 20'000;
      too_much |= isSurelyTooMuch(pending.likely) || pending.least > options_.most_vertices;
      // Bounds alone reveal a slight excess only when the tree is nearly complete.
      if (isTooMuchOnAverage(pending.central) && end >= kFewCells) {
        pending.least = std::max(pending.least, pending.central);
        return abandon(pending);
      }
      if (too_much && end >= kFewCells) return abandon(pending);
      if (tree_.complete_) splitByRange(wanted, ranges);
      if (!tree_.complete_) return abandon(pending);
      settled = sumOver(wanted.size(), settled, [&](Demand& sum, std::size_t k) {
        if (tree_.cells_[wanted[k]].is_leaf) sum.add(demands[k], boxes[k]);
      });
      first = end;
    }
    if (too_much) abandon(settled);
  }

  // Splits cells that are too large for their smallest length, and those that are bent.
  void splitByRange(const std::vector<std::uint32_t>& cells, const std::vector<SizeRange>& ranges) {
    enum class Split : std::uint8_t { No, Yes, IfBent };
    std::vector<Split> splits(cells.size());
    forEachByStretches(loop_, cells.size(), [&](std::size_t k) {
      const double low = ranges[k].low, high = ranges[k].high;
      if (!(high > low * (1.0 + toleranceOf(ranges[k])))) return;
      const SizeBox box = boxOf(cells[k]);
      const double side = sideOf(box);
      if (side > options_.coarsest * low || isStretched(box, kGradedStretch)) {
        splits[k] = Split::Yes;
      } else if (side > (ranges[k].is_graded ? options_.finest_graded : options_.finest) * low) {
        splits[k] = Split::IfBent;
      }
    });
    const auto these = [&](Split which) {
      return joined(overStretches(loop_, cells.size(), [&](std::size_t first, std::size_t last) {
        std::vector<std::uint32_t> here;
        for (auto k = static_cast<std::uint32_t>(first); k < last; ++k)
          if (splits[k] == which) here.push_back(k);
        return here;
      }));
    };
    const std::vector<std::uint32_t> surely = these(Split::Yes);
    splitIfRoom(surely.size(), [&](std::size_t k) { return cells[surely[k]]; });
    if (tree_.complete_) splitWhereBent(cells, these(Split::IfBent), ranges);
  }

  double toleranceOf(const SizeRange& range) const {
    return range.is_graded ? options_.tolerance_graded : options_.tolerance;
  }

  // Splits those of the cells `these` whose centre or sides differ from interpolation between the corners, or that
  // contain something much smaller than all of these. `these` are numbers in the two lists.
  void splitWhereBent(const std::vector<std::uint32_t>& cells, const std::vector<std::uint32_t>& these,
                      const std::vector<SizeRange>& ranges) {
    // The own vertices of each cell, then the middles of its sides.
    constexpr std::size_t kEach = 9;
    UnsetNumbers<std::uint32_t> numbers(kEach * these.size());
    forEachByStretches(loop_, these.size(), [&](std::size_t k) {
      std::ranges::copy(own_vertices_[cells[these[k]]], &numbers[kEach * k]);
      std::fill_n(&numbers[kEach * k + kOwn.size()], kMiddles.size(), kNone);
    });
    vertices_.addAll(
        loop_, [&](std::size_t i) { return vertexOf(cells[these[i / kEach]], kOwnThenMiddles[i % kEach]); }, numbers);
    resizeOn(loop_, sizes_.own, vertices_.size(), kUnasked);
    // Bounds have provided some.
    forEachByStretches(loop_, these.size(), [&](std::size_t k) {
      std::copy_n(&numbers[kEach * k], kOwn.size(), own_vertices_[cells[these[k]]].begin());
      const double at_centre = ranges[these[k]].at_centre;
      if (!std::isnan(at_centre)) sizes_.own[numbers[kEach * k + kCentre]] = at_centre;
    });
    sample();
    const auto isBent = [&](std::size_t k) {
      const SizeRange& range = ranges[these[k]];
      std::array<double, 9> v;
      for (std::size_t i = 0; i < kEach; ++i) v[kOwnThenMiddles[i]] = sizes_.own[numbers[kEach * k + i]];
      // The error of four triangles; eight have about half of it.
      double off = std::abs(0.25 * (v[0] + v[2] + v[6] + v[8]) - v[4]);
      off = 0.5 * std::max({off, std::abs(0.5 * (v[0] + v[2]) - v[1]), std::abs(0.5 * (v[0] + v[6]) - v[3]),
                            std::abs(0.5 * (v[2] + v[8]) - v[5]), std::abs(0.5 * (v[6] + v[8]) - v[7])});
      const double least = std::ranges::min(v), side = sideOf(boxOf(cells[these[k]]));
      if (least > kHidden * range.low) return true;
      return std::isfinite(off) ? off * side > toleranceOf(range) * least * least : std::isfinite(least);
    };
    const std::vector<std::uint32_t> bent =
        joined(overStretches(loop_, these.size(), [&](std::size_t first, std::size_t last) {
          std::vector<std::uint32_t> here;
          for (std::size_t k = first; k < last; ++k)
            if (isBent(k)) here.push_back(static_cast<std::uint32_t>(k));
          return here;
        }));
    const std::size_t before = tree_.cells_.size();
    splitIfRoom(bent.size(), [&](std::size_t k) { return cells[these[bent[k]]]; });
    if (!tree_.complete_) return;
    // Four of each child's vertices already have a number.
    std::vector<std::uint32_t> centres(4 * bent.size(), kNone);
    vertices_.addAll(
        loop_, [&](std::size_t i) { return vertexOf(static_cast<std::uint32_t>(before + i), 4); }, centres);
    forEachByStretches(loop_, bent.size(), [&](std::size_t k) {
      LeafVertices around;
      for (std::size_t i = 0; i < kEach; ++i) around[kOwnThenMiddles[i]] = numbers[kEach * bent[k] + i];
      for (std::size_t child = 0; child < 4; ++child) {
        const std::size_t first = child % 2 + 3 * (child / 2);
        own_vertices_[before + 4 * k + child] = {around[first], around[first + 1], centres[4 * k + child],
                                                 around[first + 3], around[first + 4]};
      }
    });
  }

  // Samples sizes at new vertices, except those that bounds have already provided.
  void sample() {
    const std::size_t known = std::exchange(sampled_, vertices_.size());
    resizeOn(loop_, sizes_.own, vertices_.size(), kUnasked);
    const std::vector<std::uint32_t> asked =
        joined(overStretches(loop_, vertices_.size() - known, [&](std::size_t first, std::size_t last) {
          std::vector<std::uint32_t> here;
          for (auto v = static_cast<std::uint32_t>(known + first); v < known + last; ++v)
            if (sizes_.own[v] == kUnasked) here.push_back(v);
          return here;
        }));
    std::vector<Point> places;
    resizeAnew(loop_, places, asked.size());
    forEachByStretches(loop_, asked.size(), [&](std::size_t k) { places[k] = placeOf(vertices_[asked[k]]); });
    UnsetNumbers<double> sizes(places.size());
    source_.sample(places, sizes);
    forEachByStretches(loop_, asked.size(), [&](std::size_t k) { sizes_.own[asked[k]] = sizes[k]; });
  }

  // The cell that contains the unit square with this lower left corner, no deeper than `level`.
  std::uint32_t find(std::uint32_t x, std::uint32_t y, int level) const {
    std::uint32_t c = 0;
    for (int l = 1; l <= level && !tree_.cells_[c].is_leaf; ++l) {
      const std::uint32_t half = kUnits >> l;
      c = tree_.cells_[c].below + ((x & half) != 0) + 2 * ((y & half) != 0);
    }
    return c;
  }

  // The cell beside a side of this one, as large or larger; kNone beyond the root. Sides: left, right, lower, upper.
  std::uint32_t beside(std::uint32_t c, unsigned side) const {
    const Square& s = squares_[c];
    const bool is_across = side < 2, is_up = side % 2 != 0;
    const std::uint32_t along = is_across ? s.x : s.y;
    // Siblings are consecutive, after the root.
    if (s.level > 0 && ((along & s.side()) != 0) != is_up) return ((c - 1) ^ (is_across ? 1u : 2u)) + 1;
    if (is_up ? along + s.side() >= kUnits : along == 0) return kNone;
    const std::uint32_t to = is_up ? along + s.side() : along - s.side();
    return is_across ? find(to, s.y, s.level) : find(s.x, to, s.level);
  }
  static constexpr unsigned kSides = 4;
  // The vertex in the middle of each side.
  static constexpr std::array<unsigned, kSides> kMiddleOf = {3, 5, 1, 7};

  // A leaf beside this one that is two levels coarser or more; kNone if there is none.
  std::uint32_t tooLargeBeside(std::uint32_t c) const {
    for (unsigned side = 0; side < kSides; ++side) {
      const std::uint32_t other = beside(c, side);
      if (other != kNone && tree_.cells_[other].is_leaf && squares_[other].level + 1 < squares_[c].level) return other;
    }
    return kNone;
  }

  // The leaves, from cell `first` on, that have a leaf beside them that is too large.
  std::vector<std::uint32_t> unbalanced(std::size_t first) const {
    return cellsWith(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(tree_.cells_.size()),
                     [&](std::uint32_t c) { return tree_.cells_[c].is_leaf && tooLargeBeside(c) != kNone; });
  }

  // Splits leaves until adjacent ones differ by at most one level, before leaves have numbers. The result is the
  // smallest such tree, in whatever order they are split.
  void balanceAll() {
    for (std::vector<std::uint32_t> waiting = unbalanced(0); !waiting.empty();) {
      std::vector<std::uint32_t> large =
          joined(overStretches(loop_, waiting.size(), [&](std::size_t first, std::size_t last) {
            std::vector<std::uint32_t> here;
            for (std::size_t k = first; k < last; ++k)
              if (tree_.cells_[waiting[k]].is_leaf) here.push_back(tooLargeBeside(waiting[k]));
            return here;
          }));
      sortOn(loop_, large);
      large.erase(std::unique(large.begin(), large.end()), large.end());
      const std::size_t before = tree_.cells_.size();
      splitAll(large.size(), [&](std::size_t k) { return large[k]; });
      std::vector<std::uint32_t> still =
          joined(overStretches(loop_, waiting.size(), [&](std::size_t first, std::size_t last) {
            std::vector<std::uint32_t> here;
            for (std::size_t k = first; k < last; ++k)
              if (tree_.cells_[waiting[k]].is_leaf && tooLargeBeside(waiting[k]) != kNone) here.push_back(waiting[k]);
            return here;
          }));
      const std::vector<std::uint32_t> more = unbalanced(before);
      still.insert(still.end(), more.begin(), more.end());
      waiting = std::move(still);
    }
  }

  // The same when leaves have numbers, which depend on the order. REQUIRES: leaves before cell `first` are balanced.
  void balance(std::size_t first) {
    std::vector<std::uint32_t> waiting = unbalanced(first);
    while (!waiting.empty()) {
      const std::uint32_t c = waiting.back();
      const std::uint32_t other = tree_.cells_[c].is_leaf ? tooLargeBeside(c) : kNone;
      if (other == kNone) {
        waiting.pop_back();
        continue;
      }
      split(other);
      for (std::uint32_t child = 0; child < 4; ++child) waiting.push_back(tree_.cells_[other].below + child);
    }
  }

  // Numbers leaves and their vertices so that neighbours are close in memory; samples sizes at new vertices.
  void number() {
    leaf_cells_ = leavesDepthFirst(tree_.cells_, loop_);
    UnsetNumbers<std::uint32_t> own(kOwn.size() * leaf_cells_.size());
    forEachByStretches(loop_, leaf_cells_.size(), [&](std::size_t l) {
      tree_.cells_[leaf_cells_[l]].below = static_cast<std::uint32_t>(l);
      std::ranges::copy(own_vertices_[leaf_cells_[l]], &own[kOwn.size() * l]);
    });
    freeMemoryOf(own_vertices_);
    vertices_.addAll(
        loop_, [&](std::size_t i) { return vertexOf(leaf_cells_[i / kOwn.size()], kOwn[i % kOwn.size()]); }, own);
    sample();
    reserveOn(loop_, is_wanted_, leaf_cells_.size(), leaf_cells_.size() / kSpare);
    is_wanted_.resize(leaf_cells_.size());
    reserveOn(loop_, leaf_vertices_, leaf_cells_.size(), leaf_cells_.size() / kSpare);
    leaf_vertices_.resize(leaf_cells_.size());
    forEachByStretches(loop_, leaf_cells_.size(), [&](std::size_t l) {
      is_wanted_[l] = source_.isWanted(boxOf(leaf_cells_[l]));
      for (std::size_t k = 0; k < kOwn.size(); ++k) leaf_vertices_[l][kOwn[k]] = own[kOwn.size() * l + k];
      findMiddles(static_cast<std::uint32_t>(l));
    });
    own = {};
    putInOrder();
    const std::size_t count = vertices_.size(), spare = sizes_.own.capacity() - count;
    reserveOn(loop_, sizes_.size, count, spare);
    sizes_.size = sizes_.own;
    reserveOn(loop_, sizes_.source, count, spare);
    sizes_.source.assign(count, kNone);
  }

  // The middle of a side is a vertex if smaller leaves meet it, or if the leaf on the other side is as large and the
  // size there is known.
  void findMiddles(std::uint32_t l) {
    const std::uint32_t c = leaf_cells_[l];
    for (unsigned side = 0; side < kSides; ++side) {
      const unsigned i = kMiddleOf[side];
      const std::uint32_t other = beside(c, side);
      const bool is_larger = other != kNone && squares_[other].level < squares_[c].level;
      leaf_vertices_[l][i] = is_larger ? kNone : vertices_.find(vertexOf(c, i));
    }
  }

  // Renumbers vertices as leaves use them; unused ones come last.
  void putInOrder() {
    const std::size_t count = vertices_.size();
    // The first use of each vertex, as 9 times the leaf plus the index in it; later its new number.
    UnsetNumbers<std::uint32_t> numbers = noNumbers(loop_, count);
    const auto useOf = [](std::size_t l, std::size_t i) { return static_cast<std::uint32_t>(9 * l + i); };
    forEachByStretches(loop_, leaf_vertices_.size(), [&](std::size_t l) {
      for (std::size_t i = 0; i < 9; ++i)
        if (leaf_vertices_[l][i] != kNone) lowerTo(numbers[leaf_vertices_[l][i]], useOf(l, i));
    });
    std::vector<std::uint32_t> order =
        joined(overStretches(loop_, leaf_vertices_.size(), [&](std::size_t first, std::size_t last) {
          std::vector<std::uint32_t> here;
          for (std::size_t l = first; l < last; ++l) {
            for (std::size_t i = 0; i < 9; ++i) {
              const std::uint32_t v = leaf_vertices_[l][i];
              if (v != kNone && numbers[v] == useOf(l, i)) here.push_back(v);
            }
          }
          return here;
        }));
    const std::vector<std::uint32_t> unused =
        joined(overStretches(loop_, count, [&](std::size_t first, std::size_t last) {
          std::vector<std::uint32_t> here;
          for (auto v = static_cast<std::uint32_t>(first); v < last; ++v)
            if (numbers[v] == kNone) here.push_back(v);
          return here;
        }));
    order.insert(order.end(), unused.begin(), unused.end());
    forEachByStretches(loop_, count, [&](std::size_t v) { numbers[order[v]] = static_cast<std::uint32_t>(v); });
    forEachByStretches(loop_, leaf_vertices_.size(), [&](std::size_t l) {
      for (std::uint32_t& v : leaf_vertices_[l])
        if (v != kNone) v = numbers[v];
    });
    vertices_.reorder(loop_, order, numbers);
    std::vector<double> own;
    reserveOn(loop_, own, count, count / kSpare);
    own.resize(count);
    forEachByStretches(loop_, count, [&](std::size_t v) { own[v] = sizes_.own[order[v]]; });
    sizes_.own = std::move(own);
  }

  // Numbers the leaves that `split` has made, from cell `first` on. Returns the leaves that are new or have other
  // vertices.
  std::vector<std::uint32_t> numberNew(std::size_t first) {
    is_wanted_.resize(leaf_cells_.size());
    leaf_vertices_.resize(leaf_cells_.size());
    std::vector<std::uint32_t> changed;
    for (auto c = static_cast<std::uint32_t>(first); c < tree_.cells_.size(); ++c) {
      if (!tree_.cells_[c].is_leaf) continue;
      const std::uint32_t l = tree_.cells_[c].below;
      is_wanted_[l] = source_.isWanted(boxOf(c));
      for (const unsigned i : kOwn) leaf_vertices_[l][i] = vertices_.add(vertexOf(c, i));
      changed.push_back(l);
      for (unsigned side = 0; side < kSides; ++side) {
        const std::uint32_t other = beside(c, side);
        if (other != kNone && tree_.cells_[other].is_leaf) changed.push_back(tree_.cells_[other].below);
      }
    }
    std::ranges::sort(changed);
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    sample();
    for (const std::uint32_t l : changed) findMiddles(l);
    sizes_.size.insert(sizes_.size.end(), sizes_.own.begin() + static_cast<std::ptrdiff_t>(sizes_.size.size()),
                       sizes_.own.end());
    sizes_.source.resize(vertices_.size(), kNone);
    return changed;
  }

  void limitGradation() {
    const SizeGrid grid{vertices_, unit(), tree_.origin_, options_.surface, kSafely * options_.gradation};
    SizeGrading grading(sizes_, grid, leaf_vertices_, loop_);
    for (int round = 0; round < kLevels; ++round) {
      grading.spread();
      const std::size_t before = tree_.cells_.size();
      if (!splitGraded()) break;
      balance(before);
      const std::vector<std::uint32_t> changed = numberNew(before);
      grading.update(leaf_vertices_, changed);
    }
    // If no size is requested anywhere: as large as the whole.
    const double whole =
        options_.surface.isCurved() ? std::min(tree_.side_, 2.0 * options_.surface.radius()) : tree_.side_;
    for (double& size : sizes_.size) size = std::min(size, whole);
    grading.flatten();
  }

  // Splits leaves that are too large for the sizes that grow into them, or too stretched. Leaves that will not be
  // evaluated are split only for the latter, since sizes grow through them too.
  bool splitGraded() {
    struct Due {
      std::uint32_t leaf;
      std::array<std::uint32_t, 9> sources;
      std::size_t count = 0;
      std::span<const std::uint32_t> known() const { return std::span(sources).first(count); }
    };
    const std::vector<Due> due =
        joined(overStretches(loop_, leaf_cells_.size(), [&](std::size_t first, std::size_t last) {
          std::vector<Due> here;
          for (std::size_t l = first; l < last; ++l) {
            if (!is_wanted_[l] && !options_.surface.isCurved()) continue;
            Due one{static_cast<std::uint32_t>(l), {}};
            for (const std::uint32_t v : leaf_vertices_[l])
              if (v != kNone && sizes_.source[v] != kNone) one.sources[one.count++] = sizes_.source[v];
            if (one.count > 0 && isDue(leaf_cells_[l], one.known(), is_wanted_[l] != 0)) here.push_back(one);
          }
          return here;
        }));
    const std::size_t before = tree_.cells_.size();
    for (const Due& one : due) splitBelow(leaf_cells_[one.leaf], one.known(), is_wanted_[one.leaf] != 0);
    return tree_.cells_.size() > before;
  }

  bool isDue(std::uint32_t c, std::span<const std::uint32_t> sources, bool is_wanted) const {
    if (squares_[c].level == kLevels) return false;
    return (is_wanted && isTooLarge(c, sources)) || isStretched(boxOf(c), kGradedStretch);
  }

  void splitBelow(std::uint32_t c, std::span<const std::uint32_t> sources, bool is_wanted) {
    if (!isDue(c, sources, is_wanted) || isFull()) return;
    split(c);
    for (std::uint32_t k = 0; k < 4; ++k) splitBelow(tree_.cells_[c].below + k, sources, is_wanted);
  }

  bool isTooLarge(std::uint32_t c, std::span<const std::uint32_t> sources) const {
    const Surface& surface = options_.surface;
    const Square square = squares_[c];
    const double half = 0.5 * unit() * square.side();
    const Point centre{unit() * square.x + half, unit() * square.y + half};
    double low = kInfinity;
    for (const std::uint32_t s : sources) {
      const Point off = Point{unit() * vertices_[s].x, unit() * vertices_[s].y} - centre;
      const Point beyond{std::max(std::abs(off.x) - half, 0.0), std::max(std::abs(off.y) - half, 0.0)};
      double way = std::sqrt(squaredLength(beyond));
      if (surface.isCurved()) {
        const Point at = tree_.origin_ + centre + off;
        const Point nearest =
            tree_.origin_ + centre + Point{std::clamp(off.x, -half, half), std::clamp(off.y, -half, half)};
        way = arcBetween(surface, at, nearest);
      }
      low = std::min(low, sizes_.own[s] + kSizeGrowth * options_.gradation * way);
    }
    return sideOf(boxOf(c)) > options_.coarsest * low;
  }

  // Stores cells and leaves depth first, so that neighbours are close in memory.
  void fill() {
    CellOrder order = orderDepthFirst(tree_.cells_, leaf_vertices_.size(), loop_);
    tree_.cells_ = std::move(order.cells);
    reserveOn(loop_, tree_.leaves_, leaf_vertices_.size());
    tree_.leaves_.resize(leaf_vertices_.size());
    const std::vector<SizeRange> parts =
        overStretches(loop_, leaf_vertices_.size(), [&](std::size_t first, std::size_t last) {
          SizeRange range{kInfinity, 0.0};
          for (std::size_t l = first; l < last; ++l) {
            for (unsigned i = 0; i < 9; ++i) {
              const std::uint32_t v = leaf_vertices_[l][i];
              tree_.leaves_[order.leaf[l]][i] = v == kNone ? std::nanf("") : static_cast<float>(sizes_.size[v]);
              if (v == kNone) continue;
              range.low = std::min(range.low, sizes_.size[v]);
              range.high = std::max(range.high, sizes_.size[v]);
            }
          }
          return range;
        });
    tree_.least_ = kInfinity;
    for (const SizeRange& part : parts) {
      tree_.least_ = std::min(tree_.least_, part.low);
      tree_.most_ = std::max(tree_.most_, part.high);
    }
  }

  // Makes a table of start cells, in proportion to the tree.
  void makeStart() {
    constexpr int kMostLevels = 11;
    int& levels = tree_.start_levels_;
    while (levels < kMostLevels && (tree_.leaves_.size() >> (2 * levels)) >= 16) ++levels;
    const std::uint32_t starts = 1u << levels;
    tree_.start_.resize(std::size_t{starts} * starts);
    tree_.start_level_.resize(tree_.start_.size());
    for (std::uint32_t j = 0; j < starts; ++j) {
      for (std::uint32_t i = 0; i < starts; ++i) {
        std::uint32_t c = 0;
        std::uint8_t level = 0;
        for (; level < levels && !tree_.cells_[c].is_leaf; ++level) {
          const std::uint32_t half = starts >> (level + 1);
          c = tree_.cells_[c].below + ((i & half) != 0) + 2 * ((j & half) != 0);
        }
        tree_.start_[(std::size_t{j} << levels) + i] = c;
        tree_.start_level_[(std::size_t{j} << levels) + i] = level;
      }
    }
  }

  SizeTree& tree_;
  const SizeSource& source_;
  const SizeTreeOptions& options_;
  const ItemLoop loop_;
  std::vector<Square> squares_;            // one for each cell
  std::vector<OwnVertices> own_vertices_;  // one for each cell, until leaves have numbers
  SizePlaces vertices_;                    // in units; some are of cells that were split
  GradedSizes sizes_;                      // at the vertices
  std::size_t sampled_ = 0;                // vertices whose sizes `sample` has found
  std::vector<std::uint32_t> leaf_cells_;
  std::vector<LeafVertices> leaf_vertices_;
  std::vector<char> is_wanted_;  // one for each leaf
  std::vector<double> likely_;   // demand estimated at each level
  int levels_beyond_ = 0;        // consecutive levels whose centres require too much
};

SizeTree::SizeTree(const Point& low, const Point& high, const SizeSource& source, const SizeTreeOptions& options,
                   const ItemLoop& loop) {
  // Slightly larger, so that nothing lies on the root's own sides.
  const double extent = std::max(high.x - low.x, high.y - low.y);
  side_ = 1.01 * (extent > 0.0 ? extent : 1.0);
  origin_ = midpoint(low, high) - Point{0.5 * side_, 0.5 * side_};
  SizeTreeBuilder(*this, source, options, loop).build();
}

}  // namespace coastmesh
