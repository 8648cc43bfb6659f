#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/ids.hpp"
#include "core/item_loop.hpp"
#include "gis/clean/clean_options.hpp"
#include "gis/clean/clean_report.hpp"
#include "gis/clean/domain.hpp"
#include "gis/clean/seam.hpp"

namespace coastmesh {

// A vertex of the input, or one made where edges cross.
struct CleanVertices {
  std::vector<Point> plane;
  std::vector<Point> input;  // with the input's bits, unless new
  std::vector<char> is_new;  // made by cleaning: `input` is computed
};

// A ring or an open line over vertices.
struct CleanChain {
  enum class Role { Outer, Hole, Line, Point };
  Role role = Role::Outer;
  std::uint32_t feature = 0;   // index into Coastline::features
  std::vector<VertexId> walk;  // a ring's first vertex is not repeated; a point has one vertex

  bool isRing() const { return role == Role::Outer || role == Role::Hole; }
};

// The first stage of cleaning: features as chains over distinct vertices.
struct CleanChains {
  CleanVertices vertices;
  std::vector<CleanChain> chains;
  double snap = 0;  // the snap distance in the plane; 0 if too small to matter
  Resolution resolution;
  std::optional<Seam> seam;
  // True if features of these uses exist, even without chains: a frame around the whole globe has none.
  bool framed = false, land = false, coast = false;
  std::vector<std::uint32_t> beyond;  // features that contain the plane's point at infinity, ascending
};

// Projects the members' points, merges those that are equal or within the snap distance (the first stays), removes
// repeated points and spikes from chains, and drops chains without area, islands too small and rings that a feature has
// twice. Throws InputError for a point that cannot be projected.
CleanChains makeChains(const Coastline& coastline, const std::vector<std::size_t>& members,
                       const Projection& projection, const CleanOptions& options, CleanReport& report,
                       const ItemLoop& loop = inOrder);

}  // namespace coastmesh
