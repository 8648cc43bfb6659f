#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/metric.hpp"
#include "core/point.hpp"

namespace coastmesh {

// Two numbers that one instruction processes. Each has the bits of the same operation on it alone.
using DoublePair [[gnu::vector_size(16)]] = double;

// The same at any address of two doubles.
using LooseDoublePair [[gnu::vector_size(16), gnu::aligned(8), gnu::may_alias]] = double;

inline DoublePair pairAt(const double* first) { return *reinterpret_cast<const LooseDoublePair*>(first); }
inline void putPair(double* first, DoublePair pair) { *reinterpret_cast<LooseDoublePair*>(first) = pair; }

inline DoublePair larger(DoublePair a, DoublePair b) { return a > b ? a : b; }
inline DoublePair smaller(DoublePair a, DoublePair b) { return a < b ? a : b; }
inline double larger(double a, double b) { return a > b ? a : b; }
inline double smaller(double a, double b) { return a < b ? a : b; }

// A link edge with what tests of its constraints need.
struct LookEdge {
  Point from, to, along;
  double squared;  // length
};

// Two of them side by side.
struct LookEdgePair {
  DoublePair from_x, from_y, to_x, to_y, along_x, along_y, squared;
  DoublePair inverse;  // of that; set where it is needed
};

// Some link edges, in pairs.
class LookEdges {
 public:
  void clear() { count_ = 0; }
  std::size_t size() const { return count_; }

  void push(const LookEdge& e) {
    const std::size_t at = count_ / 2;
    if (at == pairs_.size()) pairs_.emplace_back();
    put(e, pairs_[at], count_ % 2);
    ++count_;
  }
  // The edges of a loop of at least three corners, of which edge k leads to corner k.
  template <typename Corner>
  void takeLoop(std::size_t count, const Corner& corner) {
    count_ = count;
    if (2 * pairs_.size() < count) pairs_.resize((count + 1) / 2);
    Point before = corner(count - 1);
    LookEdgePair* pair = pairs_.data();
    for (std::size_t k = 0; k < count; k += 2, ++pair) {
      const Point here = corner(k);
      const bool alone = k + 1 == count;
      const Point after = alone ? here : corner(k + 1), middle = alone ? before : here;
      *pair = pairOf({before, here}, {middle, after});
      before = after;
    }
  }
  // REQUIRES: there is an edge. If their number is odd, the last one fills its pair.
  std::span<LookEdgePair> pairs() {
    const std::size_t used = (count_ + 1) / 2;
    if (count_ % 2 == 1) put((*this)[count_ - 1], pairs_[used - 1], 1);
    return {pairs_.data(), used};
  }
  LookEdge operator[](std::size_t i) const {
    const LookEdgePair& p = pairs_[i / 2];
    const std::size_t lane = i % 2;
    return {{p.from_x[lane], p.from_y[lane]},
            {p.to_x[lane], p.to_y[lane]},
            {p.along_x[lane], p.along_y[lane]},
            p.squared[lane]};
  }

 private:
  struct Ends {
    Point from, to;
  };
  static LookEdgePair pairOf(const Ends& one, const Ends& other) {
    LookEdgePair p{};
    p.from_x = DoublePair{one.from.x, other.from.x};
    p.from_y = DoublePair{one.from.y, other.from.y};
    p.to_x = DoublePair{one.to.x, other.to.x};
    p.to_y = DoublePair{one.to.y, other.to.y};
    p.along_x = p.to_x - p.from_x;
    p.along_y = p.to_y - p.from_y;
    p.squared = p.along_x * p.along_x + p.along_y * p.along_y;
    return p;
  }
  static void put(const LookEdge& e, LookEdgePair& p, std::size_t lane) {
    p.from_x[lane] = e.from.x;
    p.from_y[lane] = e.from.y;
    p.to_x[lane] = e.to.x;
    p.to_y[lane] = e.to.y;
    p.along_x[lane] = e.along.x;
    p.along_y[lane] = e.along.y;
    p.squared[lane] = e.squared;
  }

  std::vector<LookEdgePair> pairs_;  // at least as many as needed
  std::size_t count_ = 0;
};

}  // namespace coastmesh
