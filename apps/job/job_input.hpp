#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gis/clean/bend_edges.hpp"
#include "gis/clean/clean.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/coast/frame.hpp"
#include "gis/projection/projection.hpp"
#include "gis/read/read_coastline.hpp"

namespace coastmesh {

// What lengths and angles are measured on.
struct SurfaceChoice {
  SurfaceKind kind = SurfaceKind::Auto;
  bool where_known = false;  // where there is no place on Earth, or `crs` is chosen, the plane rules; else misuse

  bool needsEarth() const { return kind == SurfaceKind::Ellipsoid || kind == SurfaceKind::Sphere; }
};

// What to read, and how it becomes domains of the plane.
struct InputOptions {
  std::vector<std::string> files;          // vector files, or one .poly
  std::shared_ptr<const Pslg> pslg;        // in place of files: a ready plane graph; cleaning it is the caller's
  std::shared_ptr<const Coastline> ready;  // in place of files: features that `readInput` read
  ReadFilter filter;                       // what of the files is read
  FrameOptions frame;                      // what bounds the domain besides the shores
  std::string clip;                        // a file of polygons that bound it, in place of `frame.box`; empty: none
  std::vector<std::string> constraints;    // files of lines and points that become edges and vertices
  std::vector<std::string> weirs;          // files of lines
  std::vector<std::string> regions;        // files of polygons
  std::string crs = "auto";                // the working plane: "auto", "plane" or anything that PROJ knows
  SurfaceChoice surface;                   // what lengths and angles are measured on
  EdgeLine edges = EdgeLine::Plane;        // what an edge between two points stands for
  double edge_tolerance_m = 100.0;         // how far from that it may lie, metres, above 0
  double snap_m = 0.001;                   // metres, 0 or more
  bool snap_in_plane = false;              // `snap_m` holds for a plane input too, where else nothing is snapped
  double simplify_m = 0.0;                 // metres, 0 or more
  bool dissolve = false;                   // features that share an edge become one
  Pinches pinches = Pinches::Keep;         // what becomes of places where shores touch
  double min_island_area_m2 = 0.0;         // square metres, 0 or more
};

// Reads all the files that `options` name, which may not be a .poly. Throws OptionError, InputError.
Coastline readInput(const InputOptions& options, ReadReport& report);

// How many points its rings and lines have: a measure of the work that it is.
std::size_t pointsOf(const Feature& feature);

// An input that was read and split into groups of features, each of which is meshed apart. A .poly is one group.
class JobInput {
 public:
  // Reads, with the threads of `loop`; throws OptionError, InputError.
  explicit JobInput(const InputOptions& options, const ItemLoop& loop = inOrder);

  const Coastline& coastline() const { return coastline_; }
  const ReadReport& report() const { return report_; }
  bool isPoly() const { return poly_.has_value(); }
  std::size_t groups() const { return groups_.size(); }
  const std::vector<std::size_t>& members(std::size_t group) const { return groups_[group]; }
  std::size_t pointsOf(std::size_t group) const;
  // The same for the same features in the same groups, on any machine of a kind.
  std::uint64_t digest() const;
  // The working plane of a group.
  Projection projectionOf(std::size_t group) const;
  // What lengths and angles of a projection of its are measured on; never Auto.
  SurfaceKind surfaceOf(const Projection& projection) const;

  // Projects and cleans a group. Throws InputError where nothing of it can be meshed. May be called from several
  // threads at once. Throws NothingWanted for one that lies outside of the frame or apart from the water asked for.
  Domain domain(std::size_t group, CleanReport& report, const ItemLoop& loop = inOrder) const;
  // Square metres on the ellipsoid; none for a .poly, which says only with its holes what is inside.
  std::optional<double> area(std::size_t group) const;
  // The same of what was made of a group, where frames and coasts leave but a part of it.
  std::optional<double> area(std::size_t group, const Domain& domain, const ItemLoop& loop = inOrder) const;

 private:
  void readPolyFile(const std::string& path);
  void requireSurface();
  void bendEdges();
  void takePlaneGraph(Pslg pslg, const std::string& source);

  InputOptions options_;
  Coastline coastline_;
  ReadReport report_;
  std::vector<std::vector<std::size_t>> groups_;
  std::optional<Pslg> poly_;
  std::optional<Projection> chosen_;  // where the user chose one; the same for all groups
};

}  // namespace coastmesh
