#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "core/size/size_box.hpp"
#include "core/size_function.hpp"
#include "core/surface.hpp"

namespace coastmesh {

struct SizeRange {
  double low = 0.0;
  double high = 0.0;
  // The result of `sample` for the centre of the box, if computing the bounds found it; otherwise NaN.
  double at_centre = std::numeric_limits<double>::quiet_NaN();
  // True if all sources that determine lengths in the box grow at most by the gradation.
  bool is_graded = false;
};

// A source of requested lengths: evaluated at many places at once, so that the work can be shared. Lengths are on the
// surface, above 0; infinite if nothing is requested.
class SizeSource {
 public:
  virtual ~SizeSource() = default;

  virtual void sample(std::span<const Point> places, std::span<double> sizes) const = 0;
  // Outer bounds of the lengths within each box. `low` may be 0 and `high` infinite if nothing is known.
  virtual void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const = 0;
  // True if lengths within the box will be evaluated: elsewhere the tree stays as coarse as possible.
  virtual bool isWanted(const SizeBox&) const { return true; }
  // The share of the box to be meshed, 0 to 1, of its area on the surface.
  virtual double share(const SizeBox& box) const { return isWanted(box) ? 1.0 : 0.0; }
};

// The number of vertices that lengths require: the integral of 2 / (sqrt(3) h²) over the meshed part of the surface.
struct SizeDemand {
  double vertices = 0.0;
  SizeBox most_in;    // the tree's cell that requires the most
  double size = 0.0;  // the length there
};

struct SizeTreeOptions {
  Surface surface{};       // represented by the plane: lengths, distances and areas are measured on it
  double gradation = 0.3;  // above 0: lengths at two places differ by at most this times their distance
  // Cells in which lengths change are split down to this many times their smallest length; and further, to `finest`, if
  // interpolation between corners has a larger relative error than `tolerance` (twice that in a cell half as large as
  // the length).
  double coarsest = 3.0;
  double finest = 0.25;
  double tolerance = 0.04;  // relative
  // The same two for cells in which sizes are graded.
  double finest_graded = 0.25, tolerance_graded = 0.04;
  std::uint32_t most_cells = 64'000'000;  // no more cells are made
  // If lengths certainly require more vertices, the tree is not completed.
  double most_vertices = std::numeric_limits<double>::infinity();
};

// A size function on a quadtree: cells about as large as the requested lengths, coarser where these hardly change, so
// that memory is proportional to the mesh. Lengths are linear on the triangles between a cell's centre and the edges of
// its boundary, and continuous between cells.
//
// Lengths at two places differ by at most the gradation times their distance. Proof: on each triangle the gradient is
// at most the gradation (`SizeGrading`; the builder ensures this for the stored, rounded values). The triangles fill
// the root square, a convex set, so the straight path between two places in it consists of pieces, each in one
// triangle, and on each the length changes by at most the gradation times the piece. A place outside the square gets
// the length of the nearest place in it, and nearest places of a convex set are no further apart than the places
// themselves.
//
// If the plane represents a sphere, the gradient on a triangle is at most the gradation times the smallest scale factor
// in it: along any path in the square the length changes by at most the gradation times the path's length on the
// sphere. The distance of two places is that of the shortest such path: an arc of a great circle, unless that leaves
// the square. Cells over which the scale varies are split until it varies little, so that its minimum and the values
// between a cell's vertices are close to the requested ones.
class SizeTree final : public SizeFunction {
 public:
  // Covers the box from `low` to `high`; outside it the nearest place counts. `loop` provides threads; the tree does
  // not depend on it. Throws only what `source` throws.
  SizeTree(const Point& low, const Point& high, const SizeSource& source, const SizeTreeOptions& options,
           const ItemLoop& loop = inOrder);

  // REQUIRES, like the bounds: `isComplete()`.
  double at(const Point& x) const override;
  double least() const override { return least_; }
  double most() const override { return most_; }
  std::size_t cells() const { return cells_.size(); }
  std::size_t leaves() const { return leaves_.size(); }
  // True if `most_cells` and `most_vertices` sufficed. If not, only the demand is available.
  bool isComplete() const { return complete_; }
  // If the tree is not complete, an estimate from the lengths known so far: only its order of magnitude is right.
  const SizeDemand& demand() const { return demand_; }
  std::size_t bytes() const;

  // A node of the quadtree, whose position follows from the path to it.
  struct Cell {
    std::uint32_t below = 0;  // the first of four consecutive children, or, if `is_leaf`, a leaf's number
    bool is_leaf = true;
  };
  // Passes all parts of a complete tree to `visit`, in one call, to be saved.
  template <typename Visit>
  void visitParts(const Visit& visit) const {
    visit(origin_, side_, cells_, leaves_, start_levels_, start_, start_level_, least_, most_);
  }
  // A tree from parts that `fill` writes, the same as `visitParts` passes.
  template <typename Fill>
  static SizeTree fromParts(const Fill& fill) {
    SizeTree tree;
    fill(tree.origin_, tree.side_, tree.cells_, tree.leaves_, tree.start_levels_, tree.start_, tree.start_level_,
         tree.least_, tree.most_);
    return tree;
  }

 private:
  SizeTree() = default;

  // In rows from below: corners, midpoints of sides, centre. A side's midpoint is NaN if lengths are linear along it.
  using Leaf = std::array<float, 9>;

  // `leaves` are numbers in `sizes`, kNone for NaN.
  void storeCells(std::span<const Cell> cells, std::span<const std::array<std::uint32_t, 9>> leaves,
                  std::span<const double> sizes, const ItemLoop& loop);
  void makeStartTable();

  Point origin_;
  double side_ = 1.0;  // of the root
  std::vector<Cell> cells_;
  std::vector<Leaf> leaves_;
  int start_levels_ = 0;                   // a table leads directly to this level
  std::vector<std::uint32_t> start_;       // the cell there, or the leaf above it
  std::vector<std::uint8_t> start_level_;  // its level
  double least_ = 0.0, most_ = 0.0;
  bool complete_ = true;
  SizeDemand demand_;
};

}  // namespace coastmesh
