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
  std::vector<Point> input;  // the input's own bits
  std::vector<char> is_new;  // made by us: `input` is computed
};

// A ring or an open line over vertices.
struct CleanChain {
  enum class Role { Outer, Hole, Line, Point };
  Role role = Role::Outer;
  std::uint32_t feature = 0;   // index into Coastline::features
  std::vector<VertexId> walk;  // a ring's first vertex is not repeated; a point's is one vertex

  bool isRing() const { return role == Role::Outer || role == Role::Hole; }
};

// The first stage of cleaning: features as chains over distinct vertices.
struct CleanChains {
  CleanVertices vertices;
  std::vector<CleanChain> chains;
  double snap = 0;  // the snap distance in the plane; 0 where it is too small to matter
  Resolution resolution;
  std::optional<Seam> seam;
  // Whether features of these uses are there; a frame round the whole globe leaves no chain.
  bool framed = false, land = false, coast = false;
  std::vector<std::uint32_t> beyond;  // features that hold what lies beyond all of the plane, ascending
};

// Projects the members' points, makes one vertex of those equal or nearer than the snap distance (the first stays),
// takes repeated points and spikes out of chains and drops chains without area and islands too small. Throws InputError
// for a point that cannot be projected.
CleanChains makeChains(const Coastline& coastline, const std::vector<std::size_t>& members,
                       const Projection& projection, const CleanOptions& options, CleanReport& report,
                       const ItemLoop& loop = inOrder);

}  // namespace coastmesh
