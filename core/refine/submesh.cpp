#include "core/refine/submesh.hpp"

#include <algorithm>
#include <utility>

#include "core/bulk_list.hpp"
#include "core/large_list.hpp"
#include "core/links.hpp"
#include "core/refine/fill_holes.hpp"

namespace coastmesh {

namespace {

// Some triangles, and those that touch them in `rings` layers; numbered in `scratch`.
std::vector<TriId> gatherAround(const EditMesh& mesh, std::span<const TriId> centre, unsigned rings,
                                PatchNumbers& scratch) {
  scratch.triangle.resize(std::max<std::size_t>(scratch.triangle.size(), mesh.triangleSlots()), kNone);
  scratch.vertex.resize(std::max<std::size_t>(scratch.vertex.size(), mesh.vertexSlots()), kNone);
  std::vector<TriId> patch(centre.begin(), centre.end());
  for (const TriId t : patch) scratch.triangle[t] = 0;
  std::vector<VertexId> seen;
  std::vector<EdgeRef> star;
  std::size_t done = 0;
  for (unsigned ring = 0; ring < rings; ++ring) {
    const std::size_t end = patch.size();
    for (; done < end; ++done) {
      for (const VertexId v : mesh.triangle(patch[done]).v) {
        if (scratch.vertex[v] != kNone) continue;
        scratch.vertex[v] = 0;
        seen.push_back(v);
        mesh.star(v, star);
        for (const EdgeRef e : star) {
          if (scratch.triangle[triOf(e)] != kNone) continue;
          scratch.triangle[triOf(e)] = 0;
          patch.push_back(triOf(e));
        }
      }
    }
    std::sort(patch.begin() + static_cast<std::ptrdiff_t>(end), patch.end());
  }
  for (const VertexId v : seen) scratch.vertex[v] = kNone;
  for (TriId i = 0; i < patch.size(); ++i) scratch.triangle[patch[i]] = i;
  return patch;
}

}  // namespace

std::vector<TriId> trianglesAround(const EditMesh& mesh, std::span<const TriId> centre, unsigned rings,
                                   PatchNumbers& scratch) {
  std::vector<TriId> patch = gatherAround(mesh, centre, rings, scratch);
  for (const TriId t : patch) scratch.triangle[t] = kNone;
  return patch;
}

VertexNotes notesOn(std::span<const VertexId> vertices, VertexId fixed, VertexId parent_inputs,
                    const VertexNotes& notes) {
  VertexNotes some;
  some.surface = notes.surface;
  some.corners = notes.corners;
  if (!notes.spacing.empty()) {
    some.spacing.reserve(vertices.size());
    for (const VertexId v : vertices) some.spacing.push_back(notes.spacing[v]);
  }
  // Notes that only input vertices have; other fixed vertices have none.
  for (const VertexId v : vertices.first(fixed)) {
    const bool input = v < parent_inputs;
    if (notes.shell_unit.size() == parent_inputs) some.shell_unit.push_back(input ? notes.shell_unit[v] : 0.0);
    if (notes.small_angle.size() == parent_inputs) some.small_angle.push_back(input && notes.small_angle[v]);
  }
  return some;
}

Submesh extractAround(const EditMesh& parent, const VertexNotes& notes, std::span<const TriId> centre, unsigned rings,
                      PatchNumbers& scratch) {
  const std::vector<TriId> triangles = gatherAround(parent, centre, rings, scratch);
  const auto slotOf = [&](TriId t) { return scratch.triangle[t]; };
  const auto numberOf = [&](VertexId v) -> VertexId& { return scratch.vertex[v]; };
  Submesh sub = extractSubmesh(parent, parent.inputVertices(), notes, triangles, slotOf, numberOf);
  for (const TriId t : triangles) scratch.triangle[t] = kNone;
  for (const VertexId v : sub.parent) scratch.vertex[v] = kNone;
  return sub;
}

void putBack(EditMesh& parent, const Submesh& patch, const TriMesh& solved, std::vector<VertexId>& added,
             std::vector<TriId>& touched) {
  std::vector<bool> on_segment(solved.points.size(), false);
  for (TriId t = 0; t < solved.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      if (solved.triangles[t].seg[i] == kNone) continue;
      on_segment[solved.origin(edgeRef(t, i))] = on_segment[solved.target(edgeRef(t, i))] = true;
    }
  }
  const auto fixed_end = patch.parent.begin() + patch.mesh.input_vertices;
  std::vector<VertexId> number(patch.parent.begin(), fixed_end);
  const std::vector<VertexId> gone(fixed_end, patch.parent.end());
  for (VertexId v = patch.mesh.input_vertices; v < solved.points.size(); ++v) {
    number.push_back(parent.addVertex(solved.points[v], on_segment[v] ? VertexKind::Segment : VertexKind::Free));
    added.push_back(number.back());
  }

