#pragma once

#include <string>

#include "core/pslg.hpp"
#include "core/refine/check.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Fails the running test for every defect that `checkMesh` finds, and prints its place with all digits.
void expectValidMesh(const TriMesh& mesh, const Pslg& pslg, const CheckOptions& options = {});

// The same for a mesh without an input.
void expectValidMesh(const TriMesh& mesh, const CheckOptions& options = {});

// The defects as text, a line each, at most the first few. Empty if there are none.
std::string describe(const std::vector<MeshDefect>& defects);

// A mesh from triangles, without input and constraints. Fails the test if the triangles cannot be linked.
TriMesh meshOf(std::vector<Point> points, const std::vector<std::array<VertexId, 3>>& corners);

}  // namespace coastmesh
