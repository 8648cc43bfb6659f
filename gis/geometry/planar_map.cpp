#include "gis/geometry/planar_map.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "core/predicates.hpp"
#include "core/union_find.hpp"
#include "gis/geometry/edge_runs.hpp"

namespace coastmesh {

struct PlanarMap::Builder {
  const std::vector<Point>& points;
  const std::vector<std::pair<VertexId, VertexId>>& edges;
  PlanarMap& map;
  const ItemLoop& loop;
  std::vector<std::uint32_t> loop_of;  // by half-edge: the closed walk that it belongs to
  std::uint32_t loops = 0;

  VertexId tail(HalfEdge h) const { return h % 2 == 0 ? edges[h / 2].first : edges[h / 2].second; }
  VertexId head(HalfEdge h) const { return tail(h ^ 1u); }
  const Point& at(VertexId v) const { return points[v]; }

  void makeFans() {
    auto& begin = map.fan_begin_;
    begin.assign(points.size() + 1, 0);
    for (const auto& [a, b] : edges) ++begin[a + 1], ++begin[b + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    map.fan_.resize(2 * edges.size());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (HalfEdge h = 0; h < 2 * edges.size(); ++h) map.fan_[next[tail(h)]++] = h;
    for (VertexId v = 0; v < points.size(); ++v) {
      if (begin[v + 1] - begin[v] > 2) sortAround(v);
    }
  }

  void sortAround(VertexId v) {
    const Point& centre = at(v);
    const auto below = [&](const Point& p) { return p.y < centre.y || (p.y == centre.y && p.x < centre.x); };
    const auto begin = map.fan_.begin() + static_cast<std::ptrdiff_t>(map.fan_begin_[v]);
    const auto end = map.fan_.begin() + static_cast<std::ptrdiff_t>(map.fan_begin_[v + 1]);
    std::sort(begin, end, [&](HalfEdge g, HalfEdge h) {
      const Point &p = at(head(g)), &q = at(head(h));
      if (below(p) != below(q)) return below(q);
      return orient2d(centre, p, q) > 0;
    });
  }

  // The next half-edge around the face to the left of h: at its head, the first clockwise from h ^ 1.
  HalfEdge next(HalfEdge h) const {
    const auto star = map.leaving(head(h));
    if (star.size() == 2) return star[0] == (h ^ 1u) ? star[1] : star[0];
    const auto back = std::find(star.begin(), star.end(), h ^ 1u);
    return back == star.begin() ? star.back() : *(back - 1);
  }

  void walkLoops() {
    loop_of.assign(2 * edges.size(), kNone);
    for (HalfEdge h = 0; h < loop_of.size(); ++h) {
      if (loop_of[h] != kNone) continue;
      for (HalfEdge g = h; loop_of[g] == kNone; g = next(g)) loop_of[g] = loops;
      ++loops;
    }
  }

  // The least vertex (by x, then y) of each connected piece.
  std::vector<VertexId> leastOfPieces() const {
    UnionFind pieces(points.size());
    for (const auto& [a, b] : edges) pieces.unite(a, b);
    std::vector<VertexId> least(points.size(), kNone);
    for (VertexId v = 0; v < points.size(); ++v) {
      if (map.leaving(v).empty()) continue;
      VertexId& best = least[pieces.find(v)];
      if (best == kNone || lexLess(at(v), at(best))) best = v;
    }
    std::erase(least, kNone);
    return least;
  }

  // The half-edge from the least vertex of a piece with the piece's outside on its left. All half-edges from there
  // point between due south (excluded) and due north; it is the last counter-clockwise.
  HalfEdge outerAt(VertexId least) const {
    const auto star = map.leaving(least);
    HalfEdge last = star.front();
    for (const HalfEdge h : star) {
      if (orient2d(at(least), at(head(last)), at(head(h))) > 0) last = h;
    }
    return last;
  }

  Box boxOf(std::size_t e) const { return Box::of(at(edges[e].first), at(edges[e].second)); }

  // Joins loops to faces: the outer loop of a piece belongs to the face that contains the piece.
  void nestPieces() {
    const std::vector<VertexId> least = leastOfPieces();
    UnionFind faces(loops + 1);  // loop + 1; 0 is the unbounded face
    if (least.size() < 2) {
      for (const VertexId v : least) faces.unite(loop_of[outerAt(v)] + 1, 0);
      return numberFaces(faces);
    }
    const EdgeRuns runs(edges.size(), [&](std::size_t e) { return boxOf(e); });
    const double span = runs.bounds().xmax - runs.bounds().xmin;
    const double first_reach = span / std::sqrt(static_cast<double>(edges.size()) + 1);
    std::vector<HalfEdge> hit(least.size());
    constexpr std::size_t kWorthAStretch = 128;
    const auto work = [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) hit[i] = firstToTheLeft(at(least[i]), runs, first_reach, span);
    };
    forStretches(loop, least.size(), work, kWorthAStretch);
    for (std::size_t i = 0; i < least.size(); ++i) {
      faces.unite(loop_of[outerAt(least[i])] + 1, hit[i] == kNone ? 0 : loop_of[hit[i]] + 1);
    }
    numberFaces(faces);
  }

