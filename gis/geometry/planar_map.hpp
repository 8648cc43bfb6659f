#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/ids.hpp"
#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

// The faces of a plane graph whose edges meet only in common ends. Edge e has two half-edges: 2e from its first end to
// its second, 2e + 1 back. A half-edge belongs to the face on its left; kOuterFace is the unbounded one. Pieces that
// are not connected are nested: the outer loops of the islands in a face belong to it.
//
//              face of h
//     tail ───────h───────▶ head
//          ◀──────h^1──────
//            face of h ^ 1
class PlanarMap {
 public:
  using HalfEdge = std::uint32_t;
  static constexpr std::uint32_t kOuterFace = 0;

  // REQUIRES: exact planarity; no edge twice. `points` and `edges` are not kept.
  PlanarMap(const std::vector<Point>& points, const std::vector<std::pair<VertexId, VertexId>>& edges,
            const ItemLoop& loop = inOrder);

  std::size_t faceCount() const { return face_begin_.size() - 1; }
  std::uint32_t faceOf(HalfEdge h) const { return face_of_[h]; }
  // Half-edges that have the face on their left, of all its boundary loops.
  std::span<const HalfEdge> around(std::uint32_t face) const {
    return {by_face_.data() + face_begin_[face], by_face_.data() + face_begin_[face + 1]};
  }
  // Half-edges that leave the vertex, counter-clockwise.
  std::span<const HalfEdge> leaving(VertexId v) const {
    return {fan_.data() + fan_begin_[v], fan_.data() + fan_begin_[v + 1]};
  }

 private:
  struct Builder;

  std::vector<std::uint32_t> face_of_;
  std::vector<std::uint32_t> face_begin_;
  std::vector<HalfEdge> by_face_;
  std::vector<std::uint32_t> fan_begin_;
  std::vector<HalfEdge> fan_;
};

}  // namespace coastmesh
