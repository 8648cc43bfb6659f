#include "gis/rivers/river_overlaps.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "core/ids.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/geometry/chain_index.hpp"

namespace coastmesh {

namespace {

// A row of a reach, or a bank at a junction between two branches.
struct Item {
  std::uint32_t reach = 0;
  std::size_t row = 0;
  std::uint32_t junction = kNone;  // of a bank
  std::vector<std::pair<Point, Point>> edges;
};

class OverlapFinder {
 public:
  OverlapFinder(std::span<const RiverRows> rows, std::span<const RiverJunction> junctions)
      : rows_(rows), junctions_(junctions) {
    for (std::uint32_t reach = 0; reach < rows.size(); ++reach)
      for (std::size_t row = 0; row + 1 < rows[reach].sections.size(); ++row) addRow(reach, row);
    for (std::uint32_t j = 0; j < junctions.size(); ++j) addBanks(j);
  }

  std::vector<RiverOverlap> find() {
    std::vector<Box> boxes;
    for (const Item& item : items_) {
      Box& box = boxes.emplace_back();
      for (const auto& [a, b] : item.edges) {
        box.add(a);
        box.add(b);
      }
    }
    const BoxTree tree(boxes, BoxTree::Order::Hilbert);
    std::map<std::pair<std::uint32_t, std::uint32_t>, Point> found;
    for (std::uint32_t i = 0; i < items_.size(); ++i) {
      tree.visit(boxes[i], [&](std::uint32_t k) {
        if (k <= i || !mayOverlap(items_[i], items_[k]) || !meet(items_[i], items_[k])) return;
        const auto [first, second] = std::minmax(items_[i].reach, items_[k].reach);
        found.try_emplace({first, second}, items_[i].edges.front().first);
      });
    }
    std::vector<RiverOverlap> overlaps;
    for (const auto& [pair, place] : found) overlaps.push_back({pair.first, pair.second, place});
    return overlaps;
  }

 private:
  void addRow(std::uint32_t reach, std::size_t row) {
    const RiverSection &a = rows_[reach].sections[row], &b = rows_[reach].sections[row + 1];
    const std::array<Point, 4> corners{a.at(0.0), b.at(0.0), b.at(1.0), a.at(1.0)};
    Item& item = items_.emplace_back(Item{reach, row, kNone, {}});
    for (std::size_t i = 0; i < corners.size(); ++i) item.edges.emplace_back(corners[i], corners[(i + 1) % 4]);
  }

  void addBanks(std::uint32_t j) {
    const std::vector<RiverBranch>& branches = junctions_[j].branches;
    for (std::size_t i = 0; i < branches.size(); ++i) {
      const RiverBranch &branch = branches[i], &next = branches[(i + 1) % branches.size()];
      if (rows_[branch.reach].sections.empty() || rows_[next.reach].sections.empty()) continue;
      items_.push_back({branch.reach, 0, j, {{endOf(branch).at(1.0), endOf(next).at(0.0)}}});
    }
  }

  // The last section of a branch before its junction, as seen from there.
  RiverSection endOf(const RiverBranch& branch) const {
    const std::vector<RiverSection>& sections = rows_[branch.reach].sections;
    RiverSection end = branch.at_end ? sections.back() : sections.front();
    if (branch.at_end) end.left = {-end.left.x, -end.left.y};
    return end;
  }

  bool isBranchOf(std::uint32_t reach, std::uint32_t junction) const {
    return std::ranges::any_of(junctions_[junction].branches,
                               [&](const RiverBranch& branch) { return branch.reach == reach; });
  }

  // False for what adjoins: rows that follow one another, and a junction with its branches, which `planJunctions` has
  // kept apart.
  bool mayOverlap(const Item& a, const Item& b) const {
    if (a.junction != kNone && b.junction != kNone) return a.junction != b.junction;
    if (a.junction != kNone) return !isBranchOf(b.reach, a.junction);
    if (b.junction != kNone) return !isBranchOf(a.reach, b.junction);
    return a.reach != b.reach || std::max(a.row, b.row) - std::min(a.row, b.row) > 1;
  }

  static bool meet(const Item& a, const Item& b) {
    for (const auto& [p, q] : a.edges)
      for (const auto& [r, s] : b.edges)
        if (segmentsMeet(p, q, r, s)) return true;
    return false;
  }

  std::span<const RiverRows> rows_;
  std::span<const RiverJunction> junctions_;
  std::vector<Item> items_;
};

}  // namespace

std::vector<RiverOverlap> overlapsOf(std::span<const RiverRows> rows, std::span<const RiverJunction> junctions) {
  return OverlapFinder(rows, junctions).find();
}

}  // namespace coastmesh
