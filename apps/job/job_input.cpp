#include "apps/job/job_input.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <numeric>

#include "apps/job/places.hpp"
#include "apps/job/working_plane.hpp"
#include "core/metric.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/clean/geodesic_area.hpp"
#include "gis/clean/whole_turns.hpp"
#include "gis/coast/feature_bounds.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/coast/flood_plains.hpp"
#include "gis/coast/group_features.hpp"
#include "gis/coast/guests.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/crs/handedness.hpp"
#include "gis/error.hpp"
#include "gis/flood_plain/flood_plain.hpp"
#include "gis/for_count.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/format/poly_io.hpp"
#include "gis/read/open_source.hpp"
#include "gis/read/raw_layer.hpp"

namespace coastmesh {

namespace {

bool isPolyFile(const std::string& path) { return std::filesystem::path(path).extension() == ".poly"; }

std::string nameOfUnframed(DomainSide side) {
  return side == DomainSide::Ocean ? "ocean" : side == DomainSide::Land ? "land" : "globe";
}

void requireOneFrame(const InputOptions& options) {
  const DomainSide side = options.frame.side;
  if ((side == DomainSide::Ocean || side == DomainSide::Land || side == DomainSide::Globe) &&
      (options.frame.box || !options.clip.empty() || options.frame.water_at))
    throw OptionError("--domain " + nameOfUnframed(side) + " has no frame: leave out --bbox, --clip and --water-at");
  if (side == DomainSide::Globe) {
    if (options.surface.kind == SurfaceKind::Plane)
      throw OptionError("--domain globe uses no plane: leave out --surface plane");
    if (options.crs != "auto") throw OptionError("--domain globe uses no plane: leave out --crs");
  }
  if (options.frame.box && !options.clip.empty())
    throw OptionError("--bbox and --clip both bound the domain: give one of them");
  if (options.flood.height_m && (side == DomainSide::Ocean || side == DomainSide::Land || side == DomainSide::Globe))
    throw OptionError("--flood-height is not for --domain " + nameOfUnframed(side) +
                      ": it needs a part of the water, such as --domain outside with --bbox");
  if (options.frame.side == DomainSide::Outside && !options.frame.box && options.clip.empty() &&
      !options.frame.water_at)
    throw OptionError(
        "--domain outside: the water needs a limit: give --bbox W,S,E,N or --clip FILE, or --domain ocean for all "
        "water on Earth");
}

std::vector<Source> sourcesOf(const InputOptions& options) {
  std::vector<Source> sources;
  const auto add = [&sources](const std::vector<std::string>& files, FeatureUse use) {
    for (const std::string& file : files) sources.push_back({file, use});
  };
  add(options.files, FeatureUse::Area);
  if (!options.clip.empty()) add({options.clip}, FeatureUse::Frame);
  add(options.constraints, FeatureUse::Constraint);
  add(options.weirs, FeatureUse::Weir);
  add(options.regions, FeatureUse::Region);
  return sources;
}

// GeoJSON always declares longitudes and latitudes. If coordinates to be taken as a plane are out of their range, drops
// the CRS, with a warning: neither the input nor the mesh has a place on Earth.
void forgetImpossibleCrs(Coastline& coastline, ReadReport& report) {
  if (!coastline.crs.geographic) return;
  const Feature* odd = nullptr;
  const auto look = [&](const Feature& feature, const std::vector<Point>& chain) {
    const auto isOdd = [](const Point& p) { return !isOnEarth(asLonLat(p)); };
    if (odd == nullptr && std::ranges::any_of(chain, isOdd)) odd = &feature;
  };
  for (const Feature& feature : coastline.features) {
    for (const Polygon& polygon : feature.polygons) {
      look(feature, polygon.outer);
      for (const Ring& hole : polygon.holes) look(feature, hole);
    }
    for (const auto& line : feature.lines) look(feature, line);
  }
  if (odd == nullptr) return;
  report.warnings.push_back(featureInWords(*odd) + ": has coordinates that are not longitudes and latitudes of " +
                            nameOf(coastline.crs) + ": all are taken as metres in a plane");
  coastline.crs = {};
}

bool isMesh(const std::string& path) {
  try {
    return !readGrid(path).triangles.empty();
  } catch (const InputError&) {
    return false;
  }
}

SnapDistance snapDistanceOf(const InputOptions& options, const Crs& crs) {
  const bool in_plane = options.crs == "plane" || crs.isPlane();
  return {in_plane && !options.snap_in_plane ? 0.0 : options.snap_m, in_plane};
}

}  // namespace

bool isPlaneGraph(const InputOptions& options) {
  return options.pslg || (!options.files.empty() && isPolyFile(options.files.front()));
}

Coastline readInput(const InputOptions& options, ReadReport& report, BoundaryRules& boundaries, bool by_frame) {
  Coastline coastline;
  ReadFilter filter = options.filter;
  // A box is in the CRS of the first file. With `plane`, whether that is right shows in all coordinates.
  if (by_frame && options.files.size() == 1 && options.boundary_column.empty() && options.crs != "plane")
    filter.near = options.frame.box;
  filter.unsaid_in_plane = options.crs == "plane";
  try {
    coastline = readCoastline(
        sourcesOf(options), filter, report,
        [&](const std::vector<RawLayer>& layers) { boundaries.addInput(layers, options.boundary_column); },
        [&](const Crs& crs) { return snapDistanceOf(options, crs); });
  } catch (const NotVectorError& error) {
    if (!isMesh(error.file)) throw;
    throw InputError(sourceInWords(error.file) +
                     ": a mesh, not a coastline; convert, check, info and plot read meshes");
  }
  if (!options.boundary_column.empty() && !options.may_lack_column)
    boundaries.requireInputColumn(options.boundary_column);
  if (options.crs == "plane") forgetImpossibleCrs(coastline, report);
  return coastline;
}

std::size_t pointsOf(const Feature& feature) {
  std::size_t count = 0;
  for (const Polygon& polygon : feature.polygons) {
    count += polygon.outer.size();
    for (const Ring& hole : polygon.holes) count += hole.size();
  }
  for (const auto& line : feature.lines) count += line.size();
  return count;
}

void requireUnmirrored(const Coastline& coastline, const InputOptions& options) {
  if (coastline.crs.isPlane() || options.crs == "plane" || coastline.features.empty()) return;
  const Feature& first = coastline.features.front();
  const std::vector<Point>& points = !first.polygons.empty() ? first.polygons.front().outer
                                     : !first.lines.empty()  ? first.lines.front()
                                                             : first.points;
  if (points.empty()) return;
  const bool mirrored = mirrorsGround(coastline.crs, points.front());
  bool working_mirrored = false;
  if (options.crs != "auto") {
    const Crs working = parseWorkingCrs(options.crs);
    working_mirrored = mirrorsGround(working, Projection::to(coastline.crs, working).forward(points.front()));
  }
  if (mirrored == working_mirrored) return;
  if (working_mirrored)
    throw OptionError("--crs: " + options.crs + " mirrors the ground, and the mesh would be clockwise in the input's " +
                      nameOf(coastline.crs) + ": give " + unmirrored(parseWorkingCrs(options.crs)));
  throw InputError("the input's CRS " + nameOf(coastline.crs) +
                   " mirrors the ground: a mesh that is counter-clockwise on the ground would be clockwise in its "
                   "coordinates, which programs reject; bring the data to " +
                   unmirrored(coastline.crs) + " (ogr2ogr -t_srs)");
}

JobInput::JobInput(const InputOptions& options, const ItemLoop& loop) : options_(options) {
  if (options_.pslg) {
    const std::string name = "the plane graph given";
    requireReadyGraph(name);
    if (!sourcesOf(options_).empty())
      throw OptionError(name + " defines the domain itself; leave out files, --constraints, --weirs and --regions");
    takePlaneGraph(*options_.pslg, name);
    return;
  }
  for (const std::string& file : options_.files) {
    if (isPolyFile(file) && options_.files.size() > 1) {
      throw OptionError("'" + file + "' is a ready plane graph and cannot be joined with other inputs; mesh it alone");
    }
  }
  if (!options_.files.empty() && isPolyFile(options_.files.front())) {
    readPolyFile(options_.files.front());
    return;
  }
  std::optional<Crs> working;
  if (options_.crs != "auto" && options_.crs != "plane") working = parseWorkingCrs(options_.crs);
  requireOneFrame(options_);
  const bool globe = options_.frame.side == DomainSide::Globe;
  if (options_.ready) {
    coastline_ = *options_.ready;
    report_.features = coastline_.features.size();
    for (const Feature& feature : coastline_.features) report_.points += coastmesh::pointsOf(feature);
  } else if (globe && sourcesOf(options_).empty()) {
    coastline_.crs = wgs84();
  } else {
    coastline_ = readInput(options_, report_, boundaries_, true);
  }
  if ((globe || options_.frame.side == DomainSide::Ocean) && !coastline_.crs.geographic)
    throw InputError("--domain " + nameOfUnframed(options_.frame.side) +
                     " takes longitudes and latitudes, and the input is in " +
                     (coastline_.crs.isPlane() ? std::string("a plane without a CRS") : nameOf(coastline_.crs)));
  requireSurface();
  FrameOptions frame = options_.frame;
  frame.in_plane = options_.crs == "plane";
  if (working) chosen_ = Projection::to(coastline_.crs, *working);
  const auto hasLength = [&](const Point& a, const Point& b) {
    constexpr double kRounding = 1e-9;
    if (!chosen_) return false;
    const Point p = chosen_->forward(a), q = chosen_->forward(b);
    return distance(p, q) > kRounding * (std::abs(p.x) + std::abs(p.y));
  };
  FrameReport framed;
  try {
    framed = frameWithWholeTurns(coastline_, frame, options_.edges, hasLength);
  } catch (const InputError&) {
    if (report_.not_read == 0) throw;
    // The refusal says where the input lies: all of it.
    report_ = {}, boundaries_ = {};
    coastline_ = readInput(options_, report_, boundaries_);
    framed = frameWithWholeTurns(coastline_, frame, options_.edges, hasLength);
  }
  report_.beyond_frame = framed.beyond_frame + report_.not_read;
  for (std::size_t f = 0; f < coastline_.features.size(); ++f)
    if (coastline_.features[f].use == FeatureUse::Frame) frames_.push_back(f);
  std::ranges::move(framed.notes, std::back_inserter(report_.notes));
  std::ranges::move(framed.warnings, std::back_inserter(report_.warnings));
  if (options_.crs == "plane" && coastline_.crs.geographic)
    report_.warnings.push_back("--crs plane takes coordinates as they are, in the degrees of " +
                               nameOf(coastline_.crs) +
                               ": lengths, as of --size, have that unit, and angles on the ground differ; --crs auto "
                               "works in metres");
  if (options_.crs == "plane" && !coastline_.crs.isPlane() && !coastline_.crs.geographic &&
      metresPerUnit(coastline_.crs) != 1.0)
    report_.warnings.push_back("--crs plane takes coordinates as they are, in the unit of " + nameOf(coastline_.crs) +
                               ", " + unitOf(coastline_.crs) +
                               ": lengths, as of --size, have that unit; --crs auto works in metres");
  if (working) {
    const std::string distorts = judgeWorkingPlane(coastline_, *working, *chosen_);
    if (!distorts.empty()) report_.warnings.push_back(distorts);
    const std::string cut =
        options_.frame.box ? judgeBoxInPlane(*options_.frame.box, coastline_.crs, *working, *chosen_) : "";
    if (!cut.empty()) report_.warnings.push_back(cut);
  }
  groups_ = groupFeatures(coastline_, reach(), loop);
  bendEdges();
  addFloodPlain(loop);
}

void JobInput::regroup(double shores_move_m, const ItemLoop& loop) {
  options_.shores_move_m = shores_move_m;
  if (!poly_) groups_ = groupFeatures(coastline_, reach(), loop);
}

void JobInput::bendEdges() {
  if (options_.edges == EdgeLine::Plane) return;
  if (options_.crs == "plane" || coastline_.crs.isPlane())
    throw OptionError(std::string("--edges ") + kEdgeLineNames[static_cast<std::size_t>(options_.edges)] +
                      ": in a plane without a place on Earth edges are straight; leave it out");
  std::size_t count = 0;
  for (std::size_t g = 0; g < groups_.size(); ++g)
    count += coastmesh::bendEdges(coastline_, groups_[g], projectionOf(g), options_.edges, options_.edge_tolerance_m);
  report_.notes.push_back(std::to_string(count) + forCount(count, " point was", " points were") +
                          " added to edges that would otherwise leave their " +
                          (options_.edges == EdgeLine::LonLat ? "straight lines" : "geodesics") +
                          " by more than --edge-tolerance");
}

// Throws OptionError for options that do not apply to a ready plane graph, which is used as it is.
void JobInput::requireReadyGraph(const std::string& name) {
  if (options_.frame.side != DomainSide::Auto || options_.frame.box || options_.frame.water_at ||
      !options_.clip.empty())
    throw OptionError(name + " defines the domain itself; leave out --domain, --bbox, --clip and --water-at");
  if (!options_.filter.layers.empty() || !options_.filter.where.empty())
    throw OptionError(name + " has neither layers nor attributes; leave out --layer and --where");
  if (!options_.boundary_column.empty()) throw OptionError(name + " has no columns; leave out --boundary-column");
  if (options_.pinches == Pinches::Open || options_.dissolve || options_.simplify_m > 0.0 ||
      options_.min_island_area_m2 > 0.0 || options_.snap_in_plane) {
    throw OptionError(name +
                      " is a ready plane graph and is not cleaned; leave out --pinches open, --dissolve, --simplify, "
                      "--min-island-area and --snap");
  }
  if (options_.crs != "auto" && options_.crs != "plane")
    throw OptionError(name + " has plane coordinates already; leave out --crs, or give --crs plane");
  if (options_.flood.height_m) throw OptionError(name + " has no land that is known; leave out --flood-height");
  if (options_.edges != EdgeLine::Plane) throw OptionError(name + " has straight edges in a plane; leave out --edges");
  requireSurface();
}

void JobInput::readPolyFile(const std::string& path) {
  requireReadyGraph("'" + path + "'");
  if (sourcesOf(options_).size() > 1)
    throw OptionError("'" + path + "' defines the domain itself; leave out --constraints, --weirs and --regions");
  PolyExtras ignored;
  takePlaneGraph(readPoly(path, &ignored), path);
  if (const std::string text = textOf(ignored); !text.empty())
    report_.warnings.push_back("'" + path + "': ignored: " + text);
}

// An ellipsoid or sphere needs a place on Earth and a fitted plane. Without these, uses the plane if `where_known`, and
// throws OptionError otherwise.
void JobInput::requireSurface() {
  SurfaceChoice& surface = options_.surface;
  if (!surface.needsEarth()) return;
  std::string plane;
  if (isPlaneGraph(options_)) {
    plane = "a ready plane graph has no place on Earth";
  } else if (options_.crs == "plane") {
    plane = "--crs plane takes coordinates as they are";
  } else if (options_.crs != "auto") {
    plane = "--crs names the plane to work in, whose own lengths and angles count";
  } else if (coastline_.crs.isPlane()) {
    plane = "the input has no CRS, and no place on Earth";
  }
  const std::string name = kSurfaceNames[static_cast<std::size_t>(surface.kind)];
  if (plane.empty()) {
    if (surface.where_known)
      report_.notes.push_back(
          "angles and lengths are measured on a sphere, as the target does; --surface ellipsoid or plane changes that");
  } else if (surface.where_known) {
    surface.kind = SurfaceKind::Plane;
  } else {
    throw OptionError("--surface " + name + ": " + plane + "; leave out one of them");
  }
}

void JobInput::takePlaneGraph(Pslg pslg, const std::string& source) {
  poly_ = std::move(pslg);
  Feature feature;
  feature.fid = -1;
  feature.source = source;
  coastline_.features.push_back(feature);
  groups_ = {{0}};
  report_.features = 1;
  report_.points = poly_->points.size();
}

std::size_t JobInput::pointsOf(std::size_t group) const {
  if (poly_) return poly_->points.size();
  std::size_t count = 0;
  for (std::size_t member : groups_[group]) count += coastmesh::pointsOf(coastline_.features[member]);
  return count;
}

std::size_t JobInput::pointsInFrame() const {
  const Box frame = boundsOfFrames(coastline_);
  std::size_t points = 0;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    Box shores;
    for (const std::size_t member : groups_[g])
      if (!isGuest(coastline_.features[member].use)) shores.add(boundsOf(coastline_.features[member]));
    if (frame.empty() || shores.empty() || meetAtAnyTurn(frame, shores, coastline_.crs)) points += pointsOf(g);
  }
  return points;
}

