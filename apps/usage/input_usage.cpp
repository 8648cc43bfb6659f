#include "apps/usage/input_usage.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "gis/model/target.hpp"

namespace coastmesh {

namespace {

bool allFinite(const std::vector<double>& numbers) {
  return std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
}

// Stores the sides of a box, or what is wrong with them.
std::string storeBox(const std::vector<double>& sides, std::optional<Box>& box) {
  box.reset();
  if (!allFinite(sides)) return "is not four finite numbers W,S,E,N";
  if (sides.empty()) return {};
  // W may be more than E: in degrees such a box lies across the antimeridian.
  if (!(sides[1] < sides[3]) || sides[0] == sides[2]) return "is not W,S,E,N with S below N and W other than E";
  box = Box{sides[0], sides[1], sides[2], sides[3]};
  return {};
}

std::string storePlace(const std::vector<double>& numbers, std::optional<Point>& place) {
  place.reset();
  if (!allFinite(numbers)) return "is not two finite numbers LON,LAT";
  if (!numbers.empty()) place = Point{numbers[0], numbers[1]};
  return {};
}

const std::vector<std::string> kPinchChoices{"keep", "open"};

// Stores the user's choice among kPinchChoices.
std::function<void(const std::string&)> storePinches(InputOptions& options) {
  return [&options](const std::string& chosen) { options.pinches = chosen == "open" ? Pinches::Open : Pinches::Keep; };
}

}  // namespace

void declareInputOptions(OptionTable& table, InputOptions& options) {
  constexpr NumberRange kNotNegative{0.0, std::numeric_limits<double>::infinity()};
  table.section(Section::Input);
  table.texts({"--layer", "Layers to read"}, options.filter.layers, "NAME", false,
              "read only this layer; repeat it for several");
  table.text({"--where", "Features to read"}, options.filter.where, "SQL",
             "read only features for which this holds, such as \"kind = 'sea' AND area > 5\"");
  FrameOptions& frame = options.frame;
  table.section(Section::Domain);
  table
      .choice(
          {"--domain", "What is meshed"}, "auto", {"auto", "inside", "outside", "ocean", "land", "globe"},
          [&frame](const std::string& chosen) {
            frame.side = chosen == "inside"    ? DomainSide::Inside
                         : chosen == "outside" ? DomainSide::Outside
                         : chosen == "ocean"   ? DomainSide::Ocean
                         : chosen == "land"    ? DomainSide::Land
                         : chosen == "globe"   ? DomainSide::Globe
                                               : DomainSide::Auto;
          },
          "what is meshed: the inside of polygons, or the water outside of land polygons, as far as --bbox or "
          "--clip; of polygons of the Earth's land its ocean, all of it, or the land; or the whole globe, closed, with "
          "polygons and the rest as regions, and without INPUT too; auto: "
          "inside polygons, and beside lines within a frame on the side of the water")
      .needs(
          [&frame, &options] {
            const bool unframed =
                frame.side == DomainSide::Ocean || frame.side == DomainSide::Land || frame.side == DomainSide::Globe;
            return unframed || frame.box || !options.clip.empty();
          },
          "without --bbox or --clip")
      .ignoredWith({"--water-at"});
  table.numbers(
      {"--bbox", "Bounding box"}, "W,S,E,N", false,
      [&frame](const std::vector<double>& sides) { return storeBox(sides, frame.box); },
      "mesh only within this box, in the input's CRS; its sides become open boundaries; across the antimeridian "
      "where E "
      "is less than W");
  table.text({"--clip", "Clip to polygons"}, options.clip, kVectorFile,
             "mesh only within these polygons; their sides become open boundaries");
  table.numbers(
      {"--water-at", "Place in the water"}, "LON,LAT", false,
      [&frame](const std::vector<double>& place) { return storePlace(place, frame.water_at); },
      "a place in the water, in the input's CRS: mesh this side of the coasts");
  table.texts({"--constraints", "Lines and points to keep"}, options.constraints, kVectorFile, false,
              "lines and points in the water that become edges and vertices of the mesh");
  table.texts({"--weirs", "Weirs"}, options.weirs, kVectorFile, false,
              "lines in the water that become edges of the mesh, marked as weirs where the output has room for lines");
  table.texts({"--regions", "Regions to mark"}, options.regions, kVectorFile, false,
              "polygons that mark the triangles in them");
  table.flag({"--dissolve", "Join polygons that share an edge"}, options.dissolve,
             "polygons that share an edge become one: lakes cut at a map sheet or a meridian leave no trace");
  table.section(Section::Coast);
  table.number({"--snap", "Snapping distance"}, options.snap_m, "M", kNotNegative,
               "points nearer than this become one; in a plane only where it is given", &options.snap_in_plane);
  table.number({"--simplify", "Tolerance of simplification"}, options.simplify_m, "M", kNotNegative,
               "how far the simplified shore may lie from the input");
  table.section(Section::Input);
  table.choice(
      {"--edges", "Edges of the input"}, kEdgeLineNames.front(), {kEdgeLineNames.begin(), kEdgeLineNames.end()},
      [&options](const std::string& chosen) {
        options.edges = static_cast<EdgeLine>(std::ranges::find(kEdgeLineNames, chosen) - kEdgeLineNames.begin());
      },
      "what an edge between two points of the input is: a straight line in the working plane, in the input's "
      "longitudes and latitudes (or x and y), or a geodesic; long edges get points on it");
  table
      .number({"--edge-tolerance", "Tolerance of the edges"}, options.edge_tolerance_m, "M",
              {0.001, std::numeric_limits<double>::infinity()}, "how far edges may lie from these lines")
      .needs({"--edges"});
  table.section(Section::Coast);
  table.number({"--min-island-area", "Smallest island"}, options.min_island_area_m2, "M2", kNotNegative,
               "fill islands smaller than this");
  table.section(Section::Input);
  table.text(
      {"--crs", "Working plane"}, options.crs, "CRS",
      "plane to work in: auto fits a conformal projection, plane takes coordinates as they are, or anything that "
      "PROJ knows");
}

void declareSurface(OptionTable& table, SurfaceChoice& surface) {
  table.section(Section::Input);
  table.choice(
      {"--surface", "Surface measured on"}, kSurfaceNames.front(), {kSurfaceNames.begin(), kSurfaceNames.end()},
      [&surface](const std::string& chosen) {
        surface.kind = static_cast<SurfaceKind>(std::ranges::find(kSurfaceNames, chosen) - kSurfaceNames.begin());
      },
      "what lengths and angles are measured on: the plane, flat triangles between places on the ellipsoid, or on the "
      "sphere of models that take latitudes as they are; auto: the ellipsoid for what is larger than a cap of 30 "
      "degrees, the sphere with --target fesom or mpas, else the plane");
}

void chooseSurface(const std::vector<std::string>& targets, SurfaceChoice& surface) {
  if (surface.kind != SurfaceKind::Auto || !std::ranges::any_of(targetsNamed(targets), isOnSphere)) return;
  surface = {SurfaceKind::Sphere, true};
}

void declarePinches(OptionTable& table, const OptionNames& names, const std::string& help, InputOptions& options) {
  table.section(Section::Coast);
  table.choice(names, "keep", kPinchChoices, storePinches(options), help);
}

void declarePinches(OptionTable& table, InputOptions& options) {
  declarePinches(
      table, {"--pinches", "Where shores touch"},
      "places where shores touch in one point: keep them, or open them for water to pass: the narrower corner of "
      "land gives way by a twentieth of the shortest edge there",
      options);
}

}  // namespace coastmesh
