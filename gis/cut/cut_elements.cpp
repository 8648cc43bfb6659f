#include "gis/cut/cut_elements.hpp"

namespace coastmesh {

NodeFan fanAt(const TriMesh& mesh, const Corner& corner) {
  const VertexId node = mesh.triangle(corner.triangle).v[corner.index];
  // The triangle across the edge that leads to the node, or from it; kNone at the end of the fan.
  const auto across = [&](TriId t, bool counter_clockwise) {
    const unsigned i = mesh.cornerOf(t, node);
    const EdgeRef e = mesh.twin(edgeRef(t, counter_clockwise ? next3(i) : prev3(i)));
    return e == kNone ? kNone : triOf(e);
  };
  TriId first = corner.triangle;
  for (TriId t = first; t != kNone;) {
    first = t;
    t = across(t, false);
    if (t == corner.triangle) break;
  }
  NodeFan fan;
  TriId t = first;
  do {
    fan.triangles.push_back(t);
    t = across(t, true);
  } while (t != kNone && t != first);
  fan.whole = t == first;
  return fan;
}

std::vector<std::vector<TriId>> setsOf(const NodeFan& fan, const std::vector<std::uint8_t>& taken) {
  const std::size_t n = fan.triangles.size();
  const auto changesAt = [&](std::size_t i) {
    return taken[fan.triangles[i]] != taken[fan.triangles[(i + n - 1) % n]];
  };
  std::size_t start = 0;  // around a node, sets are followed from where the flag changes
  while (fan.whole && start < n && !changesAt(start)) ++start;
  if (start == n) return {fan.triangles};
  std::vector<std::vector<TriId>> sets;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (start + k) % n;
    if (k == 0 || changesAt(i)) sets.emplace_back();
    sets.back().push_back(fan.triangles[i]);
  }
  return sets;
}

Sides sidesOf(const Halves& halves, const std::vector<std::uint8_t>& taken, TriId t) {
  const TriId other = halves.otherOf(t);
  Sides sides;
  const auto count = [&](EdgeRef across) {
    if (across == kNone || triOf(across) == t || triOf(across) == other) return;
    if (taken[triOf(across)] != taken[t]) {
      ++sides.cut;
    } else {
      ++sides.neighbours;
      sides.neighbour = triOf(across);
    }
  };
  for (const TriId part : {t, other})
    if (part != kNone)
      for (const EdgeRef across : halves.mesh.triangles[part].adj) count(across);
  return sides;
}

bool isAlone(const Sides& sides) { return sides.cut > 0 && sides.neighbours == 0; }

bool isTooth(const Halves& halves, const std::vector<std::uint8_t>& taken, TriId t) {
  const Sides sides = sidesOf(halves, taken, t);
  return sides.cut > (halves.otherOf(t) == kNone ? 1u : 2u) || isAlone(sides);
}

bool isSingleTooth(const Halves& halves, const std::vector<std::uint8_t>& taken, TriId t) {
  if (!isTooth(halves, taken, t)) return false;
  const TriId neighbour = sidesOf(halves, taken, t).neighbour;
  return neighbour == kNone || !isTooth(halves, taken, neighbour);
}

}  // namespace coastmesh
