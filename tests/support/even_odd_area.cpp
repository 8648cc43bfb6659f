#include "tests/support/even_odd_area.hpp"

#include <algorithm>
#include <cmath>

namespace coastmesh {

namespace {

using Real = long double;

struct PlainEdge {
  Real x1, y1, x2, y2;  // x1 < x2
  std::size_t feature;

  Real heightAt(Real x) const { return y1 + (y2 - y1) * ((x - x1) / (x2 - x1)); }
};

void addRing(const Ring& ring, std::size_t feature, std::vector<PlainEdge>& edges) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    Point a = ring[i], b = ring[(i + 1) % ring.size()];
    if (a.x == b.x) continue;
    if (a.x > b.x) std::swap(a, b);
    edges.push_back({a.x, a.y, b.x, b.y, feature});
  }
}

}  // namespace

std::vector<double> evenOddAreas(const std::vector<Feature>& features) {
  std::vector<PlainEdge> edges;
  for (std::size_t f = 0; f < features.size(); ++f) {
    for (const Polygon& polygon : features[f].polygons) {
      addRing(polygon.outer, f, edges);
      for (const Ring& hole : polygon.holes) addRing(hole, f, edges);
    }
  }
  std::vector<Real> cuts;
  for (const PlainEdge& e : edges) cuts.insert(cuts.end(), {e.x1, e.x2});
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size(); ++j) {
      const PlainEdge &e = edges[i], &f = edges[j];
      const Real slope_e = (e.y2 - e.y1) / (e.x2 - e.x1), slope_f = (f.y2 - f.y1) / (f.x2 - f.x1);
      if (slope_e == slope_f) continue;
      const Real x = e.x1 + (f.heightAt(e.x1) - e.y1) / (slope_e - slope_f);
      if (x > std::max(e.x1, f.x1) && x < std::min(e.x2, f.x2)) cuts.push_back(x);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  std::vector<double> areas(features.size(), 0.0);
  std::vector<std::pair<Real, std::size_t>> column;
  for (std::size_t c = 1; c < cuts.size(); ++c) {
    const Real middle = (cuts[c - 1] + cuts[c]) / 2, width = cuts[c] - cuts[c - 1];
    if (width <= 0) continue;
    column.clear();
    for (const PlainEdge& e : edges) {
      if (e.x1 < middle && middle < e.x2) column.emplace_back(e.heightAt(middle), e.feature);
    }
    std::sort(column.begin(), column.end());
    std::vector<char> inside(features.size(), 0);
    for (std::size_t i = 0; i + 1 < column.size(); ++i) {
      inside[column[i].second] ^= 1;
      const auto first = std::find(inside.begin(), inside.end(), 1);
      if (first == inside.end()) continue;
      areas[static_cast<std::size_t>(first - inside.begin())] +=
          static_cast<double>((column[i + 1].first - column[i].first) * width);
    }
  }
  return areas;
}

}  // namespace coastmesh
