#include "gis/cut/even_cut.hpp"

#include <algorithm>
#include <functional>
#include <tuple>

#include "gis/cut/cut_elements.hpp"

namespace coastmesh {

namespace {

// Elements beside one another that several nodes want on different sides are left after so many moves.
constexpr std::uint8_t kMostMoves = 4;

class CutEvener {
 public:
  CutEvener(const Halves& halves, const std::vector<std::uint8_t>& taken, const ItemLoop& loop)
      : halves_(halves), loop_(loop), before_(taken), taken_(taken), moves_(taken.size(), 0) {}

  void even() {
    settleNodes();
    moveWhere([this](TriId t) { return isTooth(halves_, taken_, t); },
              trianglesWhere([this](TriId t) { return isSingleTooth(halves_, taken_, t); }));
    settleNodes();
    const auto isLeftAlone = [this](TriId t) { return isAlone(sidesOf(halves_, taken_, t)); };
    moveWhere(isLeftAlone, trianglesWhere(isLeftAlone));
  }

  const std::vector<std::uint8_t>& taken() const { return taken_; }

  EvenedCut changes() const {
    EvenedCut changes;
    for (TriId t = 0; t < taken_.size(); ++t)
      if (taken_[t] != before_[t] && t < halves_.otherOf(t)) ++(taken_[t] == 0 ? changes.given : changes.taken_in);
    return changes;
  }

 private:
  std::vector<TriId> trianglesWhere(const std::function<bool(TriId)>& wanted) const {
    return joined(overStretches(loop_, taken_.size(), [&](std::size_t first, std::size_t last) {
      std::vector<TriId> found;
      for (auto t = static_cast<TriId>(first); t < last; ++t)
        if (wanted(t)) found.push_back(t);
      return found;
    }));
  }

  bool isAtCut(TriId t) const {
    return std::ranges::any_of(halves_.mesh.triangles[t].adj,
                               [&](EdgeRef across) { return across != kNone && taken_[triOf(across)] != taken_[t]; });
  }

  void move(TriId t) {
    for (const TriId part : {t, halves_.otherOf(t)}) {
      if (part == kNone) continue;
      taken_[part] = taken_[part] == 0 ? 1 : 0;
      ++moves_[part];
    }
  }

  void moveWhere(const std::function<bool(TriId)>& still, const std::vector<TriId>& triangles) {
    for (const TriId t : triangles)
      if (still(t)) move(t);
  }

  // The most moves of a triangle of a set.
  std::uint8_t movesOf(const std::vector<TriId>& set) const {
    std::uint8_t most = 0;
    for (const TriId t : set) most = std::max(most, moves_[t]);
    return most;
  }

  void moveSet(const std::vector<TriId>& set) {
    const std::uint8_t before = taken_[set.front()];
    for (const TriId t : set)
      if (taken_[t] == before) move(t);  // else its other half has
  }

  // At each node, what is taken is one set, and so is the rest.
  void settleNodes() {
    std::vector<Corner> corners;
    const auto add = [&](TriId t) {
      for (unsigned i = 0; i < 3; ++i) corners.push_back({t, i});
    };
    std::ranges::for_each(trianglesWhere([this](TriId t) { return isAtCut(t); }), add);
    for (std::size_t at = 0; at < corners.size(); ++at) {  // grows
      const NodeFan fan = fanAt(halves_.mesh, corners[at]);
      for (;;) {
        std::vector<std::vector<TriId>> sets = setsOf(fan, taken_);
        if (sets.size() < 3) break;
        const std::vector<TriId> least = *std::ranges::min_element(sets, {}, [this](const std::vector<TriId>& set) {
          return std::tuple(movesOf(set), set.size(), std::ranges::min(set));
        });
        if (movesOf(least) >= kMostMoves) break;
        moveSet(least);
        for (const TriId t : least)
          for (const TriId part : {t, halves_.otherOf(t)})
            if (part != kNone) add(part);
      }
    }
  }

  const Halves& halves_;
  const ItemLoop& loop_;
  const std::vector<std::uint8_t> before_;
  std::vector<std::uint8_t> taken_;
  std::vector<std::uint8_t> moves_;  // of each triangle
};

}  // namespace

std::optional<EvenedCut> evenCut(const TriMesh& mesh, std::span<const std::uint32_t> other_half,
                                 std::vector<std::uint8_t>& taken, const ItemLoop& loop) {
  const Halves halves{mesh, other_half};
  CutEvener evener(halves, taken, loop);
  evener.even();
  const std::vector<std::uint8_t>& evened = evener.taken();
  if (std::ranges::find(evened, 0) == evened.end() || std::ranges::find(evened, 1) == evened.end()) return std::nullopt;
  taken = evened;
  return evener.changes();
}

}  // namespace coastmesh
