#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/metric.hpp"
#include "core/tri_mesh.hpp"
#include "gis/geometry/box.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// The outline of a mesh that is put into another one: its outer loops, and those around holes that it has open
// boundaries to. All that it surrounds is the inserted mesh's, islands included.
class Outline {
 public:
  // An edge, with the mesh to its left.
  struct Edge {
    std::uint32_t a = kNone, b = kNone;
    bool joins = false;  // the other mesh may continue here: an open boundary; all edges if there is none; `join`
  };

  // `mesh` is the grid's, from `linkGrid`. REQUIRES: the grid outlives it.
  Outline(const Grid& grid, const TriMesh& mesh, const ItemLoop& loop = inOrder);

  // The other mesh may continue at these edges too.
  void join(std::span<const std::uint32_t> edges);

  const std::vector<Edge>& edges() const { return edges_; }
  bool hasOpen() const { return has_open_; }
  const Box& box() const { return box_; }
  const Point& place(std::uint32_t node) const { return grid_.nodes[node]; }

  // Calls `found(edge)` with the index of each edge whose box meets `query`.
  template <typename Found>
  void visit(const Box& query, Found&& found) const {
    tree_.visit(query, found);
  }
  // True if the place is nearer to an edge for which `counts(edge)`, an index, than this share of the edge's length.
  template <typename Counts>
  bool isNear(const Point& place, double share, const Counts& counts) const {
    bool is_near = false;
    visit(Box::of(place, place).grownBy(share * longest_), [&](std::uint32_t e) {
      const Point &a = this->place(edges_[e].a), &b = this->place(edges_[e].b);
      is_near = is_near || (squaredDistanceToSegment(place, a, b) < share * share * squaredDistance(a, b) && counts(e));
    });
    return is_near;
  }
  // True if the outline surrounds the place. Exact; places on an edge are on either side.
  bool surrounds(const Point& place) const;
  // True if the place is exactly on an edge.
  bool passes(const Point& place) const;

 private:
  const Grid& grid_;
  std::vector<Edge> edges_;
  bool has_open_ = false;
  Box box_;
  double longest_ = 0.0;  // edge
  BoxTree tree_;
};

}  // namespace coastmesh