  // The half-edge that a ray from p towards smaller x hits first, with p on its left; kNone if it hits none. p's own
  // piece lies entirely on the other side. The ray runs just above p: an edge includes its lower end, not its upper.
  HalfEdge firstToTheLeft(const Point& p, const EdgeRuns& runs, double first_reach, double span) const {
    // Searches nearby first. 64 doublings extend any window wider than the rounding of coordinates across any span.
    double reach = first_reach;
    for (int doubling = 0; doubling < 64; ++doubling, reach *= 2) {
      const bool all = !(reach < span);
      HalfEdge best = kNone;
      const Box window{all ? runs.bounds().xmin : p.x - reach, p.y, p.x, p.y};
      runs.visit(
          window, [&](std::size_t e) { return boxOf(e); },
          [&](std::uint32_t e) {
            const HalfEdge up = at(edges[e].first).y <= at(edges[e].second).y ? 2 * e : 2 * e + 1;
            const Point &low = at(tail(up)), &high = at(head(up));
            if (low.y > p.y || high.y <= p.y || orient2d(low, high, p) >= 0) return;
            if (best == kNone || isRightOf(up, best)) best = up;
          });
      if (best != kNone) {
        const Point &low = at(tail(best)), &high = at(head(best));
        const double x = low.x + (high.x - low.x) * ((p.y - low.y) / (high.y - low.y));
        if (all || x > p.x - 0.99 * reach) return best ^ 1u;
      }
      if (all) return kNone;
    }
    return kNone;
  }

  // True if g lies to the right of h at a height that both pass upwards. REQUIRES: they do not cross.
  bool isRightOf(HalfEdge g, HalfEdge h) const {
    const Point &a = at(tail(g)), &b = at(head(g)), &c = at(tail(h)), &d = at(head(h));
    if (c.y >= a.y) {  // h begins within g's range of y
      const int side = orient2d(a, b, c);
      return side != 0 ? side > 0 : orient2d(a, b, d) > 0;
    }
    const int side = orient2d(c, d, a);
    return side != 0 ? side < 0 : orient2d(c, d, b) < 0;
  }

  void numberFaces(UnionFind& faces) {
    std::vector<std::uint32_t> number(loops + 1, kNone), face_of_loop(loops);
    number[0] = kOuterFace;
    std::uint32_t count = 1;
    for (std::uint32_t l = 0; l < loops; ++l) {
      std::uint32_t& face = number[faces.find(l + 1)];
      if (face == kNone) face = count++;
      face_of_loop[l] = face;
    }
    for (std::uint32_t& l : loop_of) l = face_of_loop[l];
    map.face_of_ = std::move(loop_of);
    auto& begin = map.face_begin_;
    begin.assign(count + 1, 0);
    for (const std::uint32_t face : map.face_of_) ++begin[face + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    map.by_face_.resize(map.face_of_.size());
    std::vector<std::uint32_t> next_place(begin.begin(), begin.end() - 1);
    for (HalfEdge h = 0; h < map.face_of_.size(); ++h) map.by_face_[next_place[map.face_of_[h]]++] = h;
  }
};

PlanarMap::PlanarMap(const std::vector<Point>& points, const std::vector<std::pair<VertexId, VertexId>>& edges,
                     const ItemLoop& loop) {
  Builder builder{points, edges, *this, loop, {}, 0};
  builder.makeFans();
  builder.walkLoops();
  builder.nestPieces();
}

}  // namespace coastmesh
