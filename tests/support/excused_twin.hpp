#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/input_corners.hpp"
#include "core/pslg.hpp"
#include "core/refine/refine.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// The results of InputCorners for a mesh with a known input, computed independently from the definition, and slowly:
// considers every constraint for every apex, and every apex for every triangle.
class ExcusedTwin {
 public:
  ExcusedTwin(const TriMesh& mesh, const Pslg& pslg, double min_angle_deg, double max_angle_deg);

  Excuse excuseOf(TriId t) const;
  std::size_t corners() const { return corners_.size(); }

 private:
  struct Corner {
    VertexId apex;
    double from, gap;  // angles in radians: direction of one constraint, and the turn to the next
    double size;       // the local feature size
  };
  bool fills(TriId t, VertexId apex, double from, double gap) const;

  const TriMesh& mesh_;
  std::vector<Corner> corners_;
};

// Describes errors in the list of bound violations: a triangle that clearly violates `options`, is not excused and not
// listed; or one that is listed but clearly meets them or is excused. Empty if the list is right.
std::string wrongBoundViolations(const TriMesh& mesh, const Pslg& pslg, const RefineOptions& options,
                                 const std::vector<BoundViolation>& listed);

}  // namespace coastmesh
