#include "gis/cut/tidy_cut.hpp"

#include <algorithm>
#include <utility>

namespace coastmesh {

namespace {

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
struct Fan {
  std::vector<TriId> triangles;
  bool whole = false;
};

Fan fanAt(const TriMesh& mesh, const Corner& corner) {
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
  Fan fan;
  TriId t = first;
  do {
    fan.triangles.push_back(t);
    t = across(t, true);
  } while (t != kNone && t != first);
  fan.whole = t == first;
  return fan;
}

// The taken triangles of a fan, in connected sets.
std::vector<std::vector<TriId>> takenSets(const Fan& fan, const std::vector<std::uint8_t>& taken) {
  std::vector<std::vector<TriId>> sets;
  const std::size_t n = fan.triangles.size();
  // Around a node, sets are followed from the end of a gap.
  const auto gap = std::ranges::find_if(fan.triangles, [&](TriId t) { return taken[t] == 0; });
  if (gap == fan.triangles.end()) return {fan.triangles};
  const std::size_t start = fan.whole ? static_cast<std::size_t>(gap - fan.triangles.begin()) : 0;
  bool follows = false;
  for (std::size_t k = 0; k < n; ++k) {
    const TriId t = fan.triangles[(start + k) % n];
    if (taken[t] != 0) {
      if (!follows) sets.emplace_back();
      sets.back().push_back(t);
    }
    follows = taken[t] != 0;
  }
  return sets;
}

// Both ends of each edge between a taken triangle and another.
std::vector<Corner> cornersAtCut(const TriMesh& mesh, const std::vector<std::uint8_t>& taken, const ItemLoop& loop) {
  return joined(overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
    std::vector<Corner> found;
    for (auto t = static_cast<TriId>(first); t < last; ++t) {
      if (taken[t] == 0) continue;
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef across = mesh.twin(edgeRef(t, i));
        if (across == kNone || taken[triOf(across)] != 0) continue;
        found.push_back({t, next3(i)});
        found.push_back({t, prev3(i)});
      }
    }
    return found;
  }));
}

std::size_t leaveOutLoose(const Halves& halves, std::vector<std::uint8_t>& taken, const ItemLoop& loop) {
  const TriMesh& mesh = halves.mesh;
  std::size_t left_out = 0;
  std::vector<Corner> corners = cornersAtCut(mesh, taken, loop);
  for (std::size_t at = 0; at < corners.size(); ++at) {  // grows
    std::vector<std::vector<TriId>> sets = takenSets(fanAt(mesh, corners[at]), taken);
    if (sets.size() < 2) continue;
    const auto smaller = [](const std::vector<TriId>& a, const std::vector<TriId>& b) {
      return a.size() != b.size() ? a.size() < b.size() : std::ranges::min(a) > std::ranges::min(b);
    };
    sets.erase(std::ranges::max_element(sets, smaller));
    for (const std::vector<TriId>& set : sets) {
      for (const TriId t : set) {
        for (const TriId gone : {t, halves.otherOf(t)}) {
          if (gone == kNone || taken[gone] == 0) continue;
          taken[gone] = 0;
          if (gone == t) ++left_out;
          for (unsigned i = 0; i < 3; ++i) corners.push_back({gone, i});
        }
      }
    }
  }
  return left_out;
}

struct Sides {
  unsigned cut = 0;         // with a triangle across that is not taken
  unsigned neighbours = 0;  // with a taken one
  TriId neighbour = kNone;
};

// Those of the element that the triangle is, or is a half of.
Sides sidesOf(const Halves& halves, const std::vector<std::uint8_t>& taken, TriId t) {
  const TriId other = halves.otherOf(t);
  Sides sides;
  const auto count = [&](EdgeRef across) {
    if (across == kNone || triOf(across) == t || triOf(across) == other) return;
    if (taken[triOf(across)] == 0) {
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

// Returns how many elements the triangles are. REQUIRES: both halves of a quadrilateral are among them.
std::size_t leaveOut(const Halves& halves, std::span<const TriId> triangles, std::vector<std::uint8_t>& taken) {
  std::size_t elements = 0;
  for (const TriId t : triangles) {
    taken[t] = 0;
    if (t < halves.otherOf(t)) ++elements;  // kNone is the largest
  }
  return elements;
}

std::size_t leaveOutTeeth(const Halves& halves, std::vector<std::uint8_t>& taken, const ItemLoop& loop) {
  const auto isTooth = [&](TriId t) {
    const Sides sides = sidesOf(halves, taken, t);
    return sides.cut > (halves.otherOf(t) == kNone ? 1u : 2u) || (sides.cut > 0 && sides.neighbours == 0);
  };
  const std::vector<TriId> teeth = joined(overStretches(loop, taken.size(), [&](std::size_t first, std::size_t last) {
    std::vector<TriId> found;
    for (auto t = static_cast<TriId>(first); t < last; ++t) {
      if (taken[t] == 0 || !isTooth(t)) continue;
      const TriId neighbour = sidesOf(halves, taken, t).neighbour;
      if (neighbour == kNone || !isTooth(neighbour)) found.push_back(t);
    }
    return found;
  }));
  return leaveOut(halves, teeth, taken);
}

// Those without a neighbour, of which leaving out teeth may leave some.
std::size_t leaveOutAlone(const Halves& halves, std::vector<std::uint8_t>& taken, const ItemLoop& loop) {
  const std::vector<TriId> alone = joined(overStretches(loop, taken.size(), [&](std::size_t first, std::size_t last) {
    std::vector<TriId> found;
    for (auto t = static_cast<TriId>(first); t < last; ++t) {
      if (taken[t] == 0) continue;
      const Sides sides = sidesOf(halves, taken, t);
      if (sides.cut > 0 && sides.neighbours == 0) found.push_back(t);
    }
    return found;
  }));
  return leaveOut(halves, alone, taken);
}

}  // namespace

TidiedCut tidyCut(const TriMesh& mesh, std::span<const std::uint32_t> other_half, std::vector<std::uint8_t>& taken,
                  const ItemLoop& loop) {
  const Halves halves{mesh, other_half};
  TidiedCut tidied;
  tidied.loose = leaveOutLoose(halves, taken, loop);
  std::vector<std::uint8_t> without = taken;
  std::size_t teeth = leaveOutTeeth(halves, without, loop);
  const std::size_t loose = leaveOutLoose(halves, without, loop);
  teeth += leaveOutAlone(halves, without, loop);
  if (teeth == 0 || std::ranges::find(without, 1) == without.end()) return tidied;
  taken = std::move(without);
  tidied.teeth = teeth;
  tidied.loose += loose;
  return tidied;
}

}  // namespace coastmesh