  Patch hole{patch.triangles, {}};
  for (const EdgeRef e : patch.frozen)
    hole.boundary.push_back({parent.origin(e), parent.target(e), parent.twin(e), parent.segment(e)});
  std::vector<BoundaryEdge> inner;
  std::vector<Corners> fresh;
  for (TriId t = 0; t < solved.triangles.size(); ++t) {
    const Triangle& tri = solved.triangles[t];
    fresh.push_back({number[tri.v[0]], number[tri.v[1]], number[tri.v[2]]});
    for (unsigned i = 0; i < 3; ++i) {
      // Only a mesh of points alone has a boundary without segments.
      if (tri.seg[i] == kFrozen || (tri.seg[i] == kNone && tri.adj[i] != kNone)) continue;
      const EdgeRef e = edgeRef(t, i);
      const BoundaryEdge edge{number[solved.origin(e)], number[solved.target(e)], kNone, tri.seg[i]};
      if (tri.adj[i] == kNone) {
        hole.boundary.push_back(edge);
      } else {
        inner.push_back(edge);
      }
    }
  }
  parent.replace(hole, fresh, gone, touched, inner);
}

namespace {

// Numbers items that several others name, in the order in which a single thread would first come upon them: the items
// that `visit(i, see)` passes to `see`, for all i below `count`; at most three for each i. Items that have a number
// keep it. `numbered` lists the items by number, and gets the new ones.
template <typename Visit>
void numberAsSeen(std::size_t count, const Visit& visit, std::span<std::uint32_t> number,
                  std::vector<std::uint32_t>& numbered, const ItemLoop& loop) {
  constexpr std::size_t kLeast = 1024;
  const auto known = static_cast<std::uint32_t>(numbered.size());
  // Until it gets its number, an item has the place where it is seen first, counted from the last number.
  const auto forEachSight = [&](std::size_t first, std::size_t last, const auto& use) {
    for (std::size_t i = first; i < last; ++i) {
      auto place = known + static_cast<std::uint32_t>(3 * i);
      visit(i, [&](std::uint32_t item) { use(item, place++); });
    }
  };
  const auto claim = [&](std::uint32_t item, std::uint32_t place) { lowerTo(number[item], place); };
  forStretches(
      loop, count, [&](std::size_t first, std::size_t last) { forEachSight(first, last, claim); }, kLeast);
  const std::vector<std::vector<std::uint32_t>> seen = overStretches(
      loop, count,
      [&](std::size_t first, std::size_t last) {
        std::vector<std::uint32_t> some;
        forEachSight(first, last, [&](std::uint32_t item, std::uint32_t place) {
          if (number[item] == place) some.push_back(item);
        });
        return some;
      },
      kLeast);
  for (const std::vector<std::uint32_t>& some : seen) numbered.insert(numbered.end(), some.begin(), some.end());
  forStretches(
      loop, numbered.size() - known,
      [&](std::size_t first, std::size_t last) {
        for (std::size_t i = known + first; i < known + last; ++i) number[numbered[i]] = static_cast<std::uint32_t>(i);
      },
      kLeast);
}

// The same as `extractSubmesh` for a large mesh, by all threads: for triangles whose index is their `slot`. `number` is
// storage for new numbers of vertices.
Submesh extractOn(const ItemLoop& loop, const TriMesh& parent, const VertexNotes& notes, std::vector<TriId>&& triangles,
                  std::span<const std::uint32_t> slot, std::span<std::uint32_t> number) {
  struct Fixed {
    std::vector<VertexId> vertices;
    std::vector<EdgeRef> frozen;
  };
  const auto isInside = [&](EdgeRef e) {
    const EdgeRef twin = parent.twin(e);
    return twin == kNone ? parent.segment(e) != kFrozen : slot[triOf(twin)] != kNone;
  };
  const std::vector<Fixed> fixed = overStretches(loop, triangles.size(), [&](std::size_t first, std::size_t last) {
    Fixed some;
    for (std::size_t t = first; t < last; ++t) {
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(triangles[t], i);
        if (parent.apex(e) < parent.input_vertices) some.vertices.push_back(parent.apex(e));
        if (isInside(e)) continue;
        some.vertices.insert(some.vertices.end(), {parent.origin(e), parent.target(e)});
        some.frozen.push_back(e);
      }
    }
    return some;
  });
  Submesh sub;
  for (const Fixed& some : fixed) {
    for (const VertexId v : some.vertices) {
      if (number[v] != kNone) continue;
      number[v] = static_cast<VertexId>(sub.parent.size());
      sub.parent.push_back(v);
    }
    sub.frozen.insert(sub.frozen.end(), some.frozen.begin(), some.frozen.end());
  }
  sub.mesh.input_vertices = static_cast<VertexId>(sub.parent.size());
  const auto corners = [&](std::size_t t, const auto& see) {
    for (const VertexId v : parent.triangle(triangles[t]).v) see(v);
  };
  numberAsSeen(triangles.size(), corners, number, sub.parent, loop);

