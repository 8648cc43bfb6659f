#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>

#include "core/ids.hpp"
#include "core/metric.hpp"
#include "core/size/on_surface.hpp"
#include "core/size/size_grading.hpp"
#include "core/size/size_places.hpp"
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

}  // namespace

class SizeTreeBuilder {
 public:
  SizeTreeBuilder(SizeTree& tree, const SizeSource& source, const SizeTreeOptions& options, const ItemLoop& loop)
      : tree_(tree), source_(source), options_(options), loop_(loop) {}

  void build() {
    tree_.cells_.push_back({});
    squares_.push_back({});
    known_.push_back(kNone);
    refine();
    if (!tree_.complete_) return;
    balance(0);
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
  void addOwnVertices(std::uint32_t c) {
    if (known_[c] != kNone) return;
    known_[c] = static_cast<std::uint32_t>(own_vertices_.size());
    std::array<std::uint32_t, 5>& numbers = own_vertices_.emplace_back();
    for (std::size_t k = 0; k < kOwn.size(); ++k) numbers[k] = vertices_.add(vertexOf(c, kOwn[k]));
  }

  void split(std::uint32_t c) {
    const Square square = squares_[c];
    const std::uint32_t half = square.side() / 2;
    const std::uint32_t leaf = tree_.cells_[c].below;
    tree_.cells_[c] = {static_cast<std::uint32_t>(tree_.cells_.size()), false};
    for (unsigned k = 0; k < 4; ++k) {
      const auto child = static_cast<std::uint32_t>(tree_.cells_.size());
      tree_.cells_.push_back({});
      squares_.push_back({square.x + (k % 2) * half, square.y + (k / 2) * half, square.level + 1});
      if (leaf_cells_.empty()) {
        known_.push_back(kNone);
        continue;
      }
      // The first child takes its parent's number.
      tree_.cells_.back().below = k == 0 ? leaf : static_cast<std::uint32_t>(leaf_cells_.size());
      if (k == 0)
        leaf_cells_[leaf] = child;
      else
        leaf_cells_.push_back(child);
    }
  }

  bool isFull() {
    if (tree_.cells_.size() + 4 > options_.most_cells) tree_.complete_ = false;
    return !tree_.complete_;
  }

  // The vertices that cells require, from the ranges of their lengths: at least, and probably.
  struct Demand {
    double least = 0.0, likely = 0.0;
    double central = 0.0;     // from the lengths at the centres of cells, if known
    double most_here = -1.0;  // the largest `likely` of a cell
    SizeBox most_in;
    double size = 0.0;

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

  Demand demandOf(std::uint32_t c, const SizeRange& range) const {
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
    return {least, likely, central, likely, box, low};
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
    const std::vector<Demand> parts =
        overStretches(loop_, leaf_cells_.size(), [&](std::size_t first, std::size_t last) {
          Demand sum;
          for (std::size_t l = first; l < last; ++l) {
            if (!is_wanted_[l]) continue;
            const SizeBox box = boxOf(leaf_cells_[l]);
            const double share = source_.share(box);
            if (!(share > 0.0)) continue;
            Demand here{0.0, 0.0, 0.0, 0.0, box, kInfinity};
            forEachTriangle(leaf_vertices_[l], [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
              const double x = sizes_.size[a], y = sizes_.size[b], z = sizes_.size[c];
              const auto atMiddle = [](double p, double q) { return 4.0 / (p + q) / (p + q); };
              // Area on the surface over area in the plane.
              const auto shareOf = [&](std::uint32_t p, std::uint32_t q) {
                if (!options_.surface.isCurved()) return 1.0;
                const double shrink =
                    options_.surface.shrinkAt(tree_.origin_ + 0.5 * unit() * (gridPoint(p) + gridPoint(q)));
                return shrink * shrink;
              };
              const double area =
                  0.5 * unit() * unit() * std::abs(cross(gridPoint(b) - gridPoint(a), gridPoint(c) - gridPoint(a)));
              here.likely +=
                  kVerticesPerArea * share * area *
                  (shareOf(a, b) * atMiddle(x, y) + shareOf(b, c) * atMiddle(y, z) + shareOf(c, a) * atMiddle(z, x)) /
                  3.0;
              here.size = std::min({here.size, x, y, z});
            });
            here.most_here = here.likely;
            sum.add(here);
          }
          return sum;
        });
    Demand all;
    for (const Demand& part : parts) all.add(part);
    return {all.likely, all.most_in, all.size};
  }
  Point gridPoint(std::uint32_t v) const { return {1.0 * vertices_[v].x, 1.0 * vertices_[v].y}; }

  // Splits cells level by level, so that many places are evaluated at once.
  void refine() {
    std::uint32_t first = 0;
    std::vector<SizeBox> boxes;
    std::vector<SizeRange> ranges;
    std::vector<std::uint32_t> unsure;
    std::vector<SizeRange> unsure_ranges;
    std::vector<Demand> demands;
    Demand settled;  // of cells that are not split
    bool too_much = false;
    for (int level = 0; level < kLevels; ++level) {
      const auto end = static_cast<std::uint32_t>(tree_.cells_.size());
      for (std::uint32_t c = first; options_.surface.isCurved() && c < end && !isFull(); ++c)
        if (isStretched(boxOf(c), kAnyStretch)) split(c);
      const std::vector<std::uint32_t> wanted =
          joined(overStretches(loop_, end - first, [&](std::size_t from, std::size_t to) {
            std::vector<std::uint32_t> here;
            for (auto c = static_cast<std::uint32_t>(first + from); c < first + to; ++c)
              if (tree_.cells_[c].is_leaf && source_.isWanted(boxOf(c))) here.push_back(c);
            return here;
          }));
      if (wanted.empty() && tree_.cells_.size() == end) break;
      boxes.resize(wanted.size());
      forEachByStretches(loop_, wanted.size(), [&](std::size_t k) { boxes[k] = boxOf(wanted[k]); });
      ranges.resize(boxes.size());
      source_.bound(boxes, ranges);
      Demand pending = settled;
      demands.resize(wanted.size());
      forEachByStretches(loop_, wanted.size(), [&](std::size_t k) { demands[k] = demandOf(wanted[k], ranges[k]); });
      for (const Demand& demand : demands) pending.add(demand);
      // A few more cells cost nothing and improve the estimate.
      constexpr std::uint32_t kFewCells = 20'000;
      too_much |= isSurelyTooMuch(pending.likely) || pending.least > options_.most_vertices;
      // Bounds alone reveal a slight excess only when the tree is nearly complete.
      if (isTooMuchOnAverage(pending.central) && end >= kFewCells) {
        pending.least = std::max(pending.least, pending.central);
        return abandon(pending);
      }
      if (too_much && end >= kFewCells) return abandon(pending);
      unsure.clear();
      unsure_ranges.clear();
      for (std::size_t k = 0; k < wanted.size() && !isFull(); ++k) {
        const double low = ranges[k].low, high = ranges[k].high;
        if (!(high > low * (1.0 + toleranceOf(ranges[k])))) continue;
        const double side = sideOf(boxes[k]);
        if (side > options_.coarsest * low || isStretched(boxes[k], kGradedStretch)) {
          split(wanted[k]);
        } else if (side > (ranges[k].is_graded ? options_.finest_graded : options_.finest) * low) {
          unsure.push_back(wanted[k]);
          unsure_ranges.push_back(ranges[k]);
        }
      }
      splitWhereBent(unsure, unsure_ranges);
      if (!tree_.complete_) return abandon(pending);
      for (std::size_t k = 0; k < wanted.size(); ++k)
        if (tree_.cells_[wanted[k]].is_leaf) settled.add(demands[k]);
      first = end;
    }
    if (too_much) abandon(settled);
  }

  double toleranceOf(const SizeRange& range) const {
    return range.is_graded ? options_.tolerance_graded : options_.tolerance;
  }

  // Splits cells whose centre or sides differ from interpolation between the corners, or that contain something much
  // smaller than all of these.
  void splitWhereBent(const std::vector<std::uint32_t>& cells, const std::vector<SizeRange>& ranges) {
    std::vector<std::array<std::uint32_t, 4>> middles(cells.size());
    for (std::size_t k = 0; k < cells.size(); ++k) {
      constexpr std::size_t kAhead = 6;
      if (k + 2 * kAhead < cells.size()) {
        for (const unsigned i : kMiddles) {
          vertices_.fetchSlot(vertexOf(cells[k + 2 * kAhead], i));
          vertices_.fetchPlace(vertexOf(cells[k + kAhead], i));
        }
      }
      addOwnVertices(cells[k]);
      if (!std::isnan(ranges[k].at_centre))
        told_.push_back({own_vertices_[known_[cells[k]]][kCentre], ranges[k].at_centre});
      for (std::size_t i = 0; i < kMiddles.size(); ++i) middles[k][i] = vertices_.add(vertexOf(cells[k], kMiddles[i]));
    }
    sample();
    const auto isBent = [&](std::size_t k) {
      std::array<double, 9> v;
      for (std::size_t i = 0; i < kOwn.size(); ++i) v[kOwn[i]] = sizes_.own[own_vertices_[known_[cells[k]]][i]];
      for (std::size_t i = 0; i < kMiddles.size(); ++i) v[kMiddles[i]] = sizes_.own[middles[k][i]];
      // The error of four triangles; eight have about half of it.
      double off = std::abs(0.25 * (v[0] + v[2] + v[6] + v[8]) - v[4]);
      off = 0.5 * std::max({off, std::abs(0.5 * (v[0] + v[2]) - v[1]), std::abs(0.5 * (v[0] + v[6]) - v[3]),
                            std::abs(0.5 * (v[2] + v[8]) - v[5]), std::abs(0.5 * (v[6] + v[8]) - v[7])});
      const double least = std::ranges::min(v), side = sideOf(boxOf(cells[k]));
      if (least > kHidden * ranges[k].low) return true;
      return std::isfinite(off) ? off * side > toleranceOf(ranges[k]) * least * least : std::isfinite(least);
    };
    const std::vector<std::uint32_t> bent =
        joined(overStretches(loop_, cells.size(), [&](std::size_t first, std::size_t last) {
          std::vector<std::uint32_t> here;
          for (std::size_t k = first; k < last; ++k)
            if (isBent(k)) here.push_back(static_cast<std::uint32_t>(k));
          return here;
        }));
    for (const std::uint32_t k : bent) {
      if (isFull()) return;
      LeafVertices around;
      for (std::size_t i = 0; i < kOwn.size(); ++i) around[kOwn[i]] = own_vertices_[known_[cells[k]]][i];
      for (std::size_t i = 0; i < kMiddles.size(); ++i) around[kMiddles[i]] = middles[k][i];
      split(cells[k]);
      // Four of each child's vertices already have a number.
      for (std::uint32_t child = 0; child < 4; ++child) {
        const std::uint32_t c = tree_.cells_[cells[k]].below + child, first = child % 2 + 3 * (child / 2);
        known_[c] = static_cast<std::uint32_t>(own_vertices_.size());
        own_vertices_.push_back(
            {around[first], around[first + 1], vertices_.add(vertexOf(c, 4)), around[first + 3], around[first + 4]});
      }
    }
  }

  // Samples sizes at new vertices, except those that bounds have already provided.
  void sample() {
    const std::size_t known = sizes_.own.size();
    sizes_.own.resize(vertices_.size(), kUnasked);
    for (const auto& [v, size] : told_) sizes_.own[v] = size;
    told_.clear();
    const std::vector<std::uint32_t> asked =
        joined(overStretches(loop_, vertices_.size() - known, [&](std::size_t first, std::size_t last) {
          std::vector<std::uint32_t> here;
          for (auto v = static_cast<std::uint32_t>(known + first); v < known + last; ++v)
            if (sizes_.own[v] == kUnasked) here.push_back(v);
          return here;
        }));
    std::vector<Point> places(asked.size());
    forEachByStretches(loop_, asked.size(), [&](std::size_t k) { places[k] = placeOf(vertices_[asked[k]]); });
    std::vector<double> sizes(places.size());
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

  // Splits leaves until adjacent ones differ by at most one level. REQUIRES: leaves before cell `first` already do.
  void balance(std::size_t first) {
    std::vector<std::uint32_t> waiting =
        joined(overStretches(loop_, tree_.cells_.size() - first, [&](std::size_t from, std::size_t to) {
          std::vector<std::uint32_t> here;
          for (auto c = static_cast<std::uint32_t>(first + from); c < first + to; ++c)
            if (tree_.cells_[c].is_leaf && tooLargeBeside(c) != kNone) here.push_back(c);
          return here;
        }));
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
    const auto list = [&](const auto& self, std::uint32_t c) -> void {
      SizeTree::Cell& cell = tree_.cells_[c];
      if (!cell.is_leaf) {
        for (std::uint32_t k = 0; k < 4; ++k) self(self, cell.below + k);
        return;
      }
      cell.below = static_cast<std::uint32_t>(leaf_cells_.size());
      leaf_cells_.push_back(c);
    };
    list(list, 0);
    for (const std::uint32_t c : leaf_cells_) addOwnVertices(c);
    sample();
    is_wanted_.resize(leaf_cells_.size());
    leaf_vertices_.resize(leaf_cells_.size());
    forEachByStretches(loop_, leaf_cells_.size(), [&](std::size_t l) {
      const std::uint32_t c = leaf_cells_[l];
      is_wanted_[l] = source_.isWanted(boxOf(c));
      for (std::size_t k = 0; k < kOwn.size(); ++k) leaf_vertices_[l][kOwn[k]] = own_vertices_[known_[c]][k];
      findMiddles(static_cast<std::uint32_t>(l));
    });
    freeMemoryOf(known_);
    freeMemoryOf(own_vertices_);
    putInOrder();
    sizes_.size.reserve(sizes_.own.capacity());
    sizes_.source.reserve(sizes_.own.capacity());
    sizes_.size = sizes_.own;
    sizes_.source.assign(vertices_.size(), kNone);
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
    std::vector<std::uint32_t> order, numbers(vertices_.size(), kNone);
    order.reserve(vertices_.size());
    const auto numberOf = [&](std::uint32_t v) {
      if (numbers[v] != kNone) return numbers[v];
      order.push_back(v);
      return numbers[v] = static_cast<std::uint32_t>(order.size() - 1);
    };
    for (LeafVertices& leaf : leaf_vertices_)
      for (std::uint32_t& v : leaf)
        if (v != kNone) v = numberOf(v);
    for (std::uint32_t v = 0; v < vertices_.size(); ++v) numberOf(v);
    vertices_.reorder(order);
    std::vector<double> own;
    own.reserve(order.size() + order.size() / kSpare);
    own.resize(order.size());
    forEachByStretches(loop_, order.size(), [&](std::size_t v) { own[v] = sizes_.own[order[v]]; });
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
    std::vector<SizeTree::Cell> cells;
    cells.reserve(tree_.cells_.size());
    cells.push_back({});
    std::vector<std::uint32_t> places(leaf_cells_.size());
    std::uint32_t leaves = 0;
    const auto lay = [&](const auto& self, std::uint32_t c, std::size_t to) -> void {
      const std::uint32_t below = tree_.cells_[c].below;
      if (tree_.cells_[c].is_leaf) {
        cells[to] = {leaves, true};
        places[below] = leaves++;
        return;
      }
      const std::size_t first = cells.size();
      cells[to] = {static_cast<std::uint32_t>(first), false};
      cells.resize(first + 4);
      for (std::uint32_t k = 0; k < 4; ++k) self(self, below + k, first + k);
    };
    lay(lay, 0, 0);
    tree_.cells_ = std::move(cells);
    tree_.leaves_.resize(leaf_vertices_.size());
    const std::vector<SizeRange> parts =
        overStretches(loop_, leaf_vertices_.size(), [&](std::size_t first, std::size_t last) {
          SizeRange range{kInfinity, 0.0};
          for (std::size_t l = first; l < last; ++l) {
            for (unsigned i = 0; i < 9; ++i) {
              const std::uint32_t v = leaf_vertices_[l][i];
              tree_.leaves_[places[l]][i] = v == kNone ? std::nanf("") : static_cast<float>(sizes_.size[v]);
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
  const ItemLoop& loop_;
  std::vector<Square> squares_;                             // one for each cell
  std::vector<std::uint32_t> known_;                        // for each cell: index in own_vertices_, or kNone
  std::vector<std::array<std::uint32_t, 5>> own_vertices_;  // numbers, in the order of kOwn
  SizePlaces vertices_;                                     // in units; some are of cells that were split
  GradedSizes sizes_;                                       // at the vertices
  struct Told {
    std::uint32_t vertex;
    double size;
  };
  std::vector<Told> told_;  // sizes that bounds have provided since `sample`
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
