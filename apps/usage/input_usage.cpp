#include "apps/usage/input_usage.hpp"

#include <limits>

namespace coastmesh {

void declareInputOptions(CommandLine& line, InputOptions& options) {
  constexpr NumberRange kNotNegative{0.0, std::numeric_limits<double>::infinity()};
  line.texts("--layer", options.filter.layers, "NAME", false, "read only this layer; repeat it for several");
  line.text("--where", options.filter.where, "SQL",
            "read only features for which this holds, such as \"kind = 'sea' AND area > 5\"");
  line.choice("--domain", options.domain, {"auto", "inside", "outside"},
              "what is meshed: the inside of polygons, or the water outside of land polygons, as far as --bbox or "
              "--clip; auto: "
              "inside polygons, and beside lines within a frame on the side of the water")
      .needs({"--bbox", "--clip"})
      .ignoredWith({"--water-at"});
  line.text("--bbox", options.bbox, "W,S,E,N",
            "mesh only within this box, in the input's CRS; its sides become open boundaries; across the antimeridian "
            "where E "
            "is less than W");
  line.text("--clip", options.clip, kVectorFile, "mesh only within these polygons; their sides become open boundaries");
  line.text("--water-at", options.water_at, "LON,LAT",
            "a place in the water, in the input's CRS: mesh this side of the coasts");
  line.texts("--constraints", options.constraints, kVectorFile, false,
             "lines and points in the water that become edges and vertices of the mesh");
  line.texts("--weirs", options.weirs, kVectorFile, false,
             "lines in the water that become edges of the mesh, marked as weirs where the output has room for lines");
  line.texts("--regions", options.regions, kVectorFile, false, "polygons that mark the triangles in them");
  line.flag("--dissolve", options.dissolve,
            "polygons that share an edge become one: lakes cut at a map sheet or a meridian leave no trace");
  line.number("--snap", options.snap_m, "M", kNotNegative,
              "points nearer than this become one; in a plane only where it is given", &options.snap_in_plane);
  line.number("--simplify", options.simplify_m, "M", kNotNegative,
              "how far the simplified shore may lie from the input");
  line.number("--min-island-area", options.min_island_area_m2, "M2", kNotNegative, "fill islands smaller than this");
  line.text("--crs", options.crs, "CRS",
            "plane to work in: auto fits a conformal projection, plane takes coordinates as they are, or anything that "
            "PROJ knows");
}

void declarePinches(CommandLine& line, InputOptions& options) {
  line.choice(
      "--pinches", options.pinches, {"keep", "open"},
      "places where shores touch in one point: keep them, or open them for water to pass: the narrower corner of "
      "land gives way by a twentieth of the shortest edge there");
}

}  // namespace coastmesh
