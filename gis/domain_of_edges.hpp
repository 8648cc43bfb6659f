#pragma once

#include "gis/clean.hpp"
#include "gis/clean_chains.hpp"
#include "gis/clean_faces.hpp"

namespace coastmesh {

// The edges and points as a domain, with only the vertices that they use, in their order. Private to gis.
Domain domainOf(const CleanVertices& vertices, LabelledEdges&& edges, const Projection& projection,
                const Resolution& resolution);

}  // namespace coastmesh
