#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gis/crs/crs.hpp"
#include "gis/geometry/box.hpp"
#include "gis/model/boundary_rules.hpp"

namespace coastmesh {

struct BoundaryOptions {
  std::vector<std::string> files{};  // vector files whose polygons and lines define boundary types: see BoundaryRules
  std::string column{};              // the column of types; empty: the first named type, role, boundary, ibtype or kind
  // Rules read beforehand, for several grids, or because a stream can be read only once. Rules of the input are applied
  // before those of `files`.
  BoundaryRules of_input{};
  std::optional<std::vector<BoundaryRules>> of_files{};  // one for each of `files`; nullopt: read when needed
  // Metres: edges of outer loops are open if both ends are deeper, unless a file defines them.
  double open_deeper_m = std::numeric_limits<double>::infinity();
  double least_length_m = 0.0;  // metres: a boundary shorter than this is merged into the longer one beside it

  // The frame of the domain, in the mesh's CRS; an east less than the west is beyond the antimeridian. Its openings and
  // rivers are missed even where the water ends before it.
  std::optional<Box> frame{};

  bool opensByDepth() const { return open_deeper_m < 1e300; }
  bool any() const {
    return !files.empty() || !column.empty() || !of_input.empty() || opensByDepth() || least_length_m > 0.0;
  }
};

// What a file, or the input, asks for in vain.
struct MissedOfFile {
  std::string file;
  bool idle = false;               // it defines nothing, which `warnings` says
  std::vector<MissedRule> missed;  // including those outside the mesh
};

struct BoundaryReport {
  std::size_t edges_by_file = 0;        // boundary edges defined by the input or a file
  std::size_t edges_by_depth = 0;       // boundary edges opened by their depth
  std::size_t merged = 0;               // boundaries that were too short
  std::vector<std::size_t> idle_files;  // indices of `files` that define no boundary edge
  std::vector<std::string> warnings;    // one for each of these, and if depths open no edge
  std::vector<MissedOfFile> missed;
};

// Warnings of what is missed within the mesh, unless the file is idle.
std::vector<std::string> missedWarnings(const MissedOfFile& file);

// The boundary edges of a mesh, or of a domain to be meshed, loop by loop; all loops are closed.
struct BoundaryEdges {
  std::vector<NodePair> edges;         // of `places`
  std::vector<std::size_t> loop_ends;  // the end of each loop in `edges`
  std::vector<BoundaryKind> kinds;     // of each edge; islands count as land
  std::vector<bool> outer;             // of each edge: its loop surrounds the mesh
  std::vector<double> share{};         // see `BoundaryRules::kindsOf`
  // Of each edge: the number of the rule that makes it an opening or river; kNone: none. Set by `defineKinds`.
  std::vector<std::uint32_t> asked{};
};

// The places of the ends of boundary edges, in a CRS. `z` is positive up, and only used to open boundaries by their
// depth.
struct BoundaryPlaces {
  const Crs& crs;
  std::span<const Point> places;
  const std::vector<double>& z;
};

// Sets `kinds` by files and depths. Sizes before meshing and the grid both use this function, so that they agree.
// Throws InputError.
BoundaryReport defineKinds(const BoundaryPlaces& at, const BoundaryOptions& options, BoundaryEdges& boundary,
                           const ItemLoop& loop = inOrder);

// Merges boundaries shorter than `least_m` metres, the shortest first, into the longer one beside them; returns their
// number. Each opening or river of a rule keeps its longest part.
std::size_t mergeShort(const BoundaryPlaces& at, double least_m, BoundaryEdges& boundary);

// Reads `options.files`. Throws InputError.
std::vector<BoundaryRules> readBoundaryFiles(const BoundaryOptions& options);

}  // namespace coastmesh
