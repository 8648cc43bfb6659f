#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "core/ids.hpp"
#include "core/metric.hpp"
#include "core/size_grading.hpp"
#include "core/size_tree.hpp"

namespace coastmesh {

namespace {

// Where the least size in a cell is known to be less than that at its corners, sides and centre by this factor, something small lies
// between them. Bounds of what grows with a distance are off by less.
constexpr double kHidden = 1.5;
constexpr int kLevels = 24;
constexpr std::uint32_t kUnits = 1u << (kLevels + 1);  // of the root's side: a leaf of the last level has a centre

struct Square {
  std::uint32_t x = 0, y = 0;  // of the lower left corner, in units
  int level = 0;
  std::uint32_t side() const { return kUnits >> level; }
};

std::uint64_t keyOf(std::uint32_t x, std::uint32_t y) { return (std::uint64_t{y} << 32) | x; }

}  // namespace

class SizeTreeBuilder {
 public:
  SizeTreeBuilder(SizeTree& tree, const SizeSource& source, const SizeTreeOptions& options)
      : tree_(tree), source_(source), options_(options) {}

  void build() {
    tree_.cells_.push_back({});
    squares_.push_back({});
    refine();
    balance();
    number();
    sampleVertices();
    const std::vector<double> own = vertices_;
    tree_.slope_ = kSizeGrowth * options_.grade;
    const std::vector<std::uint32_t> sources = gradeSizes(vertices_, places_, leaf_vertices_, options_.grade);
    fill();
    if (!sources.empty()) fillCaps(sources, own);
    makeStart();
  }

 private:
  double unit() const { return tree_.side_ / kUnits; }
  Point placeOf(std::uint32_t x, std::uint32_t y) const {
    return {tree_.origin_.x + unit() * x, tree_.origin_.y + unit() * y};
  }

  void split(std::uint32_t c) {
    const Square square = squares_[c];
    const std::uint32_t half = square.side() / 2;
    tree_.cells_[c] = {static_cast<std::uint32_t>(tree_.cells_.size()), false};
    for (unsigned k = 0; k < 4; ++k) {
      tree_.cells_.push_back({});
      squares_.push_back({square.x + (k % 2) * half, square.y + (k / 2) * half, square.level + 1});
    }
  }

  bool isFull() {
    if (tree_.cells_.size() + 4 > options_.most_cells) tree_.complete_ = false;
    return !tree_.complete_;
  }

  // Level by level, so that many places are asked for at once.
  void refine() {
    std::uint32_t first = 0;
    std::vector<SizeBox> boxes;
    std::vector<SizeRange> ranges;
    std::vector<Point> places;
    std::vector<double> sizes;
    std::vector<std::uint32_t> unsure;
    std::vector<double> lows;  // of the unsure ones
    for (int level = 0; level < kLevels; ++level) {
      const auto end = static_cast<std::uint32_t>(tree_.cells_.size());
      if (first == end) return;
      boxes.clear();
      for (std::uint32_t c = first; c < end; ++c) {
        const Square& s = squares_[c];
        boxes.push_back({placeOf(s.x + s.side() / 2, s.y + s.side() / 2), 0.5 * unit() * s.side()});
      }
      ranges.resize(boxes.size());
      source_.bound(boxes, ranges);
      unsure.clear();
      lows.clear();
      for (std::uint32_t c = first; c < end && !isFull(); ++c) {
        const auto [low, high] = ranges[c - first];
        if (!(high > low * (1.0 + options_.tolerance))) continue;
        const double side = 2.0 * boxes[c - first].half;
        if (side > options_.coarsest * low) {
          split(c);
        } else if (side > options_.finest * low) {
          unsure.push_back(c);
          lows.push_back(low);
        }
      }
      splitWhereBent(unsure, lows, places, sizes);
      first = end;
    }
  }

