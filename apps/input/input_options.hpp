#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/pslg.hpp"
#include "gis/clean/bend_edges.hpp"
#include "gis/clean/clean.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/coast/frame.hpp"
#include "gis/coast/snap_distance.hpp"
#include "gis/flood_plain/flood_options.hpp"
#include "gis/projection/projection.hpp"
#include "gis/read/read_coastline.hpp"

namespace coastmesh {

// The surface on which lengths and angles are measured.
struct SurfaceChoice {
  SurfaceKind kind = SurfaceKind::Auto;
  bool where_known = false;  // without a place on Earth, or with a chosen `crs`, the plane is used; otherwise an error

  bool needsEarth() const { return kind == SurfaceKind::Ellipsoid || kind == SurfaceKind::Sphere; }
};

// The input, and how it becomes domains of the plane.
struct InputOptions {
  std::vector<std::string> files{};          // vector files, or one .poly
  std::shared_ptr<const Pslg> pslg{};        // instead of files: a ready plane graph, not to be cleaned
  std::shared_ptr<const Coastline> ready{};  // instead of files: features read by `readInput`
  ReadFilter filter{};                       // what of the files is read
  std::string boundary_column{};             // their column of boundary types; empty: only types that `clean` kept
  bool may_lack_column = false;              // the column may be missing, since other files have it
  FrameOptions frame{};                      // the limits of the domain besides the shores
  std::string clip{};                        // a file of polygons that limit it, instead of `frame.box`; empty: none
  std::vector<std::string> constraints{};    // files of lines and points that become edges and vertices
  std::vector<std::string> weirs{};          // files of lines
  std::vector<std::string> regions{};        // files of polygons
  FloodOptions flood{};                      // the low land that is meshed besides the water
  std::string crs = "auto";                  // the working plane: "auto", "plane" or anything that PROJ knows
  SurfaceChoice surface{};                   // the surface on which lengths and angles are measured
  EdgeLine edges = EdgeLine::Plane;          // what an edge between two points represents
  double edge_tolerance_m = 100.0;           // maximum distance from that, metres, above 0
  double snap_m = 0.001;                     // metres, 0 or more
  bool snap_in_plane = false;                // `snap_m` applies to a plane input too, which is not snapped otherwise
  double simplify_m = 0.0;                   // metres, 0 or more
  double shores_move_m = 0.0;                // the distance by which shores may move after cleaning, 0 or more
  bool dissolve = false;                     // features that share an edge become one
  Pinches pinches = Pinches::Keep;           // what to do where shores touch
  double min_island_area_m2 = 0.0;           // square metres, 0 or more
};

// True if the input is a plane graph, which has no features: `pslg` or a .poly.
bool isPlaneGraph(const InputOptions& options);

// True for the name of a .poly.
bool isPolyFile(const std::string& path);

// The vector files, and what their features are used as.
std::vector<Source> sourcesOf(const InputOptions& options);

// The domain's name for one that has no frame.
std::string nameOfUnframed(DomainSide side);

// The distance within which vertices of an input in this CRS are joined.
SnapDistance snapDistanceOf(const InputOptions& options, const Crs& crs);

// Throws OptionError for options of the domain that exclude one another, or that leave the water without a limit.
void requireOneFrame(const InputOptions& options);

// Throws OptionError for options that do not apply to a ready plane graph, which is used as it is.
void requireReadyGraph(const InputOptions& options, const std::string& name);

}  // namespace coastmesh
