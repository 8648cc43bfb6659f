#include "gis/cut/tidy_cut.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "gis/cut/cut_elements.hpp"

namespace coastmesh {

namespace {

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
    std::vector<std::vector<TriId>> sets = setsOf(fanAt(mesh, corners[at]), taken);
    std::erase_if(sets, [&](const std::vector<TriId>& set) { return taken[set.front()] == 0; });
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

// Returns how many elements the triangles are. REQUIRES: both halves of a quadrilateral are among them.
std::size_t leaveOut(const Halves& halves, std::span<const TriId> triangles, std::vector<std::uint8_t>& taken) {
  std::size_t elements = 0;
  for (const TriId t : triangles) {
    taken[t] = 0;
    if (t < halves.otherOf(t)) ++elements;  // kNone is the largest
  }
  return elements;
}

// Leaves out those of the taken triangles of which this is true before. Returns how many elements they are.
std::size_t leaveOutWhere(const Halves& halves, std::vector<std::uint8_t>& taken, const ItemLoop& loop,
                          const std::function<bool(TriId)>& isToGo) {
  const std::vector<TriId> all = joined(overStretches(loop, taken.size(), [&](std::size_t first, std::size_t last) {
    std::vector<TriId> found;
    for (auto t = static_cast<TriId>(first); t < last; ++t)
      if (taken[t] != 0 && isToGo(t)) found.push_back(t);
    return found;
  }));
  return leaveOut(halves, all, taken);
}

}  // namespace

TidiedCut tidyCut(const TriMesh& mesh, std::span<const std::uint32_t> other_half, std::vector<std::uint8_t>& taken,
                  const ItemLoop& loop) {
  const Halves halves{mesh, other_half};
  TidiedCut tidied;
  tidied.loose = leaveOutLoose(halves, taken, loop);
  std::vector<std::uint8_t> without = taken;
  std::size_t teeth = leaveOutWhere(halves, without, loop, [&](TriId t) { return isSingleTooth(halves, without, t); });
  const std::size_t loose = leaveOutLoose(halves, without, loop);
  teeth += leaveOutWhere(halves, without, loop, [&](TriId t) { return isAlone(sidesOf(halves, without, t)); });
  if (teeth == 0 || std::ranges::find(without, 1) == without.end()) return tidied;
  taken = std::move(without);
  tidied.teeth = teeth;
  tidied.loose += loose;
  return tidied;
}

TidiedCut tidyEvenCut(const TriMesh& mesh, std::span<const std::uint32_t> other_half, std::vector<std::uint8_t>& taken,
                      const ItemLoop& loop) {
  const Halves halves{mesh, other_half};
  TidiedCut tidied;
  tidied.loose = leaveOutLoose(halves, taken, loop);
  if (tidied.loose > 0)
    tidied.teeth = leaveOutWhere(halves, taken, loop, [&](TriId t) { return isAlone(sidesOf(halves, taken, t)); });
  return tidied;
}

}  // namespace coastmesh
