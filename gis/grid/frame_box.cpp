#include "gis/grid/frame_box.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/quality.hpp"
#include "gis/coast/feature_bounds.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "gis/grid/local_plane.hpp"

namespace coastmesh {

FrameBox::FrameBox(const Coastline& coastline)
    : box_(boundsOfFrames(coastline)), in_parts_(std::ranges::any_of(coastline.features, [](const Feature& feature) {
        return feature.use == FeatureUse::Frame && feature.polygons.size() > 1;
      })) {}

Point FrameBox::nearest(const Point& p) const {
  return {in_parts_ ? p.x : std::clamp(p.x, box_.xmin, box_.xmax), std::clamp(p.y, box_.ymin, box_.ymax)};
}

bool FrameBox::hasOnSide(const Point& p) const {
  return p.y == box_.ymin || p.y == box_.ymax || (!in_parts_ && (p.x == box_.xmin || p.x == box_.xmax));
}

namespace {

// Ascending indices of items for which `is_wanted`.
template <typename IsWanted>
std::vector<std::uint32_t> indicesOf(std::size_t count, const ItemLoop& loop, IsWanted&& is_wanted) {
  return joined(overStretches(loop, count, [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> some;
    for (std::size_t i = first; i < last; ++i)
      if (is_wanted(i)) some.push_back(static_cast<std::uint32_t>(i));
    return some;
  }));
}

std::array<double, 3> anglesOf(const Grid& grid, std::uint32_t triangle) {
  const auto p = localPlane(grid, grid.triangles[triangle]);
  return anglesDeg(p[0], p[1], p[2]);
}

class Mover {
 public:
  Mover(Grid& grid, std::vector<std::uint32_t>&& nodes, const AngleBounds& bounds, const ItemLoop& loop)
      : grid_(grid), nodes_(std::move(nodes)), moves_(grid.nodes.size(), 0) {
    for (const std::uint32_t n : nodes_) moves_[n] = 1, before_.push_back(grid.nodes[n]);
    triangles_ = indicesOf(grid.triangles.size(), loop, [&](std::size_t t) { return hasMoved(t); });
    for (const std::uint32_t t : triangles_) {
      angles_.push_back(anglesOf(grid, t));
      const auto [least, greatest] = std::ranges::minmax(angles_.back());
      allowed_.push_back(
          {std::min(bounds.least, least) - kAngleSlackDeg, std::max(bounds.greatest, greatest) + kAngleSlackDeg});
    }
  }

  void move(const FrameBox& box) {
    for (const std::uint32_t n : nodes_) grid_.nodes[n] = box.nearest(grid_.nodes[n]);
    // Nodes that are put back may spoil triangles checked before. Each node is put back at most once.
    for (bool again = true; again;) {
      again = false;
      for (std::size_t k = 0; k < triangles_.size(); ++k) {
        if (!hasMoved(triangles_[k]) || !isSpoilt(k)) continue;
        putBack(grid_.triangles[triangles_[k]]);
        again = true;
      }
    }
  }

  // Also sets areas and angles of the triangles.
  FrameMoves moves() {
    FrameMoves moves;
    moves.nodes = static_cast<std::size_t>(std::ranges::count(moves_, std::uint8_t{1}));
    std::vector<std::uint32_t> changed;
    std::vector<std::array<std::uint32_t, 3>> corners;
    for (std::size_t k = 0; k < triangles_.size(); ++k) {
      const std::uint32_t t = triangles_[k];
      if (!hasMoved(t)) continue;
      changed.push_back(t);
      corners.push_back(grid_.triangles[t]);
      moves.angles_before.push_back(angles_[k]);
      moves.angles_after.push_back(anglesOf(grid_, t));
    }
    const std::vector<double> areas =
        grid_.area_m2.empty() ? std::vector<double>() : areasOfFew(grid_.nodes, corners, grid_.crs);
    for (std::size_t k = 0; k < changed.size(); ++k) {
      if (!areas.empty()) grid_.area_m2[changed[k]] = areas[k];
      if (!grid_.min_angle_deg.empty()) grid_.min_angle_deg[changed[k]] = std::ranges::min(moves.angles_after[k]);
    }
    return moves;
  }

 private:
  bool hasMoved(std::size_t triangle) const {
    return std::ranges::any_of(grid_.triangles[triangle], [&](std::uint32_t n) { return moves_[n] != 0; });
  }

  bool isSpoilt(std::size_t k) const {
    const auto& [a, b, c] = grid_.triangles[triangles_[k]];
    if (orientationOnGround(grid_.nodes[a], grid_.nodes[b], grid_.nodes[c], grid_.crs) <= 0) return true;
    const auto [least, greatest] = std::ranges::minmax(anglesOf(grid_, triangles_[k]));
    return least < allowed_[k].least || greatest > allowed_[k].greatest;
  }

  void putBack(const std::array<std::uint32_t, 3>& corners) {
    for (const std::uint32_t n : corners) {
      if (moves_[n] == 0) continue;
      grid_.nodes[n] = before_[static_cast<std::size_t>(std::ranges::lower_bound(nodes_, n) - nodes_.begin())];
      moves_[n] = 0;
    }
  }

  Grid& grid_;
  std::vector<std::uint32_t> nodes_;           // outside the box, ascending
  std::vector<Point> before_;                  // where they were
  std::vector<std::uint8_t> moves_;            // of each node: moved, and not put back
  std::vector<std::uint32_t> triangles_;       // with such nodes
  std::vector<std::array<double, 3>> angles_;  // of each of these, before
  std::vector<AngleBounds> allowed_;
};

}  // namespace

FrameMoves keepInFrame(Grid& grid, const Coastline& coastline, const AngleBounds& bounds, const ItemLoop& loop) {
  if (!coastline.framed_by_box) return {};
  const FrameBox box(coastline);
  std::vector<std::uint32_t> outside =
      indicesOf(grid.nodes.size(), loop, [&](std::size_t n) { return !(box.nearest(grid.nodes[n]) == grid.nodes[n]); });
  if (outside.empty()) return {};
  Mover mover(grid, std::move(outside), bounds, loop);
  mover.move(box);
  return mover.moves();
}

}  // namespace coastmesh
