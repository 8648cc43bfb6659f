#pragma once

#include <cstddef>
#include <functional>

#include "core/point.hpp"
#include "core/size_function.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// A size function made from any function, for tests.
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

// How closely a mesh meets the requested lengths.
struct SizeFigures {
  double median = 0.0;          // of edge length over requested length at the edge's middle
  double share_within = 0.0;    // of edges with 0.7 to 1.4 times the requested length
  double vertices_share = 0.0;  // of the integral of 2 / (sqrt(3) h²), the fewest that equilateral triangles need
};
SizeFigures sizeFigures(const TriMesh& mesh, const SizeFunction& size);

}  // namespace coastmesh
