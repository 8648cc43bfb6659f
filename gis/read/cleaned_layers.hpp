#pragma once

#include "gis/mesh_layers.hpp"

namespace coastmesh {

// Layers of the files that `coastmesh clean` writes and `readCleaned` reads. Feature ids refer to the layer `features`;
// 0: no feature.

// Edges: kind (open, shore, border, constraint, weir, region), region (the part of the graph, from 0), left_fid,
// right_fid (-1: outside), left_id, right_id, line_id (features), first and last (numbers of its ends within the part);
// boundary (the boundary's type), if types were given; boundary_name, if one of these has a name.
inline constexpr const char* kPslgLayer = "pslg";
inline constexpr const char* kBoundaryField = "boundary";
inline constexpr const char* kBoundaryNameField = "boundary_name";
inline constexpr const char* kEditLayer = "edits";            // points: kind, fid_of_feature, source
inline constexpr const char* kVertexLayer = "vertices";       // points without edges: region, number
inline constexpr const char* kFeatureLayer = "features";      // no geometry: id, fid_of_feature, source
inline constexpr const char* kAttributeLayer = "attributes";  // no geometry: feature_id, name, value, in order
inline constexpr const char* kRegionLayer = "regions";        // polygons: feature_id

static_assert(isOwnLayer(kPslgLayer) && isOwnLayer(kEditLayer) && isOwnLayer(kVertexLayer) &&
              isOwnLayer(kFeatureLayer) && isOwnLayer(kAttributeLayer) && isOwnLayer(kRegionLayer));

}  // namespace coastmesh
