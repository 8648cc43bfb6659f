#pragma once

#include <stdexcept>
#include <string>

#include "core/pslg.hpp"
#include "core/surface.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// What makes a PSLG unusable, and where.
struct PslgDefect {
  enum class Kind {
    NotFinite,   // of a point or a hole
    OutOfRange,  // a point or a hole beyond kLargestCoordinate, or two points nearer than kLeastDistance
    PointsCoincide,
    SegmentOfNoLength,
    UnknownVertex,
    SegmentsCross,     // `segment` and `other`
    SegmentsCoincide,  // `segment` and `other`
    PointOnSegment,
    LabelsContradict,  // `segment` and `other` label the same place differently
    NoArea
  };
  Kind kind;
  Point place;
  SegmentId segment = kNone;  // the one involved, where there is one
  SegmentId other = kNone;    // and the other one, where there are two
  std::string message;        // a sentence, without the place
};

struct BadPslg : std::runtime_error {
  explicit BadPslg(PslgDefect d) : std::runtime_error(d.message), defect(std::move(d)) {}
  PslgDefect defect;
};

// The constrained Delaunay triangulation of the PSLG's domain: holes and outside are carved, regions labelled.
// Throws BadPslg, and nothing else, where the input is no PSLG or encloses no area. Cost O(n log n) time, O(n) memory.
// The surface is for speed alone: what lies near to one another on it is numbered so.
TriMesh constrainedDelaunay(const Pslg& pslg, const Surface& surface = {});

}  // namespace coastmesh
