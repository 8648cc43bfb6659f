#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "gis/crs/crs.hpp"
#include "gis/model/boundary_rules.hpp"

namespace coastmesh {

struct BoundaryOptions {
  std::vector<std::string> files{};  // vector files whose polygons and lines define boundary types: see BoundaryRules
  std::string column{};              // the column of types; empty: the first named type, role, boundary, ibtype or kind
  // Read before, for several grids or since a stream can be read only once. What the input itself defines comes before
  // `files`.
  BoundaryRules of_input{};
  std::optional<std::vector<BoundaryRules>> of_files{};  // those of `files`, each; none: they are read when needed
  double open_deeper_m = std::numeric_limits<double>::infinity();  // metres: edges of outer loops are open if both
                                                                   // ends are deeper, unless a file says otherwise
  double least_length_m = 0.0;  // metres: a boundary shorter than this is merged into the longer one beside it

  bool opensByDepth() const { return open_deeper_m < 1e300; }
  bool any() const {
    return !files.empty() || !column.empty() || !of_input.empty() || opensByDepth() || least_length_m > 0.0;
  }
};

struct BoundaryReport {
  std::size_t edges_by_file = 0;        // edges of the boundary, by a file
  std::size_t edges_by_depth = 0;       // edges opened by their depth
  std::size_t merged = 0;               // boundaries that were too short
  std::vector<std::size_t> idle_files;  // of `files`: those that say nothing of the mesh's boundary
  std::vector<std::string> warnings;    // one for each of these
};

// A boundary, of a mesh or of a domain to be meshed, edge by edge: loop after loop, each closed.
struct BoundaryEdges {
  std::vector<NodePair> edges;         // of `places`
  std::vector<std::size_t> loop_ends;  // the end of each loop in `edges`
  std::vector<BoundaryKind> kinds;     // what each is; islands count as land
  std::vector<bool> outer;             // of each edge: its loop goes round the mesh
  std::vector<double> share{};         // see `BoundaryRules::kindsOf`
};

// The places of a boundary's ends, in a CRS. `z` is positive up, and only used to open boundaries by their depth.
struct BoundaryPlaces {
  const Crs& crs;
  const std::vector<Point>& places;
  const std::vector<double>& z;
};

// Sets `kinds` as files and depths say. The only place where that is decided: for sizes before meshing, and for the
// grid. Throws InputError.
BoundaryReport defineKinds(const BoundaryPlaces& at, const BoundaryOptions& options, BoundaryEdges& boundary);

// Merges boundaries shorter than `least_m` metres, the shortest first, into the longer one beside them; returns their
// number.
std::size_t mergeShort(const BoundaryPlaces& at, double least_m, BoundaryEdges& boundary);

// Reads `options.files`. Throws InputError.
std::vector<BoundaryRules> readBoundaryFiles(const BoundaryOptions& options);

}  // namespace coastmesh
