// The closest edge of a boundary, and the places along lines that it is searched for, against all edges.
#include "gis/rules/edge_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "gis/rules/line_walks.hpp"

namespace coastmesh {
namespace {

// Edges of a winding coast about a place, and of a lattice, where many edges are equally close.
std::vector<NearEdge> coastAt(const Point& centre, const RulePlane& plane) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> offset(-0.02, 0.02);
  std::vector<NearEdge> edges;
  const auto add = [&](const Point& a, const Point& b, bool outer) {
    PlacedEdge edge{a, b};
    edge.length = edge.element = plane.distance(a, b);
    edge.outer = outer;
    edges.push_back({edge});
  };
  Point last{centre.x - 1.0, centre.y};
  for (int i = 1; i <= 400; ++i) {
    const Point next{centre.x - 1.0 + i / 200.0, centre.y + 0.3 * std::sin(i / 20.0) + offset(random)};
    add(last, next, true);
    last = next;
  }
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j) {
      const Point corner{centre.x + i / 8.0, centre.y + 0.5 + j / 8.0};
      add(corner, {corner.x + 0.125, corner.y}, false);
      add(corner, {corner.x, corner.y + 0.125}, false);
    }
  return edges;
}

Closest closestOfAll(const std::vector<NearEdge>& edges, const RulePlane& plane, const Point& p, bool outer_only) {
  Closest best;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (const double turn : plane.turns()) {
      double share = 0.0;
      const double distance = plane.distance({p.x + turn, p.y}, edges[i].edge.a, edges[i].edge.b, &share);
      if ((edges[i].edge.outer || !outer_only) && distance < best.distance) best = {i, distance, share};
    }
  }
  return best;
}

void expectSame(const Closest& found, const Closest& expected) {
  EXPECT_EQ(found.edge, expected.edge);
  EXPECT_EQ(found.distance, expected.distance);
  EXPECT_EQ(found.share, expected.share);
}

TEST(EdgeSearch, IsTheFirstClosestOfAllWhateverIsGuessed) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> offset(-2.0, 2.0);
  for (const bool geographic : {true, false}) {
    const RulePlane plane(geographic);
    const Point centre{179.9, 60.0};
    const std::vector<NearEdge> edges = coastAt(centre, plane);
    std::uniform_int_distribution<std::size_t> guess(0, edges.size() - 1);
    const EdgeSearch search(edges, plane, inOrder);
    for (int i = 0; i < 3000; ++i) {
      Point p{centre.x + offset(random), centre.y + offset(random)};
      if (i % 3 == 0)
        p = {centre.x + std::round(16.0 * offset(random)) / 16.0, centre.y + std::round(8.0 * offset(random)) / 8.0};
      if (i % 5 == 0) p.x -= geographic ? 360.0 : 50.0;
      const bool outer_only = i % 2 == 0;
      const Closest expected = closestOfAll(edges, plane, p, outer_only);
      expectSame(search.closestTo(p, outer_only), expected);
      expectSame(search.closestTo(p, outer_only, guess(random)), expected);
    }
  }
}

TEST(EdgeSearch, FindsNothingWhereThereIsNothing) {
  const RulePlane plane(true);
  const std::vector<NearEdge> none;
  EXPECT_FALSE(EdgeSearch(none, plane, inOrder).closestTo({1.0, 2.0}, false).any());
  std::vector<NearEdge> edges = coastAt({0.0, 0.0}, plane);
  for (NearEdge& near : edges) near.edge.outer = false;
  const EdgeSearch search(edges, plane, inOrder);
  EXPECT_FALSE(search.closestTo({1.0, 2.0}, true).any());
  EXPECT_FALSE(search.closestTo({1.0, 2.0}, true, 3).any());
  // A point: the mean size of edges is zero.
  const std::vector<NearEdge> point{{PlacedEdge{{4.0, 5.0}, {4.0, 5.0}}}};
  EXPECT_EQ(EdgeSearch(point, plane, inOrder).closestTo({4.0, 6.0}, false).distance, 1.0);
}

// Places one after another, as a single thread would find them: that before decides how far the next one is.
Walk walkInOrder(const RuleChain& chain, const std::vector<NearEdge>& edges, const RulePlane& plane) {
  double whole = 0.0;
  for (const RuleLine& line : chain)
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
      whole += plane.distance(line.points[i], line.points[i + 1]);
  Walk walk;
  const auto add = [&](const Point& p, double length, std::size_t rule) {
    walk.push_back({p, length, rule, closestOfAll(edges, plane, p, false)});
  };
  for (const RuleLine& line : chain) {
    add(line.points.front(), 0.0, line.rule);
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
      const Point &a = line.points[i], &b = line.points[i + 1];
      const double length = plane.distance(a, b);
      for (double at = 0.0; at < length;) {
        const Closest& closest = walk.back().closest;
        const PlacedEdge& edge = edges[closest.edge].edge;
        const double away = 0.5 * (closest.distance - kWall * edge.element);
        const double step = std::min(std::max({0.125 * edge.length, away, whole / 1e6}), length - at);
        at = length - at - step < 1e-9 * length ? length : at + step;
        const double share = at / length;
        add({a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)}, step, line.rule);
      }
    }
  }
  return walk;
}

TEST(LineWalks, AreThoseOfASingleThread) {
  const auto backwards = [](std::size_t count, const std::function<void(std::size_t)>& work) {
    for (std::size_t i = count; i-- > 0;) work(i);
  };
  const RulePlane plane(true);
  const Point centre{179.9, 60.0};
  const std::vector<NearEdge> edges = coastAt(centre, plane);
  const EdgeSearch search(edges, plane, inOrder);
  // More points than one thread takes at once, some of them repeated, also where one thread's share ends.
  RuleLine line{0, {}};
  for (int i = 0; i <= 1200; ++i) {
    line.points.push_back({centre.x - 1.5 + i / 400.0, centre.y + 0.3 * std::sin(i / 40.0)});
    if (i % 64 >= 60) line.points.push_back(line.points.back());
  }
  const RuleLine short_line{1, {line.points.back(), {centre.x + 2.0, centre.y}}};
  const RuleLine repeated{2, {centre, centre, centre}};
  const std::vector<RuleChain> chains{{line, short_line}, {repeated}, {short_line}};
  for (const ItemLoop& loop : {ItemLoop(inOrder), ItemLoop(backwards)}) {
    const std::vector<Walk> walks = walksAlong(chains, edges, plane, search, loop);
    ASSERT_EQ(walks.size(), chains.size());
    for (std::size_t c = 0; c < chains.size(); ++c) {
      const Walk expected = walkInOrder(chains[c], edges, plane);
      ASSERT_EQ(walks[c].size(), expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(walks[c][i].place, expected[i].place);
        EXPECT_EQ(walks[c][i].length, expected[i].length);
        EXPECT_EQ(walks[c][i].rule, expected[i].rule);
        expectSame(walks[c][i].closest, expected[i].closest);
      }
    }
  }
}

}  // namespace
}  // namespace coastmesh
