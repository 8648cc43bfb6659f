#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/input/input_options.hpp"
#include "gis/flood_plain/plain_land.hpp"
#include "gis/model/boundary_rules.hpp"

namespace coastmesh {

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
  // What tells the flood plain's land from the water; null without a flood plain.
  const PlainLand* plain() const { return plain_ ? &*plain_ : nullptr; }
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
  // The same without a report; nullopt if nothing of the group can be meshed.
  std::optional<Domain> domainIfAny(std::size_t group, const ItemLoop& loop = inOrder) const;
  // Square metres on the ellipsoid, the sum of its rings as they are; nullopt for a .poly, whose inside depends on its
  // holes.
  std::optional<double> area(std::size_t group) const;
  // Area of a group's domain: excludes what cleaning drops and what frames and coasts cut off; overlaps count once.
  std::optional<double> area(const Domain& domain, const ItemLoop& loop = inOrder) const;

 private:
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
  std::shared_ptr<const AreasWithin> areas_;  // if small islands are left out; else null
  std::optional<PlainLand> plain_;
  std::optional<Pslg> poly_;
  std::optional<Projection> chosen_;  // if the user chose one; the same for all groups
};

}  // namespace coastmesh