std::uint64_t JobInput::digest() const {
  std::uint64_t digest = 0;
  const auto mix = [&digest](std::uint64_t value) { digest = std::rotl((digest ^ value) * 0x9E3779B97F4A7C15ull, 31); };
  const auto mixChain = [&mix](const std::vector<Point>& chain) {
    mix(chain.size());
    for (const Point& p : chain) {
      mix(std::bit_cast<std::uint64_t>(p.x));
      mix(std::bit_cast<std::uint64_t>(p.y));
    }
  };
  const auto mixText = [&mix](const std::string& text) {
    mix(text.size());
    for (const char c : text) mix(static_cast<unsigned char>(c));
  };
  mixText(coastline_.crs.wkt);
  for (const auto& group : groups_) {
    mix(group.size());
    for (const std::size_t member : group) {
      const Feature& feature = coastline_.features[member];
      mix(member);
      mix(static_cast<std::uint64_t>(feature.fid));
      mix(static_cast<std::uint64_t>(feature.use));
      for (const Polygon& polygon : feature.polygons) {
        mixChain(polygon.outer);
        for (const Ring& hole : polygon.holes) mixChain(hole);
      }
      for (const auto& line : feature.lines) mixChain(line);
      mixChain(feature.points);
      for (const auto& [name, value] : feature.attributes) mixText(name), mixText(value);
    }
  }
  if (!poly_) return digest;
  mixChain(poly_->points);
  mix(poly_->segments.size());
  for (const Segment& s : poly_->segments) {
    for (const std::uint64_t part : {std::uint64_t{s.a}, std::uint64_t{s.b}, static_cast<std::uint64_t>(s.left),
                                     static_cast<std::uint64_t>(s.right), static_cast<std::uint64_t>(s.tag)})
      mix(part);
  }
  mixChain(poly_->holes);
  return digest;
}

