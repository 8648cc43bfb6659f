#pragma once

namespace coastmesh {

// What stands for depths where no raster has one: as nodes get them, see `DepthFill`.
enum class GapFill {
  Mean,     // a membrane between the depths around
  Nearest,  // the depth that is nearest through water
  None,     // nothing: only what is around counts, as far as it is graded
};

}  // namespace coastmesh
