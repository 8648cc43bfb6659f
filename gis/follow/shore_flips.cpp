#include "gis/follow/shore_flips.hpp"

#include <algorithm>
#include <utility>

#include "core/flip.hpp"
#include "core/links.hpp"
#include "core/predicates.hpp"

namespace coastmesh {

void ShoreFlips::touch(TriId t) {
  changed_.push_back(t);
  for (unsigned i = 0; i < 3; ++i) {
    t_.home[t_.mesh.triangles[t].v[i]] = t;
    waiting_.push_back(edgeRef(t, i));
  }
}

TriId ShoreFlips::make(const std::array<VertexId, 3>& corners, RegionId region) {
  TriId t = static_cast<TriId>(t_.mesh.triangles.size());
  if (!free_.empty()) {
    t = free_.back();
    free_.pop_back();
  } else {
    t_.mesh.triangles.emplace_back();
    t_.mesh.regions.push_back(region);
    t_.size.push_back(0.0);
    t_.width.push_back(0.0);
  }
  t_.mesh.triangles[t] = unlinked(corners);
  t_.mesh.regions[t] = region;
  return t;
}

void ShoreFlips::free(TriId t) {
  t_.mesh.triangles[t].v[0] = kNone;
  free_.push_back(t);
}

ShoreFlips::Side ShoreFlips::sideOf(EdgeRef inside) const {
  return {t_.mesh.origin(inside), t_.mesh.twin(inside), t_.mesh.segment(inside)};
}

void ShoreFlips::remove(VertexId v) {
  std::vector<Side> hole;
  std::vector<TriId> star;
  forTrianglesRound(t_, v, [&](TriId t) {
    hole.push_back(sideOf(edgeRef(t, t_.mesh.cornerOf(t, v))));
    star.push_back(t);
  });
  const RegionId region = t_.mesh.regions[star.front()];
  for (const TriId t : star) free(t);
  t_.home[v] = kNone;
  fill(hole, region);
}

// An ear; one with an empty circumcircle if possible.
std::size_t ShoreFlips::earOf(const std::vector<Side>& hole) const {
  const std::size_t count = hole.size();
  const auto at = [&](std::size_t i) -> const Point& { return t_.mesh.point(hole[i % count].from); };
  for (const bool by_circle : {true, false}) {
    for (std::size_t i = 0; i < count; ++i) {
      const Point &a = at(i), &b = at(i + 1), &c = at(i + 2);
      if (orient2d(a, b, c) <= 0) continue;
      bool is_ear = true;
      for (std::size_t k = 3; k < count && is_ear; ++k) {
        const Point& x = at(i + k);
        is_ear = by_circle ? inCircle(a, b, c, x) <= 0
                           : orient2d(a, b, x) < 0 || orient2d(b, c, x) < 0 || orient2d(c, a, x) < 0;
      }
      if (is_ear) return i;
    }
  }
  return count;
}

// The hole is star-shaped, so it has ears until it is a triangle.
void ShoreFlips::fill(std::vector<Side>& hole, RegionId region) {
  while (hole.size() >= 3) {
    const std::size_t i = hole.size() == 3 ? 0 : earOf(hole), j = (i + 1) % hole.size(), k = (i + 2) % hole.size();
    const TriId t = make({hole[i].from, hole[j].from, hole[k].from}, region);
    link(t_.mesh.triangles, edgeRef(t, 2), hole[i].beyond, hole[i].segment);
    link(t_.mesh.triangles, edgeRef(t, 0), hole[j].beyond, hole[j].segment);
    if (hole.size() == 3) link(t_.mesh.triangles, edgeRef(t, 1), hole[k].beyond, hole[k].segment);
    touch(t);
    if (hole.size() == 3) return;
    hole[i] = {hole[i].from, edgeRef(t, 1), kNone};
    hole.erase(hole.begin() + static_cast<std::ptrdiff_t>(j));
  }
}

void ShoreFlips::insert(VertexId v, TriId in) {
  const Point& x = t_.mesh.point(v);
  std::vector<TriId> around{in};
  std::vector<Side> hole;
  for (unsigned i = 0; i < 3; ++i) {
    const EdgeRef e = edgeRef(in, i);
    if (orient2d(t_.mesh.point(t_.mesh.origin(e)), t_.mesh.point(t_.mesh.target(e)), x) != 0) {
      hole.push_back(sideOf(e));
      continue;
    }
    const EdgeRef beyond = t_.mesh.twin(e);
    around.push_back(triOf(beyond));
    hole.push_back(sideOf(edgeRef(triOf(beyond), next3(indexOf(beyond)))));
    hole.push_back(sideOf(edgeRef(triOf(beyond), prev3(indexOf(beyond)))));
  }
  const RegionId region = t_.mesh.regions[in];
  for (const TriId t : around) free(t);
  TriId first = kNone, last = kNone;
  for (std::size_t i = 0; i < hole.size(); ++i) {
    const TriId t = make({v, hole[i].from, hole[(i + 1) % hole.size()].from}, region);
    link(t_.mesh.triangles, edgeRef(t, 0), hole[i].beyond, hole[i].segment);
    if (last == kNone) {
      first = t;
    } else {
      link(t_.mesh.triangles, edgeRef(t, 2), edgeRef(last, 1), kNone);
    }
    last = t;
  }
  link(t_.mesh.triangles, edgeRef(first, 2), edgeRef(last, 1), kNone);
  t_.home[v] = last;
  forTrianglesRound(t_, v, [&](TriId t) { touch(t); });
}

void ShoreFlips::finish() {
  const auto mayFlip = [&](EdgeRef e) {
    return t_.mesh.triangles[triOf(e)].v[0] != kNone && t_.mesh.segment(e) == kNone && t_.mesh.twin(e) != kNone;
  };
  flipWaiting(t_.mesh.points, t_.mesh.triangles, waiting_, mayFlip, [&](TriId t, TriId n) {
    for (const TriId changed : {t, n}) {
      changed_.push_back(changed);
      for (const VertexId v : t_.mesh.triangles[changed].v) t_.home[v] = changed;
    }
  });
  std::vector<char> is_measured(t_.mesh.triangles.size(), 0);
  for (const TriId t : changed_) {
    if (std::exchange(is_measured[t], 1) == 0 && t_.mesh.triangles[t].v[0] != kNone) measureTriangle(t_, t, size_);
  }
  pack();
  t_.region_was = t_.mesh.regions;
}

void ShoreFlips::pack() {
  std::ranges::sort(free_);
  auto count = static_cast<TriId>(t_.mesh.triangles.size());
  for (std::size_t first = 0, last = free_.size(); first < last;) {
    const TriId from = --count;
    if (free_[last - 1] == from) {
      --last;
      continue;
    }
    const TriId to = free_[first++];
    t_.mesh.triangles[to] = t_.mesh.triangles[from];
    t_.mesh.regions[to] = t_.mesh.regions[from];
    t_.size[to] = t_.size[from];
    t_.width[to] = t_.width[from];
    for (unsigned i = 0; i < 3; ++i) {
      const Triangle& moved = t_.mesh.triangles[to];
      link(t_.mesh.triangles, edgeRef(to, i), moved.adj[i], moved.seg[i]);
      t_.home[moved.v[i]] = to;
    }
  }
  t_.mesh.triangles.resize(count);
  t_.mesh.regions.resize(count);
  t_.size.resize(count);
  t_.width.resize(count);
  free_.clear();
  changed_.clear();
}

}  // namespace coastmesh
