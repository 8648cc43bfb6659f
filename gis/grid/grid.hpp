#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "core/pslg.hpp"
#include "core/tri_mesh.hpp"
#include "gis/crs/crs.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// River: water comes in by a discharge; Open: by a level.
enum class BoundaryRole { Land, Island, Open, River };
inline constexpr std::array kBoundaryRoles{BoundaryRole::Land, BoundaryRole::Island, BoundaryRole::Open,
                                           BoundaryRole::River};
std::string_view toString(BoundaryRole role);

// A chain of nodes on the mesh's boundary, the mesh to its left; closed loops do not repeat their first node. Where one
// chain ends and another begins, both have the node.
struct Boundary {
  BoundaryRole role = BoundaryRole::Land;
  bool closed = true;
  std::vector<std::uint32_t> nodes;
  int ibtype = -1;                          // ADCIRC's type where a file or the user says one, else -1: the role's own
  std::vector<std::uint32_t> back_nodes{};  // of a weir between two shores: the node across, one a node
  bool repeats_first = false;               // a file's segment repeated its first node at its end
  std::vector<double> weir{};               // of a weir: heights and coefficients, the same number a node
};

// A line inside the mesh that the user named: a chain of nodes along edges, with the mesh on both sides; a closed one
// does not repeat its first node.
enum class LineKind { Constraint, Weir, RegionBorder };
struct GridLine {
  LineKind kind = LineKind::Constraint;
  std::string name;
  bool closed = false;
  std::vector<std::uint32_t> nodes;
};

// Where a triangle came from.
struct GridFeature {
  std::int64_t fid = 0;
  std::string source;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string region{};  // empty: none was given
};

// A mesh as models and GIS know it: what writers write and readers read.
struct Grid {
  std::string title;
  Crs crs;
  std::vector<Point> nodes;                             // in `crs`; those of `makeGrid` all belong to a triangle
  std::vector<double> z;                                // metres, positive up; empty or one a node, NaN where unknown
  std::vector<double> size_m;                           // empty or one a node: length that edges were to have there
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise
  std::vector<std::uint32_t> feature_of;                // empty or one a triangle: index into `features`
  std::vector<std::uint32_t> piece_of;                  // empty or one a triangle: the piece that it was refined in
  std::vector<std::uint32_t> part_of;                   // empty or one a triangle: the solver's process, from 0
  std::vector<std::uint32_t> node_part_of;              // empty or one a node, likewise
  std::vector<double> min_angle_deg;                    // empty or one a triangle, measured as the mesh was made
  std::vector<double> area_m2;                          // empty or one a triangle, on the ellipsoid
  std::vector<GridFeature> features;
  std::vector<Boundary> boundaries;
  std::vector<GridLine> lines;
  std::vector<std::string> notes;  // what a file says of itself and is not so: "NETA is 12, but 11 nodes follow"
};

// The arrays that have one entry a node, and one a triangle: what edits a grid goes through these. Each names every
// member of Grid, so that a new one does not compile until it is put here where it belongs.
template <typename AnyGrid>
auto nodeArrays(AnyGrid& grid) {
  auto& [title, crs, nodes, z, size_m, triangles, feature_of, piece_of, part_of, node_part_of, min_angle_deg, area_m2,
         features, boundaries, lines, notes] = grid;
  return std::tie(nodes, z, size_m, node_part_of);
}
template <typename AnyGrid>
auto triangleArrays(AnyGrid& grid) {
  auto& [title, crs, nodes, z, size_m, triangles, feature_of, piece_of, part_of, node_part_of, min_angle_deg, area_m2,
         features, boundaries, lines, notes] = grid;
  return std::tie(triangles, feature_of, piece_of, part_of, min_angle_deg, area_m2);
}

// Throws OutputError where a z is unknown; for formats that need one at every node.
void requireZ(const Grid& grid, const std::string& path);

// The grid as a mesh in the plane of `projection` (for checks, figures and plots).
TriMesh toTriMesh(const Grid& grid, const Projection& projection, std::vector<EdgeConflict>& conflicts);

}  // namespace coastmesh