Projection JobInput::projectionOf(std::size_t group) const {
  if (chosen_) return *chosen_;
  if (poly_ || options_.crs == "plane" || coastline_.crs.isPlane()) return Projection::plane();
  return Projection::fitted(coastline_, groups_[group], options_.surface.kind);
}

SurfaceKind JobInput::surfaceOf(const Projection& projection) const {
  if (!projection.surface().isCurved()) return SurfaceKind::Plane;
  return options_.surface.kind == SurfaceKind::Sphere ? SurfaceKind::Sphere : SurfaceKind::Ellipsoid;
}

SnapDistance JobInput::snapDistance() const { return snapDistanceOf(options_, coastline_.crs); }

// The distance within which shores of different features may meet once they are cleaned and generalised.
SnapDistance JobInput::reach() const {
  SnapDistance reach = snapDistance();
  reach.length = std::max(reach.length, 2.0 * (options_.simplify_m + options_.shores_move_m));
  return reach;
}

Domain JobInput::domain(std::size_t group, CleanReport& report, const ItemLoop& loop) const {
  if (poly_) return {.pslg = *poly_, .input_points = poly_->points, .resolution = resolutionOf(poly_->points)};
  CleanOptions clean;
  clean.snap_m = snapDistance().length;
  clean.simplify_m = options_.simplify_m;
  clean.min_island_area_m2 = options_.min_island_area_m2;
  clean.dissolve = options_.dissolve;
  clean.pinches = options_.pinches;
  return cleanFeatures(coastline_, groups_[group], projectionOf(group), clean, report, loop);
}

