#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

// A spatial index of edges that are mostly connected in sequence, as in rings: a tree over runs of up to kLongest edges
// whose consecutive boxes meet, so that it sorts and stores an eighth of the boxes. `box_of(e)` is the box of edge e,
// the same at every call.
class EdgeRuns {
 public:
  template <typename BoxOf>
  EdgeRuns(std::size_t count, BoxOf&& box_of) {
    std::vector<Box> boxes;
    boxes.reserve(count / kLongest + 1);
    begin_.reserve(count / kLongest + 2);
    Box last;
    for (std::size_t e = 0; e < count; ++e) {
      const Box box = box_of(e);
      if (e == 0 || e - begin_.back() == kLongest || !box.meets(last)) {
        begin_.push_back(static_cast<std::uint32_t>(e));
        boxes.push_back(box);
      } else {
        boxes.back().add(box);
      }
      last = box;
    }
    begin_.push_back(static_cast<std::uint32_t>(count));
    tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
    boxes_ = std::move(boxes);
  }

  Box bounds() const { return tree_.bounds(); }

  // Calls `found(e)` for every edge whose box meets `query`.
  template <typename BoxOf, typename Found>
  void visit(const Box& query, BoxOf&& box_of, Found&& found) const {
    tree_.visit(query, [&](std::uint32_t run) {
      for (std::uint32_t e = begin_[run]; e < begin_[run + 1]; ++e) {
        if (box_of(e).meets(query)) found(e);
      }
    });
  }

  // The number of blocks of nearby runs, and the least number worth a call of `visitPairs`.
  std::size_t blockCount() const { return tree_.blockCount(); }
  static constexpr std::size_t kWorthAStretch = 128;

  // Calls `found(e, f)`, e < f, for pairs of edges of which at least one is `active` and whose boxes, one of them grown
  // by `margin`, meet. Covers the runs of blocks [first, last) and the runs near them. Each pair is found from one run
  // only, so that calls for all blocks together find it once.
  template <typename BoxOf, typename Active, typename Found>
  void visitPairs(std::size_t first, std::size_t last, double margin, BoxOf&& box_of, Active&& active,
                  Found&& found) const {
    Some own, near_other, others;
    std::vector<std::uint32_t> near;
    for (std::size_t block = first; block < last; ++block) {
      const std::span<const std::uint32_t> runs = tree_.block(block);
      Box around_all;
      for (const std::uint32_t run : runs) around_all.add(boxes_[run]);
      near.clear();
      tree_.visit(around_all.grownBy(margin), [&](std::uint32_t run) { near.push_back(run); });
      for (const std::uint32_t run : runs) {
        if (!anyActive(run, active)) continue;
        own.take(begin_[run], begin_[run + 1], [&](std::uint32_t e) { return box_of(e).grownBy(margin); });
        pairsWithin(own, box_of, active, found);
        const Box around = boxes_[run].grownBy(margin);
        for (const std::uint32_t other : near) {
          if (other == run || !boxes_[other].meets(around)) continue;
          if (other < run && anyActive(other, active)) continue;  // found from there
          near_other.takeThose(own, boxes_[other]);
          if (near_other.size == 0) continue;
          others.takeThose(begin_[other], begin_[other + 1], near_other.bounds(), box_of);
          pairsBetween(near_other, others, active, found);
        }
      }
    }
  }

 private:
  static constexpr std::uint32_t kLongest = 8;

  // Edges of a run and their boxes.
  struct Some {
    std::size_t size = 0;
    std::uint32_t edge[kLongest];
    Box box[kLongest];

    Box bounds() const {
      Box bounds;
      for (std::size_t i = 0; i < size; ++i) bounds.add(box[i]);
      return bounds;
    }
    template <typename BoxOf>
    void take(std::uint32_t begin, std::uint32_t end, BoxOf&& box_of) {
      size = 0;
      for (std::uint32_t e = begin; e < end; ++e) {
        edge[size] = e;
        box[size] = box_of(e);
        ++size;
      }
    }
    void takeThose(const Some& some, const Box& around) {
      size = 0;
      for (std::size_t i = 0; i < some.size; ++i) {
        edge[size] = some.edge[i];
        box[size] = some.box[i];
        size += box[size].meets(around) ? 1 : 0;
      }
    }
    template <typename BoxOf>
    void takeThose(std::uint32_t begin, std::uint32_t end, const Box& around, BoxOf&& box_of) {
      size = 0;
      for (std::uint32_t e = begin; e < end; ++e) {
        edge[size] = e;
        box[size] = box_of(e);
        size += box[size].meets(around) ? 1 : 0;
      }
    }
  };

  template <typename BoxOf, typename Active, typename Found>
  static void pairsWithin(const Some& own, BoxOf& box_of, Active& active, Found& found) {
    for (std::size_t i = 0; i < own.size; ++i) {
      for (std::size_t j = i + 1; j < own.size; ++j) {
        const std::uint32_t e = own.edge[i], f = own.edge[j];
        if (own.box[i].meets(box_of(f)) && (active(e) || active(f))) found(e, f);
      }
    }
  }

  template <typename Active, typename Found>
  static void pairsBetween(const Some& own, const Some& others, Active& active, Found& found) {
    for (std::size_t i = 0; i < own.size; ++i) {
      for (std::size_t j = 0; j < others.size; ++j) {
        const std::uint32_t e = own.edge[i], f = others.edge[j];
        if (own.box[i].meets(others.box[j]) && (active(e) || active(f))) found(std::min(e, f), std::max(e, f));
      }
    }
  }

  template <typename Active>
  bool anyActive(std::uint32_t run, Active& active) const {
    for (std::uint32_t e = begin_[run]; e < begin_[run + 1]; ++e) {
      if (active(e)) return true;
    }
    return false;
  }

  std::vector<std::uint32_t> begin_;  // first edge of each run, and the end
  std::vector<Box> boxes_;            // by run
  BoxTree tree_;
};

}  // namespace coastmesh
