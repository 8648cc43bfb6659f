#include "apps/usage/input_usage.hpp"

#include <array>
#include <functional>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

#include "core/computable.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

// "1,2.5" as so many numbers.
std::vector<double> parseNumbers(const std::string& option, const std::string& text, std::size_t count,
                                 const std::string& form) {
  std::vector<double> numbers;
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  for (double number; stream >> number;) {
    if (!isComputable(number)) break;
    numbers.push_back(number);
    char comma = 0;
    if (numbers.size() < count && !(stream >> comma && comma == ',')) break;
    if (numbers.size() == count) break;
  }
  std::string rest;
  if (numbers.size() == count && !(stream >> rest)) return numbers;
  throw OptionError(option + ": '" + text + "' is not " + form);
}

const std::vector<std::string> kPinchChoices{"keep", "open"};

// Stores the user's choice among kPinchChoices.
std::function<void(const std::string&)> storePinches(InputOptions& options) {
  return [&options](const std::string& chosen) { options.pinches = chosen == "open" ? Pinches::Open : Pinches::Keep; };
}

}  // namespace

void declareInputOptions(CommandLine& line, InputOptions& options) {
  constexpr NumberRange kNotNegative{0.0, std::numeric_limits<double>::infinity()};
  line.texts("--layer", options.filter.layers, "NAME", false, "read only this layer; repeat it for several");
  line.text("--where", options.filter.where, "SQL",
            "read only features for which this holds, such as \"kind = 'sea' AND area > 5\"");
  FrameOptions& frame = options.frame;
  line.choice(
          "--domain", "auto", {"auto", "inside", "outside"},
          [&frame](const std::string& chosen) {
            frame.side = chosen == "inside"    ? DomainSide::Inside
                         : chosen == "outside" ? DomainSide::Outside
                                               : DomainSide::Auto;
          },
          "what is meshed: the inside of polygons, or the water outside of land polygons, as far as --bbox or "
          "--clip; auto: "
          "inside polygons, and beside lines within a frame on the side of the water")
      .needs({"--bbox", "--clip"})
      .ignoredWith({"--water-at"});
  line.text(
      "--bbox", "W,S,E,N",
      [&frame](const std::string& text) {
        if (text.empty()) return frame.box.reset();
        const std::vector<double> n = parseNumbers("--bbox", text, 4, "four numbers W,S,E,N");
        frame.box = Box{n[0], n[1], n[2], n[3]};
      },
      "mesh only within this box, in the input's CRS; its sides become open boundaries; across the antimeridian "
      "where E "
      "is less than W");
  line.text("--clip", options.clip, kVectorFile, "mesh only within these polygons; their sides become open boundaries");
  line.text(
      "--water-at", "LON,LAT",
      [&frame](const std::string& text) {
        if (text.empty()) return frame.water_at.reset();
        const std::vector<double> n = parseNumbers("--water-at", text, 2, "two numbers LON,LAT");
        frame.water_at = Point{n[0], n[1]};
      },
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

void declarePinches(CommandLine& line, const std::string& name, const std::string& help, InputOptions& options) {
  line.choice(name, "keep", kPinchChoices, storePinches(options), help);
}

void declarePinches(CommandLine& line, InputOptions& options) {
  declarePinches(
      line, "--pinches",
      "places where shores touch in one point: keep them, or open them for water to pass: the narrower corner of "
      "land gives way by a twentieth of the shortest edge there",
      options);
}

}  // namespace coastmesh
