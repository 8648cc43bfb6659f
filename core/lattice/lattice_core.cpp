#include "core/lattice/lattice_core.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <utility>

#include "core/bulk_list.hpp"
#include "core/links.hpp"
#include "core/triangulate/delaunay.hpp"

namespace coastmesh {

namespace {

// Rows of the lattice that stay in the mesh around a core: changes beside the shore spread this far.
constexpr int kRowsKept = 4;

bool holds(const LatticeRows& set, std::int64_t a, std::int64_t b) {
  const auto row = set.row(b);
  const auto next = std::ranges::upper_bound(row, a, {}, &Interval::first);
  return next != row.begin() && a < std::prev(next)->last;
}

// The core of a lattice: triangles that far inside, and their corners.
LatticeCore coreOf(const LatticePlaces& places, const ItemLoop& loop) {
  LatticeRows inner = places.places;
  for (int i = 0; i < kRowsKept; ++i) inner = eroded(inner, loop);
  LatticeCore core{places.lattice, {}, {}, {}, {}};
  // Row b of triangles lies between rows b and b + 1 of places.
  core.up = eachRow(inner, loop, [&](std::int64_t b) {
    const auto here = inner.row(b);
    return intersectionOf(intersectionOf(here, shifted(here, -1)), inner.row(b + 1));
  });
  core.down = eachRow(inner, loop, [&](std::int64_t b) {
    const auto above = inner.row(b + 1);
    return intersectionOf(intersectionOf(above, shifted(above, -1)), shifted(inner.row(b), -1));
  });
  core.interior = eroded(inner, loop);
  core.edge = eachRow(inner, loop, [&](std::int64_t b) {
    Intervals corners;
    const auto add = [&](std::span<const Interval> row, std::int64_t from, std::int64_t to) {
      for (const Interval& i : row) corners.push_back({i.first + from, i.last + to});
    };
    add(core.up.row(b), 0, 1);
    add(core.up.row(b - 1), 0, 0);
    add(core.down.row(b), 1, 1);
    add(core.down.row(b - 1), 0, 1);
    return differenceOf(unionOf(std::move(corners)), core.interior.row(b));
  });
  return core;
}

// Removes the triangles that the boundaries of cores enclose from a triangulation.
class CoreCarver {
 public:
  CoreCarver(const TriMesh& mesh, VertexId first, const std::vector<LatticeCore>& cores, const ItemLoop& loop)
      : mesh_(mesh), first_(first) {
    for (const LatticeCore& core : cores) {
      const BulkList<LatticePlace> places = placesIn(core.edge, loop);
      const std::size_t before = places_.size();
      resizeUnset(places_, before + places.size());
      resizeUnset(core_of_, places_.size());
      forEachByStretches(loop, places.size(), [&](std::size_t i) {
        places_[before + i] = places[i];
        core_of_[before + i] = &core;
      });
    }
  }

  TriMesh run(const ItemLoop& loop) const {
    const std::size_t all = mesh_.triangles.size();
    BulkList<TriId> number = unsetList<TriId>(all);
    const std::vector<TriId> counts = overStretches(loop, all, [&](std::size_t first, std::size_t last) {
      TriId count = 0;
      for (std::size_t t = first; t < last; ++t) number[t] = isInCore(static_cast<TriId>(t)) ? kNone : count++;
      return count;
    });
    std::vector<TriId> starts{0};
    for (const TriId count : counts) starts.push_back(starts.back() + count);
    TriMesh rest;
    rest.points = copyOn(loop, mesh_.points);
    rest.input_vertices = mesh_.input_vertices;
    resizeUnset(rest.triangles, starts.back());
    forEachStretch(loop, all, counts.size(), [&](std::size_t s, std::size_t first, std::size_t last) {
      for (std::size_t t = first; t < last; ++t)
        if (number[t] != kNone) number[t] += starts[s];
    });
    forEachByStretches(loop, all, [&](std::size_t t) {
      if (number[t] == kNone) return;
      rest.triangles[number[t]] = renumbered(
          mesh_.triangles[t], [&](TriId n) { return number[n]; }, std::identity(), kFrozen);
    });
    assert(findBrokenLink(rest.triangles) == kNone);
    return rest;
  }

