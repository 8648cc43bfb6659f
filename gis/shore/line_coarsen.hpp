#pragma once

#include <cstdint>
#include <vector>

#include "gis/shore/line_pieces.hpp"

namespace coastmesh {

// A piece of a line as part of a chain.
struct LineStep {
  std::uint32_t from, to;  // nodes, in the order of the chain
  SegmentId of;            // segment of the line
  bool is_back;            // runs against it

  LinePiece piece() const { return is_back ? LinePiece{to, from, of} : LinePiece{from, to, of}; }
};
using LineChain = std::vector<LineStep>;

// Removes nodes of chains where pieces are shorter than half the size, if they are within a tenth of the size of the
// piece that replaces theirs, and nothing else lies between. `lines`: those that `cutter` cuts; the same water is on
// both of their sides, so that directions say nothing: where a line crosses others, its pieces run either way.
// `stays`: which of their points must stay.
void coarsenLines(std::vector<LineChain>& chains, const LineCutter& cutter, const Pslg& shores,
                  const std::vector<Segment>& lines, const std::vector<char>& stays, const SizeFunction& size);

}  // namespace coastmesh