std::optional<double> JobInput::area(std::size_t group) const {
  if (poly_) return std::nullopt;
  return geodesicArea(coastline_, groups_[group]);
}

std::optional<double> JobInput::area(const Domain& domain, const ItemLoop& loop) const {
  if (poly_) return std::nullopt;
  return geodesicArea(domain, coastline_.crs, loop);
}

namespace {

// Returns nullopt for a group of which nothing can be meshed.
std::optional<Domain> domainOf(const JobInput& input, std::size_t group, const ItemLoop& loop) {
  CleanReport ignored;
  try {
    return input.domain(group, ignored, loop);
  } catch (const InputError&) {
    return std::nullopt;
  } catch (const BadPslg&) {
    return std::nullopt;
  }
}

// The area of each group's polygons, whatever frames and regions are in it. Its domain has at most this area, unless
// parts of a polygon were cut off.
std::vector<double> polygonAreas(const JobInput& input, const ItemLoop& loop) {
  const std::vector<Feature>& features = input.coastline().features;
  std::vector<double> areas(input.groups());
  forEachByStretches(loop, areas.size(), [&](std::size_t g) {
    std::vector<std::size_t> own;
    std::ranges::copy_if(input.members(g), std::back_inserter(own), [&](std::size_t member) {
      return features[member].use == FeatureUse::Area || features[member].use == FeatureUse::Land;
    });
    areas[g] = geodesicArea(input.coastline(), own);
  });
  return areas;
}

bool isClipped(const JobInput& input, std::size_t group) {
  return std::ranges::any_of(input.members(group), [&](std::size_t member) {
    const Feature& feature = input.coastline().features[member];
    return feature.clipped || isFloodPlain(feature);
  });
}

}  // namespace

