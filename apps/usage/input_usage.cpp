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

// Stores the sides of a box; returns what is wrong with them, empty if nothing.
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

std::string storeBox(const std::vector<double>& sides, std::optional<Box>& box) {
  box.reset();
  if (!allFinite(sides)) return "is not four finite numbers W,S,E,N";
  if (sides.empty()) return {};
  if (!(sides[1] < sides[3]) || sides[0] == sides[2]) return "is not W,S,E,N with S below N and W other than E";
  box = Box{sides[0], sides[1], sides[2], sides[3]};
  return {};
}

void declareInputOptions(OptionTable& table, InputOptions& options) {
  constexpr NumberRange kNotNegative{0.0, std::numeric_limits<double>::infinity()};
  table.section(Section::Input);
  table.texts({"--layer", "Layers to read"}, options.filter.layers, "NAME", false,
              "read only this layer; can be repeated");
  table.text({"--where", "Features to read"}, options.filter.where, "SQL",
             "read only features that satisfy this expression, such as \"kind = 'sea' AND area > 5\"");
  FrameOptions& frame = options.frame;
  table.section(Section::Domain);
  table
      .choice(
          {"--domain", "Domain to mesh"}, "auto", {"auto", "inside", "outside", "ocean", "land", "globe"},
          [&frame](const std::string& chosen) {
            frame.side = chosen == "inside"    ? DomainSide::Inside
                         : chosen == "outside" ? DomainSide::Outside
                         : chosen == "ocean"   ? DomainSide::Ocean
                         : chosen == "land"    ? DomainSide::Land
                         : chosen == "globe"   ? DomainSide::Globe
                                               : DomainSide::Auto;
          },
          "inside: the inside of polygons; outside: the water around land polygons, up to --bbox or --clip; ocean: all "
          "water of the Earth, given its land polygons; land: those polygons; globe: the whole globe, closed, with "
          "polygons and the rest as regions (INPUT may be omitted); auto: the inside of polygons, or the water beside "
          "lines within --bbox or --clip")
      .needs(
          [&frame, &options] {
            const bool unframed =
                frame.side == DomainSide::Ocean || frame.side == DomainSide::Land || frame.side == DomainSide::Globe;
            const bool refused = frame.side == DomainSide::Outside;  // without a frame: see `requireOneFrame`
            return refused || unframed || frame.box || !options.clip.empty() || frame.water_at;
          },
          "without --bbox or --clip")
      // --water-at meshes the water outside land anyway.
      .needs([&frame] { return !frame.water_at || frame.side == DomainSide::Outside; }, "with --water-at");
  table.numbers(
      {"--bbox", "Bounding box"}, "W,S,E,N", false,
      [&frame](const std::vector<double>& sides) { return storeBox(sides, frame.box); },
      "mesh only within this box, in the input's CRS; its sides become open boundaries, except across land; in "
      "degrees, a box with E less than W crosses the antimeridian");
  table.text({"--clip", "Clip to polygons"}, options.clip, kVectorFile,
             "mesh only within these polygons, united; their sides become open boundaries, except across land");
  table.numbers(
      {"--water-at", "Point in the water"}, "LON,LAT", false,
      [&frame](const std::vector<double>& place) { return storePlace(place, frame.water_at); },
      "point in the water, in the input's CRS: mesh this side of the coasts");
  table.texts({"--constraints", "Lines and points to keep"}, options.constraints, kVectorFile, false,
              "lines and points in the water that become edges and vertices of the mesh");
  table.texts(
      {"--weirs", "Weirs"}, options.weirs, kVectorFile, false,
      "lines in the water that become edges of the mesh, marked as weirs if the output can hold lines; with "
      "--target adcirc alone, those with an attribute height, or a crest in --weir-heights, become its weirs between "
      "pairs of nodes");
  table.texts({"--regions", "Regions to mark"}, options.regions, kVectorFile, false,
              "polygons whose name is given to the triangles inside");
  table.flag({"--dissolve", "Join polygons that share an edge"}, options.dissolve,
             "join polygons that share an edge, so that cuts at map sheets or meridians leave no trace");
  table.section(Section::Coast);
  table.number({"--snap", "Snapping distance"}, options.snap_m, "M", kNotNegative,
               "points closer than this are merged, and ends of lines joined; in a plane only if given",
               &options.snap_in_plane);
  table.number({"--simplify", "Simplification tolerance"}, options.simplify_m, "M", kNotNegative,
               "maximum distance of the simplified shore from the input");
  table.section(Section::Input);
  table.choice(
      {"--edges", "Edges of the input"}, kEdgeLineNames.front(), {kEdgeLineNames.begin(), kEdgeLineNames.end()},
      [&options](const std::string& chosen) {
        options.edges = static_cast<EdgeLine>(std::ranges::find(kEdgeLineNames, chosen) - kEdgeLineNames.begin());
      },
      "what an edge between two points of the input is: plane: a straight line in the working plane; lonlat: in the "
      "input's longitudes and latitudes (or x and y); geodesic; points are added to long edges");
  table
      .number({"--edge-tolerance", "Tolerance of edges"}, options.edge_tolerance_m, "M",
              {0.001, std::numeric_limits<double>::infinity()}, "maximum distance of edges from these lines")
      .needs({"--edges"});
  table.section(Section::Coast);
  table.number({"--min-island-area", "Smallest island"}, options.min_island_area_m2, "M2", kNotNegative,
               "fill islands smaller than this; those that a frame cuts stay");
  table.section(Section::Input);
  table.text({"--crs", "Working plane"}, options.crs, "CRS",
             "auto fits a conformal projection, plane uses coordinates as they are; or any CRS that PROJ knows: if it "
             "distorts shapes, angles on the ground differ, and a warning says by how much");
}

void declareSurface(OptionTable& table, SurfaceChoice& surface) {
  table.section(Section::Input);
  table.choice(
      {"--surface", "Surface for measurements"}, kSurfaceNames.front(), {kSurfaceNames.begin(), kSurfaceNames.end()},
      [&surface](const std::string& chosen) {
        surface.kind = static_cast<SurfaceKind>(std::ranges::find(kSurfaceNames, chosen) - kSurfaceNames.begin());
      },
      "where lengths and angles are measured: in the plane, or on flat triangles between points on the ellipsoid, or "
      "on a sphere with unchanged latitudes, as some models use it; auto: the ellipsoid if the domain is larger than a "
      "cap of 30 degrees, the sphere with --target fesom or mpas, otherwise the plane");
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
  declarePinches(table, {"--pinches", "Where shores touch"},
                 "places where shores touch in one point: keep them, or open them so that water can pass: the narrower "
                 "corner of land recedes by a twentieth of the shortest edge there",
                 options);
}

}  // namespace coastmesh