 private:
  // No triangle crosses the boundary of a core, whose edges are edges of the triangulation: one with three corners
  // there is inside if its centroid is.
  bool isInCore(TriId t) const {
    LatticePlace sum{0, 0};
    const LatticeCore* core = nullptr;
    for (const VertexId v : mesh_.triangle(t).v) {
      const VertexId k = v - first_;
      if (k >= places_.size() || (core != nullptr && core != core_of_[k])) return false;
      core = core_of_[k];
      sum.a += places_[k].a;
      sum.b += places_[k].b;
    }
    // In thirds of the lattice's steps. A centroid on an edge lies inside or outside together with both its sides.
    const auto below = [](std::int64_t thirds) { return thirds >= 0 ? thirds / 3 : -((2 - thirds) / 3); };
    const std::int64_t a = below(sum.a), b = below(sum.b);
    const bool is_upper = sum.a - 3 * a + sum.b - 3 * b > 3;
    return holds(is_upper ? core->down : core->up, a, b);
  }

  const TriMesh& mesh_;
  VertexId first_;  // of the vertices on boundaries of cores
  BulkList<LatticePlace> places_;
  BulkList<const LatticeCore*> core_of_;
};

// Numbers the places of a row in ascending order. REQUIRES: calls of `at` in ascending order.
class RowNumbers {
 public:
  RowNumbers(std::span<const Interval> row, std::uint32_t first) : row_(row), next_(first) {}

  std::uint32_t at(std::int64_t a) {
    while (i_ < row_.size() && row_[i_].last <= a) {
      next_ += static_cast<std::uint32_t>(row_[i_].last - row_[i_].first);
      ++i_;
    }
    return i_ < row_.size() && row_[i_].first <= a ? next_ + static_cast<std::uint32_t>(a - row_[i_].first) : kNone;
  }

 private:
  std::span<const Interval> row_;
  std::uint32_t next_;
  std::size_t i_ = 0;
};

// The first number of each row and, after the last row, the end. Rows before the first have its first number.
struct RowStarts {
  std::int64_t first_row = 0;
  std::vector<std::uint32_t> start;

  std::uint32_t of(std::int64_t b) const {
    return start[static_cast<std::size_t>(
        std::clamp<std::int64_t>(b - first_row, 0, static_cast<std::int64_t>(start.size()) - 1))];
  }
};

template <typename CountOf>
RowStarts startsOf(const LatticeRows& like, std::uint32_t first, const CountOf& countIn) {
  RowStarts starts{like.first, {first}};
  for (std::size_t r = 0; r < like.rows.size(); ++r)
    starts.start.push_back(starts.start.back() +
                           static_cast<std::uint32_t>(countIn(like.first + static_cast<std::int64_t>(r))));
  return starts;
}

// A frozen edge of the mesh around the cores, and the vertices that it joins.
struct FrozenEdge {
  VertexId from, to;
  EdgeRef edge;

  friend auto operator<=>(const FrozenEdge&, const FrozenEdge&) = default;
};

std::vector<FrozenEdge> frozenEdges(const TriMesh& mesh, const ItemLoop& loop) {
  auto edges = joined(overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
    std::vector<FrozenEdge> some;
    for (std::size_t t = first; t < last; ++t)
      for (unsigned i = 0; i < 3; ++i)
        if (const EdgeRef e = edgeRef(static_cast<TriId>(t), i); mesh.segment(e) == kFrozen)
          some.push_back({mesh.origin(e), mesh.target(e), e});
    return some;
  }));
  sortOn(loop, edges);
  return edges;
}

// Writes one core into a mesh that has room for it.
class CoreWriter {
 public:
  CoreWriter(TriMesh& mesh, const LatticeCore& core, const std::vector<FrozenEdge>& frozen, VertexId edge_vertex,
             VertexId interior_vertex, TriId triangle)
      : mesh_(mesh),
        core_(core),
        frozen_(frozen),
        edge_(startsOf(core.edge, edge_vertex, [&](std::int64_t b) { return countOf(core.edge.row(b)); })),
        interior_(startsOf(core.edge, interior_vertex, [&](std::int64_t b) { return countOf(core.interior.row(b)); })),
        triangle_(startsOf(core.edge, triangle,
                           [&](std::int64_t b) { return countOf(core.up.row(b)) + countOf(core.down.row(b)); })) {}

  void run(const ItemLoop& loop) {
    eachOf(loop, [&](std::int64_t b) { writeRow(b); });
    eachOf(loop, [&](std::int64_t b) { linkRow(b); });
  }

 private:
  template <typename Work>
  void eachOf(const ItemLoop& loop, const Work& work) {
    constexpr std::size_t kRowsAtOnce = 8;
    const auto workOn = [&](std::size_t first, std::size_t last) {
      for (std::size_t r = first; r < last; ++r) work(core_.edge.first + static_cast<std::int64_t>(r));
    };
    forStretches(loop, core_.edge.rows.size(), workOn, kRowsAtOnce);
  }