  // Splits cells whose centre or sides are not what the corners tell, or that hold something much smaller than all of these.
  void splitWhereBent(const std::vector<std::uint32_t>& cells, const std::vector<double>& lows,
                      std::vector<Point>& places, std::vector<double>& sizes) {
    places.clear();
    for (const std::uint32_t c : cells) {
      const Square& s = squares_[c];
      for (unsigned i = 0; i < 9; ++i)
        places.push_back(placeOf(s.x + (i % 3) * (s.side() / 2), s.y + (i / 3) * (s.side() / 2)));
    }
    sizes.resize(places.size());
    source_.sample(places, sizes);
    for (std::size_t k = 0; k < cells.size() && !isFull(); ++k) {
      const double* v = sizes.data() + 9 * k;
      const double centre = v[4];
      const double corners = 0.25 * (v[0] + v[2] + v[6] + v[8]);
      double off = std::abs(corners - centre);
      off = std::max({off, std::abs(0.5 * (v[0] + v[2]) - v[1]), std::abs(0.5 * (v[0] + v[6]) - v[3]),
                      std::abs(0.5 * (v[2] + v[8]) - v[5]), std::abs(0.5 * (v[6] + v[8]) - v[7])});
      const double least = *std::min_element(v, v + 9);
      const bool is_bent = std::isfinite(off) ? off > options_.tolerance * centre : std::isfinite(least);
      if (is_bent || least > kHidden * lows[k]) split(cells[k]);
    }
  }

  // The cell that holds the unit square with this lower left corner, no deeper than `level`.
  std::uint32_t find(std::uint32_t x, std::uint32_t y, int level) const {
    std::uint32_t c = 0;
    for (int l = 1; l <= level && !tree_.cells_[c].is_leaf; ++l) {
      const std::uint32_t half = kUnits >> l;
      c = tree_.cells_[c].below + ((x & half) != 0) + 2 * ((y & half) != 0);
    }
    return c;
  }

  // Splits leaves until those side by side differ by one level at most.
  void balance() {
    std::vector<std::uint32_t> waiting;
    for (std::uint32_t c = 0; c < tree_.cells_.size(); ++c)
      if (tree_.cells_[c].is_leaf) waiting.push_back(c);
    std::ranges::stable_sort(waiting,
                             [&](std::uint32_t a, std::uint32_t b) { return squares_[a].level < squares_[b].level; });
    while (!waiting.empty()) {
      const std::uint32_t c = waiting.back();
      waiting.pop_back();
      if (!tree_.cells_[c].is_leaf) continue;
      const Square s = squares_[c];
      for (int k = 0; k < 4; ++k) {
        const std::int64_t x = std::int64_t{s.x} + (k == 0 ? -1 : k == 1 ? std::int64_t{s.side()} : 0);
        const std::int64_t y = std::int64_t{s.y} + (k == 2 ? -1 : k == 3 ? std::int64_t{s.side()} : 0);
        if (x < 0 || y < 0 || x >= kUnits || y >= kUnits) continue;
        const std::uint32_t beside = find(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), s.level);
        if (!tree_.cells_[beside].is_leaf || squares_[beside].level + 1 >= s.level) continue;
        split(beside);
        for (std::uint32_t child = 0; child < 4; ++child) waiting.push_back(tree_.cells_[beside].below + child);
        waiting.push_back(c);
        break;
      }
    }
  }

  // Numbers leaves, and their corners and centres; the middle of a side only where smaller leaves meet it there.
  void number() {
    std::unordered_map<std::uint64_t, std::uint32_t> numbers;
    std::vector<std::uint32_t> leaf_cells;
    for (std::uint32_t c = 0; c < tree_.cells_.size(); ++c) {
      if (!tree_.cells_[c].is_leaf) continue;
      tree_.cells_[c].below = static_cast<std::uint32_t>(leaf_cells.size());
      leaf_cells.push_back(c);
    }
    numbers.reserve(2 * leaf_cells.size());
    const auto numberOf = [&](std::uint32_t x, std::uint32_t y) {
      const auto [entry, fresh] = numbers.try_emplace(keyOf(x, y), static_cast<std::uint32_t>(places_.size()));
      if (fresh) places_.push_back(placeOf(x, y));
      return entry->second;
    };
    leaf_vertices_.resize(leaf_cells.size());
    for (std::size_t l = 0; l < leaf_cells.size(); ++l) {
      const Square& s = squares_[leaf_cells[l]];
      const std::uint32_t half = s.side() / 2;
      for (const unsigned i : {0u, 2u, 6u, 8u})
        leaf_vertices_[l][i] = numberOf(s.x + (i % 3) * half, s.y + (i / 3) * half);
      leaf_vertices_[l][4] = static_cast<std::uint32_t>(places_.size());
      places_.push_back(placeOf(s.x + half, s.y + half));
    }
    for (std::size_t l = 0; l < leaf_cells.size(); ++l) {
      const Square& s = squares_[leaf_cells[l]];
      const std::uint32_t half = s.side() / 2;
      for (const unsigned i : {1u, 3u, 5u, 7u}) {
        const auto entry = numbers.find(keyOf(s.x + (i % 3) * half, s.y + (i / 3) * half));
        leaf_vertices_[l][i] = entry == numbers.end() ? kNone : entry->second;
      }
    }
    squares_ = {};
  }

