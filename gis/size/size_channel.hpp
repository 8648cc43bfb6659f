#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "core/pslg.hpp"
#include "core/surface.hpp"
#include "gis/size/size_distance.hpp"

namespace coastmesh {

struct ChannelLines {
  std::vector<SizedLine> lines;
  double vertices = 0.0;  // about how many they require; if not `complete`, extrapolated from the shores so far
  bool complete = true;
};

// The limits for channels.
struct ChannelRoom {
  double vertices = std::numeric_limits<double>::infinity();
  double lines = std::numeric_limits<double>::infinity();
};

// The widths of a domain's water, as lines across it that want `elements` on their length: the diameters of circles
// that lie in the water and touch both shores, taken at places along the shore that lie as near to one another as the
// water there is wide, and round the points of capes in steps of their direction: two capes are as far apart as their
// points, which no circle at their sides shows. After Ma, Bae & Choi, "3D medial axis point approximation using nearest
// neighbors and the normal field" (2012). Bends of one shore do not make a channel: the two touching places lie more
// than 110 degrees apart, seen from the centre. Sizes are at least `least_m`, and what is wider than asks for `most_m`
// is left out; `scale` is plane length over metres. On a sphere, too, the circles of the plane are circles: as wide as
// the scale at their centres says. Stops where they pass what is allowed.
ChannelLines channelLines(const Pslg& pslg, double elements, double rate, double least_m, double most_m,
                          const std::function<double(const Point&)>& scale, const ChannelRoom& room = {},
                          const Surface& surface = {});

}  // namespace coastmesh