  resizeAnew(loop, sub.mesh.points, sub.parent.size());
  forEachByStretches(loop, sub.parent.size(), [&](std::size_t v) { sub.mesh.points[v] = parent.point(sub.parent[v]); });
  sub.notes = notesOn(sub.parent, sub.mesh.input_vertices, parent.input_vertices, notes);
  resizeAnew(loop, sub.mesh.triangles, triangles.size());
  forEachByStretches(loop, triangles.size(), [&](std::size_t t) {
    sub.mesh.triangles[t] = renumbered(
        parent.triangle(triangles[t]), [&](TriId n) { return slot[n]; }, [&](VertexId v) { return number[v]; },
        kFrozen);
  });
  sub.triangles = std::move(triangles);
  assert(findBrokenLink(sub.mesh.triangles) == kNone);
  return sub;
}

}  // namespace

Submesh extractNear(const TriMesh& parent, const VertexNotes& notes, std::span<const TriId> centre, unsigned edges,
                    const ItemLoop& loop) {
  std::vector<TriId> triangles;
  BulkList<std::uint32_t> slot = noNumbers(loop, parent.triangles.size());
  BulkList<std::uint32_t> number = noNumbers(loop, parent.points.size());
  numberAsSeen(
      centre.size(), [&](std::size_t i, const auto& see) { see(centre[i]); }, slot, triangles, loop);
  std::size_t done = 0;
  for (unsigned ring = 0; ring < edges; ++ring) {
    const std::vector<TriId> front(triangles.begin() + static_cast<std::ptrdiff_t>(done), triangles.end());
    done = triangles.size();
    const auto neighbours = [&](std::size_t i, const auto& see) {
      for (const EdgeRef twin : parent.triangle(front[i]).adj)
        if (twin != kNone) see(triOf(twin));
    };
    numberAsSeen(front.size(), neighbours, slot, triangles, loop);
  }
  const VertexNotes without_spacing{notes.surface, {}, notes.shell_unit, notes.small_angle, notes.corners};
  Submesh sub = extractOn(loop, parent, without_spacing, std::move(triangles), slot, number);
  noteSpacingOfNeighbours(sub.mesh, sub.notes, loop);
  for (VertexId v = 0; v < sub.mesh.input_vertices; ++v)
    if (sub.parent[v] < parent.input_vertices) sub.notes.spacing[v] = notes.spacing[sub.parent[v]];
  return sub;
}

