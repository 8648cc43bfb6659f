#include "apps/input/job_input.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "apps/input/read_input.hpp"
#include "apps/input/working_plane.hpp"
#include "core/metric.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/clean/areas_within.hpp"
#include "gis/clean/geodesic_area.hpp"
#include "gis/clean/whole_turns.hpp"
#include "gis/coast/feature_bounds.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/coast/group_features.hpp"
#include "gis/coast/guests.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/error.hpp"
#include "gis/flood_plain/flood_plain.hpp"
#include "gis/for_count.hpp"
#include "gis/format/poly_io.hpp"

namespace coastmesh {

JobInput::JobInput(const InputOptions& options, const ItemLoop& loop) : options_(options) {
  if (options_.pslg) {
    const std::string name = "the plane graph given";
    requireReadyGraph(options_, name);
    requireSurface();
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
  if (options_.min_island_area_m2 > 0.0) areas_ = std::make_shared<const AreasWithin>(coastline_);
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

void JobInput::readPolyFile(const std::string& path) {
  requireReadyGraph(options_, "'" + path + "'");
  requireSurface();
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
  clean.areas = areas_.get();
  clean.dissolve = options_.dissolve;
  clean.pinches = options_.pinches;
  return cleanFeatures(coastline_, groups_[group], projectionOf(group), clean, report, loop);
}

std::optional<Domain> JobInput::domainIfAny(std::size_t group, const ItemLoop& loop) const {
  CleanReport ignored;
  try {
    return domain(group, ignored, loop);
  } catch (const InputError&) {
    return std::nullopt;
  } catch (const BadPslg&) {
    return std::nullopt;
  }
}

std::optional<double> JobInput::area(std::size_t group) const {
  if (poly_) return std::nullopt;
  return geodesicArea(coastline_, groups_[group]);
}

std::optional<double> JobInput::area(const Domain& domain, const ItemLoop& loop) const {
  if (poly_) return std::nullopt;
  return geodesicArea(domain, coastline_.crs, loop);
}

// The land is found beside the waters as they are cleaned without it.
void JobInput::addFloodPlain(const ItemLoop& loop) {
  if (!options_.flood.height_m) return;
  std::vector<Domain> waters;
  for (std::size_t g = 0; g < groups_.size(); ++g)
    if (std::optional<Domain> domain = domainIfAny(g, loop)) waters.push_back(std::move(*domain));
  FloodPlain plain = floodPlainOf(coastline_, waters, options_.flood, loop);
  plain_.emplace(waters);
  std::ranges::move(plain.features, std::back_inserter(coastline_.features));
  std::ranges::move(plain.notes, std::back_inserter(report_.notes));
  groups_ = groupFeatures(coastline_, reach(), loop);
}

}  // namespace coastmesh
