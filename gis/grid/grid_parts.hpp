#pragma once

#include <cstdint>
#include <initializer_list>

namespace coastmesh {

// What a grid may hold besides nodes, their depths, triangles, and the open boundaries.
enum class GridPart : std::uint8_t {
  Title,
  Quads,         // quadrilaterals; otherwise two triangles each
  Sizes,         // the requested edge length at each node
  Features,      // the feature of each triangle
  FeatureNames,  // names and sources of features
  Regions,       // names of regions, by triangle
  Pieces,        // the piece that a triangle was refined in
  Partition,     // the part of a triangle, for solvers
  NodePartition,
  Lines,  // lines inside the mesh, and their kinds
  LineNames,
  Rivers,     // which boundaries are rivers
  Ibtypes,    // ADCIRC's types of boundaries that do not follow from the role
  Weirs,      // nodes across, heights and coefficients of weirs
  BareWeirs,  // boundaries of a weir's type without these
  BoundaryNames,
  PartIslands,  // boundaries of an island's type that are only a part of a shore
  NodeFields,
};

// A set of them.
struct GridParts {
  std::uint32_t bits = 0;

  constexpr GridParts() = default;
  constexpr GridParts(std::initializer_list<GridPart> parts) {
    for (const GridPart part : parts) bits |= bitOf(part);
  }
  constexpr bool has(GridPart part) const { return (bits & bitOf(part)) != 0; }

 private:
  static constexpr std::uint32_t bitOf(GridPart part) { return 1u << static_cast<unsigned>(part); }
};

}  // namespace coastmesh
