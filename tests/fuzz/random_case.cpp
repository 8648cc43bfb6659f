#include "tests/fuzz/random_case.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/metric.hpp"
#include "tests/fuzz/edge_pslgs.hpp"
#include "tests/fuzz/placement.hpp"
#include "tests/fuzz/ring_pslgs.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {

namespace {

// PSLGs that the tests of the core use too, with random parameters.
Pslg namedPslg(Choices& choices) {
  const unsigned seed = choices.below(1u << 16);
  switch (choices.below(11)) {
    case 0:
      return randomPointsInBox(seed, static_cast<int>(choices.below(40)));
    case 1:
      return nearDuplicates(seed, static_cast<int>(choices.below(8)));
    case 2:
      return starPolygon(seed, 3 + static_cast<int>(choices.below(40)));
    case 3:
      return fractalCoast(seed, static_cast<int>(choices.below(3)), static_cast<int>(choices.below(4)));
    case 4:
      return combPolygon(1 + static_cast<int>(choices.below(6)));
    case 5: {
      const int rays = 2 + static_cast<int>(choices.below(8));
      return fanOfAngles(rays, choices.between(0.1, 5.0));
    }
    case 6:
      return nestedRings();
    case 7:
      return touchingHoles();
    case 8:
      return collinearRuns();
    case 9:
      return narrowChannel(std::pow(10.0, -choices.between(0.3, 2.5)));
    default:
      return choices.oneIn(2) ? openLines() : twoRegions();
  }
}

Pslg randomPslg(Choices& choices) {
  const Placement placement = randomPlacement(choices);
  Pslg pslg;
  switch (choices.below(8)) {
    case 0:
    case 1:
    case 2:
      return edgePslg(choices, placement);
    case 3:
      pslg = nestedStars(choices);
      break;
    case 4:
      pslg = tinyAngles(choices);
      break;
    case 5:
      pslg = narrowStrip(choices);
      break;
    case 6:
      pslg = brokenSides(choices);
      break;
    default:
      pslg = namedPslg(choices);
  }
  for (Point& p : pslg.points) p = placement(p);
  for (Point& p : pslg.holes) p = placement(p);
  return pslg;
}

double extentOf(const Pslg& pslg) {
  if (pslg.points.empty()) return 1.0;
  Point low = pslg.points.front(), high = low;
  for (const Point& p : pslg.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return std::max(distance(low, high), std::numeric_limits<double>::min());
}

RefineOptions randomOptions(Choices& choices) {
  RefineOptions options;
  options.algorithm = choices.oneOf({Algorithm::Relocate, Algorithm::Optimal, Algorithm::Circumcenter,
                                     Algorithm::Offcenter, Algorithm::Relocate, Algorithm::Relocate});
  options.min_angle_deg = choices.oneIn(2)
                              ? choices.between(0.0, 45.0)
                              : choices.oneOf({30.0, 0.0, 20.0, 26.565, 33.0, 34.0, 36.0, 38.0, 40.0, 42.0, 45.0});
  if (choices.oneIn(4))
    options.max_angle_deg =
        choices.oneIn(2) ? choices.between(60.0, 180.0) : choices.oneOf({90.0, 100.0, 120.0, 150.0, 179.0, 60.0});
  return options;
}

}  // namespace

RefineCase randomCase(Choices& choices) {
  RefineCase c;
  // Options are drawn first, so that a fuzzer finds them at the same place in every input.
  c.coarsen = !choices.oneIn(4);
  c.options = randomOptions(choices);
  const double size_share = choices.between(0.05, 1.0);
  const std::uint32_t room = choices.below(200);
  const bool sized = choices.oneIn(5), budgeted = choices.oneIn(20);
  c.pslg = randomPslg(choices);
  if (sized) c.options.size_max = size_share * extentOf(c.pslg);
  if (budgeted) c.options.max_vertices = c.pslg.points.size() + room;
  return c;
}

}  // namespace coastmesh
