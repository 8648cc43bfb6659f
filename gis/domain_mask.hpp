#pragma once

#include <cstdint>
#include <vector>

#include "core/pslg.hpp"
#include "core/size_tree.hpp"

namespace coastmesh {

// Which squares of the plane have anything of a domain in them, to the cells of a grid that is about as fine as the domain's
// segments are many: what lies outside by less may be taken for inside, never the other way round.
class DomainMask {
 public:
  // Over a square that holds the domain. Where no segment is labelled all of it counts as inside.
  DomainMask(const Pslg& pslg, const SizeBox& square);

  bool meets(const SizeBox& box) const;

 private:
  std::vector<bool> rasterize(const Pslg& pslg, int level) const;

  Point origin_;
  double side_ = 1.0;
  std::vector<std::vector<bool>> levels_;  // of 2^level rows of 2^level cells; empty where all is inside
};

}  // namespace coastmesh
