#pragma once

#include <cstddef>
#include <functional>

#include "core/point.hpp"
#include "core/size_function.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// A size function from any other, for tests.
class SizeOf final : public SizeFunction {
 public:
  SizeOf(double least, double most, std::function<double(const Point&)> f)
      : least_(least), most_(most), f_(std::move(f)) {}

  double at(const Point& x) const override;
  double least() const override { return least_; }
  double most() const override { return most_; }

 private:
  double least_, most_;
  std::function<double(const Point&)> f_;
};

// How near a mesh comes to the lengths wanted.
struct SizeFigures {
  double median = 0.0;          // of an edge's length over the length wanted at its middle
  double share_within = 0.0;    // of the edges: 0.7 to 1.4 of what is wanted
  double vertices_share = 0.0;  // of the integral of 2 / (sqrt(3) h²), the fewest that equilateral triangles need
};
SizeFigures sizeFigures(const TriMesh& mesh, const SizeFunction& size);

}  // namespace coastmesh
