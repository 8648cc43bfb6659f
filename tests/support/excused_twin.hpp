#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/input_corners.hpp"
#include "core/pslg.hpp"
#include "core/refine/refine.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// What InputCorners says of a mesh of ours, once more from its definition, by other means and in no hurry: every
// constraint is looked at for every apex, every apex for every triangle.
class ExcusedTwin {
 public:
  ExcusedTwin(const TriMesh& mesh, const Pslg& pslg, double min_angle_deg, double max_angle_deg);

  Excuse excuseOf(TriId t) const;
  std::size_t corners() const { return corners_.size(); }

 private:
  struct Corner {
    VertexId apex;
    double from, gap;  // directions in radians: from that of one constraint up to the next
    double size;       // the local feature size
  };
  bool fills(TriId t, VertexId apex, double from, double gap) const;

  const TriMesh& mesh_;
  std::vector<Corner> corners_;
};

// What is wrong with the bound violations listed for a mesh: a triangle that clearly falls short of `options`, that
// nothing excuses, and that is not listed; or one listed that clearly holds them, or is excused. Empty where all is
// right.
std::string wrongBoundViolations(const TriMesh& mesh, const Pslg& pslg, const RefineOptions& options,
                                 const std::vector<BoundViolation>& listed);

}  // namespace coastmesh
