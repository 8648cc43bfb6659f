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

// Limits at which the search for channels stops.
struct ChannelRoom {
  double vertices = std::numeric_limits<double>::infinity();
  double lines = std::numeric_limits<double>::infinity();
};

// The widths of a domain's water, as lines across it with a size that puts `elements` elements on each width. Widths
// are diameters of circles in the water that touch both shores; a line joins the two points of contact. Circles are
// taken along the shore, at a spacing proportional to their radius, and around the points of capes in steps of
// direction: two capes are as far apart as their points, which no circle at their sides shows. Shores are the segments
// with land on one side that are not open; in a graph without labels, all that are not open. After Ma, Bae & Choi,
// "3D medial axis point approximation using nearest neighbors and the normal field" (2012). Bends of one shore are no
// channel: the points of contact must be more than 110 degrees apart, seen from the centre. Sizes are at least
// `least_m`; water so wide that its size reaches `most_m` is left out. `scale` is plane length over metres. On a
// sphere, circles of the plane are circles too, measured with the scale at their centres. Stops at the limits of
// `room`.
ChannelLines channelLines(const Pslg& pslg, double elements, double rate, double least_m, double most_m,
                          const std::function<double(const Point&)>& scale, const ChannelRoom& room = {},
                          const Surface& surface = {});

}  // namespace coastmesh
