#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gis/clean/bend_edges.hpp"
#include "gis/clean/clean.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/coast/frame.hpp"
#include "gis/coast/snap_distance.hpp"
#include "gis/flood_plain/flood_options.hpp"
#include "gis/model/boundary_rules.hpp"
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

// Reads all the files of `options`, which must not be a .poly, once; what `files` define about boundaries is added to
// `boundaries`. Throws OptionError, InputError.
// With `by_frame`, features far outside a box may be left out, which framing would exclude.
Coastline readInput(const InputOptions& options, ReadReport& report, BoundaryRules& boundaries, bool by_frame = false);

// The number of points of its rings and lines: a measure of the work.
std::size_t pointsOf(const Feature& feature);

// Throws InputError if the mesh would be clockwise in the coordinates that it is written in: those of the input mirror
// the ground, or `options.crs` mirrors them.
void requireUnmirrored(const Coastline& coastline, const InputOptions& options);

// An input that was read and split into groups of features, each to be meshed separately. A .poly is one group.
class JobInput {
 public:
  // Reads, with the threads of `loop`; throws OptionError, InputError.
  explicit JobInput(const InputOptions& options, const ItemLoop& loop = inOrder);

  const Coastline& coastline() const { return coastline_; }
  const ReadReport& report() const { return report_; }
  // What the files define about boundaries; empty for features that were read already.
  const BoundaryRules& boundaries() const { return boundaries_; }
  bool isPoly() const { return poly_.has_value(); }
  std::size_t groups() const { return groups_.size(); }
  const std::vector<std::size_t>& members(std::size_t group) const { return groups_[group]; }
  // The features that are frames.
  const std::vector<std::size_t>& frames() const { return frames_; }
  std::size_t pointsOf(std::size_t group) const;
  // Of the groups that do not lie beyond the frame, by their extents: the others will not be meshed.
  std::size_t pointsInFrame() const;
  // Groups the features again, for shores that may move by this distance after cleaning.
  void regroup(double shores_move_m, const ItemLoop& loop = inOrder);
  // Equal for the same features in the same groups, on any machine of a kind.
  std::uint64_t digest() const;
  // The working plane of a group.
  Projection projectionOf(std::size_t group) const;
  // The surface for lengths and angles in one of its projections; never Auto.
  SurfaceKind surfaceOf(const Projection& projection) const;

  // Projects and cleans a group. Throws InputError if nothing of it can be meshed. May be called from several threads
  // at once. Throws NothingWanted for one outside the frame or separate from the requested water.
  Domain domain(std::size_t group, CleanReport& report, const ItemLoop& loop = inOrder) const;
  // Square metres on the ellipsoid, the sum of its rings as they are; nullopt for a .poly, whose inside depends on its
  // holes.
  std::optional<double> area(std::size_t group) const;
  // Area of a group's domain: excludes what cleaning drops and what frames and coasts cut off; overlaps count once.
  std::optional<double> area(const Domain& domain, const ItemLoop& loop = inOrder) const;

 private:
  void requireReadyGraph(const std::string& name);
  void readPolyFile(const std::string& path);
  void requireSurface();
  void bendEdges();
  void addFloodPlain(const ItemLoop& loop);
  SnapDistance snapDistance() const;
  SnapDistance reach() const;
  void takePlaneGraph(Pslg pslg, const std::string& source);

  InputOptions options_;
  Coastline coastline_;
  ReadReport report_;
  BoundaryRules boundaries_;
  std::vector<std::vector<std::size_t>> groups_;
  std::vector<std::size_t> frames_;
  std::optional<Pslg> poly_;
  std::optional<Projection> chosen_;  // if the user chose one; the same for all groups
};

// The group with the largest area within the frame, and its domain.
struct LargestGroup {
  std::size_t group = 0;
  Domain domain;
  double share = 1.0;  // of the area of all groups, by their polygons as they are, beyond the frame too
};

// Returns nullopt if nothing of the input can be meshed. Of equal groups, returns the first.
std::optional<LargestGroup> largestGroup(const JobInput& input, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
