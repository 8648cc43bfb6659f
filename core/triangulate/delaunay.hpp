#pragma once

#include <stdexcept>
#include <string>

#include "core/item_loop.hpp"
#include "core/pslg.hpp"
#include "core/surface.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// A defect that makes a PSLG unusable.
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
  SegmentId segment = kNone;  // the segment involved, if any
  SegmentId other = kNone;    // the second one, if there are two
  std::string message;        // a sentence, without the place
};

struct BadPslg : std::runtime_error {
  explicit BadPslg(PslgDefect d) : std::runtime_error(d.message), defect(std::move(d)) {}
  PslgDefect defect;
};

// The constrained Delaunay triangulation of the PSLG's domain: holes and outside are removed, regions labelled. Throws
// only BadPslg, if the input is not a valid PSLG or encloses no area. O(n log n) time, O(n) memory. The surface affects
// only the numbering: vertices close together on it get close numbers. The result does not depend on the loop.
TriMesh constrainedDelaunay(const Pslg& pslg, const Surface& surface = {}, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
