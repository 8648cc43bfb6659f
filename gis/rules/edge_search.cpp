#include "gis/rules/edge_search.hpp"

#include <algorithm>

namespace coastmesh {
namespace {

// Rounding may make the distance to a box a little greater than that to the edge in it.
constexpr double kRounding = 1.0 + 1e-9;

}  // namespace

// A search for the edge closest to one place.
class EdgeSearch::Query {
 public:
  Query(const EdgeSearch& search, const Point& p, bool outer_only)
      : search_(search), p_(p), shrink_(search.plane_.shrinkAt(p.y)), outer_only_(outer_only) {}

  const Closest& best() const { return best_; }

  void considerEdge(std::uint32_t edge) {
    for (const double turn : search_.plane_.turns()) consider({p_.x + turn, p_.y}, edge);
  }

  // Considers edges in a growing box around the place until there is one: in the order of the tree, distances would
  // decrease only slowly.
  void considerSome() {
    const Box bounds = search_.tree_.bounds();
    for (double reach = search_.edge_size_; !best_.any(); reach *= 4.0) {
      bool all = true;
      for (const double turn : search_.plane_.turns()) {
        const Point place{p_.x + turn, p_.y};
        const Box box = search_.plane_.around(Box::of(place, place), reach);
        all = all && box.contains(bounds);
        search_.tree_.visit(box, [&](std::uint32_t i) { consider(place, i); });
      }
      if (all || !(reach > 0.0) || !(reach < 1e300)) return;
    }
  }

  void considerAll() {
    for (const double turn : search_.plane_.turns()) {
      const Point place{p_.x + turn, p_.y};
      search_.tree_.descend([&](const Box& box, std::size_t, std::size_t) { return mayHaveCloser(place, box); },
                            [&](std::uint32_t i) { consider(place, i); });
    }
  }

 private:
  void consider(const Point& place, std::uint32_t i) {
    const PlacedEdge& edge = search_.edges_[i].edge;
    if (outer_only_ && !edge.outer) return;
    double share = 0.0;
    const double distance = RulePlane::distance(place, edge.a, edge.b, shrink_, &share);
    const bool closer = distance < best_.distance || (distance == best_.distance && i < best_.edge);
    if (closer) best_ = {i, distance, share};
  }
  bool mayHaveCloser(const Point& place, const Box& box) const {
    const double dx = std::max({0.0, box.xmin - place.x, place.x - box.xmax}) * shrink_;
    const double dy = std::max({0.0, box.ymin - place.y, place.y - box.ymax});
    return dx * dx + dy * dy <= kRounding * best_.distance * best_.distance;
  }

  const EdgeSearch& search_;
  const Point p_;
  const double shrink_;
  const bool outer_only_;
  Closest best_;
};

EdgeSearch::EdgeSearch(const std::vector<NearEdge>& edges, const RulePlane& plane, const ItemLoop& loop)
    : edges_(edges), plane_(plane) {
  std::vector<Box> boxes;
  double sum = 0.0;
  for (const NearEdge& near : edges) {
    boxes.push_back(Box::of(near.edge.a, near.edge.b));
    sum += std::max(boxes.back().xmax - boxes.back().xmin, boxes.back().ymax - boxes.back().ymin);
  }
  tree_ = BoxTree(boxes, BoxTree::Order::Hilbert, loop);
  edge_size_ = edges.empty() ? 0.0 : sum / static_cast<double>(edges.size());
}

Closest EdgeSearch::closestTo(const Point& p, bool outer_only, std::size_t guess) const {
  Query query(*this, p, outer_only);
  if (guess < edges_.size()) query.considerEdge(static_cast<std::uint32_t>(guess));
  if (!query.best().any()) query.considerSome();
  query.considerAll();
  return query.best();
}

}  // namespace coastmesh
