#pragma once

#include <cmath>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/metric.hpp"
#include "core/refine/refine_options.hpp"

namespace coastmesh {

// The paper's four types, Section 3.
enum class SteinerType : unsigned {
  DualOfShortestEdge = 0,  // I: the off-centre
  OtherVoronoiEdge = 1,    // II
  OtherCircumcenter = 2,   // III
  OwnCircumcenter = 3,     // IV
};

struct SteinerPoint {
  Point place;
  SteinerType type = SteinerType::OwnCircumcenter;
  TriId near = kNone;              // a triangle whose circumcircle contains the point
  double squared_clearance = 0.0;  // to the nearest visible vertex
};

// Finds the point to insert for a bad triangle.
class SteinerSearch {
 public:
  // Points aim at an angle that is `aim` (radians) above the bound.
  SteinerSearch(Algorithm algorithm, const TriangleBound& bound, double aim, double scale = 1.0)
      : algorithm_(algorithm),
        bound_(bound),
        // Slightly above the bound: otherwise rounding makes a triangle with its apex on the petal's boundary bad.
        sin_place_(std::sin(bound.min_angle + toRadians(AngleBound::kMarginDeg) + aim)),
        scale_(scale) {}

  // `t` is bad and its shortest edge is opposite its corner `apex`.
  SteinerPoint find(const EditMesh& mesh, TriId t, unsigned apex);

 private:
  struct Step {
    EdgeRef edge;  // the Voronoi edge to follow is dual to it
    Point from;    // start of that edge: a circumcentre inside the petal, relative to the origin
  };

  Algorithm algorithm_;
  const TriangleBound& bound_;
  double sin_place_;  // of the minimum angle that points aim at
  double scale_;      // factor on the requested lengths that points aim at
  std::vector<Step> steps_;
};

}  // namespace coastmesh
