#pragma once

#include <cstdint>
#include <vector>

#include "gis/follow/line_pieces.hpp"

namespace coastmesh {

// Pieces of lines that follow one another.
struct LineStep {
  std::uint32_t from, to;  // nodes, in the order of the chain
  SegmentId of;            // of the line's segments
  bool is_back;            // that runs the other way

  LinePiece piece() const { return is_back ? LinePiece{to, from, of} : LinePiece{from, to, of}; }
};
using LineChain = std::vector<LineStep>;

// Takes nodes out of chains where pieces are shorter than half the size: those within a tenth of the size of the piece
// that replaces theirs, if nothing else lies between. `lines`: what `cutter` cuts. `stays`: by point of these.
void coarsenLines(std::vector<LineChain>& chains, const LineCutter& cutter, const Pslg& shores,
                  const std::vector<Segment>& lines, const std::vector<char>& stays, const SizeFunction& size);

}  // namespace coastmesh
