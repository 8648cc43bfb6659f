#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/point.hpp"

namespace coastmesh {

// An edit made by an earlier `coastmesh clean`, as recorded in its output file.
struct EarlierEdit {
  std::string kind;
  Point place;
  std::int64_t fid = 0;
  std::string source{};  // of the feature; empty in files of earlier versions
};

struct ReadReport {
  std::uint64_t features = 0;        // in the coastline, and those not read
  std::uint64_t points = 0;          // coordinates in the files, repeated ones included
  std::uint64_t rings = 0;           // of polygons, including those made of lines
  std::uint64_t skipped_empty = 0;   // features without a geometry, or with an empty one
  std::uint64_t skipped_points = 0;  // point geometries, which cannot be meshed
  std::uint64_t filtered = 0;        // features excluded by a user's filter
  std::uint64_t beyond_frame = 0;    // features excluded by framing: see `frameCoastline`
  std::uint64_t not_read = 0;        // of those, the features whose place was known from an index: not in other counts
  std::uint64_t unclosed_rings = 0;  // rings of polygons whose last point is not the first; they were closed
  bool cleaned = false;              // a source was written by `coastmesh clean`
  std::vector<EarlierEdit> edits;
  std::vector<std::string> warnings;
  std::vector<std::string> notes;  // decisions where the input was ambiguous
};

}  // namespace coastmesh
