#include "gis/rivers/river_overlaps.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "core/ids.hpp"
#include "core/metric.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/geometry/near_segments.hpp"

namespace coastmesh {

namespace {

// A row of a reach, or a bank at a junction between two branches.
struct Item {
  std::uint32_t reach = 0;
  std::size_t row = 0;
  std::uint32_t junction = kNone;  // of a bank
  std::vector<std::pair<Point, Point>> edges;
  double length = 0.0;  // of the row
};

class OverlapFinder {
 public:
  OverlapFinder(std::span<const RiverRows> rows, std::span<const RiverJunction> junctions, double clearance)
      : rows_(rows), junctions_(junctions), clearance_(clearance) {
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
      box = box.grownBy(clearance_ * item.length);
    }
    const BoxTree tree(boxes, BoxTree::Order::Hilbert);
    std::map<std::pair<std::uint32_t, std::uint32_t>, RiverOverlap> found;
    for (std::uint32_t i = 0; i < items_.size(); ++i) {
      tree.visit(boxes[i], [&](std::uint32_t k) {
        if (k <= i || !mayOverlap(items_[i], items_[k]) || !meet(items_[i], items_[k])) return;
        const auto [first, second] = std::minmax(items_[i].reach, items_[k].reach);
        RiverOverlap& overlap =
            found.try_emplace({first, second}, RiverOverlap{first, second, items_[i].edges.front().first, {}})
                .first->second;
        if (first == second && items_[i].junction == kNone && items_[k].junction == kNone)
          overlap.rows.insert(overlap.rows.end(), {items_[i].row, items_[k].row});
      });
    }
    std::vector<RiverOverlap> overlaps;
    for (auto& [pair, overlap] : found) {
      std::ranges::sort(overlap.rows);
      const auto repeated = std::ranges::unique(overlap.rows);
      overlap.rows.erase(repeated.begin(), repeated.end());
      overlaps.push_back(std::move(overlap));
    }
    return overlaps;
  }

 private:
  void addRow(std::uint32_t reach, std::size_t row) {
    const RiverSection &a = rows_[reach].sections[row], &b = rows_[reach].sections[row + 1];
    const std::array<Point, 4> corners{a.at(0.0), b.at(0.0), b.at(1.0), a.at(1.0)};
    Item& item = items_.emplace_back(Item{reach, row, kNone, {}, distance(a.place, b.place)});
    for (std::size_t i = 0; i < corners.size(); ++i) item.edges.emplace_back(corners[i], corners[(i + 1) % 4]);
  }

  void addBanks(std::uint32_t j) {
    const std::vector<RiverBranch>& branches = junctions_[j].branches;
    for (std::size_t i = 0; i < branches.size(); ++i) {
      const RiverBranch &branch = branches[i], &next = branches[(i + 1) % branches.size()];
      if (rows_[branch.reach].sections.empty() || rows_[next.reach].sections.empty()) continue;
      items_.push_back({branch.reach, 0, j, {{endOf(branch).at(1.0), endOf(next).at(0.0)}}, 0.0});
    }
  }

  // The last section of a branch before its junction, as seen from there.
  RiverSection endOf(const RiverBranch& branch) const {
    const std::vector<RiverSection>& sections = rows_[branch.reach].sections;
    return branch.at_end ? sections.back().turned() : sections.front();
  }

  // True for the row of a branch beside its junction.
  bool adjoins(const Item& row, std::uint32_t junction) const {
    return std::ranges::any_of(junctions_[junction].branches, [&](const RiverBranch& branch) {
      return branch.reach == row.reach && row.row == (branch.at_end ? rows_[row.reach].sections.size() - 2 : 0);
    });
  }

  // False for what adjoins: rows that follow one another, and the banks of a junction and rows beside it.
  bool mayOverlap(const Item& a, const Item& b) const {
    if (a.junction != kNone && b.junction != kNone) return a.junction != b.junction;
    if (a.junction != kNone) return !adjoins(b, a.junction);
    if (b.junction != kNone) return !adjoins(a, b.junction);
    return a.reach != b.reach || std::max(a.row, b.row) - std::min(a.row, b.row) > 1;
  }

  // Rows of one reach that follow closely are near one another anyway.
  bool meet(const Item& a, const Item& b) const {
    const double least = a.reach == b.reach ? 0.0 : clearance_ * std::max(a.length, b.length);
    for (const auto& [p, q] : a.edges)
      for (const auto& [r, s] : b.edges)
        if (areNear(p, q, r, s, least)) return true;
    return false;
  }

  std::span<const RiverRows> rows_;
  std::span<const RiverJunction> junctions_;
  double clearance_;
  std::vector<Item> items_;
};

}  // namespace

std::vector<RiverOverlap> overlapsOf(std::span<const RiverRows> rows, std::span<const RiverJunction> junctions,
                                     double clearance) {
  return OverlapFinder(rows, junctions, clearance).find();
}

}  // namespace coastmesh
