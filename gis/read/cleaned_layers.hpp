#pragma once

namespace coastmesh {

// Layers of a file that `coastmesh clean` writes, and that is read back as what it was. Numbers of features are those
// of the layer `features`; where there is none they are 0.

// Edges: kind (open, shore, border, constraint, weir, region), region (the part of the graph, from 0), left_fid,
// right_fid (-1: outside), left_id, right_id, line_id (features), first and last (numbers of its ends within the part);
// boundary (what the boundary is there), where that was given.
inline constexpr const char* kPslgLayer = "pslg";
inline constexpr const char* kBoundaryField = "boundary";
inline constexpr const char* kEditLayer = "edits";            // points: kind, fid_of_feature, source
inline constexpr const char* kVertexLayer = "vertices";       // points that no edge has: region, number
inline constexpr const char* kFeatureLayer = "features";      // no shapes: id, fid_of_feature, source
inline constexpr const char* kAttributeLayer = "attributes";  // no shapes: feature_id, name, value, in their order
inline constexpr const char* kRegionLayer = "regions";        // polygons: feature_id

}  // namespace coastmesh
