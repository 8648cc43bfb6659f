#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gis/box_tree.hpp"

namespace coastmesh {

// A spatial index of edges that mostly follow one another, as those of rings do: a tree over runs of up to kLongest edges whose
// boxes meet, so that there is an eighth of boxes to sort and to keep. `box_of(e)` is the box of edge e, the same at
// every call. Private to gis.
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

  std::size_t runCount() const { return boxes_.size(); }
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

  // Calls `found(e, f)` once, e < f, for every two edges of which `active(e)` holds for one at least and whose boxes come
  // nearer to one another than `margin`; for runs [first, last) and what lies near them: each pair is found from one
  // run.
  template <typename BoxOf, typename Active, typename Found>
  void visitPairs(std::size_t first, std::size_t last, double margin, BoxOf&& box_of, Active&& active,
                  Found&& found) const {
    std::uint32_t of_run[kLongest];
    Box box_of_run[kLongest];
    for (auto run = static_cast<std::uint32_t>(first); run < last; ++run) {
      if (!anyActive(run, active)) continue;
      std::size_t size = 0;
      for (std::uint32_t e = begin_[run]; e < begin_[run + 1]; ++e) {
        of_run[size] = e;
        box_of_run[size++] = box_of(e).grownBy(margin);
      }
      tree_.visit(boxes_[run].grownBy(margin), [&](std::uint32_t other) {
        if (other < run && anyActive(other, active)) return;  // found from there
        for (std::size_t i = 0; i < size; ++i) {
          if (!box_of_run[i].meets(boxes_[other])) continue;
          const std::uint32_t e = of_run[i];
          for (std::uint32_t f = other == run ? e + 1 : begin_[other]; f < begin_[other + 1]; ++f) {
            if (!box_of_run[i].meets(box_of(f)) || (!active(e) && !active(f))) continue;
            found(std::min(e, f), std::max(e, f));
          }
        }
      });
    }
  }

 private:
  static constexpr std::uint32_t kLongest = 8;

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