  struct Vertices {
    RowNumbers edge, interior;
    VertexId at(std::int64_t a) {
      const VertexId v = interior.at(a);
      return v != kNone ? v : edge.at(a);
    }
  };
  Vertices verticesOf(std::int64_t b) const {
    return {RowNumbers(core_.edge.row(b), edge_.of(b)), RowNumbers(core_.interior.row(b), interior_.of(b))};
  }
  RowNumbers upOf(std::int64_t b) const { return {core_.up.row(b), triangle_.of(b)}; }
  RowNumbers downOf(std::int64_t b) const {
    return {core_.down.row(b), triangle_.of(b) + static_cast<std::uint32_t>(countOf(core_.up.row(b)))};
  }

  void writeRow(std::int64_t b) {
    VertexId v = interior_.of(b);
    for (const Interval& i : core_.interior.row(b))
      for (std::int64_t a = i.first; a < i.last; ++a) mesh_.points[v++] = core_.lattice.at(a, b);
    TriId t = triangle_.of(b);
    const auto write = [&](std::span<const Interval> row, const std::array<std::array<int, 2>, 3>& corners) {
      std::array<Vertices, 3> of{verticesOf(b + corners[0][1]), verticesOf(b + corners[1][1]),
                                 verticesOf(b + corners[2][1])};
      for (const Interval& i : row)
        for (std::int64_t a = i.first; a < i.last; ++a)
          mesh_.triangles[t++] =
              unlinked({of[0].at(a + corners[0][0]), of[1].at(a + corners[1][0]), of[2].at(a + corners[2][0])});
    };
    write(core_.up.row(b), {{{0, 0}, {1, 0}, {0, 1}}});
    write(core_.down.row(b), {{{1, 0}, {1, 1}, {0, 1}}});
  }

  // Every edge inside the core lies between an upward and a downward triangle.
  void linkRow(std::int64_t b) {
    RowNumbers up = upOf(b), right = downOf(b), left = downOf(b), below = downOf(b - 1);
    for (const Interval& i : core_.up.row(b)) {
      for (std::int64_t a = i.first; a < i.last; ++a) {
        const TriId t = up.at(a);
        linkUp(edgeRef(t, 0), right.at(a), 1);
        linkUp(edgeRef(t, 1), left.at(a - 1), 2);
        linkUp(edgeRef(t, 2), below.at(a), 0);
      }
    }
    RowNumbers down = downOf(b), beside = upOf(b), beyond = upOf(b), above = upOf(b + 1);
    for (const Interval& i : core_.down.row(b)) {
      for (std::int64_t a = i.first; a < i.last; ++a) {
        const TriId t = down.at(a);
        if (above.at(a) == kNone) linkOut(edgeRef(t, 0));
        if (beside.at(a) == kNone) linkOut(edgeRef(t, 1));
        if (beyond.at(a + 1) == kNone) linkOut(edgeRef(t, 2));
      }
    }
  }

  void linkUp(EdgeRef e, TriId down, unsigned i) {
    if (down != kNone) {
      link(mesh_.triangles, e, edgeRef(down, i), kNone);
    } else {
      linkOut(e);
    }
  }

  void linkOut(EdgeRef e) {
    const auto at = std::ranges::lower_bound(frozen_, FrozenEdge{mesh_.target(e), mesh_.origin(e), 0});
    assert(at != frozen_.end() && at->from == mesh_.target(e) && at->to == mesh_.origin(e));
    link(mesh_.triangles, e, at->edge, kNone);
  }

  TriMesh& mesh_;
  const LatticeCore& core_;
  const std::vector<FrozenEdge>& frozen_;
  RowStarts edge_, interior_, triangle_;
};

std::uint64_t interiorOf(const LatticeCore& core) { return static_cast<std::uint64_t>(core.interior.count()); }
std::uint64_t trianglesOf(const LatticeCore& core) {
  return static_cast<std::uint64_t>(core.up.count() + core.down.count());
}

// Appends the points that divide segments, which get numbers from `first` on.
void addDivisions(const DividedSegments& divided, VertexId input, VertexId first, Pslg& all) {
  all.points.insert(all.points.end(), divided.points.begin(), divided.points.end());
  if (divided.points.empty()) return;
  for (Segment& s : all.segments)
    for (VertexId* const end : {&s.a, &s.b})
      if (*end >= input) *end += first - input;
}