  void sampleVertices() {
    vertices_.resize(places_.size());
    source_.sample(places_, vertices_);
    // Where nothing is wanted: as large as the whole.
    for (double& size : vertices_)
      if (!(size < tree_.side_)) size = tree_.side_;
  }

  void fill() {
    tree_.leaves_.resize(leaf_vertices_.size());
    float least = std::numeric_limits<float>::max(), most = 0.0F;
    for (std::size_t l = 0; l < leaf_vertices_.size(); ++l) {
      const LeafVertices& from = leaf_vertices_[l];
      SizeTree::Leaf& to = tree_.leaves_[l];
      for (const unsigned i : {0u, 2u, 4u, 6u, 8u}) to[i] = static_cast<float>(vertices_[from[i]]);
      const auto middle = [&](unsigned i, unsigned a, unsigned b) {
        to[i] = from[i] == kNone ? 0.5F * (to[a] + to[b]) : static_cast<float>(vertices_[from[i]]);
      };
      middle(1, 0, 2);
      middle(3, 0, 6);
      middle(5, 2, 8);
      middle(7, 6, 8);
      for (const float size : to) {
        least = std::min(least, size);
        most = std::max(most, size);
      }
    }
    tree_.least_ = least;
    tree_.most_ = most;
  }

  void fillCaps(const std::vector<std::uint32_t>& sources, const std::vector<double>& own) {
    std::vector<std::uint32_t> here;
    for (const LeafVertices& leaf : leaf_vertices_) {
      tree_.first_cap_.push_back(static_cast<std::uint32_t>(tree_.caps_.size()));
      here.clear();
      for (const std::uint32_t v : leaf)
        if (v != kNone && sources[v] != kNone) here.push_back(sources[v]);
      std::ranges::sort(here);
      here.erase(std::unique(here.begin(), here.end()), here.end());
      for (const std::uint32_t v : here) tree_.caps_.push_back({places_[v], own[v]});
    }
    tree_.first_cap_.push_back(static_cast<std::uint32_t>(tree_.caps_.size()));
  }

  void makeStart() {
    constexpr std::uint32_t kStarts = 1u << SizeTree::kStartLevels;
    tree_.start_.resize(std::size_t{kStarts} * kStarts);
    tree_.start_level_.resize(tree_.start_.size());
    for (std::uint32_t j = 0; j < kStarts; ++j) {
      for (std::uint32_t i = 0; i < kStarts; ++i) {
        std::uint32_t c = 0;
        std::uint8_t level = 0;
        for (; level < SizeTree::kStartLevels && !tree_.cells_[c].is_leaf; ++level) {
          const std::uint32_t half = kStarts >> (level + 1);
          c = tree_.cells_[c].below + ((i & half) != 0) + 2 * ((j & half) != 0);
        }
        tree_.start_[(std::size_t{j} << SizeTree::kStartLevels) + i] = c;
        tree_.start_level_[(std::size_t{j} << SizeTree::kStartLevels) + i] = level;
      }
    }
  }

  SizeTree& tree_;
  const SizeSource& source_;
  const SizeTreeOptions& options_;
  std::vector<Square> squares_;  // one a cell
  std::vector<Point> places_;    // of the vertices of the triangles between cells' centres and sides
  std::vector<double> vertices_;
  std::vector<LeafVertices> leaf_vertices_;
};

SizeTree::SizeTree(const Point& low, const Point& high, const SizeSource& source, const SizeTreeOptions& options) {
  // A hair larger, so that nothing lies on the root's own sides.
  const double extent = std::max(high.x - low.x, high.y - low.y);
  side_ = 1.01 * (extent > 0.0 ? extent : 1.0);
  origin_ = midpoint(low, high) - Point{0.5 * side_, 0.5 * side_};
  SizeTreeBuilder(*this, source, options).build();
}

}  // namespace coastmesh
