#pragma once

#include <string>

#include "core/pslg.hpp"
#include "core/refine/check.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Fails the running test with every defect that `checkMesh` finds, its place to the last bit.
void expectValidMesh(const TriMesh& mesh, const Pslg& pslg, const CheckOptions& options = {});

// The same for a mesh without input to compare with.
void expectValidMesh(const TriMesh& mesh, const CheckOptions& options = {});

// The defects as text, a line each, the first few of many. Empty where there are none.
std::string describe(const std::vector<MeshDefect>& defects);

// A mesh by hand, without input and constraints. Fails the test where the triangles do not link.
TriMesh meshOf(std::vector<Point> points, const std::vector<std::array<VertexId, 3>>& corners);

}  // namespace coastmesh
