#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/tri_mesh.hpp"

namespace coastmesh {

// A mesh, and for each triangle the other half of its quadrilateral; empty if there are only triangles.
struct Halves {
  const TriMesh& mesh;
  std::span<const std::uint32_t> other;

  TriId otherOf(TriId t) const { return other.empty() ? kNone : other[t]; }
};

struct Corner {
  TriId triangle;
  unsigned index;
};

// The triangles around a node that are connected to the corner's through edges there, counter-clockwise; `whole` if
// they surround the node.
struct NodeFan {
  std::vector<TriId> triangles;
  bool whole = false;
};
NodeFan fanAt(const TriMesh& mesh, const Corner& corner);

// The triangles of a fan in connected sets with the same flag in `taken`, one after another.
std::vector<std::vector<TriId>> setsOf(const NodeFan& fan, const std::vector<std::uint8_t>& taken);

// The sides of the element that a triangle is, or is a half of.
struct Sides {
  unsigned cut = 0;         // with a triangle across that has another flag
  unsigned neighbours = 0;  // with one that has the same
  TriId neighbour = kNone;
};
Sides sidesOf(const Halves& halves, const std::vector<std::uint8_t>& taken, TriId t);

// True if the element is at the cut, and no other one of its flag is beside it.
bool isAlone(const Sides& sides);

// True if the element sticks out into those with another flag: all of its sides but one lie along the cut, or it is
// alone.
bool isTooth(const Halves& halves, const std::vector<std::uint8_t>& taken, TriId t);

// True if it does, and its neighbour does not.
bool isSingleTooth(const Halves& halves, const std::vector<std::uint8_t>& taken, TriId t);

}  // namespace coastmesh
