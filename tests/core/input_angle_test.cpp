#include "core/input_angle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/edit_mesh.hpp"
#include "core/triangulate/delaunay.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

constexpr double kNoSize = std::numeric_limits<double>::infinity();

// Any corner of a triangle at a vertex.
std::pair<TriId, unsigned> cornerAt(const TriMesh& mesh, VertexId v) {
  for (TriId t = 0; t < mesh.triangles.size(); ++t)
    for (unsigned i = 0; i < 3; ++i)
      if (mesh.triangles[t].v[i] == v) return {t, i};
  ADD_FAILURE() << "no triangle at vertex " << v;
  return {0, 0};
}

TEST(SectorAt, CornersOfASquare) {
  const TriMesh mesh = constrainedDelaunay(squarePslg());
  for (TriId t = 0; t < 2; ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const Sector sector = sectorAt(mesh, t, i);
      EXPECT_NEAR(sector.angle, std::numbers::pi / 2, 1e-15);
      ASSERT_NE(sector.right, kNone);
      ASSERT_NE(sector.left, kNone);
      EXPECT_EQ(mesh.origin(sector.right), mesh.triangles[t].v[i]) << "leaves the vertex";
      EXPECT_EQ(mesh.target(sector.left), mesh.triangles[t].v[i]) << "enters the vertex";
      EXPECT_EQ(mesh.twin(sector.right), kNone);
      EXPECT_EQ(mesh.twin(sector.left), kNone);
    }
  }
}

TEST(SectorAt, VertexWithoutConstraintsHasTheFullCircle) {
  const TriMesh mesh = constrainedDelaunay(randomPointsInBox(3, 20));
  for (VertexId v = 4; v < mesh.points.size(); ++v) {
    const auto [t, i] = cornerAt(mesh, v);
    const Sector sector = sectorAt(mesh, t, i);
    EXPECT_NEAR(sector.angle, 2 * std::numbers::pi, 1e-12);
    EXPECT_EQ(sector.right, kNone);
    EXPECT_EQ(sector.left, kNone);
    EXPECT_GE(sector.triangles, 3u);
  }
}

TEST(SectorAt, EndOfAnOpenLineHasTheFullCircleBetweenItsTwoSides) {
  const Pslg pslg = openLines();
  const TriMesh mesh = constrainedDelaunay(pslg);
  const auto [t, i] = cornerAt(mesh, 4);  // the first line begins there
  const Sector sector = sectorAt(mesh, t, i);
  EXPECT_NEAR(sector.angle, 2 * std::numbers::pi, 1e-12);
  ASSERT_NE(sector.right, kNone);
  EXPECT_EQ(mesh.segment(sector.right), mesh.segment(sector.left));
  EXPECT_EQ(mesh.twin(sector.right), sector.left);
}

// At every vertex the sectors of its corners are the gaps between the segments that leave it.
TEST(SectorAt, SectorsAreTheGapsBetweenSegments) {
  for (const NamedPslg& named : assortedPslgs()) {
    SCOPED_TRACE(named.name);
    const Pslg& pslg = named.pslg;
    if (pslg.segments.empty()) continue;
    const TriMesh mesh = constrainedDelaunay(pslg);
    std::vector<std::vector<double>> directions(pslg.points.size());
    for (const Segment& s : pslg.segments) {
      const Point d = pslg.points[s.b] - pslg.points[s.a];
      directions[s.a].push_back(std::atan2(d.y, d.x));
      directions[s.b].push_back(std::atan2(-d.y, -d.x));
    }
    const EditMesh edit{TriMesh(mesh)};
    for (TriId t = 0; t < mesh.triangles.size(); ++t) {
      for (unsigned i = 0; i < 3; ++i) {
        const VertexId v = mesh.triangles[t].v[i];
        if (directions[v].empty()) continue;
        const Sector sector = sectorAt(mesh, t, i);
        const Point d = mesh.points[mesh.target(sector.right)] - mesh.points[v];
        const double from = std::atan2(d.y, d.x);
        double gap = 2 * std::numbers::pi;
        for (const double to : directions[v]) {
          double turn = to - from;
          while (turn < 1e-12) turn += 2 * std::numbers::pi;
          gap = std::min(gap, turn);
        }
        EXPECT_NEAR(sector.angle, gap, 1e-9) << "vertex " << v;
        const Sector same = sectorAt(edit, t, i);
        EXPECT_EQ(same.angle, sector.angle);
        EXPECT_EQ(same.right, sector.right);
        EXPECT_EQ(same.left, sector.left);
        EXPECT_EQ(same.triangles, sector.triangles);
      }
    }
  }
}

TEST(CanDivide, AnAngleOfNextToNothingIsOnePiece) {
  for (const double angle : {1e-20, 1e-12, 1e-10, 1e-9})
    EXPECT_FALSE(TriangleBound(1.5, 180.0, kNoSize).canDivide(angle));
}

TEST(CanDivide, AgreesWithTryingAllNumbersOfPieces) {
  for (const double min_angle : {0.0, 10.0, 20.0, 30.0, 33.0, 38.0, 40.0, 42.0, 45.0}) {
    for (const double max_angle : {180.0, 120.0, 100.0, 95.0, 90.0}) {
      const TriangleBound bound(min_angle, max_angle, kNoSize);
      const double largest = std::min(max_angle, 180.0 - 2.0 * min_angle);
      if (largest < 60.0) continue;
      for (double angle = 0.37; angle < 360.0; angle += 1.01) {
        bool can = false, nearly = false;
        for (int pieces = 1; pieces <= 360; ++pieces) {
          const double piece = angle / pieces;
          can = can || (piece >= min_angle && piece <= largest);
          nearly = nearly || std::abs(piece - min_angle) < 1e-4 || std::abs(piece - largest) < 1e-4;
        }
        if (!nearly) {
          EXPECT_EQ(bound.canDivide(toRadians(angle)), can)
              << angle << " degrees into " << min_angle << " to " << max_angle;
        }
      }
    }
  }
}

}  // namespace
}  // namespace coastmesh
