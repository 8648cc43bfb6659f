#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/pslg.hpp"
#include "core/size_function.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/geometry/face_locator.hpp"
#include "gis/geometry/planar_map.hpp"

namespace coastmesh {

// An end of a piece of a line: a point of the line, or where it meets the shore.
struct LineNode {
  Point at;
  VertexId vertex = kNone;   // of the shores, or kNone
  SegmentId shore = kNone;   // segment that contains it, if it is no vertex
  std::uint32_t of = kNone;  // point of the lines, or kNone

  bool isAtShore() const { return vertex != kNone || shore != kNone; }
};

struct LinePiece {
  std::uint32_t a, b;  // nodes
  SegmentId of;        // of the line
};

// Cuts lines at shores that have changed since the lines were made.
class LineCutter {
 public:
  // `shores`: labelled, without lines. `lines`: between points `at`. Keeps references to all.
  LineCutter(const Pslg& shores, const std::vector<Point>& at, const std::vector<Segment>& lines,
             const SizeFunction& size);

  // Appends the parts of a line segment in its own water to `pieces`, and the rest to `dry`. A piece ends in a vertex
  // of the shore if one is within a tenth of the size and nothing lies between.
  void cut(SegmentId line, std::vector<LinePiece>& pieces, std::vector<std::pair<Point, Point>>& dry);

  const std::vector<LineNode>& nodes() const { return nodes_; }
  std::uint32_t addNode(const Point& x);

  // The region of water at x, or kOutside.
  RegionId waterAt(const Point& x) const;

  // True if a shore is nearer to x than that.
  bool isShoreWithin(const Point& x, double distance) const;

  // True if an end of a line segment, or of a piece of one, is at x.
  bool hasNodeAt(const Point& x) const;

  // True if both nodes lie on the same segment of the shore.
  bool areOnOneShore(std::uint32_t a, std::uint32_t b) const;

  // A piece of a line from the node straight to the nearest shore; nullopt if none is within `most` or something lies
  // between.
  std::optional<LinePiece> leadToShore(std::uint32_t node, SegmentId line, double most);

  // For each segment of the shores, the nodes on it that are no vertices, unordered.
  const std::vector<std::vector<std::uint32_t>>& cuts() const { return cuts_; }

 private:
  struct Crossing {
    Point at;
    double along = 0.0;  // squared distance from the start of the line segment
    SegmentId shore;
    std::uint32_t node = kNone;
  };

  LineNode nodeOf(std::uint32_t point);
  const Point& at(std::uint32_t node) const { return nodes_[node].at; }
  bool isOf(std::uint32_t node, SegmentId shore) const;
  std::vector<Crossing> crossingsOf(SegmentId line) const;
  std::uint32_t nodeAt(Crossing& crossing, Point inner, std::uint32_t inner_node, SegmentId line, bool leads = false);
  void noteCut(SegmentId line, const Point& a, const Point& b);
  bool fits(std::uint32_t start, const Point& x, std::uint32_t end, SegmentId line, bool leads = false) const;

  const Pslg& shores_;
  const std::vector<Point>& points_;
  const std::vector<Segment>& lines_;
  const SizeFunction& size_;
  std::vector<std::pair<VertexId, VertexId>> edges_;  // of the shores
  PlanarMap map_;
  FaceLocator faces_;
  BoxTree shore_boxes_, line_boxes_;
  std::vector<LineNode> nodes_;  // points of lines first
  std::vector<std::vector<std::uint32_t>> cuts_;
  // For each line segment, the ends of its pieces if it is cut, and how far any of these extends beyond the box of its
  // segment.
  std::vector<std::vector<std::pair<Point, Point>>> cut_pieces_;
  double beyond_ = 0.0;
};

}  // namespace coastmesh