// The land is found beside the waters as they are cleaned without it.
void JobInput::addFloodPlain(const ItemLoop& loop) {
  if (!options_.flood.height_m) return;
  std::vector<Domain> waters;
  for (std::size_t g = 0; g < groups_.size(); ++g)
    if (std::optional<Domain> domain = domainOf(*this, g, loop)) waters.push_back(std::move(*domain));
  FloodPlain plain = floodPlainOf(coastline_, waters, options_.flood, loop);
  std::ranges::move(plain.features, std::back_inserter(coastline_.features));
  std::ranges::move(plain.notes, std::back_inserter(report_.notes));
  groups_ = groupFeatures(coastline_, reach(), loop);
}

std::optional<LargestGroup> largestGroup(const JobInput& input, const ItemLoop& loop) {
  const std::vector<double> areas = polygonAreas(input, loop);
  std::vector<double> bounds = areas;
  for (std::size_t g = 0; g < bounds.size(); ++g)
    if (isClipped(input, g)) bounds[g] = std::numeric_limits<double>::infinity();
  std::vector<std::size_t> order(bounds.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t g) { return bounds[g]; });
  std::optional<LargestGroup> largest;
  double most = 0.0;
  for (const std::size_t g : order) {
    if (largest && bounds[g] <= most) break;
    std::optional<Domain> domain = domainOf(input, g, loop);
    if (!domain) continue;
    const double area = input.area(*domain, loop).value_or(0.0);
    if (largest && !(area > most)) continue;
    most = area;
    largest = {g, std::move(*domain), 1.0};
  }
  const double all = std::accumulate(areas.begin(), areas.end(), 0.0);
  if (largest && all > 0.0) largest->share = areas[largest->group] / all;
  return largest;
}

}  // namespace coastmesh
