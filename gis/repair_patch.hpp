#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "core/tri_mesh.hpp"
#include "gis/check_target.hpp"
#include "gis/grid_edit.hpp"
#include "gis/rim_boundaries.hpp"

namespace coastmesh {

// Flips and splits that would mend a mesh for models, tried on a few triangles of it.

// An edge, whichever way it goes.
inline NodePair edgeKey(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

using RimKinds = std::map<NodePair, RimKind>;  // by `edgeKey`

// How the grid hangs together.
struct GridLinks {
  TriMesh mesh;
  std::vector<std::vector<std::uint32_t>> triangles_at;  // one list a node
  RimKinds kinds;                                        // of the rim's edges
  std::set<NodePair> line_edges;                         // by `edgeKey`; these stay
};

// A triangle of a patch, and the grid's triangle that it is, or is cut from.
struct PatchTriangle {
  GridCorners v{};
  std::uint32_t slot = kNone;  // kNone for a new one
  std::uint32_t source = kNone;
};

// Triangles of the grid as they would become.
struct Patch {
  std::vector<PatchTriangle> triangles;
  RimKinds halves;             // edges of the rim that splitting made
  std::vector<NodePair> gone;  // and the one it split
  Point fresh{};               // of the node that is to be added, which has the number after the grid's last
};

// An edge flipped, or split at a share of it.
struct Reshaping {
  Patch patch;
  NodePair edge{};
  std::optional<double> split_at;
};

class PatchSearch {
 public:
  // Keeps references to all three.
  PatchSearch(const Grid& grid, const GridLinks& links, std::span<const Target> targets)
      : grid_(grid), links_(links), targets_(targets) {}

  // The triangles that share a node with one of these.
  Patch patchRound(const std::vector<std::uint32_t>& middle) const;

  // The flip or split of an edge of `inside` that leaves the fewest defects in `before`, the patch round it; among
  // these the largest smallest angle. None where no edge leaves fewer.
  std::optional<Reshaping> bestReshaping(const std::vector<std::uint32_t>& inside, const Patch& before) const;

  // The same of splitting an inner node in two: half of its triangles get a node of their own, between it and their
  // other ends.
  std::optional<Patch> bestNodeSplit(std::uint32_t node, const Patch& before) const;

  // The other ends of edges at a node that have to stay: parts of lines, and those where features meet.
  std::set<std::uint32_t> fixedNeighbours(std::uint32_t node) const;

 private:
  // What an edit leaves of a patch: fewer defects are better, then a larger smallest angle.
  struct Score {
    int defects = 0;
    double min_angle = 0.0;

    bool betterThan(const Score& other) const {
      return defects != other.defects ? defects < other.defects : min_angle > other.min_angle;
    }
  };

  bool isFor(Target target) const;
  bool isFixed(std::uint32_t a, std::uint32_t b, std::uint32_t left, std::uint32_t right) const;
  std::vector<Point> planeOf(const Patch& patch, std::span<const std::uint32_t> nodes) const;
  const RimKind* kindOf(const Patch& patch, std::uint32_t a, std::uint32_t b) const;
  bool isOnRim(std::uint32_t node) const;
  Score scoreOf(const Patch& patch, const Patch& before) const;
  int badValences(const Patch& patch, const Patch& before) const;
  std::optional<Patch> flipped(Patch patch, std::uint32_t a, std::uint32_t b) const;
  Patch split(Patch patch, std::uint32_t a, std::uint32_t b, double share) const;
  std::vector<std::uint32_t> ringRound(std::uint32_t node) const;

  const Grid& grid_;
  const GridLinks& links_;
  std::span<const Target> targets_;
};

}  // namespace coastmesh