// Names the segments of the PSLG instead of their pieces.
void nameSegments(TriMesh& mesh, const std::vector<SegmentId>& of, const ItemLoop& loop) {
  forEachByStretches(loop, mesh.triangles.size(), [&](std::size_t t) {
    for (SegmentId& s : mesh.triangles[t].seg)
      if (s != kNone) s = of[s];
  });
}

}  // namespace

std::uint64_t LatticeMesh::coreVertices() const {
  std::uint64_t sum = 0;
  for (const LatticeCore& core : cores) sum += interiorOf(core);
  return sum;
}

std::uint64_t LatticeMesh::coreTriangles() const {
  std::uint64_t sum = 0;
  for (const LatticeCore& core : cores) sum += trianglesOf(core);
  return sum;
}

LatticeMesh triangulateWith(const Pslg& pslg, std::vector<LatticePlaces> lattices, bool with_cores,
                            const DividedSegments& divided, const ItemLoop& loop) {
  LatticeMesh made;
  made.pslg_vertices = static_cast<VertexId>(pslg.points.size());
  for (LatticePlaces& some : lattices) {
    if (!with_cores) break;
    LatticeCore core = coreOf(some, loop);
    if (core.interior.count() == 0) continue;
    some.places = eachRow(some.places, loop, [&](std::int64_t b) {
      return differenceOf(differenceOf(some.places.row(b), core.edge.row(b)), core.interior.row(b));
    });
    made.cores.push_back(std::move(core));
  }
  std::size_t points = pslg.points.size();
  for (const LatticeCore& core : made.cores) points += static_cast<std::size_t>(core.edge.count());
  const auto fixed = static_cast<VertexId>(points);
  for (const LatticePlaces& some : lattices) points += static_cast<std::size_t>(some.places.count());
  const std::size_t dividing = points;
  points += divided.points.size();
  Pslg all{{}, divided.pieces.empty() ? pslg.segments : divided.pieces, pslg.holes};
  reserveOn(loop, all.points, points);
  all.points.assign(pslg.points.begin(), pslg.points.end());
  const auto add = [&](const Lattice& lattice, const LatticeRows& rows) {
    const BulkList<LatticePlace> places = placesIn(rows, loop);
    const std::size_t before = all.points.size();
    all.points.resize(before + places.size());
    forEachByStretches(loop, places.size(),
                       [&](std::size_t i) { all.points[before + i] = lattice.at(places[i].a, places[i].b); });
  };
  for (const LatticeCore& core : made.cores) add(core.lattice, core.edge);
  for (const LatticePlaces& some : lattices) add(some.lattice, some.places);
  addDivisions(divided, made.pslg_vertices, static_cast<VertexId>(dividing), all);
  made.mesh = constrainedDelaunay(all, {}, loop);
  made.mesh.input_vertices = fixed;
  if (!divided.pieces.empty()) nameSegments(made.mesh, divided.of, loop);
  if (!made.cores.empty()) made.mesh = CoreCarver(made.mesh, made.pslg_vertices, made.cores, loop).run(loop);
  return made;
}

void insertCores(TriMesh& mesh, VertexId pslg_vertices, const std::vector<LatticeCore>& cores, const ItemLoop& loop) {
  const std::vector<FrozenEdge> frozen = frozenEdges(mesh, loop);
  VertexId edge_vertex = pslg_vertices;
  std::uint64_t vertices = mesh.points.size(), triangles = mesh.triangles.size();
  for (const LatticeCore& core : cores) {
    vertices += interiorOf(core);
    triangles += trianglesOf(core);
  }
  auto vertex = static_cast<VertexId>(mesh.points.size());
  auto triangle = static_cast<TriId>(mesh.triangles.size());
  // Reserves room for repairs: moving a whole large mesh takes more memory and time than they do.
  constexpr std::size_t kSpareShare = 64;
  growOn(loop, mesh.points, vertices, vertices / kSpareShare);
  growOn(loop, mesh.triangles, triangles, triangles / kSpareShare);
  resizeUnset(mesh.points, vertices);
  resizeUnset(mesh.triangles, triangles);
  for (const LatticeCore& core : cores) {
    CoreWriter(mesh, core, frozen, edge_vertex, vertex, triangle).run(loop);
    edge_vertex += static_cast<VertexId>(core.edge.count());
    vertex += static_cast<VertexId>(interiorOf(core));
    triangle += static_cast<TriId>(trianglesOf(core));
  }
  mesh.input_vertices = pslg_vertices;
  assert(findBrokenLink(mesh.triangles) == kNone);
}

}  // namespace coastmesh
