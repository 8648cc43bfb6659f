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

// An end of a piece of a line: a point of the line, or one where it meets the shore.
struct LineNode {
  Point at;
  VertexId vertex = kNone;   // of the shores, if it is one
  SegmentId shore = kNone;   // that it lies on, if it is none
  std::uint32_t of = kNone;  // the point of the lines that it is, or kNone

  bool isAtShore() const { return vertex != kNone || shore != kNone; }
};

struct LinePiece {
  std::uint32_t a, b;  // nodes
  SegmentId of;        // the line's
};

// Cuts lines at shores that they were not made for.
class LineCutter {
 public:
  // `shores`: labelled, without lines. `lines`: between points `at`. All are kept by reference.
  LineCutter(const Pslg& shores, const std::vector<Point>& at, const std::vector<Segment>& lines,
             const SizeFunction& size);

  // Appends what of a line lies in its water, and the rest to `dry`. Ends at a shore are vertices of it within a tenth
  // of the size, if nothing lies between.
  void cut(SegmentId line, std::vector<LinePiece>& pieces, std::vector<std::pair<Point, Point>>& dry);

  const std::vector<LineNode>& nodes() const { return nodes_; }
  std::uint32_t addNode(const Point& x);

  // The region of water at x, or kOutside.
  RegionId waterAt(const Point& x) const;

  // Whether a shore is nearer to x than so much.
  bool isShoreWithin(const Point& x, double distance) const;

  // Whether an end of a line, or of a piece of one, is at x.
  bool hasNodeAt(const Point& x) const;

  // Whether both nodes lie on the same segment of the shore.
  bool areOnOneShore(std::uint32_t a, std::uint32_t b) const;

  // A piece of a line from the node straight to the nearest shore, if there is one within `most` and nothing lies
  // between.
  std::optional<LinePiece> leadToShore(std::uint32_t node, SegmentId line, double most);

  // For each shore, the nodes on it that are no vertices, in no order.
  const std::vector<std::vector<std::uint32_t>>& cuts() const { return cuts_; }

 private:
  struct Crossing {
    Point at;
    double along = 0.0;  // the line
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
  std::vector<LineNode> nodes_;  // first those that are points of lines
  std::vector<std::vector<std::uint32_t>> cuts_;
  // Of each line: its pieces that are no whole segments, from end to end; and how far any of them reaches beyond the
  // box of its line.
  std::vector<std::vector<std::pair<Point, Point>>> cut_pieces_;
  double beyond_ = 0.0;
};

}  // namespace coastmesh
