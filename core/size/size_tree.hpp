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
  // What `sample` says of the middle of the box, where finding the bounds found that; else NaN.
  double at_centre = std::numeric_limits<double>::quiet_NaN();
  // Whether all that decides in the box grows by a rate that is at most the gradation, from place to place.
  bool is_graded = false;
};

// Where wanted lengths come from: asked for many places at once, so that whoever computes them can share the work out.
// Lengths are those on the surface, above 0; infinite where nothing is wanted.
class SizeSource {
 public:
  virtual ~SizeSource() = default;

  virtual void sample(std::span<const Point> places, std::span<double> sizes) const = 0;
  // Bounds of the lengths within each box, from outside. `low` may be 0 and `high` infinite where nothing is known.
  virtual void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const = 0;
  // Whether anyone will ask for lengths within the box: elsewhere the tree stays as coarse as it can.
  virtual bool isWanted(const SizeBox&) const { return true; }
  // How much of the box is to be meshed, 0 to 1, of its area on the surface.
  virtual double share(const SizeBox& box) const { return isWanted(box) ? 1.0 : 0.0; }
};

// How many vertices lengths ask for: the integral of 2 / (sqrt(3) h²) over what is to be meshed of the surface.
struct SizeDemand {
  double vertices = 0.0;
  SizeBox most_in;    // of the tree's cells the one that asks for the most
  double size = 0.0;  // the length there
};

struct SizeTreeOptions {
  Surface surface;         // that the plane stands for: lengths, distances and areas are those on it
  double gradation = 0.3;  // above 0: no two places' lengths differ by more than this times their distance
  // Cells are split down to so many times the least length in them, where that changes within them; further, to
  // `finest`, where what lies between their corners is not known from these to `tolerance`: twice that in a cell half
  // as large as the length.
  double coarsest = 3.0;
  double finest = 0.25;
  double tolerance = 0.04;  // relative
  // The same two for cells in which sizes are graded as they come.
  double finest_graded = 0.25, tolerance_graded = 0.04;
  std::uint32_t most_cells = 64'000'000;  // past that no cell is split
  // Where the lengths certainly ask for more vertices, the tree is not finished.
  double most_vertices = std::numeric_limits<double>::infinity();
};

// A size function on a quadtree: cells about as large as the lengths wanted there, coarser where these hardly change,
// so that memory follows the mesh. Lengths are linear on the triangles between a cell's centre and the edges of its
// boundary, and continuous from one cell to the next.
//
// No two places' lengths differ by more than the gradation times their distance. Proof: on each triangle the gradient
// is at most the gradation (`SizeGrading`; the builder sees to it that this holds for the rounded values that are
// kept). The triangles fill the root square, a convex set, so that the straight way between two places in it is a row
// of pieces, each in one triangle, and on each the length changes by at most the gradation times the piece. A place
// beyond the square gets the length of the nearest place in it, and nearest places of a convex set are no further apart
// than the places themselves.
//
// Where the plane stands for a sphere, the gradient on a triangle is at most the gradation times the least shrink in
// it: along any way over the square the length changes by at most the gradation times what that way measures on the
// sphere. The distance of two places is that of the shortest such way: an arc of a great circle, unless that leaves the
// square. Cells over which the shrink changes are split until it does so by little, so that the least of it and what
// lies between a cell's vertices are near what is wanted.
class SizeTree final : public SizeFunction {
 public:
  // Covers the box from `low` to `high`; beyond it the nearest place counts. `loop` lends threads; the tree does not
  // depend on it. Throws nothing but what `source` does.
  SizeTree(const Point& low, const Point& high, const SizeSource& source, const SizeTreeOptions& options,
           const ItemLoop& loop = inOrder);

  // REQUIRES, as do the bounds: `isComplete()`.
  double at(const Point& x) const override;
  double least() const override { return least_; }
  double most() const override { return most_; }
  std::size_t cells() const { return cells_.size(); }
  std::size_t leaves() const { return leaves_.size(); }
  // Whether `most_cells` and `most_vertices` were enough. Where not, there is the demand and nothing else.
  bool isComplete() const { return complete_; }
  // Where the tree is not complete, by what was known of lengths up to then: only its order of magnitude is right.
  const SizeDemand& demand() const { return demand_; }
  std::size_t bytes() const;

  // Cells are named by the place of their lower left corner, in units of the finest level.
  struct Cell {
    std::uint32_t below = 0;  // the first of four children in a row, or, where `is_leaf`, a leaf's number
    bool is_leaf = true;
  };
  // Hands all that a complete tree is made of to `visit`, in one call: to be kept elsewhere.
  template <typename Visit>
  void visitParts(const Visit& visit) const {
    visit(origin_, side_, cells_, leaves_, start_levels_, start_, start_level_, least_, most_);
  }
  // A tree of the parts that `fill` writes to what it is given, the same as `visitParts` gives.
  template <typename Fill>
  static SizeTree fromParts(const Fill& fill) {
    SizeTree tree;
    fill(tree.origin_, tree.side_, tree.cells_, tree.leaves_, tree.start_levels_, tree.start_, tree.start_level_,
         tree.least_, tree.most_);
    return tree;
  }

 private:
  friend class SizeTreeBuilder;

  SizeTree() = default;

  // In rows from below: corners, middles of sides, centre. The middle of a side is NaN where lengths are linear along
  // it.
  using Leaf = std::array<float, 9>;

  Point origin_;
  double side_ = 1.0;  // of the root
  std::vector<Cell> cells_;
  std::vector<Leaf> leaves_;
  int start_levels_ = 0;                   // a table leads straight to this level
  std::vector<std::uint32_t> start_;       // the cell there, or the leaf above it
  std::vector<std::uint8_t> start_level_;  // its level
  double least_ = 0.0, most_ = 0.0;
  bool complete_ = true;
  SizeDemand demand_;
};

}  // namespace coastmesh
