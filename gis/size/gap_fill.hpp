#pragma once

namespace coastmesh {

// Depths where no raster has one, as nodes get them: see `DepthFill`.
enum class GapFill {
  Mean,     // a membrane between the depths around the gap
  Nearest,  // the depth that is nearest through water
  None,     // none: sizes there follow from those around by gradation
};

}  // namespace coastmesh
