#include "apps/input/input_options.hpp"

#include <filesystem>

#include "gis/error.hpp"

namespace coastmesh {

bool isPolyFile(const std::string& path) { return std::filesystem::path(path).extension() == ".poly"; }

bool isPlaneGraph(const InputOptions& options) {
  return options.pslg || (!options.files.empty() && isPolyFile(options.files.front()));
}

std::string nameOfUnframed(DomainSide side) {
  return side == DomainSide::Ocean ? "ocean" : side == DomainSide::Land ? "land" : "globe";
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

SnapDistance snapDistanceOf(const InputOptions& options, const Crs& crs) {
  const bool in_plane = options.crs == "plane" || crs.isPlane();
  return {in_plane && !options.snap_in_plane ? 0.0 : options.snap_m, in_plane};
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

void requireReadyGraph(const InputOptions& options, const std::string& name) {
  if (options.frame.side != DomainSide::Auto || options.frame.box || options.frame.water_at || !options.clip.empty())
    throw OptionError(name + " defines the domain itself; leave out --domain, --bbox, --clip and --water-at");
  if (!options.filter.layers.empty() || !options.filter.where.empty())
    throw OptionError(name + " has neither layers nor attributes; leave out --layer and --where");
  if (!options.boundary_column.empty()) throw OptionError(name + " has no columns; leave out --boundary-column");
  if (options.pinches == Pinches::Open || options.dissolve || options.simplify_m > 0.0 ||
      options.min_island_area_m2 > 0.0 || options.snap_in_plane) {
    throw OptionError(name +
                      " is a ready plane graph and is not cleaned; leave out --pinches open, --dissolve, --simplify, "
                      "--min-island-area and --snap");
  }
  if (options.crs != "auto" && options.crs != "plane")
    throw OptionError(name + " has plane coordinates already; leave out --crs, or give --crs plane");
  if (options.flood.height_m) throw OptionError(name + " has no land that is known; leave out --flood-height");
  if (options.edges != EdgeLine::Plane) throw OptionError(name + " has straight edges in a plane; leave out --edges");
}

}  // namespace coastmesh
