#include "apps/job_input.hpp"

#include <filesystem>

#include "apps/command_line.hpp"
#include "gis/error.hpp"
#include "gis/poly_io.hpp"

namespace coastmesh {

namespace {

bool isPolyFile(const std::string& path) { return std::filesystem::path(path).extension() == ".poly"; }

std::size_t countPoints(const Feature& feature) {
  std::size_t count = 0;
  for (const Polygon& polygon : feature.polygons) {
    count += polygon.outer.size();
    for (const Ring& hole : polygon.holes) count += hole.size();
  }
  for (const auto& line : feature.lines) count += line.size();
  return count;
}

Crs parseWorkingCrs(const std::string& text) {
  try {
    return parseCrs(text);
  } catch (const InputError& error) {
    throw UsageError(std::string("--crs: ") + error.what());
  }
}

}  // namespace

JobInput::JobInput(const InputOptions& options) : options_(options) {
  if (options_.pslg) {
    takePlaneGraph(*options_.pslg, "the plane graph given");
    return;
  }
  for (const std::string& file : options_.files) {
    if (isPolyFile(file) && options_.files.size() > 1) {
      throw UsageError("'" + file + "' is a ready plane graph and cannot be joined with other inputs; mesh it alone");
    }
  }
  if (isPolyFile(options_.files.front())) {
    readPolyFile(options_.files.front());
    return;
  }
  std::optional<Crs> working;
  if (options_.crs != "auto" && options_.crs != "plane") working = parseWorkingCrs(options_.crs);
  std::vector<Source> sources;
  for (const std::string& file : options_.files) sources.push_back({file, FeatureUse::Area});
  coastline_ = readCoastline(sources, options_.filter, report_);
  if (working) chosen_ = Projection::to(coastline_.crs, *working);
  groups_ = groupFeatures(coastline_);
}

void JobInput::readPolyFile(const std::string& path) {
  if (!options_.filter.layers.empty() || !options_.filter.where.empty()) {
    throw UsageError("'" + path + "' has neither layers nor attributes; leave out --layer and --where");
  }
  if (options_.crs != "auto" && options_.crs != "plane") {
    throw UsageError("'" + path + "' has plane coordinates already; leave out --crs, or give --crs plane");
  }
  takePlaneGraph(readPoly(path), path);
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
  for (std::size_t member : groups_[group]) count += countPoints(coastline_.features[member]);
  return count;
}

Projection JobInput::projectionOf(std::size_t group) const {
  if (chosen_) return *chosen_;
  if (options_.crs == "plane" || coastline_.crs.isPlane()) return Projection::plane();
  return Projection::fitted(coastline_, groups_[group]);
}

Domain JobInput::domain(std::size_t group, CleanReport& report) const {
  if (poly_) return Domain{*poly_, poly_->points, Projection::plane()};
  const bool in_plane = options_.crs == "plane" || coastline_.crs.isPlane();
  CleanOptions clean;
  clean.snap_m = in_plane && !options_.snap_in_plane ? 0.0 : options_.snap_m;
  clean.simplify_m = options_.simplify_m;
  clean.min_island_area_m2 = options_.min_island_area_m2;
  return cleanFeatures(coastline_, groups_[group], projectionOf(group), clean, report);
}

std::optional<double> JobInput::area(std::size_t group) const {
  if (poly_) return std::nullopt;
  return geodesicArea(coastline_, groups_[group]);
}

}  // namespace coastmesh