namespace {

// Fills the slots of removed triangles and vertices with the last ones. Keeps the numbers in `followed` up to date.
void removeUnused(TriMesh& mesh, std::vector<TriId> triangles, std::vector<VertexId> vertices,
                  std::span<TriId> followed, const ItemLoop& loop) {
  std::ranges::sort(triangles);
  std::ranges::sort(vertices);
  if (!triangles.empty()) {
    const std::size_t left = mesh.triangles.size() - triangles.size();
    std::vector<TriId> number(triangles.size(), kNone);  // of those from `left` on
    mesh.triangles.resize(fillHoles(triangles, mesh.triangles.size(), [&](TriId from, TriId to) {
      number[from - left] = to;
      const Triangle moved = mesh.triangles[from];
      mesh.triangles[to] = unlinked(moved.v);
      for (unsigned i = 0; i < 3; ++i) link(mesh.triangles, edgeRef(to, i), moved.adj[i], moved.seg[i]);
    }));
    for (TriId& t : followed)
      if (t >= left) t = number[t - left];
  }
  if (vertices.empty()) return;
  const std::size_t left = mesh.points.size() - vertices.size();
  std::vector<VertexId> number(vertices.size(), kNone);
  mesh.points.resize(fillHoles(vertices, mesh.points.size(), [&](VertexId from, VertexId to) {
    number[from - left] = to;
    mesh.points[to] = mesh.points[from];
  }));
  forEachByStretches(loop, mesh.triangles.size(), [&](std::size_t t) {
    for (VertexId& v : mesh.triangles[t].v)
      if (v >= left) v = number[v - left];
  });
}

}  // namespace

BulkList<TriId> putBack(TriMesh& parent, const Submesh& patch, const TriMesh& solved, const ItemLoop& loop) {
  struct Beyond {
    VertexId from, to;
    EdgeRef twin;
    SegmentId seg;
    auto operator<=>(const Beyond&) const = default;
  };
  const auto endsOf = [](const Beyond& b) { return std::pair(b.from, b.to); };
  std::vector<Beyond> beyond(patch.frozen.size());
  forEachByStretches(loop, beyond.size(), [&](std::size_t i) {
    const EdgeRef e = patch.frozen[i];
    beyond[i] = {parent.origin(e), parent.target(e), parent.twin(e), parent.segment(e)};
  });
  sortOn(loop, beyond);

  // Old numbers first, then new ones.
  const auto numbersFor = [&loop](std::size_t count, std::span<const std::uint32_t> old, std::size_t next) {
    BulkList<std::uint32_t> numbers = unsetList<std::uint32_t>(count);
    forEachByStretches(loop, count, [&](std::size_t i) {
      numbers[i] = i < old.size() ? old[i] : static_cast<std::uint32_t>(next + i - old.size());
    });
    return numbers;
  };
  const BulkList<VertexId> vertex = numbersFor(solved.points.size(), patch.parent, parent.points.size());
  BulkList<TriId> triangle = numbersFor(solved.triangles.size(), patch.triangles, parent.triangles.size());
  parent.points.resize(parent.points.size() + vertex.size() - std::min(vertex.size(), patch.parent.size()));
  parent.triangles.resize(parent.triangles.size() + triangle.size() -
                          std::min(triangle.size(), patch.triangles.size()));
  forEachByStretches(loop, vertex.size() - solved.input_vertices, [&](std::size_t i) {
    const std::size_t v = solved.input_vertices + i;
    parent.points[vertex[v]] = solved.points[v];
  });
  // What lies beyond a frozen edge is in no patch: threads write different sides of its triangle.
  forEachByStretches(loop, triangle.size(), [&](std::size_t t) {
    parent.triangles[triangle[t]] = renumbered(
        solved.triangles[t], [&](TriId n) { return triangle[n]; }, [&](VertexId v) { return vertex[v]; });
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(triangle[t], i);
      if (parent.segment(e) != kFrozen) continue;
      const auto at = std::ranges::lower_bound(beyond, std::pair(parent.origin(e), parent.target(e)), {}, endsOf);
      assert(at != beyond.end() && endsOf(*at) == std::pair(parent.origin(e), parent.target(e)));
      link(parent.triangles, e, at->twin, at->seg);
    }
  });
  const auto beyondOf = [](const std::vector<std::uint32_t>& old, std::size_t count) {
    return std::vector<std::uint32_t>(old.begin() + static_cast<std::ptrdiff_t>(std::min(count, old.size())),
                                      old.end());
  };
  removeUnused(parent, beyondOf(patch.triangles, triangle.size()), beyondOf(patch.parent, vertex.size()), triangle,
               loop);
  assert(findBrokenLink(parent.triangles) == kNone);
  return triangle;
}

}  // namespace coastmesh
