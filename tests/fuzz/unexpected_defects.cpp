#include "tests/fuzz/unexpected_defects.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

namespace coastmesh {

std::vector<MeshDefect> unexpectedDefects(const TriMesh& mesh, const Pslg& pslg, const RefineOptions& options,
                                          const std::vector<BoundViolation>& unresolved) {
  std::set<std::pair<double, double>> listed;
  for (const BoundViolation& s : unresolved) listed.emplace(s.place.x, s.place.y);
  std::vector<MeshDefect> defects =
      checkMesh(mesh, &pslg, {.min_angle_deg = options.min_angle_deg, .max_angle_deg = options.max_angle_deg});
  std::erase_if(defects, [&](const MeshDefect& d) {
    return d.kind == DefectKind::AngleBelowBound && listed.contains({d.place.x, d.place.y});
  });
  return defects;
}

std::string describe(const MeshDefect& defect) {
  std::ostringstream text;
  text.precision(17);
  text << toString(defect.kind) << " at " << defect.place.x << ", " << defect.place.y;
  if (defect.triangle != kNone) text << ", triangle " << defect.triangle;
  if (defect.value != 0.0) text << ", value " << defect.value;
  return text.str();
}

}  // namespace coastmesh
