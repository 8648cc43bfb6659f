#pragma once

#include <stdexcept>
#include <string>

#include "core/pslg.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// What makes a PSLG unusable, and where.
struct PslgDefect {
  enum class Kind {
    NotFinite,
    PointsCoincide,
    SegmentOfNoLength,
    UnknownVertex,
    SegmentsCross,
    SegmentsCoincide,
    PointOnSegment,
    NoArea
  };
  Kind kind;
  Point place;
  SegmentId segment = kNone;  // one of those involved, where there is one
  std::string message;        // a sentence, without the place
};

struct BadPslg : std::runtime_error {
  explicit BadPslg(PslgDefect d) : std::runtime_error(d.message), defect(std::move(d)) {}
  PslgDefect defect;
};

// The constrained Delaunay triangulation of the PSLG's domain: holes and outside are carved, regions labelled.
// Throws BadPslg where the input is no PSLG or encloses no area. Cost O(n log n) time, O(n) memory.
TriMesh constrainedDelaunay(const Pslg& pslg);

}  // namespace coastmesh
