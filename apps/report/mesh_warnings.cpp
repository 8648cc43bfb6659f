#include "apps/report/mesh_warnings.hpp"

#include <algorithm>
#include <cmath>

#include "gis/places.hpp"

namespace coastmesh {

namespace {

// Where degrees of longitude are short, SWAN makes repairs necessary that no repair can make well.
std::string adviceForSwan(const MeshJobResult& result) {
  constexpr double kFarNorth = 60.0;
  const auto isOfShortDegrees = [](const Repair& repair) {
    return repair.target == Target::Swan && repair.kind == TargetDefectKind::LargeAngle &&
           std::abs(repair.place.y) > kFarNorth;
  };
  if (!result.crs.geographic || std::ranges::none_of(result.finish.repairs.repairs, isOfShortDegrees)) return {};
  return "; SWAN measures angles in the degrees of its file, where good triangles of high latitudes are flat: an input "
         "in a projected CRS (ogr2ogr -t_srs) needs no such repairs";
}

}  // namespace

std::vector<std::string> warningsOf(const MeshJobResult& result) {
  constexpr std::size_t kRefusalsShown = 20;
  std::vector<std::string> all = result.read.warnings;
  const std::vector<std::string> of_finish = result.finish.warnings();
  all.insert(all.end(), of_finish.begin(), of_finish.end());
  all.insert(all.end(), result.step.warnings.begin(), result.step.warnings.end());
  if (result.turned > 0) {
    all.push_back("triangles that are not counter-clockwise on the ground: " + std::to_string(result.turned) +
                  ", the first at " + pointText(result.turned_places.front()) +
                  ": sides that are straight in the working plane are curved there; divide the long edges of the input "
                  "at that place (ogr2ogr -segmentize), or widen its angle");
  }
  if (result.short_of.count > 0 && !result.finish.repairs.repairs.empty() &&
      result.short_of.count > result.short_before_repairs) {
    all.push_back("repairs left triangles that miss the requested bounds: " + std::to_string(result.short_of.count) +
                  " in all, the first at " + pointText(result.short_of.places.front().place) + "; before there were " +
                  std::to_string(result.short_before_repairs) + adviceForSwan(result));
  }
  if (result.regions == 0 && result.refusals.size() == 1) return all;
  const std::size_t shown = std::min(kRefusalsShown, result.refusals.size());
  for (std::size_t i = 0; i < shown; ++i) all.push_back("left out: " + result.refusals[i].reason);
  if (result.refusals.size() > shown)
    all.push_back("left out: " + std::to_string(result.refusals.size() - shown) + " more, which the report lists");
  return all;
}

std::string shownNotes(const std::vector<std::string>& notes) {
  constexpr std::size_t kShown = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, notes.size()); ++i) text += notes[i] + "\n";
  if (notes.size() > kShown) text += std::to_string(notes.size() - kShown) + " more notes, which the report lists\n";
  return text;
}

}  // namespace coastmesh
