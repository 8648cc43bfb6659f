#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/item_loop.hpp"

namespace coastmesh {

// Disjoint sets of 0..n-1; a set's root is its smallest member.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    if (a > b) std::swap(a, b);
    parent_[b] = a;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// Disjoint sets that several threads may unite at the same time; the roots are the same as those of UnionFind. After
// Anderson & Woll, "Wait-free parallel algorithms for the union-find problem" (1991).
class SharedUnionFind {
 public:
  SharedUnionFind(std::size_t n, const ItemLoop& loop) {
    resizeUnset(parent_, n);
    forEachByStretches(loop, n, [this](std::size_t i) { parent_[i] = static_cast<std::uint32_t>(i); });
  }

  std::uint32_t find(std::uint32_t i) {
    for (;;) {
      const std::uint32_t above = at(i), top = at(above);
      if (top == above) return above;
      // Halves the path. Whatever another thread has written here since leads to the same root.
      __atomic_store_n(&parent_[i], top, __ATOMIC_RELAXED);
      i = top;
    }
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    for (;;) {
      a = find(a), b = find(b);
      if (a == b) return;
      if (a > b) std::swap(a, b);
      std::uint32_t root = b;  // unless another thread has united it meanwhile
      if (__atomic_compare_exchange_n(&parent_[b], &root, a, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) return;
    }
  }

 private:
  std::uint32_t at(std::uint32_t i) const { return __atomic_load_n(&parent_[i], __ATOMIC_RELAXED); }

  BulkList<std::uint32_t> parent_;
};

}  // namespace coastmesh
