#pragma once

namespace coastmesh {

// Layers of a file that `coastmesh clean` writes, and that is read back as what it was.
inline constexpr const char* kPslgLayer = "pslg";        // edges: kind, region, left_fid, right_fid
inline constexpr const char* kEditLayer = "edits";       // points: kind, fid_of_feature
inline constexpr const char* kVertexLayer = "vertices";  // points

}  // namespace coastmesh
