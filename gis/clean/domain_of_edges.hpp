#pragma once

#include "gis/clean/clean_chains.hpp"
#include "gis/clean/clean_faces.hpp"
#include "gis/clean/clean_options.hpp"
#include "gis/clean/clean_report.hpp"
#include "gis/clean/domain.hpp"

namespace coastmesh {

// The edges and points as a domain, with only the used vertices, in their order.
Domain domainOf(const CleanVertices& vertices, LabelledEdges&& edges, const Projection& projection,
                const Resolution& resolution);

}  // namespace coastmesh
